// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Lenses and prisms in which every ray is known: the closed forms against an integration of their own,
// then the tracer against the closed forms.
#include "AnalyticSources.h"
#include "ClosedForms.h"

namespace schlieren
{

namespace
{

/// A medium and the box that it is looked at in.
struct Case
{
  const char* name;
  ClosedForm form;
  Point half;  ///< of the box
  Point reach; ///< of the rays: u, v
  double bend; ///< largest |grad n^2| / 2 in the box
};

const double rodIndex = 1.5;

std::vector<Case> strongMedia()
{
  return {
    // A prism of n = 1.02 ... 1.72.
    { "linear", linearMedium(1, { 0.8, -0.5, 0.6 }), { 0.5, 0.5, 0.5 }, { 0.45, 0.45, 0 }, 0.56 },
    // Three pitches of a rod.
    { "rod", oscillator(rodIndex, { rodIndex, rodIndex, 0 }), { 0.4, 0.4, 3 * pi },
      { 0.35, 0.35, 0 }, 1.3 },
    { "Luneburg", oscillator(std::sqrt(2), { 1, 1, 1 }), { 0.5, 0.5, 0.8 }, { 0.45, 0.45, 0 },
      1.1 },
    { "fish-eye", fishEye(1.5), { 0.6, 0.6, 0.5 }, { 0.5, 0.5, 0 }, 1.2 },
  };
}

Scene raysThrough(const Case& medium, Device device)
{
  Scene scene;
  scene.device = device;
  scene.samplesPerPixel = 1;
  scene.pathModel = PathModel::Refracted;
  scene.view = raysAround({ 0.01, -0.02, 0 }, 9, 9, 2 * medium.reach.x / 9);
  return scene;
}

/// Largest derivative along an axis, of the third or fourth order, of n^2 / 2 with the first of its factors
/// n held: that is how the tracer takes it. By differences, at some places of the box.
double largestDerivative(const Case& medium, int order)
{
  constexpr double d = 0.01;
  const double places[] = { -0.98, -0.8, -0.5, 0, 0.3, 0.6, 0.98 };
  double most = 0;
  for (const double x : places)
  {
    for (const double y : places)
    {
      for (const double z : places)
      {
        for (const Point& axis : { Point{ 1, 0, 0 }, Point{ 0, 1, 0 }, Point{ 0, 0, 1 } })
        {
          const auto n = [&](double i) {
            return 1 +
              medium.form.refractivity(scaled(Point{ x, y, z }, medium.half) + (i * d) * axis);
          };
          const double difference = order == 3 ? n(1.5) - 3 * n(0.5) + 3 * n(-0.5) - n(-1.5)
                                               : n(2) - 4 * n(1) + 6 * n(0) - 4 * n(-1) + n(-2);
          most = std::max(most, n(0) * std::abs(difference));
        }
      }
    }
  }
  return most / std::pow(d, order);
}

TEST(ClosedForms, ObeyTheRayEquation)
{
  for (const Case& medium : strongMedia())
  {
    SCOPED_TRACE(medium.name);
    const GridBox box{ -1.0 * medium.half, medium.half };
    for (const Point& direction : { Point{ 0, 0, 1 }, Point{ 0.48, -0.36, 0.8 } })
    {
      for (const Point& entry : { Point{ 0.31, 0.2, -1 }, Point{ -0.2, 0.3, -1 } })
      {
        const Point x{ entry.x, entry.y, -medium.half.z };
        const RayState start{ x, std::sqrt(1 + medium.form.excess(x)) * direction, 0 };
        const RayState exact = leaving(medium.form, start, box);
        const RayState numerical = integrated(medium.form, start, box);
        EXPECT_LT(length(exact.position - numerical.position), 1e-9);
        EXPECT_LT(length(exact.momentum - numerical.momentum), 1e-9);
        EXPECT_LT(std::abs(exact.path - numerical.path), 1e-9);
        EXPECT_NEAR(
          dot(exact.momentum, exact.momentum), 1 + medium.form.excess(exact.position), 1e-12);
      }
    }
  }
}

/// The leapfrog's own error. In an oscillator dx/dtau = p, dp/dtau = -k^2 x it is exactly solvable: one
/// step of h turns phase space by the angle arccos(1 - k^2 h^2 / 2) = k h (1 + k^2 h^2 / 24 + ...), on
/// the ellipse p = -k x sqrt(1 - k^2 h^2 / 4)^-1... So after tau the phase is off by k^3 h^2 tau / 24 and
/// the amplitude of p by a fraction of k^2 h^2 / 8.
TEST(ClosedForms, LeapfrogErrorIsAsDerived)
{
  const double k = rodIndex;
  const ClosedForm rod = oscillator(k, { k, 0, 0 });
  const GridBox box{ { -1, -1, -1 }, { 1, 1, 3 } };
  const double x0 = 0.5;
  const RayState start{ { x0, 0, -1 }, { 0, 0, k * std::sqrt(1 - x0 * x0) }, 0 };
  const RayState exact = leaving(rod, start, box);
  const double tau = 4 / start.momentum.z;
  for (const double h : { 0.05, 0.02 })
  {
    const RayState found = leapfrogged(rod, start, box, h);
    const double phase = k * k * k * h * h * tau / 24;
    EXPECT_NEAR(
      found.position.x - exact.position.x, -x0 * std::sin(k * tau) * phase, 0.15 * x0 * phase);
    EXPECT_NEAR(found.momentum.x - exact.momentum.x,
      -k * x0 * (std::cos(k * tau) * phase + std::sin(k * tau) * k * k * h * h / 8),
      0.15 * k * x0 * phase);
  }
}

/// A drop of radius 1, whose surface is as thick as a few cells.
class DropSource : public AnalyticSource
{
public:
  static constexpr double excess = 0.33; ///< its n - 1

