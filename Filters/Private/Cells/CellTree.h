// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellShape.h"
#include "Cells/MeshArrays.h"
#include "Cells/PointTrends.h"
#include "Common/WorkProgress.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkDataSet;

namespace filters
{

/**
 * The 3-D cells of several datasets, sorted by position, in a hierarchy of bounding boxes: those of
 * known shapes (see CellShape.h); others are ignored.
 *
 * Cells are in the order of a Hilbert curve. Eight cells in a row form a group, eight groups a
 * larger one, and so on: without pointers, about 40 bytes for each cell. VTK's locators do not know
 * values, and find the cell of one point at a time: for 1.9 million points of a far field of 1.2 million
 * cells, as many as its first image has voxels, vtkStaticCellLocator takes as long as all of that image.
 *
 * Hidden cells, and cells with points or values that are not finite, are omitted. Results depend on
 * the datasets alone, not on the number of threads. All functions but the constructor, which works
 * in parallel (vtkSMPTools), are thread-safe.
 */
class CellTree
{
public:
  /// Interpolation in cells whose own functions are linear along each edge.
  enum class Reconstruction
  {
    Linear, // the cells' own functions
    Smooth  // exact for quadratic fields, by gradients at the points (see PointTrends.h)
  };

  struct Mesh;

  /// Builds the tree of datasets with a double scalar at each point, which must outlive it. Throws
  /// for too many cells or points.
  explicit CellTree(const std::vector<vtkDataSet*>& blocks,
    Reconstruction reconstruction = Reconstruction::Linear,
    const WorkProgress& progress = WorkProgress(), Copies copies = Copies::Used);

  /// Makes the tree of other values on the mesh of another tree, which it keeps.
  CellTree(const std::vector<vtkDataSet*>& blocks, std::shared_ptr<const Mesh> mesh,
    const WorkProgress& progress = WorkProgress());
  const std::shared_ptr<const Mesh>& mesh() const { return this->Sorted; }

  /// Numbers cells through all blocks, including hidden ones.
  using Number = std::uint32_t;
  struct Cell
  {
    const MeshArrays* block;
    vtkIdType id;
  };
  Cell cell(Number number) const;
  std::size_t blocks() const { return this->Blocks.size(); }
  std::size_t blockOf(const Cell& cell) const
  {
    return static_cast<std::size_t>(cell.block - this->Blocks.data());
  }

  /// Returns the number of the cell at a place, its index in the tree's order.
  Number number(std::size_t place) const { return this->Sorted->numbers[place]; }

  /// Prefetches data of later cells: neighbours in the tree's order are far apart in a dataset, so
  /// the processor would wait for memory. Call it before reading the i-th of `count` cells, whose
  /// places are placeOf(i).
  template <class PlaceOf>
  void fetchAhead(std::size_t i, std::size_t count, const PlaceOf& placeOf) const
  {
    constexpr std::size_t ahead = 12;
    if (i + 2 * ahead < count)
    {
      const Cell later = this->cell(this->number(placeOf(i + 2 * ahead)));
      later.block->fetchCell(later.id);
    }
    if (i + ahead < count)
    {
      const Cell soon = this->cell(this->number(placeOf(i + ahead)));
      soon.block->fetchPoints(soon.id);
    }
  }

  std::size_t size() const { return this->Sorted->numbers.size(); }  // cells in the tree
  std::size_t copies() const { return this->Sorted->copies.size(); } // only neighbours
  std::size_t bytes() const; // memory, without the datasets'

  struct Range // of values
  {
    double lowest, highest;
  };
  struct Bounds // low > high: none
  {
    Vector low, high;
  };
  const Bounds& bounds() const { return this->Sorted->whole; }

  /// Summary of some cells.
  struct Content
  {
    double lowest,
      highest;       // range of interpolated values; lowest > highest: no cells
    Vector cellSize; // smallest size along each axis; infinite: no cells
  };

  /// Summarizes the cells whose bounds meet a box, independently of the tree's other cells.
  Content content(const Bounds& box) const;

  /// Returns the proportions of voxels: typical cell sizes along each axis, the largest being 1.
  const Vector& voxelShape() const { return this->Sorted->voxelShape; }

