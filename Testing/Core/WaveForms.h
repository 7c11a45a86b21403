// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Closed forms of diffraction. Lengths are metres.
#pragma once

#include "Math/Units.h"
#include "Waves/ScreenWaves.h"

#include <cmath>
#include <complex>
#include <functional>
#include <vector>

namespace schlieren::waveforms
{

using Complex = std::complex<double>;
using Numbers = std::vector<double>;

constexpr double green = 532e-9;

/// Simpson's rule with an even number of intervals.
template <class Function>
auto integral(const Function& f, double from, double to, int intervals)
{
  const double h = (to - from) / intervals;
  auto sum = f(from) + f(to);
  for (int i = 1; i < intervals; ++i)
  {
    sum += (i % 2 == 1 ? 4. : 2.) * f(from + i * h);
  }
  return sum * (h / 3);
}

/// C(x) + i S(x) of ascending places.
inline std::vector<Complex> fresnelIntegrals(const Numbers& places)
{
  const auto f = [](double t) { return std::polar(1., pi / 2 * t * t); };
  std::vector<Complex> values;
  double before = 0;
  Complex sum = 0;
  for (const double x : places)
  {
    const int intervals = 2 *
      static_cast<int>(
        std::ceil(10 * std::abs(x - before) * (1 + std::abs(x) + std::abs(before))) + 4);
    sum += integral(f, before, x, intervals);
    values.push_back(sum);
    before = x;
  }
  return values;
}

/// Behind an opaque half plane x < 0 (Born and Wolf, 8.7).
inline Numbers halfPlane(const Numbers& places, double wavelength, double distance)
{
  Numbers scaled;
  for (const double x : places)
  {
    scaled.push_back(x * std::sqrt(2 / (wavelength * distance)));
  }
  Numbers light;
  for (const Complex& value : fresnelIntegrals(scaled))
  {
    light.push_back(0.5 * std::norm(value + Complex(0.5, 0.5)));
  }
  return light;
}

/// Behind an opaque disc, at a distance from its axis (Fresnel's integral).
inline double disc(double fromAxis, double radius, double wavelength, double distance)
{
  const double k = 2 * pi / wavelength;
  const auto f = [&](double q)
  {
    return std::polar(
      q * std::cyl_bessel_j(0., k * q * fromAxis / distance), k * q * q / (2 * distance));
  };
  const Complex behind = integral(f, 0, radius, 2000) * k / Complex(0, distance) *
    std::polar(1., k * fromAxis * fromAxis / (2 * distance));
  return std::norm(1. - behind);
}

/// The field behind exp(i phase exp(-x^2 / size^2)): a sum of Gaussians, each of which stays one.
inline Complex fieldBehindColumn(
  double x, double size, double phase, double distance, double wavelength = green)
{
  const Complex grows(0, distance * wavelength / pi); // 2 i D / k
  Complex sum = 1, factor = 1;
  for (int n = 1; n < 40; ++n)
  {
    factor *= Complex(0, phase) / static_cast<double>(n);
    const double square = size * size / n;
    sum += factor * std::sqrt(square / (square + grows)) * std::exp(-x * x / (square + grows));
  }
  return sum;
}

/// Dawson's integral exp(-x^2) int_0^x exp(t^2) dt.
inline double dawson(double x)
{
  return integral([&](double t) { return std::exp(t * t - x * x); }, 0, x, 400);
}

/// Places of points that are `spacing` apart, with 0 in their middle.
inline Numbers places(std::int64_t points, double spacing)
{
  Numbers x;
  for (std::int64_t i = 0; i < points; ++i)
  {
    x.push_back((static_cast<double>(i) - 0.5 * static_cast<double>(points - 1)) * spacing);
  }
  return x;
}

inline double rms(const Numbers& a, const Numbers& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// The light behind a field along x, with nothing beyond it. `padding`: times its length.
inline Numbers propagated(
  const std::vector<Complex>& of, double spacing, double distance, double padding)
{
  const auto points = static_cast<std::int64_t>(of.size());
  ComplexField field(
    fastLength(static_cast<std::int64_t>(std::ceil(static_cast<double>(points) * padding))), 1);
  const std::int64_t before = (field.columns - points) / 2;
  for (std::size_t i = 0; i < of.size(); ++i)
  {
    field.row(0)[before + static_cast<std::int64_t>(i)] = of[i];
  }
  propagate(field, { green, distance, spacing }, 1);
  Numbers light;
  for (std::size_t i = 0; i < of.size(); ++i)
  {
    light.push_back(std::norm(field.row(0)[before + static_cast<std::int64_t>(i)]));
  }
  return light;
}

} // namespace schlieren::waveforms
