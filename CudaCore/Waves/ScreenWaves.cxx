// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/ScreenWaves.h"

#include "Device/Parallel.h"
#include "Math/Units.h"
#include "Waves/WaveField.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace schlieren
{

namespace
{

using Value = ComplexField::Value;

constexpr std::int64_t rowsInPiece = 16;
constexpr double marginInFresnelWidths = 8;

/// Numbers for the pixels of an image and for those around it, row by row.
struct PixelLight
{
  std::int64_t columns, rows;
  std::vector<double> light;
};

/// Means of |1 + field|^2 over the points of each pixel that rays have been traced for.
PixelLight developed(const ComplexField& field, const WaveGrid& grid, const LightAtExit& light,
  std::int64_t raysPerPixel, int threads)
{
  PixelLight pixels{ light.columns / raysPerPixel, light.rows / raysPerPixel, {} };
  pixels.light.resize(static_cast<std::size_t>(pixels.columns * pixels.rows));
  const std::int64_t perPixel = grid.pointsPerRay * raysPerPixel;
  const double perPoint = 1 / static_cast<double>(perPixel * perPixel);
  parallelFor(pixels.rows, rowsInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t row = begin * perPixel; row < end * perPixel; ++row)
      {
        const Value* point = field.row(grid.below + row) + grid.left;
        double* pixel = pixels.light.data() + row / perPixel * pixels.columns;
        for (std::int64_t column = 0; column < pixels.columns; ++column)
        {
          double sum = 0;
          for (std::int64_t i = 0; i < perPixel; ++i, ++point)
          {
            sum += std::norm(1. + *point);
          }
          pixel[column] += perPoint * sum;
        }
      }
    });
  return pixels;
}

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
  PixelLight& pixels, const Screen& screen, double pixel, double distance, const Monitor& monitor)
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

std::vector<float> cropped(const PixelLight& pixels, std::int64_t width, std::int64_t height)
{
  std::vector<float> image(static_cast<std::size_t>(width * height));
  const std::int64_t left = (pixels.columns - width) / 2, below = (pixels.rows - height) / 2;
  for (std::int64_t row = 0; row < height; ++row)
  {
    const double* from = pixels.light.data() + (below + row) * pixels.columns + left;
    std::transform(from, from + width, image.begin() + row * width,
      [](double light) { return static_cast<float>(std::max(0., light)); });
  }
  return image;
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

double marginOnScreen(
  const Screen& screen, double wavelengthInMedium, double distance, double largestDeflection)
{
  const double source = screen.source.shape == SourceShape::Point
    ? 0
    : 0.5 * std::max(screen.source.width, screen.source.length);
  return marginInFresnelWidths * fresnelWidth(wavelengthInMedium, distance) +
    std::abs(distance) * (largestDeflection + source);
}

bool propagate(ComplexField& field, const FreeSpace& space, int threads, const Monitor& monitor)
{
  const double distance = space.distance, wavelength = space.wavelength;
  const auto limitAlong = [&](std::int64_t points)
  {
    const double length = static_cast<double>(points) * space.spacing;
    return 1 / (wavelength * std::hypot(2 * distance / length, 1));
  };
  const double limits[2] = { limitAlong(field.columns), limitAlong(field.rows) };
  // Turns by which a frequency lags behind light along the normal, without losing small angles.
  const auto turns = [&](double square)
  {
    const double cosine = std::sqrt(1 - wavelength * wavelength * square);
    return -distance * wavelength * square / (1 + cosine);
  };
  const double ofCarrier =
    turns(space.carrier[0] * space.carrier[0] + space.carrier[1] * space.carrier[1]);
  const auto filter = [&](std::int64_t column, Value* alongY)
  {
    const double fx = frequencyOf(column, field.columns, space.spacing) + space.carrier[0];
    for (std::int64_t row = 0; row < field.rows; ++row)
    {
      const double fy = frequencyOf(row, field.rows, space.spacing) + space.carrier[1];
      const double square = fx * fx + fy * fy;
      if (std::abs(fx) > limits[0] || std::abs(fy) > limits[1] ||
        wavelength * wavelength * square >= 1)
      {
        alongY[row] = 0;
        continue;
      }
      const double phase = 2 * pi * (turns(square) - ofCarrier);
      alongY[row] *= Value(std::cos(phase), std::sin(phase));
    }
  };
  return filterSpectrum(field, filter, threads, monitor);
}

std::vector<float> lightOnScreen(
  LightAtExit&& light, const Screen& screen, const Monitor& monitor, WaveReport& report)
{
  const double wavelength = screen.wavelength / light.refractiveIndex;
  const std::int64_t border =
    (light.columns / screen.raysPerPixel - screen.width) / 2 * screen.raysPerPixel;
  const double pixel = light.spacing * screen.raysPerPixel;
  continueBehindBodies(light);
  report.plane = std::clamp(bestPlane(light, screen.planeOtherwise), 0., screen.largestPlane);
  const double distance = screen.distance + report.plane;
  report.fresnelWidth = fresnelWidth(wavelength, distance);
  report.blur = blurOnScreen(screen.source, pixel, distance);
  const LightOnPlane plane = bringToPlane(light, report.plane, screen.threads);
  report.leastTubeRatio = plane.leastTubeRatio;
  double bent = 0;
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    bent = std::max(bent, std::hypot(light.deflection[0][ray], light.deflection[1][ray]));
  }
  const WaveGrid grid = gridFor(light,
    { screen.wavelength, marginOnScreen(screen, wavelength, distance, bent), border,
      screen.raysPerPixel, screen.memoryBudget });
  report.pointsPerPixel = grid.pointsPerRay * screen.raysPerPixel;
  report.columns = grid.columns;
  report.rows = grid.rows;
  ComplexField field = fieldOf(plane, grid, screen.wavelength,
    taperOf(static_cast<double>(border), report.fresnelWidth / light.spacing), screen.threads);
  const FreeSpace space{ wavelength, distance, grid.spacing, { grid.carrier[0], grid.carrier[1] } };
  if (!propagate(field, space, screen.threads, monitor))
  {
    return {};
  }
  PixelLight pixels = developed(field, grid, light, screen.raysPerPixel, screen.threads);
  const bool isExtended = screen.source.shape != SourceShape::Point;
  if (isExtended && !blur(pixels, screen, pixel, distance, monitor))
  {
    return {};
  }
  return cropped(pixels, screen.width, screen.height);
}

} // namespace schlieren
