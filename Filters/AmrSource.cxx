// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AmrSource.h"

#include "AmrReconstruction.h"
#include "RefractivityValues.h"
#include "WeightedMedian.h"

#include "vtkDataSet.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cells around one that its reconstruction reads, and one for places on a border.
constexpr int reach = 3;

constexpr double rounding = 1e-6;           // of places, in cells
constexpr double atBorder = 0.5 - rounding; // from a cell's centre

void inTurn(std::ptrdiff_t rows, const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& work)
{
  work(0, rows);
}

} // namespace

void AmrSource::Block::findRanges()
{
  const Counts size = this->box.size();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->pieces[axis] = (size[axis] - 1) / pieceEdge + 1;
  }
  this->ranges.assign(volume(this->pieces), { infinity, -infinity });
  const CellBox all{ { 0, 0, 0 }, this->pieces };
  std::size_t cell = 0;
  forCells({ 0, 0, 0 }, size,
    [&](int i, int j, int k)
    {
      if (this->parts[cell] > 0)
      {
        Range& range = this->ranges[all.index(i / pieceEdge, j / pieceEdge, k / pieceEdge)];
        range.lowest = std::min(range.lowest, this->means[cell]);
        range.highest = std::max(range.highest, this->means[cell]);
      }
      ++cell;
    });
}

/// The means over the cells of the next coarser level.
AmrSource::Block AmrSource::coarser(const Block& block, const Counts& ratio)
{
  Block result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    result.box.begin[axis] = block.box.begin[axis] / ratio[axis];
    result.box.end[axis] = (block.box.end[axis] - 1) / ratio[axis] + 1;
  }
  result.means.assign(volume(result.box.size()), 0);
  result.parts.assign(result.means.size(), 0);
  const float part = 1 / static_cast<float>(volume(ratio));
  std::size_t cell = 0;
  forCells(block.box.begin, block.box.size(),
    [&](int i, int j, int k)
    {
      const std::size_t to = result.box.index(i / ratio[0], j / ratio[1], k / ratio[2]);
      if (block.isSolid(cell))
      {
        result.solids.resize(result.means.size());
        result.solids[to] = true;
      }
      if (block.parts[cell] > 0)
      {
        const float more = part * block.parts[cell];
        result.parts[to] += more;
        result.means[to] += static_cast<double>(more) * block.means[cell];
      }
      ++cell;
    });
  for (std::size_t to = 0; to < result.means.size(); ++to)
  {
    result.means[to] /= result.parts[to] > 0 ? static_cast<double>(result.parts[to]) : 1;
    if (result.isSolid(to) && result.parts[to] > 0)
    {
      result.solids[to] = false;
    }
  }
  return result;
}

AmrSource::AmrSource(const AmrLevels& levels, const Source& source, vtkDataObject* bodies,
  Outside outside, Tally& tally, const WorkProgress& progress)
  : FlatAxis(levels.flat)
  , Origin(levels.origin)
{
  std::size_t blocks = 0, done = 0;
  for (const AmrLevel& level : levels.levels)
  {
    this->Levels.push_back({ level.spacing, level.cells, {}, nullptr });
    blocks += level.blocks.size();
  }
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    const BoxBins covered = coveredCells(levels.levels, level);
    for (const AmrBlock& block : levels.levels[level].blocks)
    {
      AmrValues values = valuesOf(covered, block, source, tally);
      Block own{ boxOf(block), std::move(values.values), {}, {}, true, {}, {} };
      own.parts.assign(own.means.size(), 0);
      for (std::size_t cell = 0; cell < own.means.size(); ++cell)
      {
        const bool isKnown = values.counts[cell] && !std::isnan(own.means[cell]);
        own.parts[cell] = isKnown ? 1.f : 0.f;
        this->HasGas = this->HasGas || isKnown;
        if (values.counts[cell] && !isKnown)
        {
          own.solids.resize(own.means.size());
          own.solids[cell] = true;
        }
      }
      own.findRanges();
      this->Levels[level].blocks.push_back(std::move(own));
      const Block* finer = &this->Levels[level].blocks.back();
      for (std::size_t below = level; below > 0; --below)
      {
        const Counts ratio = ratioOf(this->Levels[below].cells, this->Levels[below - 1].cells);
        this->Levels[below - 1].blocks.push_back(coarser(*finer, ratio));
        finer = &this->Levels[below - 1].blocks.back();
      }
      progress.reach(0.9 * static_cast<double>(++done) / static_cast<double>(blocks));
    }
  }
  for (Level& level : this->Levels)
  {
    std::vector<CellBox> boxes;
    for (const Block& block : level.blocks)
    {
      boxes.push_back(block.box);
    }
    level.bins = std::make_unique<BoxBins>(std::move(boxes));
  }
  this->Boundary = std::make_unique<GasBoundary>(this->findFaces(), bodies, outside);
  progress.reach(1);
}

