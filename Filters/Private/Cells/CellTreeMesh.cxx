// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Makes what a CellTree needs of the mesh alone: its cells in order, and the hierarchy of boxes.
#include "Cells/CellTree.h"

#include "Cells/MeshKey.h"

#include "vtkDataSet.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Steps along each axis: those of 32 bits, with room for sums.
constexpr double steps = 1 << 30;

/// Bits of each coordinate of a point on the Hilbert curve.
constexpr int curveBits = 21;

// Voxels have the size that this fraction of cells is below. Proportions near to cubes' become
// cubes'; the maximum is 1:32.
constexpr double fractionOfSmallerCells = 0.1;
constexpr double nearlyEqual = 1.5;
constexpr double flattest = 1. / 32;
constexpr std::size_t maxCellsMeasured = 100000;

/// Returns the index of a point on the Hilbert curve (J. Skilling, Programming the Hilbert curve,
/// AIP Conf. Proc. 707, 2004, pp. 381-387).
std::uint64_t placeOnCurve(const std::int32_t middle[3])
{
  std::uint32_t x[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    x[axis] = static_cast<std::uint32_t>(middle[axis]) >> (30 - curveBits);
    x[axis] = std::min(x[axis], (1u << curveBits) - 1);
  }
  for (std::uint32_t bit = 1u << (curveBits - 1); bit > 1; bit >>= 1)
  {
    const std::uint32_t lower = bit - 1;
    for (std::uint32_t& along : x)
    {
      if (along & bit)
      {
        x[0] ^= lower;
      }
      else
      {
        const std::uint32_t exchanged = (x[0] ^ along) & lower;
        x[0] ^= exchanged;
        along ^= exchanged;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flips = 0;
  for (std::uint32_t bit = 1u << (curveBits - 1); bit > 1; bit >>= 1)
  {
    flips ^= (x[2] & bit) ? bit - 1 : 0;
  }
  std::uint64_t place = 0;
  for (int bit = curveBits - 1; bit >= 0; --bit)
  {
    for (const std::uint32_t along : x)
    {
      place = place << 1 | (((along ^ flips) >> bit) & 1);
    }
  }
  return place;
}

/// Returns an order below which evenly spread cells are 10 % more than needed.
std::uint64_t highestOrder(std::int64_t cells)
{
  const double part = 1.1 * static_cast<double>(maxCellsMeasured) / static_cast<double>(cells);
  return part < 1 ? static_cast<std::uint64_t>(std::ldexp(part, 64))
                  : std::numeric_limits<std::uint64_t>::max();
}

/// Keeps as many of the measured cells as are needed.
void keepLowest(std::vector<CellTree::MeasuredCell>& cells)
{
  const std::size_t count = std::min(cells.size(), maxCellsMeasured);
  std::partial_sort(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(count), cells.end(),
    [](const CellTree::MeasuredCell& a, const CellTree::MeasuredCell& b)
    { return std::tie(a.order, a.size) < std::tie(b.order, b.size); });
  cells.resize(count);
}

} // namespace

std::array<float, 3> CellTree::floatSizeOf(const Cell& cell)
{
  const Vector size = sizeOf(cell);
  return { static_cast<float>(size[0]), static_cast<float>(size[1]), static_cast<float>(size[2]) };
}

/// Returns bounds that are not finite if a point or a value is not.
CellTree::Bounds CellTree::boundsOf(const Cell& cell)
{
  Bounds bounds{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  double sum = 0; // detects NaN, which minimum and maximum may lose
  cell.block->forPoints(cell.id,
    [&](vtkIdType point)
    {
      double x[3];
      cell.block->coordinates(point, x);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        bounds.low[axis] = std::min(bounds.low[axis], x[axis]);
        bounds.high[axis] = std::max(bounds.high[axis], x[axis]);
      }
      sum += (x[0] + x[1] + x[2] + cell.block->values()[point]) * 0;
    });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    bounds.low[axis] += sum;
    bounds.high[axis] += sum;
  }
  return bounds;
}

/// Finds the cells of the tree, and their common box.
void CellTree::findCells(Mesh& mesh, Copies copies, const WorkProgress& progress)
{
  const Number end = mesh.firstNumbers.back();
  const std::size_t count = (std::size_t{ end } + chunkSize - 1) / chunkSize;
  std::vector<std::vector<Number>> found(count), foundCopies(count);
  std::vector<Bounds> boxes(
    count, Bounds{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } });
  forChunks(end, progress,
    [&](vtkIdType begin, vtkIdType last)
    {
      const auto i = static_cast<std::size_t>(begin / chunkSize);
      for (auto number = static_cast<Number>(begin); number < static_cast<Number>(last); ++number)
      {
        const Cell one = this->cell(number);
        if (!one.block->isVisible(one.id) || shapeOf(one.block->type(one.id)) == CellShape::Other)
        {
          continue;
        }
        const Bounds bounds = boundsOf(one);
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          sum += (bounds.high[axis] - bounds.low[axis]) * 0;
        }
        if (sum != 0) // NaN: a value is not finite, or there are no points
        {
          continue;
        }
        if (copies == Copies::Neighbours && one.block->isCopy(one.id))
        {
          foundCopies[i].push_back(number);
          continue;
        }
        found[i].push_back(number);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          boxes[i].low[axis] = std::min(boxes[i].low[axis], bounds.low[axis]);
          boxes[i].high[axis] = std::max(boxes[i].high[axis], bounds.high[axis]);
        }
      }
    });
  mesh.whole = { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  std::size_t sum = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += found[i].size();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      mesh.whole.low[axis] = std::min(mesh.whole.low[axis], boxes[i].low[axis]);
      mesh.whole.high[axis] = std::max(mesh.whole.high[axis], boxes[i].high[axis]);
    }
  }
  mesh.numbers.reserve(sum);
  for (const std::vector<Number>& some : found)
  {
    mesh.numbers.insert(mesh.numbers.end(), some.begin(), some.end());
  }
  for (const std::vector<Number>& some : foundCopies)
  {
    mesh.copies.insert(mesh.copies.end(), some.begin(), some.end());
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = mesh.whole.high[axis] - mesh.whole.low[axis];
    mesh.step[axis] = length > 0 && length < infinity ? length / (steps - 4) : 1;
    mesh.origin[axis] = mesh.whole.low[axis] - 2 * mesh.step[axis];
  }
}

