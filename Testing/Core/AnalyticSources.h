// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sources of a medium that are formulas, and straight rays through what is made of them.
#pragma once

#include "Medium/Tree/MediumTree.h"
#include "Schlieren.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace schlieren
{

/// A new version of data, each time.
inline Field fieldOf(const std::shared_ptr<const MediumSource>& source)
{
  static std::uint64_t versions = 0;
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = ++versions;
  return field;
}

using Range = std::pair<double, double>;

/// Of |x - centre| over a box.
inline Range distancesTo(const std::array<double, 3>& centre, const Box& box)
{
  double nearest = 0, farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double below = box.low[axis] - centre[axis];
    const double above = box.high[axis] - centre[axis];
    const double least = below > 0 ? below : above < 0 ? -above : 0;
    const double most = std::max(-below, above);
    nearest += least * least;
    farthest += most * most;
  }
  return { std::sqrt(nearest), std::sqrt(farthest) };
}

/// N by a formula, everywhere in a cube of half edge `half`. Derived classes say what is not gas.
class AnalyticSource : public MediumSource
{
public:
  explicit AnalyticSource(double half = 1)
    : half_(half)
  {
  }

  virtual double refractivity(double x, double y, double z) const = 0;
  virtual Range rangeOver(const Box& box) const = 0;
  virtual double cellSizeOver(const Box& box) const = 0;
  virtual Place placeAt(double, double, double) const { return Place::Gas; }
  /// To where gas ends, data units, positive in gas.
  virtual double distanceAt(double, double, double) const
  {
    return std::numeric_limits<double>::infinity();
  }
  /// hasWall, hasGas and hasWindow.
  virtual void findPlaces(const Box&, Content& content) const { content.hasGas = true; }

  Box bounds() const override { return { { -half_, -half_, -half_ }, { half_, half_, half_ } }; }
  double ambient() const override { return 0; }

  Content contentOf(const Box& box) const override
  {
    const Range range = rangeOver(box);
    const double cell = cellSizeOver(box);
    Content content{ range.first, range.second, { cell, cell, cell }, false, false, false };
    findPlaces(box, content);
    if (!content.hasGas)
    {
      content.lowest = 1;
      content.highest = 0;
    }
    return content;
  }

  void sample(
    const Lattice& lattice, double* refractivities, Place* places, float* distances) const override
  {
    ++lattices;
    std::size_t at = 0;
    for (int k = 0; k < lattice.points[2]; ++k)
    {
      for (int j = 0; j < lattice.points[1]; ++j)
      {
        for (int i = 0; i < lattice.points[0]; ++i, ++at)
        {
          const double x = lattice.first[0] + i * lattice.spacing[0];
          const double y = lattice.first[1] + j * lattice.spacing[1];
          const double z = lattice.first[2] + k * lattice.spacing[2];
          const bool isInside =
            std::abs(x) <= half_ && std::abs(y) <= half_ && std::abs(z) <= half_;
          places[at] = isInside ? placeAt(x, y, z) : Place::Window;
          refractivities[at] = places[at] == Place::Gas ? refractivity(x, y, z)
                                                        : std::numeric_limits<double>::quiet_NaN();
          if (distances != nullptr)
          {
            const double outer = half_ - std::max({ std::abs(x), std::abs(y), std::abs(z) });
            const double distance = std::min(distanceAt(x, y, z), outer) / lattice.spacing[0];
            distances[at] = static_cast<float>(
              std::clamp(distance, -static_cast<double>(reach), static_cast<double>(reach)));
          }
        }
      }
    }
  }

  mutable std::atomic<int> lattices{ 0 }; ///< that were sampled

protected:
  double half_;
};

struct Ball
{
  std::array<double, 3> centre;
  double width, height; ///< N = height exp(-(r / width)^2)
};

