// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rays cross homogeneous cubes in one step: what that costs is bounded, and saves steps.
#include "ClosedForms.h"

#include <random>

namespace schlieren
{

namespace
{

struct Medium3D
{
  const char* name;
  std::function<double(double, double, double)> refractivity;
};

/// In the cube (-1, 1)^3: the closed forms of weak media, a lens that is weak enough for steps that are not adaptive, and
/// noise.
std::vector<Medium3D> media()
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> noise(40 * 40 * 40);
  std::generate(noise.begin(), noise.end(), [&] { return 1e-6 * any(random); });
  return {
    { "column",
      [](double x, double y, double) { return 2.7e-4 * std::exp(-(x * x + y * y) / 0.04); } },
    { "Abel pair",
      [](double x, double y, double) { return 1e-3 * std::max(0., 1 - (x * x + y * y) / 0.25); } },
    { "step", [](double x, double y, double) { return x + 0.3 * y > 0.21 ? 1e-4 : 0; } },
    { "lens",
      [](double x, double y, double z)
      { return 0.2 * (std::sqrt(2 - std::min(1., 4 * (x * x + y * y + z * z))) - 1); } },
    { "noise in a ball",
      [noise](double x, double y, double z)
      {
        const auto at = [](double a)
        { return static_cast<std::size_t>(std::lround(19.5 * (a + 1))); };
        return x * x + y * y + z * z < 0.3 ? noise[(at(z) * 40 + at(y)) * 40 + at(x)] : 0;
      } },
  };
}

class Skipping : public OnDevice
{
protected:
  Scene scene() const
  {
    Scene scene;
    scene.device = GetParam();
    scene.samplesPerPixel = 1;
    scene.view.width = scene.view.height = 24;
    scene.view.viewDirection = { -0.2, -1, 0.3 };
    return scene;
  }

  void expectWithinTheBound(Integrator integrator, const std::vector<PathModel>& models) const;
};

/// Cosines one by one: the bound is that of each.
double maxChanged(const Image& a, const Image& b)
{
  double most = 0;
  for (std::size_t i = 0; i < a.deflection.size(); ++i)
  {
    most = std::max<double>(most, std::abs(a.deflection[i] - b.deflection[i]));
  }
  return most;
}

/// The bound is that of exact integrals. A ray that skips looks elsewhere afterwards, so that its steps'
/// own error, with short ones small, changes as well: as much as when all of them are a little shorter.
void Skipping::expectWithinTheBound(
  Integrator integrator, const std::vector<PathModel>& models) const
{
  for (const Medium3D& medium : media())
  {
    SampledField<double> field(cube(48, 1), medium.refractivity);
    field.field.ambient = 0;
    for (const Interpolation interpolation : allInterpolations)
    {
      Bench bench;
      for (const PathModel model : models)
      {
        Scene here = scene();
        here.view.width = here.view.height = 16;
        here.interpolation = interpolation;
        here.integrator = integrator;
        here.pathModel = model;
        here.precision = Precision::Double;
        here.stepSize = 0.125;
        const Image full = bench.render(field.field, here);
        EXPECT_EQ(full.skippingBound, 0);
        double ofSteps = 0;
        for (const double shorter : { 0.117, 0.109, 0.102 })
        {
          here.stepSize = shorter;
          ofSteps = std::max(ofSteps, 3 * maxChanged(full, bench.render(field.field, here)));
        }
        here.stepSize = 0.125;
        double last = 0;
        std::int64_t steps = full.stepsTaken;
        for (const double tolerance : { 1e-4, 1e-2, 1. })
        {
          SCOPED_TRACE(std::string(medium.name) + " " + name(interpolation) + " " +
            name(integrator) + " " + name(model) + " " + std::to_string(tolerance));
          here.homogeneityTolerance = tolerance;
          const Image skipped = bench.render(field.field, here);
          const double changed = maxChanged(full, skipped);
          EXPECT_LE(changed, skipped.skippingBound + ofSteps);
          EXPECT_GE(skipped.skippingBound, last);
          EXPECT_LE(skipped.stepsTaken, steps);
          last = skipped.skippingBound;
          steps = skipped.stepsTaken;
        }
        EXPECT_LT(steps, full.stepsTaken);
      }
    }
  }
}

TEST_P(Skipping, DeflectionChangesByNoMoreThanTheBound)
{
  expectWithinTheBound(Integrator::Leapfrog, { PathModel::Straight, PathModel::Refracted });
}

/// In weak media the bound is the tolerance times a length.
TEST_P(Skipping, BoundScalesWithTheTolerance)
{
  SampledField<double> field(cube(64, 1), media()[0].refractivity);
  field.field.ambient = 0;
  Scene here = scene();
  Bench bench;
  here.homogeneityTolerance = 1e-5;
  const double small = bench.render(field.field, here).skippingBound;
  here.homogeneityTolerance = 1e-3;
  const double large = bench.render(field.field, here).skippingBound;
  EXPECT_GT(small, 0);
  EXPECT_NEAR(large / small, 100, 1);
}

/// Where there is nothing to look at: hardly any steps, and nothing missed.
TEST_P(Skipping, UniformGasTakesHardlyAnySteps)
{
  SampledField<float> field(cube(65, 1),
    [](double x, double y, double z) { return x > 0.97 && y > 0.97 && z > 0.97 ? 1e-3 : 3e-4; });
  field.field.ambient = 1e-4;
  Scene here = scene();
  here.view.viewDirection = { 0, 0, -1 };
  here.homogeneityTolerance = 1e-3;
  const Image image = Bench().render(field.field, here);
  EXPECT_LE(image.stepsTaken, 6 * image.raysTraced);
  EXPECT_NEAR(image.opticalPathDifference[24 * 12 + 12], 2 * 2e-4, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(, Skipping, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
