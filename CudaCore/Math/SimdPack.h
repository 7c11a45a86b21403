// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Packs of numbers as the vector extensions of GCC and Clang have them, as wide as the instructions that
// the including file is compiled for. Every width has types of its own, so that no function of one
// instruction set can be mistaken for that of another.
#pragma once

#include "Math/Pack.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__AVX__) || defined(__SSE2__)
#include <immintrin.h>
#endif

namespace schlieren
{

template <class Real, int Lanes>
struct SimdPackOf
{
  typedef Real type __attribute__((vector_size(sizeof(Real) * Lanes)));
};
template <class Real, int Lanes>
using SimdPack = typename SimdPackOf<Real, Lanes>::type;

template <class Real, int Lanes>
struct SimdTraits
{
  using Number = Real;
  using Int = SimdPack<std::int32_t, Lanes>;
  static constexpr int lanes = Lanes;
};
template <>
struct PackTraits<SimdPack<float, 4>> : SimdTraits<float, 4>
{
};
template <>
struct PackTraits<SimdPack<float, 8>> : SimdTraits<float, 8>
{
};
template <>
struct PackTraits<SimdPack<float, 16>> : SimdTraits<float, 16>
{
};
template <>
struct PackTraits<SimdPack<double, 4>> : SimdTraits<double, 4>
{
};
template <>
struct PackTraits<SimdPack<double, 8>> : SimdTraits<double, 8>
{
};

/// Whether a comparison holds in any lane.
template <class Mask>
SCHLIEREN_HD auto any(const Mask& mask) -> decltype(mask[0] != 0)
{
#if defined(__AVX512DQ__)
  if constexpr (sizeof(Mask) == 64)
  {
    return sizeof(mask[0]) == 4 ? _mm512_movepi32_mask((__m512i)mask) != 0
                                : _mm512_movepi64_mask((__m512i)mask) != 0;
  }
#endif
#if defined(__AVX__)
  if constexpr (sizeof(Mask) == 32)
  {
    return _mm256_movemask_ps((__m256)mask) != 0;
  }
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(Mask) == 16)
  {
    return _mm_movemask_ps((__m128)mask) != 0;
  }
#endif
  bool one = false;
  for (std::size_t i = 0; i < sizeof(Mask) / sizeof(mask[0]); ++i)
  {
    one |= mask[i] != 0;
  }
  return one;
}

/// Whether a comparison holds in each lane: a bit of each, that of the first is the lowest.
template <class Mask>
SCHLIEREN_HD unsigned bitsOf(const Mask& mask)
{
#if defined(__AVX512DQ__)
  if constexpr (sizeof(Mask) == 64)
  {
    return sizeof(mask[0]) == 4 ? _mm512_movepi32_mask((__m512i)mask)
                                : _mm512_movepi64_mask((__m512i)mask);
  }
#endif
#if defined(__AVX__)
  if constexpr (sizeof(Mask) == 32)
  {
    return static_cast<unsigned>(
      sizeof(mask[0]) == 4 ? _mm256_movemask_ps((__m256)mask) : _mm256_movemask_pd((__m256d)mask));
  }
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(Mask) == 16)
  {
    return static_cast<unsigned>(_mm_movemask_ps((__m128)mask));
  }
#endif
  unsigned bits = 0;
  for (std::size_t i = 0; i < sizeof(Mask) / sizeof(mask[0]); ++i)
  {
    bits |= mask[i] != 0 ? 1u << i : 0;
  }
  return bits;
}

// Of these the compiler does not see that they are single instructions.
#if defined(__AVX512F__)
SCHLIEREN_HD SimdPack<float, 16> minimum(const SimdPack<float, 16>& a, const SimdPack<float, 16>& b)
{
  return (SimdPack<float, 16>)_mm512_min_ps((__m512)a, (__m512)b);
}
SCHLIEREN_HD SimdPack<float, 16> maximum(const SimdPack<float, 16>& a, const SimdPack<float, 16>& b)
{
  return (SimdPack<float, 16>)_mm512_max_ps((__m512)a, (__m512)b);
}
#endif

