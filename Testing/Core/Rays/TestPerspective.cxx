// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Light that diverges from a camera's pupil: against rays that are integrated without the tracer, against closed forms
// of Gaussian balls, and against diverging light that is seen from the other side.
#include "AnalyticSources.h"
#include "ClosedForms.h"
#include "Messages.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace schlieren
{

namespace
{

constexpr double half = 3;

/// The point that all lines of sight go through.
Point pupilOf(const Image& image, const Scene& scene)
{
  return asPoint(*scene.view.focalPoint) + image.frame.pupil * asPoint(image.frame.w);
}

/// Where a pixel is in the plane of the focal point.
Point placeOf(const Image& image, const Scene& scene, int column, int row)
{
  const Frame& frame = image.frame;
  return asPoint(*scene.view.focalPoint) +
    ((column - 0.5 * (image.width - 1)) * frame.pixelSize) * asPoint(frame.u) +
    ((row - 0.5 * (image.height - 1)) * frame.pixelSize) * asPoint(frame.v);
}

/// What the bench should say of a pixel by Runge and Kutta's method in the medium itself.
Reading truthOf(const ClosedForm& form, const Image& image, const Scene& scene, const GridBox& box,
  int column, int row)
{
  const Point pupil = pupilOf(image, scene);
  const Point place = placeOf(image, scene, column, row);
  const Point d = (1 / length(place - pupil)) * (place - pupil);
  const Point first = box.contains(pupil) ? pupil
                                          : leaving(
                                              box,
                                              [&](double path) {
                                                return RayState{ place - path * d, d, 0 };
                                              },
                                              1. / 64)
                                              .position;
  const RayState start{ first, std::sqrt(1 + form.excess(first)) * d, 0 };
  const RayState end = integrated(form, start, box, 1. / 256);
  const Point w = asPoint(image.frame.w);
  const auto onFarPlane = [&](const Point& position, const Point& direction)
  { return position + ((image.frame.entry - dot(position, w)) / dot(direction, w)) * direction; };
  const Point landed = onFarPlane(end.position, end.momentum);
  const Point moved = landed - onFarPlane(place, d);
  const Point turned = (1 / length(end.momentum)) * end.momentum - d;
  const Point u = asPoint(image.frame.u), v = asPoint(image.frame.v);
  return { { dot(turned, u), dot(turned, v) }, { dot(moved, u), dot(moved, v) },
    end.path + length(landed - end.position) - dot(landed - start.position, d) };
}

/// A pupil at such a distance from the focal point.
void setPupil(View& view, double distance)
{
  view.viewAngle = 2 * std::atan(view.parallelScale / distance) / radiansPerDegree;
}

Scene perspectiveScene(Device device, double distance, const Vector& focalPoint = { 0.1, 0.2, 0.5 })
{
  Scene scene;
  scene.device = device;
  scene.samplesPerPixel = 1;
  scene.pathModel = PathModel::Refracted;
  scene.view = raysAround(focalPoint, 7, 7, 0.33);
  setPupil(scene.view, distance);
  return scene;
}

class Perspective : public OnDevice
{
};

TEST_P(Perspective, IsBentAsTheEquationOfRaysSays)
{
  const Grid grid = boxGrid(1. / 16, { half, half, half });
  for (const auto& [form, peak] : { std::pair{ blob(0.05), 0.05 }, std::pair{ blob(1e-6), 1e-6 },
         std::pair{ linearMedium(3e-3, { 6e-4, -9e-4, 3e-4 }), 3e-3 } })
  {
    const SampledField<double> medium = sampled(grid, form);
    Field field = medium.field;
    field.ambient = 0;
    Bench bench;
    for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ -0.5, 0.4, -0.8 } })
    {
      for (const double distance : { 1e3, 8., 1.3 }) // the last one is within the data
      {
        SCOPED_TRACE("pupil at " + std::to_string(distance) + ", peak " + std::to_string(peak));
        Scene scene = perspectiveScene(GetParam(), distance);
        scene.view.viewDirection = direction;
        scene.precision = Precision::Double;
        scene.interpolation = Interpolation::Cubic;
        scene.stepSize = 0.5;
        const Image image = bench.render(field, scene);
        EXPECT_NEAR(image.frame.pupil, distance, 1e-9 * distance);
        const Comparison found = compared(image,
          [&](int column, int row)
          { return truthOf(form, image, scene, boxOf(grid), column, row); });
        EXPECT_GT(found.size.deflection, 0);
        constexpr double allowed = 2e-4;
        EXPECT_LT(found.error.deflection, allowed * found.size.deflection);
        EXPECT_LT(found.error.displacement, allowed * found.size.displacement);
        EXPECT_LT(found.error.opticalPathDifference, allowed * found.size.opticalPathDifference);
      }
    }
  }
}

