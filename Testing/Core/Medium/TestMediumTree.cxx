// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticSources.h"
#include "Fields.h"
#include "SameTree.h"

#include "Medium/Tree/BrickMakers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
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

using Tree = MediumTree<float>;

TreeSettings settingsOf(double tolerance)
{
  TreeSettings settings;
  settings.tolerance = tolerance;
  return settings;
}

const Vec3<double> x{ 1, 0, 0 }, y{ 0, 1, 0 }, z{ 0, 0, 1 };

/// Worst error of the deflection of straight rays, of the largest one, over [-half, half]^2 around a place.
double worstError(const Tree& tree, const BallsSource& source, Interpolation interpolation,
  const Vec3<double>& u, const Vec3<double>& v, double half,
  const Vec3<double>& around = { 0, 0, 0 })
{
  constexpr int edge = 31;
  double worst = 0;
  for (int n = 0; n < edge * edge; ++n)
  {
    const double a = half * (2. * (n % edge) / (edge - 1) - 1);
    const double b = half * (2. * (n / edge) / (edge - 1) - 1);
    const Vec3<double> place = around + a * u + b * v;
    const auto truth = source.deflectionAt(place, u, v);
    const Vec3<double> bend = bendAlong(tree, interpolation, place, cross(u, v));
    worst = std::max(worst, std::hypot(dot(bend, u) - truth[0], dot(bend, v) - truth[1]));
  }
  return worst / source.largestDeflection();
}

/// N everywhere the same.
class ConstantSource : public AnalyticSource
{
public:
  explicit ConstantSource(double n)
    : n_(n)
  {
  }
  double refractivity(double, double, double) const override { return n_; }
  Range rangeOver(const Box&) const override { return { n_, n_ }; }
  double cellSizeOver(const Box&) const override { return 0.01; }

private:
  double n_;
};

/// Between two corners.
class BoxSource : public ConstantSource
{
public:
  BoxSource(const std::array<double, 3>& edges, const std::array<double, 3>& shape)
    : ConstantSource(1e-4)
    , edges_(edges)
    , shape_(shape)
  {
  }
  Box bounds() const override
  {
    return { { 1, 2, 3 }, { 1 + edges_[0], 2 + edges_[1], 3 + edges_[2] } };
  }
  std::array<double, 3> voxelShape() const override { return shape_; }

private:
  std::array<double, 3> edges_, shape_;
};

TEST(MediumTree, RootCellsFillTheBox)
{
  const auto gridOf = [](const std::array<double, 3>& edges, const std::array<double, 3>& shape)
  { return Tree(std::make_shared<BoxSource>(edges, shape), 0, {}).grid(); };
  const Grid cubes = gridOf({ 4, 2, 1 }, { 1, 1, 1 });
  EXPECT_EQ(cubes.dimensions, (std::array<std::int64_t, 3>{ 65, 33, 17 }));
  EXPECT_EQ(cubes.origin, (Vector{ 1, 2, 3 }));
  const Grid flat = gridOf({ 4, 2, 1 }, { 1, 0.25, 1 });
  EXPECT_EQ(flat.dimensions, (std::array<std::int64_t, 3>{ 65, 129, 17 }));
  const Grid odd = gridOf({ 1, 0.3, 0.6 }, { 1, 1, 1 });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double edges[3] = { 1, 0.3, 0.6 };
    EXPECT_NEAR(
      odd.spacing[axis] * static_cast<double>(odd.dimensions[axis] - 1), edges[axis], 1e-14);
    EXPECT_EQ((odd.dimensions[axis] - 1) % Tree::brickEdge, 0);
  }
  const Grid tunnel = gridOf({ 10, 1, 1 }, { 1, 1, 1 });
  EXPECT_EQ(tunnel.dimensions, (std::array<std::int64_t, 3>{ 161, 17, 17 }));
}

TEST(MediumTree, LeavesLieWhereTheirPlacesSay)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything());
  std::set<std::int32_t> found;
  const double last = static_cast<double>(tree.grid().dimensions[0] - 1);
  for (std::size_t n = 0; n < tree.leaves().size(); ++n)
  {
    const Leaf<float>& leaf = tree.leaves()[n];
    // All corners of the leaf, a little within.
    for (int corner = 0; corner < 8; ++corner)
    {
      double at[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        at[axis] = leaf.first[axis] + ((corner >> axis & 1) != 0 ? 15.49 : -0.49) / leaf.perIndex;
        ASSERT_TRUE(at[axis] > 0 && at[axis] < last);
      }
      ASSERT_EQ(tree.finder().at({ at[0], at[1], at[2] }), static_cast<std::int32_t>(n));
    }
  }
}

class EachScheme : public testing::TestWithParam<Interpolation>
{
};
INSTANTIATE_TEST_SUITE_P(Schemes, EachScheme, testing::ValuesIn(allInterpolations),
  [](const auto& scheme) { return name(scheme.param); });

