// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rays on a device that has memory for a part of the medium, beside those on one that has all of it.
#include "Rays/CudaTracer.h"
#include "RaysInTree.h"

#include <algorithm>
#include <vector>

namespace schlieren
{

namespace
{

using HostAndDeviceParts = WithCuda;

template <class Real>
using Exits = typename CudaTracer<Real>::Exits;

template <class Real>
std::size_t bytesOf(const Medium<Real>& medium)
{
  return medium.tree->samples().size() * sizeof(Real) +
    medium.tree->gasDistances().size() * sizeof(std::int16_t) +
    medium.tree->leaves().size() * sizeof(Leaf<Real>);
}

template <class Real>
TracedPass traced(CudaTracer<Real>& tracer, const Traced<Real>& rays)
{
  TracedPass found;
  EXPECT_TRUE(tracer.trace(rays.task, rays.pass, { 1, 1 }, Exits<Real>::OnHost, found, Monitor{}));
  return found;
}

/// With a third of the memory. Of the largest deflection.
template <class Real>
void expectSame(const Setting& setting, double tolerance = 1e-6)
{
  const Traced<Real> rays(setting);
  CudaTracer<Real> whole(rays.medium), inParts(rays.medium, bytesOf(rays.medium) / 3);
  const TracedPass expected = traced(whole, rays);
  EXPECT_EQ(whole.parts(), 1);
  for (int time = 1; time <= 2; ++time)
  {
    const TracedPass found = traced(inParts, rays);
    EXPECT_GE(inParts.parts(), 3);
    expectCloseRays(found, expected, tolerance, 1); // rounding decides which leaf a side is in
    EXPECT_NEAR(found.worstDrift, expected.worstDrift, 0.01 * expected.worstDrift + 1e-7);
  }
}

TEST_F(HostAndDeviceParts, AgreeWithTheWholeForEveryKernel)
{
  Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  for (const Interpolation interpolation : allInterpolations)
  {
    for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
    {
      SCOPED_TRACE(
        std::string(name(interpolation)) + " path " + std::to_string(static_cast<int>(path)));
      setting.interpolation = interpolation;
      setting.path = path;
      expectSame<float>(setting);
      expectSame<double>(setting);
    }
  }
}

TEST_F(HostAndDeviceParts, AgreeFromOtherSides)
{
  Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-3)) };
  for (const Vector& direction : { Vector{ 0, 0, 1 }, Vector{ -1, 0, 0 }, Vector{ 0.7, 0.5, 0.2 } })
  {
    setting.direction = direction;
    expectSame<float>(setting);
  }
  setting.source = std::make_shared<FlatSource>(
    std::vector<Ball>{ { { -0.1, 0.05, 0 }, 0.25, 1e-3 }, { { 0.42, -0.31, 0 }, 0.05, 5e-4 } });
  expectSame<float>(setting);
}

TEST_F(HostAndDeviceParts, FollowRaysThatComeBack)
{
  // They come near to total reflection, where little makes much.
  expectSame<float>({ std::make_shared<GlassSource>() }, 1e-4);
}

TEST_F(HostAndDeviceParts, EndRaysInWalls)
{
  Setting setting{ std::make_shared<SphereSource>(2) };
  setting.tolerance = 0.5;
  setting.finest = 0.04;
  for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
  {
    setting.path = path;
    const Traced<float> rays(setting);
    EXPECT_GT(rays.count(RayFate::Blocked), 100);
    expectSame<float>(setting);
  }
}

TEST_F(HostAndDeviceParts, MayBeStopped)
{
  const Traced<float> rays({ std::make_shared<BallsSource>(threeBalls(3e-3)) });
  CudaTracer<float> tracer(rays.medium, bytesOf(rays.medium) / 3);
  TracedPass stopped;
  std::vector<double> progress;
  EXPECT_FALSE(tracer.trace(
    rays.task, rays.pass, { 1, 1 }, Exits<float>::OnDevice, stopped, { {}, [&] { return true; } }));
  EXPECT_TRUE(tracer.trace(rays.task, rays.pass, { 1, 1 }, Exits<float>::OnDevice, stopped,
    { [&](double fraction) { progress.push_back(fraction); }, {} }));
  ASSERT_TRUE(stopped.onDevice);
  const TracedPass expected = traced(tracer, rays);
  TracedPass found;
  found.exits = stopped.onDevice->toHost();
  found.crossed = stopped.crossed;
  expectCloseRays(found, expected, 0);
  EXPECT_GE(progress.size(), 3u);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_EQ(progress.back(), 1);
}

// Integrators that look at several places in a step, and fields to gather, need all leaves at once.
TEST_F(HostAndDeviceParts, AreNotForEveryTask)
{
  Traced<float> rays({ std::make_shared<BallsSource>(threeBalls(3e-3)) });
  rays.task.kernel.integrator = Integrator::Rk4;
  CudaTracer<float> whole(rays.medium), small(rays.medium, bytesOf(rays.medium) / 3);
  expectCloseRays(traced(small, rays), traced(whole, rays), 0);
  EXPECT_EQ(small.parts(), 1);
}

} // namespace

} // namespace schlieren