/// What is behind the pupil does not count, and a view away from the data is undisturbed.
TEST_P(Perspective, SeesNothingBehindThePupil)
{
  const SampledField<double> medium(cube(64, half),
    [](double x, double y, double z)
    { return 1e-4 * std::exp(-4 * (x * x + y * y + (z - 1.5) * (z - 1.5))); });
  Field field = medium.field;
  field.ambient = 0;
  Bench bench;
  Scene scene = perspectiveScene(GetParam(), 1, { 0.1, 0.2, -1 });
  Image image = bench.render(field, scene); // the ball is 1.5 behind it
  const auto largest = [&image]
  {
    return std::max(*std::max_element(image.deflection.begin(), image.deflection.end()),
      -*std::min_element(image.deflection.begin(), image.deflection.end()));
  };
  EXPECT_LT(largest(), 1e-6f);
  scene.view.focalPoint = Vector{ 0.1, 0.2, 1.4 };
  image = bench.render(field, scene);
  EXPECT_GT(largest(), 1e-5f);
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph, Cutoff::Background })
  {
    scene.cutoff = cutoff;
    scene.view.focalPoint = Vector{ 0.1, 0.2, -9 };
    image = bench.render(field, scene);
    EXPECT_EQ(largest(), 0);
    for (const float intensity : image.intensity)
    {
      EXPECT_TRUE(std::isfinite(intensity));
    }
  }
}

/// Without an extent, all of the data is in the image.
TEST_P(Perspective, FitsTheData)
{
  const SampledField<float> solid(cube(9, 1),
    [](double x, double y, double z)
    { return x + y + z < -2.9 ? 0 : std::numeric_limits<double>::quiet_NaN(); });
  Scene scene;
  scene.device = GetParam();
  scene.view.width = scene.view.height = 101;
  scene.view.viewAngle = 40;
  scene.samplesPerPixel = 1;
  scene.kScale = 0;
  const Image image = Bench().render(solid.field, scene);
  // The near face is larger than the far one and fills the image.
  EXPECT_EQ(image.intensity[pixelOf(image, 1, 1)], 0);
  EXPECT_NEAR(image.frame.pixelSize * 101 / 2, 1 + std::tan(20 * radiansPerDegree), 1e-9);
}

/// A straight ray is bent by the ball's profile at its distance from the ball, at right angles to itself.
Vec3<double> deflectionBy(const Ball& ball, const Point& place, const Point& direction)
{
  const Point from = place - Point{ ball.centre[0], ball.centre[1], ball.centre[2] };
  const Point aside = from - dot(from, direction) * direction;
  return (-2 * std::sqrt(pi) * ball.height / ball.width *
           std::exp(-dot(aside, aside) / (ball.width * ball.width))) *
    aside;
}

/// The adaptive medium of a source has voxels where a perspective looks, small ones near the camera.
TEST_P(Perspective, KeepsTheToleranceOfASource)
{
  const std::vector<Ball> balls{ { { 0.2, -0.1, -0.6 }, 0.15, 1e-4 },
    { { -0.05, 0.06, 0.55 }, 0.05, 3e-5 }, { { 0.8, 0.8, 0.9 }, 0.03, 1e-4 } };
  const auto source = std::make_shared<BallsSource>(balls);
  Scene scene;
  scene.device = GetParam();
  scene.samplesPerPixel = 1;
  scene.pathModel = PathModel::Straight;
  scene.view = raysAround({ 0, 0, 0 }, 120, 120, 0.008);
  scene.mediumTolerance = 0.01;
  for (const double distance :
    { 3., 1.2, 0.9 }) // of the last one, the third ball is behind the pupil's plane
  {
    SCOPED_TRACE(distance);
    setPupil(scene.view, distance);
    const Image image = Bench().render(fieldOf(source), scene);
    const Point pupil{ 0, 0, distance };
    const Point u = asPoint(image.frame.u), v = asPoint(image.frame.v);
    double worst = 0, largest = 0;
    for (int row = 0; row < image.height; ++row)
    {
      for (int column = 0; column < image.width; ++column)
      {
        const PixelCentre at = centreOf(image, column, row);
        const Point place = at.u * u + at.v * v;
        const Point d = (1 / length(place - pupil)) * (place - pupil);
        Vec3<double> truth{ 0, 0, 0 };
        for (const Ball& ball : balls)
        {
          truth += ball.centre[2] < distance ? deflectionBy(ball, place, d) : Point{ 0, 0, 0 };
        }
        const std::size_t pixel = 2 * pixelOf(image, column, row);
        worst = std::max(worst,
          std::hypot(
            image.deflection[pixel] - dot(truth, u), image.deflection[pixel + 1] - dot(truth, v)));
        largest = std::max(largest, length(truth));
      }
    }
    EXPECT_LT(worst, 2 * scene.mediumTolerance * largest);
    EXPECT_NEAR(image.medium.largestDeflection, largest, 0.05 * largest);
  }
}

