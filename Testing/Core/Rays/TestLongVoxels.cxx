// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Steps through voxels that are much longer than wide: as long as the light's way through a voxel where nothing bends it in
// one, shorter where it is bent, and a limited number of them where it is guided.
#include "AnalyticSources.h"
#include "ClosedForms.h"
#include "Fields.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>

namespace schlieren
{

namespace
{

constexpr double peak = 3e-4, width = 0.25;

/// Of a ball that nothing of depends on y.
double columnAt(double x, double z) { return peak * std::exp(-(x * x + z * z) / (width * width)); }

/// The same within |y| < half a thickness.
class SlabSource : public AnalyticSource
{
public:
  explicit SlabSource(double thickness)
    : thickness_(thickness)
  {
  }
  double refractivity(double x, double, double z) const override { return columnAt(x, z); }
  Range rangeOver(const Box& box) const override
  {
    const Range r =
      distancesTo({ 0, 0, 0 }, { { box.low[0], 0, box.low[2] }, { box.high[0], 0, box.high[2] } });
    return { columnAt(r.second, 0), columnAt(r.first, 0) };
  }
  double cellSizeOver(const Box&) const override { return 0.01; }
  Box bounds() const override
  {
    return { { -1, -0.5 * thickness_, -1 }, { 1, 0.5 * thickness_, 1 } };
  }

private:
  double thickness_;
};

class LongVoxels : public OnDevice
{
protected:
  Scene sceneOf(const View& view) const
  {
    Scene scene;
    scene.device = GetParam();
    scene.pathModel = PathModel::Refracted;
    scene.view = view;
    return scene;
  }
  /// A row of rays across the column.
  Scene sceneOfRow() const { return sceneOf(raysAround({ 0, 0, 0 }, 61, 1, 0.02)); }
};

double largestOf(const PixelArray<float>& values)
{
  double largest = 0;
  for (const float value : values)
  {
    largest = std::max(largest, std::abs(static_cast<double>(value)));
  }
  return largest;
}

double stepsOfRay(const Image& image)
{
  return static_cast<double>(image.stepsTaken) / static_cast<double>(image.raysTraced);
}

double differenceOf(const Image& a, const Image& b)
{
  return differences(a, b).deflection / largestOf(b.deflection);
}

double errorOfRow(const Image& image)
{
  double error = 0;
  for (int i = 0; i < image.width; ++i)
  {
    const double x = centreOf(image, i, 0).u;
    const double truth = -2 * std::sqrt(pi) * x / width * peak * std::exp(-x * x / (width * width));
    error = std::max(
      error, std::abs(static_cast<double>(image.deflection[2 * pixelOf(image, i, 0)]) - truth));
  }
  return error / largestOf(image.deflection);
}

} // namespace

/// A flat mesh that is seen edge-on, and one as thick as long.
TEST_P(LongVoxels, OfAFlatMeshTakeNoMoreStepsThanThoseOfAThickOne)
{
  const Scene scene = sceneOfRow();
  const Image thick = Bench().render(fieldOf(std::make_shared<SlabSource>(2.)), scene);
  EXPECT_LT(errorOfRow(thick), 0.01);
  for (const double thickness : { 1e-2, 1e-5, 1e-8 })
  {
    SCOPED_TRACE(thickness);
    const Image flat = Bench().render(fieldOf(std::make_shared<SlabSource>(thickness)), scene);
    EXPECT_EQ(flat.raysLost, 0);
    EXPECT_LT(errorOfRow(flat), 0.01);
    EXPECT_LE(stepsOfRay(flat), 5 * stepsOfRay(thick)); // its coarsest voxels are a quarter as long
  }
}

/// The same of images, whose voxels are as long along the light. In single precision, what their spline's coefficients are
/// rounded by would be a gradient across so thin an image.
TEST_P(LongVoxels, OfAFlatImageTakeTheStepsOfCubicOnes)
{
  Scene scene = sceneOfRow();
  scene.precision = Precision::Double;
  const auto imageOf = [&](double spacing)
  {
    Grid grid = boxGrid(1. / 64, { 1, 0.0625, 1 });
    grid.spacing[1] *= spacing;
    grid.origin[1] *= spacing;
    const SampledField<double> field(
      grid, [](double x, double, double z) { return columnAt(x, z); });
    return Bench().render(field.field, scene);
  };
  const Image cubic = imageOf(1);
  EXPECT_LT(errorOfRow(cubic), 0.01);
  for (const double spacing : { 1e-2, 1e-6 })
  {
    SCOPED_TRACE(spacing);
    const Image flat = imageOf(spacing);
    EXPECT_NEAR(stepsOfRay(flat), stepsOfRay(cubic), 1e-2 * stepsOfRay(cubic));
    EXPECT_LT(differenceOf(flat, cubic), 1e-4);
  }
}

/// Along a column of gas, where light bends: as cubic voxels with short steps do, whatever the voxels' length.
TEST_P(LongVoxels, AlongTheLightBendItAsCubicOnesDo)
{
  const auto imageOf = [&](double length, double step)
  {
    Grid grid = boxGrid(1. / 32, { 1, 1, 4 });
    grid.dimensions[2] = std::llround(8 / (length / 32)) + 1;
    grid.spacing[2] = length / 32;
    const SampledField<float> field(
      grid, [](double x, double y, double) { return columnAt(x, y); });
    Scene scene = sceneOf(raysAround({ 0, 0, 0 }, 21, 21, 0.04));
    scene.stepSize = step;
    return Bench().render(field.field, scene);
  };
  const Image cubic = imageOf(1, 0.25);
  for (const double length : { 1., 4., 64., 256. })
  {
    SCOPED_TRACE(length);
    const Image image = imageOf(length, 2);
    EXPECT_LT(differenceOf(image, cubic), 4e-3); // theory.md: of steps of two voxels
    EXPECT_LE(image.stepsTaken, cubic.stepsTaken / 7);
    EXPECT_EQ(image.raysLost, 0);
  }
}

/// Noise in voxels that are millions of times as long as wide guides a good part of the light from one end to the other, in
/// millions of swings. Such rays are given up and counted; the others come out.
TEST_P(LongVoxels, GuideLightForALimitedNumberOfSteps)
{
  Grid grid;
  grid.dimensions = { 24, 24, 9 };
  grid.spacing = { 6e-5, 1.6e-4, 418 };
  for (const double strongest : { 1e-3, 0.058, 0.3 })
  {
    SCOPED_TRACE(strongest);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> noise(0, strongest);
    const SampledField<float> field(grid, [&](double, double, double) { return noise(random); });
    View view;
    view.width = view.height = 32;
    const Image image = Bench().render(field.field, sceneOf(view));
    EXPECT_GT(image.raysLost, image.raysTraced / 20);
    EXPECT_LT(image.raysLost, image.raysTraced);
    EXPECT_LT(image.stepsTaken, 20000 * image.raysTraced);
  }
}

/// Where light that is guided through a long channel says that no settings keep the target, the image does not take those that
/// are the most expensive.
TEST_P(LongVoxels, AreNotTracedWithoutEndForATargetThatCannotBeKept)
{
  Grid grid;
  grid.dimensions = { 2, 2, 3000 };
  double n = 0;
  const SampledField<float> field(
    grid, [&](double, double, double) { return 2.3e-4 * (1 + 0.3 * std::sin(n++)); });
  View view;
  view.width = 24;
  view.height = 18;
  Scene scene = sceneOf(view);
  const Image plain = Bench().render(field.field, scene);
  scene.targetError = 0.02;
  const Image image = Bench().render(field.field, scene);
  EXPECT_GT(image.accuracy.reached, scene.targetError);
  EXPECT_LE(image.stepsTaken, 20 * plain.stepsTaken);
}

INSTANTIATE_TEST_SUITE_P(, LongVoxels, bothDevices(), deviceName);

} // namespace schlieren
