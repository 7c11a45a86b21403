// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of waves, from a field on.
#include "Fields.h"
#include "Messages.h"
#include "SameImage.h"
#include "WaveForms.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

using namespace schlieren;
using namespace schlieren::waveforms;

namespace
{

constexpr double radius = 1e-3;
constexpr double phase = 3; // radians, in the middle

/// A Gaussian column along y in a cube of 8 mm, in metres.
const SampledField<double>& column()
{
  static const SampledField<double> field(cube(97, 4e-3),
    [](double x, double, double z)
    {
      const double path = phase * green / (2 * pi);
      return path / (std::sqrt(pi) * radius) * std::exp(-(x * x + z * z) / (radius * radius));
    });
  return field;
}

Scene laserShadowgraph()
{
  Scene scene;
  scene.cutoff = Cutoff::Shadowgraph;
  scene.lightModel = LightModel::Waves;
  scene.wavelength = green;
  scene.screenDistance = 0.2;
  scene.view.parallelScale = 3e-3;
  scene.view.width = 96;
  scene.view.height = 96;
  scene.samplesPerPixel = 1;
  scene.interpolation = Interpolation::Cubic;
  scene.device = Device::Cpu;
  return scene;
}

Field columnInVacuum()
{
  Field field = column().field;
  field.ambient = 0;
  return field;
}

double lightBehindColumn(double x, double distance)
{
  return std::norm(fieldBehindColumn(x, radius, phase, distance));
}

/// The mean of a function of x over a pixel.
template <class Function>
double meanOfPixel(const Image& image, int column, const Function& f)
{
  const double middle = centreOf(image, column, 0).u, half = 0.5 * image.frame.pixelSize;
  return integral(f, middle - half, middle + half, 8) / image.frame.pixelSize;
}

Numbers rowOf(const Image& image, int row)
{
  Numbers light;
  for (int i = 0; i < image.width; ++i)
  {
    light.push_back(static_cast<double>(image.intensity[pixelOf(image, i, row)]));
  }
  return light;
}

} // namespace

TEST(WaveStage, GaussianColumnIsAsItsClosedForm)
{
  for (const Precision precision : { Precision::Single, Precision::Double })
  {
    Scene scene = laserShadowgraph();
    scene.precision = precision;
    const Image image = Bench().render(columnInVacuum(), scene);
    EXPECT_EQ(image.lightModel, LightModel::Waves);
    Numbers seen, exact;
    for (int i = 0; i < image.width; ++i)
    {
      seen.push_back(static_cast<double>(image.intensity[pixelOf(image, i, 40)]));
      exact.push_back(integral([&](double x) { return lightBehindColumn(x, 0.204); },
                        centreOf(image, i, 0).u - 0.5 * image.frame.pixelSize,
                        centreOf(image, i, 0).u + 0.5 * image.frame.pixelSize, 8) /
        image.frame.pixelSize);
    }
    EXPECT_LT(rms(seen, exact), 1e-4) << name(precision);
    EXPECT_GT(rms(exact, Numbers(exact.size(), 1)), 0.04);
    EXPECT_NEAR(image.waves.plane, 4e-3, 2e-4);
    EXPECT_NEAR(image.waves.fresnelWidth, std::sqrt(green * (0.2 + image.waves.plane)), 1e-9);
  }
}

