// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Light that leaves the data for something else through planes across the line of sight, where n sin of its angle is
// kept; and panes and rods of glass, whose faces are jumps of the index.
#include "ClosedForms.h"
#include "Math/Units.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

constexpr double water = 0.333;
constexpr double depth = 0.2;
constexpr double slope = 0.02; // of n, per unit of length along y

/// Water whose index grows along y, between two windows across z.
struct Tank : SampledField<double>
{
  explicit Tank(double along = slope)
    : SampledField<double>(
        grid(), [along](double, double y, double) { return water + along * (y - 0.1); })
  {
    field.ambient = water;
  }

  static Grid grid()
  {
    Grid grid;
    grid.dimensions = { 9, 41, 41 };
    grid.spacing = { 0.025, 0.005, 0.005 };
    return grid;
  }
};

Scene tankScene(Device device)
{
  Scene scene;
  scene.device = device;
  scene.view.width = 15;
  scene.view.height = 15;
  scene.view.parallelScale = 0.05;
  scene.samplesPerPixel = 1;
  scene.exitInto = ExitInto::Auto;
  return scene;
}

constexpr double airIndex = 1 + airRefractivity;
constexpr int middle = 7;

double deflectionOf(const Image& image)
{
  return static_cast<double>(image.deflection[2 * pixelOf(image, middle, middle) + 1]);
}

class ExitFacesOfTank : public OnDevice
{
};

/// The angle in air does not depend on n in the tank: all of n sin theta is from the gradient.
TEST_P(ExitFacesOfTank, KeepWhatLightHasAlongThem)
{
  const Tank tank;
  for (const PathModel path : { PathModel::Straight, PathModel::Refracted })
  {
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      for (const Integrator integrator : { Integrator::Leapfrog, Integrator::Adaptive })
      {
        Scene scene = tankScene(GetParam());
        scene.pathModel = path;
        scene.precision = precision;
        scene.integrator = integrator;
        Image image = Bench().render(tank.field, scene);
        EXPECT_EQ(image.exitRefractivity, airRefractivity);
        EXPECT_NEAR(deflectionOf(image), slope * depth / airIndex, 1e-4 * slope * depth);
        scene.exitInto = ExitInto::Surroundings;
        image = Bench().render(tank.field, scene);
        EXPECT_EQ(image.exitRefractivity, water);
        EXPECT_NEAR(deflectionOf(image), slope * depth / (1 + water), 1e-4 * slope * depth);
        scene.exitInto = ExitInto::Custom;
        scene.exitRefractivity = 0.47;
        image = Bench().render(tank.field, scene);
        EXPECT_NEAR(deflectionOf(image), slope * depth / 1.47, 1e-4 * slope * depth);
      }
    }
  }
}

/// Where the surroundings are said to be air, light enters the water and leaves it there.
TEST_P(ExitFacesOfTank, AreThereWhenTheSurroundingsAreAir)
{
  Tank tank;
  tank.field.ambient = airRefractivity;
  for (const PathModel path : { PathModel::Straight, PathModel::Refracted })
  {
    Scene scene = tankScene(GetParam());
    scene.pathModel = path;
    scene.precision = Precision::Double; // as n is compared with that of air
    const Image image = Bench().render(tank.field, scene);
    EXPECT_EQ(image.exitRefractivity, airRefractivity);
    EXPECT_NEAR(deflectionOf(image), slope * depth / airIndex, 1e-4 * slope * depth);
  }
}

/// Of a gas there are none: a deflection is the same to the last bit.
TEST_P(ExitFacesOfTank, AreNotThereOfAGas)
{
  const SampledField<double> gas(
    Tank::grid(), [](double, double y, double) { return 3e-4 + 1e-3 * y; });
  Scene scene = tankScene(GetParam());
  scene.pathModel = PathModel::Refracted;
  const Image automatic = Bench().render(gas.field, scene);
  scene.exitInto = ExitInto::Surroundings;
  const Image none = Bench().render(gas.field, scene);
  for (std::size_t i = 0; i < none.deflection.size(); ++i)
  {
    ASSERT_EQ(automatic.deflection[i], none.deflection[i]);
  }
}

/// A pattern in air behind the tank, and one that touches it. x(L) = b L^2 / (2 n).
TEST_P(ExitFacesOfTank, MoveAPatternBehindThem)
{
  const Tank tank;
  for (const double viewAngle : { 0., 1. })
  {
    for (const double distance : { 0., 1., 7. })
    {
      Scene scene = tankScene(GetParam());
      scene.view.viewAngle = viewAngle;
      scene.cutoff = Cutoff::Background;
      scene.pathModel = PathModel::Refracted;
      scene.background.distance = distance;
      const Image image = Bench().render(tank.field, scene);
      const double moved = image.backgroundDisplacement[2 * pixelOf(image, middle, middle) + 1];
      const double expected = slope * depth * (0.5 * depth / (1 + water) + distance / airIndex);
      EXPECT_NEAR(moved, expected, 2e-4 * expected) << viewAngle << ' ' << distance;
    }
  }
}

