// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What tests of rays through trees share.
#pragma once

#include "Fields.h"
#include "Medium/Medium.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/March/MakeTask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace schlieren
{

inline Vec3<double> vec(const Vector& a) { return { a[0], a[1], a[2] }; }

/// A view of what is in the middle, of one ray per pixel.
inline Scene shadowgraphOf(const Vector& direction, Device device = Device::Cpu)
{
  Scene scene = sceneOnCpu(160, 120, direction);
  scene.view.viewUp = { 0.1, 1, 0.2 };
  scene.view.parallelScale = 0.7;
  scene.samplesPerPixel = 1;
  scene.cutoff = Cutoff::Shadowgraph;
  scene.screenDistance = 0;
  scene.device = device;
  return scene;
}

/// The area of the shadow, and how many pixels from the circle the farthest pixel is that is wrong.
struct Shadow
{
  double area = 0, worst = 0;
};
inline Shadow shadowOfDisc(const Image& image, double radius)
{
  Shadow shadow;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const PixelCentre at = centreOf(image, column, row);
      const double blocked = image.blockedFraction[pixelOf(image, column, row)];
      shadow.area += blocked;
      const double outside = (std::hypot(at.u, at.v) - radius) / image.frame.pixelSize;
      const bool isWrong = (blocked > 0.5) != (outside < 0);
      shadow.worst = isWrong ? std::max(shadow.worst, std::abs(outside)) : shadow.worst;
    }
  }
  shadow.area *= image.frame.pixelSize * image.frame.pixelSize;
  return shadow;
}

/// Rays side by side, beside one at a time: for all schemes and integrators. Refractivities of `field` are 1e-3, about.
inline void expectPacksToDoWhatOneDoes(const Field& field)
{
  std::vector<Simd> all = { Simd::None, Simd::Four, Simd::Avx2, Simd::Avx512 };
  all.erase(
    std::remove_if(all.begin(), all.end(), [](Simd simd) { return !hasSimd(simd); }), all.end());
  for (const Interpolation interpolation : allInterpolations)
  {
    TreeSettings settings;
    settings.interpolation = interpolation;
    Medium<float> medium = buildTree<float>(field, settings);
    View view;
    view.viewDirection = { 0.3, -0.5, -0.8 };
    view.width = 37;
    view.height = 29;
    const Light light = collimatedLight(field.grid, frameOf(field.grid, view));
    refine(medium, { light.u, light.v, { 0, 0 }, { 2, 2 }, 0.01 }, {});
    for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
    {
      SCOPED_TRACE(std::string(name(interpolation)) + " integrator " +
        std::to_string(static_cast<int>(integrator)));
      // Others look at leaves' sides, where rounding decides which leaf it is, or choose their steps.
      const double allowed = integrator == Integrator::Leapfrog ? 2e-9 : 3e-5;
      RaySettings rays;
      rays.kernel = { PathModel::Refracted, integrator, interpolation };
      const RayTask<float> task = makeTask<float>(medium, light, rays);
      const Pass pass{ 0, 0, 37, 29, { 0.25, -0.125 } };
      std::vector<TracedPass> traced(all.size());
      double largest = 0;
      for (std::size_t n = 0; n < all.size(); ++n)
      {
        traced[n].resize(pass);
        ASSERT_TRUE(traceOnCpu(task, pass, traced[n], 2, {}, all[n]));
        for (std::size_t i = 0; i < traced[n].exits.size(); ++i)
        {
          const RayExit& one = traced[0].exits[i];
          const RayExit& other = traced[n].exits[i];
          largest = std::max(largest, std::abs(one.deflection[0]));
          EXPECT_EQ(one.fate, other.fate);
          EXPECT_NEAR(one.deflection[0], other.deflection[0], allowed);
          EXPECT_NEAR(one.deflection[1], other.deflection[1], allowed);
          EXPECT_NEAR(one.opticalPathDifference, other.opticalPathDifference, allowed);
          EXPECT_NEAR(one.displacement[0], other.displacement[0], 4 * allowed);
          EXPECT_NEAR(one.displacement[1], other.displacement[1], 4 * allowed);
        }
      }
      EXPECT_GT(largest, 1e-3);
      for (const TracedPass& pack : traced)
      {
        EXPECT_LT(pack.worstDrift, 2 * traced[0].worstDrift + 1e-6);
      }
    }
  }
}

} // namespace schlieren
