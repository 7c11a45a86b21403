// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trees in little memory, in pieces and of several processes; what else holds of any tree.
#include "Fields.h"
#include "Messages.h"
#include "SameTree.h"
#include "Trees.h"

#include "Medium/Tree/BrickMakers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

TEST(MediumTree, MemoryIsBounded)
{
  const auto source =
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0.11, -0.23, 0.07 }, 0.05, 1e-4 } });
  constexpr double tolerance = 1e-3; // of a tenth of the largest: the ball is small in the image
  Tree enough(source, 0, settingsOf(tolerance));
  enough.refine(everything());
  const auto needed = static_cast<double>(enough.statistics().bytes);
  EXPECT_LE(statedError(enough.statistics()), 3e-4);
  double before = 10;
  for (const double part : { 0.1, 0.2, 0.4, 0.9 })
  {
    TreeSettings settings = settingsOf(tolerance);
    settings.memory = static_cast<std::size_t>(part * needed);
    Tree tree(source, 0, settings);
    tree.refine(everything());
    EXPECT_LE(static_cast<double>(tree.statistics().bytes), part * needed);
    const auto ofDivision = static_cast<double>(8 * tree.samplesPerBrick()) * sizeof(float);
    EXPECT_GE(static_cast<double>(tree.statistics().bytes), 0.93 * part * needed - ofDivision);
    EXPECT_GT(statedError(tree.statistics()), 0.99 * statedError(enough.statistics()));
    const double error = errorOfMost(tree, *source, Interpolation::Quadratic, x, y, 1);
    EXPECT_LT(error, 3 * statedError(tree.statistics()));
    EXPECT_LT(statedError(tree.statistics()), 1.01 * before);
    EXPECT_TRUE(
      part > 0.2 || statedError(tree.statistics()) > 3 * statedError(enough.statistics()));
    before = statedError(tree.statistics());
    EXPECT_FALSE(tree.refine(everything()));
  }
}

TEST(MediumTree, MemoryGoesToTheLastView)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  Tree alone(source, 0, settingsOf(1e-4));
  alone.refine(around(-0.1, 0.05, 0.3));
  TreeSettings settings = settingsOf(1e-4);
  settings.memory = static_cast<std::size_t>(1.2 * static_cast<double>(alone.statistics().bytes));
  Tree tree(source, 0, settings);
  tree.refine(around(0.42, -0.31, 0.3));
  tree.refine(around(-0.1, 0.05, 0.3));
  EXPECT_LE(tree.statistics().bytes, static_cast<std::int64_t>(settings.memory));
  EXPECT_LE(statedError(tree.statistics()), 1.1 * statedError(alone.statistics()));
  const Vec3<double> first{ -0.1, 0.05, 0.02 };
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, x, y, 0.3, first),
    1.1 * worstError(alone, *source, Interpolation::Quadratic, x, y, 0.3, first));
  // And back again.
  tree.refine(around(0.42, -0.31, 0.3));
  EXPECT_LE(tree.statistics().bytes, static_cast<std::int64_t>(settings.memory));
  EXPECT_LT(
    worstError(tree, *source, Interpolation::Quadratic, x, y, 0.1, { 0.42, -0.31, 0.2 }), 2e-3);
}

TEST(MediumTree, BoundsHold)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  for (const Interpolation interpolation : allInterpolations)
  {
    TreeSettings settings = settingsOf(1e-2);
    settings.interpolation = interpolation;
    Tree tree(source, 0, settings);
    tree.refine(everything());
    std::mt19937 random(4);
    std::normal_distribution<double> near(0, 0.03);
    double largest = 0;
    Vec3<double> slope{ 0, 0, 0 };
    const std::vector<Ball> balls = threeBalls(1e-4);
    for (int n = 0; n < 20000; ++n)
    {
      const Ball& ball = balls[static_cast<std::size_t>(n % 3)];
      const Sample<double> sample = sampleAt(tree, interpolation,
        { ball.centre[0] + near(random), ball.centre[1] + near(random),
          ball.centre[2] + near(random) });
      largest = std::max(largest, std::abs(sample.value));
      slope = { std::max(slope.x, std::abs(sample.gradient.x)),
        std::max(slope.y, std::abs(sample.gradient.y)),
        std::max(slope.z, std::abs(sample.gradient.z)) };
    }
    const Grid& grid = tree.grid();
    const double rounding = 1 + 1e-5;
    EXPECT_LE(largest, rounding * tree.largestNu());
    EXPECT_LE(slope.x * grid.spacing[0], rounding * tree.slope().x);
    EXPECT_LE(slope.y * grid.spacing[1], rounding * tree.slope().y);
    EXPECT_LE(slope.z * grid.spacing[2], rounding * tree.slope().z);
    EXPECT_LT(tree.largestNu(), 1.1e-4);
    EXPECT_LT(tree.slope().x, 3 * slope.x * grid.spacing[0]);
    EXPECT_NEAR(tree.rangeOfNu(), 1.75e-4, 1e-9); // as the source says
  }
}

