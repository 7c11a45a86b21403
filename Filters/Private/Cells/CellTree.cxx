// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CellTree.h"

#include "vtkDataSet.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Limits the heights of tetrahedra to this fraction of their shortest edge, because they can be
/// much flatter than what they resolve.
constexpr double flattestTetrahedron = 0.5;

/// Returns the range of corner polynomials, which are linear: bounded by the other corners.
template <int count>
CellTree::Range rangeOfCorners(const CellTree::Cell& one)
{
  vtkIdType points[8];
  one.block->points(one.id, count, points);
  double origin[3], x[3][count], lowest = infinity, highest = -infinity;
  one.block->coordinates(points[0], origin);
  for (int i = 0; i < count; ++i)
  {
    double at[3];
    one.block->coordinates(points[i], at);
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis][i] = at[axis] - origin[axis];
    }
  }
  double low[count], high[count];
  std::fill_n(low, count, infinity);
  std::fill_n(high, count, -infinity);
  for (int i = 0; i < count; ++i)
  {
    const PointTrend& trend = one.block->trends()[points[i]];
    const double value = one.block->values()[points[i]];
    const double half[3] = { 0.5 * trend.gradient[0], 0.5 * trend.gradient[1],
      0.5 * trend.gradient[2] };
    const double atOrigin = value - half[0] * x[0][i] - half[1] * x[1][i] - half[2] * x[2][i];
    lowest = std::min(lowest, value + trend.lowest);
    highest = std::max(highest, value + trend.highest);
    for (int k = 0; k < count; ++k)
    {
      const double there = atOrigin + half[0] * x[0][k] + half[1] * x[1][k] + half[2] * x[2][k];
      low[k] = there < low[k] ? there : low[k];
      high[k] = there > high[k] ? there : high[k];
    }
  }
  return { std::max(lowest, *std::min_element(low, low + count)),
    std::min(highest, *std::max_element(high, high + count)) };
}

} // namespace

CellTree::CellTree(const std::vector<vtkDataSet*>& blocks, Reconstruction reconstruction,
  const WorkProgress& progress, Copies copies)
{
  const auto mesh = std::make_shared<Mesh>();
  this->Sorted = mesh;
  vtkIdType cells = 0;
  for (vtkDataSet* block : blocks)
  {
    mesh->firstNumbers.push_back(static_cast<Number>(cells));
    cells += block->GetNumberOfCells();
    constexpr auto most = static_cast<vtkIdType>(std::numeric_limits<Number>::max());
    if (cells >= most || block->GetNumberOfPoints() >= most)
    {
      throw std::runtime_error(
        "The input has more than 4294967294 cells or points, which cannot be used in one piece. "
        "Extract the part that is to be seen.");
    }
  }
  mesh->firstNumbers.push_back(static_cast<Number>(cells));
  this->Blocks = std::vector<MeshArrays>(blocks.begin(), blocks.end());
  this->findCells(*mesh, copies, progress.part(0, 0.1));
  if (reconstruction != Reconstruction::Linear)
  {
    this->findNeighbours(*mesh, progress.part(0.1, 0.4));
  }
  this->sortCells(*mesh, progress.part(0.4, 0.6));
  this->makeGroups(*mesh, progress.part(0.6, 0.7));
  mesh->voxelShape =
    voxelShapeOf(this->measuredCells(static_cast<std::int64_t>(mesh->numbers.size())));
  this->setValues(progress.part(0.7, 1));
}

CellTree::CellTree(const std::vector<vtkDataSet*>& blocks, std::shared_ptr<const Mesh> mesh,
  const WorkProgress& progress)
  : Blocks(blocks.begin(), blocks.end())
  , Sorted(std::move(mesh))
{
  this->setValues(progress);
}

CellTree::Cell CellTree::cell(Number number) const
{
  std::size_t block = 0;
  const std::vector<Number>& firstNumbers = this->Sorted->firstNumbers;
  if (this->Blocks.size() > 1)
  {
    block =
      static_cast<std::size_t>(std::upper_bound(firstNumbers.begin(), firstNumbers.end(), number) -
        firstNumbers.begin() - 1);
  }
  return { &this->Blocks[block], static_cast<vtkIdType>(number - firstNumbers[block]) };
}

