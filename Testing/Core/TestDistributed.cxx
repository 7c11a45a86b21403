// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rays through a medium of which each process has a part: the processes are threads that know each other by messages
// alone.
#include "AnalyticSources.h"
#include "Fields.h"
#include "Medium/MediumParts.h"
#include "Rays/DistributedRays.h"
#include "Rays/DistributedTracer.h"
#include "TreeRays.h"
#include "WorkerThread.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace schlieren
{

namespace
{

constexpr std::int64_t width = 53, height = 41; // no multiples of a tile's edge

/// A ball of glass, which turns rays around or sends them back into leaves that they have been in.
class GlassSource : public BallsSource
{
public:
  GlassSource()
    : BallsSource({ { { 0.05, -0.02, 0.03 }, 0.2, 2.5 } }, 1, 0.1)
  {
  }
};

struct Setting
{
  std::shared_ptr<const MediumSource> source;
  Vector direction{ 0.3, -0.5, -0.8 };
  PathModel path = PathModel::Refracted;
  Interpolation interpolation = Interpolation::Quadratic;
  double tolerance = 0.01;
  int fields = 0;
};

template <class Real>
struct Traced
{
  explicit Traced(const Setting& setting)
    : field(fieldOf(setting.source))
    , medium(buildTree<Real>(field, settingsOf(setting)))
  {
    field.gradients.count = setting.fields;
    View view;
    view.viewDirection = setting.direction;
    view.width = static_cast<int>(width);
    view.height = static_cast<int>(height);
    const Light light = collimatedLight(field.grid, frameOf(field.grid, view));
    refine(medium, { light.u, light.v, { 0, 0 }, { 2, 2 }, 0.005 }, {});
    RaySettings rays;
    rays.kernel = { setting.path, Integrator::Leapfrog, setting.interpolation };
    task = makeTask<Real>(medium, nullptr, medium.gradientsOf(field), light, rays);
    alone.resize(pass, setting.fields);
    EXPECT_TRUE(traceOnCpu(task, pass, alone, 2, {}, Simd::None));
  }

  static TreeSettings settingsOf(const Setting& setting)
  {
    TreeSettings settings;
    settings.tolerance = setting.tolerance;
    settings.interpolation = setting.interpolation;
    return settings;
  }

  Field field;
  Medium<Real> medium;
  RayTask<Real> task{};
  const Pass pass{ 0, 0, width, height, { 0.25, -0.125 } };
  TracedPass alone;

  std::int64_t count(RayFate fate) const
  {
    return std::count_if(alone.exits.begin(), alone.exits.end(),
      [fate](const RayExit& exit) { return exit.fate == fate; });
  }
};

void expectSameRays(const TracedPass& a, const TracedPass& b)
{
  ASSERT_EQ(a.exits.size(), b.exits.size());
  for (std::size_t n = 0; n < a.exits.size(); ++n)
  {
    EXPECT_EQ(std::memcmp(&a.exits[n], &b.exits[n], sizeof(RayExit)), 0)
      << n << ": " << a.exits[n].deflection[0] << " " << b.exits[n].deflection[0];
  }
  EXPECT_EQ(a.gathered, b.gathered);
  EXPECT_EQ(a.crossed, b.crossed);
  EXPECT_EQ(a.worstDrift, b.worstDrift);
}

/// To the last bit, for several numbers of processes. Returns how often rays have gone on in another part, per ray.
template <class Real>
double expectSame(const Traced<Real>& traced, int fields = 0)
{
  double perRay = 0;
  for (const std::size_t count : { 0u, 1u, 2u, 6u })
  {
    SCOPED_TRACE(count);
    std::vector<std::unique_ptr<Worker>> workers;
    std::vector<Channel*> channels;
    while (workers.size() < count)
    {
      workers.push_back(std::make_unique<Worker>());
      channels.push_back(workers.back()->channel());
    }
    DistributedTracer<Real> tracer(traced.medium);
    TracedPass rays;
    rays.resize(traced.pass, fields);
    EXPECT_TRUE(tracer.trace(traced.task, traced.pass, channels, rays, 2, {}));
    expectSameRays(rays, traced.alone);
    perRay = static_cast<double>(tracer.traffic().states) / static_cast<double>(rays.crossed);
  }
  return perRay;
}

TEST(MediumParts, HaveEachLeafOnceAndAsManyBytes)
{
  const Traced<float> traced({ std::make_shared<BallsSource>(threeBalls(3e-4)) });
  const MediumTree<float>& tree = *traced.medium.tree;
  const auto perBrick = static_cast<std::size_t>(tree.samplesPerBrick());
  constexpr std::int32_t count = 5;
  const MediumParts<float> parts(tree, count);
  std::size_t bricks = 0, least = tree.leaves().size(), most = 0;
  std::int32_t last = 0;
  for (std::size_t n = 0; n < tree.leaves().size(); ++n)
  {
    const std::int32_t owner = parts.ownerOf(static_cast<std::int32_t>(n));
    EXPECT_EQ(owner == MediumParts<float>::everywhere, tree.leaves()[n].brick == 0);
    EXPECT_GE(owner < 0 ? last : owner, last) << "no longer in the order of leaves";
    last = std::max(last, owner);
  }
  for (std::int32_t owner = 0; owner < count; ++owner)
  {
    const MediumParts<float>::Part part = parts.part(owner);
    std::size_t own = 0;
    for (std::size_t n = 0; n < part.leaves.size(); ++n)
    {
      const Leaf<float>& here = part.leaves[n];
      const Leaf<float>& leaf = tree.leaves()[n];
      const bool isOwn = parts.ownerOf(static_cast<std::int32_t>(n)) == owner;
      EXPECT_EQ(here.isResident(), isOwn || leaf.brick == 0);
      EXPECT_EQ(here.perIndex, leaf.perIndex);
      if (isOwn)
      {
        ++own;
        EXPECT_TRUE(
          std::equal(part.samples.begin() + here.brick * static_cast<std::ptrdiff_t>(perBrick),
            part.samples.begin() + (here.brick + 1) * static_cast<std::ptrdiff_t>(perBrick),
            tree.samples().begin() + leaf.brick * static_cast<std::ptrdiff_t>(perBrick)));
      }
      else if (!here.isResident())
      {
        EXPECT_EQ(~here.brick, parts.ownerOf(static_cast<std::int32_t>(n)));
      }
    }
    EXPECT_LE(part.samples.size(), (own + 2) * perBrick);
    bricks += own;
    least = std::min(least, own);
    most = std::max(most, own);
  }
  EXPECT_EQ(bricks, static_cast<std::size_t>(traced.medium.tree->statistics().bricks));
  EXPECT_GT(least, 10u);
  EXPECT_LE(most - least, 1u);
}

TEST(Distributed, IsTheSameToTheLastBitThroughManyParts)
{
  Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  for (const Interpolation interpolation : allInterpolations)
  {
    SCOPED_TRACE(name(interpolation));
    setting.interpolation = interpolation;
    EXPECT_GT(expectSame(Traced<float>(setting)), 1.5);
  }
  setting.interpolation = Interpolation::Quadratic;
  EXPECT_GT(expectSame(Traced<double>(setting)), 1.5);
  setting.path = PathModel::Straight;
  EXPECT_GT(expectSame(Traced<float>(setting)), 1.5);
}

TEST(Distributed, TakesAlongWhatRaysGather)
{
  Setting setting{ std::make_shared<SourceWithFields>(
    std::make_shared<BallsSource>(threeBalls(3e-4)),
    std::vector<FieldFormula>{ ballField({ 0.1, 0, 0 }, 0.3), ballField({ -0.2, 0.3, 0 }, 0.1) }) };
  setting.fields = 2;
  const Traced<float> traced(setting);
  EXPECT_GT(*std::max_element(traced.alone.gathered.begin(), traced.alone.gathered.end()), 0.1f);
  expectSame(traced, 2);
}

// Along the sides of leaves, where rounding decides which leaf a step is in.
TEST(Distributed, IsTheSameAlongTheSidesOfLeaves)
{
  Setting setting{ std::make_shared<BallsSource>(
    std::vector<Ball>{ { { 0, 0, 0 }, 0.3, 1e-2 } }, 1, 0.05) };
  for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ 1, 0, 0 }, Vector{ 1, 1, 0 } })
  {
    setting.direction = direction;
    setting.path = PathModel::Refracted;
    expectSame(Traced<float>(setting));
    setting.path = PathModel::Straight;
    expectSame(Traced<float>(setting));
  }
}

