// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Colour by field: rays gather the gradients of fields, and the image is tinted by the fields' colours.
#include "Fields.h"

#include <algorithm>
#include <array>
#include <limits>

namespace schlieren
{

namespace
{

using Function = std::function<double(double, double, double)>;
using Color = std::array<float, 3>;

constexpr Color red = { 1, 0, 0 };
constexpr Color blue = { 0.25f, 0.5f, 1 };

/// A medium with fields that tint.
struct TintedField : SampledField<float>
{
  TintedField(const Grid& grid, const Function& refractivity, const std::vector<Function>& fields)
    : SampledField<float>(grid, refractivity)
    , gradients(samples.size() * fields.size())
  {
    const int count = static_cast<int>(fields.size());
    for (int i = 0; i < count; ++i)
    {
      const SampledField<float> values(grid, fields[static_cast<std::size_t>(i)]);
      gradientMagnitudes(grid, values.samples.data(), nullptr, 1, count, i, gradients.data());
    }
    field.ambient = 0;
    field.gradients = { count, gradients.data(), field.version };
  }

  std::vector<float> gradients;
};

double vacuum(double, double, double) { return 0; }

/// One ray at each pixel's centre of an image that shows more than the data.
Scene sceneOf(const std::vector<Color>& colors, Device device = Device::Cpu)
{
  Scene scene;
  scene.fieldColors = colors;
  scene.view.width = scene.view.height = 40;
  scene.view.parallelScale = 1.25;
  scene.samplesPerPixel = 1;
  scene.kScale = 1000;
  scene.device = device;
  return scene;
}

/// A pixel's colour, its intensity being 1.
std::array<double, 3> tintAt(const Image& image, int column, int row)
{
  const std::size_t pixel = pixelOf(image, column, row);
  std::array<double, 3> tint;
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    tint[channel] = double{ image.color[3 * pixel + channel] } / double{ image.intensity[pixel] };
  }
  return tint;
}

/// The largest difference of any pixel's tint from that of a place of the image. Between rays the film draws what is
/// smooth: places beside kinks, as far as two pixels, can be left out.
double largestDifference(const Image& image,
  const std::function<std::array<double, 3>(double u, double v)>& truth,
  const std::function<bool(double u, double v, double pixel)>& isCompared = {})
{
  EXPECT_EQ(image.color.size(), 3 * image.intensity.size());
  double largest = 0;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const PixelCentre x = centreOf(image, column, row);
      if (isCompared && !isCompared(x.u, x.v, centreOf(image, 1, 0).u - centreOf(image, 0, 0).u))
      {
        continue;
      }
      const auto actual = tintAt(image, column, row);
      const auto expected = truth(x.u, x.v);
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        const double difference = std::abs(actual[channel] - expected[channel]);
        largest = std::isfinite(difference) ? std::max(largest, difference) : HUGE_VAL;
      }
    }
  }
  return largest;
}

bool isOutside(double u, double v) { return std::max(std::abs(u), std::abs(v)) > 1; }

constexpr std::array<double, 3> white = { 1, 1, 1 };

std::array<double, 3> mix(const std::vector<Color>& colors, const std::vector<double>& weights)
{
  std::array<double, 3> mixed{ 0, 0, 0 };
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    double sum = 0;
    for (std::size_t i = 0; i < colors.size(); ++i)
    {
      mixed[channel] += weights[i] * double{ colors[i][channel] };
      sum += weights[i];
    }
    mixed[channel] /= sum;
  }
  return mixed;
}

constexpr double rounding = 2e-6;

class TintOnDevice : public OnDevice
{
};

} // namespace

TEST(GradientMagnitudes, OfALinearFieldAreExactUpToTheFaces)
{
  Grid grid = cube(5, 1);
  grid.dimensions = { 5, 4, 3 };
  grid.spacing = { 0.5, 0.25, 2 };
  const SampledField<float> values(
    grid, [](double x, double y, double z) { return 3 * x + 2 * y - 4 * z; });
  std::vector<float> gradients(values.samples.size());
  gradientMagnitudes(grid, values.samples.data(), nullptr, 2, 1, 0, gradients.data());
  for (const float gradient : gradients)
  {
    EXPECT_NEAR(gradient, 0.25 * std::sqrt(29), 1e-6);
  }
}

