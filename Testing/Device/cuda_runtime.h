// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A CUDA device that is emulated on the host, for tests on machines without one. Replaces the toolkit's
// header of this name where .cu files are compiled as C++ (SCHLIEREN_CUDA=EMULATED). It has what CudaCore
// uses.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <tuple>
#include <utility>

#define __global__
#define __device__
#define __host__
#define __grid_constant__
#define __launch_bounds__(...)

enum cudaError_t
{
  cudaSuccess = 0,
  cudaErrorInvalidValue = 1,
  cudaErrorMemoryAllocation = 2,
  cudaErrorInvalidConfiguration = 9,
  cudaErrorNoDevice = 100,
  cudaErrorInvalidDevice = 101,
  cudaErrorInvalidResourceHandle = 400,
  cudaErrorNotReady = 600,
};
enum cudaMemcpyKind
{
  cudaMemcpyHostToDevice = 1,
  cudaMemcpyDeviceToHost = 2,
};
enum cudaDeviceAttr
{
  cudaDevAttrComputeCapabilityMajor = 75,
  cudaDevAttrComputeCapabilityMinor = 76,
};
using cudaStream_t = struct CUstream_st*;
using cudaEvent_t = struct CUevent_st*;

struct uint3
{
  unsigned x, y, z;
};
struct dim3
{
  unsigned x, y, z;
  constexpr dim3(unsigned ofX = 1, unsigned ofY = 1, unsigned ofZ = 1)
    : x(ofX)
    , y(ofY)
    , z(ofZ)
  {
  }
};

extern "C"
{

  cudaError_t cudaGetDeviceCount(int* count);
  cudaError_t cudaGetDevice(int* device);
  cudaError_t cudaSetDevice(int device);
  cudaError_t cudaDeviceGetAttribute(int* value, cudaDeviceAttr attribute, int device);
  cudaError_t cudaGetLastError();
  const char* cudaGetErrorString(cudaError_t error);
  cudaError_t cudaMemGetInfo(std::size_t* free, std::size_t* total);
  cudaError_t cudaFree(void* memory);
  cudaError_t cudaMemcpy(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind);
  cudaError_t cudaMemcpyAsync(
    void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t stream);
  cudaError_t cudaMemset(void* to, int value, std::size_t bytes);
  cudaError_t cudaStreamCreate(cudaStream_t* stream);
  cudaError_t cudaStreamSynchronize(cudaStream_t stream);
  cudaError_t cudaStreamDestroy(cudaStream_t stream);
  cudaError_t cudaEventCreate(cudaEvent_t* event);
  cudaError_t cudaEventRecord(cudaEvent_t event, cudaStream_t stream);
  cudaError_t cudaEventElapsedTime(float* milliseconds, cudaEvent_t begin, cudaEvent_t end);
  cudaError_t cudaEventDestroy(cudaEvent_t event);

} // extern "C"

namespace emulated
{

cudaError_t allocate(void** memory, std::size_t bytes);

struct Launch
{
  const void* kernel; ///< its address
  dim3 blocks, threads;
  std::size_t sharedBytes;
  std::function<void()> thread; ///< what each thread does
};
/// Ends the program where one of the values is an address of the host.
void checkArgument(const void* value, std::size_t bytes);
cudaError_t enqueue(Launch launch, cudaStream_t stream);

// Of the thread that runs.
extern uint3 thread, block;
extern dim3 blockSize, gridSize;
int lane();
/// How many threads of the block bring a one. `line` is the caller's.
int countOverBlock(int one, int line);
/// Replaces the value by that of another lane of the warp, if there is one.
void shuffle(unsigned mask, void* value, std::size_t bytes, int fromLane, int line);

/// What a kernel is given. What lies between the members of structures could look like an address.
template <class T>
T checkedArgument(const void* given)
{
  T value = *static_cast<const T*>(given);
#if __has_builtin(__builtin_clear_padding)
  __builtin_clear_padding(&value);
  checkArgument(&value, sizeof(T));
#endif
  return value;
}

template <class... Parameters, std::size_t... n>
std::tuple<Parameters...> argumentsOf(void** given, std::index_sequence<n...>)
{
  return { checkedArgument<Parameters>(given[n])... };
}

} // namespace emulated

template <class T>
cudaError_t cudaMalloc(T** memory, std::size_t bytes)
{
  return emulated::allocate(reinterpret_cast<void**>(memory), bytes);
}

template <class... Parameters>
cudaError_t cudaLaunchKernel(void (*kernel)(Parameters...), dim3 blocks, dim3 threads,
  void** arguments, std::size_t sharedBytes, cudaStream_t stream)
{
  const auto values =
    emulated::argumentsOf<Parameters...>(arguments, std::index_sequence_for<Parameters...>());
  return emulated::enqueue({ reinterpret_cast<const void*>(kernel), blocks, threads, sharedBytes,
                             [kernel, values] { std::apply(kernel, values); } },
    stream);
}

#define threadIdx (emulated::thread)
#define blockIdx (emulated::block)
#define blockDim (emulated::blockSize)
#define gridDim (emulated::gridSize)

inline int __syncthreads_count(int condition, int line = __builtin_LINE())
{
  return emulated::countOverBlock(condition != 0 ? 1 : 0, line);
}
inline void __syncthreads(int line = __builtin_LINE()) { emulated::countOverBlock(0, line); }

template <class T>
T __shfl_down_sync(unsigned mask, T value, unsigned delta, int line = __builtin_LINE())
{
  static_assert(sizeof(T) <= 8);
  emulated::shuffle(mask, &value, sizeof(T), emulated::lane() + static_cast<int>(delta), line);
  return value;
}

// Threads take turns at barriers alone, so nothing comes between reading and writing.
template <class T>
T atomicAdd(T* to, T value)
{
  return std::exchange(*to, *to + value);
}
template <class T>
T atomicMax(T* to, T value)
{
  return std::exchange(*to, *to < value ? value : *to);
}

inline long long __double_as_longlong(double value)
{
  long long bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}