TEST_P(EachScheme, ValuesAndGradientsAreThoseOfTheFormula)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  TreeSettings settings = settingsOf(1e-3);
  settings.interpolation = GetParam();
  Tree tree(source, 0, settings);
  tree.refine(everything());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-0.999, 0.999);
  for (int n = 0; n < 20000; ++n)
  {
    const Vec3<double> at{ anywhere(random), anywhere(random), anywhere(random) };
    const Sample<double> found = sampleAt(tree, GetParam(), at);
    EXPECT_NEAR(found.value, source->refractivity(at.x, at.y, at.z), 1e-6);
    // Over the leaf, as the tolerance is meant; of each component.
    const Leaf<float>& leaf = tree.leaves()[static_cast<std::size_t>(leafAt(tree, at))];
    const double edge = 16 * tree.grid().spacing[0] / leaf.perIndex;
    const double allowed = 4 * settings.tolerance * source->largestDeflection() / edge;
    constexpr double step = 1e-5;
    for (const Vec3<double>& axis : { x, y, z })
    {
      const Vec3<double> low = at - step * axis, high = at + step * axis;
      const double truth =
        (source->refractivity(high.x, high.y, high.z) - source->refractivity(low.x, low.y, low.z)) /
        (2 * step);
      ASSERT_NEAR(dot(found.gradient, axis), truth, allowed) << at.x << " " << at.y << " " << at.z;
    }
  }
}

TEST(MediumTree, DeflectionIsWithinTolerance)
{
  const auto [u, v] = obliqueAxes();
  for (const Interpolation interpolation : { Interpolation::Quadratic, Interpolation::Cubic })
  {
    for (const double width : { 0.25, 0.05, 0.02 })
    {
      const Ball ball{ { 0.11, -0.23, 0.07 }, width, 1e-4 };
      const auto source = std::make_shared<BallsSource>(std::vector<Ball>{ ball });
      for (const double tolerance : { 1e-1, 1e-2, 1e-3 })
      {
        TreeSettings settings = settingsOf(tolerance);
        settings.interpolation = interpolation;
        Tree tree(source, 0, settings);
        tree.refine(everything());
        const Vec3<double> centre{ ball.centre[0], ball.centre[1], ball.centre[2] };
        SCOPED_TRACE(
          std::to_string(width) + " " + std::to_string(tolerance) + " " + name(interpolation));
        const double worst = worstError(tree, *source, interpolation, x, y, width, centre);
        EXPECT_LT(worst, 2 * tolerance);
        EXPECT_LT(worstError(tree, *source, interpolation, x, y, 3 * width, centre), 2 * tolerance);
        EXPECT_LT(worstError(tree, *source, interpolation, u, v, width, centre), 2 * tolerance);
        EXPECT_LT(worstError(tree, *source, interpolation, u, v, 3 * width, centre), 2 * tolerance);
        const double estimated = tree.statistics().estimatedError;
        EXPECT_LE(estimated, 2 * tolerance);
        if (interpolation == Interpolation::Quadratic)
        {
          EXPECT_LT(worst, 2 * estimated);
          EXPECT_GT(worst, 0.05 * estimated);
        }
        EXPECT_NEAR(
          tree.statistics().largestDeflection / source->largestDeflection(), 1, 0.05 + tolerance);
      }
    }
  }
}

TEST(MediumTree, SpendsVoxelsWhereTheyAreNeeded)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything());
  const Tree::Statistics statistics = tree.statistics();
  const double uniform = std::pow(2 / statistics.smallestVoxel, 3);
  EXPECT_LT(static_cast<double>(statistics.voxels), 0.01 * uniform);
  EXPECT_GE(statistics.finestLevel, 3);
  EXPECT_GT(statistics.constantLeaves, 0);
  EXPECT_EQ(statistics.voxels, 4096 * statistics.bricks);
  const auto bytes = static_cast<double>(tree.samples().size() * sizeof(float) +
    tree.leaves().size() * sizeof(Leaf<float>) + tree.children().size() * sizeof(std::int32_t));
  EXPECT_GE(static_cast<double>(statistics.bytes), bytes);
  EXPECT_LT(static_cast<double>(statistics.bytes), 1.1 * bytes);
  EXPECT_EQ(tree.samples().size(),
    static_cast<std::size_t>((statistics.bricks + 1) * tree.samplesPerBrick() + 4));
  // Constant leaves read zeros, and so do packs behind the last row.
  for (std::size_t n = 0; n < static_cast<std::size_t>(tree.samplesPerBrick()); ++n)
  {
    ASSERT_EQ(tree.samples()[n], 0);
  }
  for (std::size_t n = tree.samples().size() - 4; n < tree.samples().size(); ++n)
  {
    ASSERT_EQ(tree.samples()[n], 0);
  }
  // Each lattice of samples is requested once, and few are thrown away.
  EXPECT_LT(
    source->lattices, 1.3 * static_cast<double>(statistics.bricks + statistics.constantLeaves));
}

TEST(MediumTree, DoesNotDependOnThreads)
{
  const std::shared_ptr<AnalyticSource> sources[] = {
    std::make_shared<BallsSource>(threeBalls(1e-4)), std::make_shared<SphereSource>()
  };
  for (const auto& source : sources)
  {
    std::unique_ptr<Tree> first;
    for (const int threads : { 1, 2, 5 })
    {
      TreeSettings settings = settingsOf(1e-2);
      settings.threads = threads;
      auto tree = std::make_unique<Tree>(source, 0, settings);
      tree->refine(everything(x, y, 0.05));
      if (first == nullptr)
      {
        first = std::move(tree);
        continue;
      }
      expectIdentical(*first, *tree);
    }
  }
}

Column around(double u, double v, double half, double finest = 0)
{
  return { x, y, { u, v }, { half, half }, finest };
}