TEST(GradientMagnitudes, DoNotLookIntoSolids)
{
  const Grid grid = cube(6, 1);
  SampledField<float> values(grid, [](double x, double y, double) { return x + y; });
  std::vector<unsigned char> valid(values.samples.size(), 1);
  valid[129] = 0;
  values.samples[129] = 1e6f;
  values.samples[86] = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> gradients(2 * values.samples.size(), -1);
  gradientMagnitudes(grid, values.samples.data(), valid.data(), 1, 2, 1, gradients.data());
  for (std::size_t i = 0; i < valid.size(); ++i)
  {
    EXPECT_NEAR(gradients[2 * i + 1], i == 129 || i == 86 ? 0 : 0.4 * std::sqrt(2), 1e-6) << i;
    EXPECT_EQ(gradients[2 * i], -1) << "belongs to another field";
  }
}

TEST_P(TintOnDevice, OneFieldTintsWithItsColourAlone)
{
  const TintedField tinted(cube(17, 1), vacuum, { [](double x, double, double) { return x; } });
  const Image image = Bench().render(tinted.field, sceneOf({ blue }, GetParam()));
  EXPECT_LT(largestDifference(image,
              [](double u, double v) { return isOutside(u, v) ? white : mix({ blue }, { 1 }); }),
    rounding);
}

TEST_P(TintOnDevice, FieldsInTwoHalvesTintEachItsOwn)
{
  const TintedField tinted(cube(17, 1), vacuum,
    { [](double x, double, double) { return std::min(x, 0.); },
      [](double x, double, double) { return std::max(x, 0.); } });
  Scene scene = sceneOf({ red, blue }, GetParam());
  scene.view.width = scene.view.height = 160; // so that there are pixels within the seam
  const Image image = Bench().render(tinted.field, scene);
  constexpr double h = 1. / 8;
  EXPECT_LT(largestDifference(
              image,
              [&](double u, double v)
              {
                if (isOutside(u, v))
                {
                  return white;
                }
                // At the seam both central differences are half, and linear on both sides.
                const double right = std::clamp(0.5 + 0.5 * u / h, 0., 1.);
                return mix({ red, blue }, { 1 - right, right });
              },
              [](double u, double, double pixel) { return std::abs(std::abs(u) - h) > 3 * pixel; }),
    rounding);
}

TEST_P(TintOnDevice, FieldsInOnePlaceMixByTheirGradients)
{
  const TintedField tinted(cube(17, 1), vacuum,
    { [](double, double y, double z) { return 0.3 * y - 0.4 * z; },
      [](double x, double, double) { return 1.5 * x; } });
  const Image image = Bench().render(tinted.field, sceneOf({ red, blue }, GetParam()));
  EXPECT_LT(largestDifference(image,
              [](double u, double v) {
                return isOutside(u, v) ? white : mix({ red, blue }, { 0.5, 1.5 });
              }),
    rounding);
}

// Each ray goes through the one half, then through the other.
TEST_P(TintOnDevice, FieldsOneBehindTheOtherMixByWhatIsGathered)
{
  const TintedField tinted(cube(17, 1), vacuum,
    { [](double, double, double z) { return 2 * std::min(z, 0.); },
      [](double, double, double z) { return std::max(z, 0.); } });
  for (const double step : { 1., 0.37 })
  {
    Scene scene = sceneOf({ red, blue }, GetParam());
    scene.stepSize = step;
    const Image image = Bench().render(tinted.field, scene);
    EXPECT_LT(largestDifference(image,
                [](double u, double v) {
                  return isOutside(u, v) ? white : mix({ red, blue }, { 2, 1 });
                }),
      step == 1 ? rounding : 2e-3);
  }
}

// f = x^2 y^2: a ray gathers 2 |x y| r times the depth. Full colour is where 99 % of the rays have less.
TEST_P(TintOnDevice, StrengthIsRelativeToThe99thPercentile)
{
  const TintedField tinted(
    cube(65, 1), vacuum, { [](double x, double y, double) { return x * x * y * y; } });
  const auto slope = [](double x, double y) { return 2 * std::abs(x * y) * std::hypot(x, y); };
  const Image image = Bench().render(tinted.field, sceneOf({ red }, GetParam()));
  std::vector<double> gathered;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const PixelCentre x = centreOf(image, column, row);
      if (!isOutside(x.u, x.v))
      {
        gathered.push_back(slope(x.u, x.v));
      }
    }
  }
  std::sort(gathered.begin(), gathered.end());
  const double reference =
    gathered[static_cast<std::size_t>(0.99 * static_cast<double>(gathered.size() - 1))];
  EXPECT_LT(largestDifference(
              image,
              [&](double u, double v)
              {
                const double strength = isOutside(u, v) ? 0 : std::min(1., slope(u, v) / reference);
                return std::array<double, 3>{ 1, 1 - strength, 1 - strength };
              },
              [&](double u, double v, double pixel)
              {
                const bool isAtAxis = std::min(std::abs(u), std::abs(v)) < 3 * pixel;
                const double atLeast = slope(std::abs(u) - 3 * pixel, std::abs(v) - 3 * pixel);
                const double atMost = slope(std::abs(u) + 3 * pixel, std::abs(v) + 3 * pixel);
                const bool isAtFull = atLeast < reference && atMost > reference;
                return !isAtAxis && !(isAtFull && !isOutside(u, v));
              }),
    0.01);
}