  /// A sample of cells for voxelShapeOf(): those with the lowest `order`, which depends on the cell
  /// alone, so that the sample does not depend on pieces. Its size suits a mesh of `cellsOfAll`
  /// cells.
  struct MeasuredCell
  {
    std::uint64_t order;
    Vector size;
  };
  std::vector<MeasuredCell> measuredCells(std::int64_t cellsOfAll) const;
  static Vector voxelShapeOf(std::vector<MeasuredCell> cells);

  /// Returns the largest voxel for a cell along each axis: one step changes no parametric
  /// coordinate by more than 1. Infinite for cells without volume.
  static Vector sizeOf(const Cell& cell);

  // Boxes for walk(), in steps of a lattice that is fine enough for all cells. Cells are inside;
  // rounding enlarges the boxes.
  struct Steps
  {
    std::int32_t low[3], high[3];
  };
  struct Group
  {
    Steps box;
    float cellSize[3];
  };

  /// The state that depends on the mesh alone: points, cells, hidden cells, and points without
  /// values. It needs no dataset.
  struct Mesh
  {
    std::vector<Number> firstNumbers; // of each block, and the end
    Bounds whole;
    Vector origin, step, voxelShape;
    std::vector<Number> numbers;             // in the tree's order
    std::vector<Number> copies;              // used as neighbours only
    std::vector<Steps> boxes;                // of the cells
    std::vector<std::vector<Group>> levels;  // of eight cells, of eight groups, ... one group
    std::vector<PointNeighbours> neighbours; // of each block; none: linear

    std::size_t bytes() const;
  };
  const Vector& origin() const { return this->Sorted->origin; }
  const Vector& step() const { return this->Sorted->step; }

  /// Calls enter(box), which returns whether to continue, for groups and cells, and visit(place of
  /// a cell), in an order that depends on the tree only.
  template <class Enter, class Visit>
  void walk(const Enter& enter, const Visit& visit) const
  {
    if (!this->Sorted->levels.empty())
    {
      this->walk(this->Sorted->levels.size() - 1, 0, enter, visit);
    }
  }

  /// Calls visit(number) for all cells whose boxes meet a box.
  template <class Visit>
  void visit(const Bounds& box, const Visit& visit) const
  {
    const Steps steps = this->stepsOf(box);
    this->walk([&](const Steps& other) { return meet(steps, other); },
      [&](std::size_t place) { visit(this->number(place)); });
  }

private:
  static constexpr std::size_t width = 8; // children per group

  static bool meet(const Steps& a, const Steps& b)
  {
    return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
      b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
  }

  /// Returns whether a is within b, whatever has been rounded.
  static bool areWithin(const Steps& a, const Steps& b);

  template <class Enter, class Visit>
  void walk(std::size_t level, std::size_t group, const Enter& enter, const Visit& visit) const
  {
    if (!enter(this->Sorted->levels[level][group].box))
    {
      return;
    }
    const std::size_t first = width * group;
    if (level > 0)
    {
      const std::size_t end = std::min(first + width, this->Sorted->levels[level - 1].size());
      for (std::size_t i = first; i < end; ++i)
      {
        this->walk(level - 1, i, enter, visit);
      }
      return;
    }
    const std::size_t end = std::min(first + width, this->Sorted->numbers.size());
    for (std::size_t i = first; i < end; ++i)
    {
      if (enter(this->Sorted->boxes[i]))
      {
        visit(i);
      }
    }
  }

  static std::array<float, 3> floatSizeOf(const Cell& cell);
  static Bounds boundsOf(const Cell& cell);
  Steps stepsOf(const Bounds& box) const;
  void findCells(Mesh& mesh, Copies copies, const WorkProgress& progress);
  void findNeighbours(Mesh& mesh, const WorkProgress& progress);
  void sortCells(Mesh& mesh, const WorkProgress& progress);
  void makeGroups(Mesh& mesh, const WorkProgress& progress);
  void setValues(const WorkProgress& progress);
  static Range rangeOf(const Cell& cell);
  bool meets(std::size_t place, const Bounds& box, const Steps& steps) const;

  std::vector<MeshArrays> Blocks;
  std::shared_ptr<const Mesh> Sorted;
  std::vector<std::vector<Range>> Ranges; // of the groups of each level
};

} // namespace filters
