// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/UnsharedFaces.h"

#include "Cells/CellShape.h"
#include "Cells/MeshKey.h"
#include "Common/WorkProgress.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <tuple>

namespace filters
{

namespace
{

using Face = std::array<int, 4>; // corners; -1: none

const std::vector<Face>& facesOfShape(CellShape shape)
{
  static const std::vector<Face> all[]{
    // in the order of CellShape
    { { 0, 1, 3, -1 }, { 1, 2, 3, -1 }, { 2, 0, 3, -1 }, { 0, 2, 1, -1 } }, // tetrahedron
    { { 0, 1, 2, -1 }, { 3, 5, 4, -1 }, { 0, 3, 4, 1 }, { 1, 4, 5, 2 }, { 2, 5, 3, 0 } }, // wedge
    { { 0, 3, 2, 1 }, { 0, 1, 4, -1 }, { 1, 2, 4, -1 }, { 2, 3, 4, -1 },
      { 3, 0, 4, -1 } }, // pyramid
    { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 }, { 0, 3, 2, 1 },
      { 4, 5, 6, 7 } }, // hexahedron
    { { 2, 0, 4, 6 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 3, 2, 6, 7 }, { 1, 0, 2, 3 },
      { 4, 5, 7, 6 } } // voxel
  };
  return all[static_cast<std::size_t>(shape)];
}

/// Calls visit(the lowest point, a hash of the set of points, the face) for the faces of a cell.
template <class Visit>
void forFaces(CellShape shape, const vtkIdType (&points)[8], const Visit& visit)
{
  std::uint64_t hashes[8];
  for (int i = 0; i < cornersOf(shape); ++i)
  {
    hashes[i] = hashOfPoint(static_cast<std::uint64_t>(points[i]));
  }
  for (const Face& face : facesOfShape(shape))
  {
    vtkIdType lowest = points[face[0]];
    std::uint64_t hash = 0;
    for (const int corner : face)
    {
      if (corner >= 0)
      {
        lowest = std::min(lowest, points[corner]);
        hash += hashes[corner];
      }
    }
    visit(static_cast<std::size_t>(lowest), hash, face);
  }
}

} // namespace

std::vector<OwnedFace> unsharedFaces(const MeshArrays& mesh, const std::vector<vtkIdType>& chosen)
{
  // Of the faces whose lowest point it is: their hashes, of which those of two cells cancel.
  std::vector<std::atomic<std::uint64_t>> hashes(static_cast<std::size_t>(mesh.points()));
  const auto forCells = [&](const auto& visit)
  {
    forChunks(static_cast<vtkIdType>(chosen.size()), WorkProgress(),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const vtkIdType cell = chosen[static_cast<std::size_t>(i)];
          const CellShape shape = shapeOf(mesh.type(cell));
          vtkIdType points[8];
          mesh.points(cell, cornersOf(shape), points);
          visit(cell, shape, points);
        }
      });
  };
  forCells(
    [&](vtkIdType, CellShape shape, const vtkIdType(&points)[8])
    {
      forFaces(shape, points,
        [&](std::size_t lowest, std::uint64_t hash, const Face&)
        { hashes[lowest].fetch_xor(hash, std::memory_order_relaxed); });
    });

  struct Found
  {
    std::array<vtkIdType, 4> sorted;
    OwnedFace face;
  };
  std::vector<Found> found;
  std::mutex lock; // guards `found`
  forCells(
    [&](vtkIdType cell, CellShape shape, const vtkIdType(&points)[8])
    {
      const auto isCandidate = [&](vtkIdType point)
      { return hashes[static_cast<std::size_t>(point)].load(std::memory_order_relaxed) != 0; };
      if (std::none_of(points, points + cornersOf(shape), isCandidate))
      {
        return;
      }
      forFaces(shape, points,
        [&](std::size_t lowest, std::uint64_t, const Face& corners)
        {
          if (hashes[lowest].load(std::memory_order_relaxed) == 0)
          {
            return;
          }
          Found one{ { 0, 0, 0, std::numeric_limits<vtkIdType>::max() }, { cell, {} } };
          for (const int corner : corners)
          {
            if (corner >= 0)
            {
              one.sorted[one.face.points.size()] = points[corner];
              one.face.points.push_back(points[corner]);
            }
          }
          std::sort(one.sorted.begin(), one.sorted.end());
          const std::lock_guard<std::mutex> guard(lock);
          found.push_back(std::move(one));
        });
    });
  std::sort(found.begin(), found.end(),
    [](const Found& a, const Found& b)
    { return std::tie(a.sorted, a.face.owner) < std::tie(b.sorted, b.face.owner); });
  std::vector<OwnedFace> faces;
  for (auto first = found.begin(); first != found.end();)
  {
    const auto end = std::find_if(
      first, found.end(), [&](const Found& one) { return one.sorted != first->sorted; });
    if (end - first == 1)
    {
      faces.push_back(std::move(first->face));
    }
    first = end;
  }
  return faces;
}

} // namespace filters
