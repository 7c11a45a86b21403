// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The medium of an image: its samples as nu, solids among them, coefficients of a spline.
#include "Medium/ImageBounds.h"
#include "Medium/Medium.h"

#include "Device/Parallel.h"
#include "Medium/Samples/Ambient.h"
#include "Medium/Samples/Solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

template <class Value>
struct Samples
{
  const Value* values;
  const unsigned char* valid;

  static bool maySayGas(unsigned char mark) { return mark != 0 && mark != transparent; }
  bool isGas(std::int64_t at) const
  {
    return (valid == nullptr || maySayGas(valid[at])) && std::isfinite(values[at]);
  }
  bool isSolid(std::int64_t at) const
  {
    return !isGas(at) && (valid == nullptr || valid[at] != transparent);
  }
};

/// Returns N at the gas on the grid's faces; where all of that is solid, of all gas. Faces across an axis of two points, as
/// of an extruded plane, have all points: they do not count.
template <class Value>
std::vector<WeightedValue> outerValues(
  const Samples<Value>& samples, const std::array<std::int64_t, 3>& n)
{
  std::vector<WeightedValue> values;
  const auto add = [&](std::int64_t at)
  {
    if (samples.isGas(at))
    {
      values.push_back({ static_cast<double>(samples.values[at]), 1 });
    }
  };
  const auto isOuter = [&](std::size_t axis, std::int64_t i)
  { return n[axis] > 2 && (i == 0 || i == n[axis] - 1); };
  const auto everyOf = [](std::int64_t points)
  { return static_cast<std::int64_t>(std::ceil(static_cast<double>(points) / mostOuterValues)); };
  const std::int64_t all = n[0] * n[1] * n[2];
  const std::int64_t ofFaces = 2 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]);
  std::int64_t every = everyOf(ofFaces);
  for (std::int64_t k = 0; k < n[2]; ++k)
  {
    for (std::int64_t j = 0; j < n[1]; ++j)
    {
      const bool isWhole = isOuter(1, j) || isOuter(2, k);
      for (std::int64_t i = 0; i < n[0]; i += isWhole ? 1 : n[0] - 1)
      {
        if ((isWhole || isOuter(0, i)) && (i + j + k) % every == 0)
        {
          add((k * n[1] + j) * n[0] + i);
        }
      }
    }
  }
  if (values.empty())
  {
    every *= ((all + ofFaces - 1) / ofFaces) | 1; // as many values, of all columns
    for (std::int64_t at = 0; at < all; at += every)
    {
      add(at);
    }
  }
  return values;
}

struct Range
{
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  std::int64_t gas = 0;
};

/// Copies a row of samples as nu, 0 where there is no gas; returns the number of points that are gas. `zero`: the
/// sample of the ambient gas.
/// Loads a row without branches and with one range per place in it, so that it vectorises.
template <class Real, class Value, class IsValid>
int loadRow(const Value* values, const IsValid& isValid, std::int64_t count, double zero,
  double scale, Real* nu, Value* lowest, Value* highest)
{
  constexpr Value infinite = std::numeric_limits<Value>::infinity();
  int gas = 0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const Value n = values[i];
    const bool isGas = (std::abs(n) < infinite) & isValid(i);
    const Real shifted = static_cast<Real>((static_cast<double>(n) - zero) * scale);
    nu[i] = isGas ? shifted : Real(0);
    const Value low = isGas ? n : infinite;
    const Value high = isGas ? n : -infinite;
    lowest[i] = low < lowest[i] ? low : lowest[i];
    highest[i] = high > highest[i] ? high : highest[i];
    gas += isGas ? 1 : 0;
  }
  return gas;
}

/// Copies the samples, which hold N less `offset`, into the padded volume as nu, 0 where there is no gas, and finds
/// the range of N.
template <class Real, class Value>
Range load(const Samples<Value>& samples, double offset, double ambient, PaddedVolume<Real>& volume,
  int threads)
{
  const auto [nx, ny, nz] = volume.dimensions;
  const double zero = ambient - offset;
  const double scale = 1 / (1 + ambient);
  std::vector<Range> planes(static_cast<std::size_t>(nz));
  parallelFor(nz, 1, threads,
    [&, nx = nx, ny = ny](std::int64_t begin, std::int64_t end)
    {
      const auto width = static_cast<std::size_t>(nx);
      constexpr Value none = std::numeric_limits<Value>::infinity();
      std::vector<Value> lowest(width, none), highest(width, -none);
      for (std::int64_t k = begin; k < end; ++k)
      {
        Range& range = planes[static_cast<std::size_t>(k)];
        for (std::int64_t j = 0; j < ny; ++j)
        {
          const std::int64_t row = (k * ny + j) * nx;
          const auto loadWith = [&, nx](const auto& isValid)
          {
            return loadRow(samples.values + row, isValid, nx, zero, scale, &volume.at(0, j, k),
              lowest.data(), highest.data());
          };
          const unsigned char* valid = samples.valid;
          range.gas += valid == nullptr ? loadWith([](std::int64_t) { return true; })
                                        : loadWith([valid = valid + row](std::int64_t i)
                                            { return Samples<Value>::maySayGas(valid[i]); });
        }
        range.lowest =
          offset + static_cast<double>(*std::min_element(lowest.begin(), lowest.end()));
        range.highest =
          offset + static_cast<double>(*std::max_element(highest.begin(), highest.end()));
      }
    });
  Range total;
  for (const Range& plane : planes)
  {
    total.lowest = std::min(total.lowest, plane.lowest);
    total.highest = std::max(total.highest, plane.highest);
    total.gas += plane.gas;
  }
  return total;
}

