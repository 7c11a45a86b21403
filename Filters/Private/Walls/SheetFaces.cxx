// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/SheetFaces.h"

#include "Common/WeightedMedian.h"
#include "Input/CoincidentPoints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace filters
{

namespace
{

constexpr double smallestJump = 1e-3; // relative to the range of values
constexpr double usualJump = 0.02;
constexpr double smallestRange = 1e-6; // relative to values: rounding

/// Returns the difference of values between a face's sides, relative to the whole range: the mean
/// over corners with two points; 0 if the values at one of them are about equal.
double jumpOf(
  const CutFaces& cuts, std::size_t face, const std::vector<double>& values, double range)
{
  double sum = 0;
  int count = 0;
  for (std::size_t corner = cuts.starts[face]; corner < cuts.starts[face + 1]; ++corner)
  {
    const Contribution* const of = &cuts.contributions[2 * corner];
    if (of[0].point == of[1].point)
    {
      continue; // the cut ends there
    }
    const double jump = std::abs(values[2 * corner] - values[2 * corner + 1]) / range;
    if (!(jump > smallestJump))
    {
      return 0;
    }
    sum += jump;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

std::vector<double> jumpsOf(const CutFaces& cuts, const std::vector<double>& values)
{
  std::vector<double> jumps(cuts.size(), 0);
  if (values.empty())
  {
    return jumps;
  }
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const double range = *highest - *lowest;
  if (range > smallestRange * std::max(std::abs(*lowest), std::abs(*highest)))
  {
    for (std::size_t face = 0; face < cuts.size(); ++face)
    {
      jumps[face] = jumpOf(cuts, face, values, range);
    }
  }
  return jumps;
}

} // namespace

std::vector<unsigned char> findSheets(const CutFaces& cuts, const std::vector<double>& values)
{
  const std::vector<double> jumps = jumpsOf(cuts, values);
  // Parts, by one of their faces.
  Classes partsOfFaces(cuts.size());
  std::vector<std::pair<std::int32_t, std::size_t>> corners; // place, face
  for (std::size_t face = 0; face < cuts.size(); ++face)
  {
    for (std::size_t i = cuts.starts[face]; jumps[face] > 0 && i < cuts.starts[face + 1]; ++i)
    {
      corners.emplace_back(cuts.places[i], face);
    }
  }
  std::sort(corners.begin(), corners.end());
  for (std::size_t i = 1; i < corners.size(); ++i)
  {
    if (corners[i].first == corners[i - 1].first)
    {
      partsOfFaces.join(corners[i].second, corners[i - 1].second);
    }
  }
  std::vector<std::vector<WeightedValue>> parts(cuts.size()); // jump, area
  for (std::size_t face = 0; face < cuts.size(); ++face)
  {
    if (jumps[face] > 0)
    {
      parts[partsOfFaces.rootOf(face)].push_back({ jumps[face], cuts.areas[face] });
    }
  }
  std::vector<unsigned char> areSheets(cuts.size(), 0);
  for (std::size_t face = 0; face < cuts.size(); ++face)
  {
    if (!parts[face].empty() && weightedMedian(std::move(parts[face])) > usualJump)
    {
      areSheets[face] = 1; // of roots
    }
  }
  for (std::size_t face = cuts.size(); face-- > 0;)
  {
    areSheets[face] = jumps[face] > 0 ? areSheets[partsOfFaces.rootOf(face)] : 0;
  }
  return areSheets;
}

} // namespace filters