void CellTree::findNeighbours(Mesh& mesh, const WorkProgress& progress)
{
  for (std::size_t block = 0; block < this->Blocks.size(); ++block)
  {
    const Number first = mesh.firstNumbers[block];
    std::vector<unsigned char> isThere(static_cast<std::size_t>(this->Blocks[block].cells()));
    for (const std::vector<Number>* some : { &mesh.numbers, &mesh.copies })
    {
      for (auto i = std::lower_bound(some->begin(), some->end(), first);
           i != some->end() && *i < mesh.firstNumbers[block + 1]; ++i)
      {
        isThere[*i - first] = 1;
      }
    }
    const auto parts = static_cast<double>(this->Blocks.size());
    mesh.neighbours.emplace_back(this->Blocks[block], std::move(isThere),
      progress.part(static_cast<double>(block) / parts, static_cast<double>(block + 1) / parts));
  }
}

void CellTree::sortCells(Mesh& mesh, const WorkProgress& progress)
{
  using Entry = std::pair<std::uint64_t, Number>;
  const std::size_t count = mesh.numbers.size();
  std::vector<Entry> entries(count);
  forChunks(static_cast<vtkIdType>(count), progress.part(0, 0.4),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        const Steps box = this->stepsOf(boundsOf(this->cell(mesh.numbers[i])));
        std::int32_t middle[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          middle[axis] = std::max(0, box.low[axis] + (box.high[axis] - box.low[axis]) / 2);
        }
        entries[i] = { placeOnCurve(middle), mesh.numbers[i] };
      }
    });
  vtkSMPTools::Sort(entries.begin(), entries.end());
  progress.reach(1);
  for (std::size_t i = 0; i < count; ++i)
  {
    mesh.numbers[i] = entries[i].second;
  }
}

