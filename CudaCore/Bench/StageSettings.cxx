// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/StageSettings.h"

#include "Bench/Differences.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace schlieren
{

RaySettings settingsOf(const Scene& scene, double lengthScale, double steepest)
{
  RaySettings settings;
  settings.kernel.path = scene.pathModel;
  settings.kernel.interpolation = scene.interpolation;
  if (settings.kernel.path == PathModel::Refracted)
  {
    // Whatever the step is: with leapfrog, half of it would be far less exact than all of an adaptive one.
    const bool isTooSteep = steepest > largestChangeByVoxel;
    settings.kernel.integrator = isTooSteep ? Integrator::Adaptive : scene.integrator;
  }
  if (settings.kernel.integrator == Integrator::Adaptive)
  {
    settings.adaptiveTolerance = scene.adaptiveTolerance;
  }
  settings.stepVoxels = scene.stepSize;
  settings.lengthScale = lengthScale;
  return settings;
}

template <class Real>
double noiseFloor(const Medium<Real>& medium, const Field& field, const Light& light)
{
  constexpr double margin = 16;
  const bool rounded = field.singles != nullptr || std::is_same_v<Real, float>;
  const double rounding = rounded ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                  : std::numeric_limits<double>::epsilon();
  const double voxels = std::max(1., light.depth * light.fastest());
  return margin * medium.largestN * rounding * std::sqrt(voxels);
}

namespace
{

/// See filmDistance.
double focusDistance(const Frame& frame, double offset)
{
  return frame.pupil > 0 ? frame.entry - frame.focus - offset
                         : -0.5 * (frame.exit - frame.entry) + offset;
}

/// How much nearer to the viewer than the focal point, or than the middle of the data, the plane in focus is.
double focusOffsetOf(const Scene& scene, const Frame& frame)
{
  return frame.pupil > 0 && scene.lens.focusDistance ? frame.pupil - *scene.lens.focusDistance
                                                     : scene.focusOffset;
}

/// Where a place at a distance from the plane where rays leave the data, less than 0 within them, seems to be from
/// outside. So what is in focus there lies where it does in the data.
double apparentDistance(double distance, const Frame& frame, double exitRatio)
{
  // Behind the data of a camera's view there is the same as in them: see Light.
  const double within =
    std::min(0., frame.pupil > 0 ? distance : std::max(distance, frame.entry - frame.exit));
  return within / exitRatio + (distance - within);
}

/// How much larger the image is on a film at such a distance from where rays leave the data.
double magnificationAt(const Scene& scene, const Frame& frame, double film, double exitRatio)
{
  const double inData = exitRatio * film;
  if (frame.pupil > 0)
  {
    return 1 + (inData + frame.focus - frame.entry) / frame.pupil;
  }
  const double depth = frame.exit - frame.entry;
  return scene.source.distance
    ? 1 + (inData + 0.5 * depth) / distanceInData(*scene.source.distance, frame, exitRatio)
    : 1;
}

} // namespace

double exitRefractivityOf(const Scene& scene, double ambient)
{
  switch (scene.exitInto)
  {
    case ExitInto::Auto:
      return ambient > leastOfLiquids ? airRefractivity : ambient;
    case ExitInto::Air:
      return airRefractivity;
    case ExitInto::Custom:
      return scene.exitRefractivity;
    case ExitInto::Surroundings:
      break;
  }
  return ambient;
}

ExitFaces exitFacesOf(const Scene& scene, double ambient, double largestN)
{
  if (scene.exitInto == ExitInto::Surroundings ||
    (scene.exitInto == ExitInto::Auto && !(std::max(ambient, largestN) > leastOfLiquids)))
  {
    return noFaces;
  }
  return { true, (1 + ambient) / (1 + exitRefractivityOf(scene, ambient)) };
}

double filmDistance(const Scene& scene, const Frame& frame, const ExitFaces& faces)
{
  const double depth = frame.exit - frame.entry;
  switch (techniqueOf(scene.cutoff).plane)
  {
    case RecordedPlane::Screen:
      return scene.screenDistance.value_or(depth);
    case RecordedPlane::Background:
      return scene.background.distance.value_or(depth);
    case RecordedPlane::Focus:
      break;
  }
  return apparentDistance(focusDistance(frame, focusOffsetOf(scene, frame)), frame, faces.ratio);
}

Aperture apertureOf(const Scene& scene, const Frame& frame, const ExitFaces& faces)
{
  const bool isCamera = isOfCamera(scene.cutoff);
  const bool hasPupil = frame.pupil > 0;
  Aperture aperture;
  if (hasPupil)
  {
    aperture.slope = 0.5 * scene.lens.aperture / frame.pupil;
  }
  else if (isCamera)
  {
    aperture.slope = 0.5 * scene.lens.apertureRatio / faces.ratio;
  }
  if (aperture.slope > 0)
  {
    aperture.focus = isCamera && hasPupil && scene.lens.focusDistance
      ? apparentDistance(focusDistance(frame, focusOffsetOf(scene, frame)), frame, faces.ratio)
      : filmDistance(scene, frame, faces);
  }
  return aperture;
}

namespace
{

/// How far light is moved where it meets what is `distance` behind the data, pixels.
double movedAt(double distance, const std::vector<MovedRay>& rays, const Scene& scene,
  const Frame& frame, const Light& light)
{
  constexpr double between = 1.2; // what lies between the rays may be moved further
  const double film = apparentDistance(distance, frame, light.faces.ratio);
  const double magnification = magnificationAt(scene, frame, film, light.faces.ratio);
  return magnification > 0 ? between * maximumShift(rays, film) / (magnification * frame.pixelSize)
                           : 0;
}

} // namespace

double movedInFocus(
  const std::vector<MovedRay>& rays, const Scene& scene, const Frame& frame, const Light& light)
{
  return movedAt(focusDistance(frame, focusOffsetOf(scene, frame)), rays, scene, frame, light);
}

std::int64_t marginFor(
  const std::vector<MovedRay>& rays, const Scene& scene, const Frame& frame, const Light& light)
{
  if (isOfCamera(scene.cutoff))
  {
    return 2; // what the light of a pixel's mean depends on
  }
  double largest = movedInFocus(rays, scene, frame, light);
  for (const double distance :
    { scene.screenDistance.value_or(frame.exit - frame.entry), focusDistance(frame, 0) })
  {
    largest = std::max(largest, movedAt(distance, rays, scene, frame, light));
  }
  const double pixels = std::ceil(largest) + 1;
  const auto most = static_cast<double>(maxMargin(scene.view));
  return static_cast<std::int64_t>(pixels < most ? pixels : most);
}

double screenDistanceFor(const std::vector<MovedNeighbours>& neighbours, const Scene& scene,
  const Frame& frame, const Light& light, double rounding)
{
  constexpr double wanted = 0.5;       // of |I - 1|, where white is 2
  constexpr double farthest = 1 << 20; // depths
  const double depth = frame.exit - frame.entry;
  const auto magnification = [&](double distance)
  { return magnificationAt(scene, frame, distance, light.faces.ratio); };
  // |I - 1| that a part of the light exceeds, 1/I being the area on which it lands by that which it comes from.
  const auto contrast = [&](double part, double distance)
  {
    const double pixel = frame.pixelSize * magnification(distance);
    Differences changes;
    for (const MovedNeighbours& three : neighbours)
    {
      double a[2][2] = { { 1, 0 }, { 0, 1 } };
      for (std::size_t from = 0; from < 2; ++from)
      {
        for (std::size_t to = 0; to < 2; ++to)
        {
          const auto place = [&](const MovedRay& ray)
          { return ray.displacement[to] + distance * ray.slope[to]; };
          a[from][to] +=
            (place(three.rays[from + 1]) - place(three.rays[0])) / (three.apart * pixel);
        }
      }
      const double area = std::abs(a[0][0] * a[1][1] - a[0][1] * a[1][0]);
      changes.push_back({ std::abs(1 / area - 1), 1 });
    }
    return exceededBy(part, changes);
  };
  double limit = farthest * depth;
  Differences slopes;
  for (const MovedNeighbours& three : neighbours)
  {
    limit = std::min(limit, wanted * three.apart * frame.pixelSize / rounding);
    slopes.push_back({ std::hypot(three.rays[0].slope[0], three.rays[0].slope[1]), 1 });
  }
  const double reach = static_cast<double>(maxMargin(scene.view)) * frame.pixelSize;
  const double mostByReach = reach / exceededBy(mayExceed, slopes); // infinite where nothing bends
  limit = std::min(limit, mostByReach);
  for (const double part : { mayExceed, 0. })
  {
    double below = depth, above = depth;
    while (above < limit && contrast(part, above) < wanted)
    {
      below = std::exchange(above, 2 * above);
    }
    if (above < limit)
    {
      constexpr int halvings = 10;
      for (int i = 0; i < halvings; ++i)
      {
        const double middle = 0.5 * (below + above);
        (contrast(part, middle) < wanted ? below : above) = middle;
      }
      return above;
    }
    if (!(limit < mostByReach))
    {
      return std::max(depth, limit);
    }
  }
  return depth;
}

Light lightOf(const Scene& scene, const Grid& grid, const Frame& frame, const ExitFaces& faces)
{
  const double film = filmDistance(scene, frame, faces);
  const Aperture aperture = apertureOf(scene, frame, faces);
  if (!isOfCamera(scene.cutoff))
  {
    return lightFrom(scene.source, film, grid, scene.view, frame, faces, aperture);
  }
  return frame.pupil > 0 ? lightFrom(LightSource{}, film, grid, scene.view, frame, faces, aperture)
                         : reversedLight(grid, frame, faces, aperture);
}

Column columnOf(const Scene& scene, const Light& light, const Frame& frame, std::int64_t around)
{
  Column column{};
  column.u = light.u;
  column.v = light.v;
  const double size[2] = { static_cast<double>(scene.view.width),
    static_cast<double>(scene.view.height) };
  const auto margin = static_cast<double>(maxMargin(scene.view) + around);
  for (int i = 0; i < 2; ++i)
  {
    column.middle[i] =
      frame.origin[static_cast<std::size_t>(i)] + 0.5 * (size[i] - 1) * frame.pixelSize;
    column.halfWidth[i] = (0.5 * size[i] + margin) * frame.pixelSize;
    if (!(frame.pupil > 0))
    {
      column.halfWidth[i] += 0.5 * light.steepest[i] * (frame.exit - frame.entry);
    }
  }
  column.finest = frame.pixelSize;
  column.pupil = frame.pupil;
  column.plane = frame.focus;
  const double fullScale = techniqueOf(scene.cutoff).fullScale;
  if (scene.kScale && *scene.kScale > 0 && fullScale > 0)
  {
    // In powers of two, so that a medium serves for k that differ little.
    column.fullScale = std::exp2(std::ceil(std::log2(fullScale / *scene.kScale)));
  }
  return column;
}

Projection projectionOf(
  const Scene& scene, const Frame& frame, const Light& light, double pathPerDataUnit)
{
  Projection projection{ filmDistance(scene, frame, light.faces),
    1 / (frame.pixelSize * light.magnification), pathPerDataUnit, light.inclination };
  projection.exitRatio = light.faces.ratio;
  projection.isOfCamera = isOfCamera(scene.cutoff);
  if (projection.isOfCamera && light.pupilTilt > 0)
  {
    projection.pupilTilt = light.pupilTilt;
    projection.pastFocus =
      light.faces.ratio * (projection.distance - apertureOf(scene, frame, light.faces).focus);
  }
  if (frame.pupil > 0)
  {
    projection.perSourceDistance = light.faces.ratio / (frame.pupil * light.magnification);
  }
  else if (!projection.isOfCamera && scene.source.distance)
  {
    projection.perSourceDistance = light.faces.ratio /
      (distanceInData(*scene.source.distance, frame, light.faces.ratio) * light.magnification);
  }
  return projection;
}

PixelPlaces pixelPlacesOf(const Frame& frame, const View& view, const Light& light)
{
  PixelPlaces pixels{ frame.pixelSize, frame.pixelSize * light.magnification, { 0, 0 } };
  const double middle[2] = { 0.5 * (view.width - 1), 0.5 * (view.height - 1) };
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double focal = frame.origin[axis] + middle[axis] * frame.pixelSize;
    pixels.zeroBehind[axis] = middle[axis] - focal / pixels.sizeBehind;
  }
  return pixels;
}

