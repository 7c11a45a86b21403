// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Stages.h"

#include "Bench/Validation.h"
#include "Bench/WaveStage.h"
#include "Device/DeviceError.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// How much of an image's progress belongs to making the medium's voxels, where some are to be made.
constexpr double fractionOfVoxels = 0.3;

template <class Real>
ExitFaces facesOf(const Medium<Real>& medium, const Scene& scene)
{
  return exitFacesOf(scene, medium.ambient, medium.largestN);
}

/// A monitor for making voxels.
Monitor monitorOfVoxels(UnfinishedImage& request, const Monitor& monitor)
{
  Monitor ofTree;
  ofTree.aborted = monitor.aborted;
  if (monitor.progress)
  {
    ofTree.progress = [&request, &monitor](double fraction)
    {
      request.progressOfVoxels = fractionOfVoxels;
      monitor.progress(fractionOfVoxels * fraction);
    };
  }
  return ofTree;
}

/// The most that nu may vary in a cube that counts as homogeneous.
template <class Real>
double homogeneityLimit(const Medium<Real>& medium, const Scene& scene)
{
  // What differs by rounding only is homogeneous.
  constexpr double rounding = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  return std::max(scene.homogeneityTolerance * medium.rangeOfNu, rounding * medium.largestNu);
}

} // namespace

Image Bench::Stages::begin(const UnfinishedImage& request) const
{
  const Scene& scene = request.scene;
  Image image;
  image.width = scene.view.width;
  image.height = scene.view.height;
  image.frame = frameOf(request.field.grid, scene.view);
  image.device = request.device;
  image.deviceNote = request.deviceNote;
  image.threads = threadCount(scene.threads);
  image.samplesPerPixel = scene.samplesPerPixel;
  image.stepSize = scene.stepSize;
  image.processes = request.device == Device::Cpu && processes ? processes->others() + 1 : 1;
  return image;
}

template <class Real>
RaysOfView Bench::Stages::raysFor(MediumOnDevices<Real>& onDevices, const Light& light,
  const UnfinishedImage& request, Image& image)
{
  const Field& field = request.field;
  const Scene& scene = request.scene;
  const Medium<Real>& medium = onDevices.medium;
  image.steepestChange = medium.steepest.perVoxel;
  image.steepestPlace =
    placeOf(field.grid, { medium.steepest.at[0], medium.steepest.at[1], medium.steepest.at[2] });
  const RaySettings settings = settingsOf(scene, field.lengthScale, medium.steepest.perVoxel);
  image.pathModel = settings.kernel.path;
  image.integrator = settings.kernel.integrator;
  const ViewKey key{ image.frame, scene.view.width, scene.view.height, settings.kernel,
    LightKey::of(scene, image.frame, filmDistance(scene, image.frame, light.faces), light.faces),
    onDevices.changes };
  const auto look = [&]
  {
    RaySettings coarse = settings;
    coarse.stepVoxels = longestStep;
    coarse.adaptiveTolerance = std::max(settings.adaptiveTolerance, usualTolerance);
    return lookAtLight(
      makeTask<Real>(medium, nullptr, {}, light, coarse), scene.view, scene.threads);
  };
  const bool mayMove = !isOfCamera(scene.cutoff);
  return { key, settings,
    marginFor(
      mayMove ? rays.movedIn(key, look) : std::vector<MovedRay>{}, scene, image.frame, light) };
}

