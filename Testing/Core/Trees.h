// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What tests of trees share.
#pragma once

#include "AnalyticSources.h"
#include "Medium/Tree/MediumTree.h"
#include "TreeSamples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace schlieren
{

using Tree = MediumTree<float>;

inline TreeSettings settingsOf(double tolerance)
{
  TreeSettings settings;
  settings.tolerance = tolerance;
  return settings;
}

inline const Vec3<double> x{ 1, 0, 0 }, y{ 0, 1, 0 }, z{ 0, 0, 1 };

/// Errors of deflections on a square, of the largest deflection, in order.
inline std::vector<double> errorsOf(const Tree& tree, const BallsSource& source,
  Interpolation interpolation, const Vec3<double>& u, const Vec3<double>& v, double half,
  const Vec3<double>& around = { 0, 0, 0 })
{
  constexpr int edge = 31;
  std::vector<double> errors;
  for (int n = 0; n < edge * edge; ++n)
  {
    const double a = half * (2. * (n % edge) / (edge - 1) - 1);
    const double b = half * (2. * (n / edge) / (edge - 1) - 1);
    const Vec3<double> place = around + a * u + b * v;
    const auto truth = source.deflectionAt(place, u, v);
    const Vec3<double> bend = bendAlong(tree, interpolation, place, cross(u, v));
    errors.push_back(
      std::hypot(dot(bend, u) - truth[0], dot(bend, v) - truth[1]) / source.largestDeflection());
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

/// Worst error of the deflection of straight rays, of the largest one, over [-half, half]^2 around a place.
inline double worstError(const Tree& tree, const BallsSource& source, Interpolation interpolation,
  const Vec3<double>& u, const Vec3<double>& v, double half,
  const Vec3<double>& around = { 0, 0, 0 })
{
  return errorsOf(tree, source, interpolation, u, v, half, around).back();
}

/// What 99 % of the same keep.
inline double errorOfMost(const Tree& tree, const BallsSource& source, Interpolation interpolation,
  const Vec3<double>& u, const Vec3<double>& v, double half,
  const Vec3<double>& around = { 0, 0, 0 })
{
  const std::vector<double> errors = errorsOf(tree, source, interpolation, u, v, half, around);
  return errors[errors.size() * 99 / 100];
}

/// N everywhere the same.
class ConstantSource : public AnalyticSource
{
public:
  explicit ConstantSource(double n)
    : n_(n)
  {
  }
  double refractivity(double, double, double) const override { return n_; }
  Range rangeOver(const Box&) const override { return { n_, n_ }; }
  double cellSizeOver(const Box&) const override { return 0.01; }

private:
  double n_;
};

/// Between two corners.
class BoxSource : public ConstantSource
{
public:
  BoxSource(const std::array<double, 3>& edges, const std::array<double, 3>& shape)
    : ConstantSource(1e-4)
    , edges_(edges)
    , shape_(shape)
  {
  }
  Box bounds() const override
  {
    return { { 1, 2, 3 }, { 1 + edges_[0], 2 + edges_[1], 3 + edges_[2] } };
  }
  std::array<double, 3> voxelShape() const override { return shape_; }

private:
  std::array<double, 3> edges_, shape_;
};

inline Column around(double u, double v, double half, double finest = 0)
{
  return { x, y, { u, v }, { half, half }, finest };
}

} // namespace schlieren
