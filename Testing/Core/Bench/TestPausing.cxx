// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// An image that is made in pieces is the one made in one go, to the last bit.
#include "Fields.h"
#include "SameImage.h"

#include <algorithm>
#include <limits>

namespace schlieren
{

namespace
{

using Flow = BlobWithHole;

Scene smallScene()
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = 40;
  scene.view.height = 30;
  scene.view.viewDirection = { -0.2, 0.4, -1 };
  scene.histogramSize = 16;
  scene.samplesPerPixel = 3;
  return scene;
}

/// Stops after so many questions in each call; 0: at the first.
Monitor pausingAfter(int questions)
{
  Monitor monitor;
  monitor.paused = [left = questions]() mutable { return --left < 0; };
  return monitor;
}

/// Goes on to the end with pauses after so many questions.
Image finished(Bench& bench, Image image, int questions)
{
  int calls = 0;
  while (!image.finished)
  {
    EXPECT_TRUE(bench.isUnfinished());
    const int samples = image.samples;
    image = bench.resume(pausingAfter(questions));
    EXPECT_GE(image.samples, samples);
    EXPECT_EQ(image.intensity.empty(), image.samples == samples);
    constexpr int more = 10000;
    if (++calls > more)
    {
      ADD_FAILURE() << "no end";
      break;
    }
  }
  EXPECT_FALSE(bench.isUnfinished());
  return image;
}

Image inPieces(const Field& field, const Scene& scene, int questions)
{
  Bench bench;
  return finished(bench, bench.render(field, scene, pausingAfter(questions)), questions);
}

/// Pauses at every question, and at some; with one thread and with some.
void expectSameInPieces(const Field& field, Scene scene)
{
  const Image whole = Bench().render(field, scene);
  EXPECT_TRUE(whole.finished);
  EXPECT_EQ(whole.samples, scene.samplesPerPixel);
  for (const int threads : { 1, 3 })
  {
    scene.threads = threads;
    for (const int questions : { 0, 1, 7 })
    {
      SCOPED_TRACE(testing::Message() << threads << " threads, " << questions << " questions");
      expectSameImage(inPieces(field, scene, questions), whole);
    }
  }
}

constexpr Cutoff allCutoffs[] = { Cutoff::KnifeEdge, Cutoff::Shadowgraph, Cutoff::Circular,
  Cutoff::CircularComplement, Cutoff::GradedFilter, Cutoff::ColorFilter, Cutoff::Interferogram,
  Cutoff::Background, Cutoff::NumericalSchlieren, Cutoff::PhaseContrast };

TEST(Pausing, ChangesNoBitBehindAnyCutoff)
{
  const Flow flow;
  for (const Cutoff cutoff : allCutoffs)
  {
    for (const FilmEstimator estimator : { FilmEstimator::Sheet, FilmEstimator::Photon })
    {
      SCOPED_TRACE(static_cast<int>(cutoff));
      Scene scene = smallScene();
      scene.cutoff = cutoff;
      scene.filmEstimator = estimator;
      expectSameInPieces(flow.field, scene);
    }
  }
}

TEST(Pausing, ChangesNoBitWithAnyNoiseFilter)
{
  const Flow flow;
  for (const NoiseFilter filter : { NoiseFilter::Gaussian, NoiseFilter::Mean, NoiseFilter::Cone })
  {
    for (const Cutoff cutoff : { Cutoff::ColorFilter, Cutoff::Background })
    {
      SCOPED_TRACE(static_cast<int>(filter));
      Scene scene = smallScene();
      scene.noiseFilter = filter;
      scene.cutoff = cutoff;
      scene.filmEstimator = FilmEstimator::Photon;
      expectSameInPieces(flow.field, scene);
    }
  }
}

TEST(Pausing, ChangesNoBitOfTintedAndWhiteLight)
{
  const Flow flow;
  Scene scene = smallScene();
  scene.fieldColors = { { 1, 0, 0 }, { 0, 0.5f, 1 } };
  expectSameInPieces(flow.tinted(), scene);
  scene = smallScene();
  scene.cutoff = Cutoff::Interferogram;
  scene.fringes.whiteLight = true;
  expectSameInPieces(flow.field, scene);
}

TEST(Pausing, ChangesNoBitOfAnyRays)
{
  const Flow flow;
  Scene scene = smallScene();
  scene.precision = Precision::Double;
  scene.integrator = Integrator::Adaptive;
  scene.pathModel = PathModel::Refracted;
  expectSameInPieces(flow.field, scene);
  scene = smallScene();
  scene.homogeneityTolerance = 1e-3;
  scene.pathModel = PathModel::Straight;
  expectSameInPieces(flow.field, scene);
  scene = smallScene();
  scene.source.distance = 20;
  scene.source.shape = SourceShape::Slit;
  scene.source.width = 0.01;
  scene.source.length = 0.02;
  expectSameInPieces(flow.field, scene);
}

TEST(Pausing, ChangesNoBitWhereRaysAreNotCached)
{
  const Flow flow;
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Background })
  {
    Scene scene = smallScene();
    scene.cutoff = cutoff;
    scene.memoryBudget = 0;
    expectSameInPieces(flow.field, scene);
    scene.memoryBudget = 46 * 36 * sizeof(double) * 6; // of one pass or two
    scene.samplesPerPixel = 5;
    expectSameInPieces(flow.field, scene);
  }
}