std::size_t CellTree::Mesh::bytes() const
{
  std::size_t sum = this->numbers.size() * (sizeof(Number) + sizeof(Steps));
  for (const std::vector<Group>& level : this->levels)
  {
    sum += level.size() * sizeof(Group);
  }
  for (const PointNeighbours& ofBlock : this->neighbours)
  {
    sum += ofBlock.bytes();
  }
  return sum;
}

std::size_t CellTree::bytes() const
{
  std::size_t sum = this->Sorted->bytes();
  for (const std::vector<Range>& level : this->Ranges)
  {
    sum += level.size() * sizeof(Range);
  }
  for (const MeshArrays& block : this->Blocks)
  {
    sum += block.bytes();
  }
  return sum;
}

/// Sets ranges and trends, which depend on the values.
void CellTree::setValues(const WorkProgress& progress)
{
  const Mesh& mesh = *this->Sorted;
  const auto blocks = static_cast<double>(this->Blocks.size());
  for (std::size_t block = 0; block < mesh.neighbours.size(); ++block)
  {
    const auto number = static_cast<double>(block);
    const WorkProgress part = progress.part(0.7 * number / blocks, 0.7 * (number + 1) / blocks);
    MeshArrays& arrays = this->Blocks[block];
    const PointNeighbours& neighbours = mesh.neighbours[block];
    if (arrays.cellsAround())
    {
      arrays.setValues(valuesOfMeans(arrays, neighbours, part.part(0, 0.5)));
    }
    arrays.setTrends(trendsOf(arrays, neighbours, part.part(0.5, 1)));
  }
  if (mesh.levels.empty())
  {
    return;
  }
  const std::size_t count = mesh.numbers.size();
  this->Ranges.emplace_back(mesh.levels[0].size());
  forChunks(static_cast<vtkIdType>(this->Ranges[0].size()), progress.part(0.7, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto group = static_cast<std::size_t>(begin); group < static_cast<std::size_t>(end);
           ++group)
      {
        Range& made = this->Ranges[0][group];
        made = { infinity, -infinity };
        for (std::size_t i = width * group; i < std::min(count, width * (group + 1)); ++i)
        {
          this->fetchAhead(i, count, [](std::size_t place) { return place; });
          const Range range = rangeOf(this->cell(mesh.numbers[i]));
          made.lowest = std::min(made.lowest, range.lowest);
          made.highest = std::max(made.highest, range.highest);
        }
      }
    });
  while (this->Ranges.back().size() > 1)
  {
    const std::vector<Range>& below = this->Ranges.back();
    std::vector<Range> level((below.size() + width - 1) / width, Range{ infinity, -infinity });
    for (std::size_t i = 0; i < below.size(); ++i)
    {
      Range& range = level[i / width];
      range.lowest = std::min(range.lowest, below[i].lowest);
      range.highest = std::max(range.highest, below[i].highest);
    }
    this->Ranges.push_back(std::move(level));
  }
}

/// Returns the range of interpolation in a cell with finite points and values.
CellTree::Range CellTree::rangeOf(const Cell& one)
{
  const CellShape shape = shapeOf(one.block->type(one.id));
  if (one.block->trends())
  {
    return withShape(
      shape, [&](const auto of) { return rangeOfCorners<cornersOf(decltype(of)::value)>(one); });
  }
  Range range{ infinity, -infinity };
  const double* values = one.block->values();
  one.block->forPoints(one.id,
    [&](vtkIdType point)
    {
      range.lowest = std::min(range.lowest, values[point]);
      range.highest = std::max(range.highest, values[point]);
    });
  return range;
}

Vector CellTree::sizeOf(const Cell& one)
{
  const CellShape shape = shapeOf(one.block->type(one.id));
  Vector size;
  vtkIdType points[8];
  one.block->points(one.id, cornersOf(shape), points);
  double corners[3][8];
  for (int i = 0; i < cornersOf(shape); ++i)
  {
    double x[3];
    one.block->coordinates(points[i], x);
    for (int axis = 0; axis < 3; ++axis)
    {
      corners[axis][i] = x[axis];
    }
  }
  Vector columns[3], rows[4];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Polynomial x = polynomialOf(shape, corners[axis]);
    for (std::size_t along = 0; along < 3; ++along)
    {
      columns[along][axis] = x[along + 1];
    }
  }
  if (!invert(columns, rows))
  {
    return { infinity, infinity, infinity };
  }
  // Chooses the coordinate that vanishes on the slanting face of tetrahedra and wedges.
  const bool isTetrahedron = shape == CellShape::Tetrahedron;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    rows[3][axis] = rows[0][axis] + rows[1][axis] + (isTetrahedron ? rows[2][axis] : 0);
  }
  double shortest = 0;
  if (isTetrahedron)
  {
    shortest = infinity;
    for (int i = 0; i < 4; ++i)
    {
      for (int k = 0; k < i; ++k)
      {
        shortest = std::min(shortest,
          std::hypot(corners[0][i] - corners[0][k], corners[1][i] - corners[1][k],
            corners[2][i] - corners[2][k]));
      }
    }
  }
  const int rowCount = isTetrahedron || shape == CellShape::Wedge ? 4 : 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double steepest = 0;
    for (int i = 0; i < rowCount; ++i)
    {
      steepest = std::max(steepest, std::abs(rows[i][axis]));
    }
    size[axis] = std::max(1 / steepest, flattestTetrahedron * shortest);
  }
  return size;
}

