// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compiles SCHLIEREN_CODE_FOR_PACKS, functions for packs of `lanes` numbers, for two lanes, for
// four with AVX2 and for eight with AVX-512, in a namespace each. SCHLIEREN_VARIANTS_OF(function) returns
// those for the instructions that this processor has, slowest first.

// For functions with packs as arguments.
#define SCHLIEREN_INLINE inline __attribute__((always_inline))

namespace two
{
constexpr int lanes = 2;
#include "Packs.inl"
#include SCHLIEREN_CODE_FOR_PACKS
} // namespace two

// Sets the instructions for types, too, because GCC else compares them lane by lane.
#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
namespace four
{
constexpr int lanes = 4;
#include "Packs.inl"
#include SCHLIEREN_CODE_FOR_PACKS
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
#include "Packs.inl"
#include SCHLIEREN_CODE_FOR_PACKS
} // namespace eight
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

template <class Function>
std::vector<Function> variants(Function ofTwo, Function ofFour, Function ofEight)
{
  std::vector<Function> functions = { ofTwo };
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    functions.push_back(ofFour);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma"))
  {
    functions.push_back(ofEight);
  }
  return functions;
}
#define SCHLIEREN_VARIANTS_OF(function) variants(&two::function, &four::function, &eight::function)
#else
#define SCHLIEREN_VARIANTS_OF(function) { &two::function }
#endif
