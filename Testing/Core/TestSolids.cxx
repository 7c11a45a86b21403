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

/// A Gaussian in a cube of which only a ball holds data; the rest is transparent.
struct ClippedGaussian : SampledField<float>
{
  ClippedGaussian(double radius, unsigned char outside)
    : SampledField<float>(cube(81, 1),
        [](double x, double y, double z)
        { return amplitude * std::exp(-(x * x + y * y + z * z) / (width * width)); })
  {
    const std::vector<float> radii = SampledField<float>(cube(81, 1),
      [](double x, double y, double z) {
        return std::sqrt(x * x + y * y + z * z);
      }).samples;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      mask.push_back(radii[i] < radius ? 1 : outside);
      samples[i] = radii[i] < radius ? samples[i] : 7777.f;
    }
    field.valid = mask.data();
    field.ambient = 0;
  }

  /// Of a ray at the distance b from the centre, towards it (closed form, weak deflection).
  static double deflection(double b)
  {
    return -2 * std::sqrt(pi) * amplitude * b / width * std::exp(-b * b / (width * width));
  }

  static constexpr double amplitude = 1e-5;
  static constexpr double width = 0.35;

  std::vector<unsigned char> mask;
};

/// The largest error of the deflection, relative to the largest deflection, at pixels that are nearer to
/// the centre than `radius`; and the largest blocked fraction there.
struct ClippedErrors
{
  double deflection = 0, blocked = 0;
};
ClippedErrors errorsWithin(double radius, const Image& image)
{
  ClippedErrors errors;
  const double most = std::abs(ClippedGaussian::deflection(ClippedGaussian::width / std::sqrt(2.)));
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const PixelCentre at = centreOf(image, column, row);
      const double b = std::hypot(at.u, at.v);
      if (b < radius)
      {
        const std::size_t pixel = pixelOf(image, column, row);
        const double all = b > 0 ? ClippedGaussian::deflection(b) / b : 0;
        errors.deflection =
          std::max({ errors.deflection, std::abs(image.deflection[2 * pixel] - all * at.u) / most,
            std::abs(image.deflection[2 * pixel + 1] - all * at.v) / most });
        errors.blocked =
          std::max(errors.blocked, static_cast<double>(image.blockedFraction[pixel]));
      }
    }
  }
  return errors;
}

/// Light that crosses transparent places lacks the deflection that the gas which is missing there would
/// add, and has little else: over the picture the error is that of rays that graze the edge of the data.
TEST_P(Solids, TransparentPlacesContinueTheGas)
{
  for (const double radius : { 0.7, 0.8, 0.9 })
  {
    const ClippedGaussian clipped(radius, transparent);
    Scene here = scene(GetParam());
    here.samplesPerPixel = 1;
    for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ 0.5, -0.3, -1 } })
    {
      here.view.viewDirection = direction;
      const Image image = Bench().render(clipped.field, here);
      const ClippedErrors everywhere = errorsWithin(2, image);
      const double most = ClippedGaussian::deflection(ClippedGaussian::width / std::sqrt(2.));
      const double atEdge = ClippedGaussian::deflection(radius) / most;
      EXPECT_LT(everywhere.deflection, 1.25 * atEdge);
      EXPECT_EQ(everywhere.blocked, 0);
      EXPECT_LT(errorsWithin(0.5 * radius, image).deflection, 0.25 * atEdge);
    }
  }
}

TEST_P(Solids, OnlyTransparentPlacesLetLightPass)
{
  ClippedGaussian clipped(0.8, transparent);
  const std::size_t middle = 40;
  for (std::size_t k = 38; k <= 42; ++k)
  {
    clipped.mask[(k * 81 + middle) * 81 + middle] = 0; // a body in the gas
    clipped.mask[(k * 81 + 3) * 81 + 3] = 0;           // and one in a transparent corner
  }
  Scene here = scene(GetParam());
  here.view.width = here.view.height = 256;
  const Image image = Bench().render(clipped.field, here);
  double blocked = 0;
  for (const float fraction : image.blockedFraction)
  {
    blocked += fraction * image.frame.pixelSize * image.frame.pixelSize;
  }
  EXPECT_NEAR(blocked, 2 * 0.025 * 0.025, 0.2 * 0.025 * 0.025);
  // Where what is outside is solid, all light that meets data crosses it.
  const Image black = Bench().render(ClippedGaussian(0.8, 0).field, here);
  EXPECT_EQ(black.raysBlocked, black.raysTraced);
}

INSTANTIATE_TEST_SUITE_P(, Solids, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
