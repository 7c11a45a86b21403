// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AmrField.h"

#include "AmrReconstruction.h"
#include "LatticeDistances.h"
#include "WeightedMedian.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace filters
{

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cells around one that its reconstruction reads, and one for places on a border.
constexpr int reach = 3;

/// What a value depends on is no more cells of the lattice's level away: two coefficients of the spline, of which each depends
/// on two cells more. Of the next coarser level it is as far, and what a polynomial reads.
constexpr int cellsOfSpline = 4;
constexpr int cellsOfPolynomial = 2;

constexpr double rounding = 1e-6;           // of places, in cells
constexpr double atBorder = 0.5 - rounding; // from a cell's centre

void inTurn(std::ptrdiff_t rows, const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& work)
{
  work(0, rows);
}

/// A place on a face between cells belongs to the cell behind it, however it is rounded.
double onFaces(double cells)
{
  const double face = std::round(cells);
  return std::abs(cells - face) < rounding ? face : cells;
}

/// The cells of a block that are no copies.
CellBox ownBoxOf(const AmrBlock& block)
{
  CellBox box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.begin[axis] = block.first[axis] + block.ownBegin[axis];
    box.end[axis] = block.first[axis] + block.ownEnd[axis];
  }
  return box;
}

/// Cells of a block that are looked at together.
constexpr int pieceEdge = 8;

/// Calls visit(box) for the pieces of a box.
template <class Visit>
void forPieces(const CellBox& box, const Visit& visit)
{
  Counts pieces{};
  for (std::size_t axis = 0; axis < 3 && !box.isEmpty(); ++axis)
  {
    pieces[axis] = (box.size()[axis] - 1) / pieceEdge + 1;
  }
  forCells({ 0, 0, 0 }, pieces,
    [&](int i, int j, int k)
    {
      const Counts at{ i, j, k };
      CellBox piece;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        piece.begin[axis] = box.begin[axis] + at[axis] * pieceEdge;
        piece.end[axis] = std::min(piece.begin[axis] + pieceEdge, box.end[axis]);
      }
      visit(piece);
    });
}

/// Those of a coarser level that a box meets.
CellBox coarserBox(const CellBox& box, const Counts& ratio)
{
  CellBox coarse;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    coarse.begin[axis] = box.begin[axis] / ratio[axis];
    coarse.end[axis] = (box.end[axis] - 1) / ratio[axis] + 1;
  }
  return coarse;
}

CellBox finerBox(const CellBox& box, const Counts& ratio)
{
  CellBox fine;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    fine.begin[axis] = box.begin[axis] * ratio[axis];
    fine.end[axis] = box.end[axis] * ratio[axis];
  }
  return fine;
}

} // namespace

