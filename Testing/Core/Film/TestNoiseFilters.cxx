// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The filters that take the noise out of a finished image.
#include "Fields.h"
#include "Film/NoiseFilters.h"
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

constexpr NoiseFilter allFilters[] = { NoiseFilter::Gaussian, NoiseFilter::Mean,
  NoiseFilter::Cone };

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

/// What a single bright pixel far from the border becomes.
PixelArray<float> spotThrough(NoiseFilter filter, double radius, float samplesPerPixel = 1)
{
  PixelArray<float> image = evenImage(0);
  image[14 * width + 20] = 1;
  return filtered(image, width, height, filter, radius, evenImage(samplesPerPixel), 2);
}

float at(const PixelArray<float>& image, int columns, int rows)
{
  return image[static_cast<std::size_t>((14 + rows) * width + 20 + columns)];
}

TEST(NoiseFilters, LeaveEvenLightAsItIs)
{
  for (const NoiseFilter filter : allFilters)
  {
    for (const double radius : { 1., 1.5, 2., 7.3, 32. })
    {
      for (const float light : { 0.f, 0.5f, 1.f, 0.1f, 3e30f })
      {
        const PixelArray<float> image = evenImage(light, 3);
        EXPECT_EQ(filtered(image, width, height, filter, radius, noise(), 2), image);
      }
    }
  }
}

TEST(NoiseFilters, ChangeNothingBelowOnePixel)
{
  const PixelArray<float> image = noise();
  for (const double radius : { 0., 0.5, 0.999 })
  {
    for (const NoiseFilter filter : allFilters)
    {
      EXPECT_EQ(filtered(image, width, height, filter, radius, evenImage(1), 2), image);
    }
  }
  EXPECT_EQ(filtered(image, width, height, NoiseFilter::None, 5, evenImage(1), 2), image);
}

TEST(NoiseFilters, DoNotDependOnThreads)
{
  for (const NoiseFilter filter : allFilters)
  {
    const PixelArray<float> once = filtered(noise(3), width, height, filter, 3.3, noise(), 1);
    EXPECT_NE(once, noise(3));
    for (const int threads : { 2, 3, 7 })
    {
      EXPECT_EQ(filtered(noise(3), width, height, filter, 3.3, noise(), threads), once);
    }
  }
}

TEST(NoiseFilters, GaussianHasItsWidth)
{
  const PixelArray<float> image = spotThrough(NoiseFilter::Gaussian, 4);
  EXPECT_NEAR(at(image, 2, 0) / at(image, 0, 0), std::exp(-0.5), 1e-6);
  EXPECT_NEAR(at(image, 2, -2) / at(image, 0, 0), std::exp(-1.), 1e-6);
  EXPECT_NEAR(at(image, 0, 0), 1 / (2 * pi * 4), 0.02 / (2 * pi * 4));
  EXPECT_GT(at(image, -6, 0), 0);
  EXPECT_EQ(at(image, -5, 4), 0);
}

TEST(NoiseFilters, MeanIsThatOfADisc)
{
  const PixelArray<float> image = spotThrough(NoiseFilter::Mean, 2);
  for (int row = -4; row <= 4; ++row)
  {
    for (int column = -4; column <= 4; ++column)
    {
      EXPECT_FLOAT_EQ(at(image, column, row), column * column + row * row <= 4 ? 1 / 13.f : 0.f);
    }
  }
}

/// Its disc holds pi R^2 samples: the more there are, the smaller it is.
TEST(NoiseFilters, ConeShrinksAsSamplesComeIn)
{
  for (const float samplesPerPixel : { 1.f, 4.f, 10.f, 0.5f })
  {
    constexpr double radius = 6;
    const double expected = radius / std::sqrt(static_cast<double>(samplesPerPixel));
    const PixelArray<float> image = spotThrough(NoiseFilter::Cone, radius, samplesPerPixel);
    EXPECT_NEAR(at(image, 1, 0) / at(image, 0, 0), 1 - 1 / expected, 1e-5);
    EXPECT_NEAR(
      at(image, 1, -1) / at(image, 0, 0), std::max(0., 1 - std::sqrt(2.) / expected), 1e-5);
    const int last = static_cast<int>(std::ceil(expected)) - 1;
    EXPECT_GT(at(image, last, 0), 0);
    EXPECT_EQ(at(image, last + 1, 0), 0);
  }
  // No neighbour is left in it.
  EXPECT_EQ(at(spotThrough(NoiseFilter::Cone, 6, 36), 0, 0), 1);
  EXPECT_EQ(at(spotThrough(NoiseFilter::Cone, 6, 1e12f), 0, 0), 1);
}

