// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/FoldedCells.h"

#include "Cells/CellTree.h"
#include "Cells/MeshCell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <vector>

namespace filters
{

namespace
{

constexpr std::size_t maxTested = 1000;

/// Volume relative to the largest one in a cell, or to that of a box with edges as long, below which
/// it has no sign.
constexpr double smallest = 0.02, flattest = 1e-6;

enum class Orientation
{
  Positive,
  Negative,
  Flat,
  Folded
};

/// The other ends of the three edges that begin at a corner.
using Edges = std::array<int, 3>;

const std::vector<Edges>& edgesFrom(CellShape shape)
{
  static const std::vector<Edges> all[]{
    // in the order of CellShape
    { { 1, 2, 3 } }, // tetrahedron: each corner has the same volume
    { { 1, 2, 3 }, { 2, 0, 4 }, { 0, 1, 5 }, { 5, 4, 0 }, { 3, 5, 1 }, { 4, 3, 2 } }, // wedge
    { { 1, 3, 4 }, { 2, 0, 4 }, { 3, 1, 4 }, { 0, 2, 4 } },                           // pyramid
    { { 1, 3, 4 }, { 2, 0, 5 }, { 3, 1, 6 }, { 0, 2, 7 }, { 7, 5, 0 }, { 4, 6, 1 }, { 5, 7, 2 },
      { 6, 4, 3 } }, // hexahedron
    {}               // voxels are boxes
  };
  return all[static_cast<std::size_t>(shape)];
}

Orientation orientationOf(const CellTree::Cell& cell, CellShape shape)
{
  vtkIdType points[8];
  std::array<Vector, 8> x;
  const int count = cornersOf(shape);
  cell.block->points(cell.id, count, points);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
  {
    cell.block->coordinates(points[i], x[i].data());
  }
  double low = 0, high = 0; // of the corners' volumes
  std::size_t largest = 0;
  const std::vector<Edges>& edges = edgesFrom(shape);
  const auto edge = [&](std::size_t corner, std::size_t i)
  { return x[static_cast<std::size_t>(edges[corner][i])] - x[corner]; };
  for (std::size_t corner = 0; corner < edges.size(); ++corner)
  {
    const double volume = dot(edge(corner, 0), cross(edge(corner, 1), edge(corner, 2)));
    largest = std::abs(volume) > std::max(high, -low) ? corner : largest;
    low = std::min(low, volume);
    high = std::max(high, volume);
  }
  const double most = std::max(high, -low);
  double box = 1; // squared
  for (std::size_t i = 0; i < 3 && !edges.empty(); ++i)
  {
    box *= dot(edge(largest, i), edge(largest, i));
  }
  if (!(most * most > flattest * flattest * box))
  {
    return Orientation::Flat;
  }
  if (std::min(high, -low) > smallest * most)
  {
    return Orientation::Folded;
  }
  return high == most ? Orientation::Positive : Orientation::Negative;
}

/// The cells of one block.
struct Signs
{
  std::size_t positive = 0, negative = 0;
};

struct Found
{
  std::vector<Signs> signs; // of each block
  std::int64_t folded = 0;
  CellTree::Number first = std::numeric_limits<CellTree::Number>::max();
};

Vector middleOf(const CellTree::Cell& cell)
{
  Vector sum{};
  double count = 0;
  cell.block->forPoints(cell.id,
    [&](vtkIdType point)
    {
      Vector x;
      cell.block->coordinates(point, x.data());
      sum = sum + x;
      ++count;
    });
  return (1 / count) * sum;
}

/// Returns whether the middle of a cell is in another one of its block.
bool isInAnother(const CellTree& tree, CellTree::Number number, MeshCell& other)
{
  const CellTree::Cell own = tree.cell(number);
  const Vector middle = middleOf(own);
  bool isFound = false;
  tree.visit({ middle, middle },
    [&](CellTree::Number candidate)
    {
      const CellTree::Cell cell = tree.cell(candidate);
      if (isFound || candidate == number || cell.block != own.block)
      {
        return;
      }
      other.set(cell.block->data(), cell.id);
      double place[3], outside;
      isFound = other.find(middle.data(), place, outside) && outside == 0;
    });
  return isFound;
}

} // namespace

FoldedCells foldedIn(const CellTree& tree)
{
  Found all{ std::vector<Signs>(tree.blocks()), 0 };
  std::mutex lock; // guards `all`
  const std::size_t count = tree.size();
  const auto shapeAt = [&](const CellTree::Cell& cell)
  { return shapeOf(cell.block->type(cell.id)); };
  forChunks(static_cast<vtkIdType>(count), WorkProgress(),
    [&](vtkIdType begin, vtkIdType end)
    {
      Found found{ std::vector<Signs>(tree.blocks()), 0 };
      MeshCell curved;
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        tree.fetchAhead(i, count, [](std::size_t place) { return place; });
        const CellTree::Number number = tree.number(i);
        const CellTree::Cell cell = tree.cell(number);
        const CellShape shape = shapeAt(cell);
        Orientation orientation = Orientation::Flat;
        if (shape != CellShape::Other)
        {
          orientation = orientationOf(cell, shape);
        }
        else if (isCurved(cell.block->type(cell.id)))
        {
          curved.set(cell.block->data(), cell.id);
          orientation = curved.isFolded(smallest) ? Orientation::Folded : Orientation::Flat;
        }
        Signs& signs = found.signs[tree.blockOf(cell)];
        signs.positive += orientation == Orientation::Positive ? 1 : 0;
        signs.negative += orientation == Orientation::Negative ? 1 : 0;
        if (orientation == Orientation::Folded)
        {
          ++found.folded;
          found.first = std::min(found.first, number);
        }
      }
      const std::lock_guard<std::mutex> guard(lock);
      all.folded += found.folded;
      all.first = std::min(all.first, found.first);
      for (std::size_t block = 0; block < all.signs.size(); ++block)
      {
        all.signs[block].positive += found.signs[block].positive;
        all.signs[block].negative += found.signs[block].negative;
      }
    });

  const bool haveBoth = std::any_of(all.signs.begin(), all.signs.end(),
    [](const Signs& signs) { return signs.positive > 0 && signs.negative > 0; });
  std::size_t tested = 0;
  MeshCell other;
  for (std::size_t i = 0; haveBoth && i < count && tested < maxTested; ++i)
  {
    const CellTree::Cell cell = tree.cell(tree.number(i));
    const CellShape shape = shapeAt(cell);
    const Signs& signs = all.signs[tree.blockOf(cell)];
    const Orientation rarer =
      signs.negative <= signs.positive ? Orientation::Negative : Orientation::Positive;
    if (signs.positive == 0 || signs.negative == 0 || shape == CellShape::Other ||
      orientationOf(cell, shape) != rarer)
    {
      continue;
    }
    ++tested;
    if (isInAnother(tree, tree.number(i), other))
    {
      ++all.folded;
      all.first = std::min(all.first, tree.number(i));
    }
  }
  return all.folded == 0 ? FoldedCells()
                         : FoldedCells{ all.folded, middleOf(tree.cell(all.first)) };
}

} // namespace filters