namespace simd
{

/// Four numbers that lie one after the other, one such row of each of Lanes / 4 rays.
/// load<Group>: those at row + offsets[Group], [4 + Group] and so on.
template <class Real, int Lanes>
struct RowLoader;

template <class Real>
SCHLIEREN_HD SimdPack<Real, 4> load4(const Real* from)
{
  SimdPack<Real, 4> four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

template <class Real>
struct RowLoader<Real, 4>
{
  template <int Group>
  SCHLIEREN_HD static SimdPack<Real, 4> load(const Real* row, const std::int64_t* offsets)
  {
    return load4(row + offsets[Group]);
  }
};

#if defined(__AVX512F__)
template <>
struct RowLoader<float, 16>
{
  template <int Group>
  SCHLIEREN_HD static SimdPack<float, 16> load(const float* row, const std::int64_t* offsets)
  {
    __m512 all = _mm512_zextps128_ps512(_mm_loadu_ps(row + offsets[Group]));
    all = _mm512_insertf32x4(all, _mm_loadu_ps(row + offsets[4 + Group]), 1);
    all = _mm512_insertf32x4(all, _mm_loadu_ps(row + offsets[8 + Group]), 2);
    return (SimdPack<float, 16>)_mm512_insertf32x4(all, _mm_loadu_ps(row + offsets[12 + Group]), 3);
  }
};
template <>
struct RowLoader<double, 8>
{
  template <int Group>
  SCHLIEREN_HD static SimdPack<double, 8> load(const double* row, const std::int64_t* offsets)
  {
    const __m512d low = _mm512_zextpd256_pd512(_mm256_loadu_pd(row + offsets[Group]));
    return (SimdPack<double, 8>)_mm512_insertf64x4(
      low, _mm256_loadu_pd(row + offsets[4 + Group]), 1);
  }
};
#endif

#if defined(__AVX__)
template <>
struct RowLoader<float, 8>
{
  template <int Group>
  SCHLIEREN_HD static SimdPack<float, 8> load(const float* row, const std::int64_t* offsets)
  {
    const __m256 low = _mm256_zextps128_ps256(_mm_loadu_ps(row + offsets[Group]));
    return (SimdPack<float, 8>)_mm256_insertf128_ps(low, _mm_loadu_ps(row + offsets[4 + Group]), 1);
  }
};
#endif

/// The numbers Which of a and, counted on from its last one, of b. GCC has Clang's name for it since version 12.
template <std::size_t... Which, class Pack>
SCHLIEREN_HD Pack shuffle(const Pack& a, const Pack& b)
{
#if defined(__clang__) || __GNUC__ >= 12
  return __builtin_shufflevector(a, b, Which...);
#else
  using Place = std::conditional_t<sizeof(a[0]) == 4, std::int32_t, std::int64_t>;
  return __builtin_shuffle(a, b, SimdPack<Place, sizeof...(Which)>{ Place{ Which }... });
#endif
}

// In the next three, packs are blocks of four numbers; what is done is done in each block.

template <int Which, class Pack, std::size_t... E>
SCHLIEREN_HD Pack spread(const Pack& a, std::index_sequence<E...>)
{
  return shuffle<(4 * (E / 4) + Which)...>(a, a);
}
/// The number `Which` of each block, four times.
template <int Which, class Pack>
SCHLIEREN_HD Pack spread(const Pack& a)
{
  return spread<Which>(a, std::make_index_sequence<lanesOf<Pack>>{});
}

/// Takes in each block the numbers A and B of a, then C and D of b.
template <int A, int B, int C, int D, class Pack, std::size_t... E>
SCHLIEREN_HD Pack choose(const Pack& a, const Pack& b, std::index_sequence<E...>)
{
  constexpr std::size_t which[4] = { A, B, sizeof...(E) + C, sizeof...(E) + D };
  return shuffle<(4 * (E / 4) + which[E % 4])...>(a, b);
}
template <int A, int B, int C, int D, class Pack>
SCHLIEREN_HD Pack choose(const Pack& a, const Pack& b)
{
  return choose<A, B, C, D>(a, b, std::make_index_sequence<lanesOf<Pack>>{});
}

/// Transposes the 4 x 4 numbers of each block.
template <class Pack>
SCHLIEREN_HD void transpose(const Pack (&rows)[4], Pack (&columns)[4])
{
  const Pack a = choose<0, 1, 0, 1>(rows[0], rows[1]); // 00 01 10 11
  const Pack b = choose<2, 3, 2, 3>(rows[0], rows[1]);
  const Pack c = choose<0, 1, 0, 1>(rows[2], rows[3]);
  const Pack d = choose<2, 3, 2, 3>(rows[2], rows[3]);
  columns[0] = choose<0, 2, 0, 2>(a, c);
  columns[1] = choose<1, 3, 1, 3>(a, c);
  columns[2] = choose<0, 2, 0, 2>(b, d);
  columns[3] = choose<1, 3, 1, 3>(b, d);
}

} // namespace simd

} // namespace schlieren