bool AmrSource::meetsBodies() const { return this->Boundary->hasBodiesIn(this->bounds()); }

CellState AmrSource::stateOf(std::size_t number, const Counts& cell) const
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

/// Outside of a box, as at its border.
bool AmrSource::hasGasAt(const Point& place) const
{
  for (std::size_t number = this->Levels.size(); number-- > 0;)
  {
    const Level& level = this->Levels[number];
    Counts cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double at = (place[axis] - this->Origin[axis]) / level.spacing[axis];
      if (!this->IsBox && (at < -rounding || at > level.cells[axis] + rounding))
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

BoundaryFaces AmrSource::findFaces()
{
  std::vector<AmrFaces::Level> lattices;
  for (const Level& level : this->Levels)
  {
    lattices.push_back({ level.spacing, level.cells });
  }
  AmrFaces faces(
    this->Origin, std::move(lattices),
    [this](std::size_t level, const Counts& cell) { return this->stateOf(level, cell); },
    this->isFlat() ? Extent::Layer : Extent::Volume);
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
  // Cells that no block has.
  const CellBox domain{ { 0, 0, 0 }, this->Levels[0].cells };
  std::vector<bool> isThere(volume(domain.end), false);
  for (const Block& block : this->Levels[0].blocks)
  {
    std::size_t cell = 0;
    forCells(block.box.begin, block.box.size(),
      [&](int i, int j, int k)
      {
        if (block.parts[cell] > 0 || block.isSolid(cell))
        {
          isThere[domain.index(i, j, k)] = true;
        }
        ++cell;
      });
  }
  std::size_t cell = 0;
  forCells(domain.begin, domain.end,
    [&](int i, int j, int k)
    {
      if (!isThere[cell++])
      {
        faces.addAround(0, { i, j, k }, false);
        this->IsBox = false;
      }
    });
  if (!this->IsBox)
  {
    faces.addDomain();
  }
  return faces.take();
}

schlieren::Box AmrSource::bounds() const
{
  const Level& coarsest = this->Levels[0];
  schlieren::Box box{ this->Origin, this->Origin };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.high[axis] += coarsest.cells[axis] * coarsest.spacing[axis];
  }
  return box;
}

std::array<double, 3> AmrSource::voxelShape() const { return this->Levels[0].spacing; }

double AmrSource::ambient() const
{
  std::vector<std::pair<double, double>> parts; // N, area
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
        if (outer > 0 && block.parts[cell] > 0)
        {
          parts.emplace_back(block.means[cell], outer);
        }
        ++cell;
      };
      if (block.isOfLevel)
      {
        forCells(block.box.begin, block.box.size(), look);
      }
    }
  }
  return weightedMedian(std::move(parts));
}

/// The cells of a level that a box meets, with some around them.
CellBox AmrSource::cellsIn(const Level& level, const schlieren::Box& box, int margin) const
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

/// N of the cells of a level in a box; NaN in solids and outside of the domain.
std::vector<double> AmrSource::valuesIn(std::size_t number, const CellBox& box) const
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
  CellBox missing{ box.end, box.begin }; // around those that no block has
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
    resampleAxis(values, cells, axis, middles, 1. / ratio[axis], inTurn);
  }
  forCells(missing.begin, missing.size(),
    [&](int i, int j, int k)
    {
      const std::size_t to = box.index(i, j, k);
      sums[to] = parts[to] > 0 || solids[to] ? sums[to] : values[missing.index(i, j, k)];
    });
  return sums;
}

