// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/RayStarts.h"

#include "Math/RandomBits.h"
#include "Math/Units.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace schlieren
{

namespace
{

double fraction(double x) { return x - std::floor(x); }

/// Numbers a pass in a sequence that is begun elsewhere for each seed.
double numberOf(std::int64_t pass, std::uint32_t seed)
{
  constexpr double passesPerSeed = 65537;
  return static_cast<double>(pass) + passesPerSeed * (static_cast<double>(seed) - 1);
}

constexpr std::uint32_t firstSeed = 1;

/// Rows of the first 64 points of a pixel, in 64ths of it. Columns are those of columnDigits. Point 4 ... 7 are at odd eighths,
/// point 8 ... 15 at odd sixteenths of both axes, and so on. A search among these orders of rows has found this one.
constexpr std::array<std::uint32_t, 64> firstRows{ 0, 16, 32, 48, 24, 40, 56, 8, 52, 60, 44, 36, 4,
  12, 20, 28, 14, 6, 58, 2, 42, 22, 34, 18, 62, 30, 10, 38, 26, 54, 50, 46, 51, 23, 47, 7, 1, 11,
  13, 57, 15, 37, 39, 25, 9, 41, 43, 45, 21, 63, 55, 17, 35, 27, 61, 3, 33, 53, 5, 49, 19, 59, 29,
  31 };
constexpr int digitsOfFirst = 6;

/// The binary digits of a point's column: those of its number, the last one first (van der Corput 1935).
std::uint32_t columnDigits(std::uint32_t number)
{
  std::uint32_t digits = 0;
  for (int n = 0; n < 32; ++n)
  {
    digits |= (number >> n & 1u) << (31 - n);
  }
  return digits;
}

/// The binary digits of a point's row. Each further 64 points have the rows of the first ones, moved by the second coordinate
/// of Sobol's sequence (1967) as a fraction of the pixel and, so that they are between the others, of a 64th of it.
std::uint32_t rowDigits(std::uint32_t number)
{
  std::uint32_t moved = 0;
  std::uint32_t column = std::uint32_t{ 1 }
    << 31; // of the generator matrix: powers of 1 + x, modulo 2
  for (std::uint32_t rest = number >> digitsOfFirst; rest != 0; rest >>= 1)
  {
    moved ^= (rest & 1u) * column;
    column ^= column >> 1;
  }
  return (firstRows[number % firstRows.size()] << (32 - digitsOfFirst)) + moved +
    (moved >> digitsOfFirst);
}

/// The binary digits of a column and a row of Hammersley's points. Their order takes the digits of the number alternately as those
/// that count most along columns and along rows.
std::array<std::uint32_t, 2> ownDigits(std::uint32_t number, std::uint32_t count)
{
  int digits = 0;
  while (count >> digits > 1)
  {
    ++digits;
  }
  std::uint32_t point = 0;
  for (int n = 0; n < digits; ++n)
  {
    point |= (number >> n & 1u) << (n % 2 == 0 ? n / 2 : digits - 1 - n / 2);
  }
  return { columnDigits(point), point << (32 - digits) };
}

} // namespace

std::array<double, 2> sourcePoint(
  const LightSource& source, double knifeEdgeAngle, std::int64_t pass, std::uint32_t seed)
{
  if (pass == 0 || source.shape == SourceShape::Point)
  {
    return { 0, 0 };
  }
  constexpr double goldenRatio = 1.61803398874989484820;
  constexpr double root2 = 1.41421356237309504880;
  const double n = numberOf(pass, seed);
  const double a = fraction(n * goldenRatio), b = fraction(n * root2);
  if (source.shape == SourceShape::Disc)
  {
    const double radius = 0.5 * source.width * std::sqrt(a);
    return { radius * std::cos(2 * pi * b), radius * std::sin(2 * pi * b) };
  }
  const double across = source.width * (fraction(a + 0.5) - 0.5);
  const double along = source.length * (fraction(b + 0.5) - 0.5);
  const double angle = knifeEdgeAngle * radiansPerDegree;
  return { across * std::cos(angle) - along * std::sin(angle),
    across * std::sin(angle) + along * std::cos(angle) };
}

std::array<double, 2> pupilPoint(std::int64_t pass, std::int64_t passes)
{
  if (pass == 0)
  {
    return { 0, 0 };
  }
  constexpr double goldenSection = 0.61803398874989484820;
  auto stride =
    std::max<std::int64_t>(1, std::llround(goldenSection * static_cast<double>(passes)));
  while (std::gcd(stride, passes) != 1)
  {
    ++stride;
  }
  const std::int64_t place = pass % passes * stride % passes;
  const double radius = std::sqrt((static_cast<double>(place) + 0.5) / static_cast<double>(passes));
  const double angle = 2 * pi * fraction(static_cast<double>(place) * goldenSection);
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

PixelOffset pixelOffset(std::int64_t pass, std::uint32_t seed, std::int64_t together)
{
  const std::uint64_t choice = seed == firstSeed ? 0 : mixed(seed);
  const auto first = static_cast<std::uint32_t>(choice & 3u);
  const auto count = static_cast<std::uint32_t>(haveOwnPoints(together) ? together : 1);
  const auto digitsOf = [&](std::uint32_t number)
  {
    std::array<std::uint32_t, 2> digits{ columnDigits(number / count), rowDigits(number / count) };
    if (count > 1)
    {
      const std::array<std::uint32_t, 2> own = ownDigits(number % count, count);
      digits[0] += own[0];
      digits[1] += own[1];
    }
    return digits;
  };
  const std::array<std::uint32_t, 2> digits = digitsOf(static_cast<std::uint32_t>(pass) ^ first),
                                     ofFirst = digitsOf(first);
  const auto coordinate = [&](std::size_t axis, bool isMirrored)
  {
    const std::uint32_t off = digits[axis] - ofFirst[axis];
    return std::ldexp(
      static_cast<double>(static_cast<std::int32_t>(isMirrored ? 0 - off : off)), -32);
  };
  const double a = coordinate(0, (choice & 4u) != 0);
  const double b = coordinate(1, (choice & 8u) != 0);
  return (choice & 16u) != 0 ? PixelOffset{ b, a } : PixelOffset{ a, b };
}

double sideOf(std::int64_t raysPerPixel)
{
  return 1 / std::sqrt(static_cast<double>(raysPerPixel));
}

} // namespace schlieren
