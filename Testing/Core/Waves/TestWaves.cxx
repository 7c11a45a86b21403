// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Waves behind a plane on which the field is given, against closed forms.
#include "WaveForms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace schlieren;
using namespace schlieren::waveforms;

namespace
{

/// 1, falling to 0 within `margin` points of both ends.
double taperOf(std::size_t i, std::size_t points, double margin)
{
  const double fromEnd = static_cast<double>(std::min(i, points - 1 - i)) + 0.5;
  const double t = fromEnd / margin;
  return t >= 1 ? 1 : 1 / (1 + std::exp(1 / t - 1 / (1 - t)));
}

double openFraction(double place, double spacing, double edge)
{
  return std::clamp((place - edge) / spacing + 0.5, 0., 1.);
}

} // namespace

TEST(Waves, SpectrumOfAShiftedPointIsAWave)
{
  ComplexField field(15, 8);
  field.row(3)[5] = 2;
  double worst = 0;
  filterSpectrum(
    field,
    [&](std::int64_t column, Complex* alongY)
    {
      for (std::int64_t row = 0; row < 8; ++row)
      {
        const double turns =
          static_cast<double>(5 * column) / 15 + static_cast<double>(3 * row) / 8;
        worst = std::max(worst, std::abs(alongY[row] - std::polar(2., -2 * pi * turns)));
      }
    },
    1);
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(std::abs(field.row(3)[5] - 2.), 1e-15);
  EXPECT_LT(std::abs(field.row(2)[5]), 1e-15);
}

TEST(Waves, HalfPlane)
{
  // The edge is where coverage is neither best nor worst: in the middle of a point's cell the error is twice as large.
  const double distance = 0.2, width = fresnelWidth(green, distance);
  for (const auto& [perWidth, error] : { std::pair(16, 4e-3), std::pair(32, 7e-4) })
  {
    const double spacing = width / perWidth, edge = 0.37 * spacing;
    const int margin = 8 * perWidth, points = 32 * perWidth + 1;
    const Numbers x = places(points, spacing);
    std::vector<Complex> field;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      field.push_back(openFraction(x[i], spacing, edge) * taperOf(i, x.size(), margin));
    }
    const Numbers light = propagated(field, spacing, distance, 2);
    Numbers seen, places, ofTruth;
    for (std::size_t i = static_cast<std::size_t>(margin);
         i + static_cast<std::size_t>(margin) < x.size(); ++i)
    {
      seen.push_back(light[i]);
      places.push_back(x[i] - edge);
    }
    EXPECT_LT(rms(seen, halfPlane(places, green, distance)), error) << perWidth;
    if (perWidth == 32)
    {
      const auto brightest = std::max_element(seen.begin(), seen.end());
      EXPECT_NEAR(*brightest, 1.370, 2e-3);
      EXPECT_NEAR(
        places[static_cast<std::size_t>(brightest - seen.begin())], 0.861 * width, spacing);
      const auto atEdge = std::lower_bound(places.begin(), places.end(), 0.) - places.begin();
      const double fraction = -places[static_cast<std::size_t>(atEdge - 1)] / spacing;
      EXPECT_NEAR((1 - fraction) * seen[static_cast<std::size_t>(atEdge - 1)] +
          fraction * seen[static_cast<std::size_t>(atEdge)],
        0.25, 2e-3);
    }
  }
}

TEST(Waves, SpotOfArago)
{
  const double distance = 0.5, radius = 1e-3, window = 8e-3;
  const std::int64_t points = 512, padded = 1024, before = 256;
  const double spacing = window / static_cast<double>(points);
  constexpr int finer = 8;
  ComplexField field(padded, padded);
  for (std::int64_t j = 0; j < points; ++j)
  {
    for (std::int64_t i = 0; i < points; ++i)
    {
      int covered = 0;
      for (int sample = 0; sample < finer * finer; ++sample)
      {
        const double x =
          (static_cast<double>(i - points / 2) + (sample % finer + 0.5) / finer) * spacing;
        const double y =
          (static_cast<double>(j - points / 2) + (sample / finer + 0.5) / finer) * spacing;
        covered += std::hypot(x, y) < radius ? 1 : 0;
      }
      field.row(before + j)[before + i] = -static_cast<double>(covered) / (finer * finer);
    }
  }
  propagate(field, { green, distance, spacing }, 0);
  Numbers seen, exact;
  for (std::int64_t i = 0; i < points; ++i)
  {
    const double x = (static_cast<double>(i - points / 2) + 0.5) * spacing;
    seen.push_back(std::norm(1. + field.row(before + points / 2)[before + i]));
    exact.push_back(disc(std::hypot(x, 0.5 * spacing), radius, green, distance));
  }
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    const double radiusOfRing = std::abs(static_cast<double>(i) - 255.5);
    sum += radiusOfRing * std::pow(seen[i] - exact[i], 2);
    area += radiusOfRing;
  }
  EXPECT_LT(std::sqrt(sum / area), 1.9e-3);
  EXPECT_NEAR(seen[points / 2], exact[points / 2], 0.0125);
  EXPECT_NEAR(exact[points / 2], 0.966, 1e-3);
}

TEST(Waves, GaussianBeamKeepsItsFormAndItsEnergy)
{
  const double waist = 3e-4, distance = 0.5, rayleigh = pi * waist * waist / green;
  const double wider = std::sqrt(1 + std::pow(distance / rayleigh, 2));
  const std::int64_t points = 64;
  const double spacing = 8 * waist / static_cast<double>(points);
  const Numbers x = places(points, spacing);
  ComplexField field(points, points);
  double before = 0, after = 0, sum = 0;
  for (std::int64_t j = 0; j < points; ++j)
  {
    for (std::int64_t i = 0; i < points; ++i)
    {
      const double r2 =
        std::pow(x[static_cast<std::size_t>(i)], 2) + std::pow(x[static_cast<std::size_t>(j)], 2);
      field.row(j)[i] = std::exp(-r2 / (waist * waist));
      before += std::norm(field.row(j)[i]);
    }
  }
  propagate(field, { green, distance, spacing }, 0);
  for (std::int64_t j = 0; j < points; ++j)
  {
    for (std::int64_t i = 0; i < points; ++i)
    {
      const double r2 =
        std::pow(x[static_cast<std::size_t>(i)], 2) + std::pow(x[static_cast<std::size_t>(j)], 2);
      const double exact = std::exp(-2 * r2 / std::pow(waist * wider, 2)) / (wider * wider);
      sum += std::pow(std::norm(field.row(j)[i]) - exact, 2);
      after += std::norm(field.row(j)[i]);
    }
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(points * points)), 1.3e-8);
  EXPECT_NEAR(after, before, 1e-12 * before);
}
