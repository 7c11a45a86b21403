// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Media in which the rays are known in closed form, and what the bench should say of them.
//
// With dtau = ds / n a ray obeys dr/dtau = p, dp/dtau = grad n^2 / 2, |p| = n, and its optical path is
// the integral of n^2 dtau.
#pragma once

#include "Fields.h"
#include "Math/Vec3.h"

#include <algorithm>
#include <limits>

namespace schlieren
{

using Point = Vec3<double>;

struct RayState
{
  Point position, momentum;
  double path; ///< optical path so far
};

struct ClosedForm
{
  std::function<double(const Point&)> excess;      ///< n^2 - 1
  std::function<Point(const Point&)> halfGradient; ///< grad n^2 / 2
  std::function<RayState(const RayState& start, double parameter)> after;

  double refractivity(const Point& x) const
  {
    const double e = excess(x);
    return e / (1 + std::sqrt(1 + e)); // n - 1 without cancellation
  }
};

/// n^2 = n0^2 + a.r: parabolas, r = r0 + p0 tau + a tau^2 / 4, optical path
/// n^2(r0) tau + (a.p0) tau^2 / 2 + |a|^2 tau^3 / 12. Given n0^2 - 1. The parameter is tau.
inline ClosedForm linearMedium(double excessAtZero, const Point& a)
{
  const auto excess = [=](const Point& x) { return excessAtZero + dot(a, x); };
  return { excess, [=](const Point&) { return 0.5 * a; },
    [=](const RayState& start, double t)
    {
      return RayState{ start.position + t * start.momentum + (t * t / 4) * a,
        start.momentum + (t / 2) * a,
        start.path + (1 + excess(start.position)) * t + dot(a, start.momentum) * t * t / 2 +
          dot(a, a) * t * t * t / 12 };
    } };
}

/// n^2 = n0^2 - sum of (k_i x_i)^2: each coordinate is an oscillator in tau. The parabolic rod
/// n0^2 (1 - g^2 rho^2) has k = (n0 g, n0 g, 0), Luneburg's lens 2 - r^2 / R^2 has k_i = 1 / R.
inline ClosedForm oscillator(double n0, const Point& k)
{
  const auto excess = [=](const Point& x)
  { return (n0 - 1) * (n0 + 1) - dot(scaled(k, x), scaled(k, x)); };
  const auto along = [](double x, double p, double rate, double t, double& path)
  {
    if (rate == 0)
    {
      return std::pair<double, double>{ x + p * t, p };
    }
    const double c = std::cos(rate * t), s = std::sin(rate * t);
    // Less the integral of (rate x)^2 for x = x0 cos + (p0 / rate) sin.
    path -=
      0.5 * (rate * rate * x * x * (t + s * c / rate) + p * p * (t - s * c / rate)) + x * p * s * s;
    return std::pair<double, double>{ x * c + p / rate * s, p * c - rate * x * s };
  };
  return { excess, [=](const Point& x) { return -1.0 * scaled(scaled(k, k), x); },
    [=](const RayState& start, double t)
    {
      double path = start.path + n0 * n0 * t;
      const Point x = start.position, p = start.momentum;
      const auto [x1, p1] = along(x.x, p.x, k.x, t, path);
      const auto [x2, p2] = along(x.y, p.y, k.y, t, path);
      const auto [x3, p3] = along(x.z, p.z, k.z, t, path);
      return RayState{ { x1, x2, x3 }, { p1, p2, p3 }, path };
    } };
}

/// A blob beside the axis, N = peak exp(-r^2 / width^2); its rays have no closed form.
inline ClosedForm blob(double peak)
{
  const Point middle{ 0.3, -0.2, 0.4 };
  constexpr double width = 0.8;
  const auto refractivity = [=](const Point& x)
  {
    const Point r = x - middle;
    return peak * std::exp(-dot(r, r) / (width * width));
  };
  return { [=](const Point& x) { return refractivity(x) * (2 + refractivity(x)); },
    [=](const Point& x)
    {
      const double N = refractivity(x);
      return (-2 * (1 + N) * N / (width * width)) * (x - middle);
    },
    {} };
}

/// Maxwell's fish-eye n = n0 / (1 + r^2), R = 1. It is the stereographic image of a sphere (in four
/// dimensions) on which rays are great circles, and n ds = n0 / 2 times the arc (Luneburg 1964, section
/// 28). So a ray passes through r0, closes through -r0 / |r0|^2, and the optical path between the two is
/// pi n0 / 2. The parameter is the arc.
inline ClosedForm fishEye(double n0)
{
  const auto index = [=](const Point& x) { return n0 / (1 + dot(x, x)); };
  return { [=](const Point& x) { return (index(x) - 1) * (index(x) + 1); },
    [=](const Point& x) { return (-2 * index(x) * index(x) / (1 + dot(x, x))) * x; },
    [=](const RayState& start, double t)
    {
      // The sphere's point (X, w) over r, its tangent along the ray, and back.
      const Point r = start.position;
      const double s = 1 + dot(r, r);
      const Point direction = (1 / length(start.momentum)) * start.momentum;
      const double rd = dot(r, direction);
      const Point X = (2 / s) * r;
      const double w = 1 - 2 / s;
      const Point T = direction - (2 * rd / s) * r; // (2/s) |dr| is the arc: of unit length
      const double v = 2 * rd / s;
      const double c = std::cos(t), sine = std::sin(t);
      const double below = 1 - (w * c + v * sine);
      const Point position = (1 / below) * (c * X + sine * T);
      const Point slope =
        (1 / below) * (c * T - sine * X) + ((v * c - w * sine) / below) * position;
      return RayState{ position, (index(position) / length(slope)) * slope,
        start.path + n0 / 2 * t };
    } };
}

struct GridBox
{
  Point low, high;

