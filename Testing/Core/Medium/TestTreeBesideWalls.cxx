// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Values that are continued into walls.
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

} // namespace

} // namespace schlieren