void AmrField::Block::findRanges()
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
AmrField::Block AmrField::coarser(const Block& block, const Counts& ratio)
{
  Block result{};
  result.box = coarserBox(block.box, ratio);
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

/// A part of a block.
AmrField::Block AmrField::cropped(const Block& block, const CellBox& box)
{
  Block part{ box, {}, {}, {}, block.isOfLevel, true, {}, {} };
  part.means.resize(volume(box.size()));
  part.parts.resize(part.means.size());
  part.solids.resize(block.solids.empty() ? 0 : part.means.size());
  std::size_t to = 0;
  forCells(box.begin, box.size(),
    [&](int i, int j, int k)
    {
      const std::size_t from = block.box.index(i, j, k);
      part.means[to] = block.means[from];
      part.parts[to] = block.parts[from];
      if (!part.solids.empty())
      {
        part.solids[to] = block.solids[from];
      }
      ++to;
    });
  return part;
}

AmrField::AmrField(const AmrLevels& levels, const Source& source, Tally& tally,
  const WorkProgress& progress, std::size_t firstImage)
  : FlatAxis(levels.flat)
  , Origin(levels.origin)
  , Bounds(levels.bounds())
{
  std::size_t done = 0;
  for (std::size_t number = 0; number < levels.levels.size(); ++number)
  {
    const AmrLevel& level = levels.levels[number];
    std::vector<CellBox> boxes;
    std::transform(level.blocks.begin(), level.blocks.end(), std::back_inserter(boxes), boxOf);
    this->Levels.push_back({ number, level.spacing, level.cells, level.blocks,
      std::make_unique<const BoxBins>(std::move(boxes)),
      std::make_unique<const BoxBins>(coveredCells(levels.levels, number)), {}, nullptr });
  }
  this->findMissingCells();
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    const BoxBins& covered = *this->Levels[level].covered;
    for (AmrBlock block : levels.levels[level].blocks)
    {
      if (block.leaf - firstImage >= source.leaves.size()) // or less than 0
      {
        continue;
      }
      block.leaf -= firstImage;
      AmrValues values = valuesOf(covered, block, source, tally);
      Block own{ boxOf(block), std::move(values.values), {}, {}, true, false, {}, {} };
      own.parts.assign(own.means.size(), 0);
      for (std::size_t cell = 0; cell < own.means.size(); ++cell)
      {
        const bool isKnown = values.counts[cell] && !std::isnan(own.means[cell]);
        own.parts[cell] = isKnown ? 1.f : 0.f;
        this->OwnCells += isKnown ? 1 : 0;
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
      ++done;
      progress.reach(static_cast<double>(done) / static_cast<double>(source.leaves.size()));
    }
  }
  this->sortBlocks();
}

/// Puts them into bins.
void AmrField::sortBlocks()
{
  for (Level& level : this->Levels)
  {
    std::vector<CellBox> boxes;
    for (const Block& block : level.blocks)
    {
      boxes.push_back(block.box);
    }
    level.bins = std::make_unique<const BoxBins>(std::move(boxes));
  }
}

/// Those of the coarsest level that no block has.
void AmrField::findMissingCells()
{
  const CellBox domain{ { 0, 0, 0 }, this->Levels[0].cells };
  this->AreMissing.assign(volume(domain.end), true);
  for (const Level& level : this->Levels)
  {
    const Counts ratio = ratioOf(level.cells, domain.end);
    for (const AmrBlock& block : level.all)
    {
      if (const CellBox own = ownBoxOf(block); !own.isEmpty())
      {
        const CellBox coarse = coarserBox(own, ratio);
        forCells(coarse.begin, coarse.size(),
          [&](int i, int j, int k) { this->AreMissing[domain.index(i, j, k)] = false; });
      }
    }
  }
  if (std::find(this->AreMissing.begin(), this->AreMissing.end(), true) == this->AreMissing.end())
  {
    this->AreMissing = {};
  }
}

/// How many cells of each level around a rank's own others' copies are.
std::vector<Counts> AmrField::margins() const
{
  std::vector<Counts> margins(this->Levels.size(), { cellsOfSpline, cellsOfSpline, cellsOfSpline });
  for (std::size_t level = this->Levels.size() - 1; level > 0; --level)
  {
    const Counts ratio = ratioOf(this->Levels[level].cells, this->Levels[level - 1].cells);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int coarse = (margins[level][axis] - 1) / ratio[axis] + 1 + cellsOfPolynomial;
      margins[level - 1][axis] = std::max(coarse, cellsOfSpline);
    }
  }
  return margins;
}

/// The own cells of a block that no finer block covers: boxes of at most `pieceEdge` cells along each axis around them.
std::vector<CellBox> AmrField::uncoveredIn(const Level& level, const AmrBlock& block)
{
  std::vector<CellBox> uncovered;
  forPieces(ownBoxOf(block),
    [&](const CellBox& piece)
    {
      std::vector<bool> isCovered;
      bool isAllCovered = false;
      level.covered->forPartsIn(piece,
        [&](std::size_t, const CellBox& cells)
        {
          isAllCovered = isAllCovered || cells.size() == piece.size();
          isCovered.resize(isAllCovered ? 0 : volume(piece.size()));
          forCells(cells.begin, isAllCovered ? Counts{} : cells.size(),
            [&](int i, int j, int k) { isCovered[piece.index(i, j, k)] = true; });
        });
      if (isAllCovered)
      {
        return;
      }
      std::size_t cell = 0;
      std::optional<CellBox> hull;
      forCells(piece.begin, isCovered.empty() ? Counts{} : piece.size(),
        [&](int i, int j, int k)
        {
          if (!isCovered[cell++])
          {
            const CellBox here{ { i, j, k }, { i + 1, j + 1, k + 1 } };
            hull = hull ? hullOf(*hull, here) : here;
          }
        });
      if (isCovered.empty() || hull)
      {
        uncovered.push_back(hull.value_or(piece));
      }
    });
  return uncovered;
}

