// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <type_traits>

namespace schlieren
{

/// kernel<<<blocks, threads, sharedBytes, stream>>>(arguments...), in C++ that any compiler reads; so
/// kernels also run on the emulated device of Testing/Device. The arguments become what the kernel takes.
/// cudaGetLastError then returns the error.
template <class... Parameters>
void launchKernel(void (*kernel)(Parameters...), dim3 blocks, dim3 threads, std::size_t sharedBytes,
  cudaStream_t stream, std::common_type_t<Parameters>... arguments)
{
  void* addresses[] = { &arguments... };
  cudaLaunchKernel(kernel, blocks, threads, addresses, sharedBytes, stream);
}

} // namespace schlieren