void CellTree::makeGroups(Mesh& mesh, const WorkProgress& progress)
{
  const std::size_t count = mesh.numbers.size();
  if (count == 0)
  {
    return;
  }
  mesh.boxes.resize(count);
  mesh.levels.emplace_back((count + width - 1) / width);
  forChunks(static_cast<vtkIdType>(mesh.levels[0].size()), progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto group = static_cast<std::size_t>(begin); group < static_cast<std::size_t>(end);
           ++group)
      {
        float* const sizes = mesh.levels[0][group].cellSize;
        std::fill_n(sizes, 3, std::numeric_limits<float>::infinity());
        for (std::size_t i = width * group; i < std::min(count, width * (group + 1)); ++i)
        {
          const Cell one = this->cell(mesh.numbers[i]);
          mesh.boxes[i] = this->stepsOf(boundsOf(one));
          const std::array<float, 3> size = floatSizeOf(one);
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            sizes[axis] = std::min(sizes[axis], size[axis]);
          }
        }
      }
    });

  const auto addBox = [](const Steps& from, Steps& to, bool isFirst)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      to.low[axis] = isFirst ? from.low[axis] : std::min(to.low[axis], from.low[axis]);
      to.high[axis] = isFirst ? from.high[axis] : std::max(to.high[axis], from.high[axis]);
    }
  };
  for (std::size_t i = 0; i < count; ++i)
  {
    addBox(mesh.boxes[i], mesh.levels[0][i / width].box, i % width == 0);
  }
  while (mesh.levels.back().size() > 1)
  {
    const std::vector<Group>& below = mesh.levels.back();
    std::vector<Group> level((below.size() + width - 1) / width);
    for (std::size_t i = 0; i < below.size(); ++i)
    {
      Group& group = level[i / width];
      const bool isFirst = i % width == 0;
      addBox(below[i].box, group.box, isFirst);
      for (int axis = 0; axis < 3; ++axis)
      {
        group.cellSize[axis] = isFirst ? below[i].cellSize[axis]
                                       : std::min(group.cellSize[axis], below[i].cellSize[axis]);
      }
    }
    mesh.levels.push_back(std::move(level));
  }
}

std::vector<CellTree::MeasuredCell> CellTree::measuredCells(std::int64_t cellsOfAll) const
{
  std::vector<MeasuredCell> cells;
  std::mutex lock; // guards the measured cells
  const std::uint64_t highest = highestOrder(cellsOfAll);
  const std::size_t count = this->Sorted->numbers.size();
  forChunks(static_cast<vtkIdType>(count), WorkProgress(),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<MeasuredCell> measured;
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        this->fetchAhead(i, count, [](std::size_t place) { return place; });
        const Cell one = this->cell(this->number(i));
        const Bounds bounds = boundsOf(one);
        Hash hash;
        hash.add(bounds.low.data(), 3);
        hash.add(bounds.high.data(), 3);
        if (hash.value() <= highest)
        {
          measured.push_back({ hash.value(), sizeOf(one) });
        }
      }
      const std::lock_guard<std::mutex> guard(lock);
      cells.insert(cells.end(), measured.begin(), measured.end());
    });
  return cells;
}

/// Computes voxelShape().
Vector CellTree::voxelShapeOf(std::vector<MeasuredCell> cells)
{
  keepLowest(cells);
  Vector shape = { 1, 1, 1 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::vector<double> sizes;
    for (const MeasuredCell& cell : cells)
    {
      if (cell.size[axis] < infinity)
      {
        sizes.push_back(cell.size[axis]);
      }
    }
    if (sizes.empty())
    {
      return { 1, 1, 1 };
    }
    const auto place = sizes.begin() +
      static_cast<std::ptrdiff_t>(fractionOfSmallerCells * static_cast<double>(sizes.size()));
    std::nth_element(sizes.begin(), place, sizes.end());
    shape[axis] = *place;
  }
  const double largest = *std::max_element(shape.begin(), shape.end());
  for (double& along : shape)
  {
    along = std::max(along / largest, flattest);
    along = along * nearlyEqual >= 1 ? 1 : along;
  }
  return shape;
}

CellTree::Steps CellTree::stepsOf(const Bounds& box) const
{
  Steps result;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto place = [&](double x)
    { return std::clamp((x - this->origin()[axis]) / this->step()[axis], -2., steps + 2); };
    result.low[axis] = static_cast<std::int32_t>(std::floor(place(box.low[axis]))) - 1;
    result.high[axis] = static_cast<std::int32_t>(std::floor(place(box.high[axis]))) + 2;
  }
  return result;
}

} // namespace filters
