// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/MeshArrays.h"
#include "Common/Triangles.h"
#include "Common/WorkProgress.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkDataSet;

namespace filters
{

/// A point of a leaf.
struct LeafPoint
{
  std::uint32_t leaf;
  vtkIdType point;
};

/// The state of a cell.
enum class State : unsigned char
{
  None,
  Hidden,
  Visible
};

/// Name of an array of points: whether one was made of several of a dataset (see SharedPoints.h).
constexpr const char* doublesName = "Doubles";

/// Polygons that bound visible or hidden cells.
struct Faces
{
  std::vector<Point> points;
  std::vector<unsigned char> areDoubles; // of the points, see doublesName
  std::vector<LeafPoint> origins;        // of the points
  std::vector<std::int32_t> corners;     // of all faces
  std::vector<std::size_t> starts{ 0 };  // of each face, and the end
  std::vector<Point> owners;             // middle of the cell
  std::vector<State> states;             // of the cell

  std::size_t size() const { return this->owners.size(); }
  std::int32_t addPoint(const Point& x, const LeafPoint& origin, bool isDouble)
  {
    this->points.push_back(x);
    this->areDoubles.push_back(isDouble ? 1 : 0);
    this->origins.push_back(origin);
    return static_cast<std::int32_t>(this->points.size() - 1);
  }
  /// Adds a face, after its corners.
  void finish(const Point& owner, State state)
  {
    this->starts.push_back(this->corners.size());
    this->owners.push_back(owner);
    this->states.push_back(state);
  }
};

/// Finds the surface of each leaf's visible cells, and of hidden ones; see boundaryOf(). With
/// Copies::Neighbours, only faces of cells that are no copies. The shapes of the cells are known
/// (see CellShape.h).
Faces facesOf(const std::vector<vtkDataSet*>& leaves, const WorkProgress& progress,
  Copies copies = Copies::Used);

} // namespace filters
