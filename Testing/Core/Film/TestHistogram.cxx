// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Where light meets the cutoff plane.
#include "Fields.h"
#include "Optics/DeflectionHistogram.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace schlieren
{

namespace
{

constexpr int width = 23, height = 17;
constexpr Pass pass{ -2, -1, width + 3, height + 4, { 0, 0 } };

/// Rays with a deflection each in the image, and strong ones around it that do not count.
std::vector<RayExit> exitsOf(const std::function<std::array<double, 2>(int, int)>& deflection)
{
  std::vector<RayExit> exits(static_cast<std::size_t>(pass.columns * pass.rows),
    RayExit{ { 0.9, -0.9 }, { 0, 0 }, 0, RayFate::Left, 1 });
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const std::array<double, 2> eps = deflection(column, row);
      exits[static_cast<std::size_t>((row + 1) * pass.columns + column + 2)] =
        RayExit{ { eps[0], eps[1] }, { 0, 0 }, 0, RayFate::Left, 1 };
    }
  }
  return exits;
}

std::vector<RayExit> randomExits(unsigned seed, double largest)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> some(-largest, largest);
  return exitsOf([&](int, int) { return std::array<double, 2>{ some(random), some(random) / 3 }; });
}

Histogram histogramOf(const std::vector<const std::vector<RayExit>*>& passes, int size, int threads)
{
  DeflectionHistogram histogram(size);
  for (const std::vector<RayExit>* exits : passes)
  {
    histogram.add({ pass, exits->data() }, width, height, threads);
  }
  EXPECT_EQ(histogram.passes(), static_cast<int>(passes.size()));
  return histogram.histogram();
}

std::int64_t sumOf(const Histogram& histogram)
{
  return std::accumulate(histogram.rays.begin(), histogram.rays.end(), std::int64_t{ 0 });
}

TEST(Histogram, CountsEachRayInItsBin)
{
  const std::vector<RayExit> exits = exitsOf(
    [](int column, int row) {
      return std::array<double, 2>{ 0.75e-3 * (column - 11) / 11, column == row ? 0.6e-3 : -1e-5 };
    });
  const Histogram histogram = histogramOf({ &exits }, 4, 2);
  EXPECT_EQ(histogram.size, 4);
  EXPECT_EQ(histogram.range, 1. / 1024);
  // Of u: below -range / 2, up to 0, up to range / 2, above; row by row of v.
  std::vector<std::int64_t> expected(16);
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const double u = 0.75e-3 * (column - 11) / 11;
      const std::size_t binU = u < -1. / 2048 ? 0 : u < 0 ? 1 : u < 1. / 2048 ? 2 : 3;
      const std::size_t binV = column == row ? 3 : 1;
      ++expected[4 * binV + binU];
    }
  }
  EXPECT_EQ(histogram.rays, expected);
}

TEST(Histogram, HoldsAllRaysThatReachTheFilmAndNoOthers)
{
  std::vector<RayExit> exits = randomExits(1, 1e-4);
  std::int64_t rays = width * height;
  for (const RayFate fate : { RayFate::Blocked, RayFate::Trapped, RayFate::Turned })
  {
    RayExit& exit = exits[static_cast<std::size_t>(3 * pass.columns + 4 + static_cast<int>(fate))];
    exit.fate = fate;
    exit.deflection[0] = 1; // does not count for the range either
    --rays;
  }
  exits[static_cast<std::size_t>(5 * pass.columns + 4)].fate = RayFate::Missed; // reaches the film
  exits[static_cast<std::size_t>(5 * pass.columns + 5)].deflection[1] = std::nan("");
  --rays;
  for (const int size : { 1, 2, 3, 64, 257 })
  {
    const Histogram histogram = histogramOf({ &exits }, size, 2);
    EXPECT_EQ(sumOf(histogram), rays) << size;
    EXPECT_EQ(histogram.range, std::ldexp(1, -13)) << size;
  }
}

