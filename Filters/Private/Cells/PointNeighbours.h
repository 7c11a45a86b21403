// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/MeshArrays.h"
#include "Common/WorkProgress.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

/// A set of points in the order of insertion: a hash table with open addressing.
class PointSet
{
public:
  const std::vector<std::uint32_t>& points() const { return this->Points; }

  void clear()
  {
    ++this->Turn;
    this->Points.clear();
  }

  void add(std::uint32_t point)
  {
    if (2 * this->Points.size() >= this->Places.size())
    {
      this->Places.assign(2 * this->Places.size(), 0);
      for (const std::uint32_t known : this->Points)
      {
        this->isNew(known);
      }
    }
    if (this->isNew(point))
    {
      this->Points.push_back(point);
    }
  }

private:
  bool isNew(std::uint32_t point)
  {
    const std::uint64_t entry = this->Turn << 32 | point;
    const std::size_t last = this->Places.size() - 1;
    std::size_t place = (point * 0x9e3779b97f4a7c15u >> 32) & last;
    while (this->Places[place] >> 32 == this->Turn)
    {
      if (this->Places[place] == entry)
      {
        return false;
      }
      place = (place + 1) & last;
    }
    this->Places[place] = entry;
    return true;
  }

  std::uint64_t Turn = 1; // marks valid entries
  std::vector<std::uint32_t> Points;
  std::vector<std::uint64_t> Places = std::vector<std::uint64_t>(256, 0); // a power of two
};

/**
 * Which points are around each point of a mesh: those of the same cells, and where these are few some of the cells
 * beside them, too. It depends on the mesh alone. (The weights of a fit through them would be ten times as many
 * numbers, and are found faster than they are read.)
 */
class PointNeighbours
{
public:
  /// Uses cells whose `isCellUsed` is not 0.
  PointNeighbours(const MeshArrays& mesh, std::vector<unsigned char> isCellUsed,
    const WorkProgress& progress = WorkProgress());

  struct Range
  {
    const std::uint32_t *first, *last;
    const std::uint32_t* begin() const { return this->first; }
    const std::uint32_t* end() const { return this->last; }
  };
  /// Returns the neighbours of a point of a mesh with the same points and cells. They are valid until `memory` is used again.
  Range of(const MeshArrays& mesh, vtkIdType point, PointSet& memory) const;

  std::size_t bytes() const;

private:
  // Neighbours of the points of each chunk, see forChunks(), and where those of each point end in
  // it. Structured grids have none, whose cells are found as fast.
  std::vector<std::vector<std::uint32_t>> Chunks;
  std::vector<std::uint32_t> Ends;
  std::vector<unsigned char> IsCellUsed; // for structured grids
};

} // namespace filters
