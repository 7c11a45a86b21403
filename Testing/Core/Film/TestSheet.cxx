// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The ray-tube estimator's cells, one by one and as lattices, against areas and integrals found in other ways.
#include "Film/Sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace schlieren
{

namespace
{

constexpr int width = 12, height = 9;
constexpr double one = 1LL << 32;

/// A film of two planes that only remembers.
struct Recorder
{
  std::array<std::vector<std::int64_t>, 2> pixels{ std::vector<std::int64_t>(width * height),
    std::vector<std::int64_t>(width* height) };
  std::array<std::int64_t, 2> sent{}, lost{};

  void emitted(int plane, std::int64_t light) { sent.at(static_cast<std::size_t>(plane)) += light; }
  void outside(int plane, std::int64_t light) { lost.at(static_cast<std::size_t>(plane)) += light; }
  void pixel(int plane, std::int64_t column, std::int64_t row, std::int64_t light)
  {
    ASSERT_TRUE(column >= 0 && column < width && row >= 0 && row < height);
    pixels.at(static_cast<std::size_t>(plane)).at(static_cast<std::size_t>(row * width + column)) +=
      light;
  }
  void block(int plane, std::int64_t column, std::int64_t row, const Contributions& contributions)
  {
    const auto add = [&](std::int64_t i, std::int64_t j, std::int64_t light) {
      i >= 0 && i < width&& j >= 0 && j < height ? pixel(plane, i, j, light)
                                                 : outside(plane, light);
    };
    add(column, row, contributions.lowerLeft);
    add(column + 1, row, contributions.lowerRight);
    add(column, row + 1, contributions.upperLeft);
    add(column + 1, row + 1, contributions.upperRight);
  }

  double at(int column, int row, std::size_t plane = 0) const
  {
    return static_cast<double>(
             pixels.at(plane).at(static_cast<std::size_t>(row * width + column))) /
      one;
  }
  std::int64_t onFilm(std::size_t plane = 0) const
  {
    return std::accumulate(pixels.at(plane).begin(), pixels.at(plane).end(), std::int64_t{ 0 });
  }
};

using Ray = FilmRay<2>;

constexpr FilmSize filmSize{ width, height, one };
using Map = std::function<std::array<double, 2>(double, double)>;
using LightOf = std::function<double(double, double)>;

double even(double, double) { return 1; }

/// A lattice of rays from `first` to `last` pixels (both ways, from the film's corner) that land where
/// `landing` says; the second plane has three quarters of the light of the first one.
Recorder exposed(int first, int last, const std::array<double, 2>& offset, const Map& landing,
  const LightOf& light = even)
{
  Recorder film;
  Sheet<2, Recorder> sheet(filmSize, film);
  const auto ray = [&](int i, int j)
  {
    const double x = i + offset[0], y = j + offset[1];
    const std::array<double, 2> at = landing(x, y);
    return Ray{ at[0], at[1], { light(x, y), 0.75 * light(x, y) }, true };
  };
  for (int j = first; j < last; ++j)
  {
    for (int i = first; i < last; ++i)
    {
      sheet.addCell(ray(i, j), ray(i + 1, j), ray(i, j + 1), ray(i + 1, j + 1));
    }
  }
  for (std::size_t plane = 0; plane < 2; ++plane)
  {
    EXPECT_EQ(film.sent.at(plane), film.onFilm(plane) + film.lost.at(plane));
  }
  return film;
}

Map undisturbed()
{
  return [](double x, double y) { return std::array<double, 2>{ x, y }; };
}

Recorder exposed(const std::array<std::array<double, 2>, 4>& at)
{
  Recorder film;
  const auto ray = [&at](std::size_t i) { return Ray{ at[i][0], at[i][1], { 1, 0.5 }, true }; };
  Sheet<2, Recorder>(filmSize, film).addCell(ray(0), ray(1), ray(3), ray(2));
  EXPECT_EQ(film.sent[0], one);
  for (std::size_t plane = 0; plane < 2; ++plane)
  {
    EXPECT_EQ(film.sent.at(plane), film.onFilm(plane) + film.lost.at(plane));
    EXPECT_GE(*std::min_element(film.pixels.at(plane).begin(), film.pixels.at(plane).end()), -1000);
    EXPECT_GE(film.lost.at(plane), -1000);
  }
  return film;
}

using Polygon = std::vector<std::array<double, 2>>;

/// What of a polygon has sign * coordinate <= limit (Sutherland & Hodgman 1974).
Polygon cut(const Polygon& polygon, std::size_t axis, double sign, double limit)
{
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    const double da = limit - sign * a[axis], db = limit - sign * b[axis];
    if (da >= 0)
    {
      inside.push_back(a);
    }
    if ((da > 0 && db < 0) || (da < 0 && db > 0))
    {
      const double t = da / (da - db);
      inside.push_back({ a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]) });
    }
  }
  return inside;
}

