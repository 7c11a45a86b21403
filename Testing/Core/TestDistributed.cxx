// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rays through a medium of which each process has a part: the processes are threads that know each other by messages
// alone.
#include "AnalyticSources.h"
#include "ClosedForms.h"
#include "Fields.h"
#include "PeakMemory.h"
#include "Rays/DistributedTracer.h"
#include "RaysInTree.h"
#include "SameImage.h"
#include "WorkerThread.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

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

/// What rays have gathered, to `tolerance` of the most.
void expectCloseSums(const TracedPass& a, const TracedPass& b, double tolerance)
{
  ASSERT_EQ(a.gathered.size(), b.gathered.size());
  const float most =
    b.gathered.empty() ? 0 : *std::max_element(b.gathered.begin(), b.gathered.end());
  for (std::size_t n = 0; n < a.gathered.size(); ++n)
  {
    EXPECT_NEAR(a.gathered[n], b.gathered[n], tolerance * static_cast<double>(most)) << n;
  }
}

/// Workers, and a tree that they have parts of.
template <class Real>
struct Team
{
  Team(const Setting& setting, std::size_t count, Worker::Fault fault = Worker::Fault::None,
    int after = 0)
  {
    while (workers.size() < count)
    {
      workers.push_back(std::make_unique<Worker>(fault, after));
      channels.push_back(workers.back()->channel());
    }
    owners = std::make_shared<BrickChannels>(channels);
    traced.emplace(setting, owners);
  }

  std::vector<std::unique_ptr<Worker>> workers;
  std::vector<Channel*> channels;
  std::shared_ptr<BrickChannels> owners;
  std::optional<Traced<Real>> traced;

  const MediumTree<Real>& tree() const { return *traced->medium.tree; }
};

/// To the last bit for several numbers of processes, and to `tolerance` of the largest deflection as by one that has all.
/// Returns how often rays have continued in another part, per ray.
template <class Real>
double expectSame(const Setting& setting, const Traced<Real>& alone, double tolerance = 1e-6,
  Simd simd = bestSimd(), int stepsApart = 0)
{
  TracedPass expected;
  alone.traceAlone(expected, simd);
  double perRay = 0;
  for (const std::size_t count : { 0u, 1u, 2u, 6u })
  {
    SCOPED_TRACE(count);
    const Team<Real> team(setting, count);
    const auto ofTeam = team.tree().statistics(), ofOne = alone.medium.tree->statistics();
    EXPECT_EQ(ofTeam.bricks, ofOne.bricks);
    EXPECT_EQ(ofTeam.largestDeflection, ofOne.largestDeflection);
    EXPECT_NEAR(ofTeam.estimatedError, ofOne.estimatedError, 1e-5 * ofOne.estimatedError);
    DistributedTracer<Real> tracer(team.traced->medium, *team.owners);
    TracedPass rays;
    rays.resize(team.traced->pass, team.traced->task.gradients.count);
    EXPECT_TRUE(tracer.trace(team.traced->task, team.traced->pass, rays, 2, {}, simd));
    if (count > 0)
    {
      expectSameRays(rays, expected);
    }
    else
    {
      expectCloseRays(rays, expected, tolerance, stepsApart);
      expectCloseSums(rays, expected, tolerance);
      expected = std::move(rays);
    }
    const auto& traffic = tracer.traffic();
    EXPECT_EQ(traffic.amongWorkers.states > 0, count > 1);
    perRay = static_cast<double>(traffic.own.states + traffic.amongWorkers.states) /
      static_cast<double>(rays.crossed);
  }
  return perRay;
}
template <class Real = float>
double expectSame(const Setting& setting, Simd simd = bestSimd())
{
  return expectSame(setting, Traced<Real>(setting), 1e-6, simd);
}