// Seen along a diagonal, through voxels of 1 : 2 : 3, the colours are the same.
TEST_P(TintOnDevice, ObliqueViewsAndFlatVoxelsDoNotChangeTheMixture)
{
  Grid grid = cube(13, 1);
  grid.dimensions = { 25, 13, 9 };
  grid.spacing = { 2. / 24, 2. / 12, 2. / 8 };
  const TintedField tinted(grid, vacuum,
    { [](double x, double, double) { return x; },
      [](double, double y, double z) { return 0.6 * y + 0.8 * z; } });
  Scene scene = sceneOf({ red, blue }, GetParam());
  scene.view.viewDirection = { -1, -2, -3 };
  scene.view.parallelScale = 0.2; // where all rays have the same depth
  const Image image = Bench().render(tinted.field, scene);
  const std::size_t centre = pixelOf(image, 20, 20);
  const auto expected = mix({ red, blue }, { 1, 1 });
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(double{ image.color[3 * centre + channel] } / double{ image.intensity[centre] },
      expected[channel], 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, TintOnDevice, bothDevices(), deviceName);

namespace
{

double swirl(double x, double y, double z) { return 3e-4 * std::sin(2 * x + y) * std::cos(2 * z); }

std::vector<Function> fiveFields()
{
  std::vector<Function> fields;
  for (int i = 0; i < 5; ++i)
  {
    fields.push_back([i](double x, double y, double z)
      { return std::sin((i + 1) * x) * std::cos(i * y) + 0.2 * i * z; });
  }
  return fields;
}

const std::vector<Color> fiveColors = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 0 },
  { 0, 1, 1 } };

} // namespace

// What is not tinted is the same to the last bit, and the tint does not depend on the threads.
TEST(Tint, LeavesEverythingElseAsItIsWithAnyNumberOfThreads)
{
  TintedField tinted(cube(24, 1), swirl, fiveFields());
  tinted.samples[24 * 24 * 12 + 24 * 12 + 12] = std::numeric_limits<float>::quiet_NaN();
  Scene scene = sceneOf(fiveColors);
  scene.samplesPerPixel = 3;
  scene.kScale.reset();
  for (const Interpolation interpolation : allInterpolations)
  {
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph })
      {
        scene.interpolation = interpolation;
        scene.precision = precision;
        scene.cutoff = cutoff;
        scene.threads = 1;
        Field plain = tinted.field;
        plain.gradients = {};
        const Image without = Bench().render(plain, scene);
        const Image with = Bench().render(tinted.field, scene);
        EXPECT_TRUE(without.color.empty());
        EXPECT_EQ(without.intensity, with.intensity);
        EXPECT_EQ(without.deflection, with.deflection);
        EXPECT_EQ(without.opticalPathDifference, with.opticalPathDifference);
        EXPECT_EQ(without.stepsTaken, with.stepsTaken);
        EXPECT_EQ(without.kScale, with.kScale);
        ASSERT_EQ(with.color.size(), 3 * with.intensity.size());
        EXPECT_GT(with.raysBlocked, 0);
        bool isTinted = false;
        for (std::size_t i = 0; i < with.color.size(); ++i)
        {
          EXPECT_LE(with.color[i], with.intensity[i / 3]);
          isTinted = isTinted || with.color[i] < 0.5f * with.intensity[i / 3];
        }
        EXPECT_TRUE(isTinted);
        for (const int threads : { 2, 5 })
        {
          scene.threads = threads;
          EXPECT_EQ(Bench().render(tinted.field, scene).color, with.color);
        }
      }
    }
  }
}

