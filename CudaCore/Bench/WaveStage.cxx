// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/WaveStage.h"

#include "Bench/ImagingOfScene.h"
#include "Bench/StageSettings.h"
#include "Bench/WaveScene.h"
#include "Rays/March/MakeTask.h"
#include "Rays/RayStarts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <optional>
#include <sstream>
#include <vector>

namespace schlieren
{

namespace
{

/// Bodies are edges, which take points by the Fresnel width, each with a ray of its own; at least and at most so many along the
/// side of a pixel.
constexpr double raysPerFresnelWidth = 8;
constexpr int leastRaysPerPixel = 2;
constexpr int mostRaysPerPixel = 4;

/// Rays by which an image's light is traced for waves: those of its centre, on a grid of its own.
Scene sceneOfRays(const Scene& scene, int raysPerPixel)
{
  Scene ofRays = scene;
  ofRays.view.width *= raysPerPixel;
  ofRays.view.height *= raysPerPixel;
  ofRays.source = LightSource{};
  ofRays.source.distance = scene.source.distance;
  ofRays.pathModel = PathModel::Refracted;
  return ofRays;
}

/// The slopes of rays are yet to be found.
std::optional<PointSource> pointSourceOf(const Scene& scene, const Frame& frame, double lengthScale)
{
  if (frame.pupil > 0)
  {
    return PointSource{ lengthScale * frame.pupil, lengthScale * (frame.focus - frame.entry),
      { 0, 0 }, 0 };
  }
  if (scene.source.distance)
  {
    return PointSource{ lengthScale * *scene.source.distance,
      0.5 * lengthScale * (frame.exit - frame.entry), { 0, 0 }, 0 };
  }
  return {};
}

double largestDeflectionOf(const Image& image)
{
  double largest = 0;
  for (std::size_t i = 0; i + 1 < image.deflection.size(); i += 2)
  {
    largest = std::max(largest,
      std::hypot(
        static_cast<double>(image.deflection[i]), static_cast<double>(image.deflection[i + 1])));
  }
  return largest;
}

void addExits(const TracedPass& traced, double lengthScale, LightAtExit& light)
{
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    const RayExit& exit = traced.exits[ray];
    if (!exit.reachesFilm())
    {
      light.isBlocked[ray] = 1;
      continue;
    }
    light.path[ray] = exit.opticalPathDifference;
    for (int axis = 0; axis < 2; ++axis)
    {
      light.deflection[axis][ray] = exit.deflection[axis];
      light.displacement[axis][ray] = lengthScale * static_cast<double>(exit.displacement[axis]);
    }
  }
}

void addBlocked(const TracedPass& traced, float perPass, LightAtExit& light)
{
  for (std::size_t ray = 0; ray < light.size(); ++ray)
  {
    light.passing[ray] -= traced.exits[ray].reachesFilm() ? 0 : perPass;
  }
}

} // namespace

template <class Real>
bool WaveStage<Real>::areWanted() const
{
  const Scene& scene = request_.scene;
  if (scene.lightModel == LightModel::Rays)
  {
    return false;
  }
  std::string problem = problemOfWaves(scene, frame_);
  if (problem.empty() && faces_.ratio != 1 && (frame_.pupil > 0 || scene.source.distance))
  {
    problem = thatWaves(scene) +
      ", but light diverges and is refracted where it leaves the data, as through a "
      "window. Set ViewAngle and SourceDistance to 0, ExitInto to Surroundings," +
      orRays(scene);
  }
  if (!problem.empty())
  {
    throw Error(problem);
  }
  return true;
}