double areaOf(const Polygon& polygon)
{
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

Polygon within(const Polygon& polygon, double left, double right, double low, double high)
{
  return cut(cut(cut(cut(polygon, 0, -1, -left), 0, 1, right), 1, -1, -low), 1, 1, high);
}

TEST(Sheet, UndisturbedLightIsEvenUpToTheBorder)
{
  for (const std::array<double, 2>& offset :
    { std::array<double, 2>{ 0.5, 0.5 }, { 0, 0.999 }, { 0.25, 0.7 }, { 1e-9, 0.3 }, { 0.123, 1 } })
  {
    const Recorder film = exposed(-1, std::max(width, height) + 1, offset, undisturbed());
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        ASSERT_NEAR(film.at(column, row), 1, 16 / one);
        ASSERT_NEAR(film.at(column, row, 1), 0.75, 16 / one);
      }
    }
  }
}

/// The integral from -infinity to x of the hat function max(0, 1 - |x|).
double hatIntegral(double x)
{
  x = std::clamp(x, -1., 1.);
  return x < 0 ? 0.5 * (1 + x) * (1 + x) : 1 - 0.5 * (1 - x) * (1 - x);
}

/// Where nothing is bent a pixel gets the mean over its square of light that is bilinear between the rays.
TEST(Sheet, UndisturbedLightIsInterpolatedBilinearly)
{
  const auto light = [](double x, double y)
  { return 0.5 + 0.5 * std::sin(17.3 * std::floor(x) + 5.1 * std::floor(y)); };
  for (const std::array<double, 2>& offset :
    { std::array<double, 2>{ 0.5, 0.5 }, { 0.1, 0.8 }, { 0.9, 0.35 } })
  {
    const Recorder film = exposed(-2, 14, offset, undisturbed(), light);
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        double expected = 0;
        for (int j = row - 2; j <= row + 2; ++j)
        {
          for (int i = column - 2; i <= column + 2; ++i)
          {
            const double x = i + offset[0], y = j + offset[1];
            expected += light(x, y) * (hatIntegral(column + 1 - x) - hatIntegral(column - x)) *
              (hatIntegral(row + 1 - y) - hatIntegral(row - y));
          }
        }
        ASSERT_NEAR(film.at(column, row), expected, 1e-8) << column << ' ' << row;
      }
    }
  }
  // Rays at the centres of pixels: the weights 1, 6, 1 eighths.
  const Recorder film = exposed(-2, 14, { 0.5, 0.5 }, undisturbed(),
    [](double x, double y) { return x == 5.5 && y == 4.5 ? 1 : 0; });
  EXPECT_NEAR(film.at(5, 4), 36. / 64, 1e-8);
  EXPECT_NEAR(film.at(4, 4), 6. / 64, 1e-8);
  EXPECT_NEAR(film.at(6, 5), 1. / 64, 1e-8);
}

