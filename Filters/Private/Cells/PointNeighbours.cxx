// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/PointNeighbours.h"

#include "Common/Vectors.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

namespace filters
{

namespace
{

/// Up to how many points of the cells around a point, and this one, are too few to find second derivatives in all
/// directions: where cells are tetrahedra and where they have six corners and more, of which 18 lie in two layers at a
/// boundary.
constexpr std::size_t fewOfTetrahedra = 14, fewOfHexahedra = 18;

/// Cells of points: those of point i are cells[starts[i]] to cells[starts[i + 1]], in order.
struct CellsOfPoints
{
  std::vector<std::uint64_t> starts;
  std::vector<std::uint32_t> cells;
};

CellsOfPoints cellsOfPoints(const MeshArrays& mesh, const std::vector<unsigned char>& isCellUsed,
  const WorkProgress& progress)
{
  const auto points = static_cast<std::size_t>(mesh.points());
  std::vector<std::atomic<std::uint32_t>> counts(points);
  const auto forCells = [&](const WorkProgress& done, const auto& visit)
  {
    forChunks(mesh.cells(), done,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType cell = begin; cell < end; ++cell)
        {
          if (isCellUsed[static_cast<std::size_t>(cell)])
          {
            mesh.forPoints(
              cell, [&](vtkIdType point) { visit(cell, static_cast<std::size_t>(point)); });
          }
        }
      });
  };
  forCells(progress.part(0, 0.3),
    [&](vtkIdType, std::size_t point) { counts[point].fetch_add(1, std::memory_order_relaxed); });
  CellsOfPoints result;
  result.starts.resize(points + 1);
  for (std::size_t i = 0; i < points; ++i)
  {
    result.starts[i + 1] = result.starts[i] + counts[i].load(std::memory_order_relaxed);
  }
  result.cells.resize(result.starts.back());
  // Fills from behind, then sorts, so that the order does not depend on threads.
  forCells(progress.part(0.3, 0.7),
    [&](vtkIdType cell, std::size_t point)
    {
      const std::uint32_t left = counts[point].fetch_sub(1, std::memory_order_relaxed);
      result.cells[result.starts[point] + left - 1] = static_cast<std::uint32_t>(cell);
    });
  forChunks(mesh.points(), progress.part(0.7, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      const auto placeOf = [&](vtkIdType point)
      {
        return result.cells.begin() +
          static_cast<std::ptrdiff_t>(result.starts[static_cast<std::size_t>(point)]);
      };
      for (vtkIdType point = begin; point < end; ++point)
      {
        std::sort(placeOf(point), placeOf(point + 1));
      }
    });
  return result;
}

/// Finds the points of all cells around a point, which is the first of them. If these are few tetrahedra those of all cells
/// around these; if few other cells, those around the nearest of the points that have the most cells, if more than this one
/// (all that are as near): a third layer behind a boundary, and no wider ones along it.
/// `forCells(point, visit)` visits the numbers of the cells around a point.
template <class ForCells>
void findNeighbours(
  const MeshArrays& mesh, const ForCells& forCells, vtkIdType point, PointSet& found)
{
  found.clear();
  found.add(static_cast<std::uint32_t>(point));
  std::size_t cells = 0, corners = 0;
  const auto addAround = [&](std::uint32_t known)
  {
    forCells(static_cast<vtkIdType>(known),
      [&](vtkIdType cell)
      {
        ++cells;
        mesh.forPoints(cell,
          [&](vtkIdType other)
          {
            ++corners;
            found.add(static_cast<std::uint32_t>(other));
          });
      });
  };
  addAround(found.points()[0]);
  const std::size_t end = found.points().size();
  const std::size_t own = cells;
  const bool areTetrahedra = corners < 6 * own;
  if (end > (areTetrahedra ? fewOfTetrahedra : fewOfHexahedra))
  {
    return;
  }
  if (areTetrahedra)
  {
    for (std::size_t i = 1; i < end; ++i)
    {
      addAround(found.points()[i]);
    }
    return;
  }
  Vector here;
  mesh.coordinates(point, here.data());
  const auto squareTo = [&](std::uint32_t other)
  {
    Vector there;
    mesh.coordinates(static_cast<vtkIdType>(other), there.data());
    return dot(there - here, there - here);
  };
  const auto cellsAround = [&](std::uint32_t other)
  {
    std::size_t count = 0;
    forCells(static_cast<vtkIdType>(other), [&](vtkIdType) { ++count; });
    return count;
  };
  std::size_t most = 0;
  double nearest = 0;
  for (std::size_t i = 1; i < end; ++i)
  {
    const std::uint32_t other = found.points()[i];
    const std::size_t count = cellsAround(other);
    const double square = squareTo(other);
    if (count > most || (count == most && square < nearest))
    {
      most = count;
      nearest = square;
    }
  }
  constexpr double asNear = 1.001;
  for (std::size_t i = 1; i < end && most > own; ++i)
  {
    const std::uint32_t other = found.points()[i];
    if (cellsAround(other) == most && squareTo(other) <= asNear * nearest)
    {
      addAround(other);
    }
  }
}

} // namespace

