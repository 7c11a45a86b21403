// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlacesInCell.h"

#include <cstdint>
#include <cstring>
#include <limits>

namespace refractivity
{

namespace
{

// Newton's method converges quadratically: after a step as small as this nothing is left.
constexpr int mostSteps = 15;
constexpr double lastStep = 1e-7;
constexpr double farthest = 1; // from the range
constexpr double nearlyAffine = 0.5;
constexpr double nothing = 1e-14; // of what is left, in edges: also where cells are collapsed

// For functions with packs as arguments.
#define SCHLIEREN_INLINE inline __attribute__((always_inline))

namespace two
{
constexpr int lanes = 2;
#include "PlacesInCell.inl"
} // namespace two

// Types, too, depend on the instructions: where GCC knows of these only in functions, it compares lane by lane.
#if defined(__x86_64__)
#define SCHLIEREN_HAS_AVX

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
namespace four
{
constexpr int lanes = 4;
#include "PlacesInCell.inl"
} // namespace four
#if defined(__clang__)
#pragma clang attribute pop
#pragma clang attribute push( \
  __attribute__((target("avx512f,avx512dq,avx512vl,fma"))), apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,fma")
#endif
namespace eight
{
constexpr int lanes = 8;
#include "PlacesInCell.inl"
} // namespace eight
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

} // namespace

std::vector<LocateInCell> functionsToLocate()
{
  std::vector<LocateInCell> functions = { two::locate };
#if defined(SCHLIEREN_HAS_AVX)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    functions.push_back(four::locate);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma"))
  {
    functions.push_back(eight::locate);
  }
#endif
  return functions;
}

} // namespace refractivity