  bool contains(const Point& x) const
  {
    return x.x >= low.x && x.x <= high.x && x.y >= low.y && x.y <= high.y && x.z >= low.z &&
      x.z <= high.z;
  }
};

/// Of a grid that is not rotated.
inline GridBox boxOf(const Grid& grid)
{
  Point edges{};
  double* edge[3] = { &edges.x, &edges.y, &edges.z };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    *edge[axis] = grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1);
  }
  const Point low{ grid.origin[0], grid.origin[1], grid.origin[2] };
  return { low, low + edges };
}

/// Where a path leaves the box: of after(t), the last within it. Looks every `stride`.
template <class After>
RayState leaving(const GridBox& box, const After& after, double stride)
{
  double inside = 0, outside = stride;
  while (box.contains(after(outside).position))
  {
    inside = outside;
    outside += stride;
  }
  for (int bisection = 0; bisection < 60; ++bisection)
  {
    const double middle = 0.5 * (inside + outside);
    (box.contains(after(middle).position) ? inside : outside) = middle;
  }
  return after(inside);
}

inline RayState leaving(const ClosedForm& form, const RayState& start, const GridBox& box)
{
  return leaving(
    box, [&](double t) { return form.after(start, t); }, 1. / 512);
}

/// One step of the classical Runge-Kutta method in the medium itself: no grid, nothing of the tracer's.
inline RayState rungeKutta(const ClosedForm& form, const RayState& state, double step)
{
  RayState sum{ { 0, 0, 0 }, { 0, 0, 0 }, 0 };
  RayState slope = sum;
  const double at[] = { 0, 0.5, 0.5, 1 };
  const double weight[] = { 1. / 6, 1. / 3, 1. / 3, 1. / 6 };
  for (int stage = 0; stage < 4; ++stage)
  {
    const Point x = state.position + (at[stage] * step) * slope.position;
    const Point p = state.momentum + (at[stage] * step) * slope.momentum;
    slope = { p, form.halfGradient(x), 1 + form.excess(x) };
    sum.position += weight[stage] * slope.position;
    sum.momentum += weight[stage] * slope.momentum;
    sum.path += weight[stage] * slope.path;
  }
  return { state.position + step * sum.position, state.momentum + step * sum.momentum,
    state.path + step * sum.path };
}

