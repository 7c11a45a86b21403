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
    cudaGetLastError(); // it must not haunt the next launch
    throw Failure(std::string(doing) + " on the CUDA device failed: " + cudaGetErrorString(status) +
      ". Set Device to Auto or CPU.");
  }
}

/// Memory of the device for `size` values, not initialised; for cudaFree.
template <class T, class Failure>
T* allocateOnCuda(std::size_t size)
{
  T* data = nullptr;
  const cudaError_t status = cudaMalloc(&data, size * sizeof(T));
  if (status == cudaErrorMemoryAllocation)
  {
    cudaGetLastError();
    std::size_t free = 0, total = 0;
    checkCuda<Failure>(cudaMemGetInfo(&free, &total), "Asking for free memory");
    const auto megabytes = [](std::size_t bytes) { return std::to_string(bytes >> 20) + " MB"; };
    throw Failure("The CUDA device has " + megabytes(free) + " of its " + megabytes(total) +
      " of memory free, but " + megabytes(size * sizeof(T)) +
      " more are needed. Set Device to Auto or CPU, or take a coarser grid or smaller pictures.");
  }
  checkCuda<Failure>(status, "Allocating memory");
  return data;
}

/// Device memory for `size` values, freed with it.
template <class T, class Failure>
class CudaBuffer
{
public:
  explicit CudaBuffer(std::size_t size)
    : data_(allocateOnCuda<T, Failure>(size))
  {
  }
  /// With the values; `copying` is what a failure says: "Copying the medium".
  CudaBuffer(const T* values, std::size_t size, const char* copying)
    : CudaBuffer(size)
  {
    checkCuda<Failure>(
      cudaMemcpy(data_, values, size * sizeof(T), cudaMemcpyHostToDevice), copying);
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
template <class Failure>
class CudaStream
{
public:
  CudaStream() { checkCuda<Failure>(cudaStreamCreate(&stream_), "Making a stream"); }
  CudaStream(const CudaStream&) = delete;
  CudaStream& operator=(const CudaStream&) = delete;
  ~CudaStream()
  {
    cudaStreamSynchronize(stream_); // nothing may write to memory that is freed after it
    cudaStreamDestroy(stream_);
  }

  cudaStream_t get() const { return stream_; }

  /// Waits for the work so far; throws what went wrong in it.
  void wait(const char* doing) const { checkCuda<Failure>(cudaStreamSynchronize(stream_), doing); }

private:
  cudaStream_t stream_ = nullptr;
};

/// A moment in a queue's work.
template <class Failure>
class CudaEvent
{
public:
  CudaEvent() { checkCuda<Failure>(cudaEventCreate(&event_), "Making an event"); }
  CudaEvent(const CudaEvent&) = delete;
  CudaEvent& operator=(const CudaEvent&) = delete;
  ~CudaEvent() { cudaEventDestroy(event_); }

  /// When the queue's work so far is done.
  void record(const CudaStream<Failure>& stream)
  {
    checkCuda<Failure>(cudaEventRecord(event_, stream.get()), "Recording an event");
  }
  /// Both have happened.
  static double secondsBetween(const CudaEvent& begin, const CudaEvent& end)
  {
    float milliseconds = 0;
    checkCuda<Failure>(
      cudaEventElapsedTime(&milliseconds, begin.event_, end.event_), "Reading an event");
    return 1e-3 * static_cast<double>(milliseconds);
  }

private:
  cudaEvent_t event_ = nullptr;
};

} // namespace schlieren
