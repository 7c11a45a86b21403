// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/SharedPoints.h"

#include "Cells/MeshArrays.h"
#include "Common/WorkProgress.h"
#include "Input/CoincidentPoints.h"
#include "Input/DatasetPieces.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

using Leaves = std::vector<vtkSmartPointer<vtkDataSet>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the smallest edge of the visible cells of each point; -1 without any. Edges are the
/// distances of a cell's points, of the first ones in large cells.
std::vector<double> smallestEdges(const MeshArrays& mesh)
{
  constexpr double roundedAway = 1e-14;
  constexpr std::size_t most = 64;
  std::vector<std::atomic<double>> sizes(static_cast<std::size_t>(mesh.points()));
  std::fill(sizes.begin(), sizes.end(), -1);
  const auto measure = [&](vtkIdType cell, std::vector<Point>& known)
  {
    double smallest = infinity;
    known.clear();
    mesh.forPoints(cell,
      [&](vtkIdType point)
      {
        Point x;
        mesh.coordinates(point, x.data());
        for (const Point& other : known)
        {
          const double squared = dot(other - x, other - x);
          const bool isEdge = squared > roundedAway * dot(other, other) * roundedAway;
          smallest = isEdge ? std::min(smallest, squared) : smallest;
        }
        known.resize(std::min(known.size() + 1, most), x);
      });
    const double edge = std::sqrt(smallest);
    mesh.forPoints(cell,
      [&](vtkIdType point)
      {
        std::atomic<double>& size = sizes[static_cast<std::size_t>(point)];
        double before = size.load(std::memory_order_relaxed);
        while ((before < 0 || edge < before) &&
          !size.compare_exchange_weak(before, edge, std::memory_order_relaxed))
        {
        }
      });
  };
  forChunks(mesh.cells(), WorkProgress(),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<Point> known;
      for (vtkIdType cell = begin; cell < end; ++cell)
      {
        if (mesh.isVisible(cell))
        {
          measure(cell, known);
        }
      }
    });
  return { sizes.begin(), sizes.end() };
}

/// Points of visible cells, which may coincide with others, leaf by leaf in their order.
struct Candidates
{
  explicit Candidates(const Leaves& datasets)
  {
    for (std::size_t leaf = 0; leaf < datasets.size(); ++leaf)
    {
      const MeshArrays mesh(datasets[leaf]);
      const std::vector<double> edges = smallestEdges(mesh);
      const bool areOfCells = datasets[leaf]->GetCellData()->GetScalars() != nullptr;
      for (vtkIdType point = 0; point < mesh.points(); ++point)
      {
        Point x;
        mesh.coordinates(point, x.data());
        const double size = edges[static_cast<std::size_t>(point)];
        if (size >= 0 && std::isfinite(x[0] + x[1] + x[2]))
        {
          this->leaves.push_back(static_cast<std::uint32_t>(leaf));
          this->points.push_back(point);
          this->places.push_back(x);
          this->sizes.push_back(size);
          this->values.push_back(areOfCells ? std::nan("") : mesh.values()[point]);
        }
      }
      this->starts.push_back(this->points.size());
    }
  }
  std::size_t size() const { return this->points.size(); }

  std::vector<std::uint32_t> leaves;
  std::vector<vtkIdType> points;
  std::vector<Point> places;
  std::vector<double> sizes, values;    // values of points; NaN: values belong to cells
  std::vector<std::size_t> starts{ 0 }; // of the leaves
};

