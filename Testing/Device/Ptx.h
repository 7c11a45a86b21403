// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What translated PTX (translate-ptx) needs: the emulated device, checks of each access to memory, and arithmetic
// for which C++ has no operator or leaves something undefined.
#pragma once

#include "Threads.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace ptx
{

using u8 = std::uint8_t;
using s8 = std::int8_t;
using u16 = std::uint16_t;
using s16 = std::int16_t;
using u32 = std::uint32_t;
using s32 = std::int32_t;
using u64 = std::uint64_t;
using s64 = std::int64_t;

/// Makes the kernel known by its name. `bytes`: of each parameter.
struct Kernel
{
  using Code = void(char* const* given);
  Kernel(const char* name, Code* code, std::vector<std::size_t> bytes);
};

enum class Access
{
  Read,
  Write,
  Atomic
};

/// Ends the program where memory is not one allocation's or not aligned, and where another thread of the same launch has
/// touched it: only reads, or only atomic operations, may come together. `line`: of the PTX.
void check(const char* memory, std::size_t bytes, Access access, int line);

/// Integers are converted, other bits are kept.
template <class T, class From>
T as(From from)
{
  if constexpr (std::is_integral_v<T> && std::is_integral_v<From>)
  {
    return static_cast<T>(from);
  }
  else
  {
    static_assert(sizeof(T) == sizeof(From));
    T to;
    std::memcpy(&to, &from, sizeof(to));
    return to;
  }
}

inline char* place(u64 base, s64 offset)
{
  return reinterpret_cast<char*>(base + static_cast<u64>(offset));
}
inline u64 addressOf(const char* local) { return reinterpret_cast<u64>(local); }

template <class T>
T load(const char* from)
{
  T value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}
template <class T>
void store(char* to, T value)
{
  std::memcpy(to, &value, sizeof(value));
}

template <class T>
T atomic_add(char* to, T value, int line)
{
  check(to, sizeof(T), Access::Atomic, line);
  const T before = load<T>(to);
  store<T>(to, before + value);
  return before;
}
template <class T>
T atomic_max(char* to, T value, int line)
{
  check(to, sizeof(T), Access::Atomic, line);
  const T before = load<T>(to);
  store<T>(to, before < value ? value : before);
  return before;
}

template <class T>
T absolute(T value)
{
  return value < 0 || (std::is_floating_point_v<T> && value == 0) ? -value + 0 : value;
}

/// Of two numbers, the other one where one is NaN.
template <class T>
T minimum(T a, T b)
{
  return b < a || a != a ? b : a;
}
template <class T>
T maximum(T a, T b)
{
  return b > a || a != a ? b : a;
}

/// Limited to what T holds; of NaN, 0.
template <class T, class Real>
T toInteger(Real whole)
{
  using Limits = std::numeric_limits<T>;
  const Real end = std::ldexp(Real(1), Limits::digits); // one past the largest
  return whole != whole                        ? T(0)
    : whole < static_cast<Real>(Limits::min()) ? Limits::min()
    : whole >= end                             ? Limits::max()
                                               : static_cast<T>(whole);
}

template <class T>
T shiftedLeft(T value, u32 by)
{
  return by >= 8 * sizeof(T) ? T(0) : static_cast<T>(static_cast<u64>(value) << by);
}
template <class T>
T shiftedRight(T value, u32 by)
{
  return by < 8 * sizeof(T) ? static_cast<T>(value >> by) : static_cast<T>(value < T(0) ? -1 : 0);
}

/// `into` with `count` bits of `bits` from bit `first` on.
template <class T>
T withBits(T bits, T into, u32 first, u32 count)
{
  const T ones = static_cast<T>(shiftedLeft<T>(1, count) - 1);
  const T mask = shiftedLeft<T>(ones, first);
  return static_cast<T>((shiftedLeft<T>(bits, first) & mask) | (into & ~mask));
}

/// shfl.sync.down over whole warps, whose clamp is 31.
inline u32 shuffledDown(u32 value, u32 delta, u32 clamp, u32 mask, bool& found, int line)
{
  if (clamp != 31)
  {
    emulated::fail("a shuffle within parts of a warp is not emulated", line);
  }
  const int from = emulated::lane() + static_cast<int>(delta);
  found = from <= 31;
  emulated::shuffle(mask, &value, sizeof(value), from, line);
  return value;
}

} // namespace ptx