/// Where the ray leaves the box by that method: the truth for media without a closed form.
inline RayState integrated(
  const ClosedForm& form, const RayState& start, const GridBox& box, double step = 1. / 512)
{
  RayState state = start;
  for (RayState next = rungeKutta(form, state, step); box.contains(next.position);
       next = rungeKutta(form, state, step))
  {
    state = next;
  }
  return leaving(
    box, [&](double t) { return rungeKutta(form, state, t); }, step);
}

/// The leapfrog in the medium itself, in double precision: what the method does, apart from any grid.
inline RayState leapfrogged(
  const ClosedForm& form, const RayState& start, const GridBox& box, double step)
{
  const auto stepped = [&](const RayState& from, double s)
  {
    const Point middle = from.position + (s / 2) * from.momentum;
    const Point p = from.momentum + s * form.halfGradient(middle);
    const Point mean = 0.5 * (from.momentum + p);
    // On the mean of n^2 and |p|^2, which are the same: see Documentation/development/theory.md.
    return RayState{ middle + (s / 2) * p, p,
      from.path + s / 2 * (1 + form.excess(middle) + dot(mean, mean)) };
  };
  RayState state = start;
  for (RayState next = stepped(state, step); box.contains(next.position);
       next = stepped(state, step))
  {
    state = next;
  }
  return leaving(
    box, [&](double t) { return stepped(state, t); }, step);
}

inline Point asPoint(const Vector& a) { return { a[0], a[1], a[2] }; }

/// The light of a pixel where it enters the box, with |p| = n; false if it misses it.
inline bool entering(const ClosedForm& form, const GridBox& box, const Frame& frame,
  const PixelCentre& at, RayState& ray)
{
  const Point w = asPoint(frame.w);
  const Point start = at.u * asPoint(frame.u) + at.v * asPoint(frame.v) + frame.entry * w;
  double from = 0, to = frame.exit - frame.entry;
  const double x[] = { start.x, start.y, start.z }, d[] = { w.x, w.y, w.z };
  const double low[] = { box.low.x, box.low.y, box.low.z };
  const double high[] = { box.high.x, box.high.y, box.high.z };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (d[axis] == 0)
    {
      to = x[axis] < low[axis] || x[axis] > high[axis] ? -1 : to;
      continue;
    }
    const double a = (low[axis] - x[axis]) / d[axis], b = (high[axis] - x[axis]) / d[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  const Point entry = start + from * w;
  ray = { entry, std::sqrt(1 + form.excess(entry)) * w, 0 };
  return from < to;
}

/// What the bench says of a ray.
struct Reading
{
  double deflection[2], displacement[2], opticalPathDifference;
};

inline Reading readingOf(
  const RayState& start, const RayState& end, const Frame& frame, double indexAround = 1)
{
  const Point u = asPoint(frame.u), v = asPoint(frame.v), w = asPoint(frame.w);
  const Point p = end.momentum, path = end.position - start.position;
  const double rest = (frame.exit - dot(end.position, w)) / dot(p, w);
  return { { dot(p, u) / length(p), dot(p, v) / length(p) },
    { dot(path, u) + rest * dot(p, u), dot(path, v) + rest * dot(p, v) },
    end.path - start.path + indexAround * (rest * length(p) - dot(path + rest * p, w)) };
}

inline Reading readingOf(const Image& image, std::size_t pixel)
{
  return { { image.deflection[2 * pixel], image.deflection[2 * pixel + 1] },
    { image.displacement[2 * pixel], image.displacement[2 * pixel + 1] },
    image.opticalPathDifference[pixel] };
}

/// Largest values, or largest differences.
struct Worst
{
  double deflection = 0, displacement = 0, opticalPathDifference = 0;

  void include(const Reading& a, const Reading& b = {})
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      widen(deflection, a.deflection[axis] - b.deflection[axis]);
      widen(displacement, a.displacement[axis] - b.displacement[axis]);
    }
    widen(opticalPathDifference, a.opticalPathDifference - b.opticalPathDifference);
  }

