// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// A tree in parts, for devices with little memory.
#include "Medium/TreeParts.h"
#include "RaysInTree.h"

#include <cmath>
#include <cstdlib>
#include <set>

namespace schlieren
{

namespace
{

std::size_t bytesOf(const MediumView<float>& medium, const Leaf<float>& leaf)
{
  const auto perBrick = static_cast<std::size_t>(medium.brickStride);
  return (leaf.brick != 0 ? perBrick * sizeof(float) : 0) +
    (leaf.map >= 0 ? perBrick * sizeof(std::int16_t) : 0);
}

/// Each brick is once in a part, and light comes to no part again.
void expectParts(const Traced<float>& traced, std::size_t bytesOfPart, std::int32_t least)
{
  const MediumView<float>& medium = traced.task.medium;
  const std::vector<Leaf<float>>& leaves = traced.medium.tree->leaves();
  const Vec3<double> along = traced.task.light.perLength;
  const TreeParts parts = divideTree(medium, leaves.size(), along, bytesOfPart);
  EXPECT_GE(parts.count(), least);
  std::set<std::int32_t> seen;
  for (std::int32_t part = 0; part < parts.count(); ++part)
  {
    std::size_t bytes = 0;
    for (std::size_t n = parts.begin(part); n < parts.end(part); ++n)
    {
      const std::int32_t leaf = parts.leaves[n];
      EXPECT_TRUE(seen.insert(leaf).second);
      EXPECT_EQ(parts.ofLeaf[static_cast<std::size_t>(leaf)], part);
      bytes += bytesOf(medium, leaves[static_cast<std::size_t>(leaf)]);
    }
    EXPECT_LE(bytes, bytesOfPart);
  }
  std::size_t withBricks = 0;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
  {
    const bool hasBrick = bytesOf(medium, leaves[leaf]) > 0;
    withBricks += hasBrick ? 1 : 0;
    EXPECT_EQ(parts.ofLeaf[leaf] != TreeParts::none, hasBrick);
  }
  EXPECT_EQ(seen.size(), withBricks);

  for (int ray = 0; ray < 200; ++ray)
  {
    // Across the domain, about its middle; not along the sides of leaves.
    const auto beside = [ray](int axis) { return 5.03 * std::sin(ray * (1.7 + axis) + axis); };
    const double per = 1 / std::max({ std::abs(along.x), std::abs(along.y), std::abs(along.z) });
    const Vec3<double> middle = Vec3<double>{ beside(0), beside(1), beside(2) } + 0.5 * medium.last;
    std::int32_t last = 0;
    for (double at = -60; at < 60; at += 0.01)
    {
      const Vec3<double> index = middle + (at * per) * along;
      const auto isIn = [](double x, double end) { return x >= 0 && x <= end; };
      if (isIn(index.x, medium.last.x) && isIn(index.y, medium.last.y) &&
        isIn(index.z, medium.last.z))
      {
        const std::int32_t leaf = medium.finder.at(index);
        const std::int32_t part = parts.ofLeaf[static_cast<std::size_t>(leaf)];
        EXPECT_TRUE(part == TreeParts::none || part >= last) << ray << " at " << at;
        last = part == TreeParts::none ? last : part;
      }
    }
  }
}

TEST(TreeParts, AreInTheOrderOfLightFromAllSides)
{
  Setting setting{ std::make_shared<BallsSource>(threeBalls(3e-2)) };
  for (int octant = 0; octant < 8; ++octant)
  {
    setting.direction = { (octant & 1) != 0 ? 0.3 : -0.3, (octant & 2) != 0 ? 0.5 : -0.5,
      (octant & 4) != 0 ? 0.8 : -0.8 };
    const Traced<float> traced(setting);
    const std::size_t bytes = traced.medium.tree->samples().size() * sizeof(float);
    expectParts(traced, bytes / 5, 5);
  }
  setting.direction = { 0, 0, -1 };
  expectParts(Traced<float>(setting), std::size_t{ 1 } << 30, 1);
}

TEST(TreeParts, HaveWalls)
{
  Setting setting{ std::make_shared<SphereSource>(2) };
  setting.tolerance = 0.5;
  setting.finest = 0.04;
  const Traced<float> traced(setting);
  ASSERT_FALSE(traced.medium.tree->gasDistances().empty());
  expectParts(traced, std::size_t{ 1 } << 18, 3);
}

TEST(TreeParts, MayBeOfOneLayer)
{
  const Setting setting{ std::make_shared<FlatSource>(
    std::vector<Ball>{ { { -0.1, 0.05, 0 }, 0.25, 1e-3 }, { { 0.42, -0.31, 0 }, 0.05, 5e-4 } }) };
  expectParts(Traced<float>(setting), std::size_t{ 1 } << 13, 3);
}

TEST(TreeParts, OneIsThereWhereNothingIs)
{
  Setting setting{ std::make_shared<BallsSource>(
    std::vector<Ball>{ { { 0, 0, 0 }, 0.3, 0. } }, 1, 0.05) };
  const Traced<float> traced(setting);
  const TreeParts parts = divideTree(
    traced.task.medium, traced.medium.tree->leaves().size(), { 0, 0, 1 }, std::size_t{ 1 });
  EXPECT_EQ(parts.count(), 1);
  EXPECT_TRUE(parts.leaves.empty());
}

} // namespace

} // namespace schlieren