TEST(Histogram, IsTheSameForAnyNumberOfThreadsAndAnyOrderOfPasses)
{
  // Ranges grow and shrink from pass to pass; one has nothing but light at rest.
  const std::vector<RayExit> weak = randomExits(2, 3e-9), strong = randomExits(3, 0.04),
                             middle = randomExits(4, 1e-5), atRest = randomExits(5, 0);
  for (const int size : { 6, 7, 32 })
  {
    const Histogram expected = histogramOf({ &weak, &strong, &middle, &atRest }, size, 1);
    EXPECT_EQ(sumOf(expected), 4 * width * height);
    for (const int threads : { 1, 3, 8 })
    {
      for (const auto& order :
        { std::vector<const std::vector<RayExit>*>{ &atRest, &weak, &middle, &strong },
          { &strong, &middle, &weak, &atRest }, { &middle, &atRest, &strong, &weak } })
      {
        const Histogram histogram = histogramOf(order, size, threads);
        EXPECT_EQ(histogram.range, expected.range);
        EXPECT_EQ(histogram.rays, expected.rays) << size;
      }
    }
  }
}

TEST(Histogram, BinsHaveTheirPlaceWhateverCameFirst)
{
  // Counted with a fine range first, light has to be in the bin where a coarse one would put it.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> exponent(-40, -2);
  const auto anySize = [&](int, int)
  {
    const double u = std::exp2(exponent(random)), v = std::exp2(exponent(random));
    return std::array<double, 2>{ random() % 2 == 0 ? u : -u, random() % 2 == 0 ? v : -v };
  };
  const std::vector<RayExit> exits = exitsOf(anySize);
  for (const int size : { 2, 5, 12 })
  {
    const Histogram histogram = histogramOf({ &exits }, size, 1);
    std::vector<std::int64_t> expected(histogram.rays.size());
    const auto binOf = [&](double eps)
    { return static_cast<int>(std::floor((eps / histogram.range + 1) / 2 * size)); };
    DeflectionHistogram oneByOne(size);
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        const RayExit& exit =
          exits[static_cast<std::size_t>((row + 1) * pass.columns + column + 2)];
        ++expected[static_cast<std::size_t>(
          binOf(exit.deflection[1]) * size + binOf(exit.deflection[0]))];
        oneByOne.add({ { 0, 0, 1, 1, { 0, 0 } }, &exit }, 1, 1, 1);
      }
    }
    EXPECT_EQ(histogram.rays, expected) << size;
    EXPECT_EQ(oneByOne.histogram().rays, expected) << size;
  }
}

TEST(Histogram, OfLightAtRestIsOneBinInTheMiddle)
{
  const std::vector<RayExit> exits = randomExits(5, 0);
  const Histogram histogram = histogramOf({ &exits }, 5, 2);
  EXPECT_GT(histogram.range, 0);
  EXPECT_EQ(histogram.rays[12], width * height);
  EXPECT_EQ(sumOf(histogram), width * height);
}

TEST(Histogram, TakesAnyDeflection)
{
  const std::vector<RayExit> exits = exitsOf(
    [](int column, int)
    {
      const double values[] = { 1, -1, 1e-320, -1e-320, 1e300, HUGE_VAL };
      return std::array<double, 2>{ values[column % 6], values[column % 5] };
    });
  const Histogram histogram = histogramOf({ &exits }, 8, 2);
  EXPECT_GT(histogram.range, 1e300);
  EXPECT_TRUE(std::isfinite(histogram.range));
}

TEST(Histogram, BelongsToTheImageAndIsCountedOnce)
{
  SampledField<float> column(
    cube(24, 1), [](double x, double y, double) { return 1e-4 * std::exp(-4 * (x * x + y * y)); });
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = 20;
  scene.view.height = 14;
  scene.samplesPerPixel = 3;
  Bench bench;
  EXPECT_EQ(bench.render(column.field, scene).histogram.size, 0);
  scene.histogramSize = 33;
  const Image first = bench.render(column.field, scene);
  EXPECT_EQ(first.histogram.size, 33);
  EXPECT_EQ(sumOf(first.histogram), 20 * 14 * 3);
  scene.cutoff = Cutoff::BrightField;
  EXPECT_EQ(bench.render(column.field, scene).histogram.rays, first.histogram.rays);
  scene.samplesPerPixel = 5;
  const Image more = bench.render(column.field, scene);
  EXPECT_EQ(sumOf(more.histogram), 20 * 14 * 5);
  EXPECT_EQ(more.histogram.rays, Bench().render(column.field, scene).histogram.rays);
  scene.samplesPerPixel = 3;
  EXPECT_EQ(bench.render(column.field, scene).histogram.rays, first.histogram.rays);
  scene.view.width = 21;
  EXPECT_EQ(sumOf(bench.render(column.field, scene).histogram), 21 * 14 * 3);
}

} // namespace

} // namespace schlieren
