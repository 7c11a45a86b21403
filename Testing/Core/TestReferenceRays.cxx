// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The tracer against the reference tracer, ray by ray and technique by technique. Media are cubic polynomials, which
// cubic splines reproduce, or samples whose spline the reference has as well: so there is no error of the grid.
#include "Fields.h"
#include "ReferenceTracer.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

using namespace reference;

/// Full scale, and the largest error.
struct Error
{
  Real full = 0, worst = 0;

  void include(Real truth, Real found)
  {
    full = std::max(full, std::abs(truth));
    worst = std::isnan(found) ? Real(1e300L) : std::max(worst, std::abs(truth - found));
  }
  double relative() const { return static_cast<double>(worst / full); }
};

Error errorOf(const std::vector<Pair>& truth, const PixelArray<float>& found)
{
  Error error;
  EXPECT_EQ(2 * truth.size(), found.size());
  for (std::size_t i = 0; 2 * i < found.size(); ++i)
  {
    error.include(truth[i].real(), Real(found[2 * i]));
    error.include(truth[i].imag(), Real(found[2 * i + 1]));
  }
  return error;
}

template <class Number>
Error errorOf(const std::vector<Real>& truth, const PixelArray<Number>& found)
{
  Error error;
  EXPECT_EQ(truth.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    error.include(truth[i], Real(found[i]));
  }
  return error;
}

constexpr double ambient = 1e-4;
constexpr double lengthScale = 0.1;

/// A medium as both tracers have it. The reference has the formula, or the spline through the same samples.
struct Medium
{
  SampledField<double> samples;
  Flow flow;

  Medium(const Grid& grid, const Refractivity& refractivity, Real largest,
    std::optional<Interpolation> interpolation = {})
    : samples(grid,
        [&](double x, double y, double z) {
          return static_cast<double>(refractivity({ x, y, z }).refractivity);
        })
    , flow(interpolation ? splineThrough(grid, samples.samples, *interpolation, largest)
                         : flowOf(grid, refractivity, largest))
  {
    flow.ambient = ambient;
    flow.lengthScale = lengthScale;
    samples.field.ambient = ambient;
    samples.field.lengthScale = lengthScale;
  }
};

/// N - ambient = peak times a polynomial of third degree that has all kinds of terms.
Medium polynomial(Real peak, const Grid& grid = cube(24, 1))
{
  return { grid,
    [peak](const Vec& a)
    {
      const auto [x, y, z] = a;
      const Real sum = 0.2L + 0.3L * x - 0.2L * y + 0.1L * z + 0.3L * x * y - 0.4L * x * x +
        0.2L * y * y * z - 0.25L * x * x * x + 0.2L * x * y * z;
      const Vec gradient{ 0.3L + 0.3L * y - 0.8L * x - 0.75L * x * x + 0.2L * y * z,
        -0.2L + 0.3L * x + 0.4L * y * z + 0.2L * x * z, 0.1L + 0.2L * y * y + 0.2L * x * y };
      return Value{ Real(ambient) + peak * sum, peak * gradient };
    },
    peak };
}

/// A Gaussian ball, as a spline through samples.
Medium ball(Real peak, Interpolation interpolation, std::int64_t points = 40)
{
  return { cube(points, 1),
    [peak](const Vec& a)
    {
      const Vec r = a - Vec{ 0.1L, -0.05L, 0.05L };
      const Real N = peak * std::exp(-(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / 0.09L);
      return Value{ Real(ambient) + N, (-2 * N / 0.09L) * r };
    },
    peak, interpolation };
}

Scene exactScene(const Vector& direction = { 0, 0, -1 })
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.viewDirection = direction;
  scene.view.width = 9;
  scene.view.height = 7;
  scene.view.focalPoint = Vector{ 0.05, -0.1, 0.08 };
  scene.view.parallelScale = 0.5;
  scene.samplesPerPixel = 1;
  scene.kScale = 1;
  scene.pathModel = PathModel::Refracted;
  scene.integrator = Integrator::Rk4;
  scene.interpolation = Interpolation::Cubic;
  scene.precision = Precision::Double;
  scene.stepSize = 0.1;
  return scene;
}

const Vector oblique{ -0.4, 0.3, -0.9 };

void expectSameRays(const Medium& medium, const Scene& scene, double allowed = 1e-6)
{
  const Image image = Bench().render(medium.samples.field, scene);
  const Images truth = trace(medium.flow, scene);
  EXPECT_LT(errorOf(truth.deflection, image.deflection).relative(), allowed);
  EXPECT_LT(errorOf(truth.displacement, image.displacement).relative(), allowed);
  EXPECT_LT(errorOf(truth.opticalPathDifference, image.opticalPathDifference).relative(), allowed);
}

void forViews(const std::function<void(const Scene&)>& visit)
{
  for (const Vector& direction : { Vector{ 0, 0, -1 }, oblique })
  {
    Scene scene = exactScene(direction);
    {
      SCOPED_TRACE("parallel light");
      visit(scene);
    }
    {
      SCOPED_TRACE("point source");
      scene.source.distance = 5;
      visit(scene);
    }
    {
      SCOPED_TRACE("perspective");
      scene.source.distance.reset();
      scene.view.viewAngle = 20;
      visit(scene);
    }
    {
      SCOPED_TRACE("camera with a perspective");
      scene.cutoff = Cutoff::Background;
      visit(scene);
    }
    {
      SCOPED_TRACE("camera");
      scene.view.viewAngle = 0;
      visit(scene);
    }
  }
}

TEST(ReferenceRays, OfPolynomials)
{
  for (const double peak : { 1e-9, 1e-4, 0.02, 0.2 })
  {
    SCOPED_TRACE(peak);
    const Medium medium = polynomial(peak);
    forViews([&](const Scene& scene) { expectSameRays(medium, scene); });
  }
}

TEST(ReferenceRays, OfSplines)
{
  for (const Interpolation interpolation : { Interpolation::Cubic, Interpolation::Quadratic })
  {
    SCOPED_TRACE(name(interpolation));
    for (const double peak : { 1e-4, 0.02 })
    {
      const Medium medium = ball(peak, interpolation);
      for (const Vector& direction : { Vector{ 0, 0, -1 }, oblique })
      {
        Scene scene = exactScene(direction);
        scene.interpolation = interpolation;
        scene.stepSize = interpolation == Interpolation::Cubic ? 0.1 : 0.02;
        expectSameRays(medium, scene);
      }
    }
  }
}

TEST(ReferenceRays, OfIntegrators)
{
  const Medium medium = polynomial(0.02);
  for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
  {
    Scene scene = exactScene(oblique);
    scene.integrator = integrator;
    scene.stepSize = integrator == Integrator::Leapfrog ? 0.02 : 1;
    scene.adaptiveTolerance = 1e-10;
    expectSameRays(medium, scene);
  }
}

} // namespace

} // namespace schlieren