  explicit DropSource(double cell)
    : AnalyticSource(1.25)
    , cell_(cell)
  {
  }
  double refractivity(double x, double y, double z) const override
  {
    return at(std::hypot(x, y, z));
  }
  Range rangeOver(const Box& box) const override
  {
    const auto [nearest, farthest] = distancesTo({ 0, 0, 0 }, box);
    return { at(farthest), at(nearest) };
  }
  double cellSizeOver(const Box&) const override { return cell_; }

private:
  double at(double radius) const { return 0.5 * excess * (1 - std::tanh((radius - 1) / cell_)); }

  double cell_;
};

/// Snell (1621): light at a distance b from the axis is turned by 2 (asin b - asin(b / n)).
TEST(Drop, IsMoreExactWithFinerCells)
{
  constexpr double n = 1 + DropSource::excess;
  double before = 1;
  for (const double cell : { 1. / 12, 1. / 24, 1. / 48 })
  {
    SCOPED_TRACE(cell);
    Scene scene;
    scene.samplesPerPixel = 1;
    scene.stepSize = 0.5;
    scene.view = raysAround({ 0, 0, 0 }, 21, 21, 0.07);
    const Image image = Bench().render(fieldOf(std::make_shared<DropSource>(cell)), scene);
    double squares = 0, rays = 0;
    for (int row = 0; row < image.height; ++row)
    {
      for (int column = 0; column < image.width; ++column)
      {
        const PixelCentre at = centreOf(image, column, row);
        const double b = std::hypot(at.u, at.v);
        if (b > 0.02 && b < 0.7)
        {
          const Reading ray = readingOf(image, pixelOf(image, column, row));
          const double sine = -std::sin(2 * (std::asin(b) - std::asin(b / n)));
          squares += std::pow(ray.deflection[0] - sine * at.u / b, 2) +
            std::pow(ray.deflection[1] - sine * at.v / b, 2);
          ++rays;
        }
      }
    }
    const double error = std::sqrt(squares / rays);
    EXPECT_LT(error, before);
    before = error;
  }
  EXPECT_LT(before, 0.003);
}

class StrongMedia : public OnDevice
{
};

/// Adaptive steps on the fourth-order interpolation, in double precision.
TEST_P(StrongMedia, AdaptiveOnACubicSplineIsExactToAMillionth)
{
  for (const Case& medium : strongMedia())
  {
    SCOPED_TRACE(medium.name);
    const double spacing = 1. / 80;
    const Grid grid = boxGrid(spacing, medium.half);
    SampledField<double> field = sampled(grid, medium.form);
    field.field.ambient = 0;
    Scene scene = raysThrough(medium, GetParam());
    scene.integrator = Integrator::Adaptive;
    scene.adaptiveTolerance = 1e-9;
    scene.interpolation = Interpolation::Cubic;
    scene.precision = Precision::Double;
    const Image image = Bench().render(field.field, scene);
    const Worst errors = errorsOf(medium.form, grid, image);
    EXPECT_LT(errors.deflection, 1e-6);
    EXPECT_LT(errors.displacement, 1e-6);
    EXPECT_LT(errors.opticalPathDifference, 1e-6);
    EXPECT_EQ(image.raysLost, 0);
  }
}

/// The default integrator in single precision at one step per voxel. The error is at most the sum of
/// - the method's own, which a leapfrog in the medium itself shows (derived above for oscillators);
/// - where it leaves: the last step ends where its tangent meets the face, up to F s^2 / 2 off for a step
///   s and a bend F = |grad n^2| / 2, in which n turns on by F and the path is n^2 - p.w longer;
/// - the spline's gradient, wrong by up to h^2 / 12 times the third derivative along each axis (quadratic)
///   or 0.008 h^3 times the fourth (cubic: the largest of the Bernoulli polynomial B3 / 6), all along the
///   ray. A kick moves the ray by its size at most: these media are an oscillator of a rate above 1, or no
///   deeper than 1;
/// - rounding, one of the gradient in each step, of which 4e-6 is generous.
TEST_P(StrongMedia, LeapfrogInSinglePrecisionIsAsExactAsDerived)
{
  for (const Case& medium : strongMedia())
  {
    const double h = 1. / 40;
    const Grid grid = boxGrid(h, medium.half);
    const GridBox box = boxOf(grid);
    SampledField<float> field = sampled<float>(grid, medium.form);
    field.field.ambient = 0;
    for (const Interpolation interpolation : { Interpolation::Quadratic, Interpolation::Cubic })
    {
      SCOPED_TRACE(std::string(medium.name) + " " + name(interpolation));
      Scene scene = raysThrough(medium, GetParam());
      scene.interpolation = interpolation;
      const Image image = Bench().render(field.field, scene);

      Worst method, errors;
      double tau = 0, densest = 0, forward = 1;
      forRays(medium.form, grid, image,
        [&](std::size_t pixel, const RayState& start, const RayState& end)
        {
          const Reading exact = readingOf(start, end, image.frame);
          method.include(
            readingOf(start, leapfrogged(medium.form, start, box, h), image.frame), exact);
          errors.include(readingOf(image, pixel), exact);
          forward = std::min({ forward, start.momentum.z, end.momentum.z });
          tau = std::max(tau, 2 * medium.half.z / std::min(start.momentum.z, end.momentum.z));
          densest = std::max(densest, 1 + medium.form.excess(end.position));
        });
      const double ofGrid = tau *
        (interpolation == Interpolation::Cubic
            ? 0.008 * std::pow(h, 3) * largestDerivative(medium, 4)
            : h * h / 12 * largestDerivative(medium, 3));
      const double atExit = medium.bend * h * h / 2 / forward;
      const double rounding = 4e-6;
      const double kicks = ofGrid + rounding;
      EXPECT_LT(errors.deflection, method.deflection + medium.bend * atExit + kicks);
      EXPECT_LT(errors.displacement, method.displacement + kicks);
      EXPECT_LT(
        errors.opticalPathDifference, method.opticalPathDifference + densest * (atExit + kicks));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, StrongMedia, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
