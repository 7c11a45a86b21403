// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rays in media, in grids and at places at the ends of the possible.
#include "ClosedForms.h"

namespace schlieren
{

namespace
{

class RayExtremes : public OnDevice
{
protected:
  Scene sceneOf(const View& view) const
  {
    Scene scene;
    scene.device = GetParam();
    scene.samplesPerPixel = 1;
    scene.pathModel = PathModel::Refracted;
    scene.view = view;
    return scene;
  }

  void expectTrapped(Integrator integrator) const;
};

void expectFinite(const Image& image)
{
  for (const auto* values : { &image.intensity, &image.deflection, &image.displacement })
  {
    EXPECT_TRUE(std::all_of(
      values->begin(), values->end(), [](float value) { return std::isfinite(value); }));
  }
  EXPECT_TRUE(std::all_of(image.opticalPathDifference.begin(), image.opticalPathDifference.end(),
    [](double value) { return std::isfinite(value); }));
}

/// n^2 = 1 + e + a x, n from 1 to 1 + peak over 128 voxels. Relative errors, so that digits that get lost
/// show. The interpolation's own error, h^2 / 12 times the third derivative of n, 3/8 a^3 / n^5, is
/// relative to a / 2. In single precision a sample's rounding, 2^-24 of the peak, is all along the ray
/// beside the difference of its neighbours, 1/128 of it; three times that for the sums it is in.
TEST_P(RayExtremes, RelativeAccuracyDoesNotDependOnTheStrength)
{
  for (const double peak : { 1e-14, 1e-9, 1e-4, 0.3, 3. })
  {
    // n from 1 to 1 + peak over x = -1 ... 1.
    const double square = peak * (2 + peak);
    const double a = square / 2;
    const ClosedForm form = linearMedium(square / 2, { a, 0, 0 });
    const Grid grid = boxGrid(1. / 64, { 1, 0.125, 0.5 });
    for (const Precision precision : bothPrecisions)
    {
      SCOPED_TRACE(std::to_string(std::log10(peak)) + " " + name(precision));
      SampledField<double> field = sampled(grid, form);
      field.field.ambient = 0;
      Scene scene = sceneOf(raysAround({ 0, 0.03, 0 }, 17, 1, 0.05));
      scene.precision = precision;
      scene.integrator =
        precision == Precision::Double ? Integrator::Adaptive : Integrator::Leapfrog;
      scene.adaptiveTolerance = 1e-9;
      const Image image = Bench().render(field.field, scene);
      double deflection = 0, displacement = 0, path = 0;
      for (int i = 0; i < image.width; ++i)
      {
        const double x = centreOf(image, i, 0).u;
        const double excess = form.excess({ x, 0, 0 });
        const double nu = form.refractivity({ x, 0, 0 });
        const double tau = 1 / (1 + nu); // depth 1, p_z = n
        const double shift = a * tau * tau / 4;
        const double bend = a * tau / 2 / std::sqrt(1 + excess + a * shift);
        // The integral of n^2 - p_z, in which no 1 cancels.
        const double opd = (excess - nu) * tau + a * a * tau * tau * tau / 12;
        const Reading ray = readingOf(image, static_cast<std::size_t>(i));
        deflection = std::max(deflection, std::abs(ray.deflection[0] / bend - 1));
        displacement = std::max(displacement, std::abs(ray.displacement[0] / shift - 1));
        path = std::max(path, std::abs(ray.opticalPathDifference / opd - 1));
      }
      const double ofGrid = 0.75 * a * a / (64 * 64 * 12.);
      const double rounding = precision == Precision::Double ? 2e-7 : 3 * 128 * std::exp2(-24);
      // The leapfrog's optical path: h^2 / 24 times the curvature of nu along the ray, and its last step.
      const double ofMethod =
        precision == Precision::Double ? 0 : (1 + a) * a / (24 * 64 * 64.) + a / (64 * 64.);
      EXPECT_LT(deflection, ofGrid + ofMethod + rounding);
      EXPECT_LT(displacement, ofGrid + rounding);
      EXPECT_LT(path, ofGrid + ofMethod + 4e-6);
    }
  }
}

/// A plasma's edge, n^2 = 1 - z: light that comes in at an angle goes up to where n is the sine of it, and
/// back on a parabola. Where it then still goes towards the film, it arrives as from a mirror.
TEST_P(RayExtremes, PlasmaReflectsAsItShould)
{
  const ClosedForm plasma = linearMedium(0, { 0, 0, -1 });
  Grid grid = boxGrid(1. / 64, { 2.5, 0.125, 0.46875 });
  grid.origin[2] = 0; // n^2 = 1 ... 0.0625
  SampledField<double> field = sampled(grid, plasma);
  field.field.ambient = 0;
  for (const double degrees : { 50., 60., 65. })
  {
    SCOPED_TRACE(degrees);
    const double sine = std::sin(degrees * radiansPerDegree);
    const double cosine = std::cos(degrees * radiansPerDegree);
    Scene scene = sceneOf(raysAround({ -1.5, 0, 0 }, 5, 1, 0.01));
    scene.view.viewDirection = { -sine, 0, -cosine };
    scene.precision = Precision::Double;
    scene.interpolation = Interpolation::Cubic;
    scene.integrator = Integrator::Adaptive;
    scene.adaptiveTolerance = 1e-9;
    scene.stepSize = 0.5;
    const Image image = Bench().render(field.field, scene);
    EXPECT_EQ(image.raysLost, 0);
    const Worst errors = errorsOf(plasma, grid, image);
    EXPECT_LT(errors.deflection, 1e-6);
    EXPECT_LT(errors.displacement, 5e-6);
    EXPECT_LT(errors.opticalPathDifference, 1e-6);
    // Turned by 180 degrees less twice the angle.
    EXPECT_NEAR(std::hypot(image.deflection[0], image.deflection[1]),
      std::sin((180 - 2 * degrees) * radiansPerDegree), 1e-6);
  }
  // Steeper light is sent back to where it came from: no film there.
  for (const double degrees : { 30., 40., 44.9 })
  {
    SCOPED_TRACE(degrees);
    const double angle = degrees * radiansPerDegree;
    Scene scene = sceneOf(raysAround({ -1.5, 0, 0 }, 5, 1, 0.01));
    scene.view.viewDirection = { -std::sin(angle), 0, -std::cos(angle) };
    for (const Integrator integrator : allIntegrators)
    {
      scene.integrator = integrator;
      const Image image = Bench().render(field.field, scene);
      EXPECT_EQ(image.raysLost, image.raysTraced) << name(integrator);
      expectFinite(image);
    }
  }
}

/// Turning points just before and just behind the far face: a ray leaves through it almost along it, or
/// turns and comes back. All are distinguished, and none gets lost in between.
TEST_P(RayExtremes, RaysGrazeTheTurningPoint)
{
  const ClosedForm plasma = linearMedium(0, { 0, 0, -1 });
  Grid grid = boxGrid(1. / 32, { 4, 0.125, 0.25 });
  grid.origin[2] = 0; // n^2 = 1 ... 0.5: at 45 degrees the turning point is on the far face
  SampledField<double> field = sampled(grid, plasma);
  field.field.ambient = 0;
  for (const double degrees : { 45.001, 45.01, 45.1, 46., 48. })
  {
    SCOPED_TRACE(degrees);
    const double angle = degrees * radiansPerDegree;
    Scene scene = sceneOf(raysAround({ -2, 0, 0 }, 1, 1, 0.01));
    scene.view.viewDirection = { -std::sin(angle), 0, -std::cos(angle) };
    scene.integrator = Integrator::Adaptive;
    scene.adaptiveTolerance = 1e-9;
    scene.stepSize = 0.25;
    const Image image = Bench().render(field.field, scene);
    EXPECT_EQ(image.raysLost, 0);
    // Almost square to the light.
    EXPECT_NEAR(std::hypot(image.deflection[0], image.deflection[1]),
      std::sin((180 - 2 * degrees) * radiansPerDegree), 2e-3);
    expectFinite(image);
  }
  for (const double degrees : { 44.9, 44.999, 45. })
  {
    SCOPED_TRACE(degrees);
    const double angle = degrees * radiansPerDegree;
    for (const Integrator integrator : allIntegrators)
    {
      Scene scene = sceneOf(raysAround({ -2, 0, 0 }, 5, 1, 0.01));
      scene.view.viewDirection = { -std::sin(angle), 0, -std::cos(angle) };
      scene.integrator = integrator;
      const Image image = Bench().render(field.field, scene);
      expectFinite(image);
      EXPECT_GT(image.raysTraced, 0);
      for (const float cosine : image.deflection)
      {
        EXPECT_LE(std::abs(cosine), 1);
      }
    }
  }
}

/// Head on to where the index vanishes, n^2 = 1 - z: light slows down and gets through or is abandoned.
TEST_P(RayExtremes, LightIntoAVanishingIndexComesToAnEnd)
{
  const ClosedForm plasma = linearMedium(0, { 0, 0, -1 });
  for (const double rest : { 1e-2, 1e-4, 1e-6, 1e-10 })
  {
    Grid grid = boxGrid(1. / 32, { 0.25, 0.25, 0.5 });
    grid.spacing[2] *= 1 - rest;
    grid.origin[2] = 0; // n^2 = 1 ... rest
    SampledField<double> field = sampled(grid, plasma);
    field.field.ambient = 0;
    for (const Integrator integrator : allIntegrators)
    {
      SCOPED_TRACE(std::to_string(std::log10(rest)) + " " + name(integrator));
      Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 3, 3, 0.1));
      scene.integrator = integrator;
      const Image image = Bench().render(field.field, scene);
      EXPECT_GT(image.raysTraced, 0);
      expectFinite(image);
      for (const float cosine : image.deflection)
      {
        EXPECT_NEAR(cosine, 0, 1e-3);
      }
    }
  }
}

