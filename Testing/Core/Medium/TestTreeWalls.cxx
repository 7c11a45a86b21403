// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trees whose gas ends at walls and windows.
#include "Trees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace schlieren
{

namespace
{

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

} // namespace

} // namespace schlieren
