// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Scene::samplesAtEdges: edges of bodies have the light of an image with so many rays in all pixels.
#include "Bench/EdgeStage.h"
#include "Fields.h"
#include "SameImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace schlieren
{

namespace
{

class EdgesOfBodies : public OnDevice
{
};

Scene sceneOf(Cutoff cutoff, int samples, int samplesAtEdges)
{
  Scene scene = sceneOnCpu(90, 70, { -0.2, 0.4, -1 });
  scene.cutoff = cutoff;
  scene.kScale = 300;
  scene.wavelength = 1e-5;
  scene.samplesPerPixel = samples;
  scene.samplesAtEdges = samplesAtEdges;
  return scene;
}

bool isWithin(const PatchList& tiles, std::size_t pixel, int width)
{
  const auto column = static_cast<std::int64_t>(pixel) % width;
  const auto row = static_cast<std::int64_t>(pixel) / width;
  return std::any_of(tiles.begin(), tiles.end(),
    [&](const Patch& tile)
    {
      return column >= tile.column && column < tile.column + tile.columns && row >= tile.row &&
        row < tile.row + tile.rows;
    });
}

TEST_P(EdgesOfBodies, HaveTheLightOfManyRaysAndNoOtherPixelHas)
{
  const BlobWithHole flow;
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::ColorFilter, Cutoff::Interferogram })
  {
    SCOPED_TRACE(static_cast<int>(cutoff));
    const auto imageWith = [&](int samples, int samplesAtEdges)
    {
      Scene scene = sceneOf(cutoff, samples, samplesAtEdges);
      scene.device = GetParam();
      return Bench().render(flow.field, scene);
    };
    const Image few = imageWith(4, 0), many = imageWith(16, 0), both = imageWith(4, 16);
    const PatchList tiles = EdgeTiles::in(few.blockedFraction, sceneOf(cutoff, 4, 0).view, 0.4);
    EXPECT_EQ(both.samplesAtEdges, 16);
    EXPECT_EQ(few.samplesAtEdges, 0);
    const auto expectIn = [&](const auto& of, const auto& fewer, const auto& more, double noMore)
    {
      const std::size_t perPixel = of.size() / few.intensity.size();
      std::size_t changed = 0;
      for (std::size_t at = 0; at < of.size(); ++at)
      {
        const bool isAtEdge = isWithin(tiles, at / perPixel, few.width);
        ASSERT_NEAR(of[at], isAtEdge ? more[at] : fewer[at], isAtEdge ? noMore : 0) << at;
        changed += isAtEdge && of[at] != fewer[at] ? 1 : 0;
      }
      EXPECT_GT(changed, 20);
    };
    constexpr double ofLight = 1e-6; // films of other sizes hold light in other units
    expectIn(both.intensity, few.intensity, many.intensity, ofLight);
    expectIn(both.blockedFraction, few.blockedFraction, many.blockedFraction, 0);
    if (cutoff == Cutoff::ColorFilter)
    {
      expectIn(both.color, few.color, many.color, ofLight);
    }
    for (std::size_t at = 0; at < both.deflection.size(); ++at)
    {
      ASSERT_EQ(
        both.deflection[at], (isWithin(tiles, at / 2, few.width) ? many : few).deflection[at]);
    }
    EXPECT_GT(both.raysTraced, few.raysTraced);
    EXPECT_LT(both.raysTraced, many.raysTraced);
    EXPECT_GT(both.raysBlocked, few.raysBlocked);
  }
}

INSTANTIATE_TEST_SUITE_P(, EdgesOfBodies, bothDevices(), deviceName);

