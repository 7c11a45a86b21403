// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Waves/WaveField.h"

#include "Device/Parallel.h"
#include "Math/Units.h"
#include "Waves/Spline.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <sstream>
#include <vector>

namespace schlieren
{

namespace
{

using Value = ComplexField::Value;

double largestDeflection(const LightAtExit& light, const double (&tilt)[2])
{
  double largest = 0;
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    largest = std::max(
      largest, std::hypot(light.deflection[0][ray] - tilt[0], light.deflection[1][ray] - tilt[1]));
  }
  return largest;
}

/// The tilt that all light has, where without it no more than half of the deflection is left; else none, as undisturbed
/// light around the data.
struct Tilt
{
  double along[2]{ 0, 0 };
};
Tilt commonTilt(const LightAtExit& light)
{
  constexpr double worthIt = 0.5;
  Tilt mean;
  for (int axis = 0; axis < 2; ++axis)
  {
    for (const double eps : light.deflection[axis])
    {
      mean.along[axis] += eps;
    }
    mean.along[axis] /= static_cast<double>(light.size());
  }
  const Tilt none;
  return largestDeflection(light, mean.along) <= worthIt * largestDeflection(light, none.along)
    ? mean
    : none;
}

void requireMemory(const WaveGrid& grid, const GridRequest& request, double pixel)
{
  const double bytes = request.fields * static_cast<double>(grid.columns) *
    static_cast<double>(grid.rows) * static_cast<double>(sizeof(Value));
  if (bytes <= static_cast<double>(request.memoryBudget))
  {
    return;
  }
  constexpr double mebibyte = 1 << 20, perMillimetre = 1e3, perMicrometre = 1e6;
  std::ostringstream text;
  text << "A wave image needs " << grid.columns << " x " << grid.rows << " points, "
       << std::ceil(bytes / mebibyte) << " MiB, but "
       << static_cast<double>(request.memoryBudget) / mebibyte
       << " MiB may be used. Light that is bent by " << grid.largestDeflection << " rad takes "
       << grid.pointsPerRay * request.raysPerPixel << " points along each side of a pixel of "
       << pixel * perMicrometre << " micrometres, and there are " << request.margin * perMillimetre
       << " mm around the image. Set ImageSize or ScreenDistance to less, use a machine with more "
          "free "
          "memory, or set LightModel to Rays, "
          "whose image is the mean over the fringes.";
  throw Error(text.str());
}

/// 1, falling to 0 within `taper` rays of the ends: a step all of whose derivatives are continuous. `place`: in rays from
/// the middle of the first one.
double taperAt(double place, std::int64_t rays, double taper)
{
  const double fromEnd = std::min(place + 0.5, static_cast<double>(rays) - 0.5 - place);
  const double t = fromEnd / taper;
  return t <= 0 ? 0 : t >= 1 ? 1 : 1 / (1 + std::exp(1 / t - 1 / (1 - t)));
}

/// Where points along an axis lie between rays.
struct PointAlong
{
  double place;
  Spline::Stencil stencil;
  double taper;
};
std::vector<PointAlong> pointsAlong(std::int64_t rays, std::int64_t perRay, double taper)
{
  std::vector<PointAlong> points;
  for (std::int64_t point = 0; point < rays * perRay; ++point)
  {
    const double place = (static_cast<double>(point) + 0.5) / static_cast<double>(perRay) - 0.5;
    points.push_back({ place, Spline::Stencil(place, rays), taperAt(place, rays, taper) });
  }
  return points;
}

double valueAt(const Spline::Stencil& stencil, const std::vector<double>& coefficients)
{
  const double* c = coefficients.data() + stencil.first;
  return stencil.value[0] * c[0] + stencil.value[1] * c[1] + stencil.value[2] * c[2] +
    stencil.value[3] * c[3];
}

} // namespace

