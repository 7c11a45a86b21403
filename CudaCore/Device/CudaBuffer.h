// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <string>
#include <utility>

namespace schlieren
{

/// Turns a failed CUDA call into `Failure`, with what was being done.
template <class Failure>
void checkCuda(cudaError_t status, const char* doing)
{
  if (status != cudaSuccess)
  {
    cudaGetLastError(); // an out-of-memory must not haunt the next launch
    throw Failure(std::string(doing) + " on the CUDA device failed: " + cudaGetErrorString(status));
  }
}

/// Device memory for `size` values, freed with it.
template <class T, class Failure>
class CudaBuffer
{
public:
  explicit CudaBuffer(std::size_t size)
  {
    checkCuda<Failure>(cudaMalloc(&data_, size * sizeof(T)), "Allocating memory");
  }
  CudaBuffer(const T* values, std::size_t size)
    : CudaBuffer(size)
  {
    checkCuda<Failure>(
      cudaMemcpy(data_, values, size * sizeof(T), cudaMemcpyHostToDevice), "Copying the medium");
  }
  CudaBuffer(const CudaBuffer&) = delete;
  CudaBuffer& operator=(const CudaBuffer&) = delete;
  ~CudaBuffer() { cudaFree(data_); }

  T* data() const { return data_; }

private:
  T* data_ = nullptr;
};

} // namespace schlieren