TEST(DistributedTree, HasEachBrickOnce)
{
  const Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-4)) };
  const Traced<float> alone(setting);
  constexpr std::int32_t count = 5;
  const Team<float> team(setting, count - 1);
  const MediumTree<float>& tree = team.tree();
  const std::size_t leaves = tree.leaves().size();
  ASSERT_EQ(leaves, alone.medium.tree->leaves().size());
  std::vector<std::size_t> bricks(count, 0);
  std::vector<std::set<std::int32_t>> numbers(count);
  for (std::int32_t owner = 0; owner < count; ++owner)
  {
    const std::vector<Leaf<float>> here = tree.leavesOf(owner);
    for (std::size_t n = 0; n < leaves; ++n)
    {
      const Leaf<float>& leaf = alone.medium.tree->leaves()[n];
      const std::int32_t of = tree.ownerOf(static_cast<std::int32_t>(n));
      EXPECT_EQ(here[n].isResident(), of == owner || leaf.brick == 0);
      EXPECT_EQ(here[n].perIndex, leaf.perIndex);
      if (!here[n].isResident())
      {
        EXPECT_EQ(~here[n].brick, of);
      }
      else if (here[n].brick > 0)
      {
        ++bricks[static_cast<std::size_t>(owner)];
        EXPECT_TRUE(numbers[static_cast<std::size_t>(owner)].insert(here[n].brick).second);
      }
    }
  }
  const auto all = static_cast<std::size_t>(tree.statistics().bricks);
  EXPECT_EQ(std::accumulate(bricks.begin(), bricks.end(), std::size_t{ 0 }), all);
  EXPECT_LT(
    *std::max_element(bricks.begin(), bricks.end()), 1.35 * static_cast<double>(all) / count);
  EXPECT_LT(
    tree.samples().size(), 1.35 * static_cast<double>(alone.medium.tree->samples().size()) / count);
}

// A limit of memory is that of each process.
TEST(DistributedTree, IsFinerWhereMoreProcessesHaveIt)
{
  Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-4)) };
  setting.tolerance = 1e-4;
  setting.memory = std::size_t{ 2 } << 20;
  const Traced<float> alone(setting);
  const Team<float> team(setting, 3);
  const auto ofTeam = team.tree().statistics(), ofOne = alone.medium.tree->statistics();
  EXPECT_LT(ofOne.bytes, 2 << 20);
  EXPECT_GT(ofTeam.bytes, 3 * ofOne.bytes);
  EXPECT_LT(ofTeam.bytes, 8 << 20);
  EXPECT_LT(ofTeam.estimatedError, ofOne.estimatedError);
  EXPECT_LT(team.tree().samples().size() * sizeof(float), 1.35 * (2 << 20));
}

TEST(Distributed, IsTheSameToTheLastBitThroughManyParts)
{
  Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  for (const Interpolation interpolation : allInterpolations)
  {
    SCOPED_TRACE(name(interpolation));
    setting.interpolation = interpolation;
    EXPECT_GT(expectSame<float>(setting), 1.5);
  }
  setting.interpolation = Interpolation::Quadratic;
  for (const Simd simd : { Simd::None, Simd::Four, Simd::Avx2, Simd::Avx512, Simd::Avx512Rows })
  {
    SCOPED_TRACE(static_cast<int>(simd));
    if (hasSimd(simd))
    {
      EXPECT_GT(expectSame<float>(setting, simd), 1.5);
    }
  }
  EXPECT_GT(expectSame<double>(setting), 1.5);
  setting.path = PathModel::Straight;
  EXPECT_GT(expectSame<float>(setting), 1.5);
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
    expectSame<float>(setting);
    setting.path = PathModel::Straight;
    expectSame<float>(setting);
  }
}

TEST(Distributed, IsTheSameWhereNothingDependsOnDepth)
{
  Setting setting{ std::make_shared<FlatSource>(
    std::vector<Ball>{ { { -0.1, 0.05, 0 }, 0.25, 1e-3 }, { { 0.42, -0.31, 0 }, 0.05, 5e-4 } }) };
  EXPECT_GT(expectSame<float>(setting), 0.5);
  setting.direction = { 0, 0, -1 };
  expectSame<float>(setting);
}

