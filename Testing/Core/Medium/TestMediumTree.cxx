// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fields.h"
#include "SameTree.h"
#include "Trees.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// Axes across a direction that follows no axis of the grid.
std::pair<Vec3<double>, Vec3<double>> obliqueAxes()
{
  const Vec3<double> w{ 0.36, 0.48, 0.8 };
  const Vec3<double> u{ 0.8, -0.6, 0 };
  return { u, cross(w, u) };
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
    for (const double width : { 0.25, 0.02 })
    {
      const Ball ball{ { 0.11, -0.23, 0.07 }, width, 1e-4 };
      const auto source = std::make_shared<BallsSource>(std::vector<Ball>{ ball });
      for (const double tolerance : { 1e-1, 1e-3 })
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
        const double estimated = statedError(tree.statistics());
        EXPECT_LE(estimated, 2 * tolerance);
        if (interpolation == Interpolation::Quadratic)
        {
          EXPECT_LT(errorOfMost(tree, *source, interpolation, x, y, 1), 3 * estimated);
          EXPECT_GT(worst, 0.05 * estimated);
        }
        EXPECT_NEAR(
          tree.statistics().largestDeflection / source->largestDeflection(), 1, 0.05 + tolerance);
      }
    }
  }
}

/// Of weak balls beside one that is 50 times as strong and seen in a thousandth of the image: errors are compared with what
/// an image shows of them, not with the largest deflection.
TEST(MediumTree, SeesWeakFlowsBesideStrongOnes)
{
  const std::vector<Ball> balls{ { { 0.5, 0.5, 0.1 }, 0.02, 5e-3 },
    { { -0.4, 0.3, 0.2 }, 0.08, 1e-4 }, { { 0.2, -0.5, -0.1 }, 0.08, 1e-4 } };
  const auto source = std::make_shared<BallsSource>(balls);
  constexpr double tolerance = 1e-2, weak = 1. / 50;
  std::int64_t voxels = 0;
  for (const double fullScale : { 0.1, weak }) // of the largest deflection
  {
    SCOPED_TRACE(fullScale);
    Tree tree(source, 0, settingsOf(tolerance));
    Column column = everything();
    column.fullScale = fullScale < 0.1 ? fullScale * source->largestDeflection() : 0;
    tree.refine(column);
    for (std::size_t n = 1; n < balls.size(); ++n)
    {
      const auto& [u, v, depth] = balls[n].centre;
      const double error = worstError(
        tree, *source, Interpolation::Quadratic, x, y, 2 * balls[n].width, { u, v, depth });
      EXPECT_LT(error, 2 * tolerance * fullScale);
      EXPECT_GT(error, 0.01 * tolerance * fullScale); // no more voxels than that needs
    }
    EXPECT_GT(tree.statistics().voxels, voxels);
    voxels = tree.statistics().voxels;
  }
}

TEST(MediumTree, LooksAtPartsOfTheImageAgain)
{
  const std::vector<Ball> balls = threeBalls(1e-4);
  const auto source = std::make_shared<BallsSource>(balls);
  Tree tree(source, 0, settingsOf(1e-2));
  tree.refine(everything());
  Tree again = tree;
  const auto& [u, v, depth] = balls[1].centre;
  const double half = balls[1].width;
  again.refineFurther(1e-2 / 8, { { { u, v }, { half, half } } }, {});
  const auto errorOf = [&](const Tree& of, const Ball& ball)
  {
    const Vec3<double> centre{ ball.centre[0], ball.centre[1], ball.centre[2] };
    return worstError(of, *source, Interpolation::Quadratic, x, y, 0.9 * ball.width, centre);
  };
  EXPECT_LT(errorOf(again, balls[1]), errorOf(tree, balls[1]) / 3);
  EXPECT_EQ(errorOf(again, balls[2]), errorOf(tree, balls[2])); // beside it nothing has changed
  Tree all(source, 0, settingsOf(1e-2 / 8));
  all.refine(everything());
  EXPECT_LT(again.statistics().voxels, all.statistics().voxels);
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

TEST(MediumTree, NoVoxelIsFinerThanHalfAPixel)
{
  const auto source = std::make_shared<BallsSource>(threeBalls(1e-4));
  for (const double finest : { 0.02, 0.005 })
  {
    Tree tree(source, 0, settingsOf(1e-4));
    tree.refine(everything(x, y, finest));
    EXPECT_GE(tree.statistics().smallestVoxel, 0.5 * finest);
    EXPECT_LT(tree.statistics().smallestVoxel, finest);
  }
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

} // namespace

} // namespace schlieren