/// Thin matter, in which n is far below 1, as in a plasma near its critical density: light goes through.
TEST_P(RayExtremes, LightCrossesThinMatter)
{
  for (const double index : { 0.5, 0.2, 0.05, 0.01 })
  {
    SampledField<double> field(cube(17, 1), [&](double, double, double) { return index - 1; });
    field.field.ambient = 0;
    Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 3, 3, 0.1));
    scene.precision = Precision::Double;
    for (const Integrator integrator : allIntegrators)
    {
      SCOPED_TRACE(std::to_string(index) + " " + name(integrator));
      scene.integrator = integrator;
      const Image image = Bench().render(field.field, scene);
      EXPECT_EQ(image.raysLost, 0);
      // A last step is as good as done a thousandth of it before its end.
      EXPECT_NEAR(image.opticalPathDifference[4] / (2 * (index - 1)), 1, 2e-4);
    }
  }
}

/// Light that is guided in zigzags of ever steeper angle, up to going nowhere at all: what takes too long
/// is abandoned and counted, after a number of steps that is bounded.
void RayExtremes::expectTrapped(Integrator integrator) const
{
  // n = 0.02 ... 4, smooth and even at the sides.
  const auto index = [](double x)
  {
    const double c = std::cos(pi / 2 * x);
    return 0.02 + 3.98 * c * c;
  };
  // So fine that steps are not adaptive.
  constexpr double spacing = 1. / 192;
  SampledField<double> field(boxGrid(spacing, { 1, 4 * spacing, 1 }),
    [&](double x, double, double) { return index(x) - 1; });
  field.field.ambient = 0;
  Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 65, 1, 1. / 32.5));
  SCOPED_TRACE(name(integrator));
  scene.integrator = integrator;
  scene.stepSize = 1;
  const Image image = Bench().render(field.field, scene);
  expectFinite(image);
  EXPECT_LT(image.raysLost, image.raysTraced / 2); // those of the middle get through
  if (integrator == Integrator::Leapfrog)
  {
    EXPECT_GT(image.raysLost, 0);
  }
  // Thinner matter and shorter steps than leapfrog's are reasons to take more.
  const double maxSteps = integrator == Integrator::Adaptive ? 1000 : 500;
  const double straightSteps = 2 / spacing + 1;
  EXPECT_LT(static_cast<double>(image.stepsTaken),
    maxSteps * straightSteps * static_cast<double>(image.raysTraced));
}

