// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies in the gas: they block light and bend none.
#include "Fields.h"

#include <algorithm>
#include <limits>

namespace schlieren
{

namespace
{

constexpr double bodyRadius = 0.4;

bool isInBody(double x, double y, double z)
{
  return x * x + y * y + z * z < bodyRadius * bodyRadius;
}

enum class Marked
{
  ByMask,
  ByNaN,
  ByInfinity
};

/// A sphere in gas of the given refractivity.
struct FieldWithBody : SampledField<float>
{
  FieldWithBody(const std::function<double(double, double, double)>& gas, Marked marked)
    : SampledField<float>(cube(41, 1), gas)
  {
    const std::vector<float> inside = SampledField<float>(cube(41, 1),
      [](double x, double y, double z)
      { return isInBody(x, y, z); }).samples;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      const bool isBody = inside[i] > 0;
      mask.push_back(isBody ? 0 : 1);
      if (isBody)
      {
        samples[i] = marked == Marked::ByMask
          ? 7777.f
          : (marked == Marked::ByNaN ? std::numeric_limits<float>::quiet_NaN()
                                     : std::numeric_limits<float>::infinity());
      }
    }
    if (marked == Marked::ByMask)
    {
      field.valid = mask.data();
    }
  }

  std::vector<unsigned char> mask;
};

Scene scene(Device device)
{
  Scene result;
  result.device = device;
  result.view.width = result.view.height = 64;
  return result;
}

class Solids : public OnDevice
{
};

TEST_P(Solids, UniformGasAroundABodyBendsNothing)
{
  for (const Marked marked : { Marked::ByMask, Marked::ByNaN, Marked::ByInfinity })
  {
    for (const Interpolation interpolation : { Interpolation::Quadratic, Interpolation::Linear })
    {
      const FieldWithBody body([](double, double, double) { return 2.7e-4; }, marked);
      Scene here = scene(GetParam());
      here.interpolation = interpolation;
      for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ -0.3, 0.5, -0.8 } })
      {
        here.view.viewDirection = direction;
        const Image image = Bench().render(body.field, here);
        const auto isZero = [](double value) { return value == 0; };
        EXPECT_TRUE(std::all_of(image.deflection.begin(), image.deflection.end(), isZero));
        EXPECT_TRUE(std::all_of(
          image.opticalPathDifference.begin(), image.opticalPathDifference.end(), isZero));
        EXPECT_TRUE(std::all_of(image.displacement.begin(), image.displacement.end(), isZero));
      }
    }
  }
}

TEST_P(Solids, ABodyCastsItsShadow)
{
  const FieldWithBody body([](double, double, double) { return 2.7e-4; }, Marked::ByNaN);
  const Image image = Bench().render(body.field, scene(GetParam()));
  double area = 0;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const PixelCentre at = centreOf(image, column, row);
      const std::size_t pixel = pixelOf(image, column, row);
      const double radius = std::hypot(at.u, at.v);
      const double voxels = (radius - bodyRadius) / 0.05;
      if (voxels < -1.5)
      {
        EXPECT_EQ(image.blockedFraction[pixel], 1);
        EXPECT_EQ(image.intensity[pixel], 0);
      }
      if (voxels > 1.5)
      {
        EXPECT_EQ(image.blockedFraction[pixel], 0);
        EXPECT_EQ(image.intensity[pixel], 0.5f);
      }
      area += image.blockedFraction[pixel] * image.frame.pixelSize * image.frame.pixelSize;
    }
  }
  EXPECT_NEAR(area, pi * bodyRadius * bodyRadius, 0.06 * pi * bodyRadius * bodyRadius);
}

/// The spline's coefficients feel their neighbours' neighbours; the body's fill must not reach far.
TEST_P(Solids, GasBesideABodyKeepsItsDeflection)
{
  const double slope = 1e-6;
  FieldWithBody body([=](double x, double, double) { return slope * x; }, Marked::ByMask);
  body.field.ambient = 0;
  Scene here = scene(GetParam());
  here.samplesPerPixel = 1;
  const Image image = Bench().render(body.field, here);
  double worst = 0;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const PixelCentre at = centreOf(image, column, row);
      if (std::hypot(at.u, at.v) > bodyRadius + 4 * 0.05)
      {
        worst =
          std::max(worst, std::abs(image.deflection[2 * pixelOf(image, column, row)] - 2 * slope));
      }
    }
  }
  EXPECT_LT(worst, 0.01 * 2 * slope);
}

INSTANTIATE_TEST_SUITE_P(, Solids, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