/// The coarsest level that is no coarser than a lattice, or the finest there is where the lattice lies.
std::size_t AmrSource::levelFor(const schlieren::Lattice& lattice) const
{
  schlieren::Box box{ lattice.first, lattice.first };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.high[axis] += (lattice.points[axis] - 1) * lattice.spacing[axis];
  }
  std::size_t found = 0;
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    const Level& here = this->Levels[level];
    bool isThere = false;
    here.bins->forPartsIn(this->cellsIn(here, box, reach),
      [&](std::size_t block, const CellBox&)
      { isThere = isThere || here.blocks[block].isOfLevel; });
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

schlieren::MediumSource::Content AmrSource::contentOf(const schlieren::Box& box) const
{
  Content content{ infinity, -infinity, { infinity, infinity, infinity }, false, true, false };
  this->Boundary->findPlaces(
    box, [this](const Point& place) { return this->hasGasAt(place); }, content);
  if (!content.hasGas)
  {
    return content;
  }
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
            // The spline has more detail than one voxel of the size of a cell shows.
            content.cellSize[axis] = std::min(content.cellSize[axis], level.spacing[axis] / 2);
          }
        }
      });
  }
  return content;
}

void AmrSource::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  const std::size_t number = this->levelFor(lattice);
  const Level& level = this->Levels[number];
  schlieren::Box range{};
  std::array<std::vector<double>, 3> middles; // cells of the level, from the domain's corner
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < lattice.points[axis]; ++i)
    {
      // Outside of the domain, as at its border.
      const double at = lattice.first[axis] + i * lattice.spacing[axis] - this->Origin[axis];
      middles[axis].push_back(
        std::clamp(at / level.spacing[axis] - 0.5, -atBorder, level.cells[axis] - 1 + atBorder));
    }
    range.low[axis] = this->Origin[axis] + (middles[axis].front() + 0.5) * level.spacing[axis];
    range.high[axis] = this->Origin[axis] + (middles[axis].back() + 0.5) * level.spacing[axis];
  }
  const CellBox box = this->cellsIn(level, range, reach);
  std::vector<double> values = this->valuesIn(number, box);
  Counts cells = box.size();
  for (std::size_t axis = 0; axis < this->axes(); ++axis)
  {
    for (double& middle : middles[axis])
    {
      middle -= box.begin[axis];
    }
    splineAxis(values, cells, axis, middles[axis]);
  }
  std::copy(values.begin(), values.end(), refractivity);
  std::vector<unsigned char> hasGas(values.size(), 1);
  std::size_t point = 0;
  forCells({ 0, 0, 0 }, lattice.points,
    [&](int i, int j, int k)
    {
      const Counts at{ i, j, k };
      Point place;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] = lattice.first[axis] + at[axis] * lattice.spacing[axis];
      }
      hasGas[point++] = this->hasGasAt(place) ? 1 : 0;
    });
  this->Boundary->sample(lattice, hasGas.data(), places, distances);
}

void AmrSource::addField(const AmrLevels& levels, const Source& source)
{
  Tally notReported;
  this->Fields.push_back(
    std::make_unique<const AmrSource>(levels, source, nullptr, Outside::Passes, notReported));
}

schlieren::MediumSource::FieldRange AmrSource::rangeOfField(
  int field, const schlieren::Box& box) const
{
  const Content content = this->Fields[static_cast<std::size_t>(field)]->contentOf(box);
  return { content.lowest, content.highest };
}

void AmrSource::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  this->sample(lattice, refractivity, places, distances);
  const auto size = static_cast<std::size_t>(lattice.size());
  std::vector<schlieren::Place> ofField(size);
  for (const auto& field : this->Fields)
  {
    field->sample(lattice, values, ofField.data(), nullptr);
    for (std::size_t i = 0; i < size; ++i)
    {
      values[i] = ofField[i] == schlieren::Place::Gas ? values[i] : nan;
    }
    values += size;
  }
}

} // namespace filters
