// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The same per-ray code runs on both; only the compilers' rounding differs.
#include "AnalyticSources.h"
#include "Fields.h"
#include "Medium/Medium.h"
#include "Optics/DeflectionHistogram.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/Cuda/CudaTracer.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

namespace schlieren
{

namespace
{

using HostAndDeviceRays = WithCuda;

constexpr int width = 53, height = 37; // whole blocks of threads do not fit
const Pass pass{ -4, -3, width, height, { 0.2, -0.3 } };

/// A wavy blob in gas that is still near the faces of the cube.
double blob(double x, double y, double z)
{
  const double r2 = x * x + 1.5 * y * y + z * z;
  return 3e-4 * std::exp(-r2 / 0.1) * (1 + 0.2 * std::sin(7 * x + 5 * z));
}

/// A medium and rays through it, aslant.
template <class Real>
struct Bundle
{
  Bundle(const KernelChoice& kernel, bool hasBall = false)
    : field(cube(30, 1), blob)
  {
    field.field.ambient = 0;
    if (hasBall)
    {
      for (const float sample : field.samples)
      {
        valid.push_back(sample < 1e-4f ? 1 : 0);
      }
      field.field.valid = valid.data();
    }
    View view;
    view.viewDirection = { -0.4, 0.3, -0.8 };
    view.width = width - 8;
    view.height = height - 6;
    settings.kernel = kernel;
    settings.adaptiveTolerance = 1e-3; // few steps are tried twice
    light = collimatedLight(field.field.grid, frameOf(field.field.grid, view));
    medium =
      std::make_unique<Medium<Real>>(buildMedium<Real>(field.field, kernel.interpolation, 1));
  }

  RayTask<Real> task() const { return makeTask(*medium, light, settings); }

  TracedPass onHost(const RayTask<Real>& task) const
  {
    TracedPass traced;
    traced.resize(pass);
    traceOnCpu(task, pass, traced, 1, {}, Simd::None);
    return traced;
  }

  TracedPass onDevice(const RayTask<Real>& task) const
  {
    TracedPass traced;
    CudaTracer<Real> tracer(*medium);
    tracer.trace(task, pass, CudaTracer<Real>::Exits::OnHost, traced, {});
    return traced;
  }

  SampledField<float> field;
  std::vector<unsigned char> valid;
  RaySettings settings;
  Light light;
  std::unique_ptr<Medium<Real>> medium;
};

/// How far rays differ, by the largest value of all.
struct Differences
{
  double worst = 0;
  double fraction = 0; ///< of rays that differ by more than was allowed

