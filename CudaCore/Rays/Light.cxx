// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Light.h"

#include "Math/NumberText.h"
#include "Math/Units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace schlieren
{

namespace
{

Vec3<double> vec(const Vector& a) { return { a[0], a[1], a[2] }; }

Vector array(const Vec3<double>& a) { return { a.x, a.y, a.z }; }

bool isFinite(const Vector& a)
{
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

/// Components of a data-space vector along the grid's axes.
Vec3<double> inGridAxes(const Grid& grid, const Vec3<double>& a)
{
  const std::array<double, 9>& d = grid.direction;
  return { d[0] * a.x + d[3] * a.y + d[6] * a.z, d[1] * a.x + d[4] * a.y + d[7] * a.z,
    d[2] * a.x + d[5] * a.y + d[8] * a.z };
}

/// Half the edges of the grid's box, along its own axes.
Vec3<double> halfEdges(const Grid& grid)
{
  return { 0.5 * grid.spacing[0] * static_cast<double>(grid.dimensions[0] - 1),
    0.5 * grid.spacing[1] * static_cast<double>(grid.dimensions[1] - 1),
    0.5 * grid.spacing[2] * static_cast<double>(grid.dimensions[2] - 1) };
}

Vec3<double> centreOf(const Grid& grid)
{
  const std::array<double, 9>& d = grid.direction;
  const Vec3<double> h = halfEdges(grid);
  return vec(grid.origin) +
    Vec3<double>{ d[0] * h.x + d[1] * h.y + d[2] * h.z, d[3] * h.x + d[4] * h.y + d[5] * h.z,
      d[6] * h.x + d[7] * h.y + d[8] * h.z };
}

/// Half the extent of the grid's box along a unit vector.
double halfExtent(const Grid& grid, const Vec3<double>& axis)
{
  const Vec3<double> a = inGridAxes(grid, axis);
  const Vec3<double> h = halfEdges(grid);
  return std::abs(a.x) * h.x + std::abs(a.y) * h.y + std::abs(a.z) * h.z;
}

/// A vector scaled to length 1 without overflow or underflow; zero stays zero.
Vec3<double> unit(const Vec3<double>& a)
{
  const double largest = std::max({ std::abs(a.x), std::abs(a.y), std::abs(a.z) });
  if (!(largest > 0))
  {
    return { 0, 0, 0 };
  }
  const Vec3<double> b = { a.x / largest, a.y / largest, a.z / largest };
  return (1 / length(b)) * b;
}

/// Below this sine of the angle between them, ViewUp and ViewDirection count as parallel.
constexpr double parallelSine = 1e-6;

constexpr int largestSide = 32768;

/// Collimated light along a unit vector: w or its opposite.
Light lightAlong(const Vec3<double>& w, const Grid& grid, const Frame& frame)
{
  const Vec3<double> u = vec(frame.u);
  const Vec3<double> v = vec(frame.v);
  const Vec3<double> centre = centreOf(grid);

  Light light{};
  light.unit = std::min({ grid.spacing[0], grid.spacing[1], grid.spacing[2] });
  light.u = inGridAxes(grid, u);
  light.v = inGridAxes(grid, v);
  light.w = inGridAxes(grid, w);
  light.indexScale = { light.unit / grid.spacing[0], light.unit / grid.spacing[1],
    light.unit / grid.spacing[2] };
  light.unitsPerIndex = { grid.spacing[0] / light.unit, grid.spacing[1] / light.unit,
    grid.spacing[2] / light.unit };
  light.perLength = scaled(light.indexScale, light.w);
  light.lengthPer = { 1 / light.perLength.x, 1 / light.perLength.y, 1 / light.perLength.z };
  const double pixel = frame.pixelSize / light.unit;
  light.perColumn = pixel * scaled(light.indexScale, light.u);
  light.perRow = pixel * scaled(light.indexScale, light.v);
  light.depth = 2 * halfExtent(grid, w) / light.unit;
  light.magnification = 1;
  light.faces = noFaces;

  // From the centre, which is exact in index coordinates however far the origin is from zero.
  const double a = (frame.origin[0] - dot(centre, u)) / light.unit;
  const double b = (frame.origin[1] - dot(centre, v)) / light.unit;
  light.corner = Vec3<double>{ 0.5 * static_cast<double>(grid.dimensions[0] - 1),
    0.5 * static_cast<double>(grid.dimensions[1] - 1),
    0.5 * static_cast<double>(grid.dimensions[2] - 1) } +
    scaled(light.indexScale, a * light.u + b * light.v + (-0.5 * light.depth) * light.w);
  return light;
}

} // namespace

Frame frameOf(const Grid& grid, const View& view)
{
  if (view.width < 1 || view.height < 1 || view.width > largestSide || view.height > largestSide)
  {
    throw Error("The image size " + std::to_string(view.width) + " x " +
      std::to_string(view.height) + " is not possible. Set both sides of ImageSize to 1 ... " +
      std::to_string(largestSide) + " pixels.");
  }
  if (!isFinite(view.viewDirection) || !isFinite(view.viewUp) ||
    (view.focalPoint && !isFinite(*view.focalPoint)) || !std::isfinite(view.parallelScale))
  {
    throw Error(
      "The view holds a number that is not finite. Set ViewDirection, ViewUp, FocalPoint and "
      "ParallelScale to ordinary numbers.");
  }
  const Vec3<double> forward = unit(vec(view.viewDirection));
  if (length(forward) == 0)
  {
    throw Error("ViewDirection is (0, 0, 0), so light has no direction. Set it to where the camera "
                "looks, for example (0, 0, -1).");
  }
  const Vec3<double> right = cross(forward, unit(vec(view.viewUp)));
  if (!(length(right) > parallelSine))
  {
    const bool isAlongY = std::abs(forward.y) > std::max(std::abs(forward.x), std::abs(forward.z));
    throw Error(
      "ViewUp is zero or parallel to ViewDirection, so the image has no upward direction. "
      "Set ViewUp to another direction, for example " +
      std::string(isAlongY ? "(0, 0, 1)." : "(0, 1, 0)."));
  }
  constexpr double widest = 170;
  if (!(view.viewAngle >= 0 && view.viewAngle < widest))
  {
    throw Error("ViewAngle is " + textOf(view.viewAngle) +
      " degrees. Set it to less than 170, or to 0 for parallel light.");
  }
  if (view.parallelScale < 0)
  {
    throw Error("ParallelScale is " + textOf(view.parallelScale) +
      ", but it is half the height of the image. Set it to a positive length, or to 0 to fit the "
      "data.");
  }

  Frame frame;
  const Vec3<double> u = unit(right);
  const Vec3<double> v = cross(u, forward);
  const Vec3<double> w = -1.0 * forward;
  frame.u = array(u);
  frame.v = array(v);
  frame.w = array(w);

  const double aspect = static_cast<double>(view.width) / view.height;
  const double fit = std::max(halfExtent(grid, v), halfExtent(grid, u) / aspect);
  // 2-D data have a depth that is none of theirs: a perspective would show it.
  const bool isLayer =
    std::find(grid.dimensions.begin(), grid.dimensions.end(), 2) != grid.dimensions.end();
  // With a perspective the data's nearest end has to fit.
  const double perDistance = isLayer ? 0 : std::tan(0.5 * view.viewAngle * radiansPerDegree);
  const double halfHeight =
    view.parallelScale > 0 ? view.parallelScale : fit + halfExtent(grid, w) * perDistance;
  frame.pixelSize = 2 * halfHeight / view.height;
  if (!(frame.pixelSize > 0) || !std::isfinite(frame.pixelSize))
  {
    throw Error("The image has no extent: the data spans no area seen along ViewDirection. Set "
                "ParallelScale, or look along another direction.");
  }

  const Vec3<double> centre = centreOf(grid);
  const Vec3<double> focal = view.focalPoint ? vec(*view.focalPoint) : centre;
  frame.origin = { dot(focal, u) - 0.5 * (view.width - 1) * frame.pixelSize,
    dot(focal, v) - 0.5 * (view.height - 1) * frame.pixelSize };
  frame.entry = dot(centre, w) - halfExtent(grid, w);
  frame.exit = dot(centre, w) + halfExtent(grid, w);
  if (perDistance > 0)
  {
    frame.pupil = halfHeight / perDistance;
    frame.focus = dot(focal, w);
  }
  return frame;
}

Light collimatedLight(const Grid& grid, const Frame& frame)
{
  return lightAlong(vec(frame.w), grid, frame);
}

Light reversedLight(
  const Grid& grid, const Frame& frame, const ExitFaces& faces, const Aperture& aperture)
{
  Light light = lightAlong(-1.0 * vec(frame.w), grid, frame);
  light.faces = faces;
  light.toFocus = light.depth + faces.ratio * aperture.focus / light.unit;
  light.pupilTilt = light.steepest[0] = light.steepest[1] = aperture.slope;
  return light;
}

double distanceInData(double distance, const Frame& frame, double exitRatio)
{
  const double within = 0.5 * (frame.exit - frame.entry);
  return within + exitRatio * (distance - within);
}

Light lightFrom(const LightSource& source, double film, const Grid& grid, const View& view,
  const Frame& frame, const ExitFaces& faces, const Aperture& aperture)
{
  const bool isFromPupil = frame.pupil > 0;
  Light light = isFromPupil ? reversedLight(grid, frame) : collimatedLight(grid, frame);
  light.faces = faces;
  const double halfDepth = 0.5 * light.depth;
  const double toFilm = light.depth + faces.ratio * film / light.unit;
  light.toFocus =
    aperture.slope > 0 ? light.depth + faces.ratio * aperture.focus / light.unit : toFilm;
  double perDistance =
    source.distance ? light.unit / distanceInData(*source.distance, frame, faces.ratio) : 0;
  double middle = 0; // of the data, from the image's plane along the light
  if (isFromPupil)
  {
    perDistance = light.unit / frame.pupil;
    middle = (frame.focus - 0.5 * (frame.entry + frame.exit)) / light.unit;
    light.first = std::max(0., halfDepth - middle - 1 / perDistance);
  }
  light.magnification = 1 + (toFilm - halfDepth + middle) * perDistance;
  if (light.first >= light.depth)
  {
    light.magnification = 1; // all data are behind the pupil, which no ray meets
  }
  else if (aperture.slope > 0)
  {
    light.pupilTilt = aperture.slope / (1 + (light.toFocus - halfDepth + middle) * perDistance);
  }

  // Towards the axis where it enters.
  const double axis[2] = { 0.5 * (view.width - 1), 0.5 * (view.height - 1) };
  const double nearer = (halfDepth - middle) * perDistance;
  light.corner =
    light.corner + (nearer * axis[0]) * light.perColumn + (nearer * axis[1]) * light.perRow;
  light.perColumn = (1 - nearer) * light.perColumn;
  light.perRow = (1 - nearer) * light.perRow;

  light.inclination.perPixel = frame.pixelSize / light.unit * perDistance;
  const double reach = source.shape == SourceShape::Point ? 0
                                                          : 0.5 *
      (source.shape == SourceShape::Slit ? std::hypot(source.width, source.length) : source.width);
  for (int i = 0; i < 2; ++i)
  {
    light.inclination.atOrigin[i] = -axis[i] * light.inclination.perPixel;
    light.steepest[i] =
      (axis[i] + 0.5 + static_cast<double>(maxMargin(view))) * light.inclination.perPixel +
      (light.pupilTilt > 0 ? light.pupilTilt : reach / (light.magnification * faces.ratio));
  }
  return light;
}

double Light::fastest(const Vec3<double>& scale) const
{
  // Of w and slopes, which is more than of their unit vector; convex, so that it is largest in a corner.
  double most = 0;
  for (const double sign : { -1., 1. })
  {
    most = std::max(most, length(scaled(scale, w + steepest[0] * u + (sign * steepest[1]) * v)));
    most = std::max(most, length(scaled(scale, w - steepest[0] * u + (sign * steepest[1]) * v)));
  }
  return most;
}

Vector placeOf(const Grid& grid, const Vec3<double>& index)
{
  const double along[3] = { grid.spacing[0] * index.x, grid.spacing[1] * index.y,
    grid.spacing[2] * index.z };
  Vector place = grid.origin;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[row] += grid.direction[3 * row + axis] * along[axis];
    }
  }
  return place;
}

std::int64_t maxMargin(const View& view)
{
  return std::max(16, std::max(view.width, view.height) / 8);
}

} // namespace schlieren