void AmrField::putCopies(
  std::size_t firstImage, std::size_t images, std::vector<char>& copies) const
{
  std::vector<std::vector<CellBox>> wanted(this->Levels.size());
  const std::vector<Counts> margins = this->margins();
  for (const Level& other : this->Levels)
  {
    for (const AmrBlock& block : other.all)
    {
      if (block.leaf - firstImage >= images) // or less than 0
      {
        continue;
      }
      for (const CellBox& own : uncoveredIn(other, block))
      {
        for (std::size_t number = 0; number < this->Levels.size(); ++number)
        {
          const Level& level = this->Levels[number];
          CellBox& box = wanted[number].emplace_back(number > other.number
              ? finerBox(own, ratioOf(level.cells, other.cells))
              : coarserBox(own, ratioOf(other.cells, level.cells)));
          for (std::size_t axis = 0; axis < this->axes(); ++axis)
          {
            box.begin[axis] -= margins[number][axis];
            box.end[axis] += margins[number][axis];
          }
        }
      }
    }
  }
  for (std::size_t number = 0; number < this->Levels.size(); ++number)
  {
    const BoxBins bins(std::move(wanted[number]));
    for (const Block& block : this->Levels[number].blocks)
    {
      if (block.isCopy)
      {
        continue;
      }
      forPieces(block.box,
        [&](const CellBox& piece)
        {
          std::optional<CellBox> part;
          bins.forPartsIn(piece,
            [&](std::size_t, const CellBox& cells) { part = part ? hullOf(*part, cells) : cells; });
          if (part)
          {
            const Block cells = cropped(block, *part);
            put(static_cast<std::uint64_t>(number), copies);
            put(cells.isOfLevel, copies);
            put(cells.box, copies);
            putAll(cells.means, copies);
            putAll(cells.parts, copies);
            putAll(std::vector<unsigned char>(cells.solids.begin(), cells.solids.end()), copies);
          }
        });
    }
  }
}

void AmrField::addCopies(Reader& reader)
{
  while (!reader.IsAtEnd())
  {
    Level& level = this->Levels.at(reader.Get<std::uint64_t>());
    Block block{};
    block.isCopy = true;
    block.isOfLevel = reader.Get<bool>();
    block.box = reader.Get<CellBox>();
    block.means = reader.GetAll<std::vector<double>>();
    block.parts = reader.GetAll<std::vector<float>>();
    const auto solids = reader.GetAll<std::vector<unsigned char>>();
    block.solids.assign(solids.begin(), solids.end());
    level.blocks.push_back(std::move(block));
  }
  this->sortBlocks();
}

