// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What CudaBuffer.h needs of CUDA, for TestCudaBuffer.cxx: a device to which nothing can be copied.
#pragma once

#include <cstddef>
#include <cstdlib>

enum cudaError_t
{
  cudaSuccess,
  cudaErrorMemoryAllocation,
  cudaErrorInvalidValue
};
enum cudaMemcpyKind
{
  cudaMemcpyHostToDevice
};
using cudaStream_t = void*;

inline cudaError_t cudaGetLastError() { return cudaSuccess; }
inline const char* cudaGetErrorString(cudaError_t) { return "invalid argument"; }
inline cudaError_t cudaMemGetInfo(std::size_t*, std::size_t*) { return cudaSuccess; }
template <class T>
cudaError_t cudaMalloc(T** data, std::size_t size)
{
  *data = static_cast<T*>(std::malloc(size));
  return cudaSuccess;
}
inline cudaError_t cudaFree(void* data)
{
  std::free(data);
  return cudaSuccess;
}
inline cudaError_t cudaMemcpy(void*, const void*, std::size_t, cudaMemcpyKind)
{
  return cudaErrorInvalidValue;
}
inline cudaError_t cudaStreamCreate(cudaStream_t*) { return cudaSuccess; }
inline cudaError_t cudaStreamDestroy(cudaStream_t) { return cudaSuccess; }
inline cudaError_t cudaStreamSynchronize(cudaStream_t) { return cudaSuccess; }
