// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"
#include "Walls/LatticeDistances.h"
#include "Walls/OutsidePlaces.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace filters
{

/// Classifies the points of a lattice, with distances to the gas's boundary; see
/// GasBoundary::sample().
class LatticeSampling
{
public:
  using Place = schlieren::Place;

  explicit LatticeSampling(const schlieren::Lattice& lattice);

  /// Adds faces of meshes, whose normals point into the gas.
  void addFaces(
    const Triangles& surface, const TriangleTree& tree, const std::vector<unsigned char>& walls);
  /// Adds surfaces in the gas. Returns whether any is within reach.
  bool addBodies(const Triangles& surface, const TriangleTree& tree);

  /// Classifies all points. `isInBody`: empty if no point is. Points outside and beyond reach of
  /// faces are what is `decided` there (may be null), else as those beside them, else what `kindAt`
  /// returns.
  void run(const unsigned char* isInCell, const std::vector<unsigned char>& isInBody,
    const std::function<Place(const Point&)>& kindAt, const OutsidePlaces* decided, Place* places,
    float* distances);

private:
  // State of each point.
  enum State : unsigned char
  {
    InGas,
    InWall,
    InWindow,
    Unknown // outside, kind unknown
  };
  enum Kind
  {
    Wall,
    Window,
    Body
  };
  struct Near // a triangle within reach
  {
    std::array<Point, 3> corners; // in the lattice's metric
    Point normal;                 // unit length, in the lattice's metric
  };
  /// A point by its indices.
  struct Index
  {
    int i, j, k;
  };

  /// A point with gas beside a solid.
  struct GasBeside
  {
    Index at;
    std::size_t number;
    Point place;
    Point side; // the normal of the nearest solid, turned to it
    const Near* near;
    mutable std::optional<bool> IsOver{};

    double heightOf(const Point& other) const { return dot(side, other - near->corners[0]); }
    Point foot() const { return place - heightOf(place) * side; }
    bool isOver() const; // the nearest triangle, else beyond an edge
  };

  void add(Kind kind, const Triangles& surface, std::int32_t triangle);
  void measure(const unsigned char* isInCell, const std::vector<unsigned char>& isInBody);
  bool isWallNearer(const Index& at, std::int32_t wall, std::int32_t window) const;
  void findKinds(const std::function<Place(const Point&)>& kindAt, const OutsidePlaces* decided);
  void findGaps();
  void spread(std::vector<Index>& known);
  void thickenPlates();
  void findBeside();
  static bool isOver(const Near& near, const Point& place, double slack);
  void separate(const Index& low);
  void markThin(const GasBeside& one);

  /// Calls visit(index, number) for the points whose number passes a test.
  template <class Test, class Visit>
  void forPoints(const Test& test, const Visit& visit) const
  {
    std::size_t p = 0;
    for (int k = 0; k < this->Lattice.points[2]; ++k)
    {
      for (int j = 0; j < this->Lattice.points[1]; ++j)
      {
        for (int i = 0; i < this->Lattice.points[0]; ++i, ++p)
        {
          if (test(p))
          {
            visit(Index{ i, j, k }, p);
          }
        }
      }
    }
  }
  template <class Visit>
  void forNeighbours(const Index& at, const Visit& visit) const;
  static Point placeOf(const Index& at)
  {
    return { static_cast<double>(at.i), static_cast<double>(at.j), static_cast<double>(at.k) };
  }
  std::size_t numberOf(const Index& at) const
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
  std::array<std::unique_ptr<LatticeDistances>, 3> Fields; // by kind; null: none within reach

  std::vector<unsigned char> States;
  std::vector<float> Distances;
  std::vector<float> SquaredToSolid;      // to walls and bodies
  std::vector<std::int32_t> NearestSolid; // -1: none within reach
  std::vector<std::int32_t> BesideAt;     // the number of each point in the next; -1: not there
  std::vector<GasBeside> Beside;
  std::vector<unsigned char> Marked; // will become walls
};

} // namespace filters
