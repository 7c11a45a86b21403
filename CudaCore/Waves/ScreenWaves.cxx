// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/ScreenWaves.h"

#include "Math/Units.h"
#include "Waves/WavePixels.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace schlieren
{

namespace
{

using Value = ComplexField::Value;

constexpr double marginInFresnelWidths = 8;

/// Over how many of the rays beside the image light falls to undisturbed light. Those next to it may be bent into it.
double taperOf(double border, double fresnelWidth)
{
  return std::clamp(marginInFresnelWidths * fresnelWidth, 0.5 * border, border);
}

double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }

/// The transform of a disc by its area, at a frequency times its diameter.
double airy(double x) { return x == 0 ? 1 : 2 * std::cyl_bessel_j(1., pi * x) / (pi * x); }

/// Blurs light by the source's image, of which each place of a screen receives the light of all points.
bool blur(
  WavePixels& pixels, const Screen& screen, double pixel, double distance, const Monitor& monitor)
{
  const double width = std::abs(distance) * screen.source.width;
  const double length = std::abs(distance) * screen.source.length;
  const double cosine = std::cos(screen.sourceAngle * radiansPerDegree);
  const double sine = std::sin(screen.sourceAngle * radiansPerDegree);
  const auto around = static_cast<std::int64_t>(std::ceil(std::max(width, length) / pixel));
  ComplexField field(fastLength(pixels.columns + around), fastLength(pixels.rows + around));
  for (std::int64_t row = 0; row < pixels.rows; ++row)
  {
    const double* from = pixels.light.data() + row * pixels.columns;
    std::transform(from, from + pixels.columns, field.row(row),
      [](double light) { return Value(light - 1, 0); });
  }
  const auto filter = [&](std::int64_t column, Value* alongY)
  {
    const double fx = frequencyOf(column, field.columns, pixel);
    for (std::int64_t row = 0; row < field.rows; ++row)
    {
      const double fy = frequencyOf(row, field.rows, pixel);
      alongY[row] *= screen.source.shape == SourceShape::Disc
        ? airy(std::hypot(fx, fy) * width)
        : sinc((cosine * fx + sine * fy) * width) * sinc((cosine * fy - sine * fx) * length);
    }
  };
  if (!filterSpectrum(field, filter, screen.threads, monitor))
  {
    return false;
  }
  for (std::int64_t row = 0; row < pixels.rows; ++row)
  {
    std::transform(field.row(row), field.row(row) + pixels.columns,
      pixels.light.begin() + row * pixels.columns,
      [](const Value& value) { return 1 + value.real(); });
  }
  return true;
}

double largestDeflection(const LightAtExit& light)
{
  double largest = 0;
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    largest = std::max(largest, std::hypot(light.deflection[0][ray], light.deflection[1][ray]));
  }
  return largest;
}

} // namespace

double fresnelWidth(double wavelength, double distance)
{
  return std::sqrt(wavelength * std::abs(distance));
}

double blurOnScreen(const LightSource& source, double pixel, double distance)
{
  const double image = source.shape == SourceShape::Point ? 0 : std::abs(distance) * source.width;
  return std::hypot(pixel, image);
}

std::int64_t pixelsAround(const LightAtExit& light, const Screen& screen)
{
  return (light.columns / screen.raysPerPixel - screen.width) / 2;
}

double marginOnScreen(
  const Screen& screen, double wavelengthInMedium, double distance, double largestDeflection)
{
  const double source = screen.source.shape == SourceShape::Point
    ? 0
    : 0.5 * std::max(screen.source.width, screen.source.length);
  return marginInFresnelWidths * fresnelWidth(wavelengthInMedium, distance) +
    std::abs(distance) * (largestDeflection + source);
}

SpaceFilter::SpaceFilter(const FreeSpace& space, const ComplexField& field)
  : space_(space)
{
  const std::int64_t points[2] = { field.columns, field.rows };
  for (int axis = 0; axis < 2; ++axis)
  {
    const double length = static_cast<double>(points[axis]) * space.spacing;
    limits_[axis] = 1 / (space.wavelength * std::hypot(2 * space.distance / length, 1));
  }
}

double SpaceFilter::turns(double fx, double fy) const
{
  // By which the frequency lags behind light along the normal, without losing small angles.
  const double wavelength = space_.wavelength, square = fx * fx + fy * fy;
  const double cosine = std::sqrt(std::max(0., 1 - wavelength * wavelength * square));
  return -space_.distance * wavelength * square / (1 + cosine);
}

