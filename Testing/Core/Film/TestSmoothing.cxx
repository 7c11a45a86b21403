// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The Gaussian that a finished image may be smoothed by.
#include "Fields.h"
#include "Film/Smoothing.h"
#include "Math/Units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace schlieren
{

namespace
{

constexpr int width = 41, height = 29;
constexpr std::size_t pixels = width * height;

PixelArray<float> evenImage(float light, std::size_t channels = 1)
{
  PixelArray<float> image(channels * pixels);
  std::fill(image.begin(), image.end(), light);
  return image;
}

PixelArray<float> noise(std::size_t channels = 1)
{
  std::mt19937 random(11);
  PixelArray<float> image(channels * pixels);
  std::generate(
    image.begin(), image.end(), [&random] { return static_cast<float>(random() % 1000) / 1000; });
  return image;
}

float at(const PixelArray<float>& image, int columns, int rows)
{
  return image[static_cast<std::size_t>((14 + rows) * width + 20 + columns)];
}

TEST(Smoothing, LeavesEvenLightAsItIs)
{
  for (const double radius : { 0.7, 1., 1.5, 2., 7.3, 32. })
  {
    for (const float light : { 0.f, 0.5f, 1.f, 0.1f, 3e30f })
    {
      const PixelArray<float> image = evenImage(light, 3);
      EXPECT_EQ(smoothed(image, width, height, radius, 2), image);
    }
  }
}

TEST(Smoothing, ChangesNothingWithoutNeighbours)
{
  for (const double radius : { 0., 0.5, 0.666 })
  {
    EXPECT_EQ(smoothed(noise(), width, height, radius, 2), noise());
  }
  PixelArray<float> single(1);
  single[0] = 0.25f;
  EXPECT_EQ(smoothed(single, 1, 1, 32, 2), single);
}

TEST(Smoothing, HasItsWidth)
{
  PixelArray<float> spot = evenImage(0);
  spot[14 * width + 20] = 1;
  const PixelArray<float> image = smoothed(spot, width, height, 4, 2);
  EXPECT_NEAR(at(image, 2, 0) / at(image, 0, 0), std::exp(-0.5), 1e-6);
  EXPECT_NEAR(at(image, 2, -2) / at(image, 0, 0), std::exp(-1.), 1e-6);
  EXPECT_NEAR(at(image, 0, 0), 1 / (2 * pi * 4), 0.02 / (2 * pi * 4));
  EXPECT_GT(at(image, -6, 0), 0);
  EXPECT_EQ(at(image, -5, 4), 0);
}

/// What a bench makes of a flow, with a body, is smoothed as a whole.
struct SharpImage
{
  SharpImage()
    : gas(cube(20, 1),
        [](double x, double y, double z)
        { return std::hypot(x, y) < 0.2 ? std::nan("") : 1e-4 * std::sin(9 * x + 5 * y * z); })
  {
    scene.device = Device::Cpu;
    scene.view.width = 30;
    scene.view.height = 20;
    scene.samplesPerPixel = 2;
  }

  SampledField<float> gas;
  Scene scene;
};

TEST(Smoothing, IsAppliedToTheBenchsImages)
{
  SharpImage sharp;
  Scene& scene = sharp.scene;
  scene.cutoff = Cutoff::ColorFilter;
  const Image plain = Bench().render(sharp.gas.field, scene);
  scene.smoothingRadius = 3;
  const Image image = Bench().render(sharp.gas.field, scene);
  EXPECT_NE(image.intensity, plain.intensity);
  EXPECT_EQ(image.deflection, plain.deflection);
  EXPECT_EQ(image.light.onFilm, plain.light.onFilm);
  EXPECT_EQ(image.intensity, smoothed(plain.intensity, 30, 20, 3, 1));
  EXPECT_EQ(image.color, smoothed(plain.color, 30, 20, 3, 1));
}

TEST(Smoothing, RadiusMustMakeSense)
{
  SharpImage sharp;
  for (const double radius : { -1., 32.5, 1e300, std::nan(""), HUGE_VAL })
  {
    sharp.scene.smoothingRadius = radius;
    EXPECT_THROW(Bench().render(sharp.gas.field, sharp.scene), Error);
  }
}

} // namespace

} // namespace schlieren
