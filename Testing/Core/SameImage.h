// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <gtest/gtest.h>

namespace schlieren
{

/// To the last bit, with all that is counted.
inline void expectSameImage(const Image& a, const Image& b)
{
  ASSERT_EQ(a.intensity.size(), b.intensity.size());
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.color.size(), b.color.size());
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.background.size(), b.background.size());
  EXPECT_EQ(a.background, b.background);
  EXPECT_EQ(a.backgroundDisplacement, b.backgroundDisplacement);
  EXPECT_EQ(a.deflection, b.deflection);
  EXPECT_EQ(a.opticalPathDifference, b.opticalPathDifference);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.blockedFraction, b.blockedFraction);
  EXPECT_EQ(a.kScale, b.kScale);
  EXPECT_EQ(a.undisturbedLevel, b.undisturbedLevel);
  EXPECT_EQ(a.saturatedFraction, b.saturatedFraction);
  EXPECT_EQ(a.light.emitted, b.light.emitted);
  EXPECT_EQ(a.light.onFilm, b.light.onFilm);
  EXPECT_EQ(a.light.outside, b.light.outside);
  EXPECT_EQ(a.histogram.range, b.histogram.range);
  EXPECT_EQ(a.histogram.rays, b.histogram.rays);
  EXPECT_EQ(a.raysTraced, b.raysTraced);
  EXPECT_EQ(a.stepsTaken, b.stepsTaken);
  EXPECT_EQ(a.raysBlocked, b.raysBlocked);
  EXPECT_EQ(a.momentumDrift, b.momentumDrift);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.samplesAtEdges, b.samplesAtEdges);
}

} // namespace schlieren