// Of fields with gradients where nothing bends light, too.
TEST(Distributed, GathersFieldsInAllParts)
{
  for (const bool hasWalls : { false, true })
  {
    std::shared_ptr<const MediumSource> medium = std::make_shared<BallsSource>(threeBalls(3e-2));
    Setting setting;
    if (hasWalls)
    {
      medium = std::make_shared<SphereSource>(2);
      setting.tolerance = 0.5;
      setting.finest = 0.04;
    }
    setting.source = std::make_shared<SourceWithFields>(medium,
      std::vector<FieldFormula>{
        ballField({ 0.5, 0.4, -0.3 }, 0.3), linearField({ 0.2, 0, -0.1 }) });
    const Traced<float> alone(setting);
    EXPECT_GT(expectSame(setting, alone), 1.5);
    const Team<float> team(setting, 2);
    TracedPass rays;
    rays.resize(team.traced->pass, 2);
    DistributedTracer<float>(team.traced->medium, *team.owners)
      .trace(team.traced->task, team.traced->pass, rays, 1, {});
    for (const std::size_t field : { 0u, 1u })
    {
      float most = 0;
      for (std::size_t n = field; n < rays.gathered.size(); n += 2)
      {
        most = std::max(most, rays.gathered[n]);
      }
      EXPECT_GT(most, 0.1);
    }
  }
}

TEST(Distributed, FollowsRaysThatComeBack)
{
  const Setting setting{ std::make_shared<GlassSource>() };
  const Traced<float> alone(setting);
  EXPECT_GT(alone.count(RayFate::Turned), 0);
  EXPECT_GT(alone.count(RayFate::Left), 0);
  // They come near to total reflection, where little makes much.
  EXPECT_GT(expectSame(setting, alone, 1e-4), 1.5);
}

TEST(Distributed, EndsRaysInWalls)
{
  Setting setting{ std::make_shared<SphereSource>(2) };
  setting.tolerance = 0.5;
  setting.finest = 0.04;
  for (const PathModel path : { PathModel::Refracted, PathModel::Straight })
  {
    setting.path = path;
    const Traced<float> alone(setting);
    EXPECT_GT(alone.count(RayFate::Blocked), 100);
    EXPECT_GT(alone.count(RayFate::Left), 100);
    expectSame(setting, alone);
  }
}

constexpr Integrator integratorsBeyond[] = { Integrator::Rk4, Integrator::Adaptive,
  Integrator::Euler };

/// Rounding decides which steps Adaptive takes, and is what Euler's momentum is off by: they are compared closely where rays are
/// traced one by one only.
Simd simdToCompareWith(Integrator integrator)
{
  return integrator == Integrator::Rk4 ? bestSimd() : Simd::None;
}

// Of nearly each step between two leaves a sample is in the other one, by Euler of every second: its start.
TEST(Distributed, TakesStepsThatLookIntoOtherParts)
{
  Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  const double usual = expectSame<float>(setting);
  for (const Integrator integrator : integratorsBeyond)
  {
    SCOPED_TRACE(name(integrator));
    const double more = integrator == Integrator::Euler ? 1.3 : 2;
    const Simd simd = simdToCompareWith(integrator);
    setting.integrator = integrator;
    EXPECT_GT(expectSame<float>(setting, simd), more * usual);
    EXPECT_GT(expectSame<double>(setting, simd), more * usual);
    if (simd != bestSimd())
    {
      expectSame(setting, Traced<float>(setting), 1e-4, bestSimd(), 20);
    }
  }
  setting.integrator = Integrator::Rk4;
  for (const Interpolation interpolation : { Interpolation::Linear, Interpolation::Cubic })
  {
    SCOPED_TRACE(name(interpolation));
    setting.interpolation = interpolation;
    expectSame<float>(setting);
  }
}

TEST(Distributed, TakesSuchStepsNearWallsAndInFlatData)
{
  for (const Integrator integrator : integratorsBeyond)
  {
    SCOPED_TRACE(name(integrator));
    Setting walls{ std::make_shared<SphereSource>(2) };
    walls.tolerance = 0.5;
    walls.finest = 0.04;
    walls.integrator = integrator;
    const Traced<float> alone(walls);
    EXPECT_GT(alone.count(RayFate::Blocked), 100);
    EXPECT_GT(alone.count(RayFate::Left), 100);
    const Simd simd = simdToCompareWith(integrator);
    expectSame(walls, alone, 1e-6, simd);

    Setting flat{ std::make_shared<FlatSource>(
      std::vector<Ball>{ { { -0.1, 0.05, 0 }, 0.25, 1e-3 }, { { 0.42, -0.31, 0 }, 0.05, 5e-4 } }) };
    flat.integrator = integrator;
    expectSame<float>(flat, simd);

    Setting sides{ std::make_shared<BallsSource>(
      std::vector<Ball>{ { { 0, 0, 0 }, 0.3, 1e-2 } }, 1, 0.05) };
    sides.integrator = integrator;
    for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ 1, 1, 0 } })
    {
      sides.direction = direction;
      expectSame<float>(sides, simd);
    }
  }
}

