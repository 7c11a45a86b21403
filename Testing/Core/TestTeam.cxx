// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose rays are traced by several processes, here threads that know each other by messages alone.
#include "AnalyticSources.h"
#include "Fields.h"
#include "SameImage.h"
#include "WorkerThread.h"

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

/// Balls, with two fields.
Field fieldOfTree()
{
  const auto balls = std::make_shared<BallsSource>(threeBalls(3e-4));
  const auto source = std::make_shared<SourceWithFields>(balls,
    std::vector<FieldFormula>{ ballField({ 0.1, 0, 0 }, 0.3), ballField({ -0.2, 0.3, 0 }, 0.1) });
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  field.gradients.count = 2;
  return field;
}

Scene oblique()
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = 150; // no multiple of a tile's edge
  scene.view.height = 90;
  scene.view.viewDirection = { -0.2, 0.4, -1 };
  scene.histogramSize = 16;
  scene.samplesPerPixel = 2;
  scene.fieldColors = { { 1, 0, 0 }, { 0, 0.5f, 1 } };
  scene.threads = 1;
  return scene;
}

void expectSameOf(const Field& field, const Scene& scene)
{
  const Image alone = Bench().render(field, scene);
  for (const std::size_t count : { 1u, 2u, 5u })
  {
    SCOPED_TRACE(count);
    std::vector<std::unique_ptr<Worker>> workers;
    std::vector<Channel*> channels;
    while (workers.size() < count)
    {
      workers.push_back(std::make_unique<Worker>());
      channels.push_back(workers.back()->channel());
    }
    Bench bench;
    bench.setWorkers(channels);
    expectSameImage(bench.render(field, scene), alone);
    for (const auto& worker : workers)
    {
      EXPECT_GT(worker->tiles(), 0);
    }
    // With pauses: each call gives tiles back that are not traced.
    Bench paused;
    paused.setWorkers(channels);
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

TEST(Team, ChangesNoBitOfAnImage)
{
  const BlobWithHole flow;
  Scene scene = oblique();
  expectSameOf(flow.tinted(), scene);
  scene.homogeneityTolerance = 1e-3;
  scene.precision = Precision::Double;
  expectSameOf(flow.tinted(), scene);
}

TEST(Team, ChangesNoBitOfATree)
{
  Scene scene = oblique();
  scene.source.distance = 20;
  expectSameOf(fieldOfTree(), scene);
}

TEST(Team, ChangesNoBitBesideWalls)
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

TEST(Team, SendsTheMediumOnce)
{
  const BlobWithHole flow;
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  Scene scene = oblique();
  bench.render(flow.tinted(), scene);
  const int arrays = worker.arrays(), tiles = worker.tiles();
  EXPECT_EQ(arrays, 3); // samples, solids, gradients of fields
  scene.view.viewDirection = { 0.3, 0.1, -1 };
  bench.render(flow.tinted(), scene);
  EXPECT_EQ(worker.arrays(), arrays);
  EXPECT_GT(worker.tiles(), tiles);
  scene.interpolation = Interpolation::Cubic; // another medium
  bench.render(flow.tinted(), scene);
  EXPECT_GT(worker.arrays(), arrays);
  bench.setWorkers({});
  const int tilesOfWorker = worker.tiles();
  scene.view.viewDirection = { 0, 0.1, -1 };
  bench.render(flow.tinted(), scene);
  EXPECT_EQ(worker.tiles(), tilesOfWorker);
}

// They pass it on to each other; what else they are sent are a few kilobytes.
TEST(Team, SendsAsMuchToManyAsToOne)
{
  const BlobWithHole flow;
  const auto bytesSentTo = [&](std::size_t count)
  {
    std::vector<std::unique_ptr<Worker>> workers;
    std::vector<Channel*> channels;
    while (workers.size() < count)
    {
      workers.push_back(std::make_unique<Worker>());
      channels.push_back(workers.back()->channel());
    }
    Bench bench;
    bench.setWorkers(channels);
    bench.render(flow.tinted(), oblique());
    std::size_t bytes = 0;
    for (const auto& worker : workers)
    {
      EXPECT_EQ(worker->arrays(), 3);
      bytes += worker->bytesSent();
    }
    return bytes;
  };
  const std::size_t toOne = bytesSentTo(1);
  EXPECT_GT(toOne, (flow.samples.size() + flow.gradients.size()) * sizeof(float));
  EXPECT_LT(bytesSentTo(6), 2 * toOne);
}

TEST(Team, BenchesOfOneMediumSendItOnce)
{
  const BlobWithHole flow;
  Worker worker;
  const auto media = std::make_shared<SharedMedia>();
  Bench benches[2];
  Scene scene = oblique();
  for (Bench& bench : benches)
  {
    bench.setMedia(media);
    bench.setWorkers({ worker.channel() });
    bench.render(flow.tinted(), scene);
  }
  EXPECT_EQ(worker.arrays(), 3);
  scene.view.viewDirection = { 0.3, 0.1, -1 };
  for (Bench& bench : benches)
  {
    const int tiles = worker.tiles();
    bench.render(flow.tinted(), scene);
    EXPECT_GT(worker.tiles(), tiles);
  }
  EXPECT_EQ(worker.arrays(), 3);
}

// Two views of the same data, each with its own array of the same gradients and a worker of its own.
TEST(Team, BenchesOfOneMediumFindTheirOwnFields)
{
  const BlobWithHole flow;
  const Scene scene = oblique();
  const Image alone = Bench().render(flow.tinted(), scene);
  const auto media = std::make_shared<SharedMedia>();
  Worker workers[2];
  Bench benches[2];
  const std::vector<float> arrays[2] = { flow.gradients, flow.gradients };
  for (std::size_t i = 0; i < 2; ++i)
  {
    benches[i].setMedia(media);
    benches[i].setWorkers({ workers[i].channel() });
    Field field = flow.tinted();
    field.gradients.values = arrays[i].data();
    expectSameImage(benches[i].render(field, scene), alone);
    EXPECT_GT(workers[i].tiles(), 0);
  }
  EXPECT_EQ(benches[1].work().mediumBuilds, 0);
}

// Not seen in the image, whatever becomes of a worker.
TEST(Team, NeedsNoWorker)
{
  const BlobWithHole flow;
  const Scene scene = oblique();
  const Image alone = Bench().render(flow.tinted(), scene);
  for (const Worker::Fault fault :
    { Worker::Fault::Forgets, Worker::Fault::Leaves, Worker::Fault::LosesEverything })
  {
    for (const int after : { 0, 1, 2 })
    {
      SCOPED_TRACE(testing::Message() << static_cast<int>(fault) << " after " << after);
      Worker good, faulty(fault, after);
      Bench bench;
      bench.setWorkers({ faulty.channel(), good.channel() });
      expectSameImage(bench.render(flow.tinted(), scene), alone);
      Scene next = scene;
      next.view.viewDirection = { 0.3, 0.1, -1 };
      expectSameImage(bench.render(flow.tinted(), next), Bench().render(flow.tinted(), next));
      EXPECT_GT(faulty.tiles(), 0);
    }
  }
}

TEST(Team, AbortsAtOnce)
{
  const BlobWithHole flow;
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  int questions = 0;
  const Monitor aborting{ {}, [&] { return ++questions > 3; }, {} };
  EXPECT_TRUE(bench.render(flow.tinted(), oblique(), aborting).aborted);
  expectSameImage(bench.render(flow.tinted(), oblique()), Bench().render(flow.tinted(), oblique()));
}

// No side has a large medium twice.
TEST(Team, SendsLargeArraysInPieces)
{
  const SampledField<float> flow(cube(180, 1), // 23 MB
    [](double x, double y, double z)
    { return 3e-4 * std::exp(-(x * x + 2 * y * y + z * z) / 0.1); });
  Scene scene = oblique();
  scene.fieldColors.clear();
  const Image alone = Bench().render(flow.field, scene);
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  expectSameImage(bench.render(flow.field, scene), alone);
  EXPECT_EQ(worker.arrays(), 2);
  EXPECT_GT(worker.tiles(), 0);
}

/// Pieces of an array, as a worker gets them.
std::vector<std::vector<char>> piecesOf(const std::vector<char>& array, std::uint64_t version)
{
  std::vector<std::vector<char>> pieces;
  sendPieces({ RayWorker::Array, 0, version }, array.data(), array.size(),
    [&](std::vector<char> piece) { pieces.push_back(std::move(piece)); });
  return pieces;
}

TEST(Team, PiecesOfAnArrayAreAllOfIt)
{
  for (const std::size_t bytes :
    { std::size_t{ 0 }, std::size_t{ 5 }, bytesOfArrayPiece, 2 * bytesOfArrayPiece + 3 })
  {
    std::vector<char> array(bytes), together;
    for (std::size_t i = 0; i < bytes; ++i)
    {
      array[i] = static_cast<char>(i % 127);
    }
    for (const std::vector<char>& piece : piecesOf(array, 3))
    {
      ArrayMessage head;
      ASSERT_TRUE(read(piece, head));
      EXPECT_EQ(head.version, 3u);
      EXPECT_EQ(head.bytes, bytes);
      EXPECT_EQ(head.first, together.size());
      EXPECT_LE(piece.size(), sizeof(head) + bytesOfArrayPiece);
      together.insert(together.end(), piece.begin() + sizeof(head), piece.end());
    }
    EXPECT_EQ(together, array);
  }
}

TEST(Team, IgnoresMessagesThatMakeNoSense)
{
  Mail to, from;
  const std::atomic<bool> isOpen{ true };
  End channel(to, from, isOpen);
  RayWorker worker;
  for (const std::size_t bytes : { 0u, 3u, 4u, 40u })
  {
    worker.answer(std::vector<char>(bytes, 7), channel, 1);
  }
  // Of requests that it knows it says that it lacks what they need.
  for (std::uint32_t kind = RayWorker::Array; kind <= RayWorker::DeviceIs; ++kind)
  {
    for (const std::size_t bytes : { 4u, 40u, 4000u })
    {
      std::vector<char> message(bytes, 7);
      std::memcpy(message.data(), &kind, sizeof(kind));
      worker.answer(message, channel, 1);
      while (!to.isEmpty())
      {
        const std::uint32_t answer = RayWorker::kindOf(to.take());
        EXPECT_EQ(answer, kind == RayWorker::AskDevice ? RayWorker::DeviceIs : RayWorker::Lacking);
      }
    }
  }
  EXPECT_TRUE(to.isEmpty());
}

} // namespace

} // namespace schlieren