/// A layer of one voxel that is 150 times as deep as wide, in which rays are bent across several of
/// them, as in the closed form: whatever step is chosen, and however small the tolerance.
TEST_P(RayExtremes, LayersOfGlassAreTracedWithAnyStep)
{
  const ClosedForm form = oscillator(1.5, { 0.8, 0.4, 0 });
  Grid grid = boxGrid(0.02, { 0.8, 0.8, 0.02 });
  grid.dimensions[2] = 2;
  grid.spacing[2] = 3;
  grid.origin[2] = -1.5;
  SampledField<double> field = sampled(grid, form);
  field.field.ambient = 0;
  Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 9, 9, 0.12));
  scene.interpolation = Interpolation::Cubic;
  for (const double voxels : { 4., 1., 0.5, 0.25, 0.125, 0.05 })
  {
    SCOPED_TRACE(voxels);
    scene.stepSize = voxels;
    const Image image = Bench().render(field.field, scene);
    EXPECT_LT(errorsOf(form, grid, image).deflection, 1e-5 * std::max(1., voxels * voxels));
  }
  // A step from one voxel to the next, of which splines make kinks.
  SampledField<double> step(grid, [](double x, double, double) { return x < 0 ? 0.6 : 1.6; });
  step.field.ambient = 0;
  scene.integrator = Integrator::Adaptive;
  scene.precision = Precision::Double;
  scene.stepSize = 1;
  for (const double tolerance : { 1e-5, 1e-8, 1e-12 })
  {
    SCOPED_TRACE(tolerance);
    scene.adaptiveTolerance = tolerance;
    EXPECT_EQ(Bench().render(step.field, scene).raysLost, 0);
  }
}

