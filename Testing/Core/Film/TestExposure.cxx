// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// From traced rays to images: invented rays, counted one by one.
#include "Film/CentreValues.h"
#include "Film/Exposure.h"
#include "Optics/AutomaticK.h"
#include "Optics/Spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace schlieren
{

namespace
{

constexpr int width = 37, height = 90;
constexpr std::int64_t margin = 3;
constexpr std::int64_t heldMargin = 5; ///< more than the image needs

/// Passes of rays of all fates, which land up to `spread` pixels from where they start.
struct InventedRays
{
  InventedRays(int passes, double spread)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < passes; ++i)
    {
      const Pass pass{ -heldMargin, -heldMargin, width + 2 * heldMargin, height + 2 * heldMargin,
        { 0.4 * any(random), 0.4 * any(random) } };
      std::vector<RayExit> ofPass;
      for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
      {
        const auto fate = static_cast<RayFate>(random() % 5);
        ofPass.push_back({ { 1e-3 * any(random), 1e-3 * any(random) },
          { static_cast<float>(spread * any(random)), static_cast<float>(spread * any(random)) },
          1e-6 * any(random), fate, static_cast<std::int32_t>(random() % 100) });
      }
      exits.push_back(std::move(ofPass));
      rays.push_back({ pass, exits.back().data() });
    }
  }

  std::vector<std::vector<RayExit>> exits;
  std::vector<TracedRays> rays;
};

template <class Use>
void forEachRayOfImage(const TracedRays& rays, std::int64_t around, const Use& use)
{
  for (std::int64_t row = -around; row < height + around; ++row)
  {
    for (std::int64_t column = -around; column < width + around; ++column)
    {
      use(column, row,
        rays.exits[(row + heldMargin) * (width + 2 * heldMargin) + column + heldMargin]);
    }
  }
}

struct Exposed
{
  PixelArray<float> image;
  RayCounts counts;
};

Exposed exposed(const std::vector<TracedRays>& rays, const Cutoffs& cutoff,
  const Projection& projection, int threads)
{
  Films films(channelsOf(cutoff), width, height, 1000000);
  const RayCounts counts = expose(rays, cutoff, projection, margin, threads, films);
  return { films.developIntensity(1, threads), counts };
}

} // namespace

/// Of rays that land near and far from where they start; sums are the same for any number of threads.
TEST(Exposure, CountsAllRaysWithAnyThreads)
{
  for (const double spread : { 0.1, 20., 300. })
  {
    SCOPED_TRACE(spread);
    const InventedRays invented(3, spread);
    const KnifeEdge knife = KnifeEdge::at(30, 400);
    const Projection projection{ -40, 1.25, 1 };
    RayCounts counts;
    for (const TracedRays& rays : invented.rays)
    {
      forEachRayOfImage(rays, margin,
        [&](std::int64_t, std::int64_t, const RayExit& exit)
        {
          counts.crossed += exit.fate == RayFate::Missed ? 0 : 1;
          counts.steps += exit.steps;
          counts.blocked += exit.fate == RayFate::Blocked ? 1 : 0;
          counts.lost += exit.fate == RayFate::Trapped || exit.fate == RayFate::Turned ? 1 : 0;
        });
    }
    const Exposed one = exposed(invented.rays, knife, projection, 1);
    EXPECT_GT(*std::max_element(one.image.begin(), one.image.end()), 0);
    EXPECT_EQ(one.counts.crossed, counts.crossed);
    EXPECT_EQ(one.counts.steps, counts.steps);
    EXPECT_EQ(one.counts.blocked, counts.blocked);
    EXPECT_EQ(one.counts.lost, counts.lost);
    for (const int threads : { 2, 5 })
    {
      EXPECT_EQ(exposed(invented.rays, knife, projection, threads).image, one.image);
    }
  }
}

/// Of a pixel, in one number.
double carriedBy(const RayExit& exit)
{
  return exit.deflection[1] + 1e3 * exit.opticalPathDifference +
    1e-3 * double{ exit.displacement[0] };
}