TEST(WaveStage, DivergingLightIsAsParallelLightOfAnotherDistance)
{
  // The image is that in the column's plane, of which the screen is 0.204 m away.
  const double source = 0.5, magnification = 1 + 0.204 / source;
  for (const bool isPupil : { false, true })
  {
    Scene scene = laserShadowgraph();
    if (isPupil)
    {
      scene.view.viewAngle = 2 * std::atan(scene.view.parallelScale / source) / radiansPerDegree;
    }
    else
    {
      scene.source.distance = source;
    }
    const Image image = Bench().render(columnInVacuum(), scene);
    ASSERT_EQ(image.lightModel, LightModel::Waves);
    Numbers seen, exact;
    for (int i = 0; i < image.width; ++i)
    {
      seen.push_back(static_cast<double>(image.intensity[pixelOf(image, i, 40)]));
      exact.push_back(
        integral([&](double x) { return lightBehindColumn(x, 0.204 / magnification); },
          centreOf(image, i, 0).u - 0.5 * image.frame.pixelSize,
          centreOf(image, i, 0).u + 0.5 * image.frame.pixelSize, 8) /
        image.frame.pixelSize);
    }
    EXPECT_LT(rms(seen, exact), 1e-4) << isPupil;
    EXPECT_NEAR(image.waves.plane, 4e-3, 2e-4);
    EXPECT_NEAR(image.waves.fresnelWidth, std::sqrt(green * 0.204 / magnification), 1e-6);
  }
}

namespace
{

constexpr double strongPath = 60 * green / (2 * pi);

const SampledField<double>& strongColumn()
{
  static const SampledField<double> field(cube(97, 4e-3),
    [](double x, double, double z) {
      return strongPath / (std::sqrt(pi) * radius) * std::exp(-(x * x + z * z) / (radius * radius));
    });
  return field;
}

constexpr double weakPhase = 0.01;

const SampledField<double>& weakColumn()
{
  static const SampledField<double> field(cube(97, 4e-3),
    [](double x, double, double z)
    {
      const double path = weakPhase * green / (2 * pi);
      return path / (std::sqrt(pi) * radius) * std::exp(-(x * x + z * z) / (radius * radius));
    });
  return field;
}

} // namespace

TEST(WaveStage, KnifeEdgeOfAWideSlitIsAsThatOfRays)
{
  Field field = strongColumn().field;
  field.ambient = 0;
  Scene scene = laserShadowgraph();
  scene.cutoff = Cutoff::KnifeEdge;
  scene.kScale = radius / (5 * strongPath);
  scene.cutoffOffset = 0.1;
  const Image waves = Bench().render(field, scene);
  EXPECT_EQ(waves.lightModel, LightModel::Waves);
  EXPECT_NE(waves.lightNote.find("rays suffice"), std::string::npos);
  scene.lightModel = LightModel::Rays;
  const Image rays = Bench().render(field, scene);
  Numbers seen, exact;
  for (std::size_t i = 0; i < rays.intensity.size(); ++i)
  {
    seen.push_back(static_cast<double>(waves.intensity[i]));
    exact.push_back(static_cast<double>(rays.intensity[i]));
  }
  EXPECT_LT(rms(seen, exact), 0.01);
  EXPECT_GT(rms(exact, Numbers(exact.size(), 0.4)), 0.05);

  scene.lightModel = LightModel::Waves;
  scene.kScale = 0;
  EXPECT_NE(messageOf(field, scene).find("KScale"), std::string::npos);
}

TEST(WaveStage, KnifeEdgeOfADiscIsAsThatOfRays)
{
  Field field = strongColumn().field;
  field.ambient = 0;
  Scene scene = laserShadowgraph();
  scene.cutoff = Cutoff::KnifeEdge;
  scene.kScale = radius / (3 * strongPath);
  scene.source = { {}, SourceShape::Disc, 1 / *scene.kScale, 0 };
  const Image waves = Bench().render(field, scene);
  scene.lightModel = LightModel::Rays;
  const Image disc = Bench().render(field, scene);
  scene.source.shape = SourceShape::Slit;
  const Image slit = Bench().render(field, scene);
  EXPECT_LT(rms(rowOf(waves, 48), rowOf(disc, 48)), 0.01);
  EXPECT_GT(rms(rowOf(slit, 48), rowOf(disc, 48)), 0.02);
}