std::complex<double> SpaceFilter::at(double fx, double fy) const
{
  const double f[2] = { fx + space_.carrier[0], fy + space_.carrier[1] };
  const double square = f[0] * f[0] + f[1] * f[1];
  if (std::abs(f[0]) > limits_[0] || std::abs(f[1]) > limits_[1] ||
    space_.wavelength * space_.wavelength * square >= 1)
  {
    return 0;
  }
  const double phase = 2 * pi * (turns(f[0], f[1]) - turnsOfCarrier());
  return { std::cos(phase), std::sin(phase) };
}

SpectrumFilter filterOf(const FreeSpace& space, const ComplexField& field)
{
  return [ofSpace = SpaceFilter(space, field), columns = field.columns, rows = field.rows,
           spacing = space.spacing](std::int64_t column, Value* alongY)
  {
    const double fx = frequencyOf(column, columns, spacing);
    for (std::int64_t row = 0; row < rows; ++row)
    {
      alongY[row] *= ofSpace.at(fx, frequencyOf(row, rows, spacing));
    }
  };
}

bool propagate(ComplexField& field, const FreeSpace& space, int threads, const Monitor& monitor)
{
  return filterSpectrum(field, filterOf(space, field), threads, monitor);
}

double parallelDistance(const Screen& screen, double plane)
{
  const double distance = screen.distance + plane;
  if (!screen.pointSource)
  {
    return distance;
  }
  const PointSource& source = *screen.pointSource;
  return distance /
    (source.magnificationAt(source.toExit - plane) *
      source.magnificationAt(source.toExit + screen.distance));
}

FieldBeforeScreen fieldBefore(const LightAtExit& ofRays, const Screen& screen, double leastMargin,
  int fields, WaveReport& report)
{
  const double wavelength = screen.wavelength / ofRays.refractiveIndex;
  const std::int64_t border = pixelsAround(ofRays, screen) * screen.raysPerPixel;
  report.plane = std::clamp(bestPlane(ofRays, screen.planeOtherwise), 0., screen.largestPlane);
  const double distance = parallelDistance(screen, report.plane);
  const bool isDiverging = screen.pointSource.has_value();
  const LightAtExit parallel = isDiverging
    ? parallelOf(ofRays, *screen.pointSource, report.plane, screen.threads)
    : LightAtExit{};
  const LightAtExit& light = isDiverging ? parallel : ofRays;
  report.fresnelWidth = fresnelWidth(wavelength, distance);
  report.blur = blurOnScreen(screen.source, light.spacing * screen.raysPerPixel, distance);
  LightOnPlane plane = bringToPlane(light, isDiverging ? 0 : report.plane, screen.threads);
  const double margin =
    std::max(leastMargin, marginOnScreen(screen, wavelength, distance, largestDeflection(light)));
  const WaveGrid grid = gridFor(
    light, { screen.wavelength, margin, border, screen.raysPerPixel, fields, screen.memoryBudget });
  report.leastTubeRatio = plane.leastTubeRatio;
  report.raysPerPixel = screen.raysPerPixel;
  report.pointsPerPixel = grid.pointsPerRay * screen.raysPerPixel;
  report.columns = grid.columns;
  report.rows = grid.rows;
  const double taper = taperOf(static_cast<double>(border), report.fresnelWidth / light.spacing);
  const double path = takeOffCommonPath(plane, grid, screen.wavelength);
  return { grid, fieldOf(plane, grid, screen.wavelength, taper, screen.threads),
    { wavelength, distance, grid.spacing, { grid.carrier[0], grid.carrier[1] } }, path };
}

std::vector<float> lightOnScreen(
  const LightAtExit& light, const Screen& screen, const Monitor& monitor, WaveReport& report)
{
  FieldBeforeScreen before = fieldBefore(light, screen, 0, 1, report);
  if (!propagate(before.field, before.space, screen.threads, monitor))
  {
    return {};
  }
  WavePixels pixels(light, screen.raysPerPixel, 0);
  pixels.add(before.field, before.grid, 1, 1, screen.threads);
  const bool isExtended = screen.source.shape != SourceShape::Point;
  const double pixel = light.spacing * screen.raysPerPixel;
  if (isExtended && !blur(pixels, screen, pixel, before.space.distance, monitor))
  {
    return {};
  }
  return pixels.image(screen.width, screen.height);
}

} // namespace schlieren