/// Where the medium is steep, steps are adaptive, whatever their length: no shorter one is worse.
TEST_P(RayExtremes, ShorterStepsAreNoWorseWhereTheMediumIsSteep)
{
  SampledField<float> field(cube(17, 8),
    [](double x, double y, double z)
    { return 0.15 + 0.1 * std::sin(0.8 * x) * std::sin(0.7 * y + 1) * std::cos(0.9 * z); });
  View fitted;
  fitted.width = 20;
  fitted.height = 20;
  fitted.viewDirection = { -0.3, 0.2, -1 };
  Scene scene = sceneOf(fitted);
  scene.precision = Precision::Double;
  scene.interpolation = Interpolation::Cubic;
  scene.adaptiveTolerance = 1e-9;
  scene.stepSize = 1;
  const Image truth = Bench().render(field.field, scene);
  EXPECT_EQ(truth.integrator, Integrator::Adaptive);
  scene.adaptiveTolerance = Scene().adaptiveTolerance;
  for (const double step : { 1., 0.5, 0.25, 0.125 })
  {
    scene.stepSize = step;
    const Image image = Bench().render(field.field, scene);
    double sum = 0;
    for (std::size_t i = 0; i < image.deflection.size(); ++i)
    {
      const double error = image.deflection[i] - truth.deflection[i];
      sum += error * error;
    }
    const double error = std::sqrt(sum / static_cast<double>(image.deflection.size()));
    EXPECT_LT(error, 1e-6) << step; // leapfrog with steps of a quarter: 1e-4
  }
}

