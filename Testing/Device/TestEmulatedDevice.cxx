// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The emulated device notices what a real one may let pass.
#include "Device/CudaBuffer.h"
#include "Device/CudaLaunch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <numeric>
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

__global__ void queueUp(int* queue, int* length)
{
  const int number = index();
  queue[atomicAdd(length, 1)] = number;
  __syncthreads();
  queue[atomicAdd(length, 1)] = number;
}

__global__ void write(int* to, int value) { to[index()] = value; }

__global__ void sumUp(int* sums, int* greater, int least)
{
  int sum = index();
  const int count = __syncthreads_count(sum >= least);
  for (unsigned lanes = 16; lanes > 0; lanes /= 2)
  {
    sum += __shfl_down_sync(0xffffffff, sum, lanes);
  }
  if (threadIdx.x % 32 == 0)
  {
    sums[index() / 32] = sum;
    greater[index() / 32] = count;
  }
}

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

TEST(EmulatedDevice, RunsThreadsInTheOrderThatTheEnvironmentNames)
{
  constexpr std::size_t blocks = 3, threads = 7;
  int* queue = deviceMemory<int>(2 * blocks * threads);
  int* length = deviceMemory<int>(1);
  cudaMemset(length, 0, sizeof(int));
  launchKernel(queueUp, blocks, threads, 0, nullptr, queue, length);
  const std::vector<int> found = toHost(queue, 2 * blocks * threads);
  cudaFree(queue);
  cudaFree(length);

  std::vector<int> forward;
  for (int block = 0; block < static_cast<int>(blocks); ++block)
  {
    for (int turn = 0; turn < 2; ++turn)
    {
      for (int thread = 0; thread < static_cast<int>(threads); ++thread)
      {
        forward.push_back(block * static_cast<int>(threads) + thread);
      }
    }
  }
  const std::vector<int> backward(forward.rbegin(), forward.rend());
  const char* given = std::getenv("EMULATED_ORDER");
  const std::string order = given != nullptr ? given : "forward";
  if (order == "forward")
  {
    EXPECT_EQ(found, forward);
  }
  else if (order == "backward")
  {
    EXPECT_EQ(found, backward);
  }
  else
  {
    EXPECT_TRUE(std::is_permutation(found.begin(), found.end(), forward.begin()));
    EXPECT_NE(found, forward);
    EXPECT_NE(found, backward);
  }
}

TEST(EmulatedDevice, CountsOverBlocksAndShufflesOverWarps)
{
  int* sums = deviceMemory<int>(4);
  int* greater = deviceMemory<int>(4);
  launchKernel(sumUp, 2, 64, 0, nullptr, sums, greater, 10);
  EXPECT_EQ(toHost(sums, 4), (std::vector<int>{ 496, 1520, 2544, 3568 }));
  EXPECT_EQ(toHost(greater, 4), (std::vector<int>{ 54, 54, 64, 64 }));
  cudaFree(sums);
  cudaFree(greater);
}

TEST(EmulatedDevice, WorksWhenItIsWaitedFor)
{
  cudaStream_t stream{}, other{};
  cudaStreamCreate(&stream);
  cudaStreamCreate(&other);
  int* data = deviceMemory<int>(1);
  int value = 0;
  launchKernel(write, 1, 1, 0, stream, data, 5);
  cudaMemcpyAsync(&value, data, sizeof(int), cudaMemcpyDeviceToHost, stream);
  EXPECT_EQ(value, 0);
  cudaStreamSynchronize(other);
  EXPECT_EQ(value, 0);
  cudaStreamSynchronize(stream);
  EXPECT_EQ(value, 5);
  launchKernel(write, 1, 1, 0, stream, data, 6);
  EXPECT_EQ(toHost(data, 1)[0], 6); // the default stream waits for the others
  cudaFree(data);
  cudaStreamDestroy(stream);
  cudaStreamDestroy(other);
}

TEST(EmulatedDevice, NotesWhenWorkWasDone)
{
  cudaStream_t stream{};
  cudaStreamCreate(&stream);
  cudaEvent_t begin{}, end{};
  cudaEventCreate(&begin);
  cudaEventCreate(&end);
  int* data = deviceMemory<int>(1 << 12);
  float milliseconds = -1;
  EXPECT_EQ(cudaEventElapsedTime(&milliseconds, begin, end), cudaErrorInvalidValue);
  cudaEventRecord(begin, stream);
  launchKernel(write, 1 << 12, 1, 0, stream, data, 1);
  cudaEventRecord(end, stream);
  EXPECT_EQ(cudaEventElapsedTime(&milliseconds, begin, end), cudaErrorNotReady);
  cudaStreamSynchronize(stream);
  EXPECT_EQ(cudaEventElapsedTime(&milliseconds, begin, end), cudaSuccess);
  EXPECT_GT(milliseconds, 0);
  cudaGetLastError();
  cudaFree(data);
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  cudaStreamDestroy(stream);
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