double takeOffCommonPath(LightOnPlane& plane, const WaveGrid& grid, double wavelength)
{
  RayValues border;
  for (std::int64_t row = 0; row < plane.rows; ++row)
  {
    const bool isEnd = row == 0 || row + 1 == plane.rows;
    for (std::int64_t column = 0; column < plane.columns; ++column)
    {
      const auto ray = static_cast<std::size_t>(row * plane.columns + column);
      plane.path[ray] -= wavelength * plane.spacing *
        (grid.carrier[0] * static_cast<double>(column) +
          grid.carrier[1] * static_cast<double>(row));
      if (isEnd || column == 0 || column + 1 == plane.columns)
      {
        border.push_back(plane.path[ray]);
      }
    }
  }
  const auto middle = border.begin() + static_cast<std::ptrdiff_t>(border.size() / 2);
  std::nth_element(border.begin(), middle, border.end());
  for (double& path : plane.path)
  {
    path -= *middle;
  }
  return *middle;
}

double pointsFor(double length, double largestDeflection, double wavelengthInMedium)
{
  constexpr double pointsPerWave = 4;
  return std::max(1., std::ceil(pointsPerWave * largestDeflection * length / wavelengthInMedium));
}

WaveGrid gridFor(const LightAtExit& light, const GridRequest& request)
{
  WaveGrid grid;
  const Tilt tilt = commonTilt(light);
  const double wavelength = request.wavelength / light.refractiveIndex;
  grid.largestDeflection = largestDeflection(light, tilt.along);
  const double perRay = pointsFor(light.spacing, grid.largestDeflection, wavelength);
  constexpr double most = 1e6; // no memory has room for as many
  // A pixel's light is the mean over its points, and fringes may be as fine as two points.
  const std::int64_t least = request.raysPerPixel > 1 ? 1 : 2;
  grid.pointsPerRay = std::max(least, static_cast<std::int64_t>(std::min(perRay, most)));
  grid.spacing = light.spacing / static_cast<double>(grid.pointsPerRay);
  grid.carrier[0] = tilt.along[0] / wavelength;
  grid.carrier[1] = tilt.along[1] / wavelength;
  const double traced = static_cast<double>(request.border) * light.spacing;
  const double padding = std::max(0., request.margin - traced) / grid.spacing;
  const auto padded = static_cast<std::int64_t>(std::ceil(std::min(padding, most)));
  grid.columns = fastLength(light.columns * grid.pointsPerRay + 2 * padded);
  grid.rows = fastLength(light.rows * grid.pointsPerRay + 2 * padded);
  grid.left = (grid.columns - light.columns * grid.pointsPerRay) / 2;
  grid.below = (grid.rows - light.rows * grid.pointsPerRay) / 2;
  requireMemory(grid, request, light.spacing * static_cast<double>(request.raysPerPixel));
  return grid;
}

ComplexField fieldOf(
  const LightOnPlane& plane, const WaveGrid& grid, double wavelength, double taper, int threads)
{
  const Spline path(plane.path, plane.columns, plane.rows);
  const Spline amplitude(plane.amplitude, plane.columns, plane.rows);
  const std::vector<PointAlong> xs = pointsAlong(plane.columns, grid.pointsPerRay, taper);
  const std::vector<PointAlong> ys = pointsAlong(plane.rows, grid.pointsPerRay, taper);
  const double perMetre = 2 * pi / wavelength;
  ComplexField field(grid.columns, grid.rows);
  constexpr std::int64_t rowsInPiece = 16;
  parallelFor(static_cast<std::int64_t>(ys.size()), rowsInPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::vector<double> paths, amplitudes;
      for (std::int64_t row = begin; row < end; ++row)
      {
        const PointAlong& y = ys[static_cast<std::size_t>(row)];
        path.mixRows(y.place, paths);
        amplitude.mixRows(y.place, amplitudes);
        Value* value = field.row(grid.below + row) + grid.left;
        // What a body covers of a ray's cell it covers of all its points: light that is interpolated is blurred.
        const float* passing = plane.passing.data() + row / grid.pointsPerRay * plane.columns;
        for (std::size_t column = 0; column < xs.size(); ++column)
        {
          const PointAlong& x = xs[column];
          const auto ray = static_cast<std::int64_t>(column) / grid.pointsPerRay;
          const double phase = perMetre * valueAt(x.stencil, paths);
          const double size = valueAt(x.stencil, amplitudes) * static_cast<double>(passing[ray]);
          *value++ = x.taper * y.taper * Value(size * std::cos(phase) - 1, size * std::sin(phase));
        }
      }
    });
  return field;
}

} // namespace schlieren
