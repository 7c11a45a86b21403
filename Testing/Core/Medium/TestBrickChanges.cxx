// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnalyticSources.h"
#include "Medium/Tree/BrickChanges.h"
#include "TreeSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

constexpr int edge = BrickMaker<float>::edge;
constexpr std::size_t stored = edge + 2;

std::vector<double> randomSamples(BrickShape shape)
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> values(-1, 1);
  std::vector<double> samples(stored * stored * (shape == BrickShape::Layer ? 1 : stored));
  std::generate(samples.begin(), samples.end(), [&] { return values(generator); });
  return samples;
}

TEST(BrickChanges, CoefficientsOfAPartMakeTheSameSpline)
{
  for (const BrickShape shape : { BrickShape::Cube, BrickShape::Layer })
  {
    const std::vector<double> box = randomSamples(shape);
    for (std::int32_t part = 0; part < (shape == BrickShape::Layer ? 4 : 8); ++part)
    {
      const std::vector<double> ofPart = coefficientsOfChild(box.data(), part, shape);
      ASSERT_EQ(ofPart.size(), box.size());
      for (int n = 0; n < 500; ++n)
      {
        const Vec3<double> at{ -0.5 + std::fmod(0.7548 * n, 1.) * edge,
          -0.5 + std::fmod(0.5698 * n, 1.) * edge,
          shape == BrickShape::Layer ? 0 : -0.5 + std::fmod(0.3247 * n, 1.) * edge };
        const auto inBox = [&](double local, int axis)
        { return edge / 2 * (part >> axis & 1) + (local + 0.5) / 2 - 0.5; };
        const Vec3<double> atBox{ inBox(at.x, 0), inBox(at.y, 1),
          shape == BrickShape::Layer ? 0 : inBox(at.z, 2) };
        const auto a = interpolateBrick<QuadraticInterpolation>(ofPart.data(), 1, shape, at);
        const auto b = interpolateBrick<QuadraticInterpolation>(box.data(), 1, shape, atBox);
        EXPECT_NEAR(a.value, b.value, 1e-14);
        EXPECT_NEAR(2 * a.gradient.x, b.gradient.x, 1e-13);
        EXPECT_NEAR(2 * a.gradient.y, b.gradient.y, 1e-13);
      }
    }
  }
}

/// Errors of a child that could be better along all axes, and beside edges.
LineErrors errorsOf(Brick<double> made, const std::vector<double>& box)
{
  constexpr std::array<double, 3> voxel{ 0.1, 0.2, 0.1 };
  made.facts.canImprove = { true, true, true };
  made.facts.canImproveAtEdges = { true, true, true };
  addErrorsByChange(made, 5, box.data(), 0., BrickShape::Cube, voxel);
  return made.facts.errors;
}

TEST(BrickChanges, AreWhatGradientsChangeBy)
{
  constexpr std::array<bool, 3> all{ true, true, true };
  const Vec3<double> alongY{ 0, 1, 0 };
  const std::vector<double> box = randomSamples(BrickShape::Cube);
  Brick<double> made;
  made.samples = coefficientsOfChild(box.data(), 5, BrickShape::Cube);
  EXPECT_EQ(errorsOf(made, box).along(alongY, all).largest, 0);
  // A step of 1 along x: along the longest edge of the part, 16 voxels of 0.2, a gradient of 1 by 0.1.
  made.offset = 3;
  for (std::size_t at = 0; at < made.samples.size(); ++at)
  {
    made.samples[at] += (at % stored > 7 ? 1 : 0) - 3;
  }
  const LineErrors errors = errorsOf(made, box);
  EXPECT_NEAR(errors.along(alongY, all).largest, 32. / 3, 1e-4);
  EXPECT_NEAR(errors.along(alongY, { false, true, true }).largest, 0, 1e-4);
  EXPECT_NEAR(errors.along(alongY, all).typical, 32. / 3 / 4, 1e-4); // one of 16 columns
  EXPECT_NEAR(errors.along({ 1, 0, 0 }, all).largest, 0, 1e-12);     // light across the step
  // Behind a wall nothing counts, at the wall it does; there an error is three times as large, by the same change.
  made.gasDistances.assign(made.samples.size(), 2);
  const auto wallFrom = [&](std::size_t first)
  {
    for (std::size_t at = 0; at < made.samples.size(); ++at)
    {
      made.gasDistances[at] = at % stored >= first ? -2 : 2;
    }
  };
  wallFrom(7);
  EXPECT_EQ(errorsOf(made, box).along(alongY, all).largest, 0);
  EXPECT_EQ(errorsOf(made, box).along(alongY, all).largestAtEdges, 0);
  wallFrom(9);
  EXPECT_NEAR(errorsOf(made, box).along(alongY, all).largest, 0, 1e-12);
  EXPECT_NEAR(errorsOf(made, box).along(alongY, all).largestAtEdges, 32, 1e-3);
  wallFrom(11);
  EXPECT_NEAR(errorsOf(made, box).along(alongY, all).largest, 32. / 3, 1e-4);
  made.samples.clear();
  EXPECT_EQ(errorsOf(made, box).along(alongY, all).largest, 0);
}

