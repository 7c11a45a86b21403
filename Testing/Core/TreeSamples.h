// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Samples of a tree of bricks, and straight rays through them.
#pragma once

#include "Medium/Tree/MediumTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace schlieren
{

/// A column that sees all.
inline Column everything(
  const Vec3<double>& u = { 1, 0, 0 }, const Vec3<double>& v = { 0, 1, 0 }, double finest = 0)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return { u, v, { 0, 0 }, { infinite, infinite }, finest };
}

template <class Real>
std::int32_t leafAt(const MediumTree<Real>& tree, const Vec3<double>& place)
{
  const Grid& grid = tree.grid();
  return tree.finder().at({ (place.x - grid.origin[0]) / grid.spacing[0],
    (place.y - grid.origin[1]) / grid.spacing[1], (place.z - grid.origin[2]) / grid.spacing[2] });
}

/// Value and gradient, by data units.
template <class Real>
Sample<double> sampleAt(
  const MediumTree<Real>& tree, Interpolation interpolation, const Vec3<double>& place)
{
  const Grid& grid = tree.grid();
  const Leaf<Real>& leaf = tree.leaves()[static_cast<std::size_t>(leafAt(tree, place))];
  const auto local = [&](double x, std::size_t axis) -> Real
  {
    return static_cast<Real>(
      ((x - grid.origin[axis]) / grid.spacing[axis] - leaf.first[axis]) * leaf.perIndex);
  };
  const Vec3<Real> at{ local(place.x, 0), local(place.y, 1), local(place.z, 2) };
  const Real* samples = tree.samples().data() + leaf.brick * tree.samplesPerBrick();
  const Sample<Real> found = visitScheme(interpolation,
    [&](auto scheme)
    { return interpolateBrick<decltype(scheme)>(samples, tree.apron(), tree.shape(), at); });
  return { static_cast<double>(leaf.offset) + static_cast<double>(found.value),
    { static_cast<double>(found.gradient.x) * leaf.perIndex / grid.spacing[0],
      static_cast<double>(found.gradient.y) * leaf.perIndex / grid.spacing[1],
      static_cast<double>(found.gradient.z) * leaf.perIndex / grid.spacing[2] } };
}

/// Gradient summed up along the straight ray through a place, in steps of half a voxel.
template <class Real>
Vec3<double> bendAlong(const MediumTree<Real>& tree, Interpolation interpolation,
  const Vec3<double>& place, const Vec3<double>& direction)
{
  const Grid& grid = tree.grid();
  double entry = -std::numeric_limits<double>::infinity(), exit = -entry;
  const double x[3] = { place.x, place.y, place.z };
  const double d[3] = { direction.x, direction.y, direction.z };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = grid.origin[axis];
    const double high = low + grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1);
    const double a = (low - x[axis]) / d[axis], b = (high - x[axis]) / d[axis];
    if (d[axis] != 0)
    {
      entry = std::max(entry, std::min(a, b));
      exit = std::min(exit, std::max(a, b));
    }
  }
  Vec3<double> sum{ 0, 0, 0 };
  for (double s = entry; s < exit;)
  {
    const double look = s + 1e-7 * (exit - entry);
    const Leaf<Real>& leaf =
      tree.leaves()[static_cast<std::size_t>(leafAt(tree, place + look * direction))];
    double step = exit - s;
    double out = exit - s;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (d[axis] != 0)
      {
        const double voxel = grid.spacing[axis] / leaf.perIndex;
        step = std::min(step, 0.5 * voxel / std::abs(d[axis]));
        const double index = (x[axis] + s * d[axis] - grid.origin[axis]) / grid.spacing[axis];
        const double local = (index - leaf.first[axis]) * leaf.perIndex;
        out = std::min(out, std::abs(((d[axis] > 0 ? 15.5 : -0.5) - local) * voxel / d[axis]));
      }
    }
    step = std::max(std::min(step, out), 2e-7 * (exit - entry));
    if (leaf.kind != Leaf<Real>::Constant)
    {
      sum += step * sampleAt(tree, interpolation, place + (s + 0.5 * step) * direction).gradient;
    }
    s += step;
  }
  return sum;
}

} // namespace schlieren
