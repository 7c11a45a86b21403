// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Stages keep their results; images do not depend on how they came about.
#include "AnalyticSources.h"
#include "Fields.h"
#include "SameImage.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

namespace schlieren
{

namespace
{

Scene smallScene() { return sceneOnCpu(40, 30); }

/// The medium is as fine as k shows; a k that differs little needs nothing new.
TEST(Stages, SensitivityNeedsFinerVoxels)
{
  const Field field = fieldOf(
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0, 0, 0 }, 0.4, 1e-4 } }, 1., 0.01));
  Bench bench;
  Scene scene = sceneOnCpu(160, 120);
  const Image automatic = bench.render(field, scene);
  const std::int64_t rays = bench.work().raysTraced;
  scene.kScale = automatic.kScale;
  EXPECT_EQ(bench.render(field, scene).medium.voxels, automatic.medium.voxels);
  EXPECT_EQ(bench.work().raysTraced, rays);
  scene.kScale = 30 * automatic.kScale;
  const std::int64_t voxels = bench.render(field, scene).medium.voxels;
  EXPECT_GT(voxels, automatic.medium.voxels);
  const std::int64_t again = bench.work().raysTraced;
  EXPECT_GT(again, rays);
  scene.kScale = automatic.kScale;
  EXPECT_EQ(bench.render(field, scene).medium.voxels, voxels);
  EXPECT_EQ(bench.work().raysTraced, again);
}

TEST(Stages, EverythingThatMattersTracesAgain)
{
  SampledField<float> blob = blobField();
  Bench bench;
  Scene scene = smallScene();
  Image image = bench.render(blob.field, scene);
  const auto expectFresh = [&](const char* what)
  {
    SCOPED_TRACE(what);
    const std::int64_t rays = bench.work().raysTraced;
    image = bench.render(blob.field, scene);
    EXPECT_GT(bench.work().raysTraced, rays);
    expectSameImage(image, Bench().render(blob.field, scene));
  };
  scene.stepSize = 0.5;
  expectFresh("step");
  scene.seed = 2;
  expectFresh("seed");
  scene.view.width = 41;
  expectFresh("size");
  scene.view.parallelScale = 0.8;
  expectFresh("zoom");
  scene.precision = Precision::Double;
  expectFresh("precision");
  scene.interpolation = Interpolation::Cubic;
  expectFresh("interpolation");
  blob.field.lengthScale = 0.001;
  expectFresh("length scale");
}

TEST(Stages, MoreSamplesContinueTheSequence)
{
  const SampledField<float> blob = blobField();
  Bench bench;
  Scene scene = smallScene();
  scene.samplesPerPixel = 3;
  bench.render(blob.field, scene);
  const std::int64_t rays = bench.work().raysTraced;
  scene.samplesPerPixel = 9;
  const Image grown = bench.render(blob.field, scene);
  Bench fresh;
  expectSameImage(grown, fresh.render(blob.field, scene));
  EXPECT_EQ(bench.work().raysTraced, fresh.work().raysTraced);
  EXPECT_GT(bench.work().raysTraced, 2 * rays);
  // Going back shows the first image again and needs no re-tracing.
  const std::int64_t all = bench.work().raysTraced;
  scene.samplesPerPixel = 3;
  const Image back = bench.render(blob.field, scene);
  EXPECT_EQ(bench.work().raysTraced, all);
  expectSameImage(back, Bench().render(blob.field, scene));
}

TEST(Stages, ThreadsDoNotChangeABit)
{
  SampledField<float> blob = blobField();
  blob.samples[5000] = std::numeric_limits<float>::quiet_NaN();
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph })
  {
    Scene scene = smallScene();
    scene.cutoff = cutoff;
    scene.view.viewDirection = { -0.2, 0.4, -1 };
    scene.threads = 1;
    const Image one = Bench().render(blob.field, scene);
    for (const int threads : { 2, 7 })
    {
      SCOPED_TRACE(threads);
      scene.threads = threads;
      expectSameImage(one, Bench().render(blob.field, scene));
    }
  }
}

TEST(Stages, AbortLeavesNothingBroken)
{
  const SampledField<float> blob = blobField();
  Bench bench;
  const Scene scene = smallScene();
  int calls = 0;
  Monitor monitor;
  monitor.aborted = [&] { return ++calls > 3; };
  const Image aborted = bench.render(blob.field, scene, monitor);
  EXPECT_TRUE(aborted.aborted);
  EXPECT_TRUE(aborted.intensity.empty());
  const Image image = bench.render(blob.field, scene);
  EXPECT_FALSE(image.aborted);
  expectSameImage(image, Bench().render(blob.field, scene));
}

TEST(Stages, ProgressGrowsToOne)
{
  const SampledField<float> blob = blobField();
  Scene scene = smallScene();
  scene.threads = 2;
  std::vector<double> steps;
  Monitor monitor;
  monitor.progress = [&](double fraction) { steps.push_back(fraction); };
  Bench().render(blob.field, scene, monitor);
  ASSERT_GT(steps.size(), 4u);
  EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
  EXPECT_GT(steps.front(), 0);
  EXPECT_LE(steps.back(), 1);
}

// The first image that is shown is no end of it, nor is the search for settings.
TEST(Stages, ProgressTowardsATargetErrorGrowsToOne)
{
  const SampledField<float> blob = blobField();
  Scene scene = smallScene();
  scene.targetError = 1e-4; // which takes more than the first rays
  for (const bool pauses : { false, true })
  {
    SCOPED_TRACE(pauses);
    std::vector<double> steps;
    Monitor monitor;
    monitor.progress = [&](double fraction) { steps.push_back(fraction); };
    if (pauses)
    {
      monitor.paused = [] { return true; };
    }
    Bench bench;
    Image image = bench.render(blob.field, scene, monitor);
    while (image.intensity.empty())
    {
      image = bench.resume(monitor);
    }
    ASSERT_FALSE(steps.empty());
    EXPECT_EQ(steps.back() <= 0.3, pauses) << steps.back();
    while (!image.finished)
    {
      image = bench.resume(monitor);
    }
    EXPECT_GT(image.accuracy.target, 0);
    EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
    EXPECT_GT(steps.back(), 0.9);
    EXPECT_LE(steps.back(), 1);
  }
}

} // namespace

} // namespace schlieren
