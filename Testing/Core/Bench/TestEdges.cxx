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
#include <optional>
#include <set>
#include <string>
#include <vector>

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

/// How far a pixel is from the next one beside an edge, by the rays of an image: 0, if it is one, ... `most`, or farther.
int distanceToEdge(const Image& image, std::size_t pixel, int most)
{
  const auto column = static_cast<int>(pixel) % image.width,
             row = static_cast<int>(pixel) / image.width;
  const auto blockedAt = [&](int i, int j)
  {
    return image.blockedFraction[static_cast<std::size_t>(
      std::clamp(j, 0, image.height - 1) * image.width + std::clamp(i, 0, image.width - 1))];
  };
  int distance = most;
  for (int n = 0; n < (2 * most + 1) * (2 * most + 1); ++n)
  {
    const int right = n % (2 * most + 1) - most, up = n / (2 * most + 1) - most;
    float least = 1, largest = 0;
    for (int beside = 0; beside < 9; ++beside)
    {
      const float blocked = blockedAt(column + right + beside % 3 - 1, row + up + beside / 3 - 1);
      least = std::min(least, blocked);
      largest = std::max(largest, blocked);
    }
    distance = largest > 0 && least < 1
      ? std::min(distance, std::max(std::abs(right), std::abs(up)))
      : distance;
  }
  return distance;
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
    EXPECT_EQ(both.samplesAtEdges, 16);
    EXPECT_EQ(few.samplesAtEdges, 0);
    const auto expectIn =
      [&](const auto& of, const auto& fewer, const auto& more, double noMore, double noMoreBeside)
    {
      const std::size_t perPixel = of.size() / few.intensity.size();
      std::size_t changed = 0;
      for (std::size_t at = 0; at < of.size(); ++at)
      {
        constexpr int far = 3; // light is moved by less than a pixel
        const int distance = distanceToEdge(few, at / perPixel, far);
        const double toMore = std::abs(of[at] - more[at]);
        if (distance == 0)
        {
          ASSERT_LE(toMore, noMore) << at;
        }
        else if (of[at] != fewer[at])
        {
          ASSERT_LT(distance, far) << at;
          ASSERT_LE(toMore, noMoreBeside) << at;
        }
        changed += of[at] != fewer[at] ? 1 : 0;
      }
      EXPECT_GT(changed, 20);
    };
    constexpr double ofLight = 1e-6; // films of other sizes hold light in other units
    constexpr double beside = 1e-3;  // rays there have no neighbours on one side
    expectIn(both.intensity, few.intensity, many.intensity, ofLight, beside);
    expectIn(both.blockedFraction, few.blockedFraction, many.blockedFraction, 0, 0);
    expectIn(both.deflection, few.deflection, many.deflection, 0, 0);
    if (cutoff == Cutoff::ColorFilter)
    {
      expectIn(both.color, few.color, many.color, ofLight, beside);
    }
    EXPECT_GT(both.raysTraced, few.raysTraced);
    EXPECT_LT(both.raysTraced, many.raysTraced);
    EXPECT_GT(both.raysBlocked, few.raysBlocked);
  }
}

INSTANTIATE_TEST_SUITE_P(, EdgesOfBodies, bothDevices(), deviceName);

/// `of`: rows from the lowest on, a letter for a pixel: '#', all of whose rays a body stops; '+', half; '.', none, whose light is
/// moved.
EdgePixels pixelsOf(const std::vector<std::string>& of, std::int64_t around, double right = 0)
{
  std::vector<RaysOfPixel> rays;
  for (const std::string& row : of)
  {
    for (const char pixel : row)
    {
      rays.push_back({ pixel == '#' ? 1.f : (pixel == '+' ? 0.5f : 0.f), { right, 0 } });
    }
  }
  return { rays, static_cast<std::int64_t>(of.front().size()) - 2 * around, around };
}

/// The same with '+' for pixels that edges light, and '-' for others that have rays.
std::vector<std::string> lettersOf(
  const EdgePixels& pixels, std::int64_t columns, std::int64_t rows)
{
  std::vector<std::string> letters;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    letters.emplace_back();
    for (std::int64_t column = 0; column < columns; ++column)
    {
      EXPECT_GE(pixels.hasRays(column, row), pixels.isLit(column, row));
      letters.back() += pixels.isLit(column, row) ? '+' : (pixels.hasRays(column, row) ? '-' : '.');
    }
  }
  return letters;
}

