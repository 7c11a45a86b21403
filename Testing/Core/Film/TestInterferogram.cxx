// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Fringes against their formulas, of one wavelength and of white light.
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

using Color = std::array<double, 3>;

Color lightOf(const WhiteLight& kind, const RayAtFilm& ray)
{
  double light[3];
  kind.shade(ray, light);
  return { light[0], light[1], light[2] };
}

Color whiteLightAt(double path)
{
  return lightOf(WhiteLight::of(heliumNeon, {}, {}), behind(path));
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

/// Of a row of samples: how often light falls below one half and comes back.
int darkFringes(const std::vector<double>& light)
{
  int fringes = 0;
  for (std::size_t n = 1; n < light.size(); ++n)
  {
    fringes += light[n - 1] >= 0.5 && light[n] < 0.5 ? 1 : 0;
  }
  return fringes;
}

TEST(Interferogram, CountsTheFringesOfAPath)
{
  const Interferogram fringes = cutoffOf(interferogram(), 1);
  // A wedge: the path grows by 37 wavelengths over the row.
  std::vector<double> light;
  for (int n = 0; n <= 5000; ++n)
  {
    light.push_back(lightOf(fringes, behind(37 * heliumNeon * n / 5000)));
  }
  EXPECT_EQ(darkFringes(light), 37);
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

TEST(Interferogram, TakesAnyWavelength)
{
  for (const double wavelength : { 1e-12, 1e-9, 1., 1e3 })
  {
    Scene scene = interferogram();
    scene.wavelength = wavelength;
    const Interferogram fringes = cutoffOf(scene, 1);
    EXPECT_NEAR(lightOf(fringes, behind(0.25 * wavelength)), 0.5, 1e-9) << wavelength;
    EXPECT_NEAR(lightOf(fringes, behind(0.5 * wavelength)), 0, 1e-9) << wavelength;
    EXPECT_NEAR(lightOf(fringes, behind(3 * wavelength)), 1, 1e-9) << wavelength;
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

TEST(WhiteLight, IsWhiteWithoutAPath)
{
  const Color light = whiteLightAt(0);
  for (const double channel : light)
  {
    EXPECT_NEAR(channel, 1, 1e-5);
  }
}

TEST(WhiteLight, IsTheSameOnBothSides)
{
  for (double path = 0; path < 5e-6; path += 37e-9)
  {
    EXPECT_EQ(whiteLightAt(path), whiteLightAt(-path));
  }
}

/// What the colour of white light is that has a wavelength more or less: the integral, by itself. The colour
/// matching functions and the primaries are those of the code (they are checked below).
struct Spectrum
{
  std::vector<double> wavenumbers;
  std::vector<Color> contributions;
};

double lobe(double x, double height, double centre, double below, double above)
{
  const double t = (x - centre) * (x < centre ? below : above);
  return height * std::exp(-t * t / 2);
}

Spectrum fineSpectrum()
{
  // Linear sRGB of XYZ whose white is (1, 1, 1), by Bradford's adaptation.
  const double matrix[3][3] = { { 3.1466577, -1.6664638, -0.4801939 },
    { -0.9955216, 1.9557567, 0.0397649 }, { 0.0635948, -0.2145632, 1.1509684 } };
  Spectrum spectrum;
  std::vector<Color> xyz;
  Color sum{ 0, 0, 0 };
  for (double nm = 380; nm <= 780; nm += 0.25) // of equal energy per wavelength
  {
    const Color here{ lobe(nm, 0.362, 442, 0.0624, 0.0374) +
        lobe(nm, 1.056, 599.8, 0.0264, 0.0323) + lobe(nm, -0.065, 501.1, 0.049, 0.0382),
      lobe(nm, 0.821, 568.8, 0.0213, 0.0247) + lobe(nm, 0.286, 530.9, 0.0613, 0.0322),
      lobe(nm, 1.217, 437, 0.0845, 0.0278) + lobe(nm, 0.681, 459, 0.0385, 0.0725) };
    spectrum.wavenumbers.push_back(1e9 / nm);
    xyz.push_back(here);
    std::transform(sum.begin(), sum.end(), here.begin(), sum.begin(), std::plus<>());
  }
  for (const Color& here : xyz)
  {
    Color fraction{ 0, 0, 0 };
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        fraction[channel] += matrix[channel][axis] * here[axis] / sum[axis];
      }
    }
    spectrum.contributions.push_back(fraction);
  }
  return spectrum;
}

/// Limited to what a screen shows, as light is.
template <class Phase>
Color integral(const Spectrum& spectrum, const Phase& turnsOf)
{
  Color light{ 0.5, 0.5, 0.5 };
  for (std::size_t n = 0; n < spectrum.contributions.size(); ++n)
  {
    const double fringe = std::cos(2 * pi * turnsOf(spectrum.wavenumbers[n])) / 2;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      light[channel] += spectrum.contributions[n][channel] * fringe;
    }
  }
  std::transform(light.begin(), light.end(), light.begin(),
    [](double channel) { return std::clamp(channel, 0., 1.); });
  return light;
}

void expectNear(const Color& a, const Color& b, double tolerance)
{
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(a[channel], b[channel], tolerance) << "channel " << channel;
  }
}

