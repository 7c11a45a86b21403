// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The leaves that the medium consists of, as rays see them. An image is one leaf; other data are an octree over
// root cells, whose leaves are bricks of samples, each at a spacing of its own.
//
//   index coordinates   of the whole medium: MediumView::last is its far corner
//   local coordinates   of a leaf: its sample (i, j, k) lies at (i, j, k), in floats without loss wherever it is
#pragma once

#include "Math/Vec3.h"
#include "Medium/Samples/MediumSource.h"

#include <cstdint>

namespace schlieren
{

/// What bricks are made of: edge^3 samples; or one layer of edge^2, where nothing depends on z. Such leaves have all of
/// the domain's depth, and a root cell is divided along x and y alone.
enum class BrickShape
{
  Cube,
  Layer
};

template <class Real>
struct Leaf
{
  enum Kind : std::int32_t
  {
    Samples,  ///< gas, everywhere
    Constant, ///< gas that is the same everywhere: it is crossed in one step
    Mixed,    ///< gas, and places without: see MediumView::gasDistances
    Solid     ///< a body everywhere
  };

  double first[3];    ///< index coordinates of its first sample
  double perIndex;    ///< local by index coordinates
  Real offset;        ///< is added to the samples' values
  std::int32_t brick; ///< of the samples
  std::int32_t map;   ///< brick of gasDistance, where its kind is Mixed
  Kind kind;

  /// Converts index to local coordinates along an axis, and back.
  SCHLIEREN_HD double toLocal(int axis, double index) const
  {
    return (index - first[axis]) * perIndex;
  }
  SCHLIEREN_HD double toIndex(int axis, double local) const
  {
    return first[axis] + local / perIndex;
  }
  SCHLIEREN_HD Vec3<double> toLocal(const Vec3<double>& index) const
  {
    return { toLocal(0, index.x), toLocal(1, index.y), toLocal(2, index.z) };
  }
  SCHLIEREN_HD Vec3<double> toIndex(const Vec3<double>& local) const
  {
    return { toIndex(0, local.x), toIndex(1, local.y), toIndex(2, local.z) };
  }
};

/// Finds leaves. Roots and children are numbers of inner nodes (0, 1, 2 ...) or, as ~number, of leaves.
struct LeafFinder
{
  const std::int32_t* roots;    ///< of each root cell, x fastest
  const std::int32_t* children; ///< eight of each inner node, x fastest
  std::int32_t rootCells[3];
  double perIndex[3]; ///< root cells by index coordinates

  /// The leaf at a place, which may be outside by rounding.
  SCHLIEREN_HD std::int32_t at(const Vec3<double>& index) const
  {
    const double x[3] = { index.x * perIndex[0], index.y * perIndex[1], index.z * perIndex[2] };
    double rest[3];
    std::int32_t cell[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double lastCell = rootCells[axis] - 1;
      const double within = x[axis] > 0 ? (x[axis] < lastCell ? x[axis] : lastCell) : 0;
      cell[axis] = static_cast<std::int32_t>(within);
      rest[axis] = x[axis] - cell[axis];
    }
    std::int32_t node = roots[(cell[2] * rootCells[1] + cell[1]) * rootCells[0] + cell[0]];
    while (node >= 0)
    {
      int child = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const bool isUpper = rest[axis] >= 0.5;
        rest[axis] = 2 * rest[axis] - (isUpper ? 1 : 0);
        child |= (isUpper ? 1 : 0) << axis;
      }
      node = children[8 * std::int64_t{ node } + child];
    }
    return ~node;
  }
};

} // namespace schlieren
