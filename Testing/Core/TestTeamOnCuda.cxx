// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose rays are traced on the CUDA devices of several processes, here threads that know each other by messages
// alone and have the emulated device in common.
#include "AnalyticSources.h"
#include "Fields.h"
#include "SameImage.h"
#include "Threads.h"
#include "WorkerThread.h"

#include <memory>
#include <vector>

namespace schlieren
{

namespace
{

class TeamOnCuda : public WithCuda
{
protected:
  TeamOnCuda()
  {
    scene_.device = Device::Cuda;
    scene_.view.width = 100; // no multiple of a block's edges
    scene_.view.height = 130;
    scene_.view.viewDirection = { -0.2, 0.4, -1 };
    scene_.histogramSize = 16;
    scene_.samplesPerPixel = 2;
    scene_.fieldColors = { { 1, 0, 0 }, { 0, 0.5f, 1 } };
    scene_.threads = 1;
  }
  ~TeamOnCuda() override { emulated::setCapacity(emulated::defaultCapacity); }

  /// From several directions, until workers have traced rays: the first ones may be traced before they are ready.
  void expectSameOf(const Field& field)
  {
    for (const std::size_t count : { 1u, 2u })
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
      int tiles = 0;
      Image image;
      for (int view = 0; view < 10 && tiles == 0; ++view)
      {
        scene_.view.viewDirection = { 0.1 * view - 0.2, 0.4, -1 };
        image = bench.render(field, scene_);
        EXPECT_EQ(image.device, Device::Cuda);
        const Image alone = Bench().render(field, scene_);
        EXPECT_EQ(alone.workers, 0);
        expectSameImage(image, alone);
        for (const auto& worker : workers)
        {
          tiles += worker->tiles();
        }
      }
      EXPECT_GT(tiles, 0);
      EXPECT_GT(image.workers, 0);
    }
  }

  const BlobWithHole flow_;
  Scene scene_;
};

TEST_F(TeamOnCuda, ChangesNoBitOfAnImage)
{
  expectSameOf(flow_.field); // rays stay on the device
  expectSameOf(flow_.tinted());
  scene_.homogeneityTolerance = 1e-3;
  scene_.precision = Precision::Double;
  expectSameOf(flow_.tinted());
}

TEST_F(TeamOnCuda, ChangesNoBitOfATree)
{
  const auto balls = std::make_shared<BallsSource>(threeBalls(3e-4));
  const auto source = std::make_shared<SourceWithFields>(balls,
    std::vector<FieldFormula>{ ballField({ 0.1, 0, 0 }, 0.3), ballField({ -0.2, 0.3, 0 }, 0.1) });
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  field.gradients.count = 2;
  expectSameOf(field);
}

TEST_F(TeamOnCuda, ChangesNoBitBesideWalls)
{
  const auto source = std::make_shared<SphereSource>(2);
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  scene_.view.parallelScale = 1.5;
  scene_.mediumTolerance = 0.1;
  scene_.fieldColors.clear();
  expectSameOf(field);
}

TEST_F(TeamOnCuda, SendsTheMediumOnceAndFollowsTheScene)
{
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  const auto expectSame = [&]
  {
    const int tiles = worker.tiles();
    expectSameImage(bench.render(flow_.tinted(), scene_), Bench().render(flow_.tinted(), scene_));
    EXPECT_GT(worker.tiles(), tiles);
  };
  expectSame();
  EXPECT_EQ(worker.arrays(), 3); // samples, solids, gradients of fields
  scene_.view.viewDirection = { 0.3, 0.1, -1 };
  expectSame();
  scene_.device = Device::Cpu;
  scene_.view.viewDirection = { 0.2, 0.1, -1 };
  expectSame();
  scene_.device = Device::Cuda;
  expectSame();
  EXPECT_EQ(worker.arrays(), 3);
  scene_.interpolation = Interpolation::Cubic; // another medium
  expectSame();
  EXPECT_GT(worker.arrays(), 3);
}

TEST_F(TeamOnCuda, HasOneKindOfDevice)
{
  Worker good, other(Worker::Fault::HasOtherDevice);
  Bench bench;
  bench.setWorkers({ other.channel(), good.channel() });
  Image image;
  for (int view = 0; view < 10 && good.tiles() == 0; ++view) // on a busy machine it may be late
  {
    scene_.view.viewDirection = { 0.1 * view - 0.2, 0.4, -1 };
    image = bench.render(flow_.tinted(), scene_);
    expectSameImage(image, Bench().render(flow_.tinted(), scene_));
  }
  EXPECT_EQ(image.workers, 1);
  EXPECT_GT(good.tiles(), 0);
  EXPECT_EQ(other.tiles(), 0);
  EXPECT_EQ(other.arrays(), 0);
}

// Not seen in the image, whatever becomes of a worker.
TEST_F(TeamOnCuda, NeedsNoWorker)
{
  const Image alone = Bench().render(flow_.tinted(), scene_);
  for (const Worker::Fault fault :
    { Worker::Fault::Forgets, Worker::Fault::Leaves, Worker::Fault::LosesEverything })
  {
    for (const int after : { 0, 1 })
    {
      SCOPED_TRACE(testing::Message() << static_cast<int>(fault) << " after " << after);
      Worker good, faulty(fault, after);
      Bench bench;
      bench.setWorkers({ faulty.channel(), good.channel() });
      expectSameImage(bench.render(flow_.tinted(), scene_), alone);
      EXPECT_GT(faulty.tiles(), 0);
    }
  }
}

TEST_F(TeamOnCuda, DoesWithoutAWorkerWhoseDeviceHasNoMemory)
{
  const SampledField<float> large(cube(120, 1),
    [](double x, double y, double z) { return 3e-4 * std::exp(-(x * x + y * y + z * z) / 0.1); });
  scene_.fieldColors.clear();
  const Image alone = Bench().render(large.field, scene_);
  emulated::setCapacity(std::size_t{ 12 } << 20); // of this process and the worker together
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  const Image image = bench.render(large.field, scene_);
  EXPECT_EQ(image.device, Device::Cuda);
  EXPECT_EQ(image.deviceNote, "");
  expectSameImage(image, alone);
  EXPECT_GT(worker.tiles(), 0);
  int tiles = 0;
  for (const double x : { 0.1, 0.2, 0.3 })
  {
    tiles = worker.tiles();
    scene_.view.viewDirection = { x, 0.1, -1 };
    EXPECT_EQ(bench.render(large.field, scene_).device, Device::Cuda);
  }
  EXPECT_EQ(worker.tiles(), tiles); // it has failed too often
}

TEST_F(TeamOnCuda, AbortsAtOnce)
{
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  int questions = 0;
  const Monitor aborting{ {}, [&] { return ++questions > 3; }, {} };
  EXPECT_TRUE(bench.render(flow_.tinted(), scene_, aborting).aborted);
  expectSameImage(bench.render(flow_.tinted(), scene_), Bench().render(flow_.tinted(), scene_));
}

} // namespace

} // namespace schlieren
