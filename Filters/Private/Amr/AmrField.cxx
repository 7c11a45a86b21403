// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Amr/AmrField.h"

#include "Amr/AmrReconstruction.h"
#include "Walls/LatticeDistances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Number of cells around one that its reconstruction reads, plus one for points on a border.
constexpr int reach = 3;

constexpr double rounding = 1e-6;           // of positions, in cells
constexpr double atBorder = 0.5 - rounding; // distance from a cell's centre

/// Assigns positions on a face between cells to the cell behind it, regardless of rounding.
double onFaces(double cells)
{
  const double face = std::round(cells);
  return std::abs(cells - face) < rounding ? face : cells;
}

} // namespace

CellState AmrField::stateOf(std::size_t number, const Counts& cell) const
{
  CellState state = CellState::None;
  const Level& level = this->Levels[number];
  level.bins->forPartsIn({ cell, { cell[0] + 1, cell[1] + 1, cell[2] + 1 } },
    [&](std::size_t found, const CellBox&)
    {
      const Block& block = level.blocks[found];
      const std::size_t at = block.box.index(cell[0], cell[1], cell[2]);
      if (!block.isOfLevel)
      {
        const bool isThere = block.parts[at] > 0 || block.isSolid(at);
        state = isThere && state == CellState::None ? CellState::Refined : state;
      }
      else if (block.parts[at] > 0)
      {
        state = CellState::Gas;
      }
      else if (block.isSolid(at))
      {
        state = CellState::Solid;
      }
    });
  return state;
}

bool AmrField::hasGasAt(const Point& place) const
{
  for (std::size_t number = this->Levels.size(); number-- > 0;)
  {
    const Level& level = this->Levels[number];
    Counts cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double at = onFaces((place[axis] - this->Origin[axis]) / level.spacing[axis]);
      if (!this->AreMissing.empty() && (at < -rounding || at > level.cells[axis] + rounding))
      {
        return false;
      }
      cell[axis] = static_cast<int>(std::clamp(std::floor(at), 0., level.cells[axis] - 1.));
    }
    const CellState state = this->stateOf(number, cell);
    if (state == CellState::Gas || state == CellState::Solid)
    {
      return state == CellState::Gas;
    }
  }
  return false;
}

std::vector<unsigned char> AmrField::gasAt(const schlieren::Lattice& lattice) const
{
  std::vector<unsigned char> hasGas;
  forCells({ 0, 0, 0 }, lattice.points,
    [&](int i, int j, int k)
    {
      const Counts at{ i, j, k };
      Point place;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] = lattice.first[axis] + at[axis] * lattice.spacing[axis];
      }
      hasGas.push_back(this->hasGasAt(place) ? 1 : 0);
    });
  return hasGas;
}

BoundaryFaces AmrField::faces() const
{
  std::vector<AmrFaces::Level> lattices;
  for (const Level& level : this->Levels)
  {
    lattices.push_back({ level.spacing, level.cells });
  }
  AmrFaces faces(
    this->Origin, std::move(lattices),
    [&](std::size_t level, const Counts& cell) { return this->stateOf(level, cell); },
    this->FlatAxis >= 0 ? Extent::Layer : Extent::Volume);
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    for (const Block& block : this->Levels[level].blocks)
    {
      if (!block.isOfLevel || block.solids.empty())
      {
        continue;
      }
      forCells(block.box.begin, block.box.size(),
        [&](int i, int j, int k)
        {
          if (block.isSolid(block.box.index(i, j, k)))
          {
            faces.addAround(level, { i, j, k }, true);
          }
        });
    }
  }
  if (!this->AreMissing.empty())
  {
    std::size_t cell = 0;
    forCells({ 0, 0, 0 }, this->Levels[0].cells,
      [&](int i, int j, int k)
      {
        if (this->AreMissing[cell++])
        {
          faces.addAround(0, { i, j, k }, false);
        }
      });
    faces.addDomain();
  }
  return faces.take();
}

/// Returns n if each nth cell at the border of the domain is sampled.
int AmrField::outerCellsForOne() const
{
  double cells = 0;
  for (const Level& level : this->Levels)
  {
    for (const AmrBlock& block : level.all)
    {
      const CellBox box = boxOf(block);
      for (std::size_t axis = 0; axis < this->axes(); ++axis)
      {
        const int sides =
          (box.begin[axis] == 0 ? 1 : 0) + (box.end[axis] == level.cells[axis] ? 1 : 0);
        cells += sides * static_cast<double>(volume(box.size())) / box.size()[axis];
      }
    }
  }
  return static_cast<int>(std::max(1., std::ceil(cells / schlieren::mostOuterValues)));
}

