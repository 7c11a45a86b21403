// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// n^2 = n0^2 + a.r, in which rays are parabolas: with dtau = ds / n, r = r0 + p0 tau + a tau^2 / 4 and
// the optical path is n^2(r0) tau + (a.p0) tau^2 / 2 + |a|^2 tau^3 / 12.
#include "Fields.h"

namespace schlieren
{

namespace
{

class LinearMedium : public OnDevice
{
};

void compare(double n0, double slope, Device device, Precision precision, double tolerance)
{
  SCOPED_TRACE(std::string(name(precision)) + " slope " + std::to_string(slope));
  const auto squared = [=](double x) { return n0 * n0 + slope * x; };
  const SampledField<double> medium(
    cube(96, 1), [&](double x, double, double) { return std::sqrt(squared(x)) - 1; });
  Scene scene;
  scene.device = device;
  scene.precision = precision;
  scene.pathModel = PathModel::Refracted;
  scene.samplesPerPixel = 1;
  scene.stepSize = 0.5;
  scene.view.width = 33;
  scene.view.height = 3;
  scene.view.parallelScale = 0.03;
  scene.view.focalPoint = Vector{ -0.2, 0.1, 0 };
  Field field = medium.field;
  field.ambient = n0 - 1;
  const Image image = Bench().render(field, scene);

  const double depth = 2;
  double worstDeflection = 0, worstDisplacement = 0, worstOpd = 0;
  double deflection = 0, displacement = 0, opd = 0;
  for (int i = 0; i < image.width; ++i)
  {
    const double x = centreOf(image, i, 1).u;
    const double n = std::sqrt(squared(x));
    const double tau = depth / n;
    displacement = slope * tau * tau / 4;
    deflection = slope * tau / 2 / std::sqrt(squared(x + displacement));
    opd = n * n * tau + slope * slope * tau * tau * tau / 12 - n0 * depth;
    const std::size_t pixel = pixelOf(image, i, 1);
    worstDeflection = std::max(worstDeflection, std::abs(image.deflection[2 * pixel] - deflection));
    worstDisplacement =
      std::max(worstDisplacement, std::abs(image.displacement[2 * pixel] - displacement));
    worstOpd = std::max(worstOpd, std::abs(image.opticalPathDifference[pixel] - opd));
    EXPECT_NEAR(image.deflection[2 * pixel + 1], 0, tolerance * deflection);
  }
  EXPECT_LT(worstDeflection / deflection, tolerance);
  EXPECT_LT(worstDisplacement / displacement, tolerance);
  EXPECT_LT(worstOpd / std::abs(opd), tolerance);
}

TEST_P(LinearMedium, WeakRaysAreParabolas)
{
  compare(1.0003, 1e-5, GetParam(), Precision::Single, 2e-5);
  compare(1.0003, 1e-5, GetParam(), Precision::Double, 2e-5);
}

TEST_P(LinearMedium, StrongRaysAreParabolas)
{
  compare(1.4, 0.2, GetParam(), Precision::Single, 2e-5);
  compare(1.4, 0.2, GetParam(), Precision::Double, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(, LinearMedium, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