/// The rays of the first pass, which start in the pixels' centres; where these are dark, the means of the others.
TEST(CentreValues, AreThoseOfTheFirstRayOrElseMeans)
{
  const InventedRays invented(4, 1);
  Image image;
  CentreValues(width, height, 2).develop(invented.rays, image);
  std::vector<double> expected(width * height), rays(width * height), blocked(width * height);
  std::vector<bool> hasCentre(width * height);
  for (const TracedRays& ofPass : invented.rays)
  {
    forEachRayOfImage(ofPass, 0,
      [&](std::int64_t column, std::int64_t row, const RayExit& exit)
      {
        const auto pixel = static_cast<std::size_t>(row * width + column);
        blocked[pixel] += exit.fate == RayFate::Blocked ? 0.25 : 0;
        const bool reaches = exit.fate == RayFate::Left || exit.fate == RayFate::Missed;
        if (reaches && !hasCentre[pixel])
        {
          hasCentre[pixel] = &ofPass == invented.rays.data();
          rays[pixel] += 1;
          expected[pixel] += carriedBy(exit);
        }
      });
  }
  int centres = 0, means = 0;
  for (std::size_t pixel = 0; pixel < expected.size(); ++pixel)
  {
    const double found = double{ image.deflection[2 * pixel + 1] } +
      1e3 * image.opticalPathDifference[pixel] + 1e-3 * double{ image.displacement[2 * pixel] };
    ASSERT_NEAR(found, rays[pixel] > 0 ? expected[pixel] / rays[pixel] : 0, 1e-9);
    ASSERT_EQ(double{ image.blockedFraction[pixel] }, blocked[pixel]);
    centres += hasCentre[pixel] ? 1 : 0;
    means += rays[pixel] > 1 ? 1 : 0;
  }
  EXPECT_GT(centres, 100);
  EXPECT_GT(means, 100);
}

/// Passes that are not cached come one by one.
TEST(CentreValues, DoNotDependOnWhichPassesComeAtOnce)
{
  const InventedRays invented(5, 1);
  Image atOnce, inParts;
  CentreValues(width, height, 1).develop(invented.rays, atOnce);
  CentreValues means(width, height, 3);
  means.add({ invented.rays[0], invented.rays[1] });
  means.add({ invented.rays[2] });
  means.develop({ invented.rays[3], invented.rays[4] }, inParts);
  EXPECT_EQ(atOnce.deflection, inParts.deflection);
  EXPECT_EQ(atOnce.displacement, inParts.displacement);
  EXPECT_EQ(atOnce.opticalPathDifference, inParts.opticalPathDifference);
  EXPECT_EQ(atOnce.blockedFraction, inParts.blockedFraction);
}

/// Against sorting, for values that are all alike, mostly zero, of every size, and few.
TEST(Spread, HoldsTheSortedValues)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  const std::function<double()> makers[] = { [] { return 0.125; },
    [&] { return any(random) < 0.995 ? 0 : any(random); }, [&] { return any(random); },
    [&] { return std::pow(10., 600 * any(random) - 300); },
    [&] { return 1 + 1e-9 * any(random); } };
  InventedRays invented(1, 1);
  for (const auto& make : makers)
  {
    for (const int rays : { width * height, 200, 1 })
    {
      std::vector<double> values(invented.exits[0].size());
      std::vector<double> sorted;
      for (RayExit& exit : invented.exits[0])
      {
        exit.fate = RayFate::Missed;
      }
      forEachRayOfImage(invented.rays[0], heldMargin,
        [&](std::int64_t column, std::int64_t row, const RayExit& exit)
        {
          const std::int64_t ray = &exit - invented.rays[0].exits;
          double& value = values[static_cast<std::size_t>(ray)] = make();
          const bool isInImage = column >= 0 && column < width && row >= 0 && row < height;
          if (!isInImage || static_cast<int>(sorted.size()) < rays)
          {
            invented.exits[0][static_cast<std::size_t>(ray)].fate = RayFate::Left;
          }
          if (!isInImage)
          {
            value = 1e305; // must not count
          }
          else if (static_cast<int>(sorted.size()) < rays)
          {
            sorted.push_back(value);
          }
        });
      std::sort(sorted.begin(), sorted.end());
      for (const int threads : { 1, 3 })
      {
        const Spread spread = spreadOf(invented.rays[0], width, height, threads,
          [&](std::int64_t ray) { return values[static_cast<std::size_t>(ray)]; });
        EXPECT_EQ(spread.rays, rays);
        EXPECT_EQ(spread.largest, sorted.back());
        EXPECT_EQ(spread.percentile,
          sorted[static_cast<std::size_t>(0.99 * static_cast<double>(sorted.size() - 1))]);
      }
    }
  }
}

TEST(Spread, OfNoRaysIsNone)
{
  InventedRays invented(1, 1);
  for (RayExit& exit : invented.exits[0])
  {
    exit.fate = RayFate::Blocked;
  }
  EXPECT_EQ(spreadOf(invented.rays[0], width, height, 2, [](std::int64_t) { return 1.; }).rays, 0);
  EXPECT_EQ(strongDeflection(invented.rays[0], width, height, {}, 2), 0);
}

} // namespace schlieren