TEST(Distributed, TakesSuchStepsBackAndThroughFields)
{
  for (const Integrator integrator : integratorsBeyond)
  {
    SCOPED_TRACE(name(integrator));
    Setting glass{ std::make_shared<GlassSource>() };
    glass.integrator = integrator;
    const Traced<float> alone(glass);
    EXPECT_GT(alone.count(RayFate::Turned), 0);
    const Simd simd = simdToCompareWith(integrator);
    expectSame(glass, alone, 1e-4, simd);

    Setting fields{ std::make_shared<SourceWithFields>(
      std::make_shared<BallsSource>(threeBalls(3e-2)),
      std::vector<FieldFormula>{
        ballField({ 0.5, 0.4, -0.3 }, 0.3), linearField({ 0.2, 0, -0.1 }) }) };
    fields.integrator = integrator;
    expectSame<float>(fields, simd);
  }
}

TEST(Distributed, ResumesAfterPauses)
{
  const Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  const Team<float> team(setting, 2);
  DistributedTracer<float> tracer(team.traced->medium, *team.owners);
  const Pass pass = team.traced->pass;
  TracedPass expected, rays;
  expected.resize(pass, 0);
  rays.resize(pass, 0);
  ASSERT_TRUE(tracer.trace(team.traced->task, pass, expected, 1, {}));
  std::int64_t questions = 0;
  const Monitor often{ {}, {}, [&] { return ++questions % 3 == 0; } };
  constexpr int most = 1000;
  int calls = 1;
  while (!tracer.trace(team.traced->task, pass, rays, 1, often) && calls < most)
  {
    ++calls;
  }
  EXPECT_LT(calls, most);
  expectSameRays(rays, expected);
}

/// Traces often enough for any fault to show.
void traceOften(const Traced<float>& traced, const BrickChannels& owners)
{
  DistributedTracer<float> tracer(traced.medium, owners);
  for (int again = 0; again < 100; ++again)
  {
    TracedPass rays;
    rays.resize(traced.pass, 0);
    tracer.trace(traced.task, traced.pass, rays, 1, {});
  }
}

void expectErrorAbout(const std::string& rank, const std::function<void()>& work)
{
  try
  {
    work();
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find(rank), std::string::npos) << error.what();
  }
}

TEST(Distributed, SaysWhichRankDoesNotAnswer)
{
  const Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  for (const Worker::Fault fault : { Worker::Fault::Leaves, Worker::Fault::LosesEverything })
  {
    for (const int after : { 0, 3, 12 }) // before there is a tree, while it is made, and later
    {
      SCOPED_TRACE(testing::Message() << static_cast<int>(fault) << " after " << after);
      expectErrorAbout("Rank 1 ",
        [&]
        {
          const Team<float> team(setting, 1, fault, after);
          traceOften(*team.traced, *team.owners);
        });
    }
  }
}

// While others hand on rays to it.
TEST(Distributed, SaysWhichOfManyRanksDoesNotAnswer)
{
  const Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  for (const Worker::Fault fault : { Worker::Fault::Leaves, Worker::Fault::LosesEverything })
  {
    SCOPED_TRACE(static_cast<int>(fault));
    Worker first, third, faulty(fault, 30);
    const auto owners = std::make_shared<BrickChannels>(
      std::vector<Channel*>{ first.channel(), faulty.channel(), third.channel() });
    const Traced<float> traced(setting, owners);
    expectErrorAbout("Rank 2 ", [&] { traceOften(traced, *owners); });
  }
}

/// A worker in this thread, which works whenever somebody looks for messages. The messages of a trace may come late to it.
class LateWorker : public Channel
{
  Mail answers_, requests_;

public:
  explicit LateWorker(bool isLate = false)
    : isLate_(isLate)
  {
  }

