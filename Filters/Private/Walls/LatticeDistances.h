// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"

#include <vector>

namespace filters
{

/// Scales a lattice to spacings of 1, with its first point at 0.
class LatticeMetric
{
public:
  explicit LatticeMetric(const schlieren::Lattice& lattice);

  Point at(const Point& place) const
  {
    return { (place[0] - this->First[0]) * this->PerUnit[0],
      (place[1] - this->First[1]) * this->PerUnit[1],
      (place[2] - this->First[2]) * this->PerUnit[2] };
  }

private:
  Point First, PerUnit;
};

/// Returns the lattice's bounds, extended by `reach` spacings.
schlieren::Box boxAround(const schlieren::Lattice& lattice, double reach);

/**
 * Unsigned distances from a lattice's points to triangles, in spacings, and the nearest triangles.
 * Triangles search for the points within reach of them, eight at a time in a row along x.
 */
class LatticeDistances
{
public:
  LatticeDistances(const schlieren::Lattice& lattice, float reach);

  /// `number`: what nearest() returns for this triangle.
  void add(const std::array<Point, 3>& corners, std::int32_t number);

  /// Returns, for a row of points along x, squared distances, at most that of the reach, and the
  /// nearest triangles; -1: none within reach.
  const float* squaredInRow(int j, int k) const { return this->Squared.data() + this->row(j, k); }
  const std::int32_t* nearestInRow(int j, int k) const
  {
    return this->Nearest.data() + this->row(j, k);
  }

  static constexpr int lanes = 4; ///< points processed at once

private:
  std::size_t row(int j, int k) const
  {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(this->Points[1]) +
             static_cast<std::size_t>(j)) *
      this->Stride;
  }

  std::array<int, 3> Points;
  std::size_t Stride; // of a row
  float Reach;
  std::vector<float> Squared;
  std::vector<std::int32_t> Nearest;
};

} // namespace filters