TEST_P(RayExtremes, TrappedRaysAreCountedInBoundedTime) { expectTrapped(Integrator::Leapfrog); }

TEST_P(RayExtremes, AdaptiveCountsTrappedRaysInBoundedTime) { expectTrapped(Integrator::Adaptive); }

/// Total reflection inside glass. One voxel takes n from 1.5 to 1, in z. What runs along the step is kept,
/// so that light is reflected exactly, or refracted by Snell's law.
TEST_P(RayExtremes, OneVoxelRefractsAndReflectsAsASurface)
{
  Grid grid = boxGrid(1. / 16, { 6, 0.25, 1 });
  SampledField<double> field(grid, [](double, double, double z) { return z < 0.03 ? 0.5 : 0; });
  field.field.ambient = 0.5;
  for (const Interpolation interpolation : allInterpolations)
  {
    for (const double degrees : { 0., 20., 35., 46., 60. }) // critical: 41.8
    {
      SCOPED_TRACE(std::string(name(interpolation)) + " " + std::to_string(degrees));
      const double angle = degrees * radiansPerDegree;
      Scene scene = sceneOf(raysAround({ 0, 0.01, 0 }, 3, 1, 0.01));
      scene.view.viewDirection = { -std::sin(angle), 0, -std::cos(angle) };
      scene.interpolation = interpolation;
      scene.precision = Precision::Double;
      scene.integrator = Integrator::Adaptive;
      scene.stepSize = 1. / 16;
      const Image image = Bench().render(field.field, scene);
      EXPECT_EQ(image.raysLost, 0);
      const double sine = 1.5 * std::sin(angle);
      const double turned = sine < 1 ? std::asin(sine) - angle : pi - 2 * angle;
      for (int i = 0; i < image.width; ++i)
      {
        const Reading ray = readingOf(image, static_cast<std::size_t>(i));
        EXPECT_NEAR(std::abs(ray.deflection[0]), std::abs(std::sin(turned)), 1e-3);
        EXPECT_NEAR(ray.deflection[1], 0, 1e-9);
      }
    }
  }
}

/// All rays of an image of a box, against the piece of line inside it: a field that is linear is
/// interpolated exactly by every scheme, on every grid, up to its faces.
void compareWithChords(const Grid& grid, const Scene& scene, const Vector& viewDirection)
{
  SCOPED_TRACE("view " + std::to_string(viewDirection[0]) + " " + std::to_string(viewDirection[1]) +
    " " + std::to_string(viewDirection[2]));
  const Point slope{ 1e-9, -2e-9, 3e-9 };
  const ClosedForm still = linearMedium(0, { 0, 0, 0 }); // for rays as straight as these
  SampledField<double> field(grid,
    [&](double x, double y, double z) {
      return 4e-8 + dot(slope, Point{ x, y, z });
    });
  field.field.ambient = 0;
  Scene here = scene;
  here.view.viewDirection = viewDirection;
  here.view.viewUp =
    std::abs(viewDirection[1]) > std::abs(viewDirection[2]) ? Vector{ 0, 0, 1 } : Vector{ 0, 1, 0 };
  const Image image = Bench().render(field.field, here);
  EXPECT_EQ(image.raysLost, 0);
  const GridBox box = boxOf(grid);
  const Point w = asPoint(image.frame.w);
  Worst errors, size;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      RayState start{};
      Reading exact{};
      if (entering(still, box, image.frame, centreOf(image, column, row), start))
      {
        const RayState end = leaving(still, start, box);
        const double chord = length(end.position - start.position);
        const Point middle = 0.5 * (start.position + end.position);
        const double bendU = chord * dot(slope, asPoint(image.frame.u));
        const double bendV = chord * dot(slope, asPoint(image.frame.v));
        const double rest = image.frame.exit - dot(end.position, w);
        exact = { { bendU, bendV }, { bendU * (chord / 2 + rest), bendV * (chord / 2 + rest) },
          chord * (4e-8 + dot(slope, middle)) };
      }
      errors.include(readingOf(image, pixelOf(image, column, row)), exact);
      size.include(exact);
    }
  }
  EXPECT_GT(size.deflection, 0);
  const bool isDouble = scene.precision == Precision::Double;
  // In single precision: the rounding of samples of up to 5e-8, per voxel. What makes spline coefficients of
  // them magnifies it, in three dimensions some times.
  const double depth = image.frame.exit - image.frame.entry;
  const double rounding = isDouble ? 0 : 8 * 5e-8 * std::exp2(-24) * depth;
  const double finest = std::min({ grid.spacing[0], grid.spacing[1], grid.spacing[2] });
  EXPECT_LT(errors.deflection, 1e-6 * size.deflection + rounding / finest);
  EXPECT_LT(errors.displacement, 1e-6 * size.displacement + rounding / finest * depth);
  EXPECT_LT(errors.opticalPathDifference, 1e-6 * size.opticalPathDifference + rounding);
}

