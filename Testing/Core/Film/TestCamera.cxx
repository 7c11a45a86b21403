// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The camera in front of the flow: its lens's aperture, and what it is focused on.
#include "Fields.h"
#include "Messages.h"
#include "Rays/Light.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace schlieren
{

namespace
{

/// A shock of half width `width` across x, in a slab 20 mm deep: 1 m before the camera of these scenes.
constexpr double width = 2e-4, depth = 0.02, toCamera = 1;

/// `strength`: of its density's change, by that of 0.6 and 1.8 kg/m^3.
SampledField<float> shock(double strength = 1)
{
  Grid grid;
  grid.dimensions = { 801, 3, 11 };
  grid.origin = { -0.04, -0.02, -0.5 * depth };
  grid.spacing = { 1e-4, 0.02, depth / 10 };
  return { grid, [strength](double x, double, double) {
            return 2.26e-4 * (1.2 + 0.6 * strength * (1 + std::tanh(x / width)));
          } };
}

SampledField<float> still()
{
  Grid grid;
  grid.dimensions = { 9, 9, 9 };
  grid.origin = { -0.04, -0.04, -0.5 * depth };
  grid.spacing = { 0.01, 0.01, depth / 8 };
  return { grid, [](double, double, double) { return 2.7e-4; } };
}

/// Pixels of 0.1 mm where the flow is.
Scene sceneOf(Device device, Cutoff cutoff, int columns, int rows)
{
  constexpr double pixel = 1e-4;
  Scene scene;
  scene.device = device;
  scene.cutoff = cutoff;
  scene.pathModel = PathModel::Straight;
  scene.view.width = columns;
  scene.view.height = rows;
  scene.view.focalPoint = Vector{ 0, 0, 0 };
  scene.view.parallelScale = 0.5 * rows * pixel;
  scene.view.viewAngle = 2 * std::atan(scene.view.parallelScale / toCamera) / radiansPerDegree;
  scene.background.distance = 1 - 0.5 * depth; // 1 m behind the flow's middle
  scene.samplesPerPixel = 320;
  return scene;
}

void setLens(Scene& scene, double focalLength, double number)
{
  scene.lens.aperture = focalLength / number;
  scene.lens.apertureRatio = 1 / number;
}

/// A curve over x, its area, and four standard deviations.
struct Profile
{
  std::vector<double> x, value;

  double area() const { return std::accumulate(value.begin(), value.end(), 0.) * (x[1] - x[0]); }
  double largest() const { return *std::max_element(value.begin(), value.end()); }
  double width() const
  {
    double sums[3] = { 0, 0, 0 };
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      sums[0] += value[i];
      sums[1] += value[i] * x[i];
      sums[2] += value[i] * x[i] * x[i];
    }
    const double mean = sums[1] / sums[0];
    return 4 * std::sqrt(sums[2] / sums[0] - mean * mean);
  }
  double widthAtHalf() const
  {
    const double half = 0.5 * largest();
    const auto crossing = [&](std::size_t i)
    { return x[i] + (x[i + 1] - x[i]) * (half - value[i]) / (value[i + 1] - value[i]); };
    double ends[2] = { 0, 0 };
    int found = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
    {
      if ((value[i] < half) != (value[i + 1] < half))
      {
        ends[std::min(found++, 1)] = crossing(i);
      }
    }
    return ends[1] - ends[0];
  }
};

Profile across(const Image& image, const std::function<double(std::size_t)>& value)
{
  Profile profile;
  const int row = image.height / 2;
  for (int column = 0; column < image.width; ++column)
  {
    profile.x.push_back(centreOf(image, column, row).u);
    profile.value.push_back(value(pixelOf(image, column, row)));
  }
  return profile;
}

Profile displacementOf(const Image& image)
{
  return across(image,
    [&](std::size_t pixel)
    { return static_cast<double>(image.backgroundDisplacement[2 * pixel]); });
}

/// What n points of the aperture make of a front: as many of it, as far apart as a disc of diameter `cone` puts them and as
/// they are in a pixel.
double spread(double x, double cone, double pixel, int n)
{
  double sum = 0;
  for (int i = 0; i < n; ++i)
  {
    const double off = pixelOffset(i, 1).column * pixel - 0.5 * pupilPoint(i, n)[0] * cone;
    const double cosh = std::cosh((x + off) / width);
    sum += 1 / (cosh * cosh);
  }
  return sum / n;
}

class Camera : public OnDevice
{
};

/// Focused on the pattern, 2 m away: where the flow is, light of a point of it is as wide as half the aperture.
TEST_P(Camera, SpreadsAShockOverItsCone)
{
  const SampledField<float> field = shock();
  Scene scene = sceneOf(GetParam(), Cutoff::Background, 301, 5);
  Bench bench;
  scene.samplesPerPixel = 1;
  const Profile pinhole = displacementOf(bench.render(field.field, scene));
  scene.samplesPerPixel = 320; // 10 cones by widths
  setLens(scene, 0.05, 4);
  const Profile open = displacementOf(bench.render(field.field, scene));
  constexpr double cone = 0.00625;
  EXPECT_NEAR(
    std::sqrt(std::pow(open.width(), 2) - std::pow(pinhole.width(), 2)), cone, 0.02 * cone);
  EXPECT_NEAR(open.widthAtHalf(), 5.41e-3, 0.02 * 5.41e-3);
  EXPECT_NEAR(open.area() / pinhole.area(), 1, 1e-3);
  Profile expected = open;
  std::transform(open.x.begin(), open.x.end(), expected.value.begin(),
    [&](double x) { return spread(x, cone, 1e-4, scene.samplesPerPixel); });
  const double scale = open.area() / expected.area();
  double squares = 0;
  for (std::size_t i = 0; i < open.x.size(); ++i)
  {
    squares += std::pow(open.value[i] - scale * expected.value[i], 2);
  }
  const double rms = std::sqrt(squares / static_cast<double>(open.x.size()));
  EXPECT_LT(rms, 0.004 * open.largest());

  setLens(scene, 0.05, 22);
  scene.samplesPerPixel = 64;
  const Profile narrow = displacementOf(bench.render(field.field, scene));
  EXPECT_NEAR(std::sqrt(std::pow(narrow.width(), 2) - std::pow(pinhole.width(), 2)), 1.14e-3, 3e-5);
}

/// Contrast of stripes that are out of focus: of a cosine seen through a disc.
TEST_P(Camera, BlursWhatIsNotInFocus)
{
  const SampledField<float> field = shock();
  const SampledField<float> gas = still();
  Scene scene = sceneOf(GetParam(), Cutoff::Background, 301, 5);
  scene.background.kind = PatternKind::Stripes;
  scene.samplesPerPixel = 64;
  setLens(scene, 0.05, 4);
  Bench bench;
  const auto contrastOf = [&](double period)
  {
    scene.background.period = period;
    const Image image = bench.render(gas.field, scene);
    EXPECT_EQ(image.intensity, image.background);
    // Compared with the stripes in world coordinates, on a pattern twice as far away as the focal point.
    double sum = 0, squares = 0;
    for (int column = 0; column < image.width; ++column)
    {
      const double cosine = std::cos(2 * pi * 2 * centreOf(image, column, 2).u / period);
      sum += cosine * (image.background[pixelOf(image, column, 2)] - 0.5);
      squares += cosine * cosine;
    }
    return 2 * sum / squares;
  };
  EXPECT_NEAR(contrastOf(0.01), 1, 0.01);
  scene.lens.focusDistance = toCamera; // the flow
  for (const double period : { 0.01, 0.015, 0.03 })
  {
    const double x = pi * scene.lens.aperture * 1 / (toCamera * period);
    EXPECT_NEAR(contrastOf(period), 2 * std::cyl_bessel_j(1., x) / x, 0.01) << period;
  }
  scene.background.period = 0;
  scene.samplesPerPixel = 1;
  const Profile atCentre = displacementOf(bench.render(field.field, scene));
  scene.samplesPerPixel = 64;
  const Profile inFocus = displacementOf(bench.render(field.field, scene));
  EXPECT_NEAR(inFocus.width(), atCentre.width(), 0.03 * atCentre.width());
}

/// A parallel view has a telecentric lens, whose cone does not depend on the camera's place.
TEST_P(Camera, IsTelecentricInAParallelView)
{
  const SampledField<float> field = shock();
  Scene scene = sceneOf(GetParam(), Cutoff::Background, 301, 5);
  scene.view.viewAngle = 0;
  Bench bench;
  scene.samplesPerPixel = 1;
  const Profile pinhole = displacementOf(bench.render(field.field, scene));
  scene.samplesPerPixel = 320;
  setLens(scene, 0.05, 200);
  const Profile open = displacementOf(bench.render(field.field, scene));
  constexpr double cone = 1. / 200;
  EXPECT_NEAR(
    std::sqrt(std::pow(open.width(), 2) - std::pow(pinhole.width(), 2)), cone, 0.02 * cone);
  EXPECT_NEAR(open.area() / pinhole.area(), 1, 1e-3);
}

/// Other techniques with a perspective focus on a plane in the flow, or beside it.
TEST_P(Camera, IsFocusedOnAPlane)
{
  const SampledField<float> field = shock(1e-3); // so weak that it moves no light
  Scene scene = sceneOf(GetParam(), Cutoff::KnifeEdge, 301, 5);
  scene.kScale = 2e4;
  scene.samplesPerPixel = 1;
  Bench bench;
  const auto take = [&]
  {
    const Image image = bench.render(field.field, scene);
    return across(image, [&](std::size_t pixel) { return image.intensity[pixel] - 0.5; });
  };
  const Profile pinhole = take();
  setLens(scene, 0.05, 4);
  scene.samplesPerPixel = 256;
  EXPECT_NEAR(take().width(), pinhole.width(), 0.02 * pinhole.width());
  // Half a metre behind it, light of the shock comes from two thirds of a cone's end that is as wide as half the aperture.
  scene.lens.focusDistance = 1.5;
  const Profile open = take();
  const double blur = scene.lens.aperture * 0.5 / 1.5;
  EXPECT_NEAR(
    std::sqrt(std::pow(open.width(), 2) - std::pow(pinhole.width(), 2)), blur, 0.03 * blur);
  scene.lens.focusDistance.reset();
  scene.focusOffset = -0.5; // is the same plane
  EXPECT_EQ(take().value, open.value);
}

/// A pinhole has all in focus, and no bit depends on what it is focused on.
TEST_P(Camera, OfAPinholeHasNoFocus)
{
  const SampledField<float> field = shock();
  Scene scene = sceneOf(GetParam(), Cutoff::Background, 101, 5);
  scene.samplesPerPixel = 4;
  const Image image = Bench().render(field.field, scene);
  scene.lens.focusDistance = 0.7;
  const Image focused = Bench().render(field.field, scene);
  EXPECT_EQ(image.intensity, focused.intensity);
  EXPECT_EQ(image.backgroundDisplacement, focused.backgroundDisplacement);
}

/// Rays through an aperture are cached as others are; those of another number of points are others.
TEST_P(Camera, TracesItsRaysOnce)
{
  const SampledField<float> field = shock();
  Scene scene = sceneOf(GetParam(), Cutoff::Background, 65, 5);
  setLens(scene, 0.05, 4);
  scene.samplesPerPixel = 8;
  Bench bench;
  const Image image = bench.render(field.field, scene);
  const std::int64_t traced = bench.work().raysTraced;
  scene.background.period = 0.02;
  bench.render(field.field, scene);
  EXPECT_EQ(bench.work().raysTraced, traced);
  scene.background.period = 0;
  scene.samplesPerPixel = 9;
  bench.render(field.field, scene);
  EXPECT_GT(bench.work().raysTraced, 2 * traced);
  scene.samplesPerPixel = 8;
  EXPECT_EQ(bench.render(field.field, scene).intensity, image.intensity);
}

/// With a target error there are as many rays as the mean over the aperture takes.
TEST_P(Camera, KeepsATargetError)
{
  const SampledField<float> field = shock();
  Scene scene = sceneOf(GetParam(), Cutoff::Background, 201, 5);
  setLens(scene, 0.05, 22);
  scene.samplesPerPixel = 1024;
  const Image exact = Bench().render(field.field, scene);
  scene.samplesPerPixel = 1;
  scene.targetError = 1;
  const Image image = Bench().render(field.field, scene);
  ASSERT_TRUE(image.accuracy.isKept());
  EXPECT_GE(image.samplesPerPixel, 4);
  const Profile a = displacementOf(image), b = displacementOf(exact);
  for (std::size_t i = 0; i < a.x.size(); ++i)
  {
    EXPECT_LT(std::abs(a.value[i] - b.value[i]) / 2e-4, scene.targetError); // pixels of the pattern
  }
}

INSTANTIATE_TEST_SUITE_P(, Camera, bothDevices(), deviceName);

TEST(PointsOfAPupil, FillADisc)
{
  for (const std::int64_t passes : { 1, 2, 7, 64, 100 })
  {
    double squares = 0, sums[2] = { 0, 0 };
    for (std::int64_t pass = 0; pass < passes; ++pass)
    {
      const std::array<double, 2> place = pupilPoint(pass, passes);
      EXPECT_LT(std::hypot(place[0], place[1]), 1);
      EXPECT_EQ(pass == 0, place[0] == 0 && place[1] == 0);
      squares += place[0] * place[0] + place[1] * place[1];
      sums[0] += place[0];
      sums[1] += place[1];
    }
    const auto n = static_cast<double>(passes);
    EXPECT_NEAR(squares / n, passes > 1 ? 0.5 : 0, 0.6 / n); // of a disc of radius 1
    EXPECT_LT(std::hypot(sums[0], sums[1]) / n, 1 / n);
  }
}

TEST(CameraMistakes, AreReported)
{
  const SampledField<float> field = still();
  const auto expectErrorOf = [&](double aperture, std::optional<double> focus, const char* part)
  {
    Scene scene = sceneOf(Device::Cpu, Cutoff::Background, 16, 16);
    scene.samplesPerPixel = 1;
    scene.lens = { aperture, 0, focus };
    expectError(messageOf(field.field, scene), part);
  };
  expectErrorOf(-1, {}, "FNumber");
  expectErrorOf(std::numeric_limits<double>::quiet_NaN(), {}, "FNumber");
  expectErrorOf(5, {}, "FNumber"); // steeper than 45 degrees
  expectErrorOf(0.01, -1, "FocusDistance");
  expectErrorOf(0.01, 0, "FocusDistance");
}

} // namespace

} // namespace schlieren
