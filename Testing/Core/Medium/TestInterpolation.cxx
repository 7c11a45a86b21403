// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fields.h"
#include "Medium/Medium.h"
#include "Medium/Samples/Interpolation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

template <class Real>
Sample<Real> sampleAt(
  const Medium<Real>& medium, Interpolation interpolation, double x, double y, double z)
{
  return visitScheme(interpolation,
    [&](auto scheme)
    {
      return interpolate<decltype(scheme)>(
        medium.view(), { static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z) });
    });
}

Grid box(std::int64_t nx, std::int64_t ny, std::int64_t nz)
{
  Grid grid;
  grid.dimensions = { nx, ny, nz };
  return grid;
}

template <class Real>
Medium<Real> mediumOf(const Grid& grid, Interpolation interpolation,
  const std::function<double(double, double, double)>& refractivity)
{
  SampledField<Real> field(grid, refractivity);
  field.field.ambient = 0;
  return buildMedium<Real>(field.field, interpolation, 1);
}

const Grid someBoxes[] = { box(2, 2, 2), box(2, 9, 2), box(3, 2, 5), box(3, 3, 3), box(4, 3, 2),
  box(2, 5, 4), box(9, 8, 7), box(40, 3, 4) };

class EachInterpolation : public testing::TestWithParam<Interpolation>
{
};
INSTANTIATE_TEST_SUITE_P(Schemes, EachInterpolation, testing::ValuesIn(allInterpolations),
  [](const auto& scheme) { return name(scheme.param); });

template <class Real>
void expectSamples(const Grid& grid, Interpolation interpolation)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.1, 0.1);
  SampledField<Real> field(grid, [&](double, double, double) { return any(random); });
  field.field.ambient = 0;
  const Medium<Real> medium = buildMedium<Real>(field.field, interpolation, 1);
  std::size_t at = 0;
  for (int k = 0; k < grid.dimensions[2]; ++k)
  {
    for (int j = 0; j < grid.dimensions[1]; ++j)
    {
      for (int i = 0; i < grid.dimensions[0]; ++i, ++at)
      {
        EXPECT_NEAR(sampleAt(medium, interpolation, i, j, k).value, field.samples[at],
          10 * std::numeric_limits<Real>::epsilon());
      }
    }
  }
}

TEST_P(EachInterpolation, PassesThroughTheSamples)
{
  for (const Grid& grid : someBoxes)
  {
    SCOPED_TRACE(testing::PrintToString(grid.dimensions));
    expectSamples<double>(grid, GetParam());
    expectSamples<float>(grid, GetParam());
  }
}

/// A sum of c x^a y^b z^c.
struct Polynomial
{
  struct Term
  {
    double factor;
    int powers[3];
  };
  std::vector<Term> terms;

  /// All terms of a total degree up to `degree` of which the grid has points enough along each axis.
  Polynomial(int degree, const Grid& grid)
  {
    const auto most = [&](std::size_t axis)
    { return std::min(degree, static_cast<int>(grid.dimensions[axis] - 1)); };
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int a = 0; a <= most(0); ++a)
    {
      for (int b = 0; b <= most(1); ++b)
      {
        for (int c = 0; c <= most(2); ++c)
        {
          if (a + b + c <= degree)
          {
            terms.push_back({ 0.01 * any(random) * std::pow(0.05, a + b + c), { a, b, c } });
          }
        }
      }
    }
  }

  Sample<double> at(double x, double y, double z) const
  {
    Sample<double> sum{ 0, { 0, 0, 0 } };
    for (const Term& term : terms)
    {
      const auto [a, b, c] = term.powers;
      const double xs = std::pow(x, a), ys = std::pow(y, b), zs = std::pow(z, c);
      const auto derivative = [](double at, int power)
      { return power == 0 ? 0 : power * std::pow(at, power - 1); };
      sum.value += term.factor * xs * ys * zs;
      sum.gradient += term.factor *
        Vec3<double>{ derivative(x, a) * ys * zs, xs * derivative(y, b) * zs,
          xs * ys * derivative(z, c) };
    }
    return sum;
  }
};

/// Up to the faces: nothing is mirrored or flattened there.
void expectReproduced(Interpolation interpolation, int degree)
{
  for (const Grid& grid : someBoxes)
  {
    SCOPED_TRACE(testing::PrintToString(grid.dimensions));
    const Polynomial polynomial(degree, grid);
    const Medium<double> medium = mediumOf<double>(grid, interpolation,
      [&](double x, double y, double z) { return polynomial.at(x, y, z).value; });
    const auto& n = grid.dimensions;
    for (int i = 0; i <= 4 * (n[0] - 1); ++i)
    {
      for (int j = 0; j <= 3 * (n[1] - 1); ++j)
      {
        for (int k = 0; k <= 5 * (n[2] - 1); ++k)
        {
          const double x = i / 4., y = j / 3., z = k / 5.;
          const Sample<double> sample = sampleAt(medium, interpolation, x, y, z);
          const Sample<double> exact = polynomial.at(x, y, z);
          constexpr double tolerance = 1e-14;
          EXPECT_NEAR(sample.value, exact.value, tolerance);
          EXPECT_NEAR(sample.gradient.x, exact.gradient.x, tolerance);
          EXPECT_NEAR(sample.gradient.y, exact.gradient.y, tolerance);
          EXPECT_NEAR(sample.gradient.z, exact.gradient.z, tolerance);
        }
      }
    }
  }
}