PointNeighbours::PointNeighbours(
  const MeshArrays& mesh, std::vector<unsigned char> isCellUsed, const WorkProgress& progress)
{
  if (mesh.isStructured())
  {
    this->IsCellUsed = std::move(isCellUsed);
    return;
  }
  const CellsOfPoints known = cellsOfPoints(mesh, isCellUsed, progress.part(0, 0.3));
  const vtkIdType points = mesh.points();
  this->Chunks.resize(static_cast<std::size_t>((points + chunkSize - 1) / chunkSize));
  this->Ends.resize(static_cast<std::size_t>(points));
  forChunks(points, progress.part(0.3, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      PointSet found;
      std::vector<std::uint32_t> ids;
      const auto forCells = [&](vtkIdType point, const auto& visit)
      {
        const auto at = static_cast<std::size_t>(point);
        for (std::uint64_t i = known.starts[at]; i < known.starts[at + 1]; ++i)
        {
          visit(static_cast<vtkIdType>(known.cells[i]));
        }
      };
      for (vtkIdType point = begin; point < end; ++point)
      {
        findNeighbours(mesh, forCells, point, found);
        ids.insert(ids.end(), found.points().begin() + 1, found.points().end());
        this->Ends[static_cast<std::size_t>(point)] = static_cast<std::uint32_t>(ids.size());
      }
      this->Chunks[static_cast<std::size_t>(begin / chunkSize)].assign(ids.begin(), ids.end());
    });
}

PointNeighbours::Range PointNeighbours::of(
  const MeshArrays& mesh, vtkIdType point, PointSet& memory) const
{
  if (mesh.isStructured())
  {
    const auto forCells = [&](vtkIdType around, const auto& visit)
    {
      mesh.forCellsAround(around,
        [&](vtkIdType cell)
        {
          if (this->IsCellUsed[static_cast<std::size_t>(cell)])
          {
            visit(cell);
          }
        });
    };
    findNeighbours(mesh, forCells, point, memory);
    const std::uint32_t* ids = memory.points().data();
    return { ids + 1, ids + memory.points().size() };
  }
  const auto at = static_cast<std::size_t>(point);
  const std::uint32_t* ids = this->Chunks[static_cast<std::size_t>(point / chunkSize)].data();
  return { point % chunkSize == 0 ? ids : ids + this->Ends[at - 1], ids + this->Ends[at] };
}

std::size_t PointNeighbours::bytes() const
{
  const std::size_t ids =
    std::accumulate(this->Chunks.begin(), this->Chunks.end(), std::size_t{ 0 },
      [](std::size_t sum, const std::vector<std::uint32_t>& chunk) { return sum + chunk.size(); });
  return (ids + this->Ends.size()) * sizeof(std::uint32_t) + this->IsCellUsed.size();
}

} // namespace filters