/// I = 1 / |det|, whether light is spread, concentrated, sheared, turned or mirrored.
TEST(Sheet, LinearMapsGiveTheirDeterminant)
{
  const std::array<std::array<double, 4>, 10> maps = { {
    { 1, 0, 0, 1 },
    { 1.2, 0.1, -0.2, 0.9 },
    { 0.3, 0, 0, 0.4 },
    { 2.5, 0.3, 0.1, 3.1 },
    { -1, 0, 0, 1 },
    { 0, 1, 1, 0 },
    { -0.7, 0.2, 0.1, -0.6 },
    { 0.6, -0.8, 0.8, 0.6 },
    { 14, 3, -5, 11 },
    { 1, 0.9, 0.9, 1 },
  } };
  for (const auto& m : maps)
  {
    const double det = m[0] * m[3] - m[1] * m[2];
    const auto landing = [&m](double x, double y)
    {
      return std::array<double, 2>{ 6 + m[0] * (x - 6) + m[1] * (y - 4.5),
        4.5 + m[2] * (x - 6) + m[3] * (y - 4.5) };
    };
    // Linear light stays linear.
    const auto light = [](double x, double y) { return 0.5 + 0.002 * x - 0.001 * y; };
    const int around = 60;
    const Recorder bright = exposed(-around, around, { 0.5, 0.3 }, landing);
    const Recorder film = exposed(-around, around, { 0.5, 0.3 }, landing, light);
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        const double x = column + 0.5 - 6, y = row + 0.5 - 4.5;
        const double expected =
          light(6 + (m[3] * x - m[1] * y) / det, 4.5 + (m[0] * y - m[2] * x) / det) / std::abs(det);
        // Next to exact: the middle of a cut cell's part is taken for that of its corners.
        ASSERT_NEAR(film.at(column, row), expected, 1e-4 * expected)
          << m[0] << ' ' << m[1] << ' ' << m[2] << ' ' << m[3];
      }
    }
  }
}

/// Each pixel's fraction of a cell of any convex shape is that of the area.
TEST(Sheet, ConvexCellsAreCutExactly)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  int tested = 0;
  while (tested < 2000)
  {
    const double size = std::pow(10, 3 * any(random) - 2);
    const std::array<double, 2> origin{ 16 * any(random) - 2, 13 * any(random) - 2 };
    Polygon quad;
    for (int i = 0; i < 4; ++i)
    {
      quad.push_back({ origin[0] + size * any(random), origin[1] + size * any(random) });
    }
    bool isConvex = true;
    for (std::size_t i = 0; i < 4; ++i)
    {
      isConvex &= areaOf({ quad[i], quad[(i + 1) % 4], quad[(i + 2) % 4] }) > 1e-3 * size * size;
    }
    if (!isConvex)
    {
      continue;
    }
    if (++tested % 2 == 0)
    {
      std::reverse(quad.begin(), quad.end());
    }
    const Recorder film = exposed({ quad[0], quad[1], quad[2], quad[3] });
    const double area = areaOf(quad);
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        const double expected = areaOf(within(quad, column, column + 1, row, row + 1)) / area;
        ASSERT_NEAR(film.at(column, row), expected, 1e-8);
        ASSERT_NEAR(film.at(column, row, 1), 0.5 * expected, 1e-8);
      }
    }
    ASSERT_NEAR(static_cast<double>(film.lost[0]) / one,
      1 - areaOf(within(quad, 0, width, 0, height)) / area, 1e-7);
  }
}

