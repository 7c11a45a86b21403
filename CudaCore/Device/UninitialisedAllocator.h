// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>

namespace schlieren
{

/// Requests pages of 2 MiB, where it has them and the memory holds some: a volume of 256^3
/// floats is made in 3/4 (Linear) to 9/10 (Quadratic) of the time.
void requestHugePages(void* memory, std::size_t bytes);

/// Leaves what it finds in memory: whoever makes a volume, or traces rays, writes all of it anyway, and the
/// system hands out pages on the first write, to many threads faster than to one.
template <class T>
struct UninitialisedAllocator : std::allocator<T>
{
  UninitialisedAllocator() = default;
  template <class Other>
  UninitialisedAllocator(const UninitialisedAllocator<Other>&) noexcept
  {
  }
  template <class Other>
  struct rebind
  {
    using other = UninitialisedAllocator<Other>;
  };

  template <class Other>
  void construct(Other* at) noexcept
  {
    ::new (static_cast<void*>(at)) Other;
  }
  T* allocate(std::size_t count)
  {
    T* memory = std::allocator<T>::allocate(count);
    requestHugePages(memory, count * sizeof(T));
    return memory;
  }

  template <class Other, class... Arguments>
  void construct(Other* at, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(at)) Other(std::forward<Arguments>(arguments)...);
  }
};

} // namespace schlieren