  void send(std::vector<char> message) override
  {
    isHeld_ = isHeld_ || (isLate_ && RayWorker::kindOf(message) == RayWorker::BeginRays);
    isHeld_ ? held_.push_back(std::move(message)) : worker.answer(std::move(message), there_, 1);
  }
  bool hasMessage() override
  {
    if (!isStuck)
    {
      const bool hasWorked = worker.advance(there_, peers, 1);
      raysBeforeBegin += hasWorked && isHeld_ ? 1 : 0;
      if (isHeld_ && (hasWorked || ++polls_ > 1000))
      {
        isHeld_ = isLate_ = false;
        for (std::vector<char>& message : std::exchange(held_, {}))
        {
          worker.answer(std::move(message), there_, 1);
        }
      }
    }
    return !answers_.isEmpty();
  }
  std::vector<char> receive() override { return answers_.take(); }
  bool isOpen() const override { return isOpenNow; }
  std::int32_t address() const override { return peers.address(); }

  RayWorker worker;
  PeerThread peers{ requests_ };
  int raysBeforeBegin = 0; ///< how often others' have come
  bool isStuck = false;    ///< takes no rays further
  std::atomic<bool> isOpenNow{ true };

private:
  End there_{ answers_, requests_, isOpenNow, 0 };
  std::deque<std::vector<char>> held_;
  bool isLate_, isHeld_ = false;
  int polls_ = 0;
};

// One worker hands on rays to another that does not know the trace yet.
TEST(Distributed, RaysMayComeBeforeTheirTrace)
{
  const Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  const Team<float> team(setting, 2);
  DistributedTracer<float> tracer(team.traced->medium, *team.owners);
  TracedPass expected, rays;
  expected.resize(team.traced->pass, 0);
  ASSERT_TRUE(tracer.trace(team.traced->task, team.traced->pass, expected, 1, {}));

  LateWorker first, late(true);
  const auto owners = std::make_shared<BrickChannels>(std::vector<Channel*>{ &first, &late });
  const Traced<float> traced(setting, owners);
  DistributedTracer<float> again(traced.medium, *owners);
  rays.resize(traced.pass, 0);
  ASSERT_TRUE(again.trace(traced.task, traced.pass, rays, 1, {}));
  EXPECT_EQ(late.raysBeforeBegin, 1);
  expectSameRays(rays, expected);
}

TEST(Distributed, RaysOfATraceThatHasFailedAreForgotten)
{
  const Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  LateWorker worker;
  const auto owners = std::make_shared<BrickChannels>(std::vector<Channel*>{ &worker });
  const Traced<float> traced(setting, owners);
  DistributedTracer<float> tracer(traced.medium, *owners);
  worker.isStuck = true;
  int questions = 0;
  const Monitor leaves{ {},
    [&]
    {
      worker.isOpenNow = ++questions < 10;
      return false;
    },
    {} };
  TracedPass rays;
  rays.resize(traced.pass, 0);
  EXPECT_THROW(tracer.trace(traced.task, traced.pass, rays, 1, leaves), Error);
  EXPECT_TRUE(worker.worker.advance(worker, worker.peers, 1));
  worker.worker.endTrace();
  EXPECT_FALSE(worker.worker.advance(worker, worker.peers, 1));
}

Scene sceneOf(DistributedMedium distribution)
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = static_cast<int>(Traced<float>::width);
  scene.view.height = static_cast<int>(Traced<float>::height);
  scene.view.viewDirection = { 0.3, -0.5, -0.8 };
  scene.cutoff = Cutoff::KnifeEdge;
  scene.samplesPerPixel = 2;
  scene.threads = 1;
  scene.distributedMedium = distribution;
  return scene;
}

/// Of two images: of the largest deflection, the mean and the largest difference.
std::pair<double, double> differenceOf(const Image& a, const Image& b)
{
  EXPECT_EQ(a.deflection.size(), b.deflection.size());
  double largest = 0, worst = 0, sum = 0;
  for (std::size_t n = 0; n < a.deflection.size(); ++n)
  {
    const double difference =
      std::abs(static_cast<double>(a.deflection[n]) - static_cast<double>(b.deflection[n]));
    largest = std::max(largest, std::abs(static_cast<double>(a.deflection[n])));
    worst = std::max(worst, difference);
    sum += difference;
  }
  return { sum / static_cast<double>(a.deflection.size()) / largest, worst / largest };
}