TEST(WhiteLight, IsTheIntegralOverAllWavelengths)
{
  const Spectrum spectrum = fineSpectrum();
  for (double path = 0; path < 12e-6; path += 110e-9)
  {
    SCOPED_TRACE(path);
    expectNear(whiteLightAt(path), integral(spectrum, [=](double s) { return path * s; }), 2e-3);
  }
}

TEST(WhiteLight, HasItsMeanColorFarFromZeroAndNeverComesBack)
{
  for (double path = 20e-6; path < 300e-6; path += 53e-9)
  {
    expectNear(whiteLightAt(path), { 0.5, 0.5, 0.5 }, 5e-3);
  }
  for (const double path : { 1e-3, 0.1, 7., 1e6 })
  {
    expectNear(whiteLightAt(path), { 0.5, 0.5, 0.5 }, 1e-3);
  }
}

TEST(WhiteLight, IsDarkAtHalfAWavelengthOfGreen)
{
  double darkest = 2, at = 0;
  for (double path = 0; path < 0.6e-6; path += 1e-9)
  {
    const Color light = whiteLightAt(path);
    const double luminance = luminanceOf({ light[0], light[1], light[2] });
    if (luminance < darkest)
    {
      darkest = luminance;
      at = path;
    }
  }
  EXPECT_NEAR(at, 0.28e-6, 0.01e-6);
  EXPECT_LT(darkest, 0.03);
}

/// About that of air: N grows towards blue (Cauchy's form).
double likeAir(double wavelength)
{
  const auto index = [](double lambda) { return 1 + 5.67e-15 / (lambda * lambda); };
  return index(wavelength) / index(heliumNeon);
}

TEST(WhiteLight, DispersionScalesThePathOfEachWavelength)
{
  const Spectrum spectrum = fineSpectrum();
  for (const double strength : { 1., 8. })
  {
    const auto dispersion = [=](double lambda) { return 1 + strength * (likeAir(lambda) - 1); };
    const WhiteLight dispersed = WhiteLight::of(heliumNeon, dispersion, {});
    for (double path = 0; path < 12e-6; path += 230e-9)
    {
      SCOPED_TRACE(path);
      expectNear(lightOf(dispersed, behind(path)),
        integral(spectrum, [&](double s) { return path * s * dispersion(1 / s); }), 4e-3);
    }
  }
  // It differs from light without.
  const WhiteLight dispersed =
    WhiteLight::of(heliumNeon, [](double lambda) { return 1 + 8 * (likeAir(lambda) - 1); }, {});
  EXPECT_GT(std::abs(lightOf(dispersed, behind(2e-6))[1] - whiteLightAt(2e-6)[1]), 0.05);
}

TEST(WhiteLight, ACarrierIsAPathBesideTheGas)
{
  const Spectrum spectrum = fineSpectrum();
  Scene scene = interferogram();
  scene.view.width = 101;
  scene.view.height = 1;
  scene.fringes.finite = true;
  scene.fringes.spacing = 10; // pixels, and a path of one wavelength
  scene.fringes.whiteLight = true;
  scene.fringes.dispersion = likeAir;
  CutoffMaker maker;
  const WhiteLight light = std::get<WhiteLight>(maker.cutoffOf(scene, 0, { 1 }));
  expectNear(lightOf(light, { { 0, 0 }, 0, { 50, 0 } }), { 1, 1, 1 }, 1e-5);
  for (const double path : { 0., 1e-6, -4e-6, 40e-6 })
  {
    for (const double pixels : { 0., 3., 17., -40., -640. })
    {
      SCOPED_TRACE(path);
      SCOPED_TRACE(pixels);
      const double tilt = heliumNeon * pixels / 10;
      expectNear(lightOf(light, { { 0, 0 }, path, { 50 + pixels, 0 } }),
        integral(
          spectrum, [&](double s) { return s * (path * scene.fringes.dispersion(1 / s) + tilt); }),
        5e-3);
    }
  }
}

