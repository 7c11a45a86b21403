// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The emulated device notices what a real one may let pass.
#include "Device/CudaBuffer.h"
#include "Device/CudaLaunch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

namespace schlieren
{

namespace
{

template <class T>
T* deviceMemory(std::size_t size)
{
  T* data = nullptr;
  EXPECT_EQ(cudaMalloc(&data, size * sizeof(T)), cudaSuccess);
  return data;
}

template <class T>
std::vector<T> toHost(const T* data, std::size_t size)
{
  std::vector<T> values(size);
  EXPECT_EQ(cudaMemcpy(values.data(), data, size * sizeof(T), cudaMemcpyDeviceToHost), cudaSuccess);
  return values;
}

__device__ int index() { return static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); }

__global__ void write(int* to, int value) { to[index()] = value; }

__global__ void leaveOneOut(int left)
{
  if (index() != left)
  {
    __syncthreads();
  }
}

__global__ void waitApart(int parts)
{
  if (index() % parts == 0)
  {
    __syncthreads();
  }
  else
  {
    __syncthreads();
  }
}

TEST(EmulatedDevice, HasNoNumbersInNewMemory)
{
  float* data = deviceMemory<float>(3);
  for (const float value : toHost(data, 3))
  {
    EXPECT_TRUE(std::isnan(value));
  }
  cudaFree(data);
  long long* number = deviceMemory<long long>(1);
  EXPECT_GT(toHost(number, 1)[0], 1ll << 62);
  cudaFree(number);
}

TEST(EmulatedDevice, RefusesWhatCudaRefuses)
{
  int* data = deviceMemory<int>(2);
  int value = 0;
  EXPECT_EQ(cudaMemcpy(data, nullptr, sizeof(int), cudaMemcpyHostToDevice), cudaErrorInvalidValue);
  EXPECT_EQ(cudaMemcpy(&value, &value, sizeof(int), cudaMemcpyDeviceToHost), cudaErrorInvalidValue);
  EXPECT_EQ(cudaMemset(data + 1, 0, 2 * sizeof(int)), cudaErrorInvalidValue);
  EXPECT_EQ(cudaFree(&value), cudaErrorInvalidValue);
  cudaGetLastError();
  launchKernel(write, 1, 1025, 0, nullptr, data, 1);
  EXPECT_EQ(cudaGetLastError(), cudaErrorInvalidConfiguration);
  launchKernel(write, 0, 1, 0, nullptr, data, 1);
  EXPECT_EQ(cudaGetLastError(), cudaErrorInvalidConfiguration);
  EXPECT_EQ(cudaGetLastError(), cudaSuccess);
  cudaFree(data);
}

TEST(EmulatedDeviceDeathTest, KeepsTheHostOffItsMemory)
{
  int* data = deviceMemory<int>(1);
  EXPECT_DEATH(*data = 1, "");
  cudaFree(data);
}

TEST(EmulatedDeviceDeathTest, KeepsKernelsWithinTheirMemory)
{
  int* data = deviceMemory<int>(4);
  const auto end = [data]
  {
    launchKernel(write, 1, 5, 0, nullptr, data, 1);
    cudaStreamSynchronize(nullptr);
  };
  const auto freed = [data]
  {
    cudaFree(data);
    deviceMemory<int>(4);
    launchKernel(write, 1, 1, 0, nullptr, data, 1);
    cudaStreamSynchronize(nullptr);
  };
  EXPECT_DEATH(end(), "");
  EXPECT_DEATH(freed(), "");
  cudaFree(data);
}

TEST(EmulatedDeviceDeathTest, KeepsKernelsOffTheHost)
{
  int value = 0;
  const auto given = [&value] { launchKernel(write, 1, 1, 0, nullptr, &value, 1); };
  EXPECT_DEATH(given(), "address of the host");
}

TEST(EmulatedDeviceDeathTest, WantsAllThreadsAtABarrier)
{
  const auto leftOut = []
  {
    launchKernel(leaveOneOut, 1, 40, 0, nullptr, 35);
    cudaStreamSynchronize(nullptr);
  };
  const auto apart = []
  {
    launchKernel(waitApart, 1, 40, 0, nullptr, 2);
    cudaStreamSynchronize(nullptr);
  };
  EXPECT_DEATH(leftOut(), "waits for others that never come");
  EXPECT_DEATH(apart(), "wait for each other in different places");
}

TEST(EmulatedDeviceDeathTest, WantsItsMemoryBack)
{
  const auto forget = []
  {
    deviceMemory<int>(1);
    std::exit(0);
  };
  EXPECT_EXIT(forget(), testing::KilledBySignal(SIGABRT), "was not freed");
}

} // namespace

} // namespace schlieren
