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
  Scene scene = sceneOnCpu(40, 30, { -0.2, 0.4, -1 });
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
    EXPECT_EQ(image.intensity.empty(), !image.finished && image.samples == samples);
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

// Of each stage that pauses: rays, one film or two, and rays that are traced again for each image.
TEST(Pausing, ChangesNoBitOfAnyStage)
{
  const Flow flow;
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::ColorFilter, Cutoff::Background })
  {
    SCOPED_TRACE(static_cast<int>(cutoff));
    Scene scene = smallScene();
    scene.cutoff = cutoff;
    expectSameInPieces(flow.field, scene);
    scene.memoryBudget = 46 * 36 * sizeof(double) * 6; // of one pass or two
    expectSameInPieces(flow.field, scene);
  }
  Scene scene = smallScene();
  scene.samplesAtEdges = 16;
  expectSameInPieces(flow.field, scene);
}

// With all that their rays carry, and the first one as if no more had been requested.
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
      scene.smoothingRadius = 2;
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
          const Image alone = Bench().render(flow.field, fewer);
          if (image.samples == 1 && cutoff != Cutoff::Background)
          {
            expectSameImage(image, alone);
          }
          EXPECT_EQ(image.raysTraced, alone.raysTraced);
          EXPECT_EQ(image.deflection, alone.deflection);
          EXPECT_EQ(image.blockedFraction, alone.blockedFraction);
          // Light of a ray in all of a pixel instead of its share.
          constexpr double blur = 0.1;
          for (std::size_t pixel = 0; pixel < image.intensity.size(); ++pixel)
          {
            ASSERT_NEAR(image.intensity[pixel], alone.intensity[pixel], blur);
          }
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

} // namespace

} // namespace schlieren