struct BenchOfTeam
{
  explicit BenchOfTeam(std::size_t count)
  {
    while (workers.size() < count)
    {
      workers.push_back(std::make_unique<Worker>());
      channels.push_back(workers.back()->channel());
    }
    bench.setWorkers(channels);
  }
  std::vector<std::unique_ptr<Worker>> workers;
  std::vector<Channel*> channels;
  Bench bench;
};

TEST(DistributedImage, IsThatOfOneProcess)
{
  const Field field = fieldOf(std::make_shared<BallsSource>(threeBalls(3e-4)));
  for (const PathModel path : { PathModel::Refracted, PathModel::Straight, PathModel::Auto })
  {
    Scene scene = sceneOf(DistributedMedium::On);
    scene.pathModel = path;
    const Image alone = Bench().render(field, scene);
    EXPECT_EQ(alone.medium.processes, 1);
    BenchOfTeam team(3);
    const Image image = team.bench.render(field, scene);
    EXPECT_EQ(image.medium.processes, 4);
    EXPECT_EQ(image.medium.bricks, alone.medium.bricks);
    EXPECT_EQ(image.raysTraced, alone.raysTraced);
    EXPECT_EQ(image.blockedFraction, alone.blockedFraction);
    const auto [mean, worst] = differenceOf(alone, image);
    EXPECT_LT(mean, 1e-7);
    EXPECT_LT(worst, 1e-6);
    // Another view, with pauses.
    scene.view.viewDirection = { -0.1, 0.2, -1 };
    const Image other = Bench().render(field, scene);
    const Monitor atOnce{ {}, {}, [] { return true; } };
    Image paused = team.bench.render(field, scene, atOnce);
    int calls = 1;
    for (; !paused.finished && calls < 10000; ++calls)
    {
      paused = team.bench.resume(atOnce);
    }
    EXPECT_GT(calls, 2);
    EXPECT_EQ(paused.medium.processes, 4);
    EXPECT_LT(differenceOf(other, paused).second, 1e-6);
  }
}

TEST(DistributedImage, IsThatOfOneProcessByAllIntegrators)
{
  const Field field = fieldOf(std::make_shared<BallsSource>(threeBalls(3e-4)));
  Scene scene = sceneOf(DistributedMedium::On);
  scene.pathModel = PathModel::Refracted;
  BenchOfTeam team(3);
  for (const Integrator integrator : integratorsBeyond)
  {
    SCOPED_TRACE(name(integrator));
    scene.integrator = integrator;
    const Image alone = Bench().render(field, scene), image = team.bench.render(field, scene);
    EXPECT_EQ(image.medium.processes, 4);
    EXPECT_EQ(image.medium.bricks, alone.medium.bricks);
    EXPECT_EQ(image.raysTraced, alone.raysTraced);
    // See simdToCompareWith().
    const double allowed = integrator == Integrator::Rk4 ? 1e-6
      : integrator == Integrator::Adaptive               ? 2e-5
                                                         : 1e-4;
    EXPECT_LT(differenceOf(alone, image).second, allowed);
  }
}

TEST(DistributedImage, IsDistributedWhereThatIsWorthIt)
{
  const Field field = fieldOf(std::make_shared<BallsSource>(threeBalls(3e-4)));
  Scene scene = sceneOf(DistributedMedium::Auto);
  scene.mediumTolerance = 1e-3;
  BenchOfTeam team(3);
  const Image enough = team.bench.render(field, scene);
  EXPECT_EQ(enough.medium.processes, 1);
  EXPECT_FALSE(enough.medium.isMemoryShort);
  scene.mediumMemory = static_cast<std::size_t>(enough.medium.bytes / 2);
  const Image alone = Bench().render(field, scene);
  EXPECT_TRUE(alone.medium.isMemoryShort);
  const Image image = team.bench.render(field, scene);
  EXPECT_EQ(image.medium.processes, 4);
  EXPECT_FALSE(image.medium.isMemoryShort);
  EXPECT_EQ(image.medium.bricks, enough.medium.bricks);
  EXPECT_LT(differenceOf(enough, image).second, 1e-6);
  scene.distributedMedium = DistributedMedium::Off;
  expectSameImage(team.bench.render(field, scene), alone);
}