/// Where light is dense the cone is narrow: a bright line stays sharp, while what is beside it is blurred.
TEST(NoiseFilters, ConeIsNarrowWhereLightIsDense)
{
  PixelArray<float> samples = evenImage(1);
  for (int row = 0; row < height; ++row)
  {
    samples[static_cast<std::size_t>(row * width + 20)] = 1000;
  }
  PixelArray<float> image = samples;
  const PixelArray<float> sharp = filtered(image, width, height, NoiseFilter::Cone, 5, samples, 2);
  EXPECT_EQ(at(sharp, 0, 0), 1000);
  EXPECT_EQ(at(sharp, 9, 0), 1);
}

/// Nowhere are there samples enough, or any: a disc of twice the radius is the limit.
TEST(NoiseFilters, ConeHasALimit)
{
  const PixelArray<float> image = spotThrough(NoiseFilter::Cone, 3, 0);
  EXPECT_NEAR(at(image, 3, 0) / at(image, 0, 0), 0.5, 1e-6);
  EXPECT_EQ(at(image, 6, 0), 0);
  PixelArray<float> single(1);
  single[0] = 0.25f;
  for (const NoiseFilter filter : allFilters)
  {
    EXPECT_EQ(filtered(single, 1, 1, filter, 32, single, 2), single);
  }
}

/// Noise of independent pixels falls as the square root of how many are averaged.
TEST(NoiseFilters, TakeNoiseOut)
{
  const auto deviation = [](const PixelArray<float>& image)
  {
    double sum = 0, squares = 0;
    for (const float light : image)
    {
      sum += static_cast<double>(light);
      squares += static_cast<double>(light) * static_cast<double>(light);
    }
    const double mean = sum / static_cast<double>(image.size());
    return std::sqrt(squares / static_cast<double>(image.size()) - mean * mean);
  };
  const double before = deviation(noise());
  const double after =
    deviation(filtered(noise(), width, height, NoiseFilter::Mean, 2, evenImage(1), 2));
  EXPECT_NEAR(after / before, 1 / std::sqrt(13.), 0.05);
}

/// What a bench makes of a flow, with a body, is filtered as a whole.
struct NoisyImage
{
  NoisyImage()
    : gas(cube(20, 1),
        [](double x, double y, double z)
        { return std::hypot(x, y) < 0.2 ? std::nan("") : 1e-4 * std::sin(9 * x + 5 * y * z); })
  {
    scene.device = Device::Cpu;
    scene.view.width = 30;
    scene.view.height = 20;
    scene.samplesPerPixel = 2;
    scene.noiseFilterRadius = 3;
    scene.filmEstimator = FilmEstimator::Photon;
  }

  SampledField<float> gas;
  Scene scene;
};

TEST(NoiseFilters, AreAppliedToTheBenchsImages)
{
  NoisyImage noisy;
  std::vector<float> gradients(noisy.gas.samples.size(), 1);
  noisy.gas.field.gradients = { 1, gradients.data(), 1 };
  Scene& scene = noisy.scene;
  scene.fieldColors = { { 1, 0, 0.5f } };
  const Image plain = Bench().render(noisy.gas.field, scene);
  for (const NoiseFilter filter : allFilters)
  {
    scene.noiseFilter = filter;
    const Image image = Bench().render(noisy.gas.field, scene);
    EXPECT_NE(image.intensity, plain.intensity);
    EXPECT_EQ(image.deflection, plain.deflection);
    EXPECT_EQ(image.light.onFilm, plain.light.onFilm);
    if (filter != NoiseFilter::Cone)
    {
      EXPECT_EQ(image.intensity, filtered(plain.intensity, 30, 20, filter, 3, {}, 1));
      EXPECT_EQ(image.color, filtered(plain.color, 30, 20, filter, 3, {}, 1));
    }
  }
}

/// The cone's samples are counted where rays land, whatever light they bring.
TEST(NoiseFilters, ConeCountsTheSamplesThatLand)
{
  NoisyImage noisy;
  Scene& scene = noisy.scene;
  scene.cutoff = Cutoff::Shadowgraph;
  scene.screenDistance = 300;
  const Image plain = Bench().render(noisy.gas.field, scene);
  PixelArray<float> samples = plain.intensity;
  std::transform(
    samples.begin(), samples.end(), samples.begin(), [](float light) { return 2 * light; });
  scene.noiseFilter = NoiseFilter::Cone;
  const Image image = Bench().render(noisy.gas.field, scene);
  const PixelArray<float> expected =
    filtered(plain.intensity, 30, 20, NoiseFilter::Cone, 3, samples, 1);
  for (std::size_t pixel = 0; pixel < expected.size(); ++pixel)
  {
    EXPECT_NEAR(image.intensity[pixel], expected[pixel], 1e-5f * std::max(1.f, expected[pixel]));
  }
}

TEST(NoiseFilters, RadiusMustMakeSense)
{
  NoisyImage noisy;
  for (const double radius : { -1., 32.5, 1e300, std::nan(""), HUGE_VAL })
  {
    noisy.scene.noiseFilterRadius = radius;
    EXPECT_THROW(Bench().render(noisy.gas.field, noisy.scene), Error);
  }
}

} // namespace

} // namespace schlieren
