// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// All rays of a view are traced in one way: those of its image and of its waves, and those that look at it before.
#include "AnalyticSources.h"
#include "Fields.h"
#include "OtherProcesses.h"
#include "Rays/Cpu/CpuTracer.h"
#include "SameImage.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace schlieren
{

namespace
{

void expectSameAccuracy(const Image& a, const Image& b)
{
  EXPECT_EQ(a.stepSize, b.stepSize);
  EXPECT_EQ(a.samplesPerPixel, b.samplesPerPixel);
  EXPECT_EQ(a.accuracy.reached, b.accuracy.reached);
  EXPECT_EQ(a.accuracy.largest, b.accuracy.largest);
  EXPECT_EQ(a.accuracy.limit, b.accuracy.limit);
}

/// Views whose images need all kinds of looks at them.
class TracerOfViews
{
public:
  using Visit = std::function<void(const Field& field, const Scene& scene)>;

  /// Calls visit() for each. Some choose their settings by a target error.
  void forAll(const Visit& visit) const
  {
    for (const auto& [cutoff, target] :
      { std::pair<Cutoff, double>{ Cutoff::KnifeEdge, 1. / 256 }, { Cutoff::Shadowgraph, 1. / 256 },
        { Cutoff::Interferogram, 0.02 }, { Cutoff::Background, 0.02 } })
    {
      SCOPED_TRACE("cutoff " + std::to_string(static_cast<int>(cutoff)));
      Scene scene = sceneOf(cutoff);
      scene.targetError = target;
      visit(flow_.field, scene);
    }
    {
      SCOPED_TRACE("walls in a tree, double precision");
      Scene scene = sceneOf(Cutoff::BrightField);
      scene.targetError = 1. / 64;
      scene.precision = Precision::Double;
      scene.view.parallelScale = 1.5;
      scene.view.width = scene.view.height = 16;
      visit(fieldOf(std::make_shared<SphereSource>(2)), scene);
    }
    {
      SCOPED_TRACE("waves");
      Scene scene = sceneOf(Cutoff::Shadowgraph);
      scene.lightModel = LightModel::Waves;
      scene.wavelength = 0.01;
      scene.screenDistance = 0.5;
      visit(smooth_.field, scene);
    }
  }

private:
  static Scene sceneOf(Cutoff cutoff)
  {
    Scene scene = sceneOnCpu(20, 16, { -0.2, 0.4, -1 });
    scene.cutoff = cutoff;
    scene.wavelength = 1e-4;
    scene.screenDistance = 2;
    scene.background.distance = 2;
    scene.samplesPerPixel = 1;
    scene.threads = 2;
    return scene;
  }

  const BlobWithHole flow_;
  const SampledField<float> smooth_{ cube(24, 1),
    [](double x, double y, double z) { return 1e-3 * std::exp(-6 * (x * x + y * y + z * z)); } };
};

TEST(Tracer, DividesAllRaysOfAViewBetweenProcesses)
{
  const TracerOfViews views;
  views.forAll(
    [](const Field& field, const Scene& scene)
    {
      const Image byOne = Bench().render(field, scene);
      for (const int count : { 1, 2 })
      {
        SCOPED_TRACE(count);
        OtherProcesses others(count);
        Bench bench;
        bench.setProcesses(&others);
        const std::int64_t before = tilesTracedOnCpu();
        const Image together = bench.render(field, scene);
        expectSameImage(together, byOne);
        expectSameAccuracy(together, byOne);
        EXPECT_EQ(together.lightModel, byOne.lightModel);
        // None by one of them alone, but some pixels' through finer voxels, which the others need not have.
        const std::int64_t alone = tilesTracedOnCpu() - before - others.tiles;
        EXPECT_LE(alone, field.source ? others.tiles / 4 : 0);
        EXPECT_GT(others.tiles, 0);
      }
    });
}

TEST(Tracer, PausesWhereverItIs)
{
  const TracerOfViews views;
  views.forAll(
    [](const Field& field, const Scene& scene)
    {
      const Image atOnce = Bench().render(field, scene);
      OtherProcesses others(1);
      Bench bench;
      bench.setProcesses(&others);
      const Monitor always{ {}, {}, [] { return true; } };
      Image image = bench.render(field, scene, always);
      for (int calls = 0; bench.isUnfinished() && calls < 3000; ++calls)
      {
        image = bench.resume(always);
      }
      expectSameImage(image, atOnce);
      expectSameAccuracy(image, atOnce);
    });
}

TEST(Tracer, SaysWhatFailsWhileItLooksAtAView)
{
  const BlobWithHole flow;
  Scene scene = sceneOnCpu(40, 32, { -0.2, 0.4, -1 });
  scene.targetError = 1. / 256;
  OtherProcesses others(1);
  others.failing = 0;
  Bench bench;
  bench.setProcesses(&others);
  EXPECT_THROW(bench.render(flow.field, scene), Error);
  others.failing = -1;
  expectSameImage(bench.render(flow.field, scene), Bench().render(flow.field, scene));
}

class TracerOnCuda : public WithCuda
{
};

TEST_F(TracerOnCuda, TracesNoRayOfAViewOnTheCpu)
{
  const TracerOfViews views;
  views.forAll(
    [](const Field& field, Scene scene)
    {
      const Image onCpu = Bench().render(field, scene);
      scene.device = Device::Cuda;
      const std::int64_t before = tilesTracedOnCpu();
      const Image onCuda = Bench().render(field, scene);
      OtherProcesses others(1);
      Bench bench;
      bench.setProcesses(&others);
      const Image onTwo = bench.render(field, scene);
      EXPECT_EQ(tilesTracedOnCpu(), before);
      EXPECT_EQ(others.tiles, 0); // one device traces all rays
      EXPECT_EQ(onCuda.device, Device::Cuda);
      expectSameImage(onTwo, onCuda);
      expectSameAccuracy(onTwo, onCuda);
      EXPECT_EQ(onCuda.stepSize, onCpu.stepSize);
      EXPECT_EQ(onCuda.samplesPerPixel, onCpu.samplesPerPixel);
      EXPECT_EQ(onCuda.accuracy.limit, onCpu.accuracy.limit);
      EXPECT_NEAR(onCuda.accuracy.reached, onCpu.accuracy.reached, 0.01 * scene.targetError);
      EXPECT_EQ(onCuda.lightModel, onCpu.lightModel);
    });
}

} // namespace

} // namespace schlieren
