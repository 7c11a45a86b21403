// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of waves, from a field on.
#include "Fields.h"
#include "SameImage.h"
#include "WaveForms.h"

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

/// exp(i phase exp(-x^2 / s^2)) is a sum of Gaussians, each of which stays one.
double lightBehindColumn(double x, double distance)
{
  const std::complex<double> grows(0, distance * green / pi); // 2 i D / k
  std::complex<double> sum = 1, factor = 1;
  for (int n = 1; n < 40; ++n)
  {
    factor *= std::complex<double>(0, phase) / static_cast<double>(n);
    const double square = radius * radius / n;
    sum += factor * std::sqrt(square / (square + grows)) * std::exp(-x * x / (square + grows));
  }
  return std::norm(sum);
}

std::string messageOf(const Field& field, const Scene& scene)
{
  try
  {
    Bench().render(field, scene);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
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
    EXPECT_LT(rms(seen, exact), 5e-4) << name(precision);
    EXPECT_GT(rms(exact, Numbers(exact.size(), 1)), 0.04);
    EXPECT_NEAR(image.waves.plane, 4e-3, 2e-4);
    EXPECT_NEAR(image.waves.fresnelWidth, std::sqrt(green * (0.2 + image.waves.plane)), 1e-9);
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

  // After an image of waves there are the same rays, and with Auto on pixels of 8 mm, too.
  scene.lightModel = LightModel::Waves;
  bench.render(columnInVacuum(), scene);
  scene.lightModel = LightModel::Rays;
  expectSameImage(bench.render(columnInVacuum(), scene), rays);
  scene.view.parallelScale = 4e-2;
  scene.view.width = scene.view.height = 10;
  const Image coarse = bench.render(columnInVacuum(), scene);
  scene.lightModel = LightModel::Auto;
  const Image chosen = bench.render(columnInVacuum(), scene);
  expectSameImage(chosen, coarse);
  EXPECT_EQ(chosen.lightModel, LightModel::Rays);
  EXPECT_GT(chosen.waves.blur, 4 * chosen.waves.fresnelWidth);
}

TEST(WaveStage, AutoTakesWavesWhereTheyShow)
{
  Scene scene = laserShadowgraph();
  const Image waves = Bench().render(columnInVacuum(), scene);
  scene.lightModel = LightModel::Auto;
  const Image chosen = Bench().render(columnInVacuum(), scene);
  EXPECT_EQ(chosen.lightModel, LightModel::Waves);
  EXPECT_EQ(chosen.intensity, waves.intensity);
  scene.cutoff = Cutoff::KnifeEdge;
  const Image knife = Bench().render(columnInVacuum(), scene);
  EXPECT_EQ(knife.lightModel, LightModel::Rays);
  EXPECT_NE(knife.lightNote.find("Shadowgraph alone"), std::string::npos);
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

TEST(WaveStage, DoesNotDependOnThreads)
{
  Scene scene = laserShadowgraph();
  scene.threads = 1;
  const Image one = Bench().render(columnInVacuum(), scene);
  scene.threads = 3;
  EXPECT_EQ(Bench().render(columnInVacuum(), scene).intensity, one.intensity);
}

TEST(WaveStage, WhatCannotBeMadeIsAnError)
{
  struct Case
  {
    void (*spoil)(Scene&);
    const char* words;
  };
  for (const Case& each :
    { Case{ [](Scene& scene) { scene.cutoff = Cutoff::Interferogram; }, "Cutoff is Interferogram" },
      Case{ [](Scene& scene) { scene.view.viewAngle = 10; }, "ViewAngle to 0" },
      Case{ [](Scene& scene) { scene.source.distance = 1; }, "Collimated" },
      Case{ [](Scene& scene) { scene.pathModel = PathModel::Straight; }, "PathModel" },
      Case{ [](Scene& scene) { scene.bandwidth = green; }, "Bandwidth" },
      Case{ [](Scene& scene) { scene.coherenceSamples = 0; }, "CoherenceSamples" },
      Case{ [](Scene& scene) { scene.wavelength = 0; }, "Wavelength" },
      Case{ [](Scene& scene) { scene.screenDistance = 1e4; }, "MemoryBudget" } })
  {
    Scene scene = laserShadowgraph();
    each.spoil(scene);
    EXPECT_NE(messageOf(columnInVacuum(), scene).find(each.words), std::string::npos)
      << messageOf(columnInVacuum(), scene);
  }
}
