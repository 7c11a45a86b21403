// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Walls/BoundaryFaces.h"
#include "Walls/PlaneSides.h"

#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace filters
{

/**
 * Decides which places that no cell covers stop light.
 *
 * Places that hang together are treated alike. They are a body if the mesh encloses them, or if
 * they reach the sides of the mesh's box only at sides in which the mesh has flat faces, too: a
 * floor, a symmetry plane, an inlet or outlet. Otherwise light passes. The box lies along the
 * mesh's largest plane sides. Layers of one cell are looked at in their plane. Parts of
 * whose surface within the mesh's convex hull less than a tenth is open are bodies, too.
 *
 * Faces divide a grid over the box into parts. Where they are nearer than its spacing they decide
 * themselves; faces beside no part, of plates, are walls. Thread-safe.
 */
class OutsidePlaces
{
public:
  using Place = schlieren::Place;

  explicit OutsidePlaces(const BoundaryFaces& faces);

  /// Returns whether a triangle is no wall.
  bool isOuter(std::size_t triangle) const { return this->AreOuter[triangle] != 0; }
  /// Returns whether a place is beyond a side of the mesh's box.
  bool isBeyond(const Point& place) const;
  /// Returns nothing where the nearest face decides.
  std::optional<Place> at(const Point& place) const;

  int bodies() const { return this->Bodies; }

private:
  enum class Kind : unsigned char
  {
    Crossed, // by faces, or left to them
    Gas,
    Body,
    BodyWithin, // the hull, beyond which it passes
    Passes
  };
  using Parts = std::vector<std::size_t>; // of each place of the grid, by its lowest number

  Point turned(const Point& place) const;
  std::size_t count() const { return this->Kinds.size(); }
  std::array<std::size_t, 3> indexOf(std::size_t n) const;
  bool isCut(std::size_t axis) const { return this->Counts[axis] > 1; }
  const PlaneSide* hullBefore(const Point& own) const;
  Point middleOf(std::size_t n) const; // in own axes
  template <class Visit>
  void forNeighbours(std::size_t n, const Visit& visit) const;

  void layGrid(const Triangles& own, bool isLayer);
  void markCrossed(const Triangles& own);
  Parts partsOf(Kind kind) const;
  std::size_t lookFrom(const Triangles& own, std::size_t triangle, bool isOutward) const;
  void findGas(const Triangles& own);
  void findBodies(const Parts& parts);
  void findHull(const Triangles& own, const std::vector<PlaneSide>& sides);
  void findBodiesWithin();
  void freeFromHull();
  std::size_t indexAt(std::size_t axis, double x) const; // in own axes
  std::size_t numberAt(const Point& own) const;
  Kind kindAt(const Point& own) const;
  std::array<bool, 2> beyondSides(const Point& own, double tolerance) const;
  void findOuter(const Triangles& own, const std::vector<unsigned char>& hide,
    const PlaneSides& sides, const Parts& parts);

  std::array<Point, 3> Axes; // of the box, by rows
  Point Low{}, High{}, Spacing{};
  std::array<std::size_t, 3> Counts{};
  std::array<bool, 6> AreClosed{}; // sides of the box: low and high along each axis
  std::vector<PlaneSide> Hull;     // in own axes; open ones have no part
  double Tolerance, Finest = 0;
  std::vector<Kind> Kinds;
  std::vector<unsigned char> AreOuter;
  bool Hides; // there are hidden cells, also beyond the box
  int Bodies = 0;
};

} // namespace filters