/// What falls beside the film is found by itself, so the residue of rounding is a few units.
TEST(Sheet, NothingIsLeftOver)
{
  struct Watching : Recorder
  {
    std::int64_t last = 0; ///< the residue is what is added last
    void pixel(int plane, std::int64_t column, std::int64_t row, std::int64_t light)
    {
      last = light;
      Recorder::pixel(plane, column, row, light);
    }
    void outside(int plane, std::int64_t light)
    {
      last = light;
      Recorder::outside(plane, light);
    }
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  for (int n = 0; n < 2000; ++n)
  {
    Watching film;
    const auto ray = [&] {
      return Ray{ 40 * any(random) - 14, 37 * any(random) - 14, { any(random), any(random) },
        true };
    };
    Sheet<2, Watching>(filmSize, film).addCell(ray(), ray(), ray(), ray());
    const bool isBesideIt = film.onFilm() == 0;
    ASSERT_TRUE(isBesideIt || std::abs(film.last) < 1000) << film.last;
  }
}

/// The light of a phase that is linear in a parallelogram that covers several pixels.
TEST(Sheet, FringesOfAnyCellHaveTheirMean)
{
  const auto turns = [](double s, double t) { return 0.15 + 0.15 * s + 0.1 * t; };
  const auto ray = [&](double s, double t) {
    return FilmRay<1>{ 2.3 + 2.6 * s + 0.3 * t, 2.1 + 0.5 * s + 2.3 * t, { turns(s, t) }, true };
  };
  Recorder film;
  Sheet<1, Recorder, coverageTileSize, true>(filmSize, film)
    .addCell(ray(0, 0), ray(1, 0), ray(0, 1), ray(1, 1));
  const double pi = std::acos(-1.);
  const auto contrast = [&](double over) { return std::sin(pi * over) / (pi * over); };
  const double mean =
    0.5 + 0.5 * std::cos(2 * pi * turns(0.5, 0.5)) * contrast(0.15) * contrast(0.1);
  EXPECT_NEAR(static_cast<double>(film.sent[0]) / one, mean, 1e-9);
  EXPECT_EQ(film.sent[0], film.onFilm());
}

/// Cells that are no areas: their light arrives, in full and where they are.
TEST(Sheet, CollapsedCellsKeepTheirLight)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  // In a point, also on the border of pixels.
  EXPECT_EQ(exposed({ { { 3.3, 4.4 }, { 3.3, 4.4 }, { 3.3, 4.4 }, { 3.3, 4.4 } } }).at(3, 4), 1);
  EXPECT_EQ(exposed({ { { 3, 4 }, { 3, 4 }, { 3, 4 }, { 3, 4 } } }).at(3, 4), 1);
  EXPECT_EQ(exposed({ { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } } }).at(0, 0), 1);
  // Along a line.
  const Recorder line = exposed({ { { 2, 3.5 }, { 6, 3.5 }, { 6, 3.5 }, { 2, 3.5 } } });
  for (int column = 2; column < 6; ++column)
  {
    EXPECT_NEAR(line.at(column, 3), 0.25, 1e-6);
  }
  const Recorder back = exposed({ { { 2, 2 }, { 5, 5 }, { 2, 2 }, { 5, 5 } } });
  EXPECT_NEAR(back.at(2, 2) + back.at(3, 3) + back.at(4, 4), 1, 1e-6);
  // A bow tie and an arrow.
  const Recorder tie = exposed({ { { 2, 2 }, { 4, 2 }, { 2, 4 }, { 4, 4 } } });
  EXPECT_NEAR(tie.at(2, 2) + tie.at(3, 2) + tie.at(2, 3) + tie.at(3, 3), 1, 1e-6);
  EXPECT_NEAR(tie.at(2, 3), tie.at(3, 2), 1e-6);
  EXPECT_EQ(exposed({ { { 2, 2 }, { 2.9, 2.1 }, { 2.3, 2.2 }, { 2.1, 2.9 } } }).at(2, 2), 1);
  // Nowhere.
  for (const double far : { nan, inf, -inf, 1e300, 1e200, -1e12 })
  {
    for (std::size_t corner = 0; corner < 4; ++corner)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        std::array<std::array<double, 2>, 4> at{ { { 3, 3 }, { 4, 3 }, { 4, 4 }, { 3, 4 } } };
        at.at(corner).at(axis) = far;
        exposed(at);
      }
    }
    EXPECT_EQ(exposed({ { { far, far }, { far, far }, { far, far }, { far, far } } }).lost[0], one);
  }
}

/// A cell as large as many films lights each pixel of it alike.
TEST(Sheet, CellsOfAnySizeAreSpread)
{
  for (const double size : { 20., 300., 1e5 })
  {
    const Recorder film =
      exposed({ { { -size, -size }, { size, -size }, { size, size }, { -size, size } } });
    const double expected = 0.25 / (size * size);
    EXPECT_NEAR(film.at(0, 0), expected, 1e-3 * expected + 50 / one);
    EXPECT_NEAR(film.at(11, 8), expected, 1e-3 * expected + 50 / one);
    EXPECT_NEAR(static_cast<double>(film.lost[0]) / one, 1 - width * height * expected, 1e-6);
  }
}