/// Balls with Gaussian profiles. Cells are a fraction of a ball's width in it, and large elsewhere.
class BallsSource : public AnalyticSource
{
public:
  explicit BallsSource(std::vector<Ball> balls, double half = 1, double cellByWidth = 0.01)
    : AnalyticSource(half)
    , balls_(std::move(balls))
    , cellByWidth_(cellByWidth)
  {
  }

  double refractivity(double x, double y, double z) const override
  {
    double sum = 0;
    for (const Ball& ball : balls_)
    {
      const double dx = x - ball.centre[0], dy = y - ball.centre[1], dz = z - ball.centre[2];
      const double q = (dx * dx + dy * dy + dz * dz) / (ball.width * ball.width);
      sum += q < 60 ? ball.height * std::exp(-q) : 0;
    }
    return sum;
  }
  Range rangeOver(const Box& box) const override
  {
    Range sum{ 0, 0 };
    for (const Ball& ball : balls_)
    {
      const Range r = distancesTo(ball.centre, box);
      const auto profile = [&](double x)
      { return ball.height * std::exp(-x * x / (ball.width * ball.width)); };
      sum.first += std::min(profile(r.first), profile(r.second));
      sum.second += std::max(profile(r.first), profile(r.second));
    }
    return sum;
  }
  double cellSizeOver(const Box& box) const override
  {
    double size = 0.1 * half_;
    for (const Ball& ball : balls_)
    {
      size = distancesTo(ball.centre, box).first < 4 * ball.width
        ? std::min(size, cellByWidth_ * ball.width)
        : size;
    }
    return size;
  }

  /// Of a straight ray through a place: along u and v.
  std::array<double, 2> deflectionAt(
    const Vec3<double>& place, const Vec3<double>& u, const Vec3<double>& v) const
  {
    std::array<double, 2> sum{ 0, 0 };
    for (const Ball& ball : balls_)
    {
      const Vec3<double> from =
        place - Vec3<double>{ ball.centre[0], ball.centre[1], ball.centre[2] };
      const double a = dot(from, u), b = dot(from, v);
      const double slope = -2 * std::sqrt(std::acos(-1.)) * ball.height / ball.width *
        std::exp(-(a * a + b * b) / (ball.width * ball.width));
      sum[0] += slope * a;
      sum[1] += slope * b;
    }
    return sum;
  }
  double largestDeflection() const
  {
    double largest = 0;
    for (const Ball& ball : balls_)
    {
      largest = std::max(largest,
        2 * std::sqrt(std::acos(-1.)) * std::abs(ball.height) * std::exp(-0.5) / std::sqrt(2.));
    }
    return largest;
  }

private:
  std::vector<Ball> balls_;
  double cellByWidth_;
};

/// A sphere of radius 1 in a flow that fades away, in a round domain with nothing around it.
class SphereSource : public AnalyticSource
{
public:
  explicit SphereSource(double outer = 20)
    : SphereSource(outer, outer)
  {
  }

  static double profile(double r) { return 1e-4 * std::exp(-(std::max(r, 1.) - 1)); }
  static double radius(double a, double b, double c) { return std::sqrt(a * a + b * b + c * c); }

  double refractivity(double a, double b, double c) const override
  {
    return profile(radius(a, b, c));
  }
  Range rangeOver(const Box& box) const override
  {
    const Range r = distancesTo({ 0, 0, 0 }, box);
    return { profile(r.second), profile(r.first) };
  }
  double cellSizeOver(const Box& box) const override
  {
    return 0.04 * std::max(distancesTo({ 0, 0, 0 }, box).first, 1.);
  }
  Place placeAt(double a, double b, double c) const override
  {
    const double r = radius(a, b, c);
    return r < 1 ? Place::Wall : r < outer_ ? Place::Gas : Place::Window;
  }
  double distanceAt(double a, double b, double c) const override
  {
    const double r = radius(a, b, c);
    return std::min(r - 1, outer_ - r);
  }
  void findPlaces(const Box& box, Content& content) const override
  {
    const Range r = distancesTo({ 0, 0, 0 }, box);
    content.hasWall = r.first < 1;
    content.hasGas = r.second > 1 && r.first < outer_;
    content.hasWindow = r.second > outer_;
  }

protected:
  SphereSource(double outer, double half)
    : AnalyticSource(half)
    , outer_(outer)
  {
  }

private:
  double outer_; ///< radius of the domain
};