/// What is in focus in the tank is where it is without the window: the camera looks at its apparent depth.
TEST_P(ExitFacesOfTank, LeaveThePlaneInFocusWhereItIs)
{
  // A lens: n falls from the middle outwards.
  const SampledField<double> lens(
    Tank::grid(), [](double, double y, double) { return water - 2 * (y - 0.1) * (y - 0.1); });
  Field field = lens.field;
  field.ambient = water;
  for (const double offset : { -0.07, 0., 0.1 })
  {
    Scene scene = tankScene(GetParam());
    scene.pathModel = PathModel::Refracted;
    scene.cutoff = Cutoff::Interferogram;
    scene.wavelength = 1e-3; // few fringes
    scene.focusOffset = offset;
    scene.samplesPerPixel = 4;
    const Image air = Bench().render(field, scene);
    scene.exitInto = ExitInto::Surroundings;
    const Image inWater = Bench().render(field, scene);
    double change = 0, contrast = 0;
    // Of the outermost pixels rays run along the data's border: rounding decides whether they are in.
    for (int row = 1; row + 1 < air.height; ++row)
    {
      for (int column = 1; column + 1 < air.width; ++column)
      {
        const std::size_t pixel = pixelOf(air, column, row);
        change = std::max(
          change, std::abs(static_cast<double>(air.intensity[pixel] - inWater.intensity[pixel])));
        contrast = std::max(contrast, 1 - static_cast<double>(air.intensity[pixel]));
      }
    }
    EXPECT_GT(contrast, 0.5);
    EXPECT_LT(change, 4e-3) << offset;
  }
}

/// A shadowgraph of a weak lens, on a screen in air: I = 1 / (1 - D f) with f = -d eps / dx in air.
TEST_P(ExitFacesOfTank, FocusOnAScreenInAir)
{
  constexpr double strength = 0.05; // n = water - strength (y - 0.1)^2
  const SampledField<double> lens(Tank::grid(),
    [](double, double y, double) { return water - strength * (y - 0.1) * (y - 0.1); });
  Field field = lens.field;
  field.ambient = water;
  Scene scene = tankScene(GetParam());
  scene.cutoff = Cutoff::Shadowgraph;
  scene.pathModel = PathModel::Refracted;
  scene.screenDistance = 3;
  const Image image = Bench().render(field, scene);
  // On the exit plane rays are nearer together by 1 - strength L^2 / n.
  const double nearer =
    1 - strength * depth * depth / (1 + water) - 3 * 2 * strength * depth / airIndex;
  EXPECT_NEAR(image.intensity[pixelOf(image, middle, middle)], 1 / nearer, 2e-3);
}

/// Light of a uniform tank is undisturbed, in any view and with any source, whatever is outside.
TEST_P(ExitFacesOfTank, LetUndisturbedLightAlone)
{
  for (const double ambient : { water, airRefractivity })
  {
    Tank tank(0);
    tank.field.ambient = ambient;
    for (const double viewAngle : { 0., 50. })
    {
      for (const Vector& direction : { Vector{ 0, 0, -1 }, Vector{ 0.4, -0.3, -0.8 } })
      {
        Scene scene = tankScene(GetParam());
        scene.view.viewAngle = viewAngle;
        scene.view.viewDirection = direction;
        scene.pathModel = PathModel::Refracted;
        scene.source.shape = SourceShape::Disc;
        scene.source.width = 0.02;
        scene.samplesPerPixel = 3;
        const Image image = Bench().render(tank.field, scene);
        EXPECT_EQ(image.raysLost, 0);
        for (const float deflection : image.deflection)
        {
          ASSERT_NEAR(deflection, 0, 2e-6) << ambient << ' ' << viewAngle;
        }
      }
    }
  }
}

/// The perspective is that in the data: a line of sight inclined there by theta is inclined by s sin theta outside, and
/// light that would be inclined by more than a right angle does not come out.
TEST_P(ExitFacesOfTank, ReflectSteepLightTotally)
{
  const Tank tank(0);
  Scene scene = tankScene(GetParam());
  scene.pathModel = PathModel::Refracted;
  scene.view.parallelScale = 0.09;
  scene.view.viewAngle = 2 * std::asin(airIndex / (1 + water)) / radiansPerDegree + 2;
  EXPECT_GT(Bench().render(tank.field, scene).raysLost, 0);
  scene.view.viewAngle = 60; // 42 degrees in the corners
  EXPECT_EQ(Bench().render(tank.field, scene).raysLost, 0);
  scene.exitInto = ExitInto::Surroundings;
  scene.view.viewAngle = 2 * 49;
  EXPECT_EQ(Bench().render(tank.field, scene).raysLost, 0);
}