/// Along the grid's axes and its diagonals, and hardly off them.
const std::vector<Vector> straightViews = { { 0, 0, -1 }, { 0, 0, 1 }, { 0, -1, 0 }, { 0, 1, 0 },
  { -1, 0, 0 }, { 1, 0, 0 }, { -1, -1, 0 }, { 0, 1, -1 }, { 1, 0, -1 }, { -1, -1, -1 },
  { 1, -1, 1 } };
const std::vector<Vector> tiltedViews = { { 1e-7, 0, -1 }, { 1e-12, -1e-12, -1 },
  { -1, 1e-3, 1e-9 }, { 1, 1 + 1e-9, 1e-9 } };

/// Pixels on the grid's planes: rays run exactly along faces, edges and planes of the grid, and through
/// its corners. All numbers are exact in binary. A straight ray stays where it is.
TEST_P(RayExtremes, RaysOnGridPlanesFacesEdgesAndCorners)
{
  for (const Precision precision : bothPrecisions)
  {
    for (const Interpolation interpolation : allInterpolations)
    {
      SCOPED_TRACE(std::string(name(precision)) + " " + name(interpolation));
      Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 17, 17, 0.125));
      scene.precision = precision;
      scene.interpolation = interpolation;
      scene.pathModel = PathModel::Straight;
      for (const Vector& viewDirection : straightViews)
      {
        compareWithChords(cube(9, 1), scene, viewDirection);
      }
    }
  }
}

/// Bent rays leave at once where they run on a face and are bent out of it, so here none does. Rays that
/// start inside a cell, at its side, or cross hardly any of the grid.
TEST_P(RayExtremes, BentRaysHaveTheirChords)
{
  for (const Integrator integrator : allIntegrators)
  {
    for (const Interpolation interpolation : allInterpolations)
    {
      SCOPED_TRACE(std::string(name(integrator)) + " " + name(interpolation));
      Scene scene = sceneOf(raysAround({ 0.013, 0.0071, 0.0043 }, 23, 23, 0.124));
      scene.interpolation = interpolation;
      scene.integrator = integrator;
      scene.precision = Precision::Double;
      for (const std::vector<Vector>& views : { straightViews, tiltedViews })
      {
        for (const Vector& viewDirection : views)
        {
          compareWithChords(cube(9, 1), scene, viewDirection);
        }
      }
    }
  }
}

