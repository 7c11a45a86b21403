// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Waves on a screen, from what rays carry where they leave the data.
#include "Messages.h"
#include "WaveBench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>

using namespace schlieren;
using namespace schlieren::waveforms;

TEST(ScreenWaves, UndisturbedLightIsOne)
{
  WaveReport report;
  Bench1d bench{ 2e-5, 40, 0.1 };
  bench.planeOtherwise = 3e-3;
  for (const double light : bench.image([](double) { return Ray{}; }, &report))
  {
    EXPECT_NEAR(light, 1, 1e-12);
  }
  EXPECT_EQ(report.pointsPerPixel, 2);
  EXPECT_EQ(report.plane, 3e-3);
  EXPECT_NEAR(report.fresnelWidth, std::sqrt(green * 0.103), 1e-12);
  EXPECT_EQ(report.leastTubeRatio, 1);
}

TEST(ScreenWaves, BecomeRaysAsTheWavelengthFalls)
{
  const double size = 1e-3, distance = 0.2, path = 0.5 * size * size / (2 * distance);
  const RayAt rays = column(path, size);
  double before = 1;
  for (const auto& [wavelength, error] :
    { std::pair(532e-9, 3e-3), std::pair(133e-9, 2.5e-4), std::pair(33e-9, 1e-4) })
  {
    const Bench1d bench{ 5e-5, 100, distance, wavelength, steepestOfColumn(path, size) };
    Numbers exact;
    for (const double x : bench.pixels())
    {
      double edges[2];
      for (int side = 0; side < 2; ++side)
      {
        const double at = x + (side - 0.5) * bench.pixel;
        double start = at;
        for (int round = 0; round < 60; ++round)
        {
          start += 0.5 * (at - start - distance * rays(start).deflection);
        }
        edges[side] = start;
      }
      exact.push_back((edges[1] - edges[0]) / bench.pixel);
    }
    const double off = rms(bench.image(rays), exact);
    EXPECT_LT(off, error) << wavelength;
    EXPECT_LT(off, before);
    before = off;
  }
}

TEST(ScreenWaves, OneRayInAPixelIsEnough)
{
  const double size = 1e-3, distance = 0.2, path = 1.5 * size * size / (2 * distance); // 44 rad
  Bench1d bench{ size / 8, 48, distance, green, steepestOfColumn(path, size) };
  WaveReport report;
  const Numbers coarse = bench.image(column(path, size), &report);
  EXPECT_EQ(report.pointsPerPixel, 4); // 4 by a wave's length over the largest deflection
  bench.raysPerPixel = 4;
  EXPECT_LT(rms(coarse, bench.image(column(path, size))), 2e-4);
}

TEST(ScreenWaves, FlowMayCrossTheBorder)
{
  const double distance = 0.2, scale = fresnelWidth(green, distance), width = 20 * scale;
  const RayAt rays = [=](double x)
  {
    const double y = (x - 0.3 * width) / (0.25 * width), hump = 4e-6 * std::exp(-y * y);
    return Ray{ hump + 5e-7 * std::sin(x / scale / 1.5),
      -2 * y / (0.25 * width) * hump + 5e-7 / scale / 1.5 * std::cos(x / scale / 1.5), 0 };
  };
  const Bench1d bench{ scale / 12, 240, distance, green, 4e-3 };
  const Bench1d wide{ scale / 12, 960, distance, green, 4e-3 };
  const Numbers all = wide.image(rays);
  EXPECT_LT(rms(bench.image(rays), Numbers(all.begin() + 360, all.begin() + 600)), 1e-4);
}

TEST(ScreenWaves, CommonTiltTakesNoPoints)
{
  const double size = 1e-3, distance = 0.2, path = 3e-6, wedge = 0.02;
  const double shift = distance * wedge / std::sqrt(1 - wedge * wedge);
  // So many pixels that the shift is a whole number of them.
  const double pixel = shift / 160;
  Bench1d bench{ pixel, 400, distance, green, wedge + steepestOfColumn(path, size) };
  const RayAt straight = column(path, size);
  const RayAt tilted = [&](double x)
  {
    Ray ray = straight(x + shift);
    ray.path += wedge * x;
    ray.deflection += wedge;
    return ray;
  };
  WaveReport report;
  const Numbers seen = bench.image(tilted, &report), exact = bench.image(straight);
  EXPECT_EQ(report.pointsPerPixel, 2);
  EXPECT_LT(
    rms({ seen.begin() + 100, seen.begin() + 300 }, { exact.begin() + 100, exact.begin() + 300 }),
    2e-3);
}

namespace
{

/// Two columns of 10 rad, before and behind the middle, traced by small steps; and the field behind 400 slices of it.
struct TwoColumns
{
  static constexpr double depth = 8e-3;
  static constexpr int slices = 400;
  static constexpr double step = depth / slices;

