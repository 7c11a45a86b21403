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
  scene.fieldColors = { { 1, 0, 0 }, { 0, 0.5f, 1 } };
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
  expectSameOf(flow.tinted(), scene);
  scene.precision = Precision::Double;
  expectSameOf(flow.tinted(), scene);
}

TEST(Processes, ChangesNoBitOfATree)
{
  Scene scene = oblique();
  scene.source.distance = 20;
  expectSameOf(ballsWithFields(), scene);
}

TEST(Processes, ChangesNoBitBesideWalls)
{
  const auto source = std::make_shared<SphereSource>(2);
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  Scene scene = oblique();
  scene.view.parallelScale = 1.5;
  scene.mediumTolerance = 0.1;
  scene.fieldColors.clear();
  expectSameOf(field, scene);
}

TEST(Processes, SendsTheMediumOnce)
{
  const BlobWithHole flow;
  OtherProcesses others(3);
  Bench bench;
  bench.setProcesses(&others);
  Scene scene = oblique();
  bench.render(flow.tinted(), scene);
  const int traces = others.traces;
  EXPECT_EQ(others.arrays, 3); // samples, solids, gradients of fields
  scene.view.viewDirection = { 0.3, 0.1, -1 };
  bench.render(flow.tinted(), scene);
  EXPECT_EQ(others.arrays, 3);
  EXPECT_GT(others.traces, traces);
  scene.interpolation = Interpolation::Cubic; // another medium
  bench.render(flow.tinted(), scene);
  EXPECT_GT(others.arrays, 3);
  bench.setProcesses(nullptr);
  const int tracesOfOthers = others.traces;
  scene.view.viewDirection = { 0, 0.1, -1 };
  EXPECT_EQ(bench.render(flow.tinted(), scene).processes, 1);
  EXPECT_EQ(others.traces, tracesOfOthers);
}

// Two views of the same data, each with its own array of the same gradients and with others of its own, or the same ones.
TEST(Processes, BenchesOfOneMediumFindTheirOwnFields)
{
  const BlobWithHole flow;
  Scene scene = oblique();
  const auto media = std::make_shared<SharedMedia>();
  OtherProcesses first(1), second(1), both(1);
  Bench benches[4];
  OtherProcesses* const of[4] = { &first, &second, &both, &both };
  const std::vector<float> arrays[4] = { flow.gradients, flow.gradients, flow.gradients,
    flow.gradients };
  for (const double x : { -0.2, 0.3 })
  {
    scene.view.viewDirection = { x, 0.4, -1 };
    const Image alone = Bench().render(flow.tinted(), scene);
    for (std::size_t i = 0; i < 4; ++i)
    {
      benches[i].setMedia(media);
      benches[i].setProcesses(of[i]);
      Field field = flow.tinted();
      field.gradients.values = arrays[i].data();
      expectSameImage(benches[i].render(field, scene), alone);
      EXPECT_GT(of[i]->traces, 0);
    }
  }
  EXPECT_EQ(benches[1].work().mediumBuilds, 0);
  EXPECT_EQ(first.arrays, 4); // gradients twice, as another bench has had its own meanwhile
}

TEST(Processes, SaysWhatGoesWrongInOne)
{
  const BlobWithHole flow;
  OtherProcesses others(2);
  others.failing = 1;
  Bench bench;
  bench.setProcesses(&others);
  EXPECT_THROW(bench.render(flow.tinted(), oblique()), Error);
  others.failing = -1;
  expectSameImage(bench.render(flow.tinted(), oblique()), Bench().render(flow.tinted(), oblique()));
}

TEST(Processes, AbortsAtOnce)
{
  const BlobWithHole flow;
  OtherProcesses others(1);
  Bench bench;
  bench.setProcesses(&others);
  int questions = 0;
  const Monitor aborting{ {}, [&] { return ++questions > 1; }, {} };
  EXPECT_TRUE(bench.render(flow.tinted(), oblique(), aborting).aborted);
  expectSameImage(bench.render(flow.tinted(), oblique()), Bench().render(flow.tinted(), oblique()));
}

// No side has a large medium twice.
TEST(Processes, SendsLargeArraysInPieces)
{
  const SampledField<float> flow(cube(180, 1), // 23 MB
    [](double x, double y, double z)
    { return 3e-4 * std::exp(-(x * x + 2 * y * y + z * z) / 0.1); });
  Scene scene = oblique();
  scene.fieldColors.clear();
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