/// A quarter of a cell for each ray that arrives: light is even up to half a cell past the last of them.
TEST(Sheet, LightIsEvenUpToAShadow)
{
  for (const std::array<double, 2>& offset :
    { std::array<double, 2>{ 0.5, 0.5 }, { 0.1, 0.8 }, { 0.95, 0.35 }, { 0, 1 } })
  {
    Recorder film;
    Sheet<2, Recorder> sheet(filmSize, film);
    const auto ray = [&](int i, int j)
    {
      const bool arrives = i < 6 && j >= 3;
      return arrives ? Ray{ i + offset[0], j + offset[1], { 1, 0.75 }, true }
                     : Ray{ std::nan(""), 1e300, { 1, 1 }, false };
    };
    for (int j = -2; j < 14; ++j)
    {
      for (int i = -2; i < 14; ++i)
      {
        sheet.addCell(ray(i, j), ray(i + 1, j), ray(i, j + 1), ray(i + 1, j + 1));
      }
    }
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        const double expected = std::clamp(5.5 + offset[0] - column, 0., 1.) *
          std::clamp(row + 1 - 2.5 - offset[1], 0., 1.);
        ASSERT_NEAR(film.at(column, row), expected, 1e-8);
        ASSERT_NEAR(film.at(column, row, 1), 0.75 * expected, 1e-8);
      }
    }
    EXPECT_EQ(film.sent[0], film.onFilm() + film.lost[0]);
    EXPECT_GT(film.lost[0], 0);
  }
}

/// Interpolation between rays adds a twelfth of the second difference to light's mean: it is taken off before.
TEST(SheetRay, LightHasItsMeanBetweenRays)
{
  const auto square = [](double x, double y) {
    return Ray{ x, y, { 0.1 + 0.03 * x * x + 0.01 * y * y - 0.02 * x * y, 0.5 }, true };
  };
  for (const std::array<double, 2>& offset : { std::array<double, 2>{ 0.5, 0.5 }, { 0.1, 0.8 } })
  {
    Recorder film;
    Sheet<2, Recorder> sheet(filmSize, film);
    const auto around = [&](int i, int j)
    { return square(0.25 * (i + offset[0]), 0.25 * (j + offset[1])); };
    const auto ray = [&](int i, int j)
    {
      SheetRay<2> at = sheetRay(
        around(i, j), around(i - 1, j), around(i + 1, j), around(i, j - 1), around(i, j + 1));
      at.x = i + offset[0];
      at.y = j + offset[1];
      EXPECT_NEAR(at.bend, 0, 1e-12);
      return at;
    };
    for (int j = -2; j < 12; ++j)
    {
      for (int i = -2; i < 14; ++i)
      {
        sheet.addCell(ray(i, j), ray(i + 1, j), ray(i, j + 1), ray(i + 1, j + 1), around);
      }
    }
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        // The mean over the pixel: that of x^2 is x^2 + h^2 / 12.
        const double x = 0.25 * (column + 0.5), y = 0.25 * (row + 0.5);
        const double expected = square(x, y).light[0] + (0.03 + 0.01) * 0.0625 / 12;
        ASSERT_NEAR(film.at(column, row), expected, 1e-8);
        ASSERT_NEAR(film.at(column, row, 1), 0.5, 1e-8);
      }
    }
  }
}

TEST(SheetRay, TakesNothingFromNeighboursThatDoNotArrive)
{
  const Ray here{ 3, 4, { 0.5, 1 }, true }, bright{ 4, 4, { 1, 0 }, true };
  const Ray none{ std::nan(""), 1e300, { 1, 1 }, false };
  const SheetRay<2> alone = sheetRay(here, bright, none, none, bright);
  EXPECT_EQ(alone.light[0], 0.5);
  EXPECT_EQ(alone.bend, 0);
  const Ray right{ 2.5, 4.25, { 0.25, 0 }, true };
  const SheetRay<2> among = sheetRay(here, bright, right, none, none);
  EXPECT_DOUBLE_EQ(among.light[0], 0.5 - 0.25 / 12);
  EXPECT_EQ(among.light[1], 1); // limited
  EXPECT_DOUBLE_EQ(among.bend, 0.5);
  EXPECT_FALSE(sheetRay(none, here, here, here, here).arrives);
}