template <class Real>
RaysOfImage<Real> Bench::Stages::prepareRays(
  MediumOnDevices<Real>& onDevices, const Light& light, UnfinishedImage& request, Image& image)
{
  const Field& field = request.field;
  const Scene& scene = request.scene;
  const View& view = scene.view;
  const Medium<Real>& medium = onDevices.medium;
  const auto [viewKey, settings, margin] = raysFor(onDevices, light, request, image);

  // An adaptive step is as long as the medium lets it be without a map.
  const double skips = field.source || settings.kernel.integrator == Integrator::Adaptive
    ? 0
    : scene.homogeneityTolerance;
  const HomogeneityMap<Real>* map = nullptr;
  if (skips > 0)
  {
    const double limit = homogeneityLimit(medium, scene);
    map = onDevices.mapFor(limit, scene.interpolation, scene.threads);
    image.skippingBound =
      light.faces.ratio * skippingBound(medium, light, limit, scene.interpolation);
  }

  RaysKey key{ image.frame, view.width, view.height, settings, skips, scene.seed, request.device,
    {}, viewKey.light };
  if (field.gradients.count > 0)
  {
    key.gradients = field.gradients.version;
  }
  work.raySets += rays.prepare(key, margin) ? 1 : 0;
  return { onDevices, makeTask<Real>(medium, map, medium.gradientsOf(field), light, settings),
    margin, deflectionErrors(medium, light, field, image),
    projectionFor(settings, light, request, image), pixelPlacesOf(image.frame, scene.view, light),
    lensSpreadOf(scene, image.frame, light.faces, field.lengthScale) };
}

bool Bench::Stages::develop(
  bool hasAllPasses, UnfinishedImage& request, const Watch& watch, Image& image)
{
  ProgressiveImage& progressive = *request.image;
  image.kScale = request.kScale;
  image.momentumDrift = request.momentumDrift;
  image.accuracy = request.accuracy;
  image.traceSeconds = request.traceSeconds;
  image.finished = hasAllPasses && progressive.passes() == request.scene.samplesPerPixel;
  request.hasBeenSilent = !image.finished && !request.isNewImageThere();
  if (request.scene.histogramSize > 0 && !request.hasBeenSilent)
  {
    image.histogram = rays.histogram();
  }
  if (image.finished)
  {
    if (!progressive.finish(image, watch.monitor()))
    {
      return false;
    }
    rays.finish();
    return true;
  }
  if (!request.hasBeenSilent)
  {
    progressive.develop(image);
    request.shown = progressive.passes();
  }
  image.samples = static_cast<int>(request.shown);
  return true;
}

const Scene& Bench::Stages::clearedFor(const UnfinishedImage& request)
{
  if (!media.holds(request.field, request.scene))
  {
    clearRays();
  }
  return request.scene;
}

template <class Real>
Light Bench::Stages::prepareMedium(
  MediumInUse<Real>& inUse, UnfinishedImage& request, const Watch& watch, Image& image)
{
  const Scene& scene = request.scene;
  image.ambient = inUse.medium().ambient;
  image.exitRefractivity = exitRefractivityOf(scene, image.ambient);
  Light light = lightOf(scene, request.field.grid, image.frame, facesOf(inUse.medium(), scene));
  if (request.field.source)
  {
    const std::int64_t around =
      pixelsOfFresnelMargin(request.field, scene, image.frame, light.faces);
    inUse.refine(
      columnOf(scene, light, image.frame, around), monitorOfVoxels(request, watch.monitor()));
    image.medium = inUse.medium().tree->statistics();
  }
  light.faces = facesOf(inUse.medium(), scene); // of all voxels
  return light;
}

template RaysOfView Bench::Stages::raysFor(
  MediumOnDevices<float>&, const Light&, const UnfinishedImage&, Image&);
template RaysOfView Bench::Stages::raysFor(
  MediumOnDevices<double>&, const Light&, const UnfinishedImage&, Image&);
template Light Bench::Stages::prepareMedium(
  MediumInUse<float>&, UnfinishedImage&, const Watch&, Image&);
template Light Bench::Stages::prepareMedium(
  MediumInUse<double>&, UnfinishedImage&, const Watch&, Image&);

