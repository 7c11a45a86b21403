// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Fringes against their formulas.
#include "Bench/CutoffMaker.h"
#include "Fields.h"
#include "Film/Exposure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace schlieren
{

namespace
{

constexpr double heliumNeon = 632.8e-9;

RayAtFilm behind(double path) { return { { 0, 0 }, path, { 0, 0 } }; }

double lightOf(const Interferogram& kind, const RayAtFilm& ray)
{
  double light[1];
  kind.shade(ray, light);
  return light[0];
}

Interferogram cutoffOf(const Scene& scene, double pixelSize)
{
  CutoffMaker maker;
  return std::get<Interferogram>(maker.cutoffOf(scene, 0, { pixelSize }));
}

Scene interferogram()
{
  Scene scene;
  scene.cutoff = Cutoff::Interferogram;
  return scene;
}

TEST(Interferogram, FollowsItsFormula)
{
  const Interferogram fringes = cutoffOf(interferogram(), 1);
  for (const double waves : { 0., 0.1, 0.25, 0.4999, 0.5, 0.77, 1., -0.3, 12.34, -1234.56 })
  {
    EXPECT_NEAR(
      lightOf(fringes, behind(waves * heliumNeon)), (1 + std::cos(2 * pi * waves)) / 2, 1e-11)
      << waves;
  }
  EXPECT_EQ(lightOf(fringes, behind(0)), 1);
}

TEST(Interferogram, KeepsItsPhaseOverTenMillionFringes)
{
  // Of a wavelength that is a power of two, so that whole fringes are exact.
  Scene scene = interferogram();
  scene.wavelength = std::ldexp(1, -20);
  scene.fringes.finite = true;
  scene.fringes.spacing = 16;
  const Interferogram fringes = cutoffOf(scene, 1);
  for (const double position : { 0., 1., 100., 8191. })
  {
    for (const double fraction : { 0., 0.125, 0.25, 0.4 })
    {
      RayAtFilm near{ { 0, 0 }, std::ldexp(fraction, -20), { position, 3 } };
      RayAtFilm far = near;
      far.path += std::ldexp(1e7, -20);
      EXPECT_NEAR(lightOf(fringes, far), lightOf(fringes, near), 1e-8) << position;
    }
  }
}

/// A prism of rays that are straight: all is of first order, and no bend makes a path longer.
TEST(Interferogram, OfStraightRaysIsOfTheirPathAlone)
{
  constexpr double slope = 1e-2, depth = 2;
  SampledField<double> prism(cube(16, 1), [](double x, double, double) { return slope * x; });
  prism.field.ambient = 0;
  Scene scene = interferogram();
  scene.device = Device::Cpu;
  scene.pathModel = PathModel::Straight;
  scene.wavelength = 4 * slope * slope; // a bend's path is longer by half of it
  scene.samplesPerPixel = 1;
  scene.view.focalPoint = Vector{ 0.2, 0.1, 0 };
  scene.view.width = 61;
  scene.view.height = 3;
  scene.view.parallelScale = 1.5 * 5e-4;
  const Image image = Bench().render(prism.field, scene);
  for (int column = 0; column < image.width; ++column)
  {
    const double waves = slope * depth * centreOf(image, column, 1).u / scene.wavelength;
    EXPECT_NEAR(
      image.intensity[pixelOf(image, column, 1)], (1 + std::cos(2 * pi * waves)) / 2, 2e-3);
  }
}

TEST(FiniteFringes, HaveTheirSpacingAndDirection)
{
  constexpr double pixelSize = 0.02, spacing = 0.3; // 15 pixels
  Scene scene = interferogram();
  scene.view.width = 301;
  scene.view.height = 201;
  scene.fringes.finite = true;
  scene.fringes.spacing = spacing;
  for (const double degrees : { 0., 30., 90., 135., 180., -70., 400. })
  {
    SCOPED_TRACE(degrees);
    scene.fringes.angle = degrees;
    const Interferogram fringes = cutoffOf(scene, pixelSize);
    const double across[2] = { std::cos(degrees * radiansPerDegree),
      std::sin(degrees * radiansPerDegree) };
    const auto at = [&](double alongNormal, double aside, double path)
    {
      // From the middle of the image, data units.
      const double u = alongNormal * across[0] - aside * across[1];
      const double v = alongNormal * across[1] + aside * across[0];
      return lightOf(fringes, { { 0, 0 }, path, { 150 + u / pixelSize, 100 + v / pixelSize } });
    };
    EXPECT_NEAR(at(0, 0, 0), 1, 1e-12);
    for (const double aside : { 0., 0.7, -1.1 })
    {
      EXPECT_NEAR(at(0, aside, 0), 1, 1e-12);
      EXPECT_NEAR(at(spacing, aside, 0), 1, 1e-12);
      EXPECT_NEAR(at(-7 * spacing, aside, 0), 1, 1e-12);
      EXPECT_NEAR(at(spacing / 2, aside, 0), 0, 1e-12);
      EXPECT_NEAR(at(spacing / 4, aside, 0), 0.5, 1e-12);
      // The phase grows along the direction, as with the path: where it does not, the other one makes up
      // for it.
      EXPECT_NEAR(at(spacing / 4, aside, heliumNeon / 4), 0, 1e-9);
      EXPECT_NEAR(at(spacing / 4, aside, -heliumNeon / 4), 1, 1e-9);
    }
  }
}

TEST(FiniteFringes, AlongAnAxisAreExactlyStraight)
{
  Scene scene = interferogram();
  scene.fringes.finite = true;
  scene.fringes.spacing = 7.3;
  for (const double degrees : { 0., 180., 90., -90. })
  {
    scene.fringes.angle = degrees;
    const Interferogram fringes = cutoffOf(scene, 1);
    const bool isAcross = std::abs(degrees) == 90;
    const auto at = [&](double along, double aside)
    {
      return lightOf(fringes,
        isAcross ? RayAtFilm{ { 0, 0 }, 0, { aside, along } }
                 : RayAtFilm{ { 0, 0 }, 0, { along, aside } });
    };
    EXPECT_EQ(at(12, 0), at(12, 511));
    EXPECT_NE(at(12, 0), at(13, 0));
  }
}

/// One ray per pixel makes pixels as bright as the fringes in them are on average, wherever in a pixel rays start.
void expectMeansOfPixels(double spacing, double bend, double tolerance)
{
  constexpr int width = 40, height = 30, margin = 2, columns = width + 2 * margin;
  constexpr int finer = 64;
  Scene scene = interferogram();
  scene.view.width = width;
  scene.view.height = height;
  scene.fringes.finite = true;
  scene.fringes.spacing = spacing;
  scene.fringes.angle = 25;
  const Interferogram fringes = cutoffOf(scene, 1);
  const auto waves = [=](double x, double y)
  { return bend * (std::sin(0.12 * x) + std::cos(0.17 * y - 0.05 * x)); };
  for (const PixelOffset& offset : { PixelOffset{ 0, 0 }, PixelOffset{ 0.4, -0.23 } })
  {
    const Pass pass{ -margin, -margin, columns, height + 2 * margin, offset };
    RayExits exits;
    for (std::int64_t ray = 0; ray < pass.columns * pass.rows; ++ray)
    {
      RayExit exit{};
      exit.opticalPathDifference = heliumNeon * waves(pass.columnOf(ray), pass.rowOf(ray));
      exits.push_back(exit);
    }
    Films films(1, width, height, pass.columns * pass.rows);
    expose({ { pass, exits.data() } }, fringes, { 0, 1, 0 }, margin, 1, films);
    const PixelArray<float> image = films.developIntensity(1, 1);
    double worst = 0;
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        double mean = 0;
        for (int n = 0; n < finer * finer; ++n)
        {
          const double x = column - 0.5 + (n % finer + 0.5) / finer;
          const double y = row - 0.5 + (static_cast<double>(n / finer) + 0.5) / finer;
          mean += lightOf(fringes, { { 0, 0 }, heliumNeon * waves(x, y), { x, y } });
        }
        worst = std::max(worst,
          std::abs(mean / (finer * finer) -
            static_cast<double>(image[static_cast<std::size_t>(row * width + column)])));
      }
    }
    EXPECT_LT(worst, tolerance);
  }
}

TEST(FiniteFringes, OfAPixelEachAreRightWithARayEach)
{
  for (const double spacing : { 8., 3., 2., 1.3 })
  {
    SCOPED_TRACE(spacing);
    expectMeansOfPixels(spacing, 0, 2e-4); // what the sums above leave out
    expectMeansOfPixels(spacing, 1, 2e-3);
  }
}

} // namespace

} // namespace schlieren
