// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What nvcc's code for the host calls beside CUDA's runtime itself, which is in Memory.cxx: kernels are launched by the
// name that nvcc gives them.
#include "Ptx.h"

#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace ptx
{

namespace
{

struct Known
{
  Kernel::Code* code;
  std::vector<std::size_t> bytes;
};
std::map<std::string, Known>& kernels()
{
  static std::map<std::string, Known> all;
  return all;
}
/// By the address of the function that launches it.
std::map<const void*, std::string>& namesOfKernels()
{
  static std::map<const void*, std::string> all;
  return all;
}

/// What has been done to a word in a launch.
struct Touched
{
  std::uint64_t launch = 0;
  std::uint64_t thread = 0; ///< the first one
  Access access = Access::Read;
  bool byOthers = false;
  int line = 0;
};
/// Words are of four bytes, or of one where less is touched: these are in other pages.
constexpr std::uintptr_t pageWords = 1024;
using Page = std::array<Touched, pageWords>;
std::map<std::pair<std::size_t, std::uintptr_t>, Page> pages;
std::uint64_t launches = 0; ///< that have begun

std::uint64_t currentThread()
{
  using namespace emulated;
  const std::uint64_t ofBlock = std::uint64_t{ block.y } * gridSize.x + block.x;
  return ofBlock * blockSize.x + thread.x;
}

void checkRaces(const char* memory, std::size_t bytes, Access access, int line)
{
  static Page* page = nullptr;
  static std::pair<std::size_t, std::uintptr_t> key;
  const std::uint64_t thread = currentThread();
  const std::size_t wordBytes = bytes < 4 ? 1 : 4;
  const auto first = reinterpret_cast<std::uintptr_t>(memory) / wordBytes;
  for (std::uintptr_t word = first; word < first + bytes / wordBytes; ++word)
  {
    if (page == nullptr || key != std::pair(wordBytes, word / pageWords))
    {
      key = { wordBytes, word / pageWords };
      page = &pages[key];
    }
    Touched& touched = (*page)[word % pageWords];
    if (touched.launch != launches)
    {
      touched = { launches, thread, access, false, line };
      continue;
    }
    const bool byOthers = touched.byOthers || touched.thread != thread;
    if (byOthers && (access != touched.access || access == Access::Write))
    {
      std::fprintf(stderr, "Emulated CUDA device: a race with line %d.\n", touched.line);
      emulated::fail("threads of a launch do not agree about memory", line);
    }
    touched.byOthers = byOthers;
    touched.access = access == Access::Read ? touched.access : access;
  }
}

} // namespace

Kernel::Kernel(const char* name, Code* code, std::vector<std::size_t> bytes)
{
  kernels()[name] = { code, std::move(bytes) };
}

void check(const char* memory, std::size_t bytes, Access access, int line)
{
  if (reinterpret_cast<std::uintptr_t>(memory) % bytes != 0)
  {
    emulated::fail("an address is not aligned", line);
  }
  if (!emulated::isAllocated(memory, bytes))
  {
    emulated::fail("memory is not the device's", line);
  }
  checkRaces(memory, bytes, access, line);
}

} // namespace ptx

using namespace ptx;

extern "C"
{

  cudaError_t cudaMalloc(void** memory, std::size_t bytes)
  {
    return emulated::allocate(memory, bytes);
  }

  cudaError_t cudaLaunchKernel(const void* stub, dim3 blocks, dim3 threads, void** arguments,
    std::size_t sharedBytes, cudaStream_t stream)
  {
    const auto found = kernels().find(namesOfKernels()[stub]);
    if (found == kernels().end())
    {
      emulated::fail("a kernel that is launched has not been translated");
    }
    // Copies, each aligned as any type may be.
    constexpr std::size_t alignment = 16;
    std::vector<std::size_t> offsets;
    std::size_t size = 0;
    for (const std::size_t bytes : found->second.bytes)
    {
      offsets.push_back(size);
      size += (bytes + alignment - 1) / alignment * alignment;
    }
    const auto given =
      std::make_shared<std::vector<std::max_align_t>>(size / sizeof(std::max_align_t) + 1);
    std::vector<char*> addresses;
    for (std::size_t n = 0; n < offsets.size(); ++n)
    {
      addresses.push_back(reinterpret_cast<char*>(given->data()) + offsets[n]);
      std::memcpy(addresses.back(), arguments[n], found->second.bytes[n]);
    }
    const auto run = [code = found->second.code, given, addresses, hasBegun = false]() mutable
    {
      launches += hasBegun ? 0 : 1;
      hasBegun = true;
      code(addresses.data());
    };
    return emulated::enqueue({ stub, blocks, threads, sharedBytes, run }, stream);
  }

  cudaError_t __cudaLaunchKernel(const void* stub, dim3 blocks, dim3 threads, void** arguments,
    std::size_t sharedBytes, cudaStream_t stream)
  {
    return cudaLaunchKernel(stub, blocks, threads, arguments, sharedBytes, stream);
  }

  void __cudaRegisterFunction(
    void**, const char* stub, char*, const char* name, int, void*, void*, void*, void*, int*)
  {
    namesOfKernels()[stub] = name;
  }

  cudaError_t __cudaGetKernel(const void** kernel, const void* stub)
  {
    *kernel = stub;
    return cudaSuccess;
  }

  void** __cudaRegisterFatBinary(void*)
  {
    static void* handle = nullptr;
    return &handle;
  }
  void __cudaRegisterFatBinaryEnd(void**) {}
  void __cudaUnregisterFatBinary(void**) {}
  cudaError_t __cudaPopCallConfiguration(dim3*, dim3*, std::size_t*, void*)
  {
    return cudaErrorInvalidConfiguration; // kernels are launched by launchKernel alone
  }

} // extern "C"
