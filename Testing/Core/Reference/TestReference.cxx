// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The reference tracer itself, against closed forms: it has to be right before anything is compared with it.
#include "Fields.h"
#include "ReferenceSpline.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace schlieren
{

namespace
{

using namespace reference;

Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real length(const Vec& a) { return std::sqrt(dot(a, a)); }
Vec unit(const Vec& a) { return (1 / length(a)) * a; }

const Real circle = std::acos(Real(-1)); // half of one

/// A medium given by n^2 and grad n^2 / 2.
Refractivity bySquare(const std::function<Value(const Vec&)>& square)
{
  return [square](const Vec& x)
  {
    const auto [n2, halfGradient] = square(x);
    const Real n = std::sqrt(n2);
    return Value{ n - 1, (1 / n) * halfGradient };
  };
}

RayState towards(const Flow& flow, const Vec& place, const Vec& direction)
{
  return { place, (1 + flow.pieceAt({}).valueAt(place).refractivity) * unit(direction), 0 };
}

Real distance(const Vec& a, const Vec& b) { return length(a - b); }

/// n^2 = n0^2 (1 - g^2 rho^2): sines in dtau = ds / n, all of one pitch.
TEST(Reference, RaysOfAParabolicRodAreSines)
{
  constexpr Real n0 = 1.5L, g = 0.8L;
  const Flow flow = flowOf(cube(2, 2),
    bySquare(
      [=](const Vec& x)
      {
        const Real rate = n0 * n0 * g * g;
        return Value{ n0 * n0 - rate * (x[0] * x[0] + x[1] * x[1]),
          { -rate * x[0], -rate * x[1], 0 } };
      }),
    0.5L);
  const RayState start = towards(flow, { 0.3L, -0.2L, -2 }, { 0.1L, 0.25L, 1 });
  const RayState end = follow(flow, start);
  const Real tau = 4 / start.momentum[2], rate = n0 * g;
  const Real c = std::cos(rate * tau), s = std::sin(rate * tau);
  Vec place{ 0, 0, 2 }, momentum{ 0, 0, start.momentum[2] };
  Real path = n0 * n0 * tau;
  for (const std::size_t i : { 0, 1 })
  {
    const Real x = start.position[i], p = start.momentum[i];
    place[i] = x * c + p / rate * s;
    momentum[i] = p * c - rate * x * s;
    path -= (rate * rate * x * x * (tau + s * c / rate) + p * p * (tau - s * c / rate)) / 2 +
      x * p * s * s;
  }
  EXPECT_LT(distance(end.position, place), 1e-11L);
  EXPECT_LT(distance(end.momentum, momentum), 1e-11L);
  EXPECT_NEAR(static_cast<double>(end.path - path), 0, 1e-11);
}

/// Luneburg's lens n^2 = 2 - r^2: all parallel light meets at (0, 0, 1), on paths of 1 + pi / 2 from z = -1.
TEST(Reference, LuneburgsLensFocuses)
{
  const Flow flow = flowOf(cube(2, 1),
    bySquare(
      [](const Vec& x) {
        return Value{ 2 - dot(x, x), Real(-1) * x };
      }),
    0.5L);
  for (const Real height : { 0.1L, 0.5L, 0.85L })
  {
    const Real before = std::sqrt(1 - height * height);
    const RayState end =
      follow(flow, { { 0.6L * height, 0.8L * height, -before }, { 0, 0, 1 }, 0 });
    EXPECT_LT(distance(end.position, { 0, 0, 1 }), 1e-11L);
    EXPECT_NEAR(static_cast<double>(1 - before + end.path - (1 + circle / 2)), 0, 1e-11);
  }
}

/// Maxwell's fish-eye n = 2 / (1 + r^2): all light of (0, 0, -1) meets at (0, 0, 1), on paths of pi.
TEST(Reference, MaxwellsFishEyeFocuses)
{
  const Flow flow = flowOf(
    cube(2, 1),
    [](const Vec& x)
    {
      const Real n = 2 / (1 + dot(x, x));
      return Value{ n - 1, (-n * n) * x };
    },
    1);
  for (const Vec& direction : { Vec{ 0, 0, 1 }, Vec{ 0.5L, -0.3L, 1 }, Vec{ -0.4L, 0.6L, 0.8L } })
  {
    const RayState end = follow(flow, towards(flow, { 0, 0, -1 }, direction));
    EXPECT_LT(distance(end.position, { 0, 0, 1 }), 1e-11L);
    EXPECT_NEAR(static_cast<double>(end.path - circle), 0, 1e-11);
  }
}

/// N = A exp(-(x^2 + y^2) / s^2) in boxes that cut off nothing.
Flow columnOf(Real peak)
{
  Grid grid = cube(2, 7);
  grid.dimensions = { 3, 3, 3 };
  grid.spacing = { 7, 7, 7 };
  return flowOf(
    grid,
    [=](const Vec& x)
    {
      const Real N = peak * std::exp(-x[0] * x[0] - x[1] * x[1]);
      return Value{ N, { -2 * N * x[0], -2 * N * x[1], 0 } };
    },
    peak);
}

Scene columnScene(Cutoff cutoff)
{
  Scene scene;
  scene.cutoff = cutoff;
  scene.view.viewDirection = { 0, -1, 0 };
  scene.view.viewUp = { 0, 0, 1 };
  scene.view.width = 9;
  scene.view.height = 1;
  scene.view.focalPoint = Vector{ 0.7, 0, 0.1 };
  scene.view.parallelScale = 0.04;
  scene.samplesPerPixel = 1;
  return scene;
}

/// Light goes along y, so u is -x.
Real sidewaysAt(const Scene& scene, std::size_t column)
{
  return (Real(column) - 4) * 2 * Real(scene.view.parallelScale) -
    Real((*scene.view.focalPoint)[0]);
}

TEST(Reference, AWeakColumnBendsAsAbelsTransformSays)
{
  constexpr Real peak = 1e-7L;
  const Scene scene = columnScene(Cutoff::KnifeEdge);
  const std::vector<Ray> rays = trace(columnOf(peak), scene);
  for (std::size_t i = 0; i < 9; ++i)
  {
    const Real y = sidewaysAt(scene, i), bell = std::sqrt(circle) * peak * std::exp(-y * y);
    EXPECT_NEAR(double(rays[i].deflection.real() / peak), double(-2 * y * bell / peak), 3e-7);
    EXPECT_NEAR(double(rays[i].deflection.imag() / peak), 0, 1e-8);
    EXPECT_NEAR(double(rays[i].opticalPath / peak), double(bell / peak), 3e-6);
    // It is bent in the middle, 7 before the exit plane.
    EXPECT_NEAR(double(rays[i].displacement.real() / peak), double(-14 * y * bell / peak), 3e-6);
  }
}

/// I = 1 / (1 + D d eps / dy) where y + D eps lies; a pixel has the mean of that.
TEST(Reference, AShadowgraphIsARatioOfAreas)
{
  constexpr Real peak = 1e-7L;
  Scene scene = columnScene(Cutoff::Shadowgraph);
  scene.screenDistance = 1e6; // the focal length is 2.8e6
  const std::vector<Color> image = render(columnOf(peak), scene);
  const auto shiftOf = [&](Real y)
  { return -(7 + 1e6L) * 2 * std::sqrt(circle) * peak * y * std::exp(-y * y); };
  for (std::size_t i = 0; i < 9; ++i)
  {
    // The light between the pixel's sides is that between the rays that land there.
    Real from[2];
    for (int side = 0; side < 2; ++side)
    {
      const Real place = sidewaysAt(scene, i) + (2 * side - 1) * Real(scene.view.parallelScale);
      Real low = -4, high = 4;
      for (int bisection = 0; bisection < 80; ++bisection)
      {
        const Real y = (low + high) / 2;
        (y + shiftOf(y) < place ? low : high) = y;
      }
      from[side] = low;
    }
    const Real mean = (from[1] - from[0]) / (2 * Real(scene.view.parallelScale));
    EXPECT_NEAR(double(image[i][0]), double(mean), 3e-6);
  }
}

Value cubicAt(const Vec& x)
{
  return { 1 + x[0] * x[1] * x[2] + x[0] * x[0] * x[0] - 2 * x[1] * x[1] * x[2],
    { x[1] * x[2] + 3 * x[0] * x[0], x[0] * x[2] - 4 * x[1] * x[2],
      x[0] * x[1] - 2 * x[1] * x[1] } };
}
Value quadraticAt(const Vec& x)
{
  return { 1 + x[0] * x[1] + x[0] * x[0] - 2 * x[1] * x[2],
    { x[1] + 2 * x[0], x[0] - 2 * x[2], -2 * x[1] } };
}
Value linearAt(const Vec& x)
{
  return { 1 + x[0] * x[1] - 2 * x[1] * x[2] * x[0],
    { x[1] - 2 * x[1] * x[2], x[0] - 2 * x[2] * x[0], -2 * x[1] * x[0] } };
}

/// Splines of a degree are exact of polynomials of that degree, up to the grid's sides, whatever the grid's axes.
TEST(Reference, SplinesReproducePolynomials)
{
  Grid grid;
  grid.dimensions = { 6, 7, 9 };
  grid.origin = { -0.3, 0.2, -0.4 };
  grid.spacing = { 0.2, 0.1, 0.15 };
  std::mt19937 random(1);
  const auto between = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  for (const bool isRotated : { false, true })
  {
    grid.direction =
      isRotated ? std::array<double, 9>{ 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 } : Grid().direction;
    const auto visit = [&](Interpolation interpolation, Value (*valueAt)(const Vec&))
    {
      const SampledField<double> field(grid,
        [&](double x, double y, double z) {
          return static_cast<double>(valueAt({ x, y, z }).refractivity);
        });
      const Flow flow = splineThrough(grid, field.samples, interpolation, 1);
      for (int n = 0; n < 50; ++n)
      {
        const Vec index{ between(0, 5), between(0, 6), between(0, 8) };
        const auto d = [&](int i) { return Real(grid.direction[static_cast<std::size_t>(i)]); };
        const Vec a{ index[0] * Real(grid.spacing[0]), index[1] * Real(grid.spacing[1]),
          index[2] * Real(grid.spacing[2]) };
        const Vec place = Vec{ Real(grid.origin[0]), Real(grid.origin[1]), Real(grid.origin[2]) } +
          Vec{ d(0) * a[0] + d(1) * a[1] + d(2) * a[2], d(3) * a[0] + d(4) * a[1] + d(5) * a[2],
            d(6) * a[0] + d(7) * a[1] + d(8) * a[2] };
        const Value found = flow.pieceAt(index).valueAt(place), truth = valueAt(place);
        EXPECT_NEAR(double(found.refractivity), double(truth.refractivity), 1e-14);
        EXPECT_LT(distance(found.gradient, truth.gradient), 1e-13L);
      }
    };
    visit(Interpolation::Cubic, cubicAt);
    visit(Interpolation::Quadratic, quadraticAt);
    if (!isRotated) // which would make squares of products
    {
      visit(Interpolation::Linear, linearAt);
    }
  }
}

/// The ray from piece to piece is that of the polynomial.
TEST(Reference, RaysCrossSplinesAsTheyCrossPolynomials)
{
  const Grid grid = cube(8, 1);
  const auto scaled = [](const Vec& x) {
    return Value{ 0.02L * cubicAt(x).refractivity, 0.02L * cubicAt(x).gradient };
  };
  const SampledField<double> field(grid,
    [&](double x, double y, double z) {
      return static_cast<double>(scaled({ x, y, z }).refractivity);
    });
  const Flow polynomial = flowOf(grid, scaled, 0.02L);
  const Flow spline = splineThrough(grid, field.samples, Interpolation::Cubic, 0.02L);
  for (const Vec& direction : { Vec{ 0, 0, 1 }, Vec{ 0.4L, -0.3L, 1 }, Vec{ -0.7L, 0.9L, 0.5L } })
  {
    const RayState start = towards(polynomial, { 0.1L, 0.2L, -1 }, direction);
    const RayState a = follow(polynomial, start), b = follow(spline, start);
    EXPECT_LT(distance(a.position, b.position), 1e-13L);
    EXPECT_LT(distance(a.momentum, b.momentum), 1e-13L);
    EXPECT_NEAR(double(a.path - b.path), 0, 1e-13);
  }
}

} // namespace

} // namespace schlieren
