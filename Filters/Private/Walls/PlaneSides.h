// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"

#include <array>
#include <vector>

namespace filters
{

/// Faces that turn by less than 50 degrees are of one smooth surface.
constexpr double cosineOfGentle = 0.643;

/// A plane that a mesh reaches and does not cross.
struct PlaneSide
{
  Point normal; // outward
  double offset;
  double part; // of the mesh's extent along the plane that flat faces in it cover
  double area; // of these
};

/**
 * Finds the plane sides of a mesh.
 *
 * Of the faces in a plane it counts those that end sharply: not those at one of whose corners the
 * boundary leaves the plane by less than 50 degrees, as facets of a curved far field do.
 */
class PlaneSides
{
public:
  /// `surface`: of a mesh; its normals point into it.
  explicit PlaneSides(const Triangles& surface);

  /// Distance from a plane within which points are in it.
  double tolerance() const { return this->Tolerance; }
  /// Returns the side with this outward normal.
  PlaneSide at(const Point& normal) const;
  /// Returns sides with flat faces, those with the largest area first.
  std::vector<PlaneSide> largest() const;

  /// Calls visit(one, other) for triangles at the same edge.
  template <class Visit>
  void forNeighbours(const Visit& visit) const
  {
    for (std::size_t i = 1; i < this->Edges.size(); ++i)
    {
      if (this->Edges[i].isSameEdge(this->Edges[i - 1]))
      {
        visit(static_cast<std::size_t>(this->Edges[i - 1].triangle),
          static_cast<std::size_t>(this->Edges[i].triangle));
      }
    }
  }

private:
  std::array<double, 2> rangeAlong(const Point& direction) const;
  bool areInOnePlane(std::size_t one, std::size_t other) const;

  const Triangles& Surface;
  const std::vector<EdgeOfTriangle> Edges;
  std::vector<Point> Normals; // inward
  std::vector<double> Heights;
  double Rounding, Tolerance;
};

/// Returns the axes, by rows, along which there are the largest sides; those of the data rather than
/// others. `isLayer`: z stays.
std::array<Point, 3> axesAlong(const std::vector<PlaneSide>& sides, bool isLayer);

/// Returns whether a direction is along an axis, but for rounding.
bool isAlong(const Point& direction, const std::array<Point, 3>& axes);

} // namespace filters
