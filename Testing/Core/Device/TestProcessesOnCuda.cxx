// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose rays are traced on the CUDA devices of several processes, here threads that know each other by requests
// alone and have the emulated device in common.
#include "AnalyticSources.h"
#include "Fields.h"
#include "OtherProcesses.h"
#include "SameImage.h"
#include "Threads.h"

#include <memory>

namespace schlieren
{

namespace
{

class ProcessesOnCuda : public WithCuda
{
protected:
  ProcessesOnCuda()
  {
    scene_.device = Device::Cuda;
    scene_.view.width = 100; // no multiple of a block's edges
    scene_.view.height = 130;
    scene_.view.viewDirection = { -0.2, 0.4, -1 };
    scene_.histogramSize = 16;
    scene_.samplesPerPixel = 2;
    scene_.threads = 1;
  }

  void expectSameOf(const Field& field)
  {
    const Image alone = Bench().render(field, scene_);
    EXPECT_EQ(alone.processes, 1);
    for (const int count : { 1, 2 })
    {
      SCOPED_TRACE(count);
      OtherProcesses others(count);
      Bench bench;
      bench.setProcesses(&others);
      const Image image = bench.render(field, scene_);
      EXPECT_EQ(image.device, Device::Cuda);
      EXPECT_EQ(image.processes, count + 1);
      expectSameImage(image, alone);
      EXPECT_GT(others.traces, 0);
    }
  }

  const BlobWithHole flow_;
  Scene scene_;
};

TEST_F(ProcessesOnCuda, ChangesNoBitOfAnImage)
{
  expectSameOf(flow_.field); // rays stay on the device
  scene_.precision = Precision::Double;
  expectSameOf(flow_.field);
}

TEST_F(ProcessesOnCuda, ChangesNoBitOfATree) { expectSameOf(fieldOfBalls()); }

TEST_F(ProcessesOnCuda, ChangesNoBitBesideWalls)
{
  const auto source = std::make_shared<SphereSource>(2);
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  scene_.view.parallelScale = 1.5;
  scene_.mediumTolerance = 0.1;
  expectSameOf(field);
}

TEST_F(ProcessesOnCuda, SendsTheMediumOnceAndFollowsTheScene)
{
  OtherProcesses others(1);
  Bench bench;
  bench.setProcesses(&others);
  const auto expectSame = [&]
  {
    const int traces = others.traces;
    expectSameImage(bench.render(flow_.field, scene_), Bench().render(flow_.field, scene_));
    EXPECT_GT(others.traces, traces);
  };
  expectSame();
  EXPECT_EQ(others.arrays, 2); // samples, solids
  scene_.view.viewDirection = { 0.3, 0.1, -1 };
  expectSame();
  scene_.device = Device::Cpu;
  scene_.view.viewDirection = { 0.2, 0.1, -1 };
  expectSame();
  scene_.device = Device::Cuda;
  expectSame();
  EXPECT_EQ(others.arrays, 2);
  scene_.interpolation = Interpolation::Cubic; // another medium
  expectSame();
  EXPECT_GT(others.arrays, 2);
}

// Else rays would differ: this process traces all.
TEST_F(ProcessesOnCuda, HasOneKindOfDevice)
{
  OtherProcesses others(2);
  others.hasOtherDevice = true;
  Bench bench;
  bench.setProcesses(&others);
  const Image image = bench.render(flow_.field, scene_);
  expectSameImage(image, Bench().render(flow_.field, scene_));
  EXPECT_EQ(image.processes, 1);
  EXPECT_EQ(others.traces, 0);
  EXPECT_EQ(others.arrays, 0);
}

} // namespace

} // namespace schlieren