TEST(WhiteLightTable, IsTheSameLight)
{
  for (const bool isDispersed : { false, true })
  {
    // A table does for infinite fringes and for a gas without dispersion.
    Scene scene = interferogram();
    scene.view.width = 301;
    scene.view.height = 201;
    scene.fringes.whiteLight = true;
    scene.fringes.finite = !isDispersed;
    scene.fringes.spacing = 7;
    scene.fringes.angle = 20;
    const Carrier carrier = isDispersed ? Carrier{} : Carrier::of(7, 20, { 150, 100 });
    if (isDispersed)
    {
      scene.fringes.dispersion = likeAir;
    }
    CutoffMaker maker;
    const WhiteLightTable table = std::get<WhiteLightTable>(maker.cutoffOf(scene, 0, { 1 }));
    const WhiteLight light = WhiteLight::of(heliumNeon, scene.fringes.dispersion, carrier);
    for (double path = -40e-6; path < 40e-6; path += 77e-9)
    {
      const RayAtFilm ray{ { 0, 0 }, path, { 120 + 1e6 * path, 90 - 1e6 * path } };
      double color[3];
      table.shade(ray, color);
      expectNear({ color[0], color[1], color[2] }, lightOf(light, ray), 4e-3);
      if (std::abs(path) < 15e-6)
      {
        expectNear({ color[0], color[1], color[2] }, lightOf(light, ray), 5e-4);
      }
    }
  }
}

TEST(WhiteLightTable, IsNotTakenForGasesThatItIsNotMadeFor)
{
  Scene scene = interferogram();
  scene.fringes.whiteLight = true;
  CutoffMaker maker;
  for (const auto& [least, most] : { std::pair{ 0.5, 1. }, { 1., 1.5 }, { -1., 1. } })
  {
    scene.fringes.dispersion = [=](double lambda) { return lambda < 500e-9 ? most : least; };
    EXPECT_TRUE(std::holds_alternative<WhiteLight>(maker.cutoffOf(scene, 0, { 1 })));
  }
}

TEST(WhiteLight, DispersionThatIsNoNumberIsReported)
{
  EXPECT_THROW(WhiteLight::of(heliumNeon, [](double) { return std::nan(""); }, {}), Error);
}

TEST(WhiteLight, PrimariesAndWhiteAreThoseOfTheStandard)
{
  // The matrix undone: XYZ of sRGB's white, D65, adapted to E, is (1, 1, 1); its primaries keep their places
  // but for the adaptation. Bradford (Lam 1985), IEC 61966-2-1.
  const double toXyz[3][3] = { { 0.4124564, 0.3575761, 0.1804375 },
    { 0.2126729, 0.7151522, 0.0721750 }, { 0.0193339, 0.1191920, 0.9503041 } };
  const double cone[3][3] = { { 0.8951, 0.2664, -0.1614 }, { -0.7502, 1.7135, 0.0367 },
    { 0.0389, -0.0685, 1.0296 } };
  const double ours[3][3] = { { 3.1466577, -1.6664638, -0.4801939 },
    { -0.9955216, 1.9557567, 0.0397649 }, { 0.0635948, -0.2145632, 1.1509684 } };
  const auto times = [](const double(&m)[3][3], const Color& x)
  {
    return Color{ m[0][0] * x[0] + m[0][1] * x[1] + m[0][2] * x[2],
      m[1][0] * x[0] + m[1][1] * x[1] + m[1][2] * x[2],
      m[2][0] * x[0] + m[2][1] * x[1] + m[2][2] * x[2] };
  };
  const Color coneOfE = times(cone, { 1, 1, 1 });
  const Color coneOfD65 = times(cone, times(toXyz, { 1, 1, 1 }));
  for (const Color& rgb : { Color{ 1, 0, 0 }, Color{ 0, 1, 0 }, Color{ 0, 0, 1 } })
  {
    // The same cones' answer, each by its white's.
    const Color fromD65 = times(cone, times(toXyz, rgb));
    // Solve ours * xyz = rgb by Cramer's rule.
    const auto determinant = [](const Color& a, const Color& b, const Color& c)
    {
      return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
        c[0] * (a[1] * b[2] - a[2] * b[1]);
    };
    const auto column = [&ours](std::size_t n) {
      return Color{ ours[0][n], ours[1][n], ours[2][n] };
    };
    const double all = determinant(column(0), column(1), column(2));
    const Color xyz{ determinant(rgb, column(1), column(2)) / all,
      determinant(column(0), rgb, column(2)) / all, determinant(column(0), column(1), rgb) / all };
    const Color fromE = times(cone, xyz);
    for (std::size_t n = 0; n < 3; ++n)
    {
      EXPECT_NEAR(fromE[n] / coneOfE[n], fromD65[n] / coneOfD65[n], 2e-4);
    }
  }
}

} // namespace

} // namespace schlieren
