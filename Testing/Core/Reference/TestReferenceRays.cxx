// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The tracer against the reference tracer, ray by ray and technique by technique. Media are cubic polynomials, which
// cubic splines reproduce, or samples whose spline the reference has as well: so there is no error of the grid.
#include "ClosedForms.h"
#include "ReferenceMedia.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

using namespace reference;

/// `flow`: of the reference, whose rays are bent `factor` times less.
void expectSameRays(const Medium& medium, const Scene& scene, const Flow& flow, Real factor = 1,
  double allowed = 2e-7)
{
  const Image image = schlieren::Bench().render(medium.samples.field, scene);
  Difference deflection, displacement, path, shift;
  std::size_t pixel = 0;
  for (const Ray& ray : trace(flow, scene))
  {
    deflection.include(factor * ray.deflection, &image.deflection[2 * pixel]);
    displacement.include(factor * ray.displacement, &image.displacement[2 * pixel]);
    path.include(factor * ray.opticalPath, image.opticalPathDifference[pixel]);
    if (scene.cutoff == Cutoff::Background &&
      factor == 1) // which is exact geometry, not of first order
    {
      shift.include(factor * ray.shift, &image.backgroundDisplacement[2 * pixel]);
    }
    ++pixel;
  }
  EXPECT_LT(deflection.relative(), allowed);
  EXPECT_LT(displacement.relative(), allowed);
  EXPECT_LT(path.relative(), allowed);
  EXPECT_LT(shift.relative(), allowed);
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
    forViews([&](const Scene& scene) { expectSameRays(medium, scene, medium.flow); });
  }
}

TEST(ReferenceRays, OfRotatedGrids)
{
  Grid grid = boxGrid(0.1, { 0.8, 1, 1.2 });
  grid.spacing = { 0.09, 0.1, 0.12 };
  grid.direction = { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 };
  const Medium medium = polynomial(0.02, grid);
  forViews(
    [&](Scene scene)
    {
      scene.view.parallelScale = 0.2;
      scene.view.focalPoint.reset();
      expectSameRays(medium, scene, medium.flow);
    });
}

/// Of a smooth flow in a grid so fine that its spline is as good as the flow.
TEST(ReferenceRays, OfAGaussianBall)
{
  const Medium medium = ball(0.01, {}, 160);
  Scene scene = exactScene(oblique);
  scene.stepSize = 0.5;
  expectSameRays(medium, scene, medium.flow, 1, 1e-6);
}

TEST(ReferenceRays, OfSplines)
{
  for (const Interpolation interpolation : { Interpolation::Cubic, Interpolation::Quadratic })
  {
    SCOPED_TRACE(name(interpolation));
    const Medium medium = ball(0.02, interpolation, 32);
    for (const Vector& direction : { Vector{ 0, 0, -1 }, oblique })
    {
      Scene scene = exactScene(direction);
      scene.view.width = 5;
      scene.view.height = 4;
      scene.interpolation = interpolation;
      scene.stepSize = interpolation == Interpolation::Cubic ? 0.1 : 0.02;
      expectSameRays(medium, scene, medium.flow);
    }
  }
}

/// Straight rays are what bent ones become of first order in the refractivity.
TEST(ReferenceRays, OfStraightPaths)
{
  const Medium medium = polynomial(1e-4), weak = polynomial(1e-8);
  forViews(
    [&](Scene scene)
    {
      scene.pathModel = PathModel::Straight;
      scene.stepSize = 0.01; // midpoints
      expectSameRays(medium, scene, weak.flow, 1e4L);
    });
}

/// Where steps end at the kinks of a linear interpolation, it is integrated without an error.
TEST(ReferenceRays, OfLinearInterpolation)
{
  const Medium medium = ball(1e-4, Interpolation::Linear, 32),
               weak = ball(1e-8, Interpolation::Linear, 32);
  Scene scene = exactScene();
  scene.interpolation = Interpolation::Linear;
  scene.pathModel = PathModel::Straight;
  scene.stepSize = 0.5;
  expectSameRays(medium, scene, weak.flow, 1e4L);
}

TEST(ReferenceRays, OfOtherIntegrators)
{
  const Medium medium = polynomial(0.02);
  for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
  {
    Scene scene = exactScene(oblique);
    scene.integrator = integrator;
    scene.stepSize = integrator == Integrator::Leapfrog ? 0.01 : 1;
    scene.adaptiveTolerance = 1e-10;
    expectSameRays(medium, scene, medium.flow);
  }
}

} // namespace

} // namespace schlieren