template <class Real>
Screen WaveStage<Real>::screenOf(const Image& image) const
{
  const Scene& scene = request_.scene;
  const double scale = request_.field.lengthScale;
  const double depth = scale * (frame_.exit - frame_.entry) / faces_.ratio;
  Screen screen;
  screen.wavelength = scene.wavelength;
  screen.distance = scale * filmDistance(scene, frame_, faces_);
  screen.width = image.width;
  screen.height = image.height;
  screen.source = sourceOfWaves(scene);
  screen.sourceAngle = scene.knifeEdgeAngle;
  screen.planeOtherwise = 0.5 * depth;
  screen.largestPlane = depth;
  screen.pointSource = pointSourceOf(scene, frame_, scale);
  screen.memoryBudget = scene.memoryBudget;
  screen.threads = scene.threads;
  if (image.raysBlocked > 0)
  {
    const double pixel = scale * frame_.pixelSize;
    const double wanted = std::ceil(raysPerFresnelWidth * pixel /
      fresnelWidth(scene.wavelength, parallelDistance(screen, screen.planeOtherwise)));
    screen.raysPerPixel =
      static_cast<int>(std::clamp(wanted, double{ leastRaysPerPixel }, double{ mostRaysPerPixel }));
  }
  return screen;
}

template <class Real>
std::int64_t WaveStage<Real>::borderOf(const Image& image, const Screen& screen) const
{
  const Scene& scene = request_.scene;
  const double pixel = request_.field.lengthScale * frame_.pixelSize;
  const double farthest =
    std::max(std::abs(screen.distance), std::abs(screen.distance + screen.largestPlane));
  const double bent = farthest * largestDeflectionOf(image) / pixel;
  constexpr std::int64_t least = 4; // splines have four points
  const auto most = static_cast<double>(maxMargin(scene.view));
  return least + pixelsOfFresnelMargin(request_.field, scene, frame_, faces_) +
    static_cast<std::int64_t>(std::ceil(std::min(bent, most)));
}

template <class Real>
Monitor WaveStage<Real>::withoutPauses() const
{
  Monitor monitor;
  monitor.aborted = watch_.monitor().aborted;
  return monitor;
}

template <class Real>
const TracedPass* WaveStage<Real>::tracePass(
  std::int64_t number, const Pass& pass, const RayTask<Real>& task, Image& image)
{
  const Monitor monitor = withoutPauses();
  const auto trace = [&](TracedPass& traced, bool)
  {
    const auto start = std::chrono::steady_clock::now();
    const bool isTraced = view_.tracer.trace(task, pass, traced, monitor);
    image.traceSeconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    work_.raysTraced += traced.crossed;
    return isTraced;
  };
  constexpr std::size_t partOfBudget = 4; // the rest is for the image's own rays
  return rays_.raysOf(
    number, pass, request_.device, request_.scene.memoryBudget / partOfBudget, trace);
}

/// Before they are traced.
void requireMemory(const Pass& pass, const Screen& screen, const Scene& scene)
{
  constexpr double bytesPerRay = sizeof(RayExit) + 5 * sizeof(double) + sizeof(float) + 1;
  constexpr double mebibyte = 1 << 20;
  const double bytes =
    static_cast<double>(pass.columns) * static_cast<double>(pass.rows) * bytesPerRay;
  const auto budget = static_cast<double>(screen.memoryBudget);
  if (bytes > budget)
  {
    std::ostringstream text;
    text << "A wave image needs " << pass.columns << " x " << pass.rows << " rays, "
         << std::ceil(bytes / mebibyte) << " MiB, but " << budget / mebibyte
         << " MiB may be used: light from eight times sqrt(wavelength distance) around the image "
            "reaches it. "
            "Set ScreenDistance or ImageSize to less, use a machine with more free memory,"
         << orRays(scene);
    throw Error(text.str());
  }
}

