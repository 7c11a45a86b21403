// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/RootCells.h"

#include "Medium/Samples/Field.h"
#include "Medium/Tree/Brick.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace schlieren
{

namespace
{

/// Root cells along the longest axis. More where the data are that much longer than wide.
constexpr double fewestRoots = 4;
constexpr double maxRoots = 16;

/// Limits cells and levels to what numbers of 32 bits can count.
constexpr int mostCoarserLevels = 13;

} // namespace

Division divisionOf(const MediumSource& source)
{
  const Box box = source.bounds();
  const std::array<double, 3> voxelShape = source.voxelShape();
  std::array<double, 3> length{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double edge = box.high[axis] - box.low[axis];
    if (!(edge > 0) || !std::isfinite(edge))
    {
      throw Error("The data have no extent along their " + std::string(1, "xyz"[axis]) +
        " axis, or none that is finite, so there is no depth for light to cross and no gradient to "
        "bend it. Check the points' coordinates (for 2-D data: extrude it).");
    }
    length[axis] =
      voxelShape[axis] > 0 && std::isfinite(voxelShape[axis]) ? edge / voxelShape[axis] : edge;
  }
  if (source.isFlat())
  {
    length[2] = std::min(length[0], length[1]);
  }
  std::array<double, 3> sorted = length;
  std::sort(sorted.begin(), sorted.end());
  const auto [shortest, middle, longest] = sorted;
  Division division{};
  while (division.coarserLevels < mostCoarserLevels &&
    longest > std::ldexp(maxRoots, division.coarserLevels) * middle)
  {
    ++division.coarserLevels;
  }
  const double most = std::clamp(
    std::round(longest / shortest), fewestRoots, std::ldexp(maxRoots, division.coarserLevels));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    division.cells[axis] = std::max<std::int32_t>(
      1, static_cast<std::int32_t>(std::lround(most * length[axis] / longest)));
  }
  division.cells[2] = source.isFlat() ? 1 : division.cells[2];
  return division;
}

std::array<std::int32_t, 3> rootCellsOf(const Division& division)
{
  std::array<std::int32_t, 3> roots{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    roots[axis] = ((division.cells[axis] - 1) >> division.coarserLevels) + 1;
  }
  return roots;
}

Grid gridOf(const MediumSource& source)
{
  constexpr std::int64_t brickEdge = BrickMaker<float>::edge;
  const Box box = source.bounds();
  const std::array<std::int32_t, 3> cells = divisionOf(source).cells;
  Grid grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t voxels = axis == 2 && source.isFlat() ? 1 : brickEdge * cells[axis];
    grid.dimensions[axis] = voxels + 1;
    grid.spacing[axis] = (box.high[axis] - box.low[axis]) / static_cast<double>(voxels);
    grid.origin[axis] = box.low[axis];
  }
  validate(grid);
  return grid;
}

Grid coarsestGrid(const MediumSource& source)
{
  Grid grid = gridOf(source);
  const std::array<double, 3> origin = grid.origin;
  grid.direction = source.direction();
  for (std::size_t row = 0; row < 3; ++row)
  {
    const double* toData = grid.direction.data() + 3 * row;
    grid.origin[row] = toData[0] * origin[0] + toData[1] * origin[1] + toData[2] * origin[2];
  }
  return grid;
}

} // namespace schlieren