/// On a face light is bent out of the grid or into it, but never gets lost.
TEST_P(RayExtremes, BentRaysOnFacesComeToAnEnd)
{
  for (const Interpolation interpolation : allInterpolations)
  {
    for (const Integrator integrator : allIntegrators)
    {
      SCOPED_TRACE(std::string(name(interpolation)) + " " + name(integrator));
      SampledField<float> field(
        cube(9, 1), [](double x, double y, double z) { return 1e-3 * (x - 2 * y + 0.5 * z); });
      field.field.ambient = 0;
      Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 17, 17, 0.125));
      scene.interpolation = interpolation;
      scene.integrator = integrator;
      for (const Vector& viewDirection : { Vector{ 0, 0, -1 }, Vector{ 0, 0, 1 } })
      {
        scene.view.viewDirection = viewDirection;
        const Image image = Bench().render(field.field, scene);
        EXPECT_EQ(image.raysLost, 0);
        expectFinite(image);
        for (std::size_t pixel = 0; pixel < 17 * 17; ++pixel)
        {
          EXPECT_LE(std::abs(image.deflection[2 * pixel]), 1.01 * 2e-3);
          EXPECT_LE(std::abs(image.deflection[2 * pixel + 1]), 1.01 * 4e-3);
        }
        // The grid's middle plane is like any other place: light is bent by the depth of 2.
        const std::size_t middle = pixelOf(image, 8, 8);
        EXPECT_NEAR(std::abs(image.deflection[2 * middle]), 2e-3, 2e-5);
        EXPECT_NEAR(image.deflection[2 * middle + 1], -4e-3, 4e-5);
      }
    }
  }
}

/// Rays that leave through a side along which they nearly run: rounding of a place is a long way for these. They are as
/// exact as others, with steps that end there.
TEST_P(RayExtremes, RaysLeaveThroughASideThatTheyRunAlong)
{
  Grid grid;
  grid.dimensions = { 32, 21, 21 };
  SampledField<float> field(grid,
    [](double x, double y, double z)
    { return 1e-3 * std::sin(0.9 * x + 1) * std::sin(1.1 * y + 2) * std::cos(1.3 * z); });
  field.field.ambient = 0;
  View fitted;
  fitted.width = 161;
  fitted.height = 161;
  fitted.viewDirection = { -1, -8e-3, -0.012 };
  Scene scene = sceneOf(fitted);
  scene.stepSize = 0.125;
  scene.precision = Precision::Double;
  scene.integrator = Integrator::Leapfrog;
  const Image truth = Bench().render(field.field, scene);
  const double largest = std::abs(*std::max_element(truth.deflection.begin(),
    truth.deflection.end(), [](float a, float b) { return std::abs(a) < std::abs(b); }));
  for (const Integrator integrator : allIntegrators)
  {
    SCOPED_TRACE(name(integrator));
    scene.precision = Precision::Single;
    scene.integrator = integrator;
    const Image image = Bench().render(field.field, scene);
    EXPECT_EQ(image.raysLost, 0);
    for (std::size_t i = 0; i < image.deflection.size(); ++i)
    {
      ASSERT_NEAR(image.deflection[i], truth.deflection[i], 5e-3 * largest) << i;
    }
  }
}

TEST_P(RayExtremes, SmallestAndFlattestGrids)
{
  using Dimensions = std::array<std::int64_t, 3>;
  for (const Dimensions& dimensions : { Dimensions{ 2, 2, 2 }, { 2, 5, 3 }, { 5, 2, 3 },
         { 3, 3, 2 }, { 2, 2, 9 }, { 3, 3, 3 }, { 4, 3, 2 }, { 2, 9, 8 } })
  {
    Grid grid;
    grid.dimensions = dimensions;
    grid.spacing = { 0.5, 0.75, 1.25 };
    grid.origin = { -0.3, 0.1, -2 };
    for (const Interpolation interpolation : allInterpolations)
    {
      SCOPED_TRACE(std::to_string(dimensions[0]) + " " + std::to_string(dimensions[1]) + " " +
        std::to_string(dimensions[2]) + " " + name(interpolation));
      View fitted;
      fitted.width = 19;
      fitted.height = 17;
      Scene scene = sceneOf(fitted);
      scene.interpolation = interpolation;
      scene.precision = Precision::Double;
      for (const Vector& viewDirection :
        { Vector{ 0, 0, -1 }, Vector{ -1, 0, 0 }, Vector{ 0, 1, 0 }, Vector{ -0.3, 0.5, -0.8 } })
      {
        compareWithChords(grid, scene, viewDirection);
      }
    }
  }
}

