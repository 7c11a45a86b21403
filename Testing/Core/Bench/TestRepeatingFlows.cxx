// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Scene::targetError where the pixels that are looked at could all be the wrong ones: flows that repeat every 16, 32 or 64
// pixels, and weak waves on two hundredths of an image.
#include "Fields.h"
#include "TrueError.h"

#include <cmath>
#include <ostream>

namespace schlieren
{

namespace
{

constexpr double target = 0.004;

/// Gas of some layers whose spacing is the edge of a pixel.
Grid slab(int pixels, std::int64_t columns, std::int64_t rows)
{
  const auto size = static_cast<double>(pixels);
  Grid grid;
  grid.dimensions = { columns, rows, 5 };
  grid.spacing = { size / static_cast<double>(columns - 1), size / static_cast<double>(rows - 1),
    10 };
  grid.origin = { 0, 0, 0 };
  return grid;
}

Scene sceneOf(int pixels)
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.viewDirection = { 0, 0, -1 };
  scene.view.width = scene.view.height = pixels;
  scene.view.focalPoint = Vector{ 0.5 * pixels, 0.5 * pixels, 20 };
  scene.view.parallelScale = 0.5 * pixels;
  scene.kScale = 8000;
  scene.targetError = target;
  return scene;
}

Scene finest(Scene scene)
{
  scene.targetError = 0;
  scene.interpolation = Interpolation::Cubic;
  scene.stepSize = 0.5;
  scene.samplesPerPixel = 64;
  return scene;
}

/// Of an image whose pixels on `truth` begin at a column and row.
double error(const Image& image, const Image& truth, int fromColumn, int fromRow)
{
  std::vector<double> errors;
  for (int row = 0; row < truth.height; ++row)
  {
    for (int column = 0; column < truth.width; ++column)
    {
      errors.push_back(std::abs(
        static_cast<double>(image.intensity[pixelOf(image, fromColumn + column, fromRow + row)]) -
        static_cast<double>(truth.intensity[pixelOf(truth, column, row)])));
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors[static_cast<std::size_t>(0.99 * static_cast<double>(errors.size()))];
}

struct Lattice
{
  int pixels, period;
};
void PrintTo(const Lattice& of, std::ostream* out) { *out << of.pixels << " by " << of.period; }

class RepeatingFlows : public testing::TestWithParam<Lattice>
{
};

/// Pins of a pixel across, along columns or rows of pixels, at any place in their period.
TEST_P(RepeatingFlows, AreSeen)
{
  const auto [pixels, period] = GetParam();
  for (const bool areAlongRows : { false, true })
  {
    for (const int eighth : { 0, 3, 4 })
    {
      const double phase = eighth * period / 8.;
      SCOPED_TRACE(testing::Message() << (areAlongRows ? "row " : "column ") << phase);
      const std::int64_t points = pixels + 1;
      const SampledField<float> field(
        areAlongRows ? slab(pixels, 3, points) : slab(pixels, points, 3),
        [&, period = period](double x, double y, double)
        {
          const double off = std::remainder((areAlongRows ? y : x) - phase, period);
          return 2.7e-4 + 4e-7 * std::exp(-off * off / (2 * 0.8 * 0.8));
        });
      Scene scene = sceneOf(pixels);
      scene.knifeEdgeAngle = areAlongRows ? 90 : 0;
      const Image image = Bench().render(field.field, scene);
      // The flow is the same along the pins.
      constexpr int strip = 4;
      const int from = (pixels - strip) / 2;
      (areAlongRows ? scene.view.width : scene.view.height) = strip;
      scene.view.parallelScale = 0.5 * scene.view.height;
      const Image truth = Bench().render(field.field, finest(scene));
      const double trueError =
        error(image, truth, areAlongRows ? from : 0, areAlongRows ? 0 : from);
      EXPECT_GT(trueError, 0); // or else there would be nothing to see
      EXPECT_TRUE(trueError <= target || !image.accuracy.isKept()) << trueError;
      EXPECT_GT(image.accuracy.reached, 0.5 * trueError - 0.1 * target);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pixels, RepeatingFlows,
  testing::Values(Lattice{ 512, 16 }, Lattice{ 1024, 64 }),
  [](const testing::TestParamInfo<Lattice>& test)
  { return "Of" + std::to_string(test.param.pixels) + "By" + std::to_string(test.param.period); });

/// Fine weak waves on a disc of 2 % of the image, wherever it is, beside strong ones that one ray per pixel shows well. These
/// fill the twelfth of the squares where neighbouring rays differ most.
TEST(RareFlows, AreSeen)
{
  constexpr int pixels = 256, places = 10, strong = 32;
  const double radius = pixels * std::sqrt(0.02 / pi);
  int missed = 0, needed = 0;
  for (int n = 0; n < places; ++n)
  {
    const auto coordinate = [&](double first, double factor)
    { return first + radius + (pixels - first - 2 * radius) * std::fmod(factor * (n + 1), 1.); };
    const double middle[2] = { coordinate(strong, std::sqrt(3.)), coordinate(0, std::sqrt(7.)) };
    const SampledField<float> field(slab(pixels, pixels + 1, pixels + 1),
      [&](double x, double y, double)
      {
        const double flow = x < strong ? 1.8e-6 * (1 - std::cos(2 * pi * x / 16)) : 0;
        const bool isIn = std::hypot(x - middle[0], y - middle[1]) < radius;
        return 2.7e-4 + flow + (isIn ? 3e-7 * std::sin(2 * pi * x / 3) : 0);
      });
    Scene scene = sceneOf(pixels);
    const Image image = Bench().render(field.field, scene);
    // A window around the waves: elsewhere a ray per pixel is right.
    const int edge = static_cast<int>(std::sqrt(0.02) * pixels * 1.2);
    scene.view.width = scene.view.height = edge;
    const int from[2] = { std::clamp(static_cast<int>(middle[0]) - edge / 2, 0, pixels - edge),
      std::clamp(static_cast<int>(middle[1]) - edge / 2, 0, pixels - edge) };
    scene.view.focalPoint = Vector{ from[0] + 0.5 * edge, from[1] + 0.5 * edge, 20 };
    scene.view.parallelScale = 0.5 * edge;
    Scene fine = finest(scene);
    fine.samplesPerPixel = 16;
    const Image truth = Bench().render(field.field, fine);
    std::int64_t above = 0;
    for (int row = 0; row < edge; ++row)
    {
      for (int column = 0; column < edge; ++column)
      {
        above += std::abs(static_cast<double>(
                            image.intensity[pixelOf(image, from[0] + column, from[1] + row)]) -
                   static_cast<double>(truth.intensity[pixelOf(truth, column, row)])) > target
          ? 1
          : 0;
      }
    }
    const bool isWrong = static_cast<double>(above) > 0.01 * pixels * pixels;
    missed += isWrong && image.accuracy.isKept() ? 1 : 0;
    needed += image.samplesPerPixel > 1 ? 1 : 0;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GE(needed, places - 1); // of one ray in each pixel all would be wrong
}

} // namespace

} // namespace schlieren