template <class Real>
Image Bench::Stages::proceed(UnfinishedImage& request, const Watch& watch)
{
  Image image = begin(request);
  MediumInUse<Real> inUse(media, request.field, clearedFor(request));
  const Light light = prepareMedium(inUse, request, watch, image);
  if (watch.isAborted())
  {
    return abortedImage();
  }
  if (inUse.seesChange())
  {
    clearRays();
    request.beginAnew();
  }

  MediumOnDevices<Real>& medium = inUse.onDevices();
  const RaysOfImage<Real> ofImage = prepareRays(medium, light, request, image);
  const bool hasAllPasses =
    PassLoop<Real>(ofImage, request, watch, rays, cutoffs, processes, work).run();
  if (watch.isAborted())
  {
    return abortedImage();
  }
  if (request.device == Device::Cuda && processes)
  {
    image.processes = processes->ofRays().hasCuda.value_or(false) ? processes->others() + 1 : 1;
  }
  return develop(hasAllPasses, request, watch, image) &&
      (!image.finished ||
        WaveStage<Real>{ medium, light, request, watch, waveRays, work }.run(image))
    ? std::move(image)
    : abortedImage();
}

std::unique_ptr<UnfinishedImage> Bench::Stages::instead(
  const UnfinishedImage& request, const DeviceError& failure)
{
  auto again = std::make_unique<UnfinishedImage>(request.field, request.scene);
  again->accuracy = request.accuracy;
  if (request.keepsRays && dynamic_cast<const OutOfDeviceMemory*>(&failure) != nullptr)
  {
    again->device = request.device;
    again->keepsRays = false;
    return again;
  }
  if (request.device == Device::Cpu || request.scene.device == Device::Cuda)
  {
    return nullptr;
  }
  again->deviceNote = failure.what();
  return again;
}

Image Bench::Stages::render(std::unique_ptr<UnfinishedImage> request, const Monitor& monitor)
{
  const Watch watch(monitor);
  Image image;
  for (bool isDone = false; !isDone;)
  {
    try
    {
      image = request->scene.precision == Precision::Single ? proceed<float>(*request, watch)
                                                            : proceed<double>(*request, watch);
      isDone = true;
    }
    catch (const DeviceError& failure)
    {
      clearRays();
      media.leaveDevice();
      request = instead(*request, failure);
      if (!request)
      {
        throw;
      }
    }
    catch (...) // what another process may have thrown, after some of the rays
    {
      clearRays();
      throw;
    }
  }
  if (!image.finished && !image.aborted)
  {
    unfinished = std::move(request);
  }
  return image;
}

Bench::Bench()
  : stages_(std::make_unique<Stages>())
{
}

Bench::~Bench() = default;
Bench::Bench(Bench&&) noexcept = default;
Bench& Bench::operator=(Bench&&) noexcept = default;

const Work& Bench::work() const { return stages_->work; }

void Bench::setProcesses(Processes* processes) { stages_->processes = processes; }

void Bench::setMedia(std::shared_ptr<SharedMedia> media)
{
  stages_->media.setMedia(std::move(media));
}

void Bench::cancel() { stages_->cancel(); }

bool Bench::isUnfinished() const
{
  return stages_->unfinished != nullptr || stages_->aim.has_value();
}

Image Bench::render(const Field& field, const Scene& scene, const Monitor& monitor)
{
  stages_->cancel();
  validate(field, scene);
  std::string reason;
  const bool hasCuda = scene.device != Device::Cpu && cudaAvailable(&reason);
  if (scene.device == Device::Cuda && !hasCuda)
  {
    throw Error("Device is CUDA, but no CUDA device can be used: " + reason +
      ". Set Device to Auto or CPU, or check the driver with nvidia-smi.");
  }
  const Device device = hasCuda ? Device::Cuda : Device::Cpu;
  if (scene.targetError > 0)
  {
    stages_->beginAim(field, scene, device);
    return stages_->renderAim(monitor);
  }
  auto request = std::make_unique<UnfinishedImage>(field, scene);
  request->device = device;
  return stages_->render(std::move(request), monitor);
}

Image Bench::resume(const Monitor& monitor)
{
  if (!isUnfinished())
  {
    throw Error("There is no unfinished image to resume. Render one.");
  }
  return stages_->aim ? stages_->renderAim(monitor)
                      : stages_->render(std::move(stages_->unfinished), monitor);
}

} // namespace schlieren