TEST(MediumTree, RefinesWhatAViewSees)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  Tree all(source, 0, settingsOf(1e-2));
  all.refine(everything());
  Tree tree(source, 0, settingsOf(1e-2));
  EXPECT_TRUE(tree.refine(around(0.42, -0.31, 0.1)));
  EXPECT_LT(tree.statistics().bricks, all.statistics().bricks / 2);
  const Vec3<double> second{ 0.42, -0.31, 0.2 }, third{ -0.37, 0.44, -0.5 };
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, x, y, 0.1, second), 2e-2);
  EXPECT_FALSE(tree.refine(around(0.42, -0.31, 0.1))); // it is all there
  EXPECT_FALSE(tree.refine(around(0.421, -0.31, 0.1)));

  EXPECT_TRUE(tree.refine(around(-0.37, 0.44, 0.1)));
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, x, y, 0.1, third), 2e-2);
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, x, y, 0.1, second), 2e-2);
  EXPECT_FALSE(tree.refine(around(0.42, -0.31, 0.1)));

  EXPECT_TRUE(tree.refine(everything()));
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, x, y, 0.9), 2e-2);

  Tree other(source, 0, settingsOf(1e-2));
  other.refine(everything());
  other.refine(around(-0.37, 0.44, 0.1));
  other.refine(around(0.42, -0.31, 0.1));
  other.refine(everything());
  const auto [u, v] = obliqueAxes();
  for (const Tree* made : { &tree, &other })
  {
    EXPECT_LT(worstError(*made, *source, Interpolation::Quadratic, u, v, 0.5), 2e-2);
  }
}

TEST(MediumTree, ZoomingInRefines)
{
  // The weak ball alone in the view: its own deflection is the measure then.
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  Tree tree(source, 0, settingsOf(2e-2));
  tree.refine(everything());
  const auto before = tree.statistics();
  EXPECT_TRUE(tree.refine(around(-0.37, 0.44, 0.04)));
  EXPECT_LT(tree.statistics().largestDeflection, 0.5 * before.largestDeflection);
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, x, y, 0.04, { -0.37, 0.44, -0.5 }),
    2 * 2e-2 * 0.5);
}

TEST(MediumTree, NoVoxelIsFinerThanThePixels)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  for (const double finest : { 0.02, 0.005 })
  {
    Tree tree(source, 0, settingsOf(1e-4));
    tree.refine(everything(x, y, finest));
    EXPECT_GE(tree.statistics().smallestVoxel, finest);
    EXPECT_LT(tree.statistics().smallestVoxel, 2 * finest);
  }
}

TEST(MediumTree, NoVoxelIsMuchFinerThanTheCells)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4), 1, 0.1);
  Tree tree(source, 0, settingsOf(0)); // as fine as the data
  tree.refine(everything());
  for (const Leaf<float>& leaf : tree.leaves())
  {
    const double voxel = tree.grid().spacing[0] / leaf.perIndex;
    Box box{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.low[axis] = -1 + tree.grid().spacing[axis] * leaf.first[axis] - 1.5 * voxel;
      box.high[axis] = box.low[axis] + 18 * voxel;
    }
    const double cell = source->cellSizeOver(box);
    if (leaf.kind == Leaf<float>::Samples)
    {
      EXPECT_LE(voxel, 1.401 * cell);
    }
  }
  EXPECT_GT(tree.statistics().smallestVoxel, 0.7 * 0.1 * 0.02);
}

TEST(MediumTree, FacetsOfLinearCellsAreNotResolved)
{
  static constexpr double cell = 0.025;
  /// A ball that is linear in cubic cells.
  class Cells : public BallsSource
  {
  public:
    Cells()
      : BallsSource({ { { 0.013, -0.021, 0.007 }, 0.2, 1e-4 } }, 0.6)
    {
    }
    double refractivity(double a, double b, double c) const override
    {
      const double at[3] = { a / cell + 0.37, b / cell + 0.11, c / cell + 0.73 };
      double sum = 0;
      for (int corner = 0; corner < 8; ++corner)
      {
        double weight = 1, point[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          const double low = std::floor(at[axis]);
          const bool isUpper = (corner >> axis & 1) != 0;
          weight *= isUpper ? at[axis] - low : 1 + low - at[axis];
          point[axis] = low + (isUpper ? 1 : 0);
        }
        sum += weight *
          BallsSource::refractivity(
            (point[0] - 0.37) * cell, (point[1] - 0.11) * cell, (point[2] - 0.73) * cell);
      }
      return sum;
    }
    double cellSizeOver(const Box&) const override { return cell; }
  };
  const auto source = std::make_shared<Cells>();
  Tree tree(source, 0, settingsOf(0));
  tree.refine(everything());
  EXPECT_GT(tree.statistics().smallestVoxel, 0.7 * cell);
  EXPECT_LE(tree.statistics().smallestVoxel, 1.4 * cell);
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, x, y, 0.45), 0.06);
  const auto [u, v] = obliqueAxes();
  EXPECT_LT(worstError(tree, *source, Interpolation::Quadratic, u, v, 0.45), 0.011);
}

TEST(MediumTree, ConstantDataNeedNoSamples)
{
  const auto source = std::make_shared<ConstantSource>(3e-4);
  Tree tree(source, 1e-4, settingsOf(1e-2));
  tree.refine(everything());
  EXPECT_EQ(tree.statistics().bricks, 0);
  EXPECT_EQ(tree.leaves().size(), 64u);
  EXPECT_EQ(source->lattices, 0);
  for (const Leaf<float>& leaf : tree.leaves())
  {
    EXPECT_EQ(leaf.kind, Leaf<float>::Constant);
    EXPECT_NEAR(static_cast<double>(leaf.offset), 2e-4 / 1.0001, 1e-11);
    EXPECT_EQ(leaf.brick, 0);
  }
  EXPECT_NEAR(tree.largestNu(), 2e-4 / 1.0001, 1e-11);
  EXPECT_EQ(tree.rangeOfNu(), 0);
  EXPECT_EQ(tree.largestN(), 3e-4);
  EXPECT_EQ(tree.slope().x, 0);
  EXPECT_FALSE(tree.refine(everything()));
}

