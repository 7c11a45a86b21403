// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Units, scales and sizes that must not matter, and media at the ends of the possible.
#include "Fields.h"

#include <algorithm>
#include <random>

namespace schlieren
{

namespace
{

/// A blob off the centre, as a shape that is 1 at its peak.
double blob(double x, double y, double z)
{
  const double a = x - 0.1, b = y + 0.2, c = z - 0.05;
  return std::exp(-(a * a + 2 * b * b + c * c) / 0.09);
}

Scene smallScene(Device device)
{
  Scene scene;
  scene.device = device;
  scene.view.viewDirection = { -0.3, 0.2, -0.9 };
  scene.view.width = 48;
  scene.view.height = 40;
  scene.samplesPerPixel = 2;
  return scene;
}

Image renderBlob(
  double peak, double ambient, const Scene& scene, double lengthFactor = 1, double lengthScale = 1)
{
  SampledField<double> medium(cube(40, lengthFactor),
    [&](double x, double y, double z)
    { return ambient + peak * blob(x / lengthFactor, y / lengthFactor, z / lengthFactor); });
  medium.field.ambient = ambient;
  medium.field.lengthScale = lengthScale;
  return Bench().render(medium.field, scene);
}

double largest(const PixelArray<float>& values)
{
  double result = 0;
  for (const float value : values)
  {
    result = std::max(result, std::abs(double{ value }));
  }
  return result;
}

/// Largest difference of `b` from `factor` times `a`, relative to the largest |b|.
template <class Value>
double difference(const PixelArray<Value>& a, const PixelArray<Value>& b, double factor)
{
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    worst = std::max(worst, std::abs(double{ b[i] } - factor * double{ a[i] }));
    size = std::max(size, std::abs(double{ b[i] }));
  }
  return worst / size;
}

class Extremes : public OnDevice
{
};

TEST_P(Extremes, UnitOfLengthDoesNotBendLight)
{
  for (const double factor : { 1e-9, 1024., 1e12 })
  {
    SCOPED_TRACE(factor);
    const Scene scene = smallScene(GetParam());
    const Image one = renderBlob(3e-4, 0, scene);
    const Image scaled = renderBlob(3e-4, 0, scene, factor);
    EXPECT_LT(difference(one.deflection, scaled.deflection, 1), 1e-6);
    EXPECT_LT(difference(one.opticalPathDifference, scaled.opticalPathDifference, factor), 1e-6);
    EXPECT_LT(difference(one.displacement, scaled.displacement, factor), 1e-5);
    EXPECT_LT(difference(one.intensity, scaled.intensity, 1), 1e-4);
  }
}

TEST_P(Extremes, LengthScaleScalesTheOpticalPathOnly)
{
  const Scene scene = smallScene(GetParam());
  const Image one = renderBlob(3e-4, 0, scene);
  const Image scaled = renderBlob(3e-4, 0, scene, 1, 1e-3);
  EXPECT_EQ(one.deflection, scaled.deflection);
  EXPECT_EQ(one.intensity, scaled.intensity);
  EXPECT_LT(difference(one.opticalPathDifference, scaled.opticalPathDifference, 1e-3), 1e-12);
}

TEST_P(Extremes, AmbientOffsetDoesNotShow)
{
  Scene scene = smallScene(GetParam());
  const Image vacuum = renderBlob(1e-5, 0, scene);
  const Image air = renderBlob(1e-5, 2.7e-4, scene);
  // eps scales with 1 / n_ref in the weak limit.
  EXPECT_LT(difference(vacuum.deflection, air.deflection, 1 / 1.00027), 2e-6);
  EXPECT_LT(difference(vacuum.opticalPathDifference, air.opticalPathDifference, 1), 2e-6);
}

TEST_P(Extremes, FaintestMediumGivesTheSameImage)
{
  const Scene scene = smallScene(GetParam());
  const Image reference = renderBlob(1e-4, 0, scene);
  for (const double peak : { 1e-9, 1e-20 })
  {
    SCOPED_TRACE(peak);
    const Image faint = renderBlob(peak, 0, scene);
    // Second-order effects are of the order of the stronger deflection.
    EXPECT_LT(difference(reference.deflection, faint.deflection, peak / 1e-4), 2e-3);
    EXPECT_LT(difference(reference.intensity, faint.intensity, 1), 2e-3);
    EXPECT_LT(
      difference(reference.opticalPathDifference, faint.opticalPathDifference, peak / 1e-4), 2e-3);
  }
  // Between two faint ones only rounding is left.
  const Image a = renderBlob(1e-10, 0, scene);
  const Image b = renderBlob(1e-12, 0, scene);
  EXPECT_LT(difference(a.deflection, b.deflection, 1e-2), 1e-6);
  EXPECT_LT(difference(a.intensity, b.intensity, 1), 1e-5);
}

/// Light in noise of glass-like strength goes everywhere; it must come to an end and leave numbers.
TEST_P(Extremes, StrongNoiseEndsAndStaysFinite)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anyIndex(-0.9, 3);
  const SampledField<float> medium(
    cube(24, 1), [&](double, double, double) { return anyIndex(random); });
  for (const Interpolation interpolation : allInterpolations)
  {
    Scene scene = smallScene(GetParam());
    scene.interpolation = interpolation;
    const Image image = Bench().render(medium.field, scene);
    EXPECT_GT(image.raysLost, 0);
    for (const PixelArray<float>* values :
      { &image.intensity, &image.deflection, &image.displacement })
    {
      EXPECT_TRUE(std::all_of(
        values->begin(), values->end(), [](float value) { return std::isfinite(value); }));
    }
    EXPECT_LE(largest(image.deflection), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(, Extremes, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