/// Inclined light in a medium that is stratified along w: nothing is changed along the faces, so nothing is bent
/// behind them.
TEST_P(ExitFacesOfTank, SeeNothingOfLayersAcrossTheLight)
{
  SampledField<double> layers(
    Tank::grid(), [](double, double, double z) { return 0.3 + 0.6 * z + z * z; });
  layers.field.ambient = airRefractivity;
  Scene scene = tankScene(GetParam());
  scene.view.viewAngle = 40;
  scene.pathModel = PathModel::Refracted;
  scene.precision = Precision::Double;
  const Image image = Bench().render(layers.field, scene);
  EXPECT_LT(image.momentumDrift, 1e-3);
  for (const float deflection : image.deflection)
  {
    ASSERT_NEAR(deflection, 0, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(, ExitFacesOfTank, bothDevices(), deviceName);

// Blocks of the medium reach beyond a grid of two points.
TEST(SteepestPlace, LiesInTheData)
{
  Grid grid;
  grid.dimensions = { 33, 33, 2 };
  grid.spacing = { 1, 1, 32 };
  grid.origin = { -16, -16, -16 };
  const SampledField<double> rod(
    grid, [](double x, double y, double) { return std::hypot(x, y) < 8 ? 0.5 : 0; });
  Scene scene = tankScene(Device::Cpu);
  scene.view.parallelScale = 16;
  const Image image = Bench().render(rod.field, scene);
  EXPECT_GT(image.steepestChange, 0.3);
  for (const double x : image.steepestPlace)
  {
    EXPECT_LE(std::abs(x), 16);
  }
}

/// A pane's faces take one voxel, with gas before and behind it.
class GlassInGas : public OnDevice
{
};

TEST_P(GlassInGas, APaneAcrossTheLightBendsNothing)
{
  constexpr double gradient = 2.26e-3;
  Grid grid;
  grid.dimensions = { 41, 5, 121 };
  grid.spacing = { 0.00125, 0.00125, 0.0005 };
  for (const double lateFace : { 0.03, 0.0601 }) // behind the second one is gas, or nothing
  {
    const SampledField<double> medium(grid,
      [lateFace](double x, double, double z)
      { return z > 0.02 && z < lateFace ? 0.5 : 2.7e-4 + gradient * x; });
    Field field = medium.field;
    field.ambient = 2.7e-4;
    for (const double step : { 1., 2. })
    {
      Scene scene = tankScene(GetParam());
      scene.view.viewUp = { 0, 1, 0 };
      scene.view.parallelScale = 0.002;
      scene.stepSize = step;
      const Image image = Bench().render(field, scene);
      // The faces are half a voxel before and behind the glass's points.
      const double inGas = lateFace < 0.06 ? 0.0505 : 0.02025;
      EXPECT_EQ(image.pathModel, PathModel::Refracted);
      EXPECT_EQ(image.integrator, Integrator::Adaptive);
      EXPECT_LT(image.momentumDrift, 1e-3);
      EXPECT_GT(image.steepestChange, 0.3);
      EXPECT_LT(image.steepestChange, 1);
      EXPECT_TRUE(std::abs(image.steepestPlace[2] - 0.02) < 0.005 ||
        std::abs(image.steepestPlace[2] - 0.03) < 0.005);
      EXPECT_NEAR(image.deflection[2 * pixelOf(image, middle, middle)], gradient * inGas,
        5e-3 * gradient * inGas)
        << step;
    }
  }
}

/// A rod of n = 1.5 with a face over three voxels turns light by 2 (asin h - asin h / n).
TEST_P(GlassInGas, ARodRefractsAsSnellSays)
{
  constexpr double radius = 1, glass = 1.5;
  constexpr std::int64_t points = 301;
  Grid grid;
  grid.dimensions = { points, 2, points };
  grid.spacing = { 3. / (points - 1), 3. / (points - 1), 3. / (points - 1) };
  grid.origin = { -1.5, 0, -1.5 };
  const double face = 1.5 * grid.spacing[0];
  const SampledField<float> rod(grid,
    [face](double x, double, double z)
    { return (glass - 1) * 0.5 * (1 - std::tanh((std::hypot(x, z) - radius) / face)); });
  Field field = rod.field;
  field.ambient = 0;
  for (const double step : { 1., 2. })
  {
    Scene scene;
    scene.device = GetParam();
    scene.stepSize = step;
    scene.samplesPerPixel = 1;
    scene.exitInto = ExitInto::Auto;
    scene.view.width = 101;
    scene.view.height = 3;
    scene.view.parallelScale = 0.03;
    const Image image = Bench().render(field, scene);
    EXPECT_LT(image.momentumDrift, 1e-3);
    for (int column = 0; column < image.width; ++column)
    {
      const double h = centreOf(image, column, 1).u;
      const double turned = std::sin(2 * (std::asin(std::abs(h)) - std::asin(std::abs(h) / glass)));
      if (std::abs(h) < 0.85)
      {
        const double found = image.deflection[2 * pixelOf(image, column, 1)];
        EXPECT_NEAR(found, h > 0 ? -turned : turned, 0.014 * turned + 1e-3) << h;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, GlassInGas, bothDevices(), deviceName);

} // namespace

} // namespace schlieren
