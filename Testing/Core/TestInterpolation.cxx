// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fields.h"
#include "Medium/Interpolation.h"
#include "Medium/Medium.h"

#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace schlieren
{

namespace
{

template <class Interpolate, class Real>
Sample<Real> sampleAt(const Medium<Real>& medium, double x, double y, double z)
{
  return interpolate<Interpolate>(
    medium.view(), { static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z) });
}

Grid box(std::int64_t nx, std::int64_t ny, std::int64_t nz)
{
  Grid grid;
  grid.dimensions = { nx, ny, nz };
  return grid;
}

TEST(QuadraticInterpolation, PassesThroughTheSamples)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Grid& grid : { box(2, 2, 2), box(3, 2, 5), box(9, 8, 7), box(40, 3, 4) })
  {
    SampledField<double> field(grid, [&](double, double, double) { return 0.1 * any(random); });
    field.field.ambient = 0;
    const Medium<double> medium = buildMedium<double>(field.field, Interpolation::Quadratic, 1);
    std::size_t at = 0;
    for (int k = 0; k < grid.dimensions[2]; ++k)
    {
      for (int j = 0; j < grid.dimensions[1]; ++j)
      {
        for (int i = 0; i < grid.dimensions[0]; ++i, ++at)
        {
          EXPECT_NEAR(
            sampleAt<QuadraticInterpolation>(medium, i, j, k).value, field.samples[at], 1e-14);
        }
      }
    }
  }
}

/// Up to the boundary: nothing is mirrored or flattened there.
TEST(QuadraticInterpolation, ReproducesParabolasEverywhere)
{
  const auto parabola = [](double x, double y, double z)
  { return 0.01 * (1 + 0.3 * x - 0.2 * y + 0.5 * z + 0.04 * x * x - 0.03 * x * y + 0.02 * z * z); };
  SampledField<double> field(box(6, 5, 7), parabola);
  field.field.ambient = 0;
  const Medium<double> medium = buildMedium<double>(field.field, Interpolation::Quadratic, 1);
  for (double x = 0; x <= 5; x += 0.1)
  {
    for (double y = 0; y <= 4; y += 0.4)
    {
      for (double z = 0; z <= 6; z += 0.3)
      {
        const Sample<double> sample = sampleAt<QuadraticInterpolation>(medium, x, y, z);
        EXPECT_NEAR(sample.value, parabola(x, y, z), 1e-14);
        EXPECT_NEAR(sample.gradient.x, 0.01 * (0.3 + 0.08 * x - 0.03 * y), 1e-14);
        EXPECT_NEAR(sample.gradient.y, 0.01 * (-0.2 - 0.03 * x), 1e-14);
        EXPECT_NEAR(sample.gradient.z, 0.01 * (0.5 + 0.04 * z), 1e-14);
      }
    }
  }
}

TEST(QuadraticInterpolation, GradientIsContinuousAcrossCells)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  SampledField<double> field(
    box(8, 8, 8), [&](double, double, double) { return 0.1 * any(random); });
  field.field.ambient = 0;
  const Medium<double> medium = buildMedium<double>(field.field, Interpolation::Quadratic, 1);
  for (double edge = 0.5; edge < 7; edge += 0.5)
  {
    const Sample<double> below = sampleAt<QuadraticInterpolation>(medium, edge - 1e-9, 3.3, 4.1);
    const Sample<double> above = sampleAt<QuadraticInterpolation>(medium, edge + 1e-9, 3.3, 4.1);
    EXPECT_NEAR(below.value, above.value, 1e-8);
    EXPECT_NEAR(below.gradient.x, above.gradient.x, 1e-8);
    EXPECT_NEAR(below.gradient.y, above.gradient.y, 1e-8);
    EXPECT_NEAR(below.gradient.z, above.gradient.z, 1e-8);
  }
}

/// Largest errors of value and derivative of a sine with n points over two periods.
template <class Interpolate>
std::pair<double, double> sineErrors(int n, Interpolation interpolation)
{
  const double wave = 4 * pi / (n - 1);
  SampledField<double> field(
    box(n, 4, 4), [&](double x, double, double) { return 0.1 * std::sin(wave * x); });
  field.field.ambient = 0;
  const Medium<double> medium = buildMedium<double>(field.field, interpolation, 1);
  double value = 0, slope = 0;
  for (double x = 0; x <= n - 1; x += 0.0371)
  {
    const Sample<double> sample = sampleAt<Interpolate>(medium, x, 1.5, 1.2);
    value = std::max(value, std::abs(sample.value - 0.1 * std::sin(wave * x)));
    slope = std::max(slope, std::abs(sample.gradient.x / wave - 0.1 * std::cos(wave * x)));
  }
  return { value, slope };
}