TEST(MediumTree, FindsWhatLiesBetweenSamples)
{
  // Far smaller than a voxel of the roots, and at a corner of four of them.
  const auto source =
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0.516, 0.0, -0.001 }, 0.003, 1e-4 } });
  Tree tree(source, 0, settingsOf(2e-2));
  tree.refine(everything());
  EXPECT_LT(
    worstError(tree, *source, Interpolation::Quadratic, x, y, 0.009, { 0.516, 0.0, -0.001 }), 4e-2);
  EXPECT_LT(tree.statistics().bricks, 2000);
}

TEST(MediumTree, ThinShockIsResolved)
{
  const auto source = std::make_shared<ShellSource>();
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything());
  for (int n = 0; n < 2000; ++n)
  {
    const double r = 0.44 + 6e-5 * n;
    const Vec3<double> at{ 0.6 * r, 0.64 * r, 0.48 * r };
    EXPECT_NEAR(
      sampleAt(tree, Interpolation::Quadratic, at).value, ShellSource::profile(r), 1e-4 * 6e-3);
  }
}

/// Distance in voxels between the samples, as rays see it.
template <class Real>
double gasDistanceAt(const MediumTree<Real>& tree, const Vec3<double>& place)
{
  const Grid& grid = tree.grid();
  const Leaf<Real>& leaf = tree.leaves()[static_cast<std::size_t>(leafAt(tree, place))];
  EXPECT_GE(leaf.map, 0);
  const int stride = Tree::brickEdge + 2 * tree.apron();
  const double index[3] = { (place.x - grid.origin[0]) / grid.spacing[0],
    (place.y - grid.origin[1]) / grid.spacing[1], (place.z - grid.origin[2]) / grid.spacing[2] };
  int cell[3];
  double f[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double local = (index[axis] - leaf.first[axis]) * leaf.perIndex + tree.apron();
    cell[axis] = static_cast<int>(std::floor(local));
    f[axis] = local - cell[axis];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int bits[3] = { corner & 1, corner >> 1 & 1, corner >> 2 };
    const std::int64_t at =
      (std::int64_t{ cell[2] + bits[2] } * stride + cell[1] + bits[1]) * stride + cell[0] + bits[0];
    const double weight = (bits[0] != 0 ? f[0] : 1 - f[0]) * (bits[1] != 0 ? f[1] : 1 - f[1]) *
      (bits[2] != 0 ? f[2] : 1 - f[2]);
    sum += weight *
      tree.gasDistances()[static_cast<std::size_t>(leaf.map * tree.samplesPerBrick() + at)] / 8192.;
  }
  return sum;
}

namespace
{

/// A layer a fiftieth of the domain thick at its lower side, with cells as thin as a hundredth of their width.
class LayerSource : public AnalyticSource
{
public:
  static constexpr double thickness = 0.04;
  static double profile(double b)
  {
    return 1e-4 * std::exp(-(b + 1) * (b + 1) / (thickness * thickness));
  }
  double refractivity(double, double b, double) const override { return profile(b); }
  Range rangeOver(const Box& box) const override
  {
    return { profile(box.high[1]), profile(std::max(box.low[1], -1.)) };
  }
  double cellSizeOver(const Box& box) const override { return box.low[1] < -0.9 ? 5e-4 : 0.05; }
  std::array<double, 3> voxelShape() const override { return { 1, 1. / 32, 1 }; }
};

/// Says of each box that gas and a window may be there.
class VagueSource : public HalfSource
{
public:
  using HalfSource::HalfSource;
  void findPlaces(const Box&, Content& content) const override
  {
    content.hasGas = content.hasWindow = true;
  }
};

} // namespace

// A leaf with gas beside it only has one value for all, and no samples would change that.
TEST(MediumTree, GasBesideALeafIsNothingToRefine)
{
  for (const double border : { -0.06, -0.07, -0.08, -0.1 })
  {
    Tree tree(std::make_shared<VagueSource>(0, 1e-4, border, 0.02), 0, settingsOf(1e-3));
    int calls = 0;
    Monitor monitor;
    monitor.aborted = [&calls] { return ++calls > 5000; };
    tree.refine({ x, y, { 0, 0 }, { 1, 1 }, 0.01 }, monitor);
    EXPECT_FALSE(tree.isUnfinished()) << border;
  }
}

// What is negligible leaf by leaf is not so along a ray through many of them: even a rough tree shows it.
TEST(MediumTree, ThinLayerAlongTheRaysIsSeen)
{
  for (const double tolerance : { 0.1, 0.25 })
  {
    const auto source = std::make_shared<LayerSource>();
    Tree tree(source, 0, settingsOf(tolerance));
    tree.refine({ x, y, { 0, -0.94 }, { 0.06, 0.06 }, 1e-4 });
    EXPECT_GT(tree.statistics().bricks, 0);
    double worst = 0, largest = 0;
    for (double b = -0.998; b < -0.89; b += 0.002)
    {
      const double truth = 2 * -2 * (b + 1) * LayerSource::profile(b) /
        (LayerSource::thickness * LayerSource::thickness);
      const Vec3<double> bend = bendAlong(tree, Interpolation::Quadratic, { 0.01, b, 0 }, z);
      worst = std::max(worst, std::abs(bend.y - truth));
      largest = std::max(largest, std::abs(truth));
    }
    EXPECT_LT(worst, 2 * tolerance * largest) << tolerance;
  }
}