  static double refractivity(double x, double z)
  {
    const auto hump = [](double a, double b) { return std::exp(-(a * a + b * b) / 1e-6); };
    return 4.8e-4 * (hump(x + 0.3e-3, z + 2.5e-3) + hump(x - 0.3e-3, z - 2.5e-3));
  }
  static Ray trace(double x)
  {
    constexpr double h = 1e-7;
    double at = x, slope = 0, path = 0;
    for (int i = 0; i < slices; ++i)
    {
      const double z = (i + 0.5) * step - depth / 2;
      at += 0.5 * step * slope;
      const double n = refractivity(at, z);
      const double gradient = (refractivity(at + h, z) - refractivity(at - h, z)) / (2 * h);
      const double middle = slope + 0.5 * step * gradient;
      path += step * (n + 0.5 * (n * n + middle * middle));
      slope += step * (1 + n) * gradient;
      at += 0.5 * step * slope;
    }
    return { path, slope, at - x };
  }
  static Numbers light(std::int64_t points, double spacing, double distance)
  {
    const Numbers x = places(points, spacing);
    ComplexField field(points, 1);
    for (int i = 0; i < slices; ++i)
    {
      const double z = (i + 0.5) * step - depth / 2;
      propagate(field, { green, 0.5 * step, spacing }, 1);
      for (std::int64_t k = 0; k < points; ++k)
      {
        const double turns = refractivity(x[static_cast<std::size_t>(k)], z) * step / green;
        field.row(0)[k] = (1. + field.row(0)[k]) * std::polar(1., 2 * pi * turns) - 1.;
      }
      propagate(field, { green, 0.5 * step, spacing }, 1);
    }
    propagate(field, { green, distance, spacing }, 1);
    Numbers light;
    for (std::int64_t k = 0; k < points; ++k)
    {
      light.push_back(std::norm(1. + field.row(0)[k]));
    }
    return light;
  }
};

} // namespace

TEST(ScreenWaves, TwoColumnsAreWhatSlicesOfWavesMakeOfThem)
{
  const double distance = 0.2;
  const Bench1d bench{ 4e-5, 200, distance, green, 1e-3 };
  WaveReport report;
  const Numbers seen = bench.image(TwoColumns::trace, &report);
  const std::int64_t points = 4096, perPixel = 8;
  const Numbers exact =
    meansOf(TwoColumns::light(points, bench.pixel / perPixel, distance), perPixel);
  const std::int64_t before = (points / perPixel - bench.width) / 2;
  EXPECT_LT(rms(seen, { exact.begin() + before, exact.begin() + before + bench.width }), 3e-4);
  EXPECT_NEAR(report.plane, 4e-3, 1e-3); // in the middle, about
}

TEST(ScreenWaves, HalfPlaneOfBlockedRays)
{
  const double distance = 0.2, width = fresnelWidth(green, distance);
  const Bench1d bench{ width / 4, 64, distance, green, 0, 8 };
  const Numbers seen = bench.image([](double x) { return Ray{ 0, 0, 0, x < 0 }; });
  // Of a pixel's mean, by points within it.
  const int finer = 16;
  const Numbers exact =
    meansOf(halfPlane(places(bench.width * finer, bench.pixel / finer), green, distance), finer);
  // Dark light around the image falls to undisturbed light within the margin.
  EXPECT_LT(rms({ seen.begin() + 16, seen.end() }, { exact.begin() + 16, exact.end() }), 2e-3);
}

TEST(ScreenWaves, ExtendedSourceBlursByItsImage)
{
  const double distance = 0.2, path = 3e-6, size = 5e-4;
  Bench1d bench{ 2e-5, 120, distance, green, steepestOfColumn(path, size) };
  bench.source.shape = SourceShape::Slit;
  bench.source.width = 10 * bench.pixel / distance; // ten pixels on the screen
  const Numbers seen = bench.image(column(path, size));
  const std::size_t finer = 4;
  const Bench1d fine{ bench.pixel / finer, 4 * bench.width, distance, green,
    steepestOfColumn(path, size) };
  const Numbers sharp = fine.image(column(path, size));
  Numbers blurred;
  for (std::size_t i = 0; i < sharp.size(); ++i)
  {
    double sum = 0; // of light that is a straight line between two values
    for (std::size_t k = 0; i >= 20 && i + 20 < sharp.size() && k <= 40; ++k)
    {
      sum += (k == 0 || k == 40 ? 0.5 : 1) * sharp[i + k - 20] / 40;
    }
    blurred.push_back(sum);
  }
  const Numbers means = meansOf(blurred, finer);
  EXPECT_LT(rms({ seen.begin() + 10, seen.end() - 10 }, { means.begin() + 10, means.end() - 10 }),
    2.5e-3); // of light up to 3.3
  EXPECT_GT(rms(meansOf(sharp, finer), seen), 0.02);
}

TEST(ScreenWaves, RaysThatCrossWithinTheFlowAreAnError)
{
  Bench1d bench{ 5e-5, 40, 0.1, green, 1e-2 };
  const RayAt rays = [](double x)
  {
    // Focused 1 cm before the exit, and bent in several planes, so that none brings all back.
    const double slope = std::abs(x) < 1e-3 ? -0.03 * std::sin(pi * x / 1e-3) : 0;
    return Ray{ 0, slope,
      slope * 0.02 + (std::abs(x) < 1e-3 ? 4e-4 * std::sin(2 * pi * x / 1e-3) : 0) };
  };
  const std::string message = messageOf([&] { bench.image(rays); });
  EXPECT_NE(message.find("Rays cross"), std::string::npos) << message;
}

TEST(ScreenWaves, TooManyPointsAreAnError)
{
  Bench1d bench{ 1e-4, 200, 0.2, green, 0.05 };
  bench.memoryBudget = std::size_t{ 1 } << 24;
  const RayAt rays = [](double x) { return Ray{ 0, x < 0 ? 0.05 : -0.05, 0 }; };
  const std::string message = messageOf([&] { bench.image(rays); });
  EXPECT_NE(
    message.find("38 points along each side of a pixel of 100 micrometres"), std::string::npos)
    << message;
  EXPECT_NE(message.find("may be used"), std::string::npos);
}
