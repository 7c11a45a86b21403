// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose rays are traced by several processes, here threads that know each other by requests alone.
#include "AnalyticSources.h"
#include "Fields.h"
#include "OtherProcesses.h"
#include "SameImage.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

Scene oblique()
{
  Scene scene = sceneOnCpu(150, 90, { -0.2, 0.4, -1 }); // no multiples of a tile's edge
  scene.histogramSize = 16;
  scene.samplesPerPixel = 2;
  scene.threads = 1;
  return scene;
}

void expectSameOf(const Field& field, const Scene& scene)
{
  const Image alone = Bench().render(field, scene);
  for (const int count : { 1, 2, 5 })
  {
    SCOPED_TRACE(count);
    OtherProcesses others(count);
    Bench bench;
    bench.setProcesses(&others);
    const Image together = bench.render(field, scene);
    expectSameImage(together, alone);
    EXPECT_EQ(together.processes, count + 1);
    EXPECT_GT(others.traces, 0);
    if (count != 2)
    {
      continue;
    }
    // With pauses.
    Bench paused;
    paused.setProcesses(&others);
    const Monitor atOnce{ {}, {}, [] { return true; } };
    Image image = paused.render(field, scene, atOnce);
    int calls = 0;
    for (; !image.finished && calls < 10000; ++calls)
    {
      image = paused.resume(atOnce);
    }
    EXPECT_GT(calls, 1);
    expectSameImage(image, alone);
  }
}

TEST(Processes, ChangesNoBitOfAnImage)
{
  const BlobWithHole flow;
  Scene scene = oblique();
  expectSameOf(flow.field, scene);
  scene.precision = Precision::Double;
  expectSameOf(flow.field, scene);
}

TEST(Processes, ChangesNoBitOfATree)
{
  Scene scene = oblique();
  scene.source.distance = 20;
  expectSameOf(fieldOfBalls(), scene);
}

TEST(Processes, SendsTheMediumOnce)
{
  const BlobWithHole flow;
  OtherProcesses others(3);
  Bench bench;
  bench.setProcesses(&others);
  Scene scene = oblique();
  bench.render(flow.field, scene);
  const int traces = others.traces;
  EXPECT_EQ(others.arrays, 2); // samples, solids
  scene.view.viewDirection = { 0.3, 0.1, -1 };
  bench.render(flow.field, scene);
  EXPECT_EQ(others.arrays, 2);
  EXPECT_GT(others.traces, traces);
  scene.interpolation = Interpolation::Cubic; // another medium
  bench.render(flow.field, scene);
  EXPECT_GT(others.arrays, 2);
  bench.setProcesses(nullptr);
  const int tracesOfOthers = others.traces;
  scene.view.viewDirection = { 0, 0.1, -1 };
  EXPECT_EQ(bench.render(flow.field, scene).processes, 1);
  EXPECT_EQ(others.traces, tracesOfOthers);
}

TEST(Processes, SaysWhatGoesWrongInOne)
{
  const BlobWithHole flow;
  OtherProcesses others(2);
  others.failing = 1;
  Bench bench;
  bench.setProcesses(&others);
  EXPECT_THROW(bench.render(flow.field, oblique()), Error);
  others.failing = -1;
  expectSameImage(bench.render(flow.field, oblique()), Bench().render(flow.field, oblique()));
}

TEST(Processes, AbortsAtOnce)
{
  const BlobWithHole flow;
  OtherProcesses others(1);
  Bench bench;
  bench.setProcesses(&others);
  int questions = 0;
  const Monitor aborting{ {}, [&] { return ++questions > 1; }, {} };
  EXPECT_TRUE(bench.render(flow.field, oblique(), aborting).aborted);
  expectSameImage(bench.render(flow.field, oblique()), Bench().render(flow.field, oblique()));
}

// No side has a large medium twice.
TEST(Processes, SendsLargeArraysInPieces)
{
  const SampledField<float> flow(cube(180, 1), // 23 MB
    [](double x, double y, double z)
    { return 3e-4 * std::exp(-(x * x + 2 * y * y + z * z) / 0.1); });
  Scene scene = oblique();
  const Image alone = Bench().render(flow.field, scene);
  OtherProcesses others(1);
  Bench bench;
  bench.setProcesses(&others);
  expectSameImage(bench.render(flow.field, scene), alone);
  EXPECT_EQ(others.arrays, 2);
}

TEST(Processes, RefusesRequestsThatMakeNoSense)
{
  RayWorker worker(1, 2);
  for (const std::size_t bytes : { 4u, 40u, 4000u })
  {
    std::vector<char> request(bytes, 7);
    const std::uint32_t kind = RayWorker::Trace;
    std::memcpy(request.data(), &kind, sizeof(kind));
    EXPECT_THROW(worker.answer(request, 1), Error);
  }
}

} // namespace

} // namespace schlieren