TEST(QuadraticInterpolation, ReproducesParabolasEverywhere)
{
  expectReproduced(Interpolation::Quadratic, 2);
}

TEST(CubicInterpolation, ReproducesCubicsEverywhere) { expectReproduced(Interpolation::Cubic, 3); }

TEST_P(EachInterpolation, IsContinuousAcrossCells)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.1, 0.1);
  const Medium<double> medium =
    mediumOf<double>(box(8, 8, 8), GetParam(), [&](double, double, double) { return any(random); });
  // Along x, y, z in turn, at the same places across.
  const auto along = [&](int axis, double at)
  {
    double position[3] = { 3.3, 4.1, 2.7 };
    position[axis] = at;
    return sampleAt(medium, GetParam(), position[0], position[1], position[2]);
  };
  const auto bend = [&](int axis, double from, double to)
  { return (1 / (to - from)) * (along(axis, to).gradient - along(axis, from).gradient); };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (double edge = 0.5; edge < 7; edge += 0.5)
    {
      const Sample<double> below = along(axis, edge - 1e-9);
      const Sample<double> above = along(axis, edge + 1e-9);
      EXPECT_NEAR(below.value, above.value, 1e-8);
      EXPECT_LT(length(above.gradient - below.gradient), 1e-8);
      const double kink = length(bend(axis, edge - 2e-6, edge) - bend(axis, edge, edge + 2e-6));
      if (GetParam() == Interpolation::Cubic)
      {
        EXPECT_LT(kink, 1e-4);
      }
      else if (GetParam() == Interpolation::Quadratic && (edge == 1.5 || edge == 3.5))
      {
        EXPECT_GT(kink, 1e-4);
      }
    }
  }
}

/// Largest errors of value and derivative of a sine with n points over two periods, none of whose
/// derivatives is zero on the faces.
std::pair<double, double> sineErrors(int n, Interpolation interpolation)
{
  const double wave = 4 * pi / (n - 1);
  constexpr double phase = 0.7;
  const Medium<double> medium = mediumOf<double>(box(n, 4, 4), interpolation,
    [&](double x, double, double) { return 0.1 * std::sin(wave * x + phase); });
  double value = 0, slope = 0;
  for (double x = 0; x <= n - 1; x += 0.0371)
  {
    const Sample<double> sample = sampleAt(medium, interpolation, x, 1.5, 1.2);
    value = std::max(value, std::abs(sample.value - 0.1 * std::sin(wave * x + phase)));
    slope = std::max(slope, std::abs(sample.gradient.x / wave - 0.1 * std::cos(wave * x + phase)));
  }
  return { value, slope };
}

TEST_P(EachInterpolation, ConvergesAtItsOrder)
{
  struct Orders
  {
    double value, gradient;
  };
  const Orders expected = GetParam() == Interpolation::Quadratic ? Orders{ 3, 2 } : Orders{ 4, 3 };
  const auto coarse = sineErrors(65, GetParam());
  const auto fine = sineErrors(129, GetParam());
  EXPECT_NEAR(std::log2(coarse.first / fine.first), expected.value, 0.15);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), expected.gradient, 0.15);
}

TEST_P(EachInterpolation, IsTheSameInSinglePrecision)
{
  const auto wave = [](double x, double y, double z)
  { return 0.1 * std::sin(x + 0.8 * y - 0.6 * z); };
  std::mt19937 random(17);
  std::uniform_real_distribution<double> where(0, 1);
  for (const Grid& grid : someBoxes)
  {
    const Medium<float> singles = mediumOf<float>(grid, GetParam(), wave);
    const Medium<double> doubles = mediumOf<double>(grid, GetParam(), wave);
    const Vec3<double> last = doubles.view().last;
    for (int i = 0; i < 1000; ++i)
    {
      // Positions that both can hold.
      const auto within = [&](double end) { return static_cast<float>(end * where(random)); };
      const float x = within(last.x), y = within(last.y), z = within(last.z);
      const auto single = sampleAt(singles, GetParam(), x, y, z);
      const Sample<double> sample = sampleAt(doubles, GetParam(), x, y, z);
      EXPECT_NEAR(single.value, sample.value, 5e-7);
      EXPECT_NEAR(single.gradient.x, sample.gradient.x, 5e-7);
      EXPECT_NEAR(single.gradient.y, sample.gradient.y, 5e-7);
      EXPECT_NEAR(single.gradient.z, sample.gradient.z, 5e-7);
    }
  }
}

