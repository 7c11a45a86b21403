// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Cuda/LaunchPace.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace schlieren
{

namespace
{

constexpr double steps = 300;
constexpr double secondsToLaunch = 10e-6;

/// Launches as CudaTracer makes them: each is sized before the one before has ended.
struct Launches
{
  double longest = 0, total = 0;
  int count = 0;
};

/// `crossedBetween(a, b)`: how many of the rays a ... b - 1 cross the medium; the others take no time.
template <class CrossedBetween>
Launches launchesFor(
  std::int64_t rays, double stepsPerSecond, LaunchPace& pace, const CrossedBetween& crossedBetween)
{
  Launches launches;
  std::int64_t begin = 0, end = std::min(pace.rays(), rays);
  while (begin < rays)
  {
    const std::int64_t next = std::min(end + pace.rays(), rays);
    const std::int64_t crossed = crossedBetween(begin, end);
    const double seconds = secondsToLaunch + static_cast<double>(crossed) * steps / stepsPerSecond;
    pace.add(end - begin, crossed, seconds);
    launches.longest = std::max(launches.longest, seconds);
    launches.total += seconds;
    ++launches.count;
    begin = end;
    end = next;
  }
  return launches;
}

/// Steps per second of an old GPU in double precision ... a new one that reads in order.
constexpr double speeds[] = { 5e8, 2e9, 2e10, 1e11 };

TEST(LaunchPace, NoLaunchLastsLong)
{
  constexpr std::int64_t rays = 2000 * 2000;
  for (const double speed : speeds)
  {
    LaunchPace pace(steps);
    const Launches all =
      launchesFor(rays, speed, pace, [](std::int64_t a, std::int64_t b) { return b - a; });
    EXPECT_LT(all.longest, 0.1) << speed;
    EXPECT_LT(all.count * secondsToLaunch, 0.1 * all.total) << speed;
  }
}

/// Rays of the image's lower half miss the medium, or nearly all do.
TEST(LaunchPace, RaysThatMissTellNothing)
{
  constexpr std::int64_t rays = 2000 * 2000;
  for (const double speed : speeds)
  {
    for (const std::int64_t missed : { 1, 1000 })
    {
      LaunchPace pace(steps);
      const Launches all = launchesFor(rays, speed, pace,
        [missed](std::int64_t a, std::int64_t b)
        {
          const std::int64_t inMedium = std::max<std::int64_t>(b - std::max(a, rays / 2), 0);
          return inMedium + (missed == 1 ? 0 : (b - a - inMedium) / missed);
        });
      EXPECT_LT(all.longest, 0.1) << speed;
    }
  }
}

TEST(LaunchPace, IsKeptForTheNextPass)
{
  constexpr std::int64_t rays = 512 * 512;
  const auto all = [](std::int64_t a, std::int64_t b) { return b - a; };
  LaunchPace pace(steps);
  EXPECT_GT(launchesFor(rays, 2e10, pace, all).count, 2);
  EXPECT_EQ(launchesFor(rays, 2e10, pace, all).count, 2);
  EXPECT_EQ(launchesFor(rays, 2e10, pace, all).count, 1);
}

TEST(LaunchPace, HasAtLeastOneRay)
{
  EXPECT_EQ(LaunchPace(1e12).rays(), 1);
  LaunchPace pace(steps);
  pace.add(100, 1, 10);
  EXPECT_EQ(pace.rays(), 1);
  pace.add(1, 0, 10);
  EXPECT_EQ(pace.rays(), 1);
  pace.add(1, 1, 1e-9);
  EXPECT_EQ(pace.rays(), 2);
}

} // namespace

} // namespace schlieren