TEST(Distributed, FollowsRaysThatComeBack)
{
  const Traced<float> traced({ std::make_shared<GlassSource>() });
  EXPECT_GT(traced.count(RayFate::Turned) + traced.count(RayFate::Trapped), 0);
  EXPECT_GT(traced.count(RayFate::Left), 0);
  EXPECT_GT(expectSame(traced), 1.5);
}

TEST(Distributed, EndsRaysInWalls)
{
  Setting setting{ std::make_shared<SphereSource>(2) };
  setting.tolerance = 0.1;
  for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
  {
    setting.path = path;
    const Traced<float> traced(setting);
    EXPECT_GT(traced.count(RayFate::Blocked), 100);
    EXPECT_GT(traced.count(RayFate::Left), 100);
    expectSame(traced);
  }
}

TEST(Distributed, ResumesAfterPauses)
{
  const Traced<float> traced({ std::make_shared<BallsSource>(threeBalls(3e-2)) });
  Worker one, other;
  DistributedTracer<float> tracer(traced.medium);
  TracedPass rays;
  rays.resize(traced.pass, 0);
  const Monitor atOnce{ {}, {}, [] { return true; } };
  const Pass pass = traced.pass;
  int calls = 1;
  while (!tracer.trace(traced.task, pass, { one.channel(), other.channel() }, rays, 1, atOnce) &&
    calls < 1000)
  {
    ++calls;
  }
  expectSameRays(rays, traced.alone);
  EXPECT_LT(calls, 1000);
}

TEST(Distributed, SaysWhichRankDoesNotAnswer)
{
  const Traced<float> traced({ std::make_shared<BallsSource>(threeBalls(3e-2)) });
  for (const Worker::Fault fault : { Worker::Fault::Leaves, Worker::Fault::LosesEverything })
  {
    Worker good, faulty(fault, 2);
    DistributedTracer<float> tracer(traced.medium);
    TracedPass rays;
    rays.resize(traced.pass, 0);
    try
    {
      tracer.trace(traced.task, traced.pass, { good.channel(), faulty.channel() }, rays, 1, {});
      FAIL() << "no error";
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find("Rank 2"), std::string::npos) << error.what();
    }
  }
}

} // namespace

} // namespace schlieren
