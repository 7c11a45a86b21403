// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PeakMemory.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{

std::atomic<std::size_t> allocated{ 0 };
std::atomic<std::size_t> most{ 0 };

/// Requests of this thread for memory until one fails; negative: none does.
thread_local int untilFailure = -1;

/// Before each block stands its size.
constexpr std::size_t header = alignof(std::max_align_t);

void* allocate(std::size_t size) noexcept
{
  if (untilFailure >= 0 && untilFailure-- == 0)
  {
    return nullptr;
  }
  void* block = std::malloc(size + header);
  if (block == nullptr)
  {
    return nullptr;
  }
  *static_cast<std::size_t*>(block) = size;
  const std::size_t now = allocated += size;
  std::size_t before = most;
  while (before < now && !most.compare_exchange_weak(before, now))
  {
  }
  return static_cast<char*>(block) + header;
}

void* allocateOrThrow(std::size_t size)
{
  void* memory = allocate(size);
  if (memory == nullptr)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void release(void* memory) noexcept
{
  if (memory != nullptr)
  {
    void* block = static_cast<char*>(memory) - header;
    allocated -= *static_cast<std::size_t*>(block);
    std::free(block);
  }
}

} // namespace

// All but those for over-aligned types, which stay the library's own.
void* operator new(std::size_t size) { return allocateOrThrow(size); }
void* operator new[](std::size_t size) { return allocateOrThrow(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }

namespace schlieren
{

PeakMemory::PeakMemory()
  : before_(allocated)
{
  most = before_;
}

std::size_t PeakMemory::bytes() const { return most - before_; }

FailingAllocation::FailingAllocation(int number) { untilFailure = number; }

FailingAllocation::~FailingAllocation() { untilFailure = -1; }

bool FailingAllocation::hasFailed() const { return untilFailure < 0; }

} // namespace schlieren