/// 1e7 wavelengths of optical path, to less than 1/1000 of a fringe: 1e-10.
TEST_P(RayExtremes, PhaseOfTenMillionFringes)
{
  const double wavelength = 632.8e-9;
  const double fringes = 1e7;
  // A slab: nothing bends.
  SampledField<double> slab(cube(101, 1), [](double, double, double) { return 1e-3; });
  slab.field.ambient = 0;
  slab.field.lengthScale = fringes * wavelength / (2 * 1e-3);
  Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 5, 5, 0.11));
  scene.precision = Precision::Double;
  for (const Integrator integrator : allIntegrators)
  {
    for (const double step : { 1., 0.01 })
    {
      scene.integrator = integrator;
      scene.stepSize = step;
      const Image image = Bench().render(slab.field, scene);
      for (const double path : image.opticalPathDifference)
      {
        EXPECT_NEAR(path / wavelength, fringes, 1e-3) << name(integrator) << ' ' << step;
      }
    }
  }
  // n^2 = 1 + e + a x, in which rays are parabolas.
  const double a = 1e-3;
  const ClosedForm form = linearMedium(2e-3, { a, 0, 0 });
  SampledField<double> wedge = sampled(cube(101, 1), form);
  wedge.field.ambient = 0;
  wedge.field.lengthScale = fringes * wavelength / (2 * 1e-3);
  scene.integrator = Integrator::Adaptive;
  scene.adaptiveTolerance = 1e-9;
  scene.stepSize = 0.5;
  const Image image = Bench().render(wedge.field, scene);
  double most = 0;
  for (int i = 0; i < image.width; ++i)
  {
    const double x = centreOf(image, i, 2).u;
    const double nu = form.refractivity({ x, 0, 0 });
    const double tau = 2 / (1 + nu);
    const double exact = (form.excess({ x, 0, 0 }) - nu) * tau + a * a * tau * tau * tau / 12;
    const double found = image.opticalPathDifference[pixelOf(image, i, 2)];
    EXPECT_NEAR(found / wavelength, exact * wedge.field.lengthScale / wavelength, 1e-3);
    most = std::max(most, found / wavelength);
  }
  EXPECT_GT(most, 1e7);
}

/// Numbers at the end of what can be written down: an image all the same.
TEST_P(RayExtremes, DenormalValues)
{
  for (const double peak : { 1e-40, 1e-44, 1e-300, 1e-310, 5e-324 })
  {
    for (const Precision precision : bothPrecisions)
    {
      for (const Interpolation interpolation : allInterpolations)
      {
        SampledField<double> field(
          cube(9, 1), [&](double x, double y, double) { return peak * std::exp(-x * x - y * y); });
        field.field.ambient = 0;
        View fitted;
        fitted.width = fitted.height = 16;
        Scene scene = sceneOf(fitted);
        scene.precision = precision;
        scene.interpolation = interpolation;
        for (const PathModel model : { PathModel::Refracted, PathModel::Straight })
        {
          SCOPED_TRACE(name(model));
          scene.pathModel = model;
          const Image image = Bench().render(field.field, scene);
          expectFinite(image);
          EXPECT_EQ(image.raysLost, 0);
          for (std::size_t pixel = 0; pixel < 256; ++pixel)
          {
            EXPECT_LE(std::abs(image.deflection[2 * pixel]), 1e-39);
            EXPECT_LE(std::abs(image.opticalPathDifference[pixel]), 1e-39);
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, RayExtremes, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