std::vector<schlieren::WeightedValue> AmrField::outerValues() const
{
  const int every = this->outerCellsForOne();
  std::vector<schlieren::WeightedValue> values;
  for (const Level& level : this->Levels)
  {
    for (const Block& block : level.blocks)
    {
      std::size_t cell = 0;
      const auto look = [&](int i, int j, int k)
      {
        const Counts at = { i, j, k };
        double outer = 0;
        for (std::size_t axis = 0; axis < this->axes(); ++axis)
        {
          const int sides = (at[axis] == 0 ? 1 : 0) + (at[axis] == level.cells[axis] - 1 ? 1 : 0);
          outer += sides * level.spacing[(axis + 1) % 3] * level.spacing[(axis + 2) % 3];
        }
        if (outer > 0 && (i + j + k) % every == 0 && block.parts[cell] > 0)
        {
          values.push_back({ block.means[cell], outer });
        }
        ++cell;
      };
      if (block.isOfLevel)
      {
        forCells(block.box.begin, block.box.size(), look);
      }
    }
  }
  return values;
}

/// Returns the cells of a level that meet a box, and `margin` cells around them.
CellBox AmrField::cellsIn(const Level& level, const schlieren::Box& box, int margin) const
{
  CellBox cells{ { 0, 0, 0 }, { 0, 0, 1 } };
  for (std::size_t axis = 0; axis < this->axes(); ++axis)
  {
    const auto clamped = [&](double at)
    {
      const double cell = std::floor((at - this->Origin[axis]) / level.spacing[axis]);
      return static_cast<int>(std::clamp(cell, -1., level.cells[axis] + 0.));
    };
    cells.begin[axis] = clamped(box.low[axis]) - margin;
    cells.end[axis] = clamped(box.high[axis]) + margin + 1;
  }
  return cells;
}

/// Returns N of a level's cells in a box; NaN in solids and outside of the domain.
std::vector<double> AmrField::valuesIn(std::size_t number, const CellBox& box) const
{
  const Level& level = this->Levels[number];
  std::vector<double> sums(volume(box.size()), 0.);
  std::vector<float> parts(sums.size(), 0.f);
  std::vector<bool> solids(sums.size(), false);
  level.bins->forPartsIn(box,
    [&](std::size_t block, const CellBox& cells)
    {
      const Block& from = level.blocks[block];
      forCells(cells.begin, cells.size(),
        [&](int i, int j, int k)
        {
          const std::size_t cell = from.box.index(i, j, k);
          const std::size_t to = box.index(i, j, k);
          sums[to] +=
            from.parts[cell] > 0 ? static_cast<double>(from.parts[cell]) * from.means[cell] : 0;
          parts[to] += from.parts[cell];
          solids[to] = solids[to] || from.isSolid(cell);
        });
    });
  const CellBox inside = intersection(box, { { 0, 0, 0 }, level.cells });
  CellBox missing{ box.end, box.begin }; // bounds of the cells that no block has
  forCells(inside.begin, inside.size(),
    [&](int i, int j, int k)
    {
      const std::size_t cell = box.index(i, j, k);
      if (!(parts[cell] > 0) && !solids[cell])
      {
        const Counts at = { i, j, k };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          missing.begin[axis] = std::min(missing.begin[axis], at[axis]);
          missing.end[axis] = std::max(missing.end[axis], at[axis] + 1);
        }
      }
    });
  for (std::size_t cell = 0; cell < sums.size(); ++cell)
  {
    sums[cell] = parts[cell] > 0 ? sums[cell] / static_cast<double>(parts[cell]) : nan;
  }
  if (missing.isEmpty() || number == 0)
  {
    return sums;
  }
  const Counts ratio = ratioOf(level.cells, this->Levels[number - 1].cells);
  CellBox coarse{ { 0, 0, 0 }, { 0, 0, 1 } };
  for (std::size_t axis = 0; axis < this->axes(); ++axis)
  {
    coarse.begin[axis] = missing.begin[axis] / ratio[axis] - 2;
    coarse.end[axis] = (missing.end[axis] - 1) / ratio[axis] + 3;
  }
  std::vector<double> values = this->valuesIn(number - 1, coarse);
  Counts cells = coarse.size();
  for (std::size_t axis = 0; axis < this->axes(); ++axis)
  {
    std::vector<double> middles;
    for (int i = missing.begin[axis]; i < missing.end[axis]; ++i)
    {
      middles.push_back((i + 0.5) / ratio[axis] - 0.5 - coarse.begin[axis]);
    }
    resampleAxis(values, cells, axis, middles, 1. / ratio[axis]);
  }
  forCells(missing.begin, missing.size(),
    [&](int i, int j, int k)
    {
      const std::size_t to = box.index(i, j, k);
      sums[to] = parts[to] > 0 || solids[to] ? sums[to] : values[missing.index(i, j, k)];
    });
  return sums;
}