/// What is far beside the frustum gets no voxels.
TEST(PerspectiveMedium, HasVoxelsWithinTheViewAlone)
{
  const std::vector<Ball> seen{ { { 0, 0, 0 }, 0.1, 1e-4 } };
  std::vector<Ball> all = seen;
  all.push_back(
    { { 0.6, 0, 0.7 }, 0.1, 1e-4 }); // within a column as wide as the view is at its far end
  Scene scene;
  scene.device = Device::Cpu;
  scene.samplesPerPixel = 1;
  scene.view = raysAround({ 0, 0, 0 }, 64, 64, 0.01);
  setPupil(scene.view, 1);
  const auto bricksOf = [&](const std::vector<Ball>& balls)
  { return Bench().render(fieldOf(std::make_shared<BallsSource>(balls)), scene).medium.bricks; };
  const std::int64_t few = bricksOf(seen), more = bricksOf(all);
  EXPECT_LT(static_cast<double>(more), 1.3 * static_cast<double>(few));
  scene.view.viewAngle = 0;
  scene.view.parallelScale = 1;
  EXPECT_GT(static_cast<double>(bricksOf(all)), 1.5 * static_cast<double>(bricksOf(seen)));
}

/// The pattern's displacement, where the pattern is.
TEST_P(Perspective, MovesThePatternBehindTheFlow)
{
  const std::vector<Ball> balls{ { { 0.2, -0.1, 0.1 }, 0.2, 1e-5 } };
  const auto source = std::make_shared<BallsSource>(balls);
  Scene scene;
  scene.device = GetParam();
  scene.cutoff = Cutoff::Background;
  scene.samplesPerPixel = 1;
  scene.pathModel = PathModel::Refracted;
  scene.background.distance = 4; // behind the data, which end at -1
  scene.view = raysAround({ 0, 0, 0 }, 40, 40, 0.03);
  setPupil(scene.view, 3);
  scene.mediumTolerance = 1e-3;
  const Image image = Bench().render(fieldOf(source), scene);
  const Point u = asPoint(image.frame.u), v = asPoint(image.frame.v);
  double worst = 0, largest = 0;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const PixelCentre at = centreOf(image, column, row);
      const Point place = at.u * u + at.v * v, pupil{ 0, 0, 3 };
      const Point d = (1 / length(place - pupil)) * (place - pupil);
      // Bent where it is nearest to the ball.
      const Point ball{ 0.2, -0.1, 0.1 };
      const Point bend = pupil + dot(ball - pupil, d) * d;
      const Point turned = deflectionBy(balls[0], place, d);
      const Point after = d + turned;
      const auto onPattern = [&](const Point& direction)
      { return bend + ((-5 - bend.z) / direction.z) * direction; };
      const Point moved = onPattern(after) - onPattern(d);
      const std::size_t pixel = 2 * pixelOf(image, column, row);
      worst = std::max(worst,
        std::hypot(image.backgroundDisplacement[pixel] - dot(moved, u),
          image.backgroundDisplacement[pixel + 1] - dot(moved, v)));
      largest = std::max(largest, length(moved));
    }
  }
  EXPECT_LT(worst, 5e-3 * largest);
}

/// One layer of cells is as deep as it has been made: its light is parallel, that of a source's distance, too.
TEST_P(Perspective, IsNoneOfTwoDimensionalData)
{
  Grid grid = cube(33, 1);
  grid.dimensions[2] = 2;
  const SampledField<float> layer(
    grid, [](double x, double y, double) { return 1e-4 * std::exp(-4 * (x * x + y * y)); });
  Scene scene = perspectiveScene(GetParam(), 2, { 0, 0, 0 });
  Scene parallel = scene;
  parallel.view.viewAngle = 0;
  Bench bench;
  for (const std::optional<double> distance : { std::optional<double>(), std::optional(5.) })
  {
    scene.source.distance = parallel.source.distance = distance;
    const Image image = bench.render(layer.field, scene);
    EXPECT_EQ(image.frame.pupil, 0);
    EXPECT_EQ(image.deflection, Bench().render(layer.field, parallel).deflection);
  }
}

TEST(PerspectiveMistakes, SayWhatToDo)
{
  const SampledField<float> gas(cube(8, 1), [](double, double, double) { return 3e-4; });
  Scene scene;
  scene.device = Device::Cpu;
  for (const double angle : { -1., 170., std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity() })
  {
    scene.view.viewAngle = angle;
    expectError(messageOf(gas.field, scene), "ViewAngle");
  }
  scene.view.viewAngle = 169;
  EXPECT_EQ(messageOf(gas.field, scene), "");
  scene.view.viewAngle = 30;
  scene.view.parallelScale = 1;
  scene.focusOffset = 4;
  expectError(messageOf(gas.field, scene), "FocusOffset");
  scene.cutoff = Cutoff::Shadowgraph; // is not focused
  EXPECT_EQ(messageOf(gas.field, scene), "");
}

INSTANTIATE_TEST_SUITE_P(, Perspective, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