TEST(MediumTree, WeakFlowInGlassKeepsItsGradients)
{
  /// A weak ball on a base that is a billion times as large.
  class Offset : public BallsSource
  {
  public:
    using BallsSource::BallsSource;
    double refractivity(double a, double b, double c) const override
    {
      return 0.5 + BallsSource::refractivity(a, b, c);
    }
    Range rangeOver(const Box& box) const override
    {
      const Range range = BallsSource::rangeOver(box);
      return { 0.5 + range.first, 0.5 + range.second };
    }
  };
  const Ball ball{ { 0, 0, 0 }, 0.25, 1e-9 };
  const auto source = std::make_shared<Offset>(std::vector<Ball>{ ball });
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything());
  const auto truth = source->deflectionAt({ 0.2, 0, 0 }, x, y);
  const Vec3<double> bend = bendAlong(tree, Interpolation::Quadratic, { 0.2, 0, 0 }, z);
  EXPECT_NEAR(bend.x, truth[0], 2e-2 * std::abs(truth[0]));
}

TEST(MediumTree, NoSampleIsDenormal)
{
  const auto source =
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0, 0, 0 }, 0.1, 1e-8 } });
  Tree tree(source, 0, settingsOf(0));
  tree.refine(everything(x, y, 0.01));
  for (const float sample : tree.samples())
  {
    ASSERT_TRUE(sample == 0 || std::abs(sample) > 1e-30f);
  }
}

TEST(MediumTree, StopsWhereTheMonitorSaysAndContinues)
{
  const auto source = std::make_shared<SphereSource>();
  const Column column = around(0, 0, 1.5, 0.02);
  Tree whole(source, 0, settingsOf(1e-2));
  whole.refine(column);

  Tree tree(source, 0, settingsOf(1e-2));
  Monitor monitor;
  monitor.paused = [] { return true; };
  int calls = 0;
  double progress = 0;
  do
  {
    tree.refine(column, monitor);
    ASSERT_LT(++calls, 100000);
    // Whatever there is, rays can be traced in it.
    for (const Leaf<float>& leaf : tree.leaves())
    {
      ASSERT_LT(
        static_cast<std::size_t>(leaf.brick * tree.samplesPerBrick()), tree.samples().size());
    }
  } while (tree.isUnfinished());
  EXPECT_GT(calls, 10);
  EXPECT_FALSE(tree.isUnfinished());
  EXPECT_FALSE(tree.refine(column));
  expectIdentical(tree, whole);

  Tree watched(source, 0, settingsOf(1e-2));
  watched.refine(column,
    { [&](double fraction)
      {
        EXPECT_GE(fraction, progress);
        EXPECT_LE(fraction, 1);
        progress = fraction;
      },
      {}, {} });
  EXPECT_GT(progress, 0.5);
  expectIdentical(watched, whole);
}

