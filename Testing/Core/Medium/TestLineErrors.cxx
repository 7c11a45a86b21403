// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/LineErrors.h"

#include "Medium/Tree/Brick.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace schlieren
{

namespace
{

constexpr int edge = BrickMaker<float>::edge;
constexpr std::array<double, 3> cube{ 1, 1, 1 };
constexpr std::array<bool, 3> all{ true, true, true };

std::vector<float> errorsOf(const std::function<double(int, int, int)>& at, int layers = edge)
{
  std::vector<float> errors;
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < edge; ++j)
    {
      for (int i = 0; i < edge; ++i)
      {
        errors.push_back(static_cast<float>(at(i, j, k)));
      }
    }
  }
  return errors;
}

LineErrors linesOf(const std::vector<float>& errors, std::size_t axis = 0,
  BrickShape shape = BrickShape::Cube, const std::array<double, 3>& voxel = cube)
{
  LineErrors lines;
  addLines(errors, axis, shape, voxel, GradientsOf::Gas, lines);
  return lines;
}

TEST(LineErrors, OfTheSameEverywhereAreThoseOfTheLongestLine)
{
  const LineErrors lines = linesOf(errorsOf([](int, int, int) { return 1; }));
  EXPECT_NEAR(lines.along({ 0, 0, 1 }, all).largest, edge, 1e-4);
  EXPECT_NEAR(lines.along({ 0, -1, 1 }, all).largest, edge * std::sqrt(2.), 1e-4);
  // Of a gradient along x, sqrt(2/3) is across the diagonal, which is sqrt(3) edges long.
  EXPECT_NEAR(lines.along({ -1, 1, 1 }, all).largest, edge * std::sqrt(2.), 1e-4);
  EXPECT_EQ(lines.along({ 1, 0, 0 }, all).largest, 0);
  EXPECT_NEAR(lines.along({ 0, 0, 1 }, all).typical, edge, 1e-4);
  EXPECT_EQ(lines.along({ 0, 0, 1 }, all).largestAtEdges, 0);
}

TEST(LineErrors, OfAnyValuesAreThoseThatALoopFinds)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> values(-1, 1);
  const std::vector<float> errors = errorsOf([&](int, int, int) { return values(generator); });
  const LineErrors lines = linesOf(errors);
  for (const std::array<int, 3>& step : lineDirections)
  {
    double largest = 0;
    for (int start = 0; start < edge * edge * edge; ++start)
    {
      std::array<int, 3> at{ start % edge, start / edge % edge, start / edge / edge };
      bool isFirst = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isFirst =
          isFirst || (step[axis] > 0 && at[axis] == 0) || (step[axis] < 0 && at[axis] == edge - 1);
      }
      const auto isIn = [&] {
        return at[0] >= 0 && at[0] < edge && at[1] >= 0 && at[1] < edge && at[2] >= 0 &&
          at[2] < edge;
      };
      double sum = 0;
      while (isFirst && isIn())
      {
        sum += static_cast<double>(
          errors[static_cast<std::size_t>((at[2] * edge + at[1]) * edge + at[0])]);
        largest = std::max(largest, std::abs(sum));
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          at[axis] += step[axis];
        }
      }
    }
    const double across = std::sqrt(static_cast<double>(step[1] * step[1] + step[2] * step[2]));
    const Vec3<double> direction{ static_cast<double>(step[0]), static_cast<double>(step[1]),
      static_cast<double>(step[2]) };
    EXPECT_NEAR(lines.along(direction, all).largest, across * largest, 1e-4);
  }
}

TEST(LineErrors, OfASheetAreLargeAlongItAlone)
{
  // What alternates from voxel to voxel cancels out along lines, as far as their number is even.
  const LineErrors sheet = linesOf(errorsOf([](int i, int, int) { return i == 5 ? 1 : 0; }));
  EXPECT_NEAR(sheet.along({ 0, 0, 1 }, all).largest, edge, 1e-4);
  EXPECT_NEAR(sheet.along({ 0, 0, 1 }, all).typical, edge / 4., 1e-4);
  EXPECT_NEAR(sheet.along({ 1, 0, 1 }, all).largest, 1, 1e-4);
  const LineErrors noise =
    linesOf(errorsOf([](int i, int j, int k) { return (i + j + k) % 2 == 0 ? 1 : -1; }));
  EXPECT_NEAR(noise.along({ 0, 0, 1 }, all).largest, 1, 1e-4);
  EXPECT_NEAR(noise.along({ 0, 0, 1 }, all).typical, 0, 1e-4);
}

TEST(LineErrors, ChangeGraduallyWithTheDirection)
{
  const LineErrors sheet = linesOf(errorsOf([](int i, int, int) { return i == 5 ? 1 : 0; }));
  const auto at = [&](double x) { return sheet.along({ x, 0, 1 }, all).largest; };
  EXPECT_NEAR(at(0.5), 0.5 * (at(0) + at(1)), 1e-6);
  EXPECT_NEAR(at(-0.25), 0.75 * at(0) + 0.25 * at(-1), 1e-6);
  EXPECT_EQ(sheet.along({ 0, 0, 0 }, all).largest, 0);
}

TEST(LineErrors, AreByTheLengthOfVoxels)
{
  const std::vector<float> same = errorsOf([](int, int, int) { return 1; });
  const LineErrors lines = linesOf(same, 0, BrickShape::Cube, { 0.5, 1, 4 });
  // 16 voxels of 4, a gradient of 1 by 0.5.
  EXPECT_NEAR(lines.along({ 0, 0, 1 }, all).largest, 128, 1e-3);
  const LineErrors layer =
    linesOf(errorsOf([](int, int, int) { return 1; }, 1), 0, BrickShape::Layer, { 1, 1, 100 });
  EXPECT_NEAR(layer.along({ 0, 0, 1 }, all).largest, edge, 1e-4); // over a path as long as an edge
  EXPECT_NEAR(layer.along({ 0, 1, 0 }, all).largest, edge, 1e-4);
}

} // namespace

} // namespace schlieren
