// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Lines of sight and bent rays: where they agree, and where they cannot.
#include "ClosedForms.h"

#include <random>

namespace schlieren
{

namespace
{

class PathModels : public OnDevice
{
protected:
  Scene sceneOf(PathModel model, const View& view) const
  {
    Scene scene;
    scene.device = GetParam();
    scene.samplesPerPixel = 1;
    scene.pathModel = model;
    scene.view = view;
    return scene;
  }
};

/// eps = L grad n / n, OPD = (N - N_ref) L; sideways by half of eps L.
TEST_P(PathModels, UniformGradientBendsByItsLength)
{
  const double gradient = 1e-7, ambient = 2.7e-4;
  SampledField<double> field(boxGrid(1. / 16, { 1, 1, 2 }),
    [&](double x, double y, double) { return ambient + 1e-7 + gradient * (x - 0.5 * y); });
  field.field.ambient = ambient;
  for (const PathModel model : { PathModel::Straight, PathModel::Refracted })
  {
    for (const Precision precision : bothPrecisions)
    {
      SCOPED_TRACE(std::string(name(model)) + " " + name(precision));
      Scene scene = sceneOf(model, raysAround({ 0.01, 0.02, 0 }, 9, 9, 0.2));
      scene.precision = precision;
      const Image image = Bench().render(field.field, scene);
      EXPECT_EQ(image.pathModel, model);
      Worst errors, size;
      for (int row = 0; row < 9; ++row)
      {
        for (int i = 0; i < 9; ++i)
        {
          const PixelCentre at = centreOf(image, i, row);
          const double bend = 4 * gradient / (1 + ambient);
          const Reading exact{ { bend, -0.5 * bend }, { 2 * bend, -1 * bend },
            4 * (1e-7 + gradient * (at.u - 0.5 * at.v)) };
          errors.include(readingOf(image, pixelOf(image, i, row)), exact);
          size.include(exact);
        }
      }
      // In single precision a sample's rounding, 2^-24, beside its neighbours' difference of 1/32.
      const double tolerance = precision == Precision::Single ? 1e-5 : 1e-6;
      EXPECT_LT(errors.deflection, tolerance * size.deflection);
      EXPECT_LT(errors.displacement, tolerance * size.displacement);
      EXPECT_LT(errors.opticalPathDifference, tolerance * size.opticalPathDifference);
    }
  }
}

/// N = A (1 - r^2) within r = 1 around z, seen along y: OPD = 4/3 A (1 - b^2)^(3/2) and, its derivative,
/// eps = -4 A b (1 - b^2)^(1/2). At r = 1 the gradient jumps by J = 2 A. The trapezoidal rule, which a
/// spline's integral is, is wrong there by up to J h^2 / 8 over the cosine c = (1 - b^2)^(1/2) in the OPD,
/// at two places seen from two axes, and by its derivative, J h / 2 b / c^2, in eps.
TEST_P(PathModels, AbelPair)
{
  const double peak = 1e-6;
  for (const std::int64_t points : { 49, 97 })
  {
    SampledField<double> field(cube(points, 1.25),
      [&](double x, double y, double) { return peak * std::max(0., 1 - x * x - y * y); });
    field.field.ambient = 0;
    const double h = field.field.grid.spacing[0];
    for (const PathModel model : { PathModel::Straight, PathModel::Refracted })
    {
      for (const Interpolation interpolation : allInterpolations)
      {
        SCOPED_TRACE(std::string(name(model)) + " " + name(interpolation));
        Scene scene = sceneOf(model, raysAround({ 0.003, 0, 0.01 }, 73, 1, 0.025));
        scene.view.viewDirection = { 0, -1, 0 };
        scene.view.viewUp = { 0, 0, 1 };
        scene.interpolation = interpolation;
        scene.precision = Precision::Double;
        const Image image = Bench().render(field.field, scene);
        double path = 0, deflection = 0; // the largest, of what is allowed
        for (int i = 0; i < image.width; ++i)
        {
          const double b = centreOf(image, i, 0).u;
          const double c = std::sqrt(1 - b * b);
          const Reading ray = readingOf(image, static_cast<std::size_t>(i));
          const double pathError = ray.opticalPathDifference - 4. / 3 * peak * c * c * c;
          const double deflectionError = ray.deflection[0] + 4 * peak * b * c;
          const double allowedPath = peak * h * h / c;
          const double allowedDeflection = peak * h * 4 * std::abs(b) / (c * c);
          path = std::max(path, std::abs(pathError) / allowedPath);
          deflection =
            std::max(deflection, std::abs(deflectionError) / (allowedDeflection + 1e-6 * peak));
        }
        EXPECT_LT(path, 1);
        EXPECT_LT(deflection, 1);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, PathModels, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