FilmSettings filmSettingsOf(const Scene& scene)
{
  return { scene.view.width, scene.view.height, scene.samplesPerPixel, scene.seed,
    scene.smoothingRadius, isOfCamera(scene.cutoff), scene.threads };
}

double sideOnFilm(int raysPerPixel, const Scene& scene, const Light& light)
{
  constexpr double overlap = 2; // so that no gaps are where light is spread
  const Technique& technique = techniqueOf(scene.cutoff);
  const bool areAlone =
    !isOfCamera(scene.cutoff) && (scene.source.shape != SourceShape::Point || light.pupilTilt > 0);
  const bool isOnScreen = technique.plane == RecordedPlane::Screen;
  constexpr int fewestOfFringes = 16;
  return areAlone || (technique.hasFringes && raysPerPixel < fewestOfFringes)
    ? 1
    : std::min(1., (isOnScreen ? overlap : 1) * sideOf(raysPerPixel));
}

int pointsOfPixel(int samples, const Scene& scene, const Light& light)
{
  const bool areTogether = techniqueOf(scene.cutoff).showsSquares() &&
    scene.source.shape == SourceShape::Point && !(light.pupilTilt > 0) && haveOwnPoints(samples);
  return areTogether ? samples : 1;
}

void aimPass(Pass& pass, std::int64_t number, int samples, const Scene& scene, const Light& light)
{
  pass.offset = pixelOffset(number, scene.seed, pointsOfPixel(samples, scene, light));
  pass.side = sideOnFilm(samples, scene, light);
  if (light.pupilTilt > 0)
  {
    const std::array<double, 2> place = pupilPoint(number, scene.samplesPerPixel);
    pass.tilt[0] = light.pupilTilt * place[0];
    pass.tilt[1] = light.pupilTilt * place[1];
  }
  else if (!isOfCamera(scene.cutoff))
  {
    const std::array<double, 2> place =
      sourcePoint(scene.source, scene.knifeEdgeAngle, number, scene.seed);
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      pass.tilt[axis] = place[axis] / (light.magnification * light.faces.ratio);
    }
  }
}

template double noiseFloor(const Medium<float>&, const Field&, const Light&);
template double noiseFloor(const Medium<double>&, const Field&, const Light&);

} // namespace schlieren