  template <class ValuesOf>
  Differences(const TracedPass& host, const TracedPass& device, double allowed, const ValuesOf& of)
  {
    double largest = 0;
    for (const RayExit& exit : host.exits)
    {
      for (const double value : of(exit))
      {
        largest = std::max(largest, std::abs(value));
      }
    }
    for (std::size_t ray = 0; ray < host.exits.size(); ++ray)
    {
      const auto a = of(host.exits[ray]), b = of(device.exits[ray]);
      double here = host.exits[ray].fate == device.exits[ray].fate ? 0 : HUGE_VAL;
      for (std::size_t n = 0; n < a.size(); ++n)
      {
        here = std::max(here, std::abs(a[n] - b[n]) / largest);
      }
      worst = std::max(worst, here);
      fraction += here > allowed ? 1. / static_cast<double>(host.exits.size()) : 0;
    }
    EXPECT_GT(largest, 0);
  }
};

std::vector<double> deflectionOf(const RayExit& exit)
{
  return { exit.deflection[0], exit.deflection[1] };
}
std::vector<double> opticalPathOf(const RayExit& exit) { return { exit.opticalPathDifference }; }

std::string name(const KernelChoice& kernel)
{
  return std::string(name(kernel.interpolation)) + ", integrator " +
    std::to_string(static_cast<int>(kernel.integrator)) +
    (kernel.path == PathModel::Straight ? ", straight" : "");
}

/// Where a step is tried again, single rays may go another way by rounding alone.
bool mayBranch(const KernelChoice& kernel) { return kernel.integrator == Integrator::Adaptive; }

template <class Real>
void expectAgreement(const KernelChoice& kernel, double allowed)
{
  SCOPED_TRACE(name(kernel));
  const Bundle<Real> bundle(kernel);
  const RayTask<Real> task = bundle.task();
  const TracedPass host = bundle.onHost(task);
  const TracedPass device = bundle.onDevice(task);
  ASSERT_EQ(host.exits.size(), device.exits.size());
  const Differences deflection(host, device, allowed, deflectionOf);
  const Differences opticalPath(host, device, allowed, opticalPathOf);
  if (mayBranch(kernel))
  {
    EXPECT_LT(deflection.fraction, 0.02);
    EXPECT_LT(deflection.worst, 0.05);
    EXPECT_LT(opticalPath.fraction, 0.02);
    EXPECT_LT(opticalPath.worst, 0.005);
  }
  else
  {
    EXPECT_LT(deflection.worst, allowed);
    EXPECT_LT(opticalPath.worst, allowed);
  }
  EXPECT_LT(std::abs(host.worstDrift - device.worstDrift), 0.1 * host.worstDrift + 1e-6);
  EXPECT_EQ(device.crossed,
    std::count_if(device.exits.begin(), device.exits.end(),
      [](const RayExit& exit) { return exit.fate != RayFate::Missed; }));
}

template <class Visit>
void forKernelsOf(Interpolation interpolation, const Visit& visit)
{
  for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
  {
    visit(KernelChoice{ PathModel::Refracted, integrator, interpolation });
  }
  visit(KernelChoice{ PathModel::Straight, Integrator::Leapfrog, interpolation });
}

template <class Visit>
void forKernels(const Visit& visit)
{
  for (const Interpolation interpolation : allInterpolations)
  {
    forKernelsOf(interpolation, visit);
  }
}

TEST_F(HostAndDeviceRays, AgreeForEveryKernel)
{
  forKernels(
    [](const KernelChoice& kernel)
    {
      expectAgreement<float>(kernel, 1e-5);
      expectAgreement<double>(kernel, 1e-12);
    });
}

TEST_F(HostAndDeviceRays, AreCountedAlike)
{
  std::mt19937 random(1);
  for (const int size : { 1, 7, 64 })
  {
    DeflectionHistogram host(size), device(size);
    for (const double strength :
      { 0., 1e-6, 1e-4, 3e-5 }) // the range grows, and rays of the middle are many
    {
      std::normal_distribution<double> bend(0, strength > 0 ? strength : 1);
      RayExits exits(static_cast<std::size_t>(width * height), RayExit{});
      for (RayExit& exit : exits)
      {
        const bool isBent = strength > 0 && random() % 2 == 0;
        exit = { { isBent ? bend(random) : 0, isBent ? bend(random) : 0 }, { 0, 0 }, 0,
          random() % 9 == 0 ? RayFate::Blocked : RayFate::Left, 1 };
        exit.deflection[0] = random() % 50 == 0 ? std::nan("") : exit.deflection[0];
      }
      host.add({ pass, exits.data() }, width - 8, height - 6, 1);
      device.add(CudaPass(exits), pass, width - 8, height - 6);
      EXPECT_EQ(host.histogram().range, device.histogram().range);
      EXPECT_EQ(host.histogram().rays, device.histogram().rays);
    }
  }
}

TEST_F(HostAndDeviceRays, EndInTheSameBodies)
{
  const Bundle<double> bundle(
    { PathModel::Refracted, Integrator::Leapfrog, Interpolation::Quadratic }, true);
  const TracedPass host = bundle.onHost(bundle.task());
  const TracedPass device = bundle.onDevice(bundle.task());
  const auto blocked = [](const TracedPass& traced)
  {
    return std::count_if(traced.exits.begin(), traced.exits.end(),
      [](const RayExit& exit) { return exit.fate == RayFate::Blocked; });
  };
  EXPECT_GT(blocked(host), 20);
  // A ray may graze a body by rounding alone.
  const Differences deflection(host, device, 1e-12, deflectionOf);
  EXPECT_LT(deflection.fraction, 0.005);
}

TEST_F(HostAndDeviceRays, AreTrappedAtTheSameStep)
{
  const Bundle<float> bundle(
    { PathModel::Refracted, Integrator::Leapfrog, Interpolation::Quadratic });
  RayTask<float> task = bundle.task();
  task.stepLimit = 7;
  const TracedPass host = bundle.onHost(task);
  const TracedPass device = bundle.onDevice(task);
  int trapped = 0;
  for (std::size_t ray = 0; ray < host.exits.size(); ++ray)
  {
    EXPECT_EQ(host.exits[ray].fate, device.exits[ray].fate);
    EXPECT_EQ(host.exits[ray].steps, device.exits[ray].steps);
    trapped += device.exits[ray].fate == RayFate::Trapped ? 1 : 0;
  }
  EXPECT_GT(trapped, 100);
}

template <class Real>
void expectAgreementInATree(Interpolation interpolation, double allowed)
{
  const auto source =
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0.1, 0, -0.05 }, 0.1, 1e-3 } });
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  TreeSettings ofTree;
  ofTree.interpolation = interpolation;
  Medium<Real> medium = buildTree<Real>(field, ofTree);
  View view;
  view.viewDirection = { 0.3, -0.5, -0.8 };
  view.width = width;
  view.height = height;
  const Light light = collimatedLight(field.grid, frameOf(field.grid, view));
  refine(medium, { light.u, light.v, { 0, 0 }, { 2, 2 }, 0.01 }, {});
  EXPECT_GT(medium.tree->statistics().finestLevel, 0);
  CudaTracer<Real> tracer(medium);
  forKernelsOf(interpolation,
    [&](const KernelChoice& kernel)
    {
      SCOPED_TRACE(name(kernel));
      RaySettings settings;
      settings.kernel = kernel;
      settings.adaptiveTolerance = 1e-3;
      const RayTask<Real> task = makeTask(medium, light, settings);
      TracedPass host, device;
      host.resize(pass);
      traceOnCpu(task, pass, host, 1, {}, Simd::None);
      tracer.trace(task, pass, CudaTracer<Real>::Exits::OnHost, device, {});
      ASSERT_EQ(host.exits.size(), device.exits.size());
      const Differences deflection(host, device, allowed, deflectionOf);
      EXPECT_LT(deflection.fraction, 0.02); // steps begin at leaves, where rounding may decide
      EXPECT_LT(deflection.worst, 0.05);
    });
}