CellState AmrField::stateOf(std::size_t number, const Counts& cell, Whose whose) const
{
  CellState state = CellState::None;
  const Level& level = this->Levels[number];
  level.bins->forPartsIn({ cell, { cell[0] + 1, cell[1] + 1, cell[2] + 1 } },
    [&](std::size_t found, const CellBox&)
    {
      const Block& block = level.blocks[found];
      if (block.isCopy && whose == Whose::Own)
      {
        return;
      }
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
    const CellState state = this->stateOf(number, cell, Whose::Own);
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

bool AmrField::mayHold(const schlieren::Lattice& lattice) const
{
  const schlieren::Box box = boxAround(lattice, 0);
  bool isFound = false;
  for (const Level& level : this->Levels)
  {
    level.bins->forPartsIn(this->cellsIn(level, box, 1),
      [&](std::size_t number, const CellBox&)
      {
        const Block& block = level.blocks[number];
        isFound = isFound || (block.isOfLevel && !block.isCopy);
      });
  }
  return isFound;
}

BoundaryFaces AmrField::faces() const
{
  std::vector<AmrFaces::Level> lattices;
  for (const Level& level : this->Levels)
  {
    lattices.push_back({ level.spacing, level.cells });
  }
  Whose whose = Whose::All;
  AmrFaces faces(
    this->Origin, std::move(lattices),
    [&](std::size_t level, const Counts& cell) { return this->stateOf(level, cell, whose); },
    this->FlatAxis >= 0 ? Extent::Layer : Extent::Volume);
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    for (const Block& block : this->Levels[level].blocks)
    {
      if (!block.isOfLevel || block.isCopy || block.solids.empty())
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
    whose = Whose::Own; // each rank those beside its gas
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

schlieren::Box AmrField::ownBounds() const
{
  schlieren::Box bounds{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  for (const Level& level : this->Levels)
  {
    for (const Block& block : level.blocks)
    {
      for (std::size_t axis = 0; axis < 3 && block.isOfLevel && !block.isCopy; ++axis)
      {
        const int begin = block.box.begin[axis], end = block.box.end[axis];
        const double low = this->Origin[axis] + begin * level.spacing[axis];
        const double high = this->Origin[axis] + end * level.spacing[axis];
        bounds.low[axis] = std::min(bounds.low[axis], begin == 0 ? -infinity : low);
        bounds.high[axis] = std::max(bounds.high[axis], end == level.cells[axis] ? infinity : high);
      }
    }
  }
  return bounds;
}

/// How many cells of all ranks are at the border of the domain, of which each nth is looked at.
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
  return static_cast<int>(std::max(1., std::ceil(cells / mostOuterValues)));
}

std::vector<WeightedValue> AmrField::outerValues() const
{
  const int every = this->outerCellsForOne();
  std::vector<WeightedValue> values;
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
      if (block.isOfLevel && !block.isCopy)
      {
        forCells(block.box.begin, block.box.size(), look);
      }
    }
  }
  return values;
}

/// The cells of a level that a box meets, with some around them.
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

/// N of the cells of a level in a box; NaN in solids and outside of the domain.
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

std::array<double, 3> AmrField::reachOfContent() const
{
  std::array<double, 3> far = this->voxelShape();
  for (double& along : far)
  {
    along *= reach + 1; // a box may begin anywhere in a cell
  }
  return far;
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
        if (!block.isOfLevel || block.isCopy)
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

void AmrField::sample(
  const schlieren::Lattice& lattice, const CellBox& points, double* values) const
{
  const std::size_t number = this->levelFor(lattice);
  const Level& level = this->Levels[number];
  schlieren::Box all{}, part{};
  std::array<std::vector<double>, 3> middles; // cells of the level, from the domain's corner
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Outside of the domain, as at its border.
    const auto middleOf = [&](int point)
    {
      const double at = lattice.first[axis] + point * lattice.spacing[axis] - this->Origin[axis];
      return std::clamp(
        onFaces(at / level.spacing[axis]) - 0.5, -atBorder, level.cells[axis] - 1 + atBorder);
    };
    const auto placeOf = [&](int point)
    { return this->Origin[axis] + (middleOf(point) + 0.5) * level.spacing[axis]; };
    for (int i = points.begin[axis]; i < points.end[axis]; ++i)
    {
      middles[axis].push_back(middleOf(i));
    }
    all.low[axis] = placeOf(0);
    all.high[axis] = placeOf(lattice.points[axis] - 1);
    part.low[axis] = placeOf(points.begin[axis]);
    part.high[axis] = placeOf(points.end[axis] - 1);
  }
  // What a part of the lattice reads is what all of it would read there.
  const CellBox box =
    intersection(this->cellsIn(level, all, reach), this->cellsIn(level, part, cellsOfSpline));
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
