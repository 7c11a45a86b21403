// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "LatticeDistances.h"
#include "Triangles.h"

#include <functional>
#include <memory>
#include <vector>

namespace refractivity
{

/// What the points of one lattice are, and how far from where the gas ends; see GasBoundary::sample().
class LatticeSampling
{
public:
  using Place = schlieren::Place;

  explicit LatticeSampling(const schlieren::Lattice& lattice);

  /// Faces of meshes, whose normals point into the gas.
  void addFaces(
    const Triangles& surface, const TriangleTree& tree, const std::vector<unsigned char>& walls);
  /// Surfaces in the gas. Whether there are any within reach.
  bool addBodies(const Triangles& surface, const TriangleTree& tree);

  /// `isInBody`: empty where no point is. `kindAt` tells what there is at a place outside from the faces beyond
  /// reach.
  void run(const unsigned char* isInCell, const std::vector<unsigned char>& isInBody,
    const std::function<Place(const Point&)>& kindAt, Place* places, float* distances);

private:
  enum Kind
  {
    Wall,
    Window,
    Body
  };
  struct Near // a triangle within reach
  {
    std::array<Point, 3> corners; // in the lattice's metric
    Point normal;                 // of unit length there
  };
  /// The points, by their indices.
  struct Index
  {
    int i, j, k;
  };

  void add(Kind kind, const Triangles& surface, std::int32_t triangle);
  float distanceTo(Kind kind, const Index& at) const;
  std::int32_t nearestOf(Kind kind, const Index& at) const;
  std::int32_t nearestSolid(const Index& at) const;
  float distanceToSolid(const Index& at) const;
  Point normalTowards(const Index& at) const;
  bool isWallNearer(const Index& at) const;

  void measure(const unsigned char* isInCell, const std::vector<unsigned char>& isInBody);
  void findKinds(const std::function<Place(const Point&)>& kindAt);
  void spread(std::vector<std::size_t>& known);
  void thickenPlates();
  void separate(const Index& low);
  bool isThin(const Index& at) const;

  template <class Visit>
  void forPoints(const Visit& visit) const;
  std::size_t placeOf(const Index& at) const
  {
    return (static_cast<std::size_t>(at.k) * static_cast<std::size_t>(this->Lattice.points[1]) +
             static_cast<std::size_t>(at.j)) *
      static_cast<std::size_t>(this->Lattice.points[0]) +
      static_cast<std::size_t>(at.i);
  }
  bool holds(const Index& at) const
  {
    return at.i >= 0 && at.i < this->Lattice.points[0] && at.j >= 0 &&
      at.j < this->Lattice.points[1] && at.k >= 0 && at.k < this->Lattice.points[2];
  }

  const schlieren::Lattice Lattice;
  LatticeMetric Metric;
  std::vector<Near> Nearby;
  std::array<std::unique_ptr<LatticeDistances>, 3> Fields; // of each kind; null: none within reach
  std::array<std::vector<std::int32_t>, 3> Numbers;        // of each kind
  std::vector<float> Distances;
  enum State : unsigned char
  {
    InGas,
    InWall,
    InWindow,
    Unknown // outside, of what kind?
  };
  std::vector<unsigned char> States;
  std::vector<unsigned char> Marked; // to become walls
};

} // namespace refractivity
