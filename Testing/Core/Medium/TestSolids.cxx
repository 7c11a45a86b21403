// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies in the gas: they block light and bend none.
#include "Fields.h"
#include "Medium/Samples/Solids.h"

#include <algorithm>
#include <limits>
#include <random>

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
    for (const Interpolation interpolation : allInterpolations)
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
/// add, and has little else: over the image the error is that of rays that graze the edge of the data.
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

/// A plane wall, aslant: three layers behind it, of which splines in the gas have coefficients and what these depend on,
/// continue what is linear; farther on nothing is beyond them.
TEST(FillSolids, ContinuesLinearFieldsAsFarAsSplinesReach)
{
  constexpr int n = 24, reach = 3;
  const auto fieldAt = [](int i, int j, int k) { return 1 + 2. * i - 0.5 * j + 0.25 * k; };
  const auto depthOf = [](int i, int j) { return i + j / 4 - 8; }; // layers behind the wall
  std::vector<double> values;
  std::vector<unsigned char> isKnown;
  double lowest = 1e9, highest = -1e9;
  for (int at = 0; at < n * n * n; ++at)
  {
    const int i = at % n, j = at / n % n, k = at / n / n;
    isKnown.push_back(depthOf(i, j) <= 0 ? 1 : 0);
    values.push_back(isKnown.back() ? fieldAt(i, j, k) : std::nan(""));
    if (depthOf(i, j) <= reach)
    {
      lowest = std::min(lowest, fieldAt(i, j, k));
      highest = std::max(highest, fieldAt(i, j, k));
    }
  }
  continueValues(values, n, n, isKnown);
  for (int at = 0; at < n * n * n; ++at)
  {
    const int i = at % n, j = at / n % n, k = at / n / n;
    if (depthOf(i, j) <= reach)
    {
      EXPECT_NEAR(values[static_cast<std::size_t>(at)], fieldAt(i, j, k), 1e-12);
    }
    EXPECT_GE(values[static_cast<std::size_t>(at)], lowest - 1e-9);
    EXPECT_LE(values[static_cast<std::size_t>(at)], highest + 1e-9);
  }
}

/// Rows, and layers, in which nothing is known.
TEST(FillSolids, GivesValuesToAllOfABrick)
{
  constexpr int n = 20;
  std::vector<double> values(n * n * n, std::nan(""));
  std::vector<unsigned char> isKnown(values.size(), 0);
  for (const int known : { 0, (7 * n + 7) * n + 7 })
  {
    values[static_cast<std::size_t>(known)] = known > 0 ? 2 : 1;
    isKnown[static_cast<std::size_t>(known)] = 1;
  }
  continueValues(values, n, n, isKnown);
  for (const double value : values)
  {
    EXPECT_GE(value, 1);
    EXPECT_LE(value, 2);
  }
  EXPECT_EQ(values.front(), 1);
  EXPECT_EQ(values.back(), 2);
}

/// Point by point, what fillEmpty does word by word.
std::vector<double> filledPointByPoint(
  const std::array<std::int64_t, 3>& n, std::vector<double> values, std::vector<bool> empty)
{
  const auto indexOf = [&](std::int64_t i, std::int64_t j, std::int64_t k)
  { return static_cast<std::size_t>((k * n[1] + j) * n[0] + i); };
  const auto isInside = [](std::int64_t i, std::int64_t count) { return i >= 0 && i < count; };
  for (bool changes = true; changes;)
  {
    changes = false;
    const std::vector<bool> before = empty;
    for (std::int64_t at = 0; at < n[0] * n[1] * n[2]; ++at)
    {
      double sum = 0;
      int count = 0;
      for (std::int64_t near = 0; near < 27; ++near)
      {
        const std::int64_t i = at % n[0] + near % 3 - 1;
        const std::int64_t j = at / n[0] % n[1] + near / 3 % 3 - 1;
        const std::int64_t k = at / n[0] / n[1] + near / 9 - 1;
        if (isInside(i, n[0]) && isInside(j, n[1]) && isInside(k, n[2]) &&
          !before[indexOf(i, j, k)])
        {
          sum += values[indexOf(i, j, k)];
          ++count;
        }
      }
      if (before[static_cast<std::size_t>(at)] && count > 0)
      {
        values[static_cast<std::size_t>(at)] = sum / count;
        empty[static_cast<std::size_t>(at)] = false;
        changes = true;
      }
    }
  }
  return values;
}

TEST(FillSolids, TakesTheMeanOfTheLayerOutside)
{
  std::mt19937 random(9);
  std::uniform_real_distribution<double> any(1, 2);
  // Rows of less and more than a word, and of whole words.
  for (const std::array<std::int64_t, 3>& n : { std::array<std::int64_t, 3>{ 2, 2, 2 },
         { 31, 3, 4 }, { 63, 4, 3 }, { 64, 5, 2 }, { 65, 3, 9 }, { 128, 3, 3 }, { 193, 2, 5 } })
  {
    for (const double fraction : { 0.02, 0.5, 0.99 })
    {
      std::vector<double> values;
      std::vector<bool> solid;
      PointMask mask(n);
      for (std::int64_t at = 0; at < n[0] * n[1] * n[2]; ++at)
      {
        const std::int64_t i = at % n[0];
        values.push_back(any(random));
        solid.push_back(at > 0 && any(random) - 1 < fraction);
        if (!solid.back())
        {
          mask.row(at / n[0] % n[1], at / n[0] / n[1])[i >> 6] &= ~(std::uint64_t{ 1 } << (i & 63));
        }
      }
      const std::vector<double> expected = filledPointByPoint(n, values, solid);
      for (const int threads : { 1, 3 })
      {
        PaddedVolume<double> volume(n);
        std::fill(volume.samples.begin(), volume.samples.end(), 1e9); // ghosts are not looked at
        for (std::int64_t at = 0; at < n[0] * n[1] * n[2]; ++at)
        {
          volume.at(at % n[0], at / n[0] % n[1], at / n[0] / n[1]) =
            values[static_cast<std::size_t>(at)];
        }
        const std::vector<std::uint32_t> bits = bitsPerSample(volume, mask);
        fillEmpty(volume, mask, threads);
        std::size_t solids = 0;
        for (std::int64_t at = 0; at < n[0] * n[1] * n[2]; ++at)
        {
          const std::int64_t index = volume.index(at % n[0], at / n[0] % n[1], at / n[0] / n[1]);
          const auto point = static_cast<std::size_t>(at);
          EXPECT_NEAR(volume.samples[static_cast<std::size_t>(index)], expected[point], 1e-14);
          const bool bit = ((bits[static_cast<std::size_t>(index >> 5)] >> (index & 31)) & 1u) != 0;
          EXPECT_EQ(bit, solid[point]);
          solids += solid[point] ? 1 : 0;
        }
        std::size_t ones = 0;
        for (std::uint32_t word : bits)
        {
          for (; word != 0; word &= word - 1)
          {
            ++ones;
          }
        }
        EXPECT_EQ(ones, solids);
      }
    }
  }
}

} // namespace

} // namespace schlieren
