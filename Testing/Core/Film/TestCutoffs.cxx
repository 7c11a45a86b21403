// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Each cutoff against its formula, on deflections that are known.
#include "Bench/CutoffMaker.h"
#include "Fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace schlieren
{

namespace
{

RayAtFilm bent(double u, double v) { return { { u, v }, 0, { 0, 0 } }; }

template <class Kind>
std::array<double, Kind::channels> lightOf(const Kind& kind, const RayAtFilm& ray)
{
  double light[Kind::channels];
  kind.shade(ray, light);
  std::array<double, Kind::channels> result;
  std::copy(std::begin(light), std::end(light), result.begin());
  return result;
}

/// Of kinds with one channel.
template <class Kind>
double lightOf(const Kind& kind, double u, double v)
{
  static_assert(Kind::channels == 1);
  return lightOf(kind, bent(u, v))[0];
}

/// The light of the scene's cutoff.
std::vector<double> lightOf(const Scene& scene, double k, const RayAtFilm& ray)
{
  CutoffMaker maker;
  return std::visit(
    [&ray](const auto& kind)
    {
      const auto light = lightOf(kind, ray);
      return std::vector<double>(light.begin(), light.end());
    },
    maker.cutoffOf(scene, k, { 1 }));
}

double levelOf(const Scene& scene, double k)
{
  CutoffMaker maker;
  return undisturbedLevel(maker.cutoffOf(scene, k, { 1 }));
}

TEST(KnifeEdge, FollowsItsFormula)
{
  const double u = 1e-4, v = -3e-4;
  EXPECT_DOUBLE_EQ(lightOf(KnifeEdge::at(0, 1000), u, v), 0.6);
  EXPECT_DOUBLE_EQ(lightOf(KnifeEdge::at(90, 1000), u, v), 0.2);
  EXPECT_DOUBLE_EQ(lightOf(KnifeEdge::at(180, 1000), u, v), 0.4);
  EXPECT_DOUBLE_EQ(lightOf(KnifeEdge::at(-90, 1000), u, v), 0.8);
  EXPECT_DOUBLE_EQ(lightOf(KnifeEdge::at(360, 1000), u, v), 0.6);
  EXPECT_DOUBLE_EQ(lightOf(KnifeEdge::at(180, 1000), u, v), 0.4);
  EXPECT_NEAR(lightOf(KnifeEdge::at(45, 1000), u, v), 0.5 - 0.2 * std::sqrt(0.5), 1e-15);
  EXPECT_EQ(lightOf(KnifeEdge::at(0, 0), u, v), 0.5);
  EXPECT_EQ(lightOf(KnifeEdge::at(0, 1e12), u, v), 1);
  EXPECT_EQ(lightOf(KnifeEdge::at(90, 1e12), u, v), 0);
}

TEST(KnifeEdge, SeesNothingAlongItself)
{
  for (const double degrees : { 0., 180., -180., 360., 720. })
  {
    EXPECT_EQ(lightOf(KnifeEdge::at(degrees, 1e12), 0, 0.3), 0.5);
  }
  for (const double degrees : { 90., -90., 270., 450. })
  {
    EXPECT_EQ(lightOf(KnifeEdge::at(degrees, 1e12), 0.3, 0), 0.5);
  }
}

TEST(KnifeEdge, OffsetTakesItsFractionAndInvertingTheRest)
{
  for (const double offset : { -0.3, 0., 0.1, 0.5 })
  {
    EXPECT_NEAR(lightOf(KnifeEdge::at(0, 1000, offset), 2e-4, 0), 0.7 - offset, 1e-15);
    EXPECT_NEAR(lightOf(KnifeEdge::at(180, 1000, -offset), 2e-4, 0), 0.3 + offset, 1e-15);
  }
  EXPECT_EQ(lightOf(KnifeEdge::at(0, 1000, 0.8), 1e-4, 0), 0);
  EXPECT_EQ(lightOf(KnifeEdge::at(0, 1000, -0.8), -1e-4, 0), 1);
}

TEST(KnifeEdge, ContrastIsFocalLengthTimesDeflectionByTheSourcesWidth)
{
  // A bench as in a laboratory: f = 2 m, a slit of 1 mm, and an edge at 0.2 mm from its image's middle.
  const double focalLength = 2, width = 1e-3, edge = 0.2e-3;
  const double eps = 3e-5;
  const KnifeEdge knife = KnifeEdge::at(0, focalLength / width, edge / width);
  const double before = lightOf(knife, 0, 0);
  const double change = lightOf(knife, eps, 0) - before;
  EXPECT_NEAR(before, 0.3, 1e-15);
  // dI / I = f eps / a' with a', what the edge leaves of the image's width (Settles 2001).
  EXPECT_NEAR(change / before, focalLength * eps / (0.5 * width - edge), 1e-12);
  // Against light without the knife.
  EXPECT_NEAR(change, focalLength * eps / width, 1e-15);
}

/// The part of a disc of diameter 1 at x < edge (from its middle), by the midpoint rule.
double partOfDisc(double edge)
{
  constexpr int strips = 200000;
  double part = 0;
  const double width = (edge + 0.5) / strips;
  for (int n = 0; n < strips; ++n)
  {
    const double x = -0.5 + (n + 0.5) * width;
    part += 2 * std::sqrt(0.25 - x * x) * width;
  }
  return part / (pi / 4);
}

TEST(KnifeEdge, OfADiscLetsASegmentPass)
{
  const KnifeEdge knife = KnifeEdge::at(0, 1000, 0.1, SourceShape::Disc);
  for (const double eps : { -4e-4, -3e-4, 0., 1e-4, 3.7e-4, 5.9e-4 })
  {
    EXPECT_NEAR(lightOf(knife, eps, 0), partOfDisc(1000 * eps - 0.1), 1e-8) << eps;
  }
  EXPECT_EQ(lightOf(knife, 6.01e-4, 0), 1);
  EXPECT_EQ(lightOf(knife, -4.01e-4, 0), 0);
  EXPECT_EQ(lightOf(KnifeEdge::at(0, 0, 0, SourceShape::Disc), 1, 1), 0.5);
  EXPECT_EQ(lightOf(KnifeEdge::at(180, 1e12, 0, SourceShape::Disc), 1, 1), 0);
  // In its middle a disc is wider than a strip of the same area.
  const KnifeEdge middle = KnifeEdge::at(0, 1, 0, SourceShape::Disc);
  EXPECT_NEAR((lightOf(middle, 1e-6, 0) - 0.5) / 1e-6, 4 / pi, 1e-5);
}

TEST(NumericalSchlieren, DarkensExponentially)
{
  for (const double distance : { 0., 1e-9, 0.1, 1., 3., 7.9 })
  {
    const double expected = std::exp(-5 * distance);
    EXPECT_NEAR(lightOf(NumericalSchlieren{ 2000 }, 3e-4 * distance, -4e-4 * distance), expected,
      1e-8 * expected);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double strange : { 1., std::numeric_limits<double>::infinity(), nan })
  {
    EXPECT_NEAR(lightOf(NumericalSchlieren{ 1e12 }, strange, 0), 0, 1e-12);
  }
  EXPECT_EQ(lightOf(NumericalSchlieren{ 0 }, 0.3, 0.4), 1);
}

TEST(BrightField, DarkensWithTheDeflectionWhateverItsDirection)
{
  for (const double degrees : { 0., 37., 90., 200., 315. })
  {
    const double u = 2e-4 * std::cos(degrees * radiansPerDegree);
    const double v = 2e-4 * std::sin(degrees * radiansPerDegree);
    EXPECT_NEAR(lightOf(BrightField{ 1500 }, u, v), 0.7, 1e-14);
    EXPECT_NEAR(lightOf(DarkField{ 1500 }, u, v), 0.3, 1e-14);
    EXPECT_EQ(lightOf(BrightField{ 0 }, u, v), 1);
    EXPECT_EQ(lightOf(DarkField{ 0 }, u, v), 0);
    EXPECT_EQ(lightOf(BrightField{ 1e12 }, u, v), 0);
    EXPECT_EQ(lightOf(DarkField{ 1e12 }, u, v), 1);
  }
  EXPECT_EQ(lightOf(BrightField{ 1e12 }, 0, 0), 1);
  EXPECT_EQ(lightOf(DarkField{ 1e12 }, 0, 0), 0);
}

TEST(GradedFilter, IsReadWhereTheKnifeEdgesFractionIs)
{
  Scene scene;
  scene.cutoff = Cutoff::GradedFilter;
  scene.knifeEdgeAngle = 90;
  scene.cutoffOffset = 0.1;
  scene.gradedFilter = { 0, 1, 0.5 };
  // At 0.4 + 1000 eps_v: the filter rises to 1 at 0.5 and falls to 0.5 at 1.
  const auto at = [&scene](double v) { return lightOf(scene, 1000, bent(7, v))[0]; };
  EXPECT_NEAR(at(0), 0.8, 1e-7);
  EXPECT_NEAR(at(-2e-4), 0.4, 1e-7);
  EXPECT_NEAR(at(3e-4), 0.8, 1e-7);
  EXPECT_NEAR(at(6e-4), 0.5, 1e-7);
  EXPECT_EQ(at(1), 0.5);
  EXPECT_EQ(at(-1), 0);
}

TEST(GradedFilter, OfARampIsTheKnifeEdge)
{
  Scene scene;
  scene.knifeEdgeAngle = 33;
  scene.cutoffOffset = -0.07;
  Scene filter = scene;
  filter.cutoff = Cutoff::GradedFilter;
  for (const double k : { 0., 100., 3000., 1e12 })
  {
    const RayAtFilm ray = bent(1.3e-4, -0.4e-4);
    EXPECT_NEAR(lightOf(filter, k, ray)[0], lightOf(scene, k, ray)[0], 1e-15) << k;
  }
}

/// sRGB's transfer function from light to value, IEC 61966-2-1: the other way from what is tested.
double srgbOf(double light)
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

TEST(ColorWheel, HueIsTheDirectionInAllQuadrants)
{
  Scene scene;
  scene.cutoff = Cutoff::ColorFilter;
  const double k = 500;
  for (int degrees = -179; degrees <= 180; ++degrees)
  {
    SCOPED_TRACE(degrees);
    const double saturation = 0.2 + 0.002 * (degrees + 180);
    const double radians = degrees * radiansPerDegree;
    const auto light = lightOf(
      scene, k, bent(saturation / k * std::cos(radians), saturation / k * std::sin(radians)));
    std::array<double, 3> value{};
    std::transform(light.begin(), light.end(), value.begin(), srgbOf);
    const auto [least, most] = std::minmax_element(value.begin(), value.end());
    EXPECT_NEAR(*most, 1, 1e-5);
    EXPECT_NEAR(*most - *least, saturation, 1e-5);
    // Back from the colour to the hue (Smith 1978).
    const double c = *most - *least;
    const double sixths = most == value.begin() ? (value[1] - value[2]) / c
      : most == value.begin() + 1               ? 2 + (value[2] - value[0]) / c
                                                : 4 + (value[0] - value[1]) / c;
    EXPECT_NEAR(std::remainder(60 * sixths - degrees, 360), 0, 1e-3);
  }
}

TEST(ColorWheel, IsWhiteInTheMiddleAndPureOutside)
{
  Scene scene;
  scene.cutoff = Cutoff::ColorFilter;
  const std::vector<double> white{ 1, 1, 1 };
  EXPECT_EQ(lightOf(scene, 1e12, bent(0, 0)), white);
  EXPECT_EQ(lightOf(scene, 0, bent(0.1, -0.3)), white);
  EXPECT_EQ(levelOf(scene, 1e12), 1);
  EXPECT_EQ(lightOf(scene, 1e12, bent(1e-3, 0)), (std::vector<double>{ 1, 0, 0 }));
  EXPECT_EQ(lightOf(scene, 1e12, bent(-1e-3, 0)), (std::vector<double>{ 0, 1, 1 }));
}

std::shared_ptr<const RgbImage> image(int width, int height, std::vector<unsigned char> rgb)
{
  return std::make_shared<RgbImage>(RgbImage{ width, height, std::move(rgb) });
}

TEST(ColorImage, IsLookedUpBetweenItsEdges)
{
  Scene scene;
  scene.cutoff = Cutoff::ColorFilter;
  // Bottom row: black, red; top row: green, grey.
  scene.colorFilter = image(2, 2, { 0, 0, 0, 255, 0, 0, 0, 255, 0, 188, 188, 188 });
  const double grey = std::pow((188 / 255. + 0.055) / 1.055, 2.4);
  const auto at = [&](double u, double v) { return lightOf(scene, 100, bent(u / 100, v / 100)); };
  const auto expect = [&](double u, double v, double red, double green, double blue)
  {
    const std::vector<double> light = at(u, v);
    EXPECT_NEAR(light[0], red, 1e-6) << u << ' ' << v;
    EXPECT_NEAR(light[1], green, 1e-6) << u << ' ' << v;
    EXPECT_NEAR(light[2], blue, 1e-6) << u << ' ' << v;
  };
  // Pixel centres are at half way from the middle.
  expect(-0.5, -0.5, 0, 0, 0);
  expect(0.5, -0.5, 1, 0, 0);
  expect(-0.5, 0.5, 0, 1, 0);
  expect(0.5, 0.5, grey, grey, grey);
  // Outer halves of pixels, and all that is beyond.
  expect(-1, -0.9, 0, 0, 0);
  expect(1, -1, 1, 0, 0);
  expect(-7, 3, 0, 1, 0);
  expect(1e9, 1e9, grey, grey, grey);
  // In between, light is linear.
  expect(0, -0.5, 0.5, 0, 0);
  expect(0.25, -0.75, 0.75, 0, 0);
  expect(0, 0, (1 + grey) / 4, (1 + grey) / 4, grey / 4);
  EXPECT_NEAR(
    levelOf(scene, 3), 0.2126 * (1 + grey) / 4 + 0.7152 * (1 + grey) / 4 + 0.0722 * grey / 4, 1e-6);
  EXPECT_EQ(at(0, 0), lightOf(scene, 0, bent(0.4, 0.2)));
}

TEST(ColorImage, OfOnePixelIsThatColourEverywhere)
{
  Scene scene;
  scene.cutoff = Cutoff::ColorFilter;
  scene.colorFilter = image(1, 1, { 255, 0, 255 });
  for (const double k : { 0., 1., 1e12 })
  {
    EXPECT_EQ(lightOf(scene, k, bent(-0.3, 0.2)), (std::vector<double>{ 1, 0, 1 }));
  }
}

TEST(CutoffMaker, ForgetsNoImageAndKeepsNoOldOne)
{
  CutoffMaker maker;
  Scene scene;
  scene.cutoff = Cutoff::ColorFilter;
  const auto light = [&maker, &scene]
  {
    const Cutoffs cutoff = maker.cutoffOf(scene, 1, { 1 });
    return lightOf(std::get<ColorImage>(cutoff), bent(0, 0));
  };
  const std::array<double, 3> red{ 1, 0, 0 }, blue{ 0, 0, 1 };
  scene.colorFilter = image(1, 1, { 255, 0, 0 });
  EXPECT_EQ(light(), red);
  EXPECT_EQ(light(), red);
  Scene other;
  other.cutoff = Cutoff::GradedFilter;
  maker.cutoffOf(other, 1, { 1 }); // its table takes the place
  EXPECT_EQ(light(), red);
  scene.colorFilter = image(1, 1, { 0, 0, 255 });
  EXPECT_EQ(light(), blue);
}

TEST(Shadowgraph, CountsEveryRayInFull) { EXPECT_EQ(lightOf(Shadowgraph{}, 0.3, -0.1), 1); }

TEST(UndisturbedLevel, IsThatOfLightThatNothingBends)
{
  Scene scene;
  const auto level = [&scene](Cutoff cutoff)
  {
    scene.cutoff = cutoff;
    return levelOf(scene, 1000);
  };
  EXPECT_EQ(level(Cutoff::KnifeEdge), 0.5);
  EXPECT_EQ(level(Cutoff::Shadowgraph), 1);
  EXPECT_EQ(level(Cutoff::BrightField), 1);
  EXPECT_EQ(level(Cutoff::DarkField), 0);
  EXPECT_EQ(level(Cutoff::NumericalSchlieren), 1);
  EXPECT_EQ(level(Cutoff::PhaseContrast), 1);
  EXPECT_EQ(level(Cutoff::GradedFilter), 0.5);
  EXPECT_EQ(level(Cutoff::ColorFilter), 1);
  EXPECT_EQ(level(Cutoff::Interferogram), 1);
  scene.fringes.finite = true;
  scene.fringes.spacing = 3;
  EXPECT_EQ(level(Cutoff::Interferogram), 0.5);
  scene.cutoffOffset = 0.2;
  EXPECT_NEAR(level(Cutoff::KnifeEdge), 0.3, 1e-15);
}

TEST(Saturation, BeginsWhereMoreDeflectionChangesNothing)
{
  const auto saturates = [](const auto& kind, double u, double v) {
    return kind.saturates({ u, v });
  };
  const KnifeEdge knife = KnifeEdge::at(0, 1000, 0.1);
  EXPECT_FALSE(saturates(knife, 5.9e-4, 1));
  EXPECT_TRUE(saturates(knife, 6.1e-4, 0));
  EXPECT_FALSE(saturates(knife, -3.9e-4, 1));
  EXPECT_TRUE(saturates(knife, -4.1e-4, 0));
  EXPECT_FALSE(saturates(BrightField{ 1000 }, 7e-4, 7e-4));
  EXPECT_TRUE(saturates(BrightField{ 1000 }, 7.1e-4, 7.1e-4));
  EXPECT_FALSE(saturates(DarkField{ 1000 }, 7e-4, -7e-4));
  EXPECT_TRUE(saturates(DarkField{ 1000 }, 7.1e-4, -7.1e-4));
  EXPECT_TRUE(saturates(ColorWheel{ 1000, {} }, 0, -1.1e-3));
  EXPECT_FALSE(saturates(ColorWheel{ 1000, {} }, 0, -0.9e-3));
  EXPECT_TRUE(saturates(ColorImage{ 1000, 1, 1, {} }, 0, -1.1e-3));
  EXPECT_FALSE(saturates(ColorImage{ 1000, 1, 1, {} }, 0.9e-3, -0.9e-3));
  EXPECT_FALSE(saturates(Shadowgraph{}, 1, 1));
  EXPECT_FALSE(saturates(Interferogram{ 1e6, {} }, 1, 1));
}

TEST(Cutoffs, AnyDeflectionGivesLight)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double huge = std::numeric_limits<double>::max();
  Scene scene;
  for (const Cutoff cutoff : { Cutoff::KnifeEdge, Cutoff::Shadowgraph, Cutoff::BrightField,
         Cutoff::DarkField, Cutoff::GradedFilter, Cutoff::ColorFilter, Cutoff::Interferogram,
         Cutoff::NumericalSchlieren, Cutoff::PhaseContrast })
  {
    scene.cutoff = cutoff;
    for (const int variant : { 0, 1 })
    {
      scene.source.shape = variant % 2 == 0 ? SourceShape::Slit : SourceShape::Disc;
      scene.colorFilter =
        variant % 2 == 0 ? nullptr : image(2, 1, { 255, 255, 255, 255, 255, 255 });
      scene.fringes.finite = variant % 2 != 0;
      scene.fringes.spacing = 1e-3;
      for (const double k : { 0., 1e12, 1e300 })
      {
        for (const double eps : { 0., 1e-300, -1., 1e9, nan, HUGE_VAL, -huge })
        {
          const RayAtFilm ray{ { eps, -eps }, eps, { eps, eps } };
          for (const double light : lightOf(scene, k, ray))
          {
            EXPECT_TRUE(light >= 0 && light <= 1)
              << static_cast<int>(cutoff) << ' ' << variant << ' ' << k << ' ' << eps;
          }
        }
      }
    }
  }
}

/// A flow so weak that every ray lands in the middle of its pixel.
struct WeakBlob : testing::Test
{
  WeakBlob()
    : blob(cube(32, 1),
        [](double x, double y, double z)
        { return 1e-8 * std::exp(-(x * x + y * y + z * z) / 0.1); })
  {
    blob.field.lengthScale = 100;
    scene.device = Device::Cpu;
    scene.view.width = 50;
    scene.view.height = 40;
    scene.samplesPerPixel = 1;
  }

  /// Renders, and compares with a formula of the place on the film (from its middle, pixels), k eps and OPD: with its mean
  /// over each pixel that has two others on each side.
  Image expectImage(
    const std::function<double(double, double, const double (&)[2], double)>& intensity)
  {
    Image image = bench.render(blob.field, scene);
    std::vector<double> light;
    for (int row = 0; row < image.height; ++row)
    {
      for (int column = 0; column < image.width; ++column)
      {
        const auto pixel = static_cast<std::size_t>(row * image.width + column);
        const double bent[2] = { image.kScale * static_cast<double>(image.deflection[2 * pixel]),
          image.kScale * static_cast<double>(image.deflection[2 * pixel + 1]) };
        light.push_back(intensity(column - 0.5 * (image.width - 1), row - 0.5 * (image.height - 1),
          bent, image.opticalPathDifference[pixel]));
      }
    }
    const std::vector<double> expected = meansOver(image, light);
    for (int row = 2; row < image.height - 2; ++row)
    {
      for (int column = 2; column < image.width - 2; ++column)
      {
        const std::size_t pixel = pixelOf(image, column, row);
        EXPECT_NEAR(image.intensity[pixel], expected[pixel], 1e-4) << column << ' ' << row;
      }
    }
    return image;
  }

  /// Renders fringes, and compares with their means over pixels, in which the phase is quadratic. `carrier`: turns from a row
  /// to the next one.
  Image expectFringes(double carrier)
  {
    Image image = bench.render(blob.field, scene);
    const auto turns = [&](int column, int row)
    {
      return image.opticalPathDifference[pixelOf(image, column, row)] / 632.8e-9 +
        carrier * (row - 0.5 * (image.height - 1));
    };
    const auto contrast = [](double turnsPerPixel)
    { return turnsPerPixel == 0 ? 1 : std::sin(pi * turnsPerPixel) / (pi * turnsPerPixel); };
    for (int row = 2; row < image.height - 2; ++row)
    {
      for (int column = 2; column < image.width - 2; ++column)
      {
        const double here = turns(column, row);
        const double right = turns(column + 1, row) - here, left = turns(column - 1, row) - here;
        const double above = turns(column, row + 1) - here, below = turns(column, row - 1) - here;
        const double mean = here + (right + left + above + below) / 24;
        const double expected = 0.5 +
          0.5 * contrast(0.5 * (right - left)) * contrast(0.5 * (above - below)) *
            std::cos(2 * pi * mean);
        // The phase is linear in parts of cells, and is bent here by up to 0.05 turns from pixel to pixel.
        EXPECT_NEAR(image.intensity[pixelOf(image, column, row)], expected, 6e-3)
          << column << ' ' << row;
      }
    }
    return image;
  }

  SampledField<double> blob;
  Scene scene;
  Bench bench;
};

TEST_F(WeakBlob, IsSeenThroughEveryCutoffAndTracedOnce)
{
  const auto clamped = [](double light) { return std::clamp(light, 0., 1.); };
  const Image knife = expectImage(
    [&](double, double, const double(&bent)[2], double) { return clamped(0.5 + bent[0]); });
  EXPECT_EQ(knife.undisturbedLevel, 0.5);

  scene.cutoff = Cutoff::BrightField;
  const Image circular = expectImage([&](double, double, const double(&bent)[2], double)
    { return clamped(1 - std::hypot(bent[0], bent[1])); });
  EXPECT_EQ(circular.undisturbedLevel, 1);
  EXPECT_DOUBLE_EQ(circular.kScale, 2 * knife.kScale); // the same light at full scale

  scene.cutoff = Cutoff::DarkField;
  const Image complement = expectImage([&](double, double, const double(&bent)[2], double)
    { return clamped(std::hypot(bent[0], bent[1])); });
  EXPECT_EQ(complement.undisturbedLevel, 0);

  scene.cutoff = Cutoff::GradedFilter;
  scene.gradedFilter = { 1, 0, 1 };
  expectImage(
    [&](double, double, const double(&bent)[2], double) { return clamped(2 * std::abs(bent[0])); });

  scene.cutoff = Cutoff::Shadowgraph;
  scene.screenDistance = 0;
  EXPECT_EQ(expectImage([](double, double, const double(&)[2], double) { return 1; }).kScale, 0);

  scene.cutoff = Cutoff::Interferogram;
  const Image infinite = expectFringes(0);
  EXPECT_EQ(infinite.kScale, 0);
  EXPECT_LT(*std::min_element(infinite.intensity.begin(), infinite.intensity.end()), 0.1f);
  scene.fringes.finite = true;
  scene.fringes.spacing = 8 * infinite.frame.pixelSize;
  scene.fringes.angle = 90;
  expectFringes(1. / 8);

  scene.cutoff = Cutoff::ColorFilter;
  const Image wheel = bench.render(blob.field, scene);
  EXPECT_DOUBLE_EQ(wheel.kScale, 2 * knife.kScale);
  ASSERT_EQ(wheel.color.size(), 3 * wheel.intensity.size());
  EXPECT_EQ(wheel.undisturbedLevel, 1);
  EXPECT_EQ(bench.work().raysTraced, Bench().render(blob.field, scene).raysTraced);
}

TEST_F(WeakBlob, CountsSaturatedRays)
{
  scene.kScale = 1e8;
  for (const Cutoff cutoff :
    { Cutoff::KnifeEdge, Cutoff::DarkField, Cutoff::ColorFilter, Cutoff::Interferogram })
  {
    scene.cutoff = cutoff;
    const Image image = bench.render(blob.field, scene);
    int saturated = 0;
    for (std::size_t pixel = 0; pixel < image.intensity.size(); ++pixel)
    {
      const double u = image.kScale * static_cast<double>(image.deflection[2 * pixel]);
      const double v = image.kScale * static_cast<double>(image.deflection[2 * pixel + 1]);
      const bool isSaturated = cutoff == Cutoff::Interferogram ? false
        : cutoff == Cutoff::KnifeEdge                          ? std::abs(u) > 0.5
                                                               : std::hypot(u, v) > 1;
      saturated += isSaturated ? 1 : 0;
    }
    const double pixels = static_cast<double>(image.intensity.size());
    EXPECT_NEAR(image.saturatedFraction, saturated / pixels, 1e-9);
    EXPECT_EQ(image.saturatedFraction > 0.02, cutoff != Cutoff::Interferogram);
  }
}

} // namespace

} // namespace schlieren
