// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/SharedPoints.h"

#include "Cells/CellMeans.h"
#include "Cells/CellShape.h"
#include "Cells/MeshArrays.h"
#include "Cells/PointTrends.h"
#include "Common/CellTypes.h"
#include "Common/WorkProgress.h"
#include "Input/CoincidentPoints.h"
#include "Input/DatasetPieces.h"
#include "Input/FlatData.h"
#include "Input/GridSeams.h"
#include "Walls/BoundaryFaces.h"
#include "Walls/SheetFaces.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace filters
{

namespace
{

using Leaves = std::vector<vtkSmartPointer<vtkDataSet>>;

/// Minimum number of connected cells for sheets between them and others, which elements of
/// discontinuous methods do not reach.
constexpr std::size_t fewCells = 1000;
constexpr double fewOfAll = 0.25;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the smallest distance of corners, approximately for cells of unknown shape.
double smallestEdge(const MeshArrays& mesh, vtkIdType cell)
{
  constexpr double roundedAway = 1e-14;
  constexpr std::size_t most = 64; // limit for points without a known order
  const CellShape shape = shapeOf(mesh.type(cell));
  const bool isKnown = shape != CellShape::Other;
  const std::size_t corners = isKnown ? static_cast<std::size_t>(cornersOf(shape)) : most;
  std::array<Point, most> x;
  std::size_t count = 0;
  mesh.forPoints(cell,
    [&](vtkIdType point)
    {
      if (count < corners)
      {
        mesh.coordinates(point, x[count++].data());
      }
    });
  double smallest = infinity;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t k = i + 1; k < count; ++k)
    {
      const Point edge = x[i] - x[k];
      const double squared = dot(edge, edge);
      if (squared > roundedAway * dot(x[i], x[i]) * roundedAway)
      {
        smallest = std::min(smallest, squared);
      }
    }
  }
  return std::sqrt(smallest);
}

/// Returns the smallest edge of the visible cells of each point; -1 without any.
std::vector<double> smallestEdges(const MeshArrays& mesh)
{
  std::vector<std::atomic<double>> sizes(static_cast<std::size_t>(mesh.points()));
  std::fill(sizes.begin(), sizes.end(), -1);
  forChunks(mesh.cells(), WorkProgress(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType cell = begin; cell < end; ++cell)
      {
        if (!mesh.isVisible(cell))
        {
          continue;
        }
        const double edge = smallestEdge(mesh, cell);
        mesh.forPoints(cell,
          [&](vtkIdType point)
          {
            std::atomic<double>& size = sizes[static_cast<std::size_t>(point)];
            double known = size.load(std::memory_order_relaxed);
            while ((known < 0 || edge < known) &&
              !size.compare_exchange_weak(known, edge, std::memory_order_relaxed))
            {
            }
          });
      }
    });
  return { sizes.begin(), sizes.end() };
}

/// Points that may coincide with those of other leaves.
struct Candidates
{
  std::vector<std::uint32_t> leaves;
  std::vector<vtkIdType> points;
  std::vector<Point> places;
  std::vector<double> sizes;

  std::size_t size() const { return this->points.size(); }
  void reserve(std::size_t count)
  {
    this->leaves.reserve(count);
    this->points.reserve(count);
    this->places.reserve(count);
    this->sizes.reserve(count);
  }
};

/// Returns whether other boxes intersect this leaf's, or a ghost array hides cells: then points
/// within grids may coincide with others.
bool mayOverlap(const Leaves& leaves, std::size_t number)
{
  const double* a = leaves[number]->GetBounds();
  for (std::size_t other = 0; other < leaves.size(); ++other)
  {
    const double* b = leaves[other]->GetBounds();
    bool isApart = other == number;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double low = std::max(a[2 * axis], b[2 * axis]);
      const double high = std::min(a[2 * axis + 1], b[2 * axis + 1]);
      isApart = isApart || !(high - low > 1e-6 * (a[2 * axis + 1] - a[2 * axis]));
    }
    if (!isApart)
    {
      return true;
    }
  }
  return false;
}

bool hasHiddenCells(const MeshArrays& mesh)
{
  for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
  {
    if (!mesh.isVisible(cell))
    {
      return true;
    }
  }
  return false;
}