TEST_F(HostAndDeviceRays, AgreeInATreeForEveryKernel)
{
  for (const Interpolation interpolation : allInterpolations)
  {
    expectAgreementInATree<float>(interpolation, 1e-3);
    expectAgreementInATree<double>(interpolation, 1e-9);
  }
}

void expectSameBits(const RayExits& a, const RayExits& b)
{
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(RayExit)), 0);
}

/// A pass of several launches, whose rays stay there or come back while the next launch runs.
TEST_F(HostAndDeviceRays, AreTheSameWhetherTheyComeBackOrNot)
{
  const Bundle<float> bundle(
    { PathModel::Straight, Integrator::Leapfrog, Interpolation::Quadratic });
  const RayTask<float> task = bundle.task();
  Pass large = pass;
  large.columns = 2051;
  large.rows = 1201;
  CudaTracer<float> tracer(*bundle.medium);
  using Exits = CudaTracer<float>::Exits;
  std::vector<double> progress;
  TracedPass back, there;
  EXPECT_TRUE(tracer.trace(task, large, Exits::OnHost, back,
    { [&](double fraction) { progress.push_back(fraction); }, {} }));
  EXPECT_GT(progress.size(), 1u);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_EQ(progress.back(), 1);
  EXPECT_FALSE(back.onDevice);

  EXPECT_FALSE(tracer.trace(task, large, Exits::OnDevice, there, { {}, [] { return true; } }));
  EXPECT_TRUE(tracer.trace(task, large, Exits::OnDevice, there, {}));
  ASSERT_TRUE(there.onDevice);
  EXPECT_TRUE(there.exits.empty());
  EXPECT_EQ(there.crossed, back.crossed);
  EXPECT_GT(there.crossed, 0);
  expectSameBits(back.exits, there.onDevice->toHost());
}