template <class Real>
bool WaveStage<Real>::trace(Image& image, Screen& screen, LightAtExit& light)
{
  const Field& field = request_.field;
  const Scene scene = sceneOfRays(request_.scene, screen.raysPerPixel);
  const Frame frame = frameOf(field.grid, scene.view);
  const Light ofRays = lightOf(scene, field.grid, frame, faces_);
  const Medium<Real>& medium = view_.medium.medium;
  const RaySettings settings = settingsOf(scene, field.lengthScale, medium.steepest.perVoxel);
  const RayTask<Real> task = makeTask(medium, ofRays, settings);
  const std::int64_t border = borderOf(image, screen) * screen.raysPerPixel;
  const RaysKey key{ { frame, scene.view.width, scene.view.height, settings.kernel,
                       LightKey::of(scene, frame, 0, faces_), view_.medium.changes },
    settings, scene.seed, request_.device, 1 };
  work_.raySets += rays_.prepare(key, border) ? 1 : 0;
  // Rays of a wider margin will do.
  const std::int64_t around = rays_.margin() - rays_.margin() % screen.raysPerPixel;
  Pass pass{ -around, -around, scene.view.width + 2 * around, scene.view.height + 2 * around,
    { 0, 0 } };
  requireMemory(pass, screen, request_.scene);
  if (screen.pointSource)
  {
    const double first = static_cast<double>(-around);
    screen.pointSource->perRay = ofRays.inclination.perPixel;
    for (int axis = 0; axis < 2; ++axis)
    {
      screen.pointSource->first[axis] = ofRays.inclination.at(axis, first, 0);
    }
  }
  light.spacing = field.lengthScale * frame.pixelSize;
  light.refractiveIndex = 1 + view_.exitRefractivity;
  light.resize(pass.columns, pass.rows);
  const int perRay = screen.raysPerPixel * screen.raysPerPixel;
  const int passes = image.raysBlocked > 0
    ? (std::max(scene.samplesPerPixel, scene.samplesAtEdges) + perRay - 1) / perRay
    : 1;
  for (int number = 0; number < passes; ++number)
  {
    pass.offset = pixelOffset(number, scene.seed);
    const TracedPass* traced = tracePass(number, pass, task, image);
    if (traced == nullptr || watch_.isAborted())
    {
      return false;
    }
    if (number == 0)
    {
      addExits(*traced, field.lengthScale, light);
    }
    addBlocked(*traced, 1 / static_cast<float>(passes), light);
  }
  return true;
}

template <class Real>
std::vector<float> WaveStage<Real>::makeLight(
  const LightAtExit& light, const Screen& screen, const Monitor& monitor, Image& image) const
{
  const Scene& scene = request_.scene;
  if (scene.cutoff == Cutoff::Shadowgraph)
  {
    return lightOnScreen(light, screen, monitor, image.waves);
  }
  if (techniqueOf(scene.cutoff).hasK() && !(image.kScale > 0))
  {
    throw Error(
      "k is 0, so the light in the plane of the cutoff has no scale to make waves of. Set "
      "KScale to more than 0, or "
      "LightModel to Rays.");
  }
  image.lightNote = noteOnRays(scene.cutoff, screen.wavelength * image.kScale);
  const Imaging imaging =
    imagingOf(scene, image.kScale, screen.wavelength, frame_.pixelSize, request_.field.lengthScale);
  if (imaging.mask)
  {
    image.undisturbedLevel = undisturbedLight(imaging);
  }
  return lightInFocus(light, screen, imaging, monitor, image.waves);
}

template <class Real>
bool WaveStage<Real>::run(Image& image)
{
  if (!areWanted())
  {
    rays_.clear();
    return true;
  }
  Screen screen = screenOf(image);
  LightAtExit light;
  if (!trace(image, screen, light))
  {
    return false;
  }
  rays_.finish();
  continueBehindBodies(light);
  const std::vector<float> values = makeLight(light, screen, withoutPauses(), image);
  if (values.empty())
  {
    return false;
  }
  std::copy(values.begin(), values.end(), image.intensity.begin());
  image.lightModel = LightModel::Waves;
  return true;
}

template class WaveStage<float>;
template class WaveStage<double>;

} // namespace schlieren