TEST(DistributedImage, IsThatOfAllProcessesWhereGridsCannotBeDistributed)
{
  const Scene scene = sceneOf(DistributedMedium::On);
  BenchOfTeam team(2);
  const BlobWithHole flow;
  expectSameImage(team.bench.render(flow.field, scene), Bench().render(flow.field, scene));
}

TEST(DistributedImage, HasTheColoursOfFields)
{
  Field field =
    fieldOf(std::make_shared<SourceWithFields>(std::make_shared<BallsSource>(threeBalls(3e-4)),
      std::vector<FieldFormula>{ ballField({ 0.1, 0, 0 }, 0.3), linearField({ 0, 0.1, 0 }) }));
  field.gradients.count = 2;
  Scene scene = sceneOf(DistributedMedium::On);
  scene.fieldColors = { { 1, 0, 0 }, { 0, 0, 1 } };
  BenchOfTeam team(2);
  const Image image = team.bench.render(field, scene), alone = Bench().render(field, scene);
  EXPECT_EQ(image.medium.processes, 3);
  EXPECT_EQ(image.medium.bricks, alone.medium.bricks);
  EXPECT_LT(differenceOf(alone, image).second, 1e-6);
  ASSERT_FALSE(image.color.empty());
  ASSERT_EQ(image.color.size(), alone.color.size());
  float largest = 0;
  for (std::size_t n = 0; n < image.color.size(); ++n)
  {
    largest = std::max(largest, std::abs(image.color[n] - alone.color[n]));
  }
  EXPECT_LT(largest, 1e-5);
}

TEST(DistributedImage, MayHaveFewerBricksThanProcesses)
{
  const Field field =
    fieldOf(std::make_shared<BallsSource>(std::vector<Ball>{ { { 0, 0, 0 }, 0.5, 1e-4 } }, 1, 1));
  Scene scene = sceneOf(DistributedMedium::On);
  scene.mediumTolerance = 1;
  BenchOfTeam team(80);
  const Image image = team.bench.render(field, scene);
  EXPECT_EQ(image.medium.processes, 81);
  EXPECT_LT(image.medium.bricks, 80);
  EXPECT_LT(differenceOf(Bench().render(field, scene), image).second, 1e-6);
}

/// Wherever that was.
TEST(DistributedImage, IsMadeAnewAfterMemoryWasLacking)
{
  const Field field = fieldOf(std::make_shared<BallsSource>(threeBalls(3e-4)));
  Scene scene = sceneOf(DistributedMedium::On);
  scene.view.width = scene.view.height = 8;
  scene.mediumTolerance = 0.3;
  BenchOfTeam team(2);
  const Image expected = team.bench.render(field, scene);
  EXPECT_EQ(expected.medium.processes, 3);
  int failures = 0;
  for (int number = 0; number < 10000; number += number < 40 ? 1 : number / 2)
  {
    Bench bench;
    bench.setWorkers(team.channels);
    try
    {
      const FailingAllocation failing(number);
      bench.render(field, scene);
    }
    catch (const std::bad_alloc&)
    {
      ++failures;
    }
    EXPECT_LT(differenceOf(expected, bench.render(field, scene)).second, 1e-6) << number;
  }
  EXPECT_GT(failures, 30);
}

TEST(DistributedImage, IsMadeAnewAfterAFault)
{
  const Field field = fieldOf(std::make_shared<BallsSource>(threeBalls(3e-4)));
  const Scene scene = sceneOf(DistributedMedium::On);
  const auto media = std::make_shared<SharedMedia>();
  Worker good, faulty(Worker::Fault::LosesEverything, 5);
  Bench bench;
  bench.setMedia(media);
  bench.setWorkers({ good.channel(), faulty.channel() });
  EXPECT_THROW(bench.render(field, scene), Error);
  Worker another;
  bench.setWorkers({ good.channel(), another.channel() });
  const Image image = bench.render(field, scene);
  EXPECT_EQ(image.medium.processes, 3);
  EXPECT_EQ(media->count(), 0);
  EXPECT_LT(differenceOf(Bench().render(field, scene), image).second, 1e-6);
}

} // namespace

} // namespace schlieren
