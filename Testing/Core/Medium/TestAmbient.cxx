// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// N of the surroundings, from what is at the boundary.
#include "Fields.h"
#include "Medium/Medium.h"
#include "Medium/Samples/Ambient.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace schlieren
{

namespace
{

/// Values along a boundary of length 1.
template <class Value>
std::vector<WeightedValue> along(const Value& value)
{
  constexpr int count = 1000;
  std::vector<WeightedValue> values;
  for (int i = 0; i < count; ++i)
  {
    values.push_back({ value((i + 0.5) / count), 1. / count });
  }
  return values;
}

} // namespace

// Less than half of the boundary of a supersonic flow is before its shocks.
TEST(Ambient, IsTheUndisturbedInflowOfAFlowWithShocks)
{
  std::vector<WeightedValue> values =
    along([](double s) { return s < 0.3 ? 1.4 : 3 + 2 * std::sin(9 * s); });
  EXPECT_EQ(ambientOf(values), 1.4);
  std::shuffle(values.begin(), values.end(), std::mt19937(1));
  EXPECT_EQ(ambientOf(values), 1.4);
  std::mt19937 noise(2);
  for (WeightedValue& one : values)
  {
    one.value += std::normal_distribution<double>(0, 2e-3)(noise);
  }
  EXPECT_NEAR(ambientOf(values), 1.4, 2e-3);
}

// Weights are areas: a tenth of the faces, ten times as large, is half of the boundary.
TEST(Ambient, IsWeightedByArea)
{
  std::vector<WeightedValue> values =
    along([](double s) { return s < 0.1 ? 2. : 5 + std::sin(30 * s); });
  EXPECT_GT(ambientOf(values), 3);
  std::for_each(values.begin(), values.begin() + 100, [](WeightedValue& one) { one.weight *= 10; });
  EXPECT_EQ(ambientOf(values), 2);
}

// No value has more of the boundary than all others: gas of layers, both sides of a mixing layer, two
// walls of a cavity, a shock tube.
TEST(Ambient, IsTheMedianWhereNoValuePrevails)
{
  EXPECT_NEAR(ambientOf(along([](double s) { return 1 + s; })), 1.5, 1e-3);
  EXPECT_NEAR(
    ambientOf(along([](double s) { return s < 0.45 ? 1
                                     : s > 0.55    ? 2
                                                   : 1 + 10 * (s - 0.45); })),
    1.5, 0.01);
  EXPECT_NEAR(
    ambientOf(along([](double s) { return s < 0.25 ? 1
                                     : s > 0.75    ? 2
                                                   : 1.5 + 0.9 * (s - 0.5); })),
    1.5, 0.01);
  EXPECT_EQ(ambientOf(along([](double s) { return s < 0.4 ? 1. : 0.125; })), 0.125);
  EXPECT_EQ(ambientOf(along([](double) { return 0.25; })), 0.25);
  EXPECT_TRUE(std::isnan(ambientOf({})));
}

// All points of two layers are on faces: a plane's surroundings are at its edges.
TEST(Ambient, OfAnExtrudedPlaneIsAtItsEdges)
{
  for (std::size_t across = 0; across < 3; ++across)
  {
    Grid grid;
    grid.dimensions = { 41, 41, 41 };
    grid.dimensions[across] = 2;
    const SampledField<float> field(grid,
      [=](double x, double y, double z)
      {
        const double from[3] = { x - 20, y - 20, z - 20 };
        return std::hypot(from[(across + 1) % 3], from[(across + 2) % 3]) < 18 ? 4e-4 : 2.7e-4;
      });
    EXPECT_FLOAT_EQ(
      static_cast<float>(buildMedium<float>(field.field, Interpolation::Quadratic, 1).ambient),
      2.7e-4f)
      << across;
  }
}

} // namespace schlieren