TEST(Pausing, NoPauseFinishesWhatWasBegun)
{
  const Flow flow;
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Background })
  {
    Scene scene = smallScene();
    scene.cutoff = cutoff;
    scene.samplesPerPixel = 4;
    const Image whole = Bench().render(flow.field, scene);
    for (int calls = 1; calls < 40; ++calls)
    {
      Bench bench;
      Image image = bench.render(flow.field, scene, pausingAfter(0));
      for (int call = 1; call < calls && !image.finished; ++call)
      {
        image = bench.resume(pausingAfter(0));
      }
      if (!image.finished)
      {
        image = bench.resume();
      }
      expectSameImage(image, whole);
      EXPECT_FALSE(bench.isUnfinished());
    }
  }
}

// Each shows all samples so far, as if no more had been requested.
TEST(Pausing, ShowsTheImageOfTheSamplesSoFar)
{
  const Flow flow;
  for (const Cutoff cutoff : { Cutoff::ColorFilter, Cutoff::Background })
  {
    for (const int questions : { 0, 12 })
    {
      Scene scene = smallScene();
      scene.cutoff = cutoff;
      scene.samplesPerPixel = 4;
      scene.noiseFilter = NoiseFilter::Cone;
      scene.threads = 1;
      Bench bench;
      std::vector<int> shown;
      Image image = bench.render(flow.field, scene, pausingAfter(questions));
      for (; !image.finished; image = bench.resume(pausingAfter(questions)))
      {
        if (!image.intensity.empty())
        {
          shown.push_back(image.samples);
          Scene fewer = scene;
          fewer.samplesPerPixel = image.samples;
          expectSameImage(image, Bench().render(flow.field, fewer));
        }
      }
      if (questions == 0) // a pass takes longer than a call
      {
        EXPECT_EQ(shown, std::vector<int>({ 1, 2, 3 }));
      }
      EXPECT_GE(shown.size(), 2u);
    }
  }
}

// Where all rays are cached, passes may come faster than calls end; none is hidden for ever.
TEST(Pausing, CachedRaysAreShownToo)
{
  const Flow flow;
  Scene scene = smallScene();
  scene.samplesPerPixel = 6;
  scene.threads = 1;
  for (const int questions : { 0, 1, 2, 3, 5 })
  {
    Bench bench;
    bench.render(flow.field, scene);
    scene.cutoff = Cutoff::Shadowgraph;
    const std::int64_t rays = bench.work().raysTraced;
    Image image = bench.render(flow.field, scene, pausingAfter(questions));
    int silent = 0;
    for (; !image.finished; image = bench.resume(pausingAfter(questions)))
    {
      silent = image.intensity.empty() ? silent + 1 : 0;
      EXPECT_LE(silent, 4);
    }
    EXPECT_EQ(bench.work().raysTraced, rays);
    EXPECT_EQ(image.traceSeconds, 0);
    expectSameImage(image, Bench().render(flow.field, scene));
  }
}

