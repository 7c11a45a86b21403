// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityOfAmr.h"

#include "AmrReconstruction.h"
#include "FlatData.h"
#include "RefractivityByResampling.h"
#include "RefractivityValues.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filters
{

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The values of a level, all over the domain.
struct Grid
{
  Counts cells;
  std::vector<double> values;       // NaN: solid, or nothing there
  std::vector<unsigned char> known; // whether a block says what is there

  explicit Grid(const Counts& n)
    : cells(n)
    , values(volume(n), nan)
    , known(volume(n), 0)
  {
  }

  std::size_t index(int i, int j, int k) const
  {
    return CellBox{ { 0, 0, 0 }, this->cells }.index(i, j, k);
  }

  void set(std::size_t cell, double value)
  {
    this->values[cell] = value;
    this->known[cell] = 1;
  }
};

/// Sets the mean of all cells of finer levels wherever there are any.
void averageFinerLevels(const Amr& amr, const Source& source, Grid& grid, Tally& tally)
{
  if (amr.used + 1 == amr.levels.size())
  {
    return;
  }
  std::vector<double> sums(grid.values.size(), 0.), weights(grid.values.size(), 0.);
  for (std::size_t level = amr.used + 1; level < amr.levels.size(); ++level)
  {
    const Counts ratio = ratioOf(amr.levels[level].cells, grid.cells);
    const double weight = 1 / static_cast<double>(volume(ratio));
    const BoxBins covered = coveredCells(amr.levels, level);
    for (const AmrBlock& block : amr.levels[level].blocks)
    {
      forValues(covered, block, source, tally,
        [&](int i, int j, int k, double value)
        {
          const std::size_t cell = grid.index(i / ratio[0], j / ratio[1], k / ratio[2]);
          sums[cell] += weight * value;
          weights[cell] += weight;
        });
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    if (weights[i] > 0)
    {
      grid.set(i, sums[i] / weights[i]);
    }
  }
}

/// Sets the mean of the finer cells wherever there are any; solid if one of them is.
void restrictTo(Grid& coarse, const Grid& fine)
{
  const Counts ratio = ratioOf(fine.cells, coarse.cells);
  vtkSMPTools::For(0, coarse.cells[2],
    [&](vtkIdType begin, vtkIdType end)
    {
      forCells({ 0, 0, static_cast<int>(begin) },
        { coarse.cells[0], coarse.cells[1], static_cast<int>(end - begin) },
        [&](int i, int j, int k)
        {
          double sum = 0;
          int count = 0;
          forCells({ i * ratio[0], j * ratio[1], k * ratio[2] }, ratio,
            [&](int a, int b, int c)
            {
              const std::size_t cell = fine.index(a, b, c);
              sum += fine.known[cell] ? fine.values[cell] : 0;
              count += fine.known[cell];
            });
          if (count > 0)
          {
            coarse.set(coarse.index(i, j, k), sum / count);
          }
        });
    });
}

void resampleTo(std::vector<double>& values, Counts cells, const Counts& counts)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (cells[axis] == counts[axis])
    {
      continue;
    }
    const double width = static_cast<double>(cells[axis]) / counts[axis];
    std::vector<double> middles;
    for (int i = 0; i < counts[axis]; ++i)
    {
      middles.push_back((i + 0.5) * width - 0.5);
    }
    resampleAxis(values, cells, axis, middles, std::min(width, 1.),
      [](vtkIdType rows, const auto& work) { vtkSMPTools::For(0, rows, work); });
  }
}

/// Leaves some of the cells.
void crop(Grid& grid, const CellBox& box)
{
  Grid part(box.size());
  forCells(box.begin, box.size(),
    [&](int i, int j, int k)
    { part.values[box.index(i, j, k)] = grid.values[grid.index(i, j, k)]; });
  grid = std::move(part);
}

/// The values of the level that is used, all over the domain.
Grid valuesOf(const Amr& amr, const Source& source, Tally& tally)
{
  std::vector<Grid> grids;
  for (std::size_t level = 0; level <= amr.used; ++level)
  {
    Grid& grid = grids.emplace_back(amr.levels[level].cells);
    const BoxBins covered = coveredCells(amr.levels, level);
    for (const AmrBlock& block : amr.levels[level].blocks)
    {
      forValues(covered, block, source, tally,
        [&grid](int i, int j, int k, double value) { grid.set(grid.index(i, j, k), value); });
    }
  }
  averageFinerLevels(amr, source, grids.back(), tally);
  for (std::size_t level = amr.used; level > 0; --level)
  {
    restrictTo(grids[level - 1], grids[level]);
  }
  for (std::size_t level = 1; level <= amr.used; ++level)
  {
    Grid& fine = grids[level];
    std::vector<double> coarse = std::move(grids[level - 1].values);
    resampleTo(coarse, grids[level - 1].cells, fine.cells);
    for (std::size_t i = 0; i < coarse.size(); ++i)
    {
      if (!fine.known[i])
      {
        fine.values[i] = coarse[i];
      }
    }
  }
  return std::move(grids.back());
}

} // namespace

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
  // Not a finer level than fits, or than a grid that is given can show.
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
  box.within(bounds); // throws where there is nothing
  return amr;
}

void gridOf(const Amr& amr, vtkImageData* structure)
{
  structure->Initialize();
  structure->SetDimensions(amr.dimensions.data());
  structure->SetOrigin(amr.origin.data());
  structure->SetSpacing(amr.spacing.data());
}

Tally convertAmr(const Amr& amr, const Source& source, Numbers numbers, vtkImageData* output)
{
  Tally tally;
  Grid grid = valuesOf(amr, source, tally);
  crop(grid, amr.cells);
  resampleTo(grid.values, grid.cells, amr.dimensions);
  gridOf(amr, output);
  vtkNew<vtkDoubleArray> values;
  values->SetArray(grid.values.data(), static_cast<vtkIdType>(grid.values.size()), 1);
  setArrays(output, { values }, Linear(), nullptr, numbers);
  return tally;
}

} // namespace filters