TEST(Edges, AreInSquaresThatBodiesDoNotFill)
{
  View view;
  view.width = 38;
  view.height = 18;
  PixelArray<float> blocked(38 * 18);
  const auto tilesWith = [&](float all, float other, int column, int row, double moved = 0)
  {
    std::fill(blocked.begin(), blocked.end(), all);
    blocked[static_cast<std::size_t>(38 * row + column)] = other;
    return EdgeTiles::in(blocked, view, moved);
  };
  EXPECT_TRUE(tilesWith(0, 0, 0, 0).empty());
  EXPECT_TRUE(tilesWith(1, 1, 0, 0).empty());
  for (const float all : { 0.f, 1.f })
  {
    const PatchList one = tilesWith(all, 0.5f, 5, 10);
    ASSERT_EQ(one.size(), 1);
    EXPECT_EQ(one[0].column, 4);
    EXPECT_EQ(one[0].columns, 4);
    EXPECT_EQ(one[0].row, 8);
    EXPECT_EQ(one[0].rows, 4);
    EXPECT_EQ(one[0].margin, 2);
  }
  const PatchList two = tilesWith(0, 1, 7, 5); // beside the next one
  ASSERT_EQ(two.size(), 1);
  EXPECT_EQ(two[0].columns, 8);
  EXPECT_EQ(two[0].rows, 4);
  EXPECT_EQ(tilesWith(0, 1, 7, 7).size(), 2); // two rows of two
  const PatchList moved = tilesWith(0, 1, 5, 6, 1.8);
  ASSERT_EQ(moved.size(), 3);
  EXPECT_EQ(moved[0].columns, 12);
  EXPECT_EQ(moved[0].margin, 4);
  const PatchList last = tilesWith(0, 1, 37, 17);
  ASSERT_EQ(last.size(), 1);
  EXPECT_EQ(last[0].column, 36);
  EXPECT_EQ(last[0].columns, 2);
  EXPECT_EQ(last[0].row, 16);
  EXPECT_EQ(last[0].rows, 2);
}

TEST(Edges, HaveEachRayOnceHoweverManyTilesNeedIt)
{
  // Stairs, whose margins overlap, and one that is alone.
  constexpr int samples = 3;
  constexpr std::int64_t margin = 3;
  PatchList tiles{ { 0, 0, 1, 0, 0, margin, 8, 4 }, { 4, 4, 1, 4, 4, margin, 4, 12 },
    { 8, 4, 1, 8, 4, margin, 12, 4 }, { 40, 2, 1, 40, 2, margin, 2, 4 } };
  const RaysOfTiles rays(tiles.begin(), tiles.end(), samples);
  std::map<std::array<std::int64_t, 3>, std::size_t> placed; // of a pixel in a pass
  std::size_t ray = 0;
  for (const Patch& rectangle : rays.rectangles())
  {
    EXPECT_EQ(rectangle.margin, 0);
    for (int pass = 0; pass < samples; ++pass)
    {
      for (std::int64_t row = rectangle.row; row < rectangle.row + rectangle.rows; ++row)
      {
        for (std::int64_t column = rectangle.column; column < rectangle.column + rectangle.columns;
             ++column)
        {
          EXPECT_TRUE(placed.insert({ { column, row, pass }, ray++ }).second);
        }
      }
    }
  }
  std::set<std::array<std::int64_t, 3>> needed;
  for (const Patch& tile : tiles)
  {
    for (std::int64_t row = tile.row - margin; row < tile.row + tile.rows + margin; ++row)
    {
      for (std::int64_t column = tile.column - margin; column < tile.column + tile.columns + margin;
           ++column)
      {
        for (int pass = 0; pass < samples; ++pass)
        {
          needed.insert({ column, row, pass });
          ASSERT_EQ(rays.ray(column, row, pass), placed.at({ column, row, pass }));
        }
      }
    }
  }
  EXPECT_EQ(needed.size(), ray); // none that no tile needs
}

TEST(Edges, AreTracedOnceForAllCutoffs)
{
  const BlobWithHole flow;
  Bench bench;
  bench.render(flow.field, sceneOf(Cutoff::KnifeEdge, 4, 16));
  const std::int64_t before = bench.work().raysTraced;
  const Image image = bench.render(flow.field, sceneOf(Cutoff::BrightField, 4, 16));
  EXPECT_EQ(bench.work().raysTraced, before);
  expectSameImage(image, Bench().render(flow.field, sceneOf(Cutoff::BrightField, 4, 16)));
  const Scene fringes = sceneOf(Cutoff::Interferogram, 4, 16); // whose rays start elsewhere
  expectSameImage(bench.render(flow.field, fringes), Bench().render(flow.field, fringes));
  Scene scene = sceneOf(Cutoff::BrightField, 4, 16);
  scene.memoryBudget = 1; // no rays are cached
  expectSameImage(bench.render(flow.field, scene), image);
}

} // namespace

} // namespace schlieren