void addCandidates(
  const Leaves& leaves, std::size_t number, const MeshArrays& mesh, Candidates& all)
{
  const auto add = [&](vtkIdType point, double size)
  {
    Point x;
    mesh.coordinates(point, x.data());
    if (std::isfinite(x[0] + x[1] + x[2]))
    {
      all.leaves.push_back(static_cast<std::uint32_t>(number));
      all.points.push_back(point);
      all.places.push_back(x);
      all.sizes.push_back(size);
    }
  };
  if (mesh.isStructured() && !hasHiddenCells(mesh) && !mayOverlap(leaves, number))
  {
    const std::array<int, 3> n = structureOf(leaves[number]);
    for (vtkIdType k = 0, point = 0; k < n[2]; ++k)
    {
      for (vtkIdType j = 0; j < n[1]; ++j)
      {
        const bool isOuterRow = k == 0 || k == n[2] - 1 || j == 0 || j == n[1] - 1;
        for (vtkIdType i = 0; i < n[0]; i += isOuterRow ? 1 : n[0] - 1)
        {
          double size = infinity;
          mesh.forCellsAround(
            point + i, [&](vtkIdType cell) { size = std::min(size, smallestEdge(mesh, cell)); });
          add(point + i, size);
        }
        point += n[0];
      }
    }
    return;
  }
  all.reserve(all.size() + static_cast<std::size_t>(mesh.points()));
  const std::vector<double> sizes = smallestEdges(mesh);
  for (vtkIdType point = 0; point < mesh.points(); ++point)
  {
    if (sizes[static_cast<std::size_t>(point)] >= 0)
    {
      add(point, sizes[static_cast<std::size_t>(point)]);
    }
  }
}

/// Of the points of a mesh: whether they belong to so many cells that hang together that walls may be between them.
std::vector<unsigned char> maySheetsMeet(const MeshArrays& mesh)
{
  const auto points = static_cast<std::size_t>(mesh.points());
  if (mesh.isStructured() && !hasHiddenCells(mesh)) // all of them hang together
  {
    return std::vector<unsigned char>(points, 1);
  }
  Classes parts(points);
  std::vector<std::size_t> cells(points, 0);
  std::size_t all = 0;
  const auto forCells = [&](const auto& visit)
  {
    for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
    {
      if (mesh.isVisible(cell))
      {
        vtkIdType first = -1;
        mesh.forPoints(cell,
          [&](vtkIdType point)
          {
            first = first < 0 ? point : first;
            visit(static_cast<std::size_t>(first), static_cast<std::size_t>(point));
          });
      }
    }
  };
  forCells([&](std::size_t first, std::size_t point) { parts.join(first, point); });
  forCells(
    [&](std::size_t first, std::size_t point)
    {
      if (first == point)
      {
        ++cells[parts.rootOf(first)];
        ++all;
      }
    });
  std::vector<unsigned char> may(points);
  for (std::size_t i = 0; i < points; ++i)
  {
    const std::size_t count = cells[parts.rootOf(i)];
    may[i] = count >= fewCells || static_cast<double>(count) >= fewOfAll * static_cast<double>(all);
  }
  return may;
}

/// Returns whether a grid has a seam; images and rectilinear grids have none.
bool hasSeam(vtkDataSet* grid)
{
  if (!vtkStructuredGrid::SafeDownCast(grid))
  {
    return false;
  }
  const std::array<int, 6> whole = extentOf(grid, false);
  OuterPoints points;
  addOuterPoints(grid, whole, points);
  return filters::hasSeam(points, whole);
}

/// Sets point values from cells as seen from one side, exact for smooth fields.
void setValuesForSheets(vtkDataSet* leaf)
{
  if (!leaf->GetCellData()->GetScalars())
  {
    return;
  }
  bringToPoints(leaf, true);
  const MeshArrays mesh(leaf);
  std::vector<unsigned char> isUsed(static_cast<std::size_t>(mesh.cells()));
  for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
  {
    isUsed[static_cast<std::size_t>(cell)] = mesh.isVisible(cell) ? 1 : 0;
  }
  const std::vector<double> values = PointNeighbours(mesh, isUsed).valuesFromCells(mesh);
  std::copy(values.begin(), values.end(),
    vtkDoubleArray::SafeDownCast(leaf->GetPointData()->GetScalars())->GetPointer(0));
  leaf->GetPointData()->RemoveArray(cellsAroundName);
}

