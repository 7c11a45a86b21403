// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Collects the cells that an AmrField knows: those of its blocks, and their means on coarser
// levels.
#include "Amr/AmrField.h"

#include "Input/RefractivityValues.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Number of coarser cells on each side that a polynomial reads.
constexpr int cellsOfPolynomial = 2;

/// Returns the cells of a block that are not copies.
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

/// Calls visit(box) for all pieces of a box.
template <class Visit>
void forPieces(const CellBox& box, int pieceEdge, const Visit& visit)
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

/// Returns the cells of the coarser level that a box meets.
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

/// N of a block's cells, NaN in solids, and which are neither copies nor under finer blocks.
struct AmrValues
{
  std::vector<double> values;
  std::vector<unsigned char> counts;
};

AmrValues valuesOf(const BoxBins& covered, const AmrBlock& block, const Flow& flow, Tally& tally)
{
  vtkDataSet* data = flow.leaves[block.leaf].data;
  const CellBox own = boxOf(block);
  AmrValues result;
  result.counts.assign(volume(block.cells), 1);
  covered.forPartsIn(own,
    [&](std::size_t, const CellBox& cells)
    {
      forCells(cells.begin, cells.size(),
        [&](int i, int j, int k) { result.counts[own.index(i, j, k)] = 0; });
    });

  auto valid = newMask(data->GetNumberOfCells());
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  for (vtkIdType i = 0; i < valid->GetNumberOfValues(); ++i)
  {
    unsigned char& counts = result.counts[static_cast<std::size_t>(i)];
    if (!counts || (ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENCELL)))
    {
      valid->SetValue(i, 0);
    }
    if (ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATECELL))
    {
      counts = 0;
    }
  }
  const auto values = convert<vtkDoubleArray>(flow.leaves[block.leaf].arrays, flow.model, valid,
    std::numeric_limits<double>::quiet_NaN(), tally);
  result.values.assign(values->GetPointer(0), values->GetPointer(0) + values->GetNumberOfValues());
  return result;
}

} // namespace

bool AmrField::Block::isEmpty() const
{
  return this->solids.empty() &&
    std::all_of(this->parts.begin(), this->parts.end(), [](float part) { return part == 0; });
}

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

/// Averages a block over the cells of the next coarser level.
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

AmrField::AmrField(
  const AmrLevels& levels, const Flow& flow, Tally& tally, const WorkProgress& progress)
  : FlatAxis(levels.flat)
  , Origin(levels.origin)
  , Bounds(levels.bounds())
{
  std::size_t done = 0;
  for (std::size_t number = 0; number < levels.levels.size(); ++number)
  {
    const AmrLevel& level = levels.levels[number];
    this->Levels.push_back({ number, level.spacing, level.cells, level.blocks,
      std::make_unique<const BoxBins>(binsOf(level)),
      std::make_unique<const BoxBins>(coveredCells(levels.levels, number)), {}, nullptr });
  }
  this->findMissingCells();
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    const BoxBins& covered = *this->Levels[level].covered;
    for (const AmrBlock& block : levels.levels[level].blocks)
    {
      AmrValues values = valuesOf(covered, block, flow, tally);
      Block own{ boxOf(block), std::move(values.values), {}, {}, true, {}, {} };
      own.parts.assign(own.means.size(), 0);
      for (std::size_t cell = 0; cell < own.means.size(); ++cell)
      {
        const bool isKnown = values.counts[cell] && !std::isnan(own.means[cell]);
        own.parts[cell] = isKnown ? 1.f : 0.f;
        if (values.counts[cell] && !isKnown)
        {
          own.solids.resize(own.means.size());
          own.solids[cell] = true;
        }
      }
      this->addOwn(level, std::move(own));
      ++done;
      progress.reach(static_cast<double>(done) / static_cast<double>(flow.leaves.size()));
    }
  }
  this->sortBlocks();
}

/// Adds a block and its means on all coarser levels.
void AmrField::addOwn(std::size_t level, Block block)
{
  block.findRanges();
  this->OwnCells += std::count(block.parts.begin(), block.parts.end(), 1.f);
  this->Levels[level].blocks.push_back(std::move(block));
  const Block* finer = &this->Levels[level].blocks.back();
  for (std::size_t below = level; below > 0; --below)
  {
    const Counts ratio = ratioOf(this->Levels[below].cells, this->Levels[below - 1].cells);
    this->Levels[below - 1].blocks.push_back(coarser(*finer, ratio));
    finer = &this->Levels[below - 1].blocks.back();
  }
}

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

/// Finds the cells of the coarsest level that no block has.
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

} // namespace filters
