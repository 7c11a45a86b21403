// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace schlieren
{

/// Throws DeviceError of a failed CUDA call, with what was being done.
inline void checkCuda(cudaError_t status, const char* doing)
{
  if (status != cudaSuccess)
  {
    cudaGetLastError(); // it must not haunt the next launch
    const std::string what = std::string(doing) +
      " on the CUDA device failed: " + cudaGetErrorString(status) + ". Set Device to Auto or CPU.";
    if (status == cudaErrorMemoryAllocation) // a kernel's stack, for one
    {
      throw OutOfDeviceMemory(what);
    }
    throw DeviceError(what);
  }
}

/// Memory of the device for `size` values, not initialised; for cudaFree.
template <class T>
T* allocateOnCuda(std::size_t size)
{
  T* data = nullptr;
  const cudaError_t status = cudaMalloc(&data, size * sizeof(T));
  if (status == cudaErrorMemoryAllocation)
  {
    cudaGetLastError();
    std::size_t free = 0, total = 0;
    checkCuda(cudaMemGetInfo(&free, &total), "Asking for free memory");
    const auto megabytes = [](std::size_t bytes) { return std::to_string(bytes >> 20) + " MB"; };
    throw OutOfDeviceMemory("The CUDA device has " + megabytes(free) + " of its " +
      megabytes(total) + " of memory free, but " + megabytes(size * sizeof(T)) +
      " more are needed. Set Device to Auto or CPU, or make less of it: smaller images, a coarser "
      "grid, "
      "or for other data less Medium Memory or more Medium Tolerance.");
  }
  checkCuda(status, "Allocating memory");
  return data;
}

/// Device memory for `size` values, freed with it.
template <class T>
class CudaBuffer
{
public:
  explicit CudaBuffer(std::size_t size)
    : data_(allocateOnCuda<T>(size))
  {
  }
  /// Copies the values there; `copying` is what a failure says: "Copying the medium".
  CudaBuffer(const T* values, std::size_t size, const char* copying)
    : CudaBuffer(size)
  {
    checkCuda(cudaMemcpy(data_, values, size * sizeof(T), cudaMemcpyHostToDevice), copying);
  }
  CudaBuffer(const CudaBuffer&) = delete;
  CudaBuffer& operator=(const CudaBuffer&) = delete;
  ~CudaBuffer() { cudaFree(data_); }

  T* data() const { return data_; }

private:
  T* data_;
};

/// A queue of work for the device. Queues run side by side, but the default one, where work goes that
/// names none, waits for all of them and they for it.
class CudaStream
{
public:
  CudaStream() { checkCuda(cudaStreamCreate(&stream_), "Making a stream"); }
  CudaStream(const CudaStream&) = delete;
  CudaStream& operator=(const CudaStream&) = delete;
  ~CudaStream()
  {
    cudaStreamSynchronize(stream_); // nothing may write to memory that is freed after it
    cudaStreamDestroy(stream_);
  }

  cudaStream_t get() const { return stream_; }

  /// Waits for the work so far; throws what went wrong in it.
  void wait(const char* doing) const { checkCuda(cudaStreamSynchronize(stream_), doing); }

private:
  cudaStream_t stream_ = nullptr;
};

/// A moment in a queue's work.
class CudaEvent
{
public:
  CudaEvent() { checkCuda(cudaEventCreate(&event_), "Making an event"); }
  CudaEvent(const CudaEvent&) = delete;
  CudaEvent& operator=(const CudaEvent&) = delete;
  ~CudaEvent() { cudaEventDestroy(event_); }

  /// When the queue's work so far is done.
  void record(const CudaStream& stream)
  {
    checkCuda(cudaEventRecord(event_, stream.get()), "Recording an event");
  }
  /// Both have happened.
  static double secondsBetween(const CudaEvent& begin, const CudaEvent& end)
  {
    float milliseconds = 0;
    checkCuda(cudaEventElapsedTime(&milliseconds, begin.event_, end.event_), "Reading an event");
    return 1e-3 * static_cast<double>(milliseconds);
  }

private:
  cudaEvent_t event_ = nullptr;
};

} // namespace schlieren