// A source narrower than the wavelength by the image's width is one point.
TEST(WaveStage, KnifeEdgeOfANarrowSourceIsThatOfALaser)
{
  Field field = weakColumn().field;
  field.ambient = 0;
  Scene scene = laserShadowgraph();
  scene.cutoff = Cutoff::KnifeEdge;
  for (const double slits : { 0.99, 1e-9 })
  {
    scene.kScale = 6e-3 / (slits * green);
    const Image image = Bench().render(field, scene);
    EXPECT_NEAR(image.undisturbedLevel, 0.25, 1e-12);
    Numbers exact;
    for (int i = 0; i < image.width; ++i)
    {
      const double x = centreOf(image, i, 48).u / radius;
      exact.push_back(0.25 * (1 - 4 * weakPhase / std::sqrt(pi) * dawson(x)));
    }
    EXPECT_LT(rms(rowOf(image, 48), exact), 0.03 * 0.5 * weakPhase) << slits;
  }
  scene.kScale = 6e-3 / (1.01 * green);
  EXPECT_NEAR(Bench().render(field, scene).undisturbedLevel, 0.5, 1e-12);
}

TEST(WaveStage, GradedFilterOfALaserIsAsThatOfRays)
{
  Field field = strongColumn().field;
  field.ambient = 0;
  Scene scene = laserShadowgraph();
  scene.kScale = radius / (5 * strongPath);
  scene.cutoff = Cutoff::GradedFilter;
  scene.gradedFilter = { 0.2, 0.6, 0.9 };
  scene.lightModel = LightModel::Waves;
  const Image waves = Bench().render(field, scene);
  scene.lightModel = LightModel::Rays;
  const Image rays = Bench().render(field, scene);
  EXPECT_LT(rms(rowOf(waves, 48), rowOf(rays, 48)), 6e-3);
  EXPECT_GT(rms(rowOf(rays, 48), Numbers(96, 0.6)), 0.05);
  EXPECT_NEAR(waves.undisturbedLevel, rays.undisturbedLevel, 1e-6);
}

TEST(WaveStage, PhaseContrastIsOfItsPlate)
{
  Scene scene = laserShadowgraph();
  scene.cutoff = Cutoff::PhaseContrast;
  for (const PhasePlate& plate :
    { PhasePlate{ 0, 0.25, 1 }, PhasePlate{ 0, -0.25, 0.04 }, PhasePlate{ 0, 0, 0 } })
  {
    scene.phasePlate = plate;
    const Image image = Bench().render(columnInVacuum(), scene);
    ASSERT_EQ(image.lightModel, LightModel::Waves);
    const Complex factor = std::polar(std::sqrt(plate.transmission), 2 * pi * plate.delay);
    Numbers exact;
    for (int i = 0; i < image.width; ++i)
    {
      exact.push_back(meanOfPixel(image, i,
        [&](double x)
        {
          const double turned = phase * std::exp(-x * x / (radius * radius));
          return std::norm(factor + std::polar(1., turned) - 1.);
        }));
    }
    EXPECT_LT(rms(rowOf(image, 48), exact), 2e-3) << plate.transmission;
    EXPECT_NEAR(image.undisturbedLevel, plate.transmission, 1e-12);
  }
}

TEST(WaveStage, InterferogramIsThatOfRaysInFocus)
{
  for (const double spacing : { 0., 8e-4 })
  {
    Scene scene = laserShadowgraph();
    scene.cutoff = Cutoff::Interferogram;
    scene.fringes.finite = spacing > 0;
    scene.fringes.spacing = spacing;
    scene.fringes.angle = 30;
    const Image waves = Bench().render(columnInVacuum(), scene);
    EXPECT_EQ(waves.lightModel, LightModel::Waves);
    scene.lightModel = LightModel::Rays;
    scene.samplesPerPixel = 16;
    const Image rays = Bench().render(columnInVacuum(), scene);
    for (const int row : { 10, 48, 80 })
    {
      EXPECT_LT(rms(rowOf(waves, row), rowOf(rays, row)), 2e-3) << spacing;
    }
    EXPECT_GT(rms(rowOf(rays, 48), Numbers(96, 0.5)), 0.2);
    EXPECT_EQ(waves.undisturbedLevel, rays.undisturbedLevel);
  }
}