/// Merges candidates that coincide, where that is allowed.
class Joiner
{
public:
  Joiner(const Leaves& leaves, const std::vector<MeshArrays>& meshes, int dimension,
    const Candidates& candidates, const std::vector<std::vector<bool>>& kinds)
    : All(candidates)
    , Numbers(candidates.size())
  {
    const std::vector<std::int32_t> coincident = coincidentPoints(candidates.places,
      mergingTolerances(candidates.places, candidates.sizes, relativeRounding(candidates.places)));
    this->Coincident.assign(coincident.begin(), coincident.end());
    this->divideBy(kinds);
    this->findPointsApart(leaves, meshes, dimension);
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      if (!this->hasPointApart(i))
      {
        this->Numbers.join(this->Coincident[i], i);
      }
    }
  }

  Classes& numbers() { return this->Numbers; }

private:
  /// Separates coincident points by kind.
  void divideBy(const std::vector<std::vector<bool>>& kinds)
  {
    if (kinds.empty())
    {
      return;
    }
    std::map<std::pair<std::size_t, std::vector<bool>>, std::size_t> firsts;
    for (std::size_t i = 0; i < this->Coincident.size(); ++i)
    {
      this->Coincident[i] =
        firsts.try_emplace({ this->Coincident[i], kinds[this->All.leaves[i]] }, i).first->second;
    }
  }

  bool hasPointApart(std::size_t i) const
  {
    return !this->IsApart.empty() && this->IsApart[this->Coincident[i]] != 0;
  }

  /// Returns the index of a candidate; those of a leaf are contiguous, in the points' order.
  std::size_t candidateOf(std::size_t leaf, vtkIdType point) const
  {
    const auto first = std::lower_bound(this->All.leaves.begin(), this->All.leaves.end(), leaf);
    const auto last = std::upper_bound(first, this->All.leaves.end(), leaf);
    const auto begin = this->All.points.begin();
    return static_cast<std::size_t>(std::lower_bound(begin + (first - this->All.leaves.begin()),
                                      begin + (last - this->All.leaves.begin()), point) -
      begin);
  }

  void findPointsApart(const Leaves& leaves, const std::vector<MeshArrays>& meshes, int dimension)
  {
    // Marks points of leaves that have two of them at one position, between cells with possible
    // sheets.
    std::vector<std::vector<unsigned char>> may(leaves.size());
    std::vector<unsigned char> isDouble(this->All.size(), 0);
    std::vector<std::size_t> last(this->All.size(), this->All.size()); // of each position
    std::vector<std::size_t> doubles;
    for (std::size_t i = 0; i < this->All.size(); ++i)
    {
      std::size_t& before = last[this->Coincident[i]];
      if (before < i && this->All.leaves[before] == this->All.leaves[i])
      {
        const std::size_t leaf = this->All.leaves[i];
        if (may[leaf].empty())
        {
          may[leaf] = maySheetsMeet(meshes[leaf]);
        }
        if (may[leaf][static_cast<std::size_t>(this->All.points[i])] &&
          may[leaf][static_cast<std::size_t>(this->All.points[before])])
        {
          doubles.push_back(i);
        }
      }
      before = i;
    }
    if (doubles.empty())
    {
      return;
    }
    this->IsApart.assign(this->All.size(), 0);
    // Skips leaves of flat cells, whose sheets are unknown.
    bool areFacesKnown = false;
    for (const std::size_t i : doubles)
    {
      const bool isKnown = dimension == 3;
      areFacesKnown = areFacesKnown || isKnown;
      this->IsApart[this->Coincident[i]] = isKnown ? 0 : 1;
    }
    if (areFacesKnown)
    {
      this->findSheetPoints(leaves, may);
    }
  }

  void findSheetPoints(const Leaves& leaves, const std::vector<std::vector<unsigned char>>& may)
  {
    std::vector<vtkDataSet*> pointers(leaves.begin(), leaves.end());
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
    {
      if (!may[leaf].empty())
      {
        setValuesForSheets(leaves[leaf]);
      }
    }
    const CutFaces cuts = cutFacesOf(pointers, WorkProgress());
    std::vector<double> values = valuesAt(cuts.firstContributions, cuts.contributions, pointers);
    const auto mayBeSheet = [&](std::size_t corner)
    {
      const Contribution *of = &cuts.contributions[2 * corner], *other = of + 1;
      const std::vector<unsigned char>& mayMeet = may[of->leaf];
      return of->leaf == other->leaf && !mayMeet.empty() &&
        mayMeet[static_cast<std::size_t>(of->point)] &&
        mayMeet[static_cast<std::size_t>(other->point)];
    };
    for (std::size_t corner = 0; 2 * corner < values.size(); ++corner)
    {
      if (!mayBeSheet(corner))
      {
        values[2 * corner + 1] = values[2 * corner];
      }
    }
    const std::vector<unsigned char> areSheets = findSheets(cuts, values);
    const auto sideOf = [&](std::size_t corner, std::size_t side)
    {
      const Contribution& of = cuts.contributions[2 * corner + side];
      return this->candidateOf(of.leaf, of.point);
    };
    for (std::size_t face = 0; face < cuts.size(); ++face)
    {
      for (std::size_t i = cuts.starts[face]; i < cuts.starts[face + 1]; ++i)
      {
        if (areSheets[face])
        {
          this->IsApart[this->Coincident[sideOf(i, 0)]] = 1;
          this->IsApart[this->Coincident[sideOf(i, 1)]] = 1;
        }
        else if (this->Coincident[sideOf(i, 0)] == this->Coincident[sideOf(i, 1)])
        {
          this->Numbers.join(sideOf(i, 0), sideOf(i, 1));
        }
      }
    }
  }

  const Candidates& All;
  std::vector<std::size_t> Coincident; // first candidate at the same position
  std::vector<unsigned char> IsApart;  // of the candidates; empty: none
  Classes Numbers;
};