private:
  static void widen(double& most, double value)
  {
    // NaN must not pass for small.
    most =
      std::isnan(value) ? std::numeric_limits<double>::infinity() : std::max(most, std::abs(value));
  }
};

inline std::ostream& operator<<(std::ostream& out, const Worst& worst)
{
  return out << "deflection " << worst.deflection << ", displacement " << worst.displacement
             << ", optical path " << worst.opticalPathDifference;
}

/// The largest differences from the truth, in all pixels, and the largest values that are true.
struct Comparison
{
  Worst error, size;
};
template <class TruthOf>
Comparison compared(const Image& image, const TruthOf& truthOf)
{
  Comparison all;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const Reading truth = truthOf(column, row);
      all.error.include(truth, readingOf(image, pixelOf(image, column, row)));
      all.size.include(truth);
    }
  }
  return all;
}

/// Largest differences between two images.
inline Worst differences(const Image& a, const Image& b)
{
  Worst worst;
  for (std::size_t pixel = 0; pixel < a.opticalPathDifference.size(); ++pixel)
  {
    worst.include(readingOf(a, pixel), readingOf(b, pixel));
  }
  return worst;
}

/// Calls visit(pixel, the ray where it enters, where it leaves) for the rays that cross the box.
template <class Visit>
void forRays(const ClosedForm& form, const Grid& grid, const Image& image, const Visit& visit)
{
  const GridBox box = boxOf(grid);
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      RayState start{};
      if (entering(form, box, image.frame, centreOf(image, column, row), start))
      {
        visit(pixelOf(image, column, row), start, leaving(form, start, box));
      }
    }
  }
}

/// How far an image of the medium, in vacuum and with one ray per pixel, is from the closed form.
inline Worst errorsOf(const ClosedForm& form, const Grid& grid, const Image& image)
{
  Worst worst;
  forRays(form, grid, image,
    [&](std::size_t pixel, const RayState& start, const RayState& end)
    { worst.include(readingOf(image, pixel), readingOf(start, end, image.frame)); });
  return worst;
}

template <class Value = double>
SampledField<Value> sampled(const Grid& grid, const ClosedForm& form)
{
  return { grid, [&](double x, double y, double z) { return form.refractivity({ x, y, z }); } };
}

/// A grid of cubic voxels from -half to half.
inline Grid boxGrid(double spacing, const Point& half)
{
  Grid grid;
  grid.spacing = { spacing, spacing, spacing };
  const double halves[] = { half.x, half.y, half.z };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid.dimensions[axis] = std::llround(2 * halves[axis] / spacing) + 1;
    grid.origin[axis] = -0.5 * spacing * static_cast<double>(grid.dimensions[axis] - 1);
  }
  return grid;
}

/// A row or rectangle of single rays, `distance` apart around a point, for numbers rather than to look at.
inline View raysAround(const Vector& point, int columns, int rows, double distance)
{
  View view;
  view.focalPoint = point;
  view.width = columns;
  view.height = rows;
  view.parallelScale = 0.5 * rows * distance;
  return view;
}

inline const char* name(Integrator integrator)
{
  return integrator == Integrator::Leapfrog ? "Leapfrog" : "Adaptive";
}
inline const char* name(PathModel model)
{
  return model == PathModel::Straight ? "Straight" : "Refracted";
}

inline constexpr Integrator allIntegrators[] = { Integrator::Leapfrog, Integrator::Adaptive };
inline constexpr Precision bothPrecisions[] = { Precision::Single, Precision::Double };

} // namespace schlieren