/// A front whose values alternate from cell to cell, the same along z: linear in between.
class CellsSource : public AnalyticSource
{
public:
  double refractivity(double a, double b, double) const override
  {
    const double place = (a + 0.2 * b * b) / cell;
    const double first = std::floor(place);
    return valueAt(first) + (place - first) * (valueAt(first + 1) - valueAt(first));
  }
  Range rangeOver(const Box&) const override { return { 0, 1.1e-4 }; }
  double cellSizeOver(const Box&) const override { return cell; }

private:
  static constexpr double cell = 0.03;
  static double valueAt(double n)
  {
    const double isOdd = std::abs(std::fmod(n, 2.));
    return 5e-5 * (1 + std::tanh(n * cell / 0.15)) * (1 + 0.02 * isOdd);
  }
};

/// Along z, of the largest deflection.
double worstDifference(const MediumTree<float>& tree, const MediumTree<float>& finest)
{
  constexpr int count = 400;
  double worst = 0, largest = 0;
  for (int n = 0; n < count; ++n)
  {
    const Vec3<double> place{ -0.9 + 1.8 * (n % 20 + 0.5) / 20, -0.9 + 1.8 * (n / 20 + 0.5) / 20,
      0 };
    const Vec3<double> bend = bendAlong(tree, Interpolation::Quadratic, place, { 0, 0, 1 });
    const Vec3<double> right = bendAlong(finest, Interpolation::Quadratic, place, { 0, 0, 1 });
    worst = std::max(worst, std::hypot(bend.x - right.x, bend.y - right.y));
    largest = std::max(largest, std::hypot(right.x, right.y));
  }
  return worst / largest;
}

// Third differences of samples that are as far apart as every other cell know nothing of the cells between. And all
// leaves along the light are wrong by the same.
TEST(BrickChanges, CellsThatAlternateAreWithinTolerance)
{
  const auto source = std::make_shared<CellsSource>();
  TreeSettings settings;
  settings.tolerance = 0;
  MediumTree<float> finest(source, 0, settings);
  finest.refine(everything());
  for (const double tolerance : { 1e-1, 1e-2, 1e-3 })
  {
    settings.tolerance = tolerance;
    MediumTree<float> tree(source, 0, settings);
    tree.refine(everything());
    EXPECT_LT(worstDifference(tree, finest), 2 * tolerance) << tolerance;
    EXPECT_LE(tree.statistics().voxels, finest.statistics().voxels);
  }
}

/// A front within one cell of the data, at a place within it.
class FrontSource : public AnalyticSource
{
public:
  FrontSource(const Vec3<double>& normal, double cell, double place)
    : normal_((1 / length(normal)) * normal)
    , cell_(cell)
    , place_(place)
  {
  }
  double refractivity(double a, double b, double c) const override
  {
    return jump * std::clamp(dot(normal_, Vec3<double>{ a, b, c }) / cell_ - place_ + 0.5, 0., 1.);
  }
  Range rangeOver(const Box& box) const override
  {
    double middle = 0, half = 0;
    const double n[3] = { normal_.x, normal_.y, normal_.z };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle += n[axis] * 0.5 * (box.low[axis] + box.high[axis]);
      half += std::abs(n[axis]) * 0.5 * (box.high[axis] - box.low[axis]);
    }
    const auto value = [this](double x)
    { return jump * std::clamp(x / cell_ - place_ + 0.5, 0., 1.); };
    return { value(middle - half), value(middle + half) };
  }
  double cellSizeOver(const Box&) const override { return cell_; }

  static constexpr double jump = 1e-4;

private:
  Vec3<double> normal_;
  double cell_, place_;
};

// By 7 % with all of the second differences.
TEST(BrickMaker, FrontsHardlyOvershoot)
{
  for (const Vec3<double>& normal : { Vec3<double>{ 1, 0, 0 }, Vec3<double>{ 0, 0, 1 },
         Vec3<double>{ 0.9, 0.3, 0.316 }, Vec3<double>{ 1, 1, 1 } })
  {
    for (const double cell : { 0.05, 0.023 })
    {
      for (const double place : { 0., 0.23, 0.5 })
      {
        TreeSettings settings;
        settings.tolerance = 1e-3;
        MediumTree<float> tree(std::make_shared<FrontSource>(normal, cell, place), 0, settings);
        tree.refine(everything());
        double lowest = 0, highest = 0;
        for (int n = 0; n < 20000; ++n)
        {
          const Vec3<double> at{ -0.15 + 0.3 * std::fmod(0.7548 * n, 1.),
            -0.15 + 0.3 * std::fmod(0.5698 * n, 1.), -0.15 + 0.3 * std::fmod(0.3247 * n, 1.) };
          const double value =
            static_cast<double>(sampleAt(tree, Interpolation::Quadratic, at).value);
          lowest = std::min(lowest, value / FrontSource::jump);
          highest = std::max(highest, value / FrontSource::jump);
        }
        EXPECT_GT(lowest, -0.011) << cell << " " << place << " " << normal.x;
        EXPECT_LT(highest, 1.011) << cell << " " << place << " " << normal.x;
      }
    }
  }
}

} // namespace

} // namespace schlieren
