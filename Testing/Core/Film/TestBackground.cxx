// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Background-oriented schlieren: where a camera's rays meet what is behind the flow, and what it is.
#include "ClosedForms.h"
#include "Math/Units.h"
#include "Messages.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>

namespace schlieren
{

namespace
{

Scene cameraScene(Device device)
{
  Scene scene;
  scene.device = device;
  scene.cutoff = Cutoff::Background;
  scene.view.width = 64;
  scene.view.height = 48;
  scene.samplesPerPixel = 3;
  return scene;
}

std::shared_ptr<const RgbImage> fourColors()
{
  // Red, green; above blue, white.
  return std::make_shared<RgbImage>(
    RgbImage{ 2, 2, { 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255 } });
}

const PatternKind allPatterns[] = { PatternKind::Dots, PatternKind::Stripes, PatternKind::Image };

class Background : public OnDevice
{
};

/// A column of dense gas is a converging lens: beside it the camera sees what lies nearer to it, so that the
/// pattern is moved outwards. N = peak exp(-(x^2 + y^2) / radius^2) along z, seen along -y.
TEST_P(Background, IsSeenThroughAColumn)
{
  constexpr double peak = 2.7e-4, radius = 1, half = 3, distance = 200;
  const SampledField<float> column(cube(96, half),
    [](double x, double y, double)
    { return peak * std::exp(-(x * x + y * y) / (radius * radius)); });
  Field field = column.field;
  field.ambient = 0;
  Scene scene = cameraScene(GetParam());
  scene.view.viewDirection = { 0, -1, 0 };
  scene.view.viewUp = { 0, 0, 1 };
  scene.view.width = 201;
  scene.view.height = 3;
  scene.view.parallelScale = 0.03;
  scene.samplesPerPixel = 16;
  scene.background = { PatternKind::Stripes, distance, 0.4, 0, nullptr };
  const auto moved = [](double x)
  {
    const double eps =
      -2 * std::sqrt(pi) * peak * x / radius * std::exp(-x * x / (radius * radius));
    return eps * (half + distance); // from the column's middle
  };
  const Image image = Bench().render(field, scene);
  double worst = 0, worstWithout = 0, worstMoved = 0, most = 0;
  for (int i = 0; i < image.width; ++i)
  {
    const double x = centreOf(image, i, 1).u;
    const std::size_t pixel = pixelOf(image, i, 1);
    const auto stripes = [](double place) { return 0.5 + 0.5 * std::cos(2 * pi * place / 0.4); };
    worst = std::max(worst, std::abs(image.intensity[pixel] - stripes(x + moved(x))));
    worstWithout = std::max(worstWithout, std::abs(image.background[pixel] - stripes(x)));
    worstMoved = std::max(worstMoved, std::abs(image.backgroundDisplacement[2 * pixel] - moved(x)));
    most = std::max(most, std::abs(moved(x)));
    EXPECT_LT(image.backgroundDisplacement[2 * pixel] * x, 1e-9);
  }
  EXPECT_GT(most, 0.08);              // a fifth of a period
  EXPECT_LT(worstMoved, 5e-3 * most); // the mean of a pixel's 16 rays is beside its centre
  EXPECT_LT(worstWithout, 0.02);      // 20 pixels a period: what pixels and splats blur
  EXPECT_LT(worst, 0.03);
}

/// Without a flow nothing is moved, and no bit differs.
TEST_P(Background, IsTheSameWithoutFlow)
{
  const SampledField<float> gas(cube(16, 1), [](double, double, double) { return 3e-4; });
  for (const PatternKind kind : allPatterns)
  {
    for (const double radius : { 0., 2. })
    {
      Scene scene = cameraScene(GetParam());
      scene.background.kind = kind;
      scene.background.image = fourColors();
      scene.smoothingRadius = radius;
      const Image image = Bench().render(gas.field, scene);
      EXPECT_EQ(image.intensity, image.background);
      EXPECT_GT(*std::max_element(image.background.begin(), image.background.end()), 0.5f);
      for (const float moved : image.backgroundDisplacement)
      {
        EXPECT_EQ(moved, 0);
      }
    }
  }
}

/// A pattern hangs on its wall, wherever the camera looks: stripes are bright where u = 0, dots are the same ones.
TEST_P(Background, StandsInTheWorld)
{
  const SampledField<float> gas(
    cube(16, 1, { 3, -2, 1 }), [](double, double, double) { return 3e-4; });
  constexpr double period = 0.7, behind = 3, pupil = 10;
  Scene scene = cameraScene(GetParam());
  scene.view.parallelScale = 1;
  scene.background.distance = behind;
  scene.background.period = period;
  for (const bool hasPerspective : { false, true })
  {
    scene.view.viewAngle =
      hasPerspective ? 2 * std::atan(scene.view.parallelScale / pupil) / radiansPerDegree : 0;
    for (const double moved : { 0., 0.123 })
    {
      scene.view.focalPoint = Vector{ 3 + moved, -2 - 2 * moved, 1 };
      // The wall is behind the data, which end 1 behind the focal point.
      const double scale = hasPerspective ? (pupil + 1 + behind) / pupil : 1;
      scene.background.kind = PatternKind::Stripes;
      const Image image = Bench().render(gas.field, scene);
      double worst = 0;
      for (int column = 0; column < image.width; ++column)
      {
        const double focal = 3 + moved;
        const double place = focal + (centreOf(image, column, 9).u - focal) * scale;
        worst = std::max(worst,
          std::abs(image.background[pixelOf(image, column, 9)] - 0.5 -
            0.5 * std::cos(2 * pi * place / period)));
      }
      EXPECT_LT(worst, 0.03); // 17 pixels a period: what pixels and splats blur
    }
    // By whole pixels, a camera that pans sees the same dots elsewhere.
    scene.background.kind = PatternKind::Dots;
    constexpr int by = 5;
    scene.view.focalPoint = Vector{ 3, -2, 1 };
    const Image here = Bench().render(gas.field, scene);
    const double scale = hasPerspective ? (pupil + 1 + behind) / pupil : 1;
    scene.view.focalPoint = Vector{ 3 + by * scale * here.frame.pixelSize, -2, 1 };
    const Image there = Bench().render(gas.field, scene);
    double worst = 0;
    for (int column = 2; column + by < here.width - 2; ++column)
    {
      worst = std::max(worst,
        static_cast<double>(std::abs(here.background[pixelOf(here, column + by, 9)] -
          there.background[pixelOf(there, column, 9)])));
    }
    EXPECT_LT(worst, 1e-5);
  }
}

TEST_P(Background, ImageIsStretchedOverTheView)
{
  const SampledField<float> gas(cube(16, 1), [](double, double, double) { return 3e-4; });
  Scene scene = cameraScene(GetParam());
  scene.background.kind = PatternKind::Image;
  scene.background.image = fourColors();
  const Image image = Bench().render(gas.field, scene);
  ASSERT_EQ(image.color.size(), 3 * image.intensity.size());
  const auto expectColor = [&](int column, int row, const std::array<float, 3>& color)
  {
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      EXPECT_NEAR(image.color[3 * pixelOf(image, column, row) + channel], color[channel], 1e-5);
    }
  };
  expectColor(1, 1, { 1, 0, 0 });
  expectColor(62, 1, { 0, 1, 0 });
  expectColor(1, 46, { 0, 0, 1 });
  expectColor(62, 46, { 1, 1, 1 });
  EXPECT_NEAR(image.undisturbedLevel, 0.5, 1e-6);
}

/// Half of the light comes back from dots; they are as random as their seed says.
TEST_P(Background, DotsAreEvenAndRepeat)
{
  const SampledField<float> gas(cube(16, 1), [](double, double, double) { return 3e-4; });
  Scene scene = cameraScene(GetParam());
  scene.view.width = scene.view.height = 400;
  scene.samplesPerPixel = 1;
  const auto take = [&] { return Bench().render(gas.field, scene).background; };
  const PixelArray<float> first = take();
  EXPECT_EQ(first, take());
  scene.seed = 2;
  const PixelArray<float> second = take();
  const auto mean = [](const PixelArray<float>& image)
  { return std::accumulate(image.begin(), image.end(), 0.) / static_cast<double>(image.size()); };
  EXPECT_NEAR(mean(first), 0.5, 0.02);
  EXPECT_NEAR(mean(second), 0.5, 0.02);
  double differs = 0, contrast = 0;
  for (std::size_t pixel = 0; pixel < first.size(); ++pixel)
  {
    differs += std::pow(first[pixel] - second[pixel], 2);
    contrast += std::pow(first[pixel] - 0.5, 2);
  }
  EXPECT_NEAR(differs / contrast, 2, 0.2); // independent
  EXPECT_GT(contrast / static_cast<double>(first.size()), 0.12);
}

/// What is too fine for the image is grey, what is far away or coarse is drawn all the same.
TEST_P(Background, SurvivesExtremes)
{
  const SampledField<float> gas(
    cube(16, 1), [](double x, double y, double) { return 3e-4 * std::exp(-x * x - y * y); });
  for (const PatternKind kind : { PatternKind::Dots, PatternKind::Stripes })
  {
    Scene scene = cameraScene(GetParam());
    scene.background.kind = kind;
    for (const double distance : { 0., 1e9, 1e30 })
    {
      for (const double period : { 1e-300, 1e-3, 0., 1., 1e300 })
      {
        scene.background.distance = distance;
        scene.background.period = period;
        const Image image = Bench().render(gas.field, scene);
        const bool isGrey = period > 0 && period < 0.01;
        for (const float light : image.intensity)
        {
          EXPECT_TRUE(light >= -1e-6f && light <= 1 + 1e-6f);
          EXPECT_LE(isGrey ? std::abs(light - 0.5f) : 0, 1e-6f);
        }
        for (const float moved : image.backgroundDisplacement)
        {
          EXPECT_TRUE(std::isfinite(moved));
        }
        if (distance == 0)
        {
          EXPECT_EQ(image.backgroundDisplacement, image.displacement);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Background, bothDevices(), deviceName);

/// Patterns and their distance are seen by the same rays, which come from the camera whatever the light is.
TEST(RaysOfACamera, AreTracedOnce)
{
  const SampledField<float> field(cube(16, 1), [](double x, double, double) { return 1e-4 * x; });
  Scene scene = cameraScene(Device::Cpu);
  Bench bench;
  bench.render(field.field, scene);
  const std::int64_t traced = bench.work().raysTraced;
  scene.background = { PatternKind::Stripes, 1e4, 0.1, 30, nullptr };
  const Image image = bench.render(field.field, scene);
  scene.source = { 0.1, SourceShape::Disc, 3, 0 }; // within the data
  scene.knifeEdgeAngle = 45;
  scene.focusOffset = 3;
  EXPECT_EQ(bench.render(field.field, scene).intensity, image.intensity);
  EXPECT_EQ(bench.work().raysTraced, traced);
}

TEST(BackgroundMistakes, AreReported)
{
  const SampledField<float> field(cube(8, 1), [](double x, double, double) { return 1e-4 * x; });
  const auto expectErrorOf = [&](const BackgroundPattern& background, const char* part)
  {
    Scene scene = cameraScene(Device::Cpu);
    scene.background = background;
    expectError(messageOf(field.field, scene), part);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  expectErrorOf({ PatternKind::Dots, -1, 0, 0, nullptr }, "BackgroundDistance");
  expectErrorOf({ PatternKind::Dots, nan, 0, 0, nullptr }, "BackgroundDistance");
  expectErrorOf({ PatternKind::Dots, 1e31, 0, 0, nullptr }, "BackgroundDistance");
  expectErrorOf({ PatternKind::Dots, {}, -1, 0, nullptr }, "BackgroundPeriod");
  expectErrorOf({ PatternKind::Stripes, {}, 0, nan, nullptr }, "FringeAngle");
  expectErrorOf({ PatternKind::Image, {}, 0, 0, nullptr }, "BackgroundImage");
  expectErrorOf(
    { PatternKind::Image, {}, 0, 0, std::make_shared<RgbImage>(RgbImage{ 2, 2, { 1, 2, 3 } }) },
    "BackgroundImage");
}

} // namespace

} // namespace schlieren