/// Returns the leaves that share points, directly or by others, in groups.
std::vector<std::vector<std::size_t>> groupsOf(
  std::size_t leaves, const Candidates& candidates, Classes& numbers)
{
  Classes groups(leaves);
  std::vector<unsigned char> hasAny(leaves, 0);
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const std::size_t root = numbers.rootOf(i);
    if (root != i)
    {
      groups.join(candidates.leaves[root], candidates.leaves[i]);
      hasAny[candidates.leaves[root]] = hasAny[candidates.leaves[i]] = 1;
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t leaf = 0; leaf < leaves; ++leaf)
  {
    if (hasAny[leaf])
    {
      members[groups.rootOf(leaf)].push_back(leaf);
    }
  }
  std::vector<std::vector<std::size_t>> result;
  for (auto& group : members)
  {
    result.push_back(std::move(group.second));
  }
  return result;
}

} // namespace

SharedPoints::SharedPoints(
  const Leaves& leaves, int dimension, const std::vector<std::vector<bool>>& kinds)
{
  if (leaves.empty() || (leaves.size() == 1 && isGrid(leaves[0]) && !hasSeam(leaves[0])))
  {
    return;
  }
  std::vector<MeshArrays> meshes;
  meshes.reserve(leaves.size());
  Candidates candidates;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
  {
    meshes.emplace_back(leaves[leaf]);
    addCandidates(leaves, leaf, meshes[leaf], candidates);
  }
  if (candidates.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    return; // too many to be numbered
  }
  Joiner joiner(leaves, meshes, dimension, candidates, kinds);
  std::vector<std::int32_t> known(candidates.size(), -1); // of roots
  for (std::vector<std::size_t>& some : groupsOf(leaves.size(), candidates, joiner.numbers()))
  {
    Group group;
    group.leaves = std::move(some);
    for (const std::size_t leaf : group.leaves)
    {
      std::vector<std::int32_t>& numbers =
        group.numbers.emplace_back(static_cast<std::size_t>(meshes[leaf].points()), -1);
      const auto first = std::lower_bound(candidates.leaves.begin(), candidates.leaves.end(), leaf);
      auto candidate = static_cast<std::size_t>(first - candidates.leaves.begin());
      for (; candidate < candidates.size() && candidates.leaves[candidate] == leaf; ++candidate)
      {
        std::int32_t& ofRoot = known[joiner.numbers().rootOf(candidate)];
        if (ofRoot < 0)
        {
          ofRoot = static_cast<std::int32_t>(group.points++);
        }
        numbers[static_cast<std::size_t>(candidates.points[candidate])] = ofRoot;
      }
      for (std::int32_t& number : numbers)
      {
        if (number < 0)
        {
          number = static_cast<std::int32_t>(group.points++);
        }
      }
    }
    this->addGroup(leaves, std::move(group));
  }
}

} // namespace filters
