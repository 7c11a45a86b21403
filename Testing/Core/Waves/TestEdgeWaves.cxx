// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Knife edges in coherent light and in that of a slit.
#include "WaveBench.h"

using namespace schlieren;
using namespace schlieren::waveforms;

namespace
{

/// In focus on the plane that bends light.
Bench1d benchOf(double pixel, std::int64_t width, double source, int points)
{
  Bench1d bench{ pixel, width, 0 };
  bench.edge = Edge{ 0, 0, source, points };
  return bench;
}

/// A weak grating of phases over all that is traced.
RayAt grating(double amplitude, double period)
{
  return [=](double x)
  {
    const double turn = 2 * pi / period, path = amplitude * green / (2 * pi);
    return Ray{ path * std::cos(turn * x), -path * turn * std::sin(turn * x), 0 };
  };
}

} // namespace

TEST(EdgeWaves, UndisturbedLightIsHalfOfASlitAndAQuarterOfALaser)
{
  for (const auto& [points, light] : { std::pair(1, 0.25), std::pair(32, 0.5) })
  {
    for (const double value : benchOf(1e-4, 32, 1e-3, points).image([](double) { return Ray{}; }))
    {
      EXPECT_NEAR(value, light, 1e-6);
    }
  }
  Bench1d bench = benchOf(1e-4, 32, 1e-3, 40);
  bench.edge->place = 0.25e-3; // a quarter of the source's image
  EXPECT_NEAR(bench.image([](double) { return Ray{}; })[16], 0.25, 1e-6);
  bench.edge->isOther = true;
  EXPECT_NEAR(bench.image([](double) { return Ray{}; })[16], 0.75, 1e-6);
}

TEST(EdgeWaves, LaserSeesHilbertsTransformOfAWeakPhase)
{
  const double amplitude = 1e-3, width = 5e-4;
  const Bench1d bench = benchOf(2 * width / 50, 500, 0, 1); // 20 widths
  const Numbers seen = bench.image(column(amplitude * green / (2 * pi), width));
  Numbers exact, middle;
  const Numbers x = bench.pixels();
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    if (std::abs(x[i]) < 3 * width)
    {
      exact.push_back(0.25 * (1 - 4 * amplitude / std::sqrt(pi) * dawson(x[i] / width)));
      middle.push_back(seen[i]);
    }
  }
  EXPECT_LT(rms(middle, exact), 5e-3 * 0.5 * amplitude);
}

TEST(EdgeWaves, SlitSeesSlopesOfFeaturesThatAreNotTooFine)
{
  // Of a component of frequency f the light is -min(f, s / 2) / s of its phase, s the slit in frequencies.
  const double amplitude = 0.01, period = 8e-4;
  for (const auto& [orders, response] :
    { std::pair(0.5, 0.5), std::pair(2., 0.5), std::pair(4., 0.25), std::pair(16., 0.0625) })
  {
    const double source = orders * green / period;
    const Bench1d bench = benchOf(period / 40, 400, source, 64);
    const Numbers x = bench.pixels(), seen = bench.image(grating(amplitude, period));
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      sum += 2 * seen[i] * std::sin(2 * pi * x[i] / period) / static_cast<double>(x.size());
    }
    EXPECT_NEAR(sum / amplitude, -response, 0.02) << orders;
  }
}

TEST(EdgeWaves, StrongPhaseIsAsThatOfRays)
{
  const double size = 1e-3, path = 300 * green / (2 * pi);
  Bench1d bench = benchOf(4e-5, 150, 5 * steepestOfColumn(path, size), 64);
  const Numbers seen = bench.image(column(path, size));
  Numbers rays;
  for (const double x : bench.pixels())
  {
    rays.push_back(0.5 + column(path, size)(x).deflection / bench.edge->source);
  }
  EXPECT_LT(rms(seen, rays), 5e-3);
}

TEST(EdgeWaves, FollowTheEdgesAngle)
{
  const double size = 1e-3, path = 30 * green / (2 * pi);
  Bench1d bench = benchOf(4e-5, 100, 5 * steepestOfColumn(path, size), 32);
  const Numbers right = bench.image(column(path, size));
  bench.edge->angle = 180;
  const Numbers left = bench.image(column(path, size));
  for (std::size_t i = 0; i < left.size(); ++i)
  {
    EXPECT_NEAR(left[i], right[left.size() - 1 - i], 1e-6);
  }
}
