// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/BrickRays.h"

#include "Device/Parallel.h"
#include "Medium/Tree/Brick.h"
#include "Medium/Tree/StraightRays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace schlieren
{

namespace
{

constexpr int latticeEdge = 48;

/// The largest errors of leaves may add up along a ray, by their squares, to so much of what is allowed.
constexpr double maxOfSums = 2;

constexpr int brickEdge = BrickMaker<float>::edge;

/// What a leaf with one value for all may add to a ray's deflection and to its optical path, at most.
struct Neglected
{
  std::int32_t leaf;
  float deflection, opticalPath;
};

/// The error of a leaf with samples, of a ray's deflection: errors of any sign add up by their squares.
struct Wrong
{
  std::int32_t leaf;
  double square; ///< of the faintest media less than the least float
};

struct Bend
{
  double deflection = 0;
  double opticalPath = 0; // nu times data units
  double error = 0;       // sum of squares
  bool isBlocked = false;
  std::vector<Neglected> neglected;
  std::vector<Wrong> wrong;
};

/// What a straight ray crosses of a leaf with samples.
struct LeafSegment
{
  std::array<double, 3> local, along; ///< from where, local coordinates; and these by data unit
  double pathLength;                  ///< data units
  double perIndex;                    ///< of the leaf
  std::int32_t steps, brick;
  std::int32_t map; ///< -1: it has none
};

/// What the samples along it add up to.
struct LeafSums
{
  Vec3<double> gradient{ 0, 0, 0 }; ///< nu by index times data units
  double opticalPath = 0;           ///< nu times data units
  bool isBlocked = false;
};

/// Reads the nearest sample.
std::int16_t gasDistanceAt(
  const BrickLayout& layout, const std::int16_t* distances, const double (&local)[3])
{
  const int stride = 16 + 2 * layout.apron;
  std::int64_t at = 0;
  for (int axis = layout.axes() - 1; axis >= 0; --axis)
  {
    const int i = static_cast<int>(std::lround(std::clamp(local[axis], 0., 15.)));
    at = at * stride + i + layout.apron;
  }
  return distances[at];
}

template <class Scheme, class Real>
LeafSums sumUp(const LeavesView<Real>& medium, const LeafSegment& segment)
{
  const BrickLayout& layout = medium.layout;
  LeafSums sums;
  const double step = segment.pathLength / segment.steps;
  const Real* brick = medium.samples + segment.brick * layout.samplesPerBrick;
  for (int n = 0; n < segment.steps; ++n)
  {
    const double middle = (n + 0.5) * step;
    const double place[3] = { segment.local[0] + middle * segment.along[0],
      segment.local[1] + middle * segment.along[1], segment.local[2] + middle * segment.along[2] };
    if (segment.map >= 0)
    {
      const std::int16_t distance =
        gasDistanceAt(layout, medium.gasDistances + segment.map * layout.samplesPerBrick, place);
      if (distance < 0)
      {
        sums.isBlocked = sums.isBlocked || (distance & 1) == 0;
        continue;
      }
    }
    const Vec3<Real> here{ static_cast<Real>(place[0]), static_cast<Real>(place[1]),
      static_cast<Real>(place[2]) };
    const Sample<Real> sample = interpolateBrick<Scheme>(brick, layout.apron, layout.shape, here);
    sums.opticalPath += static_cast<double>(sample.value) * step;
    sums.gradient += step * (segment.perIndex * static_cast<Vec3<double>>(sample.gradient));
  }
  return sums;
}

template <class Scheme, class Real>
Bend trace(const LeavesView<Real>& medium, const Column& column, const StraightRay& ray)
{
  Vec3<double> gradient{ 0, 0, 0 }; // summed up, nu by index times data units
  Bend bend;
  const auto& spacing = medium.grid.spacing;
  double s = ray.entry;
  const auto at = [&](double where, int axis)
  { return ray.start[axis] + where * ray.direction[axis]; };
  while (s < ray.exit && !bend.isBlocked)
  {
    const std::int32_t found = medium.finder.at({ at(s, 0), at(s, 1), at(s, 2) });
    const Leaf<Real>& leaf = medium.leaves[found];
    std::array<double, 3> local, along;
    double pathLength = ray.exit - s, fastest = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      local[axis] = (at(s, axis) - leaf.first[axis]) * leaf.perIndex;
      along[axis] = ray.direction[axis] * leaf.perIndex; // samples by data unit
      if (axis == medium.layout.axes())
      {
        continue;
      }
      fastest = std::max(fastest, std::abs(along[axis]));
      if (along[axis] != 0)
      {
        const double side = along[axis] > 0 ? 15.5 : -0.5;
        pathLength = std::min(pathLength, std::max(0., (side - local[axis]) / along[axis]));
      }
    }
    // Into the next leaf, whatever rounding does.
    const double beyond =
      fastest > 0 ? std::max(1e-4 / fastest, 1e-12 * std::abs(ray.exit)) : ray.exit - s;
    if (leaf.kind == Leaf<Real>::Solid)
    {
      bend.isBlocked = true;
      break;
    }
    bend.opticalPath += static_cast<double>(leaf.offset) * pathLength;
    const auto difference = static_cast<double>(medium.differences[found]);
    const auto edgeOf = [&](double voxel) { return voxel * brickEdge / leaf.perIndex; };
    const auto [shortest, longest] =
      std::minmax_element(spacing.begin(), spacing.begin() + medium.layout.axes());
    const auto squared = [](double x) { return x * x; };
    const double ofLines = std::min(1., pathLength / edgeOf(*longest));
    const double error = ofLines * static_cast<double>(medium.errors[found]);
    bend.error += squared(ofLines * static_cast<double>(medium.typical[found]));
    if (error > 0)
    {
      bend.wrong.push_back({ found, squared(error) });
    }
    if (difference > 0 && pathLength > 0)
    {
      // A slope that makes this difference over the leaf's smallest edge; the value is in the middle.
      const double edge = edgeOf(*shortest);
      bend.neglected.push_back({ found, static_cast<float>(difference * pathLength / edge),
        static_cast<float>(0.5 * difference * pathLength) });
      bend.error += squared(difference * pathLength / edge);
    }
    if (leaf.kind != Leaf<Real>::Constant && pathLength > 0)
    {
      const LeafSums ofLeaf = sumUp<Scheme>(medium,
        LeafSegment{ local, along, pathLength, leaf.perIndex,
          std::max(1, static_cast<int>(std::ceil(pathLength * fastest))), leaf.brick,
          leaf.kind == Leaf<Real>::Mixed ? leaf.map : -1 });
      bend.opticalPath += ofLeaf.opticalPath;
      gradient += ofLeaf.gradient;
      bend.isBlocked = ofLeaf.isBlocked;
    }
    s += pathLength + beyond;
  }
  const Vec3<double> sum{ gradient.x / spacing[0], gradient.y / spacing[1],
    gradient.z / spacing[2] };
  bend.deflection = std::hypot(dot(sum, column.u), dot(sum, column.v));
  return bend;
}

/// Adds, of errors along a ray that exceed what is allowed, the leaves of the largest until what is left is half of it.
template <auto part, class Error>
void addLargest(std::vector<Error> errors, double allowed, std::vector<std::int32_t>& leaves)
{
  double sum = 0;
  for (const Error& one : errors)
  {
    sum += static_cast<double>(one.*part);
  }
  if (!(sum > allowed))
  {
    return;
  }
  std::sort(
    errors.begin(), errors.end(), [](const Error& a, const Error& b) { return a.*part > b.*part; });
  for (const Error& one : errors)
  {
    if (!(sum > 0.5 * allowed))
    {
      break;
    }
    leaves.push_back(one.leaf);
    sum -= static_cast<double>(one.*part);
  }
}

/// What 99 % of all rays keep whose errors have a normal distribution, each with a standard deviation of its own.
double keptByMost(const std::vector<double>& deviations)
{
  constexpr double others = 0.01;
  if (deviations.empty())
  {
    return 0;
  }
  const auto exceeding = [&](double error)
  {
    double sum = 0;
    for (const double deviation : deviations)
    {
      sum += deviation > 0 ? std::erfc(error / (std::sqrt(2.) * deviation)) : 0;
    }
    return sum / static_cast<double>(deviations.size());
  };
  double low = 0, high = 4 * *std::max_element(deviations.begin(), deviations.end());
  for (int n = 0; n < 40; ++n)
  {
    const double middle = 0.5 * (low + high);
    (exceeding(middle) > others ? low : high) = middle;
  }
  return high;
}

/// What 99 % do not exceed, but no less than a tenth of the most: where a view of a far field shows hardly any flow, its
/// noise is not to be resolved.
double fullScaleOf(std::vector<double> values, double most)
{
  constexpr double fraction = 0.99, leastPart = 0.1;
  if (values.empty())
  {
    return most;
  }
  const auto rank = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  const double percentile = values[static_cast<std::size_t>(rank)];
  return percentile > 0 ? std::max(percentile, leastPart * most) : most;
}

} // namespace