/// Gas with a constant gradient along y where x < border, and nothing elsewhere.
class HalfSource : public AnalyticSource
{
public:
  HalfSource(double n, double slope, double border, double cell)
    : n_(n)
    , slope_(slope)
    , border_(border)
    , cell_(cell)
  {
  }

  double refractivity(double, double b, double) const override { return n_ + slope_ * b; }
  Range rangeOver(const Box& box) const override
  {
    return { n_ + slope_ * box.low[1], n_ + slope_ * box.high[1] };
  }
  double cellSizeOver(const Box&) const override { return cell_; }
  Place placeAt(double a, double, double) const override
  {
    return a < border_ ? Place::Gas : Place::Window;
  }
  double distanceAt(double a, double, double) const override { return border_ - a; }
  void findPlaces(const Box& box, Content& content) const override
  {
    content.hasGas = box.low[0] < border_;
    content.hasWindow = box.high[0] > border_;
  }

private:
  double n_, slope_, border_, cell_;
};

/// Of a straight ray through a place, along u and v, by a midpoint rule from -`far` to `far`, in steps of `step`
/// within `near`.
template <class Gradient>
std::array<double, 2> summedUp(const Gradient& gradient, const Vec3<double>& place,
  const Vec3<double>& u, const Vec3<double>& v, double near, double step, double far)
{
  const Vec3<double> w = cross(u, v);
  const Vec3<double> start = place - dot(place, w) * w;
  Vec3<double> sum{ 0, 0, 0 };
  const auto add = [&](double from, double to, int steps)
  {
    const double length = (to - from) / steps;
    for (int n = 0; n < steps; ++n)
    {
      sum += length * gradient(start + (from + (n + 0.5) * length) * w);
    }
  };
  add(-far, -near, 400);
  add(-near, near, static_cast<int>(2 * near / step));
  add(near, far, 400);
  return { dot(sum, u), dot(sum, v) };
}

/// A shell at r = 0.5, 0.01 thick, of another N inside.
class ShellSource : public AnalyticSource
{
public:
  static double profile(double r) { return 5e-5 * (1 - std::tanh((r - 0.5) / 0.01)); }
  double refractivity(double a, double b, double c) const override
  {
    return profile(SphereSource::radius(a, b, c));
  }
  Range rangeOver(const Box& box) const override
  {
    const Range r = distancesTo({ 0, 0, 0 }, box);
    return { profile(r.second), profile(r.first) };
  }
  double cellSizeOver(const Box& box) const override
  {
    const Range r = distancesTo({ 0, 0, 0 }, box);
    return r.first < 0.55 && r.second > 0.45 ? 0.002 : 0.05;
  }

  std::array<double, 2> deflectionAt(
    const Vec3<double>& place, const Vec3<double>& u, const Vec3<double>& v) const
  {
    return summedUp(
      [](const Vec3<double>& at)
      {
        const double r = length(at);
        const double t = std::tanh((r - 0.5) / 0.01);
        return (-5e-5 / 0.01 * (1 - t * t) / r) * at;
      },
      place, u, v, 0.6, 5e-4, 1.8);
  }
};

/// Three balls: a wide, a small and a tiny one.
inline std::vector<Ball> threeBalls(double height)
{
  return { { { -0.1, 0.05, 0.02 }, 0.25, height }, { { 0.42, -0.31, 0.2 }, 0.05, 0.5 * height },
    { { -0.37, 0.44, -0.5 }, 0.02, 0.25 * height } };
}

/// What the medium states, of the largest deflection.
inline double statedError(const MediumStatistics& medium)
{
  return medium.deflectionError / medium.largestDeflection;
}

} // namespace schlieren