/// Returns the difference of values, of each leaf, beyond which its points at the same place are the
/// sides of a wall; infinite without such walls. Across the seam of an O-grid, the wake cut of a
/// C-grid and between appended pieces, values are the same but for rounding, or differ a little;
/// across walls they differ much at half of the points where they differ at all. In discontinuous
/// elements, all of whose points are double, values jump wherever the field is steep.
std::vector<double> jumpsAtWalls(
  const Leaves& leaves, const Candidates& all, const std::vector<std::int32_t>& firsts)
{
  constexpr double smallestJump = 1e-3, usualJump = 0.02; // relative to the range of values
  constexpr double smallestRange = 1e-6;                  // relative to values: rounding
  constexpr double mostDoubles = 0.25;                    // of a mesh of continuous elements
  std::vector<std::size_t> last(all.size(), all.size());  // at each place
  std::vector<double> result(leaves.size(), infinity);
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
  {
    const std::size_t begin = all.starts[leaf], end = all.starts[leaf + 1];
    std::vector<double> jumps;
    double lowest = infinity, highest = -infinity;
    for (std::size_t i = begin; i < end; ++i)
    {
      std::size_t& before = last[static_cast<std::size_t>(firsts[i])];
      if (before >= begin && before < i)
      {
        jumps.push_back(std::abs(all.values[i] - all.values[before]));
      }
      before = i;
      lowest = std::min(lowest, all.values[i]);
      highest = std::max(highest, all.values[i]);
    }
    const double range = highest - lowest;
    const auto doubles = static_cast<double>(jumps.size()),
               points = static_cast<double>(end - begin);
    if ((doubles > mostDoubles * points && !isGrid(leaves[leaf])) ||
      !(range > smallestRange * std::max(std::abs(lowest), std::abs(highest))))
    {
      continue;
    }
    jumps.erase(std::remove_if(jumps.begin(), jumps.end(),
                  [&](double jump) { return !(jump > smallestJump * range); }),
      jumps.end());
    const auto middle = jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2);
    std::nth_element(jumps.begin(), middle, jumps.end());
    if (!jumps.empty() && *middle > usualJump * range)
    {
      result[leaf] = smallestJump * range;
    }
  }
  return result;
}

/// Maps each candidate to the first one that it becomes one point with.
std::vector<std::int32_t> joinedCandidates(const Leaves& leaves, const Candidates& all)
{
  std::vector<std::int32_t> firsts = coincidentPoints(all.places, all.sizes);
  const std::vector<double> jumps = jumpsAtWalls(leaves, all, firsts);
  const auto areOne = [&](std::size_t a, std::size_t b)
  {
    const std::size_t i = all.leaves[a], j = all.leaves[b];
    return !(std::abs(all.values[a] - all.values[b]) > std::min(jumps[i], jumps[j]));
  };
  std::vector<std::int32_t> next(all.size(), -1); // other one at the same place
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    std::int32_t at = firsts[i];
    while (!areOne(static_cast<std::size_t>(at), i) && static_cast<std::size_t>(at) != i)
    {
      std::int32_t& other = next[static_cast<std::size_t>(at)];
      other = other < 0 ? static_cast<std::int32_t>(i) : other;
      at = other;
    }
    firsts[i] = at;
  }
  return firsts;
}

} // namespace

Leaves withSharedPoints(const Leaves& leaves)
{
  if (leaves.empty() ||
    (leaves.size() == 1 && isGrid(leaves[0]) && !vtkStructuredGrid::SafeDownCast(leaves[0])))
  {
    return leaves;
  }
  const Candidates all(leaves);
  if (all.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    return leaves; // too many to be numbered
  }
  const std::vector<std::int32_t> firsts = joinedCandidates(leaves, all);
  std::vector<unsigned char> hasAny(leaves.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const auto first = static_cast<std::size_t>(firsts[i]);
    if (first != i)
    {
      hasAny[all.leaves[first]] = hasAny[all.leaves[i]] = 1;
    }
  }
  Leaves result;
  JoinedLeaves joined;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
  {
    if (hasAny[leaf])
    {
      joined.leaves.push_back(leaf);
    }
    if (!hasAny[leaf] || joined.leaves.size() == 1)
    {
      result.push_back(leaves[leaf]);
    }
  }
  if (joined.leaves.empty())
  {
    return result;
  }
  std::int32_t points = 0;
  std::vector<std::int32_t> known(all.size(), -1); // of firsts
  std::vector<std::size_t> lastLeaf(all.size(), leaves.size());
  for (const std::size_t leaf : joined.leaves)
  {
    std::vector<std::int32_t>& numbers =
      joined.points.emplace_back(static_cast<std::size_t>(leaves[leaf]->GetNumberOfPoints()), -1);
    for (std::size_t i = all.starts[leaf]; i < all.starts[leaf + 1]; ++i)
    {
      const auto first = static_cast<std::size_t>(firsts[i]);
      std::int32_t& ofFirst = known[first];
      if (ofFirst < 0)
      {
        ofFirst = points++;
      }
      else if (lastLeaf[first] == leaf)
      {
        joined.doubles.push_back(ofFirst);
      }
      lastLeaf[first] = leaf;
      numbers[static_cast<std::size_t>(all.points[i])] = ofFirst;
    }
    for (std::int32_t& number : numbers)
    {
      number = number < 0 ? points++ : number;
    }
  }
  joined.count = static_cast<std::size_t>(points);
  *std::find(result.begin(), result.end(), leaves[joined.leaves[0]]) = meshOf(joined, leaves);
  return result;
}

} // namespace filters
