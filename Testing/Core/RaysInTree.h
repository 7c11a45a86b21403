// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays through a tree, for tests of those that have it in parts.
#pragma once

#include "AnalyticSources.h"
#include "Fields.h"
#include "Medium/Medium.h"
#include "Rays/Tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// A ball of glass, which turns rays around or sends them back into leaves that they have been in.
class GlassSource : public BallsSource
{
public:
  GlassSource()
    : BallsSource({ { { 0.05, -0.02, 0.03 }, 0.2, 2.5 } }, 1, 0.1)
  {
  }
};

/// The middle of balls, at all depths.
class FlatSource : public BallsSource
{
public:
  using BallsSource::BallsSource;
  bool isFlat() const override { return true; }
  double refractivity(double x, double y, double) const override
  {
    return BallsSource::refractivity(x, y, 0);
  }
  Range rangeOver(const Box& box) const override { return BallsSource::rangeOver(middleOf(box)); }
  double cellSizeOver(const Box& box) const override
  {
    return BallsSource::cellSizeOver(middleOf(box));
  }

private:
  static Box middleOf(Box box)
  {
    box.low[2] = box.high[2] = 0;
    return box;
  }
};

struct Setting
{
  std::shared_ptr<const MediumSource> source;
  Vector direction{ 0.3, -0.5, -0.8 };
  PathModel path = PathModel::Refracted;
  Integrator integrator = Integrator::Leapfrog;
  Interpolation interpolation = Interpolation::Quadratic;
  double tolerance = 0.01;
  double finest = 0.005; ///< voxels that the view needs
  std::size_t memory = std::size_t{ 1 } << 30;
};

template <class Real>
struct Traced
{
  explicit Traced(const Setting& setting, const std::shared_ptr<BrickOwners>& owners = nullptr)
    : field(fieldOf(setting.source))
    , medium(buildTree<Real>(field, settingsOf(setting, owners)))
  {
    View view;
    view.viewDirection = setting.direction;
    view.width = static_cast<int>(width);
    view.height = static_cast<int>(height);
    const Light light = collimatedLight(field.grid, frameOf(field.grid, view));
    refine(medium, { light.u, light.v, { 0, 0 }, { 2, 2 }, setting.finest }, {});
    RaySettings rays;
    rays.kernel = { setting.path, setting.integrator, setting.interpolation };
    task = makeTask<Real>(medium, nullptr, medium.tree->gradients(), light, rays);
  }

  static TreeSettings settingsOf(const Setting& setting, const std::shared_ptr<BrickOwners>& owners)
  {
    TreeSettings settings;
    settings.owners = owners;
    settings.memory = setting.memory;
    settings.tolerance = setting.tolerance;
    settings.interpolation = setting.interpolation;
    return settings;
  }

  Field field;
  Medium<Real> medium;
  RayTask<Real> task{};
  static constexpr std::int64_t width = 53, height = 41; // no multiples of a tile's edge
  const Pass pass{ 0, 0, width, height, { 0.25, -0.125 } };

  void traceAlone(TracedPass& traced, Simd simd = bestSimd()) const
  {
    traced.resize(pass, task.gradients.count);
    EXPECT_TRUE(traceOnCpu(task, pass, traced, 2, {}, simd));
  }

  std::int64_t count(RayFate fate) const
  {
    TracedPass alone;
    traceAlone(alone);
    return std::count_if(alone.exits.begin(), alone.exits.end(),
      [fate](const RayExit& exit) { return exit.fate == fate; });
  }
};

/// To `tolerance` of the largest deflection.
inline void expectCloseRays(
  const TracedPass& a, const TracedPass& b, double tolerance, int stepsApart = 0)
{
  ASSERT_EQ(a.exits.size(), b.exits.size());
  double largest = 0;
  for (const RayExit& exit : b.exits)
  {
    largest = std::max({ largest, std::abs(exit.deflection[0]), std::abs(exit.deflection[1]) });
  }
  for (std::size_t n = 0; n < a.exits.size(); ++n)
  {
    EXPECT_EQ(a.exits[n].fate, b.exits[n].fate) << n;
    EXPECT_NEAR(a.exits[n].steps, b.exits[n].steps, stepsApart) << n;
    for (int axis = 0; axis < 2; ++axis)
    {
      EXPECT_NEAR(a.exits[n].deflection[axis], b.exits[n].deflection[axis], tolerance * largest)
        << n;
    }
  }
  EXPECT_EQ(a.crossed, b.crossed);
}

} // namespace schlieren