TEST(Edges, LightWhatIsBesideThemAndWhereTheirLightLands)
{
  using Letters = std::vector<std::string>;
  const auto expect = [](const Letters& of, double right, const Letters& expected)
  {
    EXPECT_EQ(lettersOf(pixelsOf(of, 0, right), static_cast<std::int64_t>(of.front().size()),
                static_cast<std::int64_t>(of.size())),
      expected);
  };
  const Letters none(3, "......"), all(3, "######");
  expect(none, 0, none);
  expect(all, 0, none);
  // What is dark has no light that lands anywhere.
  expect({ "###.....", "###.....", "###....." }, 0, { ".+++++-.", ".+++++-.", ".+++++-." });
  expect({ "###.....", "###.....", "###....." }, 2, { "..++++++", "..++++++", "..++++++" });
  Letters one(8, "........"), lit(6, "++++++-.");
  one[2] = "..+.....";
  lit.insert(lit.end(), { "-------.", "........" });
  expect(one, 0, lit);
}

TEST(Edges, AreExposedInSquaresThatHaveLitPixels)
{
  View view;
  view.width = 38;
  view.height = 18;
  const auto tilesWith = [&](std::int64_t column, std::int64_t row, double moved = 0)
  {
    const std::int64_t around = EdgeTiles::marginFor(moved);
    std::vector<std::string> all(18 + 2 * static_cast<std::size_t>(around),
      std::string(38 + 2 * static_cast<std::size_t>(around), '#'));
    all[static_cast<std::size_t>(row + around)][static_cast<std::size_t>(column + around)] = '+';
    return EdgeTiles::in(pixelsOf(all, around), view, moved);
  };
  const PatchList two = tilesWith(5, 9); // of two squares each
  ASSERT_EQ(two.size(), 2);
  EXPECT_EQ(two[0].column, 0);
  EXPECT_EQ(two[0].columns, 8);
  EXPECT_EQ(two[0].row, 4);
  EXPECT_EQ(two[0].rows, 4);
  EXPECT_EQ(two[0].margin, 2);
  EXPECT_EQ(two[1].row, 8);
  EXPECT_EQ(tilesWith(5, 9, 1.8)[0].margin, 4);
  const PatchList high = tilesWith(1, 5);
  ASSERT_EQ(high.size(), 1);
  EXPECT_EQ(high[0].columns, 4);
  EXPECT_EQ(high[0].rows, 8);
  const PatchList last = tilesWith(37, 17);
  ASSERT_EQ(last.size(), 2);
  EXPECT_EQ(last[1].column, 32);
  EXPECT_EQ(last[1].columns, 6);
  EXPECT_EQ(last[1].row, 16);
  EXPECT_EQ(last[1].rows, 2);
}

TEST(Edges, HaveEachRayOnceHoweverManyTilesNeedIt)
{
  // Stairs, whose margins overlap, and one that is alone.
  constexpr int samples = 3;
  constexpr std::int64_t margin = 3;
  PatchList tiles{ { 0, 0, 1, 0, 0, margin, 8, 4 }, { 4, 4, 1, 4, 4, margin, 4, 12 },
    { 8, 4, 1, 8, 4, margin, 12, 4 }, { 40, 2, 1, 40, 2, margin, 2, 4 } };
  std::vector<std::string> stairs;
  for (std::size_t row = 0; row < 16 + 2 * margin; ++row)
  {
    stairs.push_back(std::string(row + 5, '#') + std::string(43 - row, '.'));
  }
  const EdgePixels pixels = pixelsOf(stairs, margin);
  const RaysOfTiles rays(tiles.begin(), tiles.end(), pixels, samples);
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
          const std::optional<std::size_t> found = rays.ray(column, row, pass);
          ASSERT_EQ(found.has_value(), pixels.hasRays(column, row));
          if (found)
          {
            needed.insert({ column, row, pass });
            ASSERT_EQ(*found, placed.at({ column, row, pass }));
          }
        }
      }
    }
  }
  EXPECT_EQ(needed.size(), ray); // none that no tile needs
  EXPECT_GT(ray, 0);
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
  const Scene otherwise = sceneOf(Cutoff::BrightField, 1, 16); // whose rays see edges elsewhere
  expectSameImage(bench.render(flow.field, otherwise), Bench().render(flow.field, otherwise));
}

} // namespace

} // namespace schlieren
