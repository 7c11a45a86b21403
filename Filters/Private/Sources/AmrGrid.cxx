// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/AmrGrid.h"

#include "Input/FlatData.h"
#include "Sources/SamplingGrid.h"

#include "vtkImageData.h"

#include <algorithm>

namespace filters
{

std::optional<Amr> planAmr(
  const Source& source, const int samplingDimensions[3], const SamplingBox& box)
{
  std::optional<AmrLevels> found = findLevels(source.leaves);
  if (!found)
  {
    return std::nullopt;
  }
  if (found->flat >= 0)
  {
    setDepth(*found, depthOf(source, found->flat));
  }
  Amr amr;
  amr.levels = std::move(found->levels);
  const Counts given = requireDimensions(samplingDimensions);
  const bool isGiven = std::find(given.begin(), given.end(), 0) == given.end();
  // Limits the level to those that fit into memory or that a given grid resolves.
  const auto cellsIn = [&](std::size_t level)
  {
    const AmrLevel& ofLevel = amr.levels[level];
    CellBox cells;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::array<int, 2> ends = static_cast<int>(axis) == found->flat
        ? std::array<int, 2>{ 0, ofLevel.cells[axis] }
        : box.cellsOf(axis, found->origin[axis], ofLevel.spacing[axis], ofLevel.cells[axis]);
      cells.begin[axis] = ends[0];
      cells.end[axis] = ends[1];
    }
    return cells;
  };
  const auto fits = [&](std::size_t level)
  {
    const double ofAll = static_cast<double>(volume(amr.levels[level].cells));
    const double wanted = static_cast<double>(volume(cellsIn(level).size()));
    const double most = isGiven ? 2 * static_cast<double>(volume(given)) : maxVoxels;
    return ofAll <= std::max(most, maxVoxels) && wanted <= most;
  };
  amr.used = amr.levels.size() - 1;
  while (amr.used > 0 && !fits(amr.used))
  {
    --amr.used;
  }
  amr.note = isGiven ? "as given" : "the cells of level " + std::to_string(amr.used);
  if (!isGiven && amr.used + 1 < amr.levels.size())
  {
    const Counts finest = amr.levels.back().cells;
    amr.note += " of " + std::to_string(amr.levels.size()) +
      ", coarser than the finest to bound memory (as fine as it is: Sampling Dimensions " +
      std::to_string(finest[0]) + " " + std::to_string(finest[1]) + " " +
      std::to_string(finest[2]) + ")";
  }
  amr.cells = cellsIn(amr.used);
  const Counts cells = amr.cells.size();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    amr.dimensions[axis] = given[axis] ? given[axis] : std::max(cells[axis], 2);
  }
  requireFits(amr.dimensions);
  double bounds[6];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isFlat = static_cast<int>(axis) == found->flat;
    const double cell = amr.levels[amr.used].spacing[axis];
    const double all = amr.levels[0].cells[axis] * amr.levels[0].spacing[axis];
    const bool isPart = cells[axis] < amr.levels[amr.used].cells[axis];
    const double length = isPart ? cells[axis] * cell : all;
    amr.spacing[axis] = length / (isFlat ? amr.dimensions[axis] - 1 : amr.dimensions[axis]);
    amr.origin[axis] =
      found->origin[axis] + amr.cells.begin[axis] * cell + (isFlat ? 0 : amr.spacing[axis] / 2);
    bounds[2 * axis] = found->origin[axis];
    bounds[2 * axis + 1] = found->origin[axis] + all;
  }
  box.within(bounds); // throws if empty
  return amr;
}

void gridOf(const Amr& amr, vtkImageData* structure)
{
  structure->Initialize();
  structure->SetDimensions(amr.dimensions.data());
  structure->SetOrigin(amr.origin.data());
  structure->SetSpacing(amr.spacing.data());
}

} // namespace filters
