// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/FieldBrick.h"

#include "Medium/Samples/Solids.h"
#include "Medium/Tree/BrickErrors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace schlieren
{

namespace
{

/// Central differences are wrong by a sixth of the third difference, a voxel, and what is interpolated linearly between
/// them by another twelfth, in the mean.
constexpr double errorByThirdDifference = 1. / 4;

/// One field of the samples.
struct OneField
{
  const double* values;
  std::vector<unsigned char> isKnown; ///< empty: everywhere
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  OneField(const double* first, std::size_t points, const std::vector<unsigned char>& isGas)
    : values(first)
  {
    double defect = 0; // NaN where a value is not finite
    for (std::size_t i = 0; i < points; ++i)
    {
      defect += values[i] - values[i];
    }
    if (!isGas.empty() || defect != 0)
    {
      isKnown.resize(points);
      for (std::size_t i = 0; i < points; ++i)
      {
        isKnown[i] = (isGas.empty() || isGas[i] != 0) && std::isfinite(values[i]) ? 1 : 0;
      }
    }
    for (std::size_t i = 0; i < points; ++i)
    {
      if (isKnown.empty() || isKnown[i] != 0)
      {
        lowest = std::min(lowest, values[i]);
        highest = std::max(highest, values[i]);
      }
    }
  }

  double range() const { return std::max(0., highest - lowest); }

  /// The slope at a point, twice, by those on one side: that of a parabola through two, where they are there and known,
  /// but no more than half as steep again as to the first; 0 where that is not known.
  double twiceOnOneSide(std::size_t at, std::size_t stride, bool isAbove, std::size_t n) const
  {
    const auto beside = [&](std::size_t i) { return isAbove ? at + i * stride : at - i * stride; };
    if (isKnown[beside(1)] == 0)
    {
      return 0;
    }
    const double first = values[beside(1)] - values[at];
    const std::size_t place = at / stride % n;
    double bend = 0;
    if ((isAbove ? place + 2 < n : place >= 2) && isKnown[beside(2)] != 0)
    {
      bend = first - (values[beside(2)] - values[beside(1)]);
    }
    const double twice = 2 * first + std::clamp(bend, -std::abs(first), std::abs(first));
    return isAbove ? twice : -twice;
  }

  /// Finds the gradient's length by 1 / perAxis[...] on each axis; 0 where the field is not known.
  double gradientAt(std::size_t at, std::size_t axes, const std::array<std::size_t, 3>& strides,
    const std::array<double, 3>& perAxis) const
  {
    if (!isKnown.empty() && isKnown[at] == 0)
    {
      return 0;
    }
    double square = 0;
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      const std::size_t stride = strides[axis];
      double twice = values[at + stride] - values[at - stride];
      if (!isKnown.empty() && (isKnown[at - stride] == 0 || isKnown[at + stride] == 0))
      {
        twice = twiceOnOneSide(at, stride, isKnown[at + stride] != 0, strides[1]);
      }
      const double slope = 0.5 * twice * perAxis[axis];
      square += slope * slope;
    }
    return std::sqrt(square);
  }
};

} // namespace

double largestGathered(const MediumSource& source, const Box& box)
{
  double sum = 0;
  for (int field = 0; field < source.fields(); ++field)
  {
    const MediumSource::FieldRange range = source.rangeOfField(field, box);
    sum += deflectionByRange * std::max(0., range.highest - range.lowest);
  }
  return sum;
}

FieldBrick fieldBrickOf(const MediumSource& source, const Box& box, const FieldSamples& samples,
  const std::vector<unsigned char>& isGas, const std::array<double, 3>& cellSize, int apron,
  double unit, double negligible)
{
  FieldBrick brick;
  FieldFacts& facts = brick.facts;
  const auto n = static_cast<std::size_t>(samples.n);
  const bool isLayer = samples.shape == BrickShape::Layer;
  const std::size_t axes = isLayer ? 2 : 3;
  const std::size_t points = n * n * (isLayer ? 1 : n);
  const auto& voxel = samples.voxel;
  const int edge = samples.n - 2 * samples.margin;
  const double longest = *std::max_element(voxel.begin(), voxel.begin() + axes);
  std::vector<OneField> fields;
  for (int number = 0; number < source.fields(); ++number)
  {
    const OneField& field = fields.emplace_back(
      samples.values.data() + static_cast<std::size_t>(number) * points, points, isGas);
    facts.range += deflectionByRange * field.range();
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      if (voxel[axis] > voxelByCell * cellSize[axis])
      {
        const double largest = largestThirdDifference(field.values, field.isKnown,
          { samples.n, samples.margin - 1, edge + 2, samples.shape }, axis);
        facts.error[axis] += errorByThirdDifference * largest * edge * longest / voxel[axis];
      }
    }
    const MediumSource::FieldRange all = source.rangeOfField(number, box);
    const double missed = all.lowest > all.highest || field.lowest > field.highest
      ? 0
      : std::max(0., all.highest - field.highest) + std::max(0., field.lowest - all.lowest);
    for (std::size_t axis = 0; axis < axes && missed > missedByRange * field.range(); ++axis)
    {
      facts.hidden[axis] +=
        voxel[axis] > coarseByCell * cellSize[axis] ? deflectionByRange * missed : 0;
    }
  }
  if (facts.range <= negligible)
  {
    facts.neglected = facts.range;
    return brick;
  }
  const int stored = edge + 2 * apron;
  const int skipped = samples.margin - apron;
  const std::array<std::size_t, 3> strides{ 1, n, n * n };
  const std::array<double, 3> perAxis{ unit / voxel[0], unit / voxel[1], unit / voxel[2] };
  const int layers = isLayer ? 1 : stored;
  const int firstLayer = isLayer ? 0 : skipped;
  const auto storedPoints = static_cast<std::size_t>(stored * stored * layers);
  brick.gradients.resize(fields.size() * storedPoints);
  std::vector<double> gradients(storedPoints);
  std::vector<unsigned char> hasGas(isGas.empty() ? 0 : storedPoints);
  for (std::size_t number = 0; number < fields.size(); ++number)
  {
    std::size_t to = 0;
    for (int k = firstLayer; k < firstLayer + layers; ++k)
    {
      for (int j = skipped; j < skipped + stored; ++j)
      {
        std::size_t at = (static_cast<std::size_t>(k) * n + static_cast<std::size_t>(j)) * n +
          static_cast<std::size_t>(skipped);
        for (int i = 0; i < stored; ++i, ++at, ++to)
        {
          gradients[to] = fields[number].gradientAt(at, axes, strides, perAxis);
          if (!isGas.empty())
          {
            hasGas[to] = isGas[at];
          }
        }
      }
    }
    if (!isGas.empty())
    {
      continueValues(gradients, stored, layers, hasGas);
    }
    for (std::size_t i = 0; i < storedPoints; ++i)
    {
      // What continues as a line may become less than nothing.
      brick.gradients[i * fields.size() + number] = std::max(0.f, static_cast<float>(gradients[i]));
    }
  }
  return brick;
}

} // namespace schlieren