TEST(MediumTree, WallsAreSharp)
{
  const auto source = std::make_shared<SphereSource>();
  constexpr double finest = 0.01;
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(around(0, 0, 1.5, finest));
  std::mt19937 random(2);
  std::normal_distribution<double> any(0, 1);
  for (int n = 0; n < 5000; ++n)
  {
    Vec3<double> at{ any(random), any(random), any(random) };
    at = (1 / length(at)) * at;
    const Leaf<float>& leaf = tree.leaves()[static_cast<std::size_t>(leafAt(tree, at))];
    ASSERT_EQ(leaf.kind, Leaf<float>::Mixed);
    const double voxel = tree.grid().spacing[0] / leaf.perIndex;
    EXPECT_GE(voxel, finest);
    EXPECT_LT(voxel, 4 * finest);
    EXPECT_LT(std::abs(gasDistanceAt(tree, at)) * voxel, 0.04 * finest); // a tenth is allowed
    // In gas values are the formula's, a voxel from the wall on.
    const Vec3<double> out = (1 + 1.5 * voxel) * at;
    EXPECT_NEAR(sampleAt(tree, Interpolation::Quadratic, out).value,
      SphereSource::profile(length(out)), 3e-7);
  }
  const auto kindAt = [&](const Vec3<double>& at)
  { return tree.leaves()[static_cast<std::size_t>(leafAt(tree, at))].kind; };
  for (const Vec3<double>& inside : { Vec3<double>{ 0, 0, 0 }, Vec3<double>{ 0.5, -0.5, 0.3 } })
  {
    EXPECT_TRUE(kindAt(inside) == Leaf<float>::Solid || gasDistanceAt(tree, inside) < 0);
  }
  // Outside of the view there is nothing; far away next to nothing.
  EXPECT_LT(tree.statistics().bytes, 40000000);
  EXPECT_EQ(kindAt({ 15, 15, 1 }), Leaf<float>::Constant);
  for (const std::int16_t distance : tree.gasDistances())
  {
    ASSERT_EQ(distance & 1, 0); // nowhere a window
  }
}

/// Remembers the largest voxels of lattices with distances to walls, and none to windows.
class WatchedSphere : public SphereSource
{
public:
  void sample(
    const Lattice& lattice, double* refractivity, Place* places, float* distances) const override
  {
    SphereSource::sample(lattice, refractivity, places, distances);
    if (distances &&
      std::find(places, places + lattice.size(), Place::Window) == places + lattice.size())
    {
      const std::lock_guard<std::mutex> lock(one_);
      coarsest_ = std::max(coarsest_, lattice.spacing[0]);
    }
  }
  double coarsest() const { return coarsest_; }

private:
  mutable std::mutex one_;
  mutable double coarsest_ = 0;
};

TEST(MediumTree, WallsAreNotSampledWhereVoxelsAreTooLarge)
{
  const auto source = std::make_shared<WatchedSphere>();
  constexpr double finest = 0.01;
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(around(0, 0, 1.5, finest));
  EXPECT_GT(source->coarsest(), finest);
  EXPECT_LE(source->coarsest(), 8 * finest);
}

TEST(MediumTree, WallsAreThereWhereMemoryIsShort)
{
  const auto source = std::make_shared<SphereSource>();
  Tree enough(source, 0, settingsOf(1e-2));
  enough.refine(around(0, 0, 1.5, 0.01));
  for (const double part : { 0.02, 0.08, 0.1, 0.3 })
  {
    TreeSettings settings = settingsOf(1e-2);
    settings.memory =
      static_cast<std::size_t>(part * static_cast<double>(enough.statistics().bytes));
    Tree tree(source, 0, settings);
    tree.refine(around(0, 0, 1.5, 0.01));
    EXPECT_TRUE(tree.statistics().isMemoryShort);
    std::mt19937 random(3);
    std::normal_distribution<double> any(0, 1);
    for (int n = 0; n < 1000; ++n)
    {
      const Vec3<double> at{ any(random), any(random), any(random) };
      const std::int32_t leaf = leafAt(tree, (1 / length(at)) * at);
      ASSERT_EQ(tree.leaves()[static_cast<std::size_t>(leaf)].kind, Leaf<float>::Mixed);
    }
  }
}

/// Gas that becomes denser towards an oblique wall.
class ObliqueWallSource : public AnalyticSource
{
public:
  static constexpr double slope = 1e-4, border = 0.21;

  static Vec3<double> normal() { return { 0.8, 0.36, 0.48 }; }
  static double depth(double a, double b, double c)
  {
    return dot(normal(), Vec3<double>{ a, b, c });
  }
  double refractivity(double a, double b, double c) const override
  {
    return slope * depth(a, b, c);
  }
  Range rangeOver(const Box& box) const override
  {
    return { slope * depth(box.low[0], box.low[1], box.low[2]),
      slope * depth(box.high[0], box.high[1], box.high[2]) };
  }
  double cellSizeOver(const Box&) const override { return 0.02; }
  Place placeAt(double a, double b, double c) const override
  {
    return depth(a, b, c) < border ? Place::Gas : Place::Wall;
  }
  double distanceAt(double a, double b, double c) const override { return border - depth(a, b, c); }
  void findPlaces(const Box& box, Content& content) const override
  {
    content.hasGas = depth(box.low[0], box.low[1], box.low[2]) < border;
    content.hasWall = depth(box.high[0], box.high[1], box.high[2]) > border;
  }
};

