// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Gaussian column N = A exp(-(x^2 + y^2) / s^2) along z. In the weak limit, looking along z's normal
// with sideways distance y: eps = -2 sqrt(pi) A (y / s) exp(-y^2 / s^2), OPD = sqrt(pi) A s
// exp(-y^2 / s^2) (Abel transform of a Gaussian).
#include "Fields.h"

#include <algorithm>
#include <utility>

namespace schlieren
{

namespace
{

constexpr double peak = 2.7e-4;
constexpr double radius = 1;
constexpr double half = 3; // cuts 2.2e-5 of the column off

double deflectionOf(double y)
{
  return -2 * std::sqrt(pi) * peak * (y / radius) * std::exp(-y * y / (radius * radius));
}

/// The line integral, and the bent ray's longer way from the column to the exit plane.
double opdOf(double y)
{
  return std::sqrt(pi) * peak * radius * std::exp(-y * y / (radius * radius)) +
    0.5 * deflectionOf(y) * deflectionOf(y) * half;
}

const double largestDeflection = std::sqrt(2 * pi) * peak * std::exp(-0.5);

/// The column along a unit axis through the origin.
std::function<double(double, double, double)> columnAlong(const Vector& axis)
{
  return [axis](double x, double y, double z)
  {
    const double along = x * axis[0] + y * axis[1] + z * axis[2];
    const double squared = x * x + y * y + z * z - along * along;
    return peak * std::exp(-squared / (radius * radius));
  };
}

struct Errors
{
  double deflection = 0; ///< largest, relative to the largest deflection
  double opd = 0;        ///< largest, relative to the largest OPD
};

/// Renders a column along z seen along -y at odd pixel positions and compares every pixel.
Errors errorsAt(std::int64_t n, Device device, Precision precision, Interpolation interpolation,
  int samplesPerPixel = 1)
{
  SampledField<double> column(cube(n, half), columnAlong({ 0, 0, 1 }));
  column.field.ambient = 0;
  Scene scene;
  scene.device = device;
  scene.precision = precision;
  scene.interpolation = interpolation;
  scene.samplesPerPixel = samplesPerPixel;
  scene.view.viewDirection = { 0, -1, 0 };
  scene.view.viewUp = { 0, 0, 1 };
  scene.view.width = 97;
  scene.view.height = 5;
  scene.view.focalPoint = Vector{ 0.0137, 0, 0.0291 };
  scene.view.parallelScale = 0.17;
  const Image image = Bench().render(column.field, scene);
  EXPECT_EQ(image.device, device);

  Errors errors;
  for (int row = 0; row < image.height; ++row)
  {
    for (int i = 0; i < image.width; ++i)
    {
      const double y = centreOf(image, i, row).u;
      const std::size_t pixel = pixelOf(image, i, row);
      errors.deflection = std::max(errors.deflection,
        std::abs(image.deflection[2 * pixel] - deflectionOf(y)) / largestDeflection);
      errors.deflection =
        std::max(errors.deflection, std::abs(image.deflection[2 * pixel + 1]) / largestDeflection);
      errors.opd =
        std::max(errors.opd, std::abs(image.opticalPathDifference[pixel] - opdOf(y)) / opdOf(0));
    }
  }
  return errors;
}

class GaussianColumn : public OnDevice
{
};

/// However many rays a pixel has, and wherever their mean place is.
TEST_P(GaussianColumn, DeflectionAndOpdAreThoseOfThePixelsCentre)
{
  const Errors ofOne = errorsAt(112, GetParam(), Precision::Single, Interpolation::Quadratic);
  for (const int samples : { 2, 3, 64 })
  {
    const Errors errors =
      errorsAt(112, GetParam(), Precision::Single, Interpolation::Quadratic, samples);
    EXPECT_EQ(errors.deflection, ofOne.deflection) << samples;
    EXPECT_EQ(errors.opd, ofOne.opd) << samples;
    EXPECT_LT(errors.deflection, 1e-3) << samples;
    EXPECT_LT(errors.opd, 1e-3) << samples;
  }
}

/// The column lies across the image at an angle and light crosses the grid obliquely, so that
/// nothing is aligned with anything.
TEST_P(GaussianColumn, ObliqueViewMatchesClosedForm)
{
  const Vector axis = { 0.48, 0.6, 0.64 };
  SampledField<float> column(cube(128, half), columnAlong(axis));
  column.field.ambient = 0;
  Scene scene;
  scene.device = GetParam();
  scene.samplesPerPixel = 1;
  // Across the axis, so that the Abel transform holds: 0.8 * 0.48 - 0.6 * 0.64 = 0.
  scene.view.viewDirection = { -0.8, 0, 0.6 };
  scene.view.viewUp = axis;
  scene.view.width = 61;
  scene.view.height = 31;
  scene.view.parallelScale =
    0.6; // far enough from the corners that light crosses all of the column
  const Image image = Bench().render(column.field, scene);
  double worst = 0, worstOpd = 0, worstAlong = 0;
  for (int row = 0; row < image.height; ++row)
  {
    for (int i = 0; i < image.width; ++i)
    {
      const double y = centreOf(image, i, row).u;
      const std::size_t pixel = pixelOf(image, i, row);
      worst = std::max(worst, std::abs(image.deflection[2 * pixel] - deflectionOf(y)));
      worstAlong = std::max(worstAlong, std::abs(double{ image.deflection[2 * pixel + 1] }));
      worstOpd = std::max(worstOpd, std::abs(image.opticalPathDifference[pixel] - opdOf(y)));
    }
  }
  EXPECT_LT(worst / largestDeflection, 1e-3);
  EXPECT_LT(worstAlong / largestDeflection, 1e-3);
  EXPECT_LT(worstOpd / opdOf(0), 1e-3);
}

/// Screen at D: I / I0 = 1 / |1 + D d eps / dy| at the shadow y + D eps of y. Before the caustic.
TEST_P(GaussianColumn, ShadowgraphMatchesLensFormula)
{
  SampledField<float> column(cube(128, half), columnAlong({ 0, 0, 1 }));
  column.field.ambient = 0;
  Scene scene;
  scene.device = GetParam();
  scene.cutoff = Cutoff::Shadowgraph;
  scene.samplesPerPixel = 16;
  scene.view.viewDirection = { 0, -1, 0 };
  scene.view.viewUp = { 0, 0, 1 };
  scene.view.width = 120;
  scene.view.height = 6;
  scene.view.parallelScale = 0.15;
  const double focal = 1 / (2 * std::sqrt(pi) * peak / radius);
  scene.screenDistance = 0.3 * focal;
  const Image image = Bench().render(column.field, scene);

  // The shadow's brightness as a function of where it falls, from a fine sweep over y.
  std::vector<double> places, brightness;
  const double second = -2 * std::sqrt(pi) * peak / radius;
  for (double y = -4; y < 4; y += 1e-4)
  {
    const double slope = second * (1 - 2 * y * y) * std::exp(-y * y);
    places.push_back(y + *scene.screenDistance * deflectionOf(y));
    brightness.push_back(1 / (1 + *scene.screenDistance * slope));
  }
  double worst = 0;
  for (int i = 0; i < image.width; ++i)
  {
    const double place = centreOf(image, i, 3).u;
    const auto at = std::lower_bound(places.begin(), places.end(), place) - places.begin();
    worst = std::max(worst,
      std::abs(image.intensity[pixelOf(image, i, 3)] - brightness[static_cast<std::size_t>(at)]));
  }
  // The second derivative of a quadratic spline is a staircase: D h / 2 d2 eps / dy2 is 0.025 here.
  EXPECT_LT(worst, 0.025);
  EXPECT_GT(image.intensity[pixelOf(image, 60, 3)], 1.3); // bright: the column is a converging lens
}

/// The light in the middle is the brightest, I = 1 / (1 - D / f), and passes 3/2 at a third of the focal length. Rays bend
/// in the middle of the data, from where the distance counts that makes I.
TEST_P(GaussianColumn, AutomaticScreenFillsHalfOfTheScale)
{
  const double focal = 1 / (2 * std::sqrt(pi) * peak / radius);
  for (const double strength : { 1., 0.01 })
  {
    SampledField<float> column(cube(128, half),
      [strength, full = columnAlong({ 0, 0, 1 })](double x, double y, double z)
      { return strength * full(x, y, z); });
    column.field.ambient = 0;
    Scene scene;
    scene.device = GetParam();
    scene.cutoff = Cutoff::Shadowgraph;
    scene.choosesScreen = true;
    scene.view.viewDirection = { 0, -1, 0 };
    scene.view.viewUp = { 0, 0, 1 };
    scene.view.parallelScale = 1;
    // Whatever the number of pixels, and how their settings are chosen.
    for (const auto& [size, target] : { std::pair{ 40, 0. }, { 160, 0. }, { 40, 0.02 } })
    {
      scene.view.width = 3 * size;
      scene.view.height = size;
      scene.targetError = target;
      const Image image = Bench().render(column.field, scene);
      const double expected = focal / strength / 3 - half;
      EXPECT_NEAR(image.screenDistance, expected, 0.03 * expected) << size;
      const float brightest = *std::max_element(image.intensity.begin(), image.intensity.end());
      EXPECT_NEAR(brightest, 1.5, 0.05) << size;
    }
  }
}

TEST_P(GaussianColumn, AutomaticScreenIsOneDepthAwayWhereNothingBends)
{
  SampledField<float> still(cube(32, half), [](double, double, double) { return peak; });
  Scene scene;
  scene.device = GetParam();
  scene.cutoff = Cutoff::Shadowgraph;
  scene.choosesScreen = true;
  EXPECT_DOUBLE_EQ(Bench().render(still.field, scene).screenDistance, 2 * half);
  scene.screenDistance = 0.25; // is not automatic
  EXPECT_EQ(Bench().render(still.field, scene).screenDistance, 0.25);
  scene.cutoff = Cutoff::KnifeEdge;
  EXPECT_EQ(Bench().render(still.field, scene).screenDistance, 0);
}

INSTANTIATE_TEST_SUITE_P(, GaussianColumn, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