TEST(WaveStage, InterferogramAwayFromFocusIsAsItsClosedForm)
{
  for (const double offset : { 0.2, -0.2 })
  {
    Scene scene = laserShadowgraph();
    scene.cutoff = Cutoff::Interferogram;
    scene.focusOffset = offset;
    const Image image = Bench().render(columnInVacuum(), scene);
    Numbers exact;
    for (int i = 0; i < image.width; ++i)
    {
      exact.push_back(meanOfPixel(image, i,
        [offset](double x)
        { return 0.25 * std::norm(1. + fieldBehindColumn(x, radius, phase, offset)); }));
    }
    EXPECT_LT(rms(rowOf(image, 48), exact), 1e-3) << offset;
    scene.lightModel = LightModel::Rays;
    EXPECT_GT(rms(rowOf(Bench().render(columnInVacuum(), scene), 48), exact), 5e-3) << offset;
  }
}

TEST(WaveStage, AllButTheLightIsOfRays)
{
  Scene scene = laserShadowgraph();
  Image waves = Bench().render(columnInVacuum(), scene);
  scene.lightModel = LightModel::Rays;
  Bench bench;
  const Image rays = bench.render(columnInVacuum(), scene);
  EXPECT_EQ(rays.waves.fresnelWidth, 0);
  EXPECT_NE(waves.intensity, rays.intensity);
  waves.intensity = rays.intensity;
  expectSameImage(waves, rays);

  // After an image of waves there are the same rays.
  scene.lightModel = LightModel::Waves;
  bench.render(columnInVacuum(), scene);
  scene.lightModel = LightModel::Rays;
  expectSameImage(bench.render(columnInVacuum(), scene), rays);
}

TEST(WaveStage, AnotherScreenNeedsNoOtherRays)
{
  Bench bench;
  Scene scene = laserShadowgraph();
  bench.render(columnInVacuum(), scene);
  const std::int64_t rays = bench.work().raysTraced;
  scene.screenDistance = 0.15;
  const Image again = bench.render(columnInVacuum(), scene);
  EXPECT_EQ(bench.work().raysTraced, rays);
  // What differs is where light around the image falls to undisturbed light.
  const Image anew = Bench().render(columnInVacuum(), scene);
  EXPECT_LT(rms({ again.intensity.begin(), again.intensity.end() },
              { anew.intensity.begin(), anew.intensity.end() }),
    2e-3);
}

TEST(WaveStage, WhatCannotBeMadeIsAnError)
{
  struct Case
  {
    void (*spoil)(Scene&);
    const char* words;
  };
  for (const Case& each :
    { Case{ [](Scene& scene) { scene.cutoff = Cutoff::ColorFilter; }, "Cutoff is Color Filter" },
      Case{ [](Scene& scene) { scene.view.viewAngle = 40; }, "or LightModel to Rays" },
      Case{ [](Scene& scene)
        {
          scene.view.viewAngle = 40;
          scene.cutoff = Cutoff::PhaseContrast;
        },
        "ViewAngle to less (0 is parallel light), or Cutoff to another technique" },
      Case{ [](Scene& scene) { scene.source.distance = 1e-2; }, "collimated light" },
      Case{ [](Scene& scene)
        {
          scene.source.distance = 1;
          scene.exitInto = ExitInto::Custom;
          scene.exitRefractivity = 0.3;
        },
        "ExitInto" },
      Case{ [](Scene& scene) { scene.pathModel = PathModel::Straight; }, "PathModel" },
      Case{ [](Scene& scene) { scene.wavelength = 0; }, "Wavelength" },
      Case{ [](Scene& scene) { scene.screenDistance = 1e4; }, "may be used" } })
  {
    Scene scene = laserShadowgraph();
    each.spoil(scene);
    EXPECT_NE(messageOf(columnInVacuum(), scene).find(each.words), std::string::npos)
      << messageOf(columnInVacuum(), scene);
  }
}
