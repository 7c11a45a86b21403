// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/ImageSpline.h"

#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points along each edge of the blocks whose ranges are stored.
constexpr int blockEdge = 8;

/// The weights of a quadratic B-spline (Unser, Aldroubi & Eden 1993), and its first coefficient.
struct Taps
{
  int first;
  double weights[3];

  explicit Taps(double place, int points)
  {
    const int nearest = std::clamp(static_cast<int>(std::lround(place)), 0, points - 1);
    const double t = place - nearest;
    this->first = nearest - 1;
    this->weights[0] = 0.5 * (0.5 - t) * (0.5 - t);
    this->weights[1] = 0.75 - t * t;
    this->weights[2] = 0.5 * (0.5 + t) * (0.5 + t);
  }
};

} // namespace

Counts ImageSpline::blockOf(const Counts& point) const
{
  Counts block;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    block[axis] = (this->First[axis] + point[axis]) / blockEdge;
  }
  return block;
}

ImageSpline::ImageSpline(const schlieren::Field& field, const std::vector<unsigned char>& isKnown,
  const Counts& points, const Counts& first, int threads)
  : Offset(0)
  , Coefficients({ points[0], points[1], points[2] })
  , First{ first[0] % blockEdge, first[1] % blockEdge, first[2] % blockEdge }
  , Blocks(this->blockOf({ points[0] - 1, points[1] - 1, points[2] - 1 }))
{
  for (int& blocks : this->Blocks)
  {
    ++blocks;
  }
  this->Ranges.resize(volume(this->Blocks), Range{ infinity, -infinity });
  schlieren::PointMask unknown({ points[0], points[1], points[2] });
  Range all{ infinity, -infinity };
  std::size_t at = 0;
  const CellBox blocks{ { 0, 0, 0 }, this->Blocks };
  forCells({ 0, 0, 0 }, points,
    [&](int i, int j, int k)
    {
      if (isKnown[at])
      {
        unknown.row(j, k)[i / 64] &= ~(std::uint64_t{ 1 } << (i % 64));
        const Counts block = this->blockOf({ i, j, k });
        Range& range = this->Ranges[blocks.index(block[0], block[1], block[2])];
        const double value = valueAt(field, at);
        range = { std::min(range.lowest, value), std::max(range.highest, value) };
        all = { std::min(all.lowest, value), std::max(all.highest, value) };
      }
      ++at;
    });
  this->Offset = all.lowest <= all.highest ? 0.5 * (all.lowest + all.highest) : 0;
  at = 0;
  forCells({ 0, 0, 0 }, points,
    [&](int i, int j, int k)
    {
      this->Coefficients.at(i, j, k) =
        isKnown[at] ? static_cast<float>(valueAt(field, at) - this->Offset) : 0.f;
      ++at;
    });
  if (unknown.any())
  {
    schlieren::fillEmpty(
      this->Coefficients, std::move(unknown), threads, schlieren::Continuation::Linear);
  }
  schlieren::prefilterQuadratic(this->Coefficients, threads);
  schlieren::fillGhosts(this->Coefficients, 2);
}

void ImageSpline::sample(const std::array<std::vector<double>, 3>& places, double* values) const
{
  std::array<std::vector<Taps>, 3> taps;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double place : places[axis])
    {
      taps[axis].emplace_back(place, static_cast<int>(this->Coefficients.dimensions[axis]));
    }
  }
  // Interpolates along y and z first, row by row, then along x.
  const int first = taps[0].front().first;
  std::vector<double> row(static_cast<std::size_t>(taps[0].back().first + 3 - first));
  for (const Taps& z : taps[2])
  {
    for (const Taps& y : taps[1])
    {
      std::fill(row.begin(), row.end(), 0.);
      for (int n = 0; n < 9; ++n)
      {
        const double weight = y.weights[n % 3] * z.weights[n / 3];
        const float* from = this->Coefficients.samples.data() +
          this->Coefficients.index(first, y.first + n % 3, z.first + n / 3);
        for (std::size_t i = 0; i < row.size(); ++i)
        {
          row[i] += weight * static_cast<double>(from[i]);
        }
      }
      for (const Taps& x : taps[0])
      {
        const double* of = row.data() + (x.first - first);
        *values++ =
          this->Offset + x.weights[0] * of[0] + x.weights[1] * of[1] + x.weights[2] * of[2];
      }
    }
  }
}

ImageSpline::Range ImageSpline::rangeIn(const Counts& begin, const Counts& last) const
{
  Counts first = begin, end = last;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Adds a point on each side, which affects the spline.
    first[axis] = std::max(0, begin[axis] - 1);
    end[axis] = std::min(static_cast<int>(this->Coefficients.dimensions[axis]) - 1, last[axis] + 1);
  }
  const Counts from = this->blockOf(first), to = this->blockOf(end);
  Range range{ infinity, -infinity };
  const CellBox blocks{ { 0, 0, 0 }, this->Blocks };
  forCells(from, { to[0] + 1 - from[0], to[1] + 1 - from[1], to[2] + 1 - from[2] },
    [&](int i, int j, int k)
    {
      const Range& one = this->Ranges[blocks.index(i, j, k)];
      range = { std::min(range.lowest, one.lowest), std::max(range.highest, one.highest) };
    });
  return range;
}

} // namespace filters