TEST(Pausing, AnotherCutoffInTheMidstKeepsTheRays)
{
  const Flow flow;
  for (int calls = 1; calls < 30; calls += 3)
  {
    Bench bench;
    Scene scene = smallScene();
    scene.threads = 1;
    bench.render(flow.field, scene, pausingAfter(0));
    for (int call = 1; call < calls && bench.isUnfinished(); ++call)
    {
      bench.resume(pausingAfter(0));
    }
    scene.cutoff = Cutoff::Circular;
    const Image image = finished(bench, bench.render(flow.field, scene, pausingAfter(0)), 0);
    Bench fresh;
    expectSameImage(image, fresh.render(flow.field, scene));
    EXPECT_EQ(bench.work().raysTraced, fresh.work().raysTraced); // none was traced twice
  }
}

TEST(Pausing, AnotherViewOrMediumInTheMidstGivesTheImageUp)
{
  Flow flow;
  Bench bench;
  Scene scene = smallScene();
  bench.render(flow.field, scene, pausingAfter(5));
  scene.view.viewDirection = { 1, 0, 0 };
  expectSameImage(bench.render(flow.field, scene), Bench().render(flow.field, scene));
  EXPECT_EQ(bench.work().mediumBuilds, 1);
  EXPECT_EQ(bench.work().raySets, 2);

  scene.view.width = 50;
  bench.render(flow.field, scene, pausingAfter(5));
  flow.samples[100] = 1e-4f;
  ++flow.field.version;
  expectSameImage(finished(bench, bench.render(flow.field, scene, pausingAfter(0)), 0),
    Bench().render(flow.field, scene));

  bench.render(flow.field, scene, pausingAfter(5));
  scene.precision = Precision::Double;
  expectSameImage(finished(bench, bench.render(flow.field, scene, pausingAfter(0)), 0),
    Bench().render(flow.field, scene));

  // A pass that is half traced without gathering what tints.
  scene = smallScene();
  bench.render(flow.field, scene, pausingAfter(2));
  scene.fieldColors = { { 1, 0, 0 }, { 0, 0.5f, 1 } };
  const Field tinted = flow.tinted();
  expectSameImage(finished(bench, bench.render(tinted, scene, pausingAfter(0)), 0),
    Bench().render(tinted, scene));
}

TEST(Pausing, AbortAndErrorsLeaveNothingUnfinished)
{
  const Flow flow;
  Bench bench;
  Scene scene = smallScene();
  scene.threads = 1;
  EXPECT_FALSE(bench.isUnfinished());
  EXPECT_THROW(bench.resume(), Error);
  for (const int questions : { 1, 8, 14 }) // while rays are traced, and exposed
  {
    ++scene.seed;
    Image image = bench.render(flow.field, scene, pausingAfter(questions));
    ASSERT_TRUE(bench.isUnfinished());
    Monitor monitor = pausingAfter(1);
    monitor.aborted = [] { return true; };
    image = bench.resume(monitor);
    EXPECT_TRUE(image.aborted);
    EXPECT_TRUE(image.intensity.empty());
    EXPECT_FALSE(bench.isUnfinished());
    expectSameImage(bench.render(flow.field, scene), Bench().render(flow.field, scene));
  }
  Scene wrong = scene;
  wrong.stepSize = -1;
  Scene other = scene;
  other.seed = 5;
  EXPECT_FALSE(bench.render(flow.field, other, pausingAfter(1)).finished);
  EXPECT_THROW(bench.render(flow.field, wrong), Error);
  EXPECT_FALSE(bench.isUnfinished());
}

// Not one call is in vain.
TEST(Pausing, EveryCallMakesProgress)
{
  const Flow flow;
  Bench bench;
  Scene scene = smallScene();
  scene.threads = 1;
  std::int64_t rays = 0;
  Image image = bench.render(flow.field, scene, pausingAfter(0));
  int withoutRays = 0;
  for (; !image.finished; image = bench.resume(pausingAfter(0)))
  {
    withoutRays += bench.work().raysTraced == rays ? 1 : 0;
    rays = bench.work().raysTraced;
  }
  EXPECT_LE(withoutRays, 3 * 8); // pieces of exposing and rays beside the grid
}

} // namespace

} // namespace schlieren