/// Calls look(place) for places in the gas that are within a voxel of the oblique wall.
template <class Look>
void besideTheObliqueWall(const Tree& tree, const Look& look)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.8, 0.8), part(0, 1);
  int looked = 0;
  for (int n = 0; n < 20000; ++n)
  {
    const double b = any(random), c = any(random);
    const double a = (ObliqueWallSource::border - 0.36 * b - 0.48 * c) / 0.8;
    const Vec3<double> wall{ a, b, c };
    if (std::abs(a) > 0.8)
    {
      continue;
    }
    const Leaf<float>& leaf = tree.leaves()[static_cast<std::size_t>(leafAt(tree, wall))];
    const double voxel = tree.grid().spacing[0] / leaf.perIndex;
    look(wall - (part(random) * voxel) * ObliqueWallSource::normal());
    ++looked;
  }
  EXPECT_GT(looked, 1000);
}

// Which values there are in a wall must not be seen in the gas beside it.
TEST(MediumTree, GradientsReachWalls)
{
  const auto source = std::make_shared<ObliqueWallSource>();
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything(x, y, 0.01));
  double worst = 0;
  besideTheObliqueWall(tree,
    [&](const Vec3<double>& at)
    {
      const Sample<double> found = sampleAt(tree, Interpolation::Quadratic, at);
      worst = std::max(
        worst, length(found.gradient - ObliqueWallSource::slope * ObliqueWallSource::normal()));
    });
  EXPECT_LT(worst, 0.02 * ObliqueWallSource::slope);
}

// The same of what rays gather of fields, a linear one and one that is bent.
TEST(MediumTree, GradientsOfFieldsReachWalls)
{
  const Vec3<double> centre{ -0.2, 0.1, 0.1 };
  constexpr double width = 0.5;
  const auto source = std::make_shared<SourceWithFields>(std::make_shared<ObliqueWallSource>(),
    std::vector<FieldFormula>{
      linearField({ 0.3, -0.4, 1.2 }), ballField({ centre.x, centre.y, centre.z }, width) });
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything(x, y, 0.01));
  double worst[2] = {};
  besideTheObliqueWall(tree,
    [&](const Vec3<double>& at)
    {
      const std::int32_t number = leafAt(tree, at);
      const Leaf<float>& leaf = tree.leaves()[static_cast<std::size_t>(number)];
      const Grid& grid = tree.grid();
      Vec3<float> local;
      local.x = static_cast<float>(
        ((at.x - grid.origin[0]) / grid.spacing[0] - leaf.first[0]) * leaf.perIndex);
      local.y = static_cast<float>(
        ((at.y - grid.origin[1]) / grid.spacing[1] - leaf.first[1]) * leaf.perIndex);
      local.z = static_cast<float>(
        ((at.z - grid.origin[2]) / grid.spacing[2] - leaf.first[2]) * leaf.perIndex);
      float found[2] = {};
      gatherGradients(
        tree.gradients(), number, local, static_cast<float>(1 / grid.spacing[0]), found);
      const double r = length(at - centre);
      const double expected[2] = { 1.3,
        2 * r / (width * width) * std::exp(-r * r / (width * width)) };
      for (int n = 0; n < 2; ++n)
      {
        worst[n] = std::max(worst[n], std::abs(static_cast<double>(found[n]) - expected[n]));
      }
    });
  EXPECT_LT(worst[0], 1e-5);
  EXPECT_LT(worst[1], 0.05); // of up to 1.7
}

