// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkDataSet;
class vtkImageData;
class vtkUnsignedCharArray;

namespace filters
{

/// The cells that hold a grid's points: 16 bytes for each point.
struct Places
{
  static constexpr std::uint32_t noCell = 0xffffffff;
  std::vector<std::uint32_t> cells;              // counted through all leaves
  std::vector<std::array<float, 3>> coordinates; // parametric ones
};

/**
 * Interpolates what meshes hold at their points to the points of a grid.
 *
 * Cells look for the points that they hold. Of several cells that hold a point, the first that holds it
 * best counts (see MeshCell::find). The grid is worked off in pieces that need nothing of each other,
 * the same ones whatever the number of threads; and so is the result.
 */
class MeshSampler
{
public:
  /// Leaves have one double scalar at each point and hide cells by ghost arrays (all bits of
  /// hiddenCellBits). `flatAxis`: across 2-D cells, along which places do not count; -1 for 3-D ones.
  /// Throws where there are too many cells.
  MeshSampler(std::vector<vtkDataSet*> leaves, vtkImageData* grid, int flatAxis);

  int pieces() const { return this->Pieces; }

  /// Before find(): which cells do the points of each piece lie in?
  enum class Cells
  {
    Visible,
    Hidden // those of the right dimension
  };
  void sort(Cells cells);

  Places find(int piece) const;

  /// Fills `values` and, where no cell is, clears `valid`: arrays of all of the grid's points.
  void interpolate(int piece, const Places& places, double* values, unsigned char* valid) const;

  /// Clears `outside` at points in cells.
  void cover(int piece, const Places& places, unsigned char* outside) const;

private:
  using Range = std::array<int, 2>; // first and last

  std::array<Range, 3> pointsOf(int piece) const;
  std::array<Range, 3> pointsWithin(vtkDataSet* data, vtkIdType cell) const;
  template <class Visit>
  void forPoints(int piece, const Visit& visit) const;
  std::size_t leafOf(std::uint32_t cell) const;

  std::vector<vtkDataSet*> Leaves;
  std::vector<std::uint32_t> FirstCells; // of each leaf, and the end
  std::array<std::vector<double>, 3> Coordinates;
  std::array<double, 3> Spacing;
  int FlatAxis;
  std::size_t Axis; // across the pieces
  int Pieces;
  std::vector<std::size_t> Starts;   // in Sorted, of each piece, and the end
  std::vector<std::uint32_t> Sorted; // cells of each piece, in their order
};

} // namespace filters