/// The points for which is(index) holds.
template <class Predicate>
PointMask findPoints(
  const std::array<std::int64_t, 3>& dimensions, int threads, const Predicate& is)
{
  PointMask found(dimensions);
  parallelFor(dimensions[2], 1, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t k = begin; k < end; ++k)
      {
        for (std::int64_t j = 0; j < dimensions[1]; ++j)
        {
          const std::int64_t first = (k * dimensions[1] + j) * dimensions[0];
          for (std::int64_t n = 0; n < found.wordsPerRow; ++n)
          {
            const std::int64_t points = std::min<std::int64_t>(64, dimensions[0] - 64 * n);
            std::uint64_t others = 0;
            for (std::int64_t i = 0; i < points; ++i)
            {
              others |= std::uint64_t{ !is(first + 64 * n + i) } << i;
            }
            found.row(j, k)[n] = ~others;
          }
        }
      }
    });
  return found;
}

/// Marks the solids and gives them, and what is transparent, values from the gas around.
template <class Real, class Value>
void setSolids(const Samples<Value>& samples, Medium<Real>& medium, int threads)
{
  const std::array<std::int64_t, 3>& dimensions = medium.volume.dimensions;
  {
    const PointMask solid =
      findPoints(dimensions, threads, [&](std::int64_t at) { return samples.isSolid(at); });
    if (solid.any())
    {
      medium.solid = bitsPerSample(medium.volume, solid);
    }
  }
  fillEmpty(medium.volume,
    findPoints(dimensions, threads, [&](std::int64_t at) { return !samples.isGas(at); }), threads);
}

/// Sets to zero what is too small to matter beside `largest` |nu|. The tails of a spline's coefficients
/// fall by 5.8 (quadratic) or 3.7 a point and soon reach denormal numbers, on which a CPU is a hundred
/// times slower.
template <class Real>
void cutTails(PaddedVolume<Real>& volume, double largest, int threads)
{
  constexpr double negligible = 1e-20;
  const Real smallest = static_cast<Real>(negligible * largest);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  parallelFor(static_cast<std::int64_t>(volume.samples.size()), grain, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        Real& sample = volume.samples[static_cast<std::size_t>(i)];
        sample = std::abs(sample) < smallest ? 0 : sample;
      }
    });
}

template <class Real, class Value>
Medium<Real> build(
  const Field& field, const Value* values, Interpolation interpolation, int threads)
{
  const Samples<Value> samples{ values, field.valid };
  // Before there is a volume: it takes memory, too.
  const auto found = [&]
  {
    std::vector<WeightedValue> outer = outerValues(samples, field.grid.dimensions);
    return field.offset + (outer.empty() ? 0 : ambientOf(std::move(outer)));
  };
  const double ambient = field.ambient ? *field.ambient : found();
  Medium<Real> medium{ PaddedVolume<Real>(field.grid.dimensions), {}, nullptr };
  medium.ambient = ambient;
  const Range range = load(samples, field.offset, ambient, medium.volume, threads);
  validateRange(range.lowest, range.highest);
  medium.largestN = std::max(std::abs(range.lowest), std::abs(range.highest));
  medium.rangeOfNu = (range.highest - range.lowest) / (1 + ambient);
  if (range.gas < field.grid.dimensions[0] * field.grid.dimensions[1] * field.grid.dimensions[2])
  {
    setSolids(samples, medium, threads);
  }
  const bool isCubic = interpolation == Interpolation::Cubic;
  isCubic ? prefilterCubic(medium.volume, threads) : prefilterQuadratic(medium.volume, threads);
  fillGhosts(medium.volume, isCubic ? 3 : 2); // as it continues in the prefilter
  cutTails(medium.volume, std::max(range.highest - ambient, ambient - range.lowest) / (1 + ambient),
    threads);
  findBounds(medium, threads);
  return medium;
}

} // namespace

template <class Real>
Medium<Real> buildMedium(const Field& field, Interpolation interpolation, int threads)
{
  validate(field.grid);
  if (field.ambient)
  {
    validateAmbient(*field.ambient);
  }
  if ((field.singles == nullptr) == (field.doubles == nullptr))
  {
    throw Error("A field needs either float or double samples.");
  }
  return field.singles != nullptr ? build<Real>(field, field.singles, interpolation, threads)
                                  : build<Real>(field, field.doubles, interpolation, threads);
}

template Medium<float> buildMedium(const Field&, Interpolation, int);
template Medium<double> buildMedium(const Field&, Interpolation, int);

} // namespace schlieren