/// A sphere that answers only what it has been prepared for, and whose bricks two processes make: here one after the other.
class RemoteSphere : public SphereSource, public BrickMakers
{
public:
  const BrickMakers* makers() const override { return this; }
  bool dependsOnLattice() const override { return true; }
  int count() const override { return 2; }
  std::vector<std::vector<char>> make(
    const BrickRules& rules, const std::vector<BrickRequest>& wanted) const override
  {
    const BrickMaker<float> maker(*this, rules);
    std::vector<std::vector<char>> made = maker.makeShare(wanted, 0, 2, 1);
    const std::vector<std::vector<char>> others = maker.makeShare(wanted, 1, 2, 2);
    for (std::size_t n = 0; n < made.size(); ++n)
    {
      EXPECT_NE(made[n].empty(), others[n].empty());
      made[n] = made[n].empty() ? others[n] : made[n];
    }
    return made;
  }
  void prepareContents(const std::vector<Box>& boxes) const override
  {
    ++requests;
    boxes_.clear();
    for (const Box& box : boxes)
    {
      boxes_.insert({ box.low, box.high });
    }
  }
  void prepareSamples(const std::vector<Lattice>& wanted) const override
  {
    if (failing)
    {
      throw std::runtime_error("lost");
    }
    lattices_.clear();
    for (const Lattice& lattice : wanted)
    {
      lattices_.insert({ lattice.first, lattice.spacing, lattice.points });
    }
  }
  Content contentOf(const Box& box) const override
  {
    const Box all = bounds();
    const bool isAll = box.low == all.low && box.high == all.high;
    EXPECT_TRUE(isAll || boxes_.count({ box.low, box.high }) > 0);
    return SphereSource::contentOf(box);
  }
  void sample(
    const Lattice& lattice, double* refractivity, Place* places, float* distances) const override
  {
    EXPECT_EQ(lattices_.count({ lattice.first, lattice.spacing, lattice.points }), 1U);
    SphereSource::sample(lattice, refractivity, places, distances);
  }

  mutable int requests = 0;
  bool failing = false;

private:
  using Place3 = std::array<double, 3>;
  mutable std::set<std::pair<Place3, Place3>> boxes_;
  mutable std::set<std::tuple<Place3, Place3, std::array<int, 3>>> lattices_;
};

TEST(MediumTree, SeveralProcessesMakeManyBricksAtOnce)
{
  const Column column = around(0, 0, 1.5, 0.02);
  Tree local(std::make_shared<SphereSource>(), 0, settingsOf(1e-2));
  local.refine(column);
  const auto remote = std::make_shared<RemoteSphere>();
  Tree tree(remote, 0, settingsOf(1e-2));
  remote->failing = true;
  EXPECT_THROW(tree.refine(column), std::runtime_error);
  EXPECT_TRUE(tree.isUnfinished());
  remote->failing = false;
  tree.refine(column);
  expectIdentical(tree, local);
  EXPECT_LT(remote->requests, static_cast<int>(local.leaves().size() / 10));
}

void expectRefusal(
  const std::shared_ptr<const MediumSource>& source, double ambient, const std::string& says)
{
  expectError(messageOf([&] { Tree(source, ambient, {}); }), says);
}

TEST(MediumTree, BadInputIsRefused)
{
  expectRefusal(std::make_shared<ConstantSource>(11.), 0, "no transparent medium has");
  expectRefusal(std::make_shared<ConstantSource>(-1.), 0, "no transparent medium has");
  expectRefusal(std::make_shared<ConstantSource>(1e-4), -1, "The ambient refractivity");
  expectRefusal(std::make_shared<ConstantSource>(std::nan("")), 0, "invalid everywhere");
  expectRefusal(
    std::make_shared<BoxSource>(std::array<double, 3>{ 1, 0, 1 }, std::array<double, 3>{ 1, 1, 1 }),
    0, "no extent along their y axis");
  class Empty : public ConstantSource
  {
  public:
    Empty()
      : ConstantSource(0)
    {
    }
    void findPlaces(const Box&, Content& content) const override { content.hasWindow = true; }
  };
  expectRefusal(std::make_shared<Empty>(), 0, "invalid everywhere");
}

TEST(MediumTree, DoublesAreMadeLikeFloats)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  MediumTree<double> tree(source, 0, settingsOf(1e-3));
  tree.refine(everything());
  Tree singles(source, 0, settingsOf(1e-3));
  singles.refine(everything());
  ASSERT_EQ(tree.samples().size(), singles.samples().size());
  for (std::size_t n = 0; n < tree.samples().size(); n += 17)
  {
    ASSERT_NEAR(tree.samples()[n], static_cast<double>(singles.samples()[n]), 2e-11);
  }
}

} // namespace

} // namespace schlieren
