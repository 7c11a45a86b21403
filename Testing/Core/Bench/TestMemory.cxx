// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the medium, its homogeneity map and images take while they are made, in bytes, against the samples
// that they are made from.
#include "Device/Parallel.h"
#include "Fields.h"
#include "Medium/Medium.h"
#include "PeakMemory.h"

#include <algorithm>
#include <atomic>

namespace schlieren
{

namespace
{

constexpr double maxPerVolume = 1.365;

enum class Body
{
  None,
  Ball,
  Foam,       ///< every other point
  AllButABall ///< the ambient value cannot be found on the faces
};

bool isSolidAt(Body body, double x, double y, double z)
{
  const bool isInBall = x * x + y * y + z * z < 0.5;
  switch (body)
  {
    case Body::None:
      return false;
    case Body::Ball:
      return isInBall;
    case Body::Foam:
      return std::sin(1e5 * x + 2e5 * y + 3e5 * z) > 0;
    case Body::AllButABall:
      return !isInBall;
  }
  return false;
}

double peakOf(const Field& field, Interpolation interpolation, int threads)
{
  const PeakMemory peak;
  const Medium<float> medium = buildMedium<float>(field, interpolation, threads);
  return static_cast<double>(peak.bytes());
}

TEST(Memory, OfTheMediumIsThatOfTheSamplesAndAThird)
{
  for (const std::int64_t n : { 64, 101 })
  {
    SampledField<float> field(
      cube(n, 1), [](double x, double y, double z) { return 1e-4 * (x * y + z); });
    const double volume = 4 * static_cast<double>(field.samples.size());
    for (const Body body : { Body::None, Body::Ball, Body::Foam, Body::AllButABall })
    {
      const std::vector<float> solid = SampledField<float>(cube(n, 1),
        [body](double x, double y, double z) {
          return isSolidAt(body, x, y, z);
        }).samples;
      std::vector<unsigned char> valid;
      std::transform(solid.begin(), solid.end(), std::back_inserter(valid),
        [](float isSolid) { return static_cast<unsigned char>(isSolid > 0 ? 0 : 1); });
      field.field.valid = valid.data();
      for (const Interpolation interpolation : allInterpolations)
      {
        SCOPED_TRACE(testing::PrintToString(static_cast<int>(body)));
        const double peak = peakOf(field.field, interpolation, 2);
        EXPECT_GT(peak, volume); // or else nothing was counted
        EXPECT_LE(peak, maxPerVolume * volume);
      }
    }
  }
}

/// All of it: medium, rays, film and the image that is handed out.
TEST(Memory, OfAImageIsThatOfTheSamplesAndAThird)
{
  const SampledField<float> field(
    cube(256, 1), [](double x, double y, double z) { return 1e-4 * (x * y + z); });
  const double volume = 4 * static_cast<double>(field.samples.size());
  Scene scene;
  scene.device = Device::Cpu;
  scene.threads = 2;
  scene.samplesPerPixel = 1;
  scene.stepSize = 16;
  const PeakMemory peak;
  Bench bench;
  bench.render(field.field, scene);
  scene.knifeEdgeAngle = 90;
  bench.render(field.field, scene);
  scene.view.viewDirection = { 1, 2, -3 };
  bench.render(field.field, scene);
  ++scene.view.height; // more rays than before
  bench.render(field.field, scene);
  EXPECT_GT(static_cast<double>(peak.bytes()), volume);
  EXPECT_LE(static_cast<double>(peak.bytes()), maxPerVolume * volume);
}

TEST(Memory, ThatThreadsLackLeavesTheWorkToTheOthers)
{
  int failures = 0;
  for (int number = 0; number < 20; ++number)
  {
    constexpr std::int64_t count = 1000;
    std::atomic<std::int64_t> sum{ 0 };
    const FailingAllocation failing(number);
    EXPECT_TRUE(parallelFor(
      count, 10, 6, [&sum](std::int64_t begin, std::int64_t end) { sum += end - begin; }));
    EXPECT_EQ(sum, count) << number;
    failures += failing.hasFailed() ? 1 : 0;
  }
  EXPECT_GT(failures, 5);
}

} // namespace

} // namespace schlieren