/// Patches of an image, of all sizes.
TEST_F(HostAndDeviceRays, AreTheSameInOnePassOrMany)
{
  const Bundle<float> bundle(
    { PathModel::Refracted, Integrator::Leapfrog, Interpolation::Quadratic });
  const RayTask<float> task = bundle.task();
  std::vector<Pass> passes;
  for (std::int64_t n = 0; n < 7; ++n)
  {
    passes.push_back({ 3 * n - 2, 20 - 4 * n, 1 + 5 * n % 37, 1 + 11 * n % 23, pixelOffset(n, 1) });
  }
  CudaTracer<float> tracer(*bundle.medium);
  constexpr auto onHost = CudaTracer<float>::Exits::OnHost;
  TracedPass onDevice, onCpu;
  EXPECT_TRUE(tracer.trace(task, passes, onHost, onDevice, {}));
  onCpu.resize(passes);
  EXPECT_TRUE(traceOnCpu(task, passes, onCpu, 2, {}));
  TracedPass oneByOne[2];
  for (const Pass& one : passes)
  {
    TracedPass alone[2];
    tracer.trace(task, one, onHost, alone[0], {});
    alone[1].resize(one);
    traceOnCpu(task, one, alone[1], 1, {});
    for (std::size_t n = 0; n < 2; ++n)
    {
      TracedPass& all = oneByOne[n];
      all.crossed += alone[n].crossed;
      all.worstDrift = std::max(all.worstDrift, alone[n].worstDrift);
      all.exits.insert(all.exits.end(), alone[n].exits.begin(), alone[n].exits.end());
    }
  }
  for (const auto& [together, apart] :
    { std::pair<const TracedPass&, const TracedPass&>{ onDevice, oneByOne[0] },
      { onCpu, oneByOne[1] } })
  {
    expectSameBits(together.exits, apart.exits);
    EXPECT_EQ(together.crossed, apart.crossed);
    EXPECT_EQ(together.worstDrift, apart.worstDrift);
    EXPECT_GT(together.crossed, 0);
  }
}

TEST_F(HostAndDeviceRays, TooMuchForTheDeviceIsReportedWithNumbers)
{
  constexpr std::size_t farTooMany = std::size_t{ 1 } << 42;
  try
  {
    const CudaPass impossible(farTooMany);
    FAIL() << "no device has as much";
  }
  catch (const DeviceError& error)
  {
    const std::string needed = std::to_string(farTooMany * sizeof(RayExit) >> 20) + " MB more";
    EXPECT_NE(std::string(error.what()).find(needed), std::string::npos) << error.what();
  }
  EXPECT_EQ(CudaPass(1000).size(), 1000u); // and the next one is served
}

Image render(Bench& bench, const Field& field, const Scene& scene)
{
  Image image = bench.render(field, scene);
  EXPECT_EQ(image.device, Device::Cuda);
  return image;
}

void expectSameImage(const Image& a, const Image& b)
{
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.deflection, b.deflection);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.opticalPathDifference, b.opticalPathDifference);
  EXPECT_EQ(a.blockedFraction, b.blockedFraction);
  EXPECT_EQ(a.kScale, b.kScale);
  EXPECT_EQ(a.raysTraced, b.raysTraced);
  EXPECT_EQ(a.stepsTaken, b.stepsTaken);
}

/// Cached rays, on the device.
TEST_F(HostAndDeviceRays, ServeForTheNextImage)
{
  const Bundle<float> bundle(
    { PathModel::Refracted, Integrator::Leapfrog, Interpolation::Quadratic });
  Field field = bundle.field.field;
  Scene scene;
  scene.device = Device::Cuda;
  scene.pathModel = PathModel::Refracted;
  scene.view.width = 40;
  scene.view.height = 30;
  scene.samplesPerPixel = 3;
  Bench bench;
  render(bench, field, scene);
  const std::int64_t rays = bench.work().raysTraced;

  scene.knifeEdgeAngle = 90;
  Bench fresh;
  expectSameImage(render(bench, field, scene), render(fresh, field, scene));
  EXPECT_EQ(bench.work().raysTraced, rays);
  scene.cutoff = Cutoff::Shadowgraph;
  Bench freshShadow;
  expectSameImage(render(bench, field, scene), render(freshShadow, field, scene));
  EXPECT_EQ(bench.work().raysTraced, rays);
  EXPECT_EQ(freshShadow.work().raysTraced, rays);

  scene.samplesPerPixel = 4; // of which three are cached
  Bench freshMore;
  expectSameImage(render(bench, field, scene), render(freshMore, field, scene));
}

} // namespace

} // namespace schlieren
