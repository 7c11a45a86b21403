// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Homogeneous cubes are crossed in one step: on real data, what that changes is within its bound.
#include "Jet.h"
#include "Schlieren.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

TEST(Skipping, JetChangesByNoMoreThanTheBound)
{
  const Jet jet;
  ASSERT_NE(jet.field.singles, nullptr);

  schlieren::Bench bench;
  schlieren::Scene scene;
  scene.device = schlieren::Device::Cpu;
  scene.samplesPerPixel = 1;
  scene.view.width = 128;
  scene.view.height = 72;
  for (const auto& viewDirection :
    { schlieren::Vector{ 0, 0, -1 }, schlieren::Vector{ -0.5, -0.3, -1 } })
  {
    scene.view.viewDirection = viewDirection;
    scene.homogeneityTolerance = 0;
    const schlieren::Image full = bench.render(jet.field, scene);
    double lastBound = 0;
    std::int64_t lastSteps = full.stepsTaken;
    for (const double tolerance : { 1e-5, 1e-4, 1e-3, 1e-2 })
    {
      SCOPED_TRACE(tolerance);
      scene.homogeneityTolerance = tolerance;
      const schlieren::Image skipped = bench.render(jet.field, scene);
      double changed = 0;
      for (std::size_t i = 0; i < full.deflection.size(); ++i)
      {
        changed = std::max<double>(changed, std::abs(full.deflection[i] - skipped.deflection[i]));
      }
      EXPECT_LE(changed, skipped.skippingBound);
      EXPECT_GT(skipped.skippingBound, lastBound);
      EXPECT_LE(skipped.stepsTaken, lastSteps);
      lastBound = skipped.skippingBound;
      lastSteps = skipped.stepsTaken;
    }
    EXPECT_LT(lastSteps, full.stepsTaken * 9 / 10);
  }
}

} // namespace