TEST(QuadraticInterpolation, ConvergesAtThirdOrderItsGradientAtSecond)
{
  const auto coarse = sineErrors<QuadraticInterpolation>(33, Interpolation::Quadratic);
  const auto fine = sineErrors<QuadraticInterpolation>(65, Interpolation::Quadratic);
  EXPECT_NEAR(std::log2(coarse.first / fine.first), 3, 0.2);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), 2, 0.2);
}

TEST(LinearInterpolation, ConvergesAtSecondOrderItsGradientAtFirst)
{
  const auto coarse = sineErrors<LinearInterpolation>(33, Interpolation::Linear);
  const auto fine = sineErrors<LinearInterpolation>(65, Interpolation::Linear);
  EXPECT_NEAR(std::log2(coarse.first / fine.first), 2, 0.2);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), 1, 0.2);
}

TEST(LinearInterpolation, ReachesTheLastPoint)
{
  SampledField<float> field(
    box(3, 3, 3), [](double x, double y, double z) { return 0.01 * x + 0.02 * y + 0.03 * z; });
  field.field.ambient = 0;
  const Medium<float> medium = buildMedium<float>(field.field, Interpolation::Linear, 1);
  const Sample<float> sample = sampleAt<LinearInterpolation>(medium, 2, 2, 2);
  EXPECT_NEAR(sample.value, 0.12, 1e-7);
  EXPECT_NEAR(sample.gradient.x, 0.01, 1e-7);
  EXPECT_NEAR(sample.gradient.y, 0.02, 1e-7);
  EXPECT_NEAR(sample.gradient.z, 0.03, 1e-7);
}

TEST(Medium, DoesNotDependOnTheNumberOfThreads)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1e-4, 1e-4);
  SampledField<float> field(box(19, 23, 29), [&](double, double, double) { return any(random); });
  field.samples[1000] = std::numeric_limits<float>::quiet_NaN();
  const Medium<float> one = buildMedium<float>(field.field, Interpolation::Quadratic, 1);
  for (const int threads : { 2, 7 })
  {
    const Medium<float> several =
      buildMedium<float>(field.field, Interpolation::Quadratic, threads);
    EXPECT_EQ(one.volume.samples, several.volume.samples);
    EXPECT_EQ(one.solid, several.solid);
    EXPECT_EQ(one.ambient, several.ambient);
    EXPECT_EQ(one.slope.x, several.slope.x);
  }
}

TEST(Medium, AmbientIsTheMedianOfTheBoundary)
{
  // A jet leaves through one face; the gas around it decides.
  const SampledField<float> field(box(11, 11, 11),
    [](double x, double y, double) { return std::hypot(x - 5, y - 5) < 3 ? 9e-4 : 2.7e-4; });
  EXPECT_FLOAT_EQ(
    static_cast<float>(buildMedium<float>(field.field, Interpolation::Linear, 1).ambient), 2.7e-4f);
}

/// The tails of a blob's coefficients end in zeros, not in denormal numbers.
TEST(Medium, HoldsNoDenormals)
{
  const SampledField<float> field(
    box(200, 6, 6), [](double x, double, double) { return x > 99 && x < 101 ? 1e-4 : 0; });
  for (const Interpolation interpolation : { Interpolation::Quadratic, Interpolation::Linear })
  {
    const Medium<float> medium = buildMedium<float>(field.field, interpolation, 1);
    int zeros = 0;
    for (const float sample : medium.volume.samples)
    {
      EXPECT_TRUE(sample == 0 || std::abs(sample) > 1e-30f);
      zeros += sample == 0 ? 1 : 0;
    }
    EXPECT_GT(zeros, 1000);
  }
}

TEST(Medium, ItsBoundsHold)
{
  std::mt19937 random(13);
  std::uniform_real_distribution<double> any(-1e-3, 1e-3);
  const SampledField<double> field(box(9, 10, 11),
    [&](double x, double y, double z)
    { return std::sin(x + 0.8 * y - 0.6 * z) * 0.1 + any(random); });
  const Medium<double> medium = buildMedium<double>(field.field, Interpolation::Quadratic, 1);
  std::uniform_real_distribution<double> where(0, 1);
  double x = 0, nu = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Sample<double> sample = sampleAt<QuadraticInterpolation>(
      medium, 8 * where(random), 9 * where(random), 10 * where(random));
    EXPECT_LE(std::abs(sample.value), medium.largestNu);
    EXPECT_LE(std::abs(sample.gradient.x), medium.slope.x);
    EXPECT_LE(std::abs(sample.gradient.y), medium.slope.y);
    EXPECT_LE(std::abs(sample.gradient.z), medium.slope.z);
    x = std::max(x, std::abs(sample.gradient.x));
    nu = std::max(nu, std::abs(sample.value));
  }
  EXPECT_GT(x, 0.1 * medium.slope.x);
  EXPECT_GT(nu, 0.1 * medium.largestNu);
}

} // namespace

} // namespace schlieren