TEST(Medium, AmbientIsTheMedianOfTheBoundary)
{
  // A jet leaves through one face; the gas around it decides.
  const SampledField<float> field(box(11, 11, 11),
    [](double x, double y, double) { return std::hypot(x - 5, y - 5) < 3 ? 9e-4 : 2.7e-4; });
  EXPECT_FLOAT_EQ(
    static_cast<float>(buildMedium<float>(field.field, Interpolation::Quadratic, 1).ambient),
    2.7e-4f);
}

/// The tails of a blob's coefficients end in zeros, not in denormal numbers.
TEST(Medium, HoldsNoDenormals)
{
  const SampledField<float> field(
    box(200, 6, 6), [](double x, double, double) { return x > 99 && x < 101 ? 1e-4 : 0; });
  for (const Interpolation interpolation : allInterpolations)
  {
    const Medium<float> medium = buildMedium<float>(field.field, interpolation, 1);
    int zeros = 0;
    for (const float sample : medium.volume.samples)
    {
      EXPECT_TRUE(sample == 0 || std::abs(sample) > 1e-30f);
      zeros += sample == 0 ? 1 : 0;
    }
    EXPECT_GT(zeros, 1000);
  }
}

TEST(Medium, KnowsTheRangeOfItsGas)
{
  SampledField<float> field(
    box(4, 5, 6), [](double x, double, double) { return x == 0 ? 1e-4 : 5e-4; });
  field.samples[7] = std::numeric_limits<float>::infinity();
  field.samples[8] = 9;
  std::vector<unsigned char> valid(field.samples.size(), 1);
  valid[8] = 0;
  field.field.valid = valid.data();
  field.field.ambient = 3e-4;
  for (const Interpolation interpolation : allInterpolations)
  {
    EXPECT_NEAR(
      buildMedium<float>(field.field, interpolation, 1).rangeOfNu, 4e-4 / (1 + 3e-4), 1e-10);
  }
}

/// What packs of rays load at once may reach past the last sample.
TEST(Medium, EndsInZeros)
{
  const auto samples = mediumOf<float>(box(4, 5, 6), Interpolation::Quadratic,
    [](double, double, double)
    { return 1; }).volume.samples;
  ASSERT_EQ(samples.size(), 6 * 7 * 8 + 4);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    EXPECT_NEAR(samples[i], i < 6 * 7 * 8 ? 1 : 0, i < 6 * 7 * 8 ? 1e-6 : 0);
  }
}

TEST_P(EachInterpolation, KeepsToTheBoundsOfTheMedium)
{
  std::mt19937 random(13);
  std::uniform_real_distribution<double> any(-1, 1), where(0, 1);
  for (const Grid& grid : someBoxes)
  {
    const bool isLarge = grid.dimensions[0] == 9; // no face determines the bounds
    const double noise = isLarge ? 1e-3 : 0.1;
    const Medium<double> medium = mediumOf<double>(grid, GetParam(),
      [&](double x, double y, double z)
      { return std::sin(x + 0.8 * y - 0.6 * z) * 0.1 + noise * any(random); });
    const Vec3<double> last = medium.view().last;
    Sample<double> most{ 0, { 0, 0, 0 } };
    for (int i = 0; i < 5000; ++i)
    {
      const Sample<double> sample = sampleAt(
        medium, GetParam(), last.x * where(random), last.y * where(random), last.z * where(random));
      most.value = std::max(most.value, std::abs(sample.value));
      most.gradient.x = std::max(most.gradient.x, std::abs(sample.gradient.x));
      most.gradient.y = std::max(most.gradient.y, std::abs(sample.gradient.y));
      most.gradient.z = std::max(most.gradient.z, std::abs(sample.gradient.z));
    }
    constexpr double rounding = 1e-15;
    EXPECT_LE(most.value, medium.largestNu + rounding);
    EXPECT_LE(most.gradient.x, medium.slope.x + rounding);
    EXPECT_LE(most.gradient.y, medium.slope.y + rounding);
    EXPECT_LE(most.gradient.z, medium.slope.z + rounding);
    if (isLarge)
    {
      EXPECT_GT(most.value, 0.1 * medium.largestNu);
      EXPECT_GT(most.gradient.x, 0.1 * medium.slope.x);
      EXPECT_GT(most.gradient.y, 0.1 * medium.slope.y);
      EXPECT_GT(most.gradient.z, 0.1 * medium.slope.z);
    }
  }
}

} // namespace

} // namespace schlieren