template <class Real>
RayFindings lookAlongRays(const LeavesView<Real>& medium, const Column& column,
  const std::vector<Vec3<double>>& places, double tolerance, const RayFindings& least, int threads)
{
  const Grid& grid = medium.grid;
  double low[2], high[2];
  for (int side = 0; side < 2; ++side)
  {
    const ImageRange ofBox = rangeOfBox(grid, column, side);
    low[side] = std::max(ofBox.low, column.middle[side] - column.halfWidth[side]);
    high[side] = std::min(ofBox.high, column.middle[side] + column.halfWidth[side]);
    if (!(low[side] < high[side]))
    {
      return least;
    }
  }
  constexpr int ofLattice = latticeEdge * latticeEdge;
  const std::int64_t rays = ofLattice + static_cast<std::int64_t>(places.size());
  std::vector<Bend> bends(static_cast<std::size_t>(rays));
  const auto rayOf = [&](std::int64_t n) -> std::optional<StraightRay>
  {
    if (n < ofLattice)
    {
      return rayAt(grid, column,
        low[0] + (high[0] - low[0]) * (static_cast<double>(n % latticeEdge) + 0.5) / latticeEdge,
        low[1] + (high[1] - low[1]) * (static_cast<double>(n / latticeEdge) + 0.5) / latticeEdge);
    }
    const Vec3<double>& index = places[static_cast<std::size_t>(n - ofLattice)];
    const Vec3<double> x{ grid.origin[0] + index.x * grid.spacing[0],
      grid.origin[1] + index.y * grid.spacing[1], grid.origin[2] + index.z * grid.spacing[2] };
    const double width = column.widthAt(dot(x, cross(column.u, column.v)));
    const double u = imageCoordinate(column, 0, dot(x, column.u), width);
    const double v = imageCoordinate(column, 1, dot(x, column.v), width);
    const bool isIn = width > 0 && u >= low[0] && u <= high[0] && v >= low[1] && v <= high[1];
    return isIn ? std::optional(rayAt(grid, column, u, v)) : std::nullopt;
  };
  visitScheme(medium.layout.interpolation,
    [&](auto scheme)
    {
      parallelFor(rays, 16, threads,
        [&](std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t n = begin; n < end; ++n)
          {
            if (const std::optional<StraightRay> ray = rayOf(n))
            {
              bends[static_cast<std::size_t>(n)] = trace<decltype(scheme)>(medium, column, *ray);
            }
          }
        });
    });
  const bool areAllBlocked =
    std::all_of(bends.begin(), bends.end(), [](const Bend& bend) { return bend.isBlocked; });
  RayFindings findings;
  findings.deflection = least.deflection;
  findings.opticalPath = least.opticalPath;
  std::vector<double> deflections, deviations;
  for (std::size_t n = 0; n < bends.size(); ++n)
  {
    const Bend& bend = bends[n];
    if (bend.isBlocked == areAllBlocked)
    {
      findings.deflection = std::max(findings.deflection, bend.deflection);
      findings.opticalPath = std::max(findings.opticalPath, std::abs(bend.opticalPath));
      if (n < ofLattice)
      {
        deflections.push_back(bend.deflection);
        deviations.push_back(std::sqrt(bend.error));
      }
    }
  }
  findings.error = keptByMost(deviations);
  findings.strong =
    std::max(least.strong, fullScaleOf(std::move(deflections), findings.deflection));
  findings.strong =
    column.fullScale > 0 ? std::min(findings.strong, column.fullScale) : findings.strong;
  for (const Bend& bend : bends)
  {
    if (bend.isBlocked == areAllBlocked)
    {
      const double allowed = tolerance * findings.strong;
      addLargest<&Neglected::deflection>(bend.neglected, allowed, findings.coarse);
      addLargest<&Neglected::opticalPath>(
        bend.neglected, tolerance * findings.opticalPath, findings.coarse);
      addLargest<&Wrong::square>(
        bend.wrong, maxOfSums * allowed * maxOfSums * allowed, findings.wrong);
    }
  }
  for (auto* leaves : { &findings.coarse, &findings.wrong })
  {
    std::sort(leaves->begin(), leaves->end());
    leaves->erase(std::unique(leaves->begin(), leaves->end()), leaves->end());
  }
  return findings;
}

template RayFindings lookAlongRays(const LeavesView<float>&, const Column&,
  const std::vector<Vec3<double>>&, double, const RayFindings&, int);
template RayFindings lookAlongRays(const LeavesView<double>&, const Column&,
  const std::vector<Vec3<double>>&, double, const RayFindings&, int);

} // namespace schlieren