// With the light of all pixels shared out, red light is the light times red, summed over the rays.
TEST(Tint, OfSeveralRaysIsTheMeanOfTheirColours)
{
  const TintedField tinted(cube(17, 1), swirl, { [](double x, double, double) { return x; } });
  Scene scene = sceneOf({ blue });
  scene.samplesPerPixel = 5;
  scene.view.parallelScale = 0.6; // all rays cross the data
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph })
  {
    scene.cutoff = cutoff;
    const Image image = Bench().render(tinted.field, scene);
    // The knife edge's rays gather nearly the same; the light of the shadowgraph comes from around.
    EXPECT_LT(largestDifference(image, [](double, double) { return mix({ blue }, { 1 }); }), 2e-3);
  }
}

TEST(Tint, BlockedLightIsBlack)
{
  TintedField tinted(cube(9, 1), vacuum, { [](double x, double, double) { return x; } });
  std::fill(tinted.samples.begin(), tinted.samples.begin() + 3 * 81,
    std::numeric_limits<float>::quiet_NaN());
  const Image image = Bench().render(tinted.field, sceneOf({ red }));
  const std::size_t centre = pixelOf(image, 20, 20);
  EXPECT_EQ(image.blockedFraction[centre], 1);
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    EXPECT_EQ(image.color[3 * centre + channel], 0);
    EXPECT_EQ(image.color[channel], 0.5); // in the corner light passes by
  }
}

TEST(Tint, FieldsWithoutGradientLeaveTheImageWhite)
{
  const TintedField tinted(cube(9, 1), swirl, { [](double, double, double) { return 7; } });
  const Image image = Bench().render(tinted.field, sceneOf({ red }));
  for (std::size_t i = 0; i < image.color.size(); ++i)
  {
    EXPECT_EQ(image.color[i], image.intensity[i / 3]);
  }
}

TEST(Tint, ColoursCutoffAndSwitchingOffTraceNothing)
{
  const TintedField tinted(
    cube(16, 1), swirl, { [](double x, double y, double) { return x * y; } });
  Field plain = tinted.field;
  plain.gradients = {};
  Bench bench;
  Scene scene = sceneOf({ red });
  scene.samplesPerPixel = 2;
  const auto first = bench.render(tinted.field, scene).color;
  const std::int64_t rays = bench.work().raysTraced;
  ASSERT_GT(rays, 0);

  scene.fieldColors = { blue };
  EXPECT_NE(bench.render(tinted.field, scene).color, first);
  scene.cutoff = Cutoff::Shadowgraph;
  bench.render(tinted.field, scene);
  scene.cutoff = Cutoff::KnifeEdge;
  scene.knifeEdgeAngle = 90;
  scene.kScale = 10;
  bench.render(tinted.field, scene);
  bench.render(plain, scene);
  EXPECT_EQ(bench.work().raysTraced, rays);

  // Rays added while nothing is tinted know no fields: tinting traces them again, and only them.
  scene = sceneOf({ red });
  scene.samplesPerPixel = 4;
  bench.render(plain, scene);
  EXPECT_EQ(bench.work().raysTraced, 2 * rays);
  const Image image = bench.render(tinted.field, scene);
  EXPECT_EQ(bench.work().raysTraced, 3 * rays);
  EXPECT_EQ(image.color, Bench().render(tinted.field, scene).color);
  EXPECT_EQ(bench.work().mediumBuilds, 1);

  // Other fields on the same medium.
  Field other = tinted.field;
  std::vector<float> gradients(tinted.samples.size(), 1.f);
  other.gradients = { 1, gradients.data(), tinted.field.version + 1000 };
  bench.render(other, scene);
  EXPECT_EQ(bench.work().raysTraced, 5 * rays);
  EXPECT_EQ(bench.work().mediumBuilds, 1);
}

TEST(Tint, MistakesAreReported)
{
  const TintedField tinted(cube(9, 1), vacuum, { [](double x, double, double) { return x; } });
  EXPECT_THROW(Bench().render(tinted.field, sceneOf({})), Error);
  EXPECT_THROW(Bench().render(tinted.field, sceneOf({ red, blue })), Error);
  EXPECT_THROW(Bench().render(tinted.field, sceneOf({ { 1, 0, 1.5f } })), Error);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Bench().render(tinted.field, sceneOf({ { nan, 0, 1 } })), Error);
  Field field = tinted.field;
  field.gradients.values = nullptr;
  EXPECT_THROW(Bench().render(field, sceneOf({ red })), Error);
}

} // namespace schlieren