bool CellTree::areWithin(const Steps& a, const Steps& b)
{
  constexpr std::int32_t rounding = 3; // see stepsOf()
  bool are = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    are = are && a.low[axis] >= b.low[axis] + rounding && a.high[axis] <= b.high[axis] - rounding;
  }
  return are;
}

CellTree::Content CellTree::content(const Bounds& box) const
{
  Content content{ infinity, -infinity, { infinity, infinity, infinity } };
  const Mesh& mesh = *this->Sorted;
  if (mesh.levels.empty())
  {
    return content;
  }
  const Steps steps = this->stepsOf(box);
  const auto mayAdd = [&](const Range& range, const float* cellSize)
  {
    return range.lowest < content.lowest || range.highest > content.highest ||
      cellSize[0] < content.cellSize[0] || cellSize[1] < content.cellSize[1] ||
      cellSize[2] < content.cellSize[2];
  };
  const auto add = [&](const Range& range, const float* cellSize)
  {
    content.lowest = std::min(content.lowest, range.lowest);
    content.highest = std::max(content.highest, range.highest);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      content.cellSize[axis] = std::min<double>(content.cellSize[axis], cellSize[axis]);
    }
  };
  // Adds groups within the box first, after which nearly all others add nothing.
  std::vector<std::size_t> atEdges; // other groups, of the lowest level
  const auto look = [&](const auto& self, std::size_t level, std::size_t index) -> void
  {
    const Group& group = mesh.levels[level][index];
    const Range& range = this->Ranges[level][index];
    if (!meet(group.box, steps) || !mayAdd(range, group.cellSize))
    {
      return;
    }
    if (areWithin(group.box, steps))
    {
      add(range, group.cellSize);
      return;
    }
    if (level == 0)
    {
      atEdges.push_back(index);
      return;
    }
    const std::size_t first = width * index;
    const std::size_t end = std::min(first + width, mesh.levels[level - 1].size());
    for (std::size_t i = first; i < end; ++i)
    {
      self(self, level - 1, i);
    }
  };
  look(look, mesh.levels.size() - 1, 0);
  for (const std::size_t index : atEdges)
  {
    if (!mayAdd(this->Ranges[0][index], mesh.levels[0][index].cellSize))
    {
      continue;
    }
    const std::size_t first = width * index;
    for (std::size_t i = first; i < std::min(first + width, mesh.numbers.size()); ++i)
    {
      if (this->meets(i, box, steps))
      {
        const Cell one = this->cell(mesh.numbers[i]);
        const std::array<float, 3> size = floatSizeOf(one);
        add(rangeOf(one), size.data());
      }
    }
  }
  return content;
}

/// Tests a cell of the tree's order. Depends on the cell and the box alone, not on the tree.
bool CellTree::meets(std::size_t place, const Bounds& box, const Steps& steps) const
{
  const Steps& own = this->Sorted->boxes[place];
  if (!meet(own, steps))
  {
    return false;
  }
  constexpr std::int32_t rounding = 5;
  bool isSure = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isSure = isSure && own.low[axis] <= steps.high[axis] - rounding &&
      own.high[axis] >= steps.low[axis] + rounding;
  }
  if (isSure)
  {
    return true;
  }
  const Bounds bounds = boundsOf(this->cell(this->Sorted->numbers[place]));
  bool doMeet = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    doMeet = doMeet && bounds.low[axis] <= box.high[axis] && bounds.high[axis] >= box.low[axis];
  }
  return doMeet;
}

} // namespace filters