/// Cubics continue where straight lines would cut a corner: quadratic maps are followed to the second order.
TEST(SheetRay, BentCellsAreRefined)
{
  const auto lands = [](double x, double y)
  {
    return std::array<double, 2>{ 6 + (x - 6) - 0.03 * (x - 6) * (x - 6) + 0.02 * (y - 4) * (y - 4),
      4 + 0.9 * (y - 4) - 0.02 * (x - 6) * (y - 4) };
  };
  Recorder film, plain = exposed(-3, 17, { 0.5, 0.5 }, lands);
  const auto around = [&](int i, int j)
  {
    const std::array<double, 2> at = lands(i + 0.5, j + 0.5);
    return Ray{ at[0], at[1], { 1, 0.75 }, true };
  };
  const auto ray = [&](int i, int j)
  {
    return sheetRay(
      around(i, j), around(i - 1, j), around(i + 1, j), around(i, j - 1), around(i, j + 1));
  };
  for (int j = -3; j < 17; ++j)
  {
    for (int i = -3; i < 17; ++i)
    {
      Sheet<2, Recorder>(filmSize, film)
        .addCell(ray(i, j), ray(i + 1, j), ray(i, j + 1), ray(i + 1, j + 1),
          [&](int right, int up) { return around(i + right, j + up); });
    }
  }
  EXPECT_EQ(film.sent[0], film.onFilm() + film.lost[0]);
  double worst = 0, worstOfPlain = 0;
  for (int row = 2; row < 7; ++row)
  {
    for (int column = 3; column < 9; ++column)
    {
      double expected = 0;
      constexpr int points = 200; // along each axis, counted where they land
      for (int j = (row - 2) * points; j < (row + 3) * points; ++j)
      {
        for (int i = (column - 2) * points; i < (column + 3) * points; ++i)
        {
          const std::array<double, 2> at = lands((i + 0.5) / points, (j + 0.5) / points);
          expected += at[0] >= column && at[0] < column + 1 && at[1] >= row && at[1] < row + 1
            ? 1. / (points * points)
            : 0;
        }
      }
      worst = std::max(worst, std::abs(film.at(column, row) - expected));
      worstOfPlain = std::max(worstOfPlain, std::abs(plain.at(column, row) - expected));
    }
  }
  EXPECT_LT(worst, 3e-3);
  EXPECT_GT(worstOfPlain, 2 * worst) << worst;
}

/// A device spreads what few cells need in a second step, and looks at one row of pixels at a time.
TEST(SheetRay, TwoStepsAreAsGoodAsOne)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  int others = 0;
  for (const double disorder : { 0., 0.3, 2., 20. })
  {
    std::array<std::array<Ray, 16>, 16> rays;
    for (std::size_t j = 0; j < rays.size(); ++j)
    {
      for (std::size_t i = 0; i < rays.size(); ++i)
      {
        rays.at(j).at(i) = { static_cast<double>(i) - 1.8 + disorder * any(random),
          static_cast<double>(j) - 3.1 + disorder * any(random), { 0.5 + any(random), 1 },
          any(random) < 0.47 };
      }
    }
    const auto at = [&rays](int i, int j)
    {
      return i >= 0 && i < 16 && j >= 0 && j < 16
        ? rays.at(static_cast<std::size_t>(j)).at(static_cast<std::size_t>(i))
        : Ray{};
    };
    Recorder film, inSteps;
    Sheet<2, Recorder> sheet(filmSize, film);
    Sheet<2, Recorder, 1> sheetInSteps(filmSize, inSteps);
    for (int j = 0; j < 15; ++j)
    {
      for (int i = 0; i < 15; ++i)
      {
        const auto around = [&](int right, int up) { return at(i + right, j + up); };
        const auto ray = [&](int right, int up)
        {
          return sheetRay(around(right, up), around(right - 1, up), around(right + 1, up),
            around(right, up - 1), around(right, up + 1));
        };
        sheet.addCell(ray(0, 0), ray(1, 0), ray(0, 1), ray(1, 1), around);
        if (!sheetInSteps.addPlain(ray(0, 0), ray(1, 0), ray(0, 1), ray(1, 1)))
        {
          ++others;
          for (int part = 0; part < 4; ++part)
          {
            sheetInSteps.addOther(part, ray(0, 0), ray(1, 0), ray(0, 1), ray(1, 1), around);
          }
        }
      }
    }
    EXPECT_EQ(film.pixels, inSteps.pixels);
    EXPECT_EQ(film.sent, inSteps.sent);
    EXPECT_EQ(film.lost, inSteps.lost);
  }
  EXPECT_GT(others, 200);
  EXPECT_LT(others, 800);
}

} // namespace

} // namespace schlieren