TEST(MediumTree, ContinuedValuesDoNotDependOnTheBrick)
{
  const auto source = std::make_shared<SphereSource>(2);
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything(x, y, 0.03));
  // On both sides of faces between leaves with walls, next to the wall.
  int compared = 0;
  for (const Leaf<float>& leaf : tree.leaves())
  {
    if (leaf.kind != Leaf<float>::Mixed || leaf.brick == 0)
    {
      continue;
    }
    const double voxel = tree.grid().spacing[0] / leaf.perIndex;
    for (int n = 0; n < 256; ++n)
    {
      const double index[3] = { leaf.first[0] + 15.5 / leaf.perIndex,
        leaf.first[1] + (n % 16) / leaf.perIndex, leaf.first[2] + (n / 16) / leaf.perIndex };
      const auto at = [&](double beyond) -> Vec3<double>
      {
        return { -2 + tree.grid().spacing[0] * index[0] + beyond,
          -2 + tree.grid().spacing[1] * index[1], -2 + tree.grid().spacing[2] * index[2] };
      };
      const double r = length(at(0));
      const Leaf<float>& next = tree.leaves()[static_cast<std::size_t>(leafAt(tree, at(1e-9)))];
      if (r > 1 && r < 1 + voxel && next.kind == Leaf<float>::Mixed &&
        next.perIndex == leaf.perIndex)
      {
        const Sample<double> a = sampleAt(tree, Interpolation::Quadratic, at(-1e-9));
        const Sample<double> b = sampleAt(tree, Interpolation::Quadratic, at(1e-9));
        EXPECT_NEAR(a.value, b.value, 1e-4 * 1e-4);
        EXPECT_NEAR(a.gradient.y * voxel, b.gradient.y * voxel, 1e-4 * 1e-4);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(MediumTree, WindowsLetNothingBeSeen)
{
  constexpr double finest = 0.01;
  constexpr double border = 0.013;
  const auto source = std::make_shared<HalfSource>(1e-4, 1e-5, border, 0.1);
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything(x, y, finest));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-0.9, 0.9);
  for (int n = 0; n < 500; ++n)
  {
    const Vec3<double> at{ border, anywhere(random), anywhere(random) };
    ASSERT_EQ(tree.leaves()[static_cast<std::size_t>(leafAt(tree, at))].kind, Leaf<float>::Mixed);
    EXPECT_NEAR(gasDistanceAt(tree, at), 0, 0.01);
    const Vec3<double> beyond{ 0.5, at.y, at.z };
    const Leaf<float>& leaf = tree.leaves()[static_cast<std::size_t>(leafAt(tree, beyond))];
    EXPECT_EQ(leaf.kind, Leaf<float>::Constant);
    EXPECT_EQ(leaf.offset, 0);
    const Vec3<double> before{ border - 1e-4, at.y, at.z };
    const Sample<double> sample = sampleAt(tree, Interpolation::Quadratic, before);
    EXPECT_NEAR(sample.value, 1e-4 * (1 + 0.1 * at.y), 1e-9);
    EXPECT_NEAR(sample.gradient.y, 1e-5, 1e-7);
  }
  for (const std::int16_t distance : tree.gasDistances())
  {
    ASSERT_TRUE(distance > 8192 || (distance & 1) == 1); // nowhere a wall
  }

  // Where gas is that of the ambient next to the window, there is nothing to be refined for.
  const auto far = std::make_shared<SphereSource>();
  Tree domain(far, 0, settingsOf(1e-2));
  domain.refine(everything(x, y, 0.1));
  const Leaf<float>& edge =
    domain.leaves()[static_cast<std::size_t>(leafAt(domain, { 0.6 * 20, 0.64 * 20, 0.48 * 20 }))];
  EXPECT_LE(edge.perIndex, 1);
  EXPECT_EQ(edge.map, -1);
}

/// Two cubes of edge 2 with a ball in each, `apart` from middle to middle along z, and nothing between them.
class FarBlocksSource : public BallsSource
{
public:
  explicit FarBlocksSource(double apart)
    : BallsSource(
        { { { 0.1, 0, -apart / 2 }, 0.3, 1e-4 }, { { -0.2, 0.1, apart / 2 }, 0.4, 1e-4 } },
        apart / 2 + 1, 0.1)
    , apart_(apart)
  {
  }

  Box bounds() const override { return { { -1, -1, -half_ }, { 1, 1, half_ } }; }
  Place placeAt(double, double, double c) const override
  {
    return std::abs(c) > half_ - 2 ? Place::Gas : Place::Window;
  }
  double distanceAt(double a, double b, double c) const override
  {
    return std::min({ 1 - std::abs(a), 1 - std::abs(b), 1 - std::abs(std::abs(c) - apart_ / 2) });
  }
  void findPlaces(const Box& box, Content& content) const override
  {
    const double inner = half_ - 2;
    content.hasGas = box.high[2] > inner || box.low[2] < -inner;
    content.hasWindow = box.high[2] > -inner && box.low[2] < inner;
  }

private:
  double apart_;
};

// Empty space costs nothing, nor are the blocks' voxels longer along it.
TEST(MediumTree, BlocksFarApartAreAsFineAsNearOnes)
{
  std::vector<MediumStatistics> found;
  for (const double apart : { 8., 2e3, 2e5 })
  {
    SCOPED_TRACE(apart);
    const auto source = std::make_shared<FarBlocksSource>(apart);
    Tree tree(source, 0, settingsOf(1e-2));
    tree.refine(everything(x, y, 0.02));
    found.push_back(tree.statistics());
    EXPECT_LT(tree.leaves().size(), 1000U);
    EXPECT_EQ(found.back().bricks, found[0].bricks);
    EXPECT_NEAR(found.back().largestDeflection / found[0].largestDeflection, 1, 1e-6);
    for (const double end : { -1., 1. })
    {
      for (const double a : { -0.5, -0.1, 0.3 })
      {
        const Vec3<double> at{ a, 0.2, end * apart / 2 };
        EXPECT_NEAR(sampleAt(tree, Interpolation::Quadratic, at).value,
          source->refractivity(at.x, at.y, at.z), 1e-6);
      }
    }
  }
}

/// A ball of gas in a wall, which has a hole along z beside it.
class BuriedSource : public BallsSource
{
public:
  BuriedSource()
    : BallsSource({ { { -0.4, 0, 0 }, 0.3, 1e-4 } }, 1, 0.1)
  {
  }

  static constexpr double radius = 0.3, ofHole = 0.1;
  static double fromBall(double a, double b, double c) { return std::hypot(a + 0.4, b, c); }
  static double fromHole(double a, double b) { return std::hypot(a - 0.75, b); }

  Place placeAt(double a, double b, double c) const override
  {
    return distanceAt(a, b, c) > 0 ? Place::Gas : Place::Wall;
  }
  double distanceAt(double a, double b, double c) const override
  {
    return std::max(radius - fromBall(a, b, c), ofHole - fromHole(a, b));
  }
  void findPlaces(const Box& box, Content& content) const override
  {
    const Range ofBall = distancesTo({ -0.4, 0, 0 }, box);
    const Range hole = distancesTo(
      { 0.6, 0, 0 }, { { box.low[0], box.low[1], 0 }, { box.high[0], box.high[1], 0 } });
    content.hasGas = ofBall.first < radius || hole.first < ofHole;
    content.hasWall = !(ofBall.second < radius || hole.second < ofHole);
  }
};

// Light that is blocked shows no walls: those of the hole are as sharp as ever.
TEST(MediumTree, NothingIsRefinedWhereLightIsBlocked)
{
  constexpr double finest = 0.005;
  Tree tree(std::make_shared<BuriedSource>(), 0, settingsOf(1e-2));
  tree.refine(everything(x, y, finest));
  const auto voxelAt = [&](const Vec3<double>& at)
  {
    const Leaf<float>& leaf = tree.leaves()[static_cast<std::size_t>(leafAt(tree, at))];
    return tree.grid().spacing[0] / leaf.perIndex;
  };
  for (int n = 0; n < 16; ++n)
  {
    const double angle = 0.1 + n * 2 * std::acos(-1.) / 16;
    const Vec3<double> ofHole{ 0.75 + 0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.3 };
    EXPECT_LT(voxelAt(ofHole), 4 * finest);
    const Vec3<double> ofBall{ -0.4 + 0.3 * std::cos(angle), 0.3 * std::sin(angle), 0 };
    EXPECT_GT(voxelAt(ofBall), 4 * finest);
  }

  // Light that is inclined may come from elsewhere.
  Column oblique = everything(x, y, finest);
  oblique.steepest = 10;
  tree.refine(oblique);
  EXPECT_LT(voxelAt({ -0.1, 0, 0 }), 4 * finest);
}

TEST(MediumTree, MemoryIsBounded)
{
  const auto source =
    std::make_shared<BallsSource>(std::vector<Ball>{ { { 0.11, -0.23, 0.07 }, 0.05, 1e-4 } });
  Tree enough(source, 0, settingsOf(1e-4));
  enough.refine(everything());
  const auto needed = static_cast<double>(enough.statistics().bytes);
  EXPECT_LE(enough.statistics().estimatedError, 3e-4);
  double before = 10;
  for (const double part : { 0.1, 0.2, 0.4, 0.9 })
  {
    TreeSettings settings = settingsOf(1e-4);
    settings.memory = static_cast<std::size_t>(part * needed);
    Tree tree(source, 0, settings);
    tree.refine(everything());
    EXPECT_LE(static_cast<double>(tree.statistics().bytes), part * needed);
    EXPECT_GE(static_cast<double>(tree.statistics().bytes), 0.9 * part * needed);
    EXPECT_GT(tree.statistics().estimatedError, 0.99 * enough.statistics().estimatedError);
    const double error = worstError(tree, *source, Interpolation::Quadratic, x, y, 0.9);
    EXPECT_LT(error, 2 * tree.statistics().estimatedError);
    EXPECT_LT(tree.statistics().estimatedError, 1.01 * before);
    EXPECT_TRUE(
      part > 0.2 || tree.statistics().estimatedError > 3 * enough.statistics().estimatedError);
    before = tree.statistics().estimatedError;
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
  EXPECT_LE(tree.statistics().estimatedError, 3e-4);
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

TEST(MediumTree, BricksArriveAsTheyWereSent)
{
  const auto source = std::make_shared<SphereSource>();
  const Tree tree(source, 0, settingsOf(1e-2));
  const BrickMaker<float> maker(*source, { tree.grid(), 0, 1e-4, Interpolation::Quadratic });
  int mixed = 0;
  for (std::int32_t at = 0; at < 8; ++at)
  {
    const Brick<float> brick = maker.make({ { 1, { at, 3, 4 } }, { 0 } });
    mixed += brick.gasDistances.empty() ? 0 : 1;
    const std::vector<char> bytes = brick.toBytes();
    const auto samples = static_cast<std::size_t>(maker.samplesPerBrick());
    const auto arrived = Brick<float>::fromBytes(bytes, samples, 0);
    EXPECT_EQ(arrived.kind, brick.kind);
    EXPECT_EQ(arrived.offset, brick.offset);
    EXPECT_EQ(arrived.samples, brick.samples);
    EXPECT_EQ(arrived.gasDistances, brick.gasDistances);
    EXPECT_EQ(std::memcmp(&arrived.facts, &brick.facts, sizeof(brick.facts)), 0);
    EXPECT_EQ(arrived.toBytes(), bytes);
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 97)
    {
      EXPECT_THROW(
        Brick<float>::fromBytes(
          { bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size) }, samples, 0),
        Error);
    }
    if (!brick.samples.empty())
    {
      EXPECT_THROW(Brick<float>::fromBytes(bytes, samples - 1, 0), Error);
    }
  }
  EXPECT_GT(mixed, 0);
}

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

void expectError(
  const std::shared_ptr<const MediumSource>& source, double ambient, const std::string& says)
{
  try
  {
    const Tree tree(source, ambient, {});
    FAIL() << "accepted: " << says;
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(MediumTree, BadInputIsRefused)
{
  expectError(std::make_shared<ConstantSource>(11.), 0, "no transparent medium has");
  expectError(std::make_shared<ConstantSource>(-1.), 0, "no transparent medium has");
  expectError(std::make_shared<ConstantSource>(1e-4), -1, "The ambient refractivity");
  expectError(std::make_shared<ConstantSource>(std::nan("")), 0, "invalid everywhere");
  expectError(
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
  expectError(std::make_shared<Empty>(), 0, "invalid everywhere");
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
