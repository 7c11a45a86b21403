// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PointFit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace refractivity
{

namespace
{

/// Added to the matrix for second derivatives, in parts of their mean: where points are too few they are
/// small.
constexpr double leastSecond = 1e-5;
/// And for first ones, where all points lie in a plane or on a line.
constexpr double leastFirst = 1e-12;
/// Added to squares of distances, of the mean one: no weight is infinite.
constexpr double leastSquare = 1e-6;

constexpr int unknowns = 9; // three first derivatives, six second ones
constexpr std::size_t fewest = 3;

// For functions with packs as arguments.
#define SCHLIEREN_INLINE inline __attribute__((always_inline))

namespace two
{
constexpr int lanes = 2;
#include "PointFit.inl"
} // namespace two

// As in PlacesInCell.cxx.
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
#include "PointFit.inl"
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
#include "PointFit.inl"
} // namespace eight
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

} // namespace

void PointFit::clear(std::size_t most)
{
  this->neighbours = most;
  this->numbers.assign(4 * points * most, 0);
  std::fill(std::begin(this->counts), std::end(this->counts), 0);
}

std::vector<FitPoints> functionsToFit()
{
  std::vector<FitPoints> functions = { two::fit };
#if defined(SCHLIEREN_HAS_AVX)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    functions.push_back(four::fit);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma"))
  {
    functions.push_back(eight::fit);
  }
#endif
  return functions;
}

} // namespace refractivity