/// Returns the coarsest level that resolves a lattice, or the finest one that has blocks there.
std::size_t AmrField::levelFor(const schlieren::Lattice& lattice) const
{
  const schlieren::Box box = boxAround(lattice, 0);
  std::size_t found = 0;
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    const Level& here = this->Levels[level];
    bool isThere = false;
    here.binsOfAll->forPartsIn(
      this->cellsIn(here, box, reach), [&](std::size_t, const CellBox&) { isThere = true; });
    found = isThere ? level : found;
    bool isFine = true;
    for (std::size_t axis = 0; axis < this->axes(); ++axis)
    {
      constexpr double slightly = 1.01;
      isFine = isFine && here.spacing[axis] <= slightly * lattice.spacing[axis];
    }
    if (isFine)
    {
      return std::min(found, level);
    }
  }
  return found;
}

CellTree::Content AmrField::contentOf(const schlieren::Box& box) const
{
  CellTree::Content content{ infinity, -infinity, { infinity, infinity, infinity } };
  for (const Level& level : this->Levels)
  {
    const CellBox inside = this->cellsIn(level, box, 0);
    level.bins->forPartsIn(this->cellsIn(level, box, reach),
      [&](std::size_t number, const CellBox& cells)
      {
        const Block& block = level.blocks[number];
        if (!block.isOfLevel)
        {
          return;
        }
        Counts first, count;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          first[axis] = (cells.begin[axis] - block.box.begin[axis]) / pieceEdge;
          count[axis] = (cells.end[axis] - 1 - block.box.begin[axis]) / pieceEdge + 1 - first[axis];
        }
        const CellBox pieces{ { 0, 0, 0 }, block.pieces };
        bool hasValues = false;
        forCells(first, count,
          [&](int i, int j, int k)
          {
            const Block::Range& range = block.ranges[pieces.index(i, j, k)];
            hasValues = hasValues || range.lowest <= range.highest;
            content.lowest = std::min(content.lowest, range.lowest);
            content.highest = std::max(content.highest, range.highest);
          });
        if (hasValues && !intersection(cells, inside).isEmpty())
        {
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            // Halves the size, because the spline has more detail than voxels of a cell's size.
            content.cellSize[axis] = std::min(content.cellSize[axis], level.spacing[axis] / 2);
          }
        }
      });
  }
  return content;
}

void AmrField::sample(const schlieren::Lattice& lattice, double* values) const
{
  const std::size_t number = this->levelFor(lattice);
  const Level& level = this->Levels[number];
  schlieren::Box places{};
  std::array<std::vector<double>, 3> middles; // in cells of the level from the domain's corner
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < lattice.points[axis]; ++i)
    {
      // Clamps points outside of the domain to its border.
      const double at = lattice.first[axis] + i * lattice.spacing[axis] - this->Origin[axis];
      middles[axis].push_back(std::clamp(
        onFaces(at / level.spacing[axis]) - 0.5, -atBorder, level.cells[axis] - 1 + atBorder));
    }
    const auto placeOf = [&](double middle)
    { return this->Origin[axis] + (middle + 0.5) * level.spacing[axis]; };
    places.low[axis] = placeOf(middles[axis].front());
    places.high[axis] = placeOf(middles[axis].back());
  }
  const CellBox box = this->cellsIn(level, places, reach);
  std::vector<double> found = this->valuesIn(number, box);
  Counts cells = box.size();
  for (std::size_t axis = 0; axis < this->axes(); ++axis)
  {
    for (double& middle : middles[axis])
    {
      middle -= box.begin[axis];
    }
    splineAxis(found, cells, axis, middles[axis]);
  }
  std::copy(found.begin(), found.end(), values);
}

} // namespace filters
