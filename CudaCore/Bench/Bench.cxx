// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Stages.h"

#include "Bench/MovedLight.h"
#include "Bench/PassLoop.h"
#include "Bench/StageSettings.h"
#include "Bench/Validation.h"
#include "Bench/WaveScene.h"
#include "Bench/WaveStage.h"
#include "Device/DeviceError.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// How much of an image's progress belongs to making the medium's voxels, where some are to be made.
constexpr double fractionOfVoxels = 0.3;

Monitor monitorOfVoxels(UnfinishedImage& request, const Monitor& monitor)
{
  Monitor ofTree;
  ofTree.aborted = monitor.aborted;
  if (monitor.progress)
  {
    ofTree.progress = [&request, &monitor](double fraction)
    {
      request.progressOfVoxels = fractionOfVoxels;
      monitor.progress(request.progressAt(fractionOfVoxels * fraction));
    };
  }
  return ofTree;
}

} // namespace

template <class Real>
std::optional<ViewSetup<Real>> Bench::Stages::setUp(
  MediumInUse<Real>& inUse, UnfinishedImage& request, const Watch& watch)
{
  const Field& field = request.field;
  Scene& scene = request.scene;
  const Frame frame = frameOf(field.grid, scene.view);
  const auto faces = [&]
  { return exitFacesOf(scene, inUse.medium().ambient, inUse.medium().largestN); };
  Light light = lightOf(scene, field.grid, frame, faces());
  if (field.source)
  {
    const std::int64_t around = pixelsOfFresnelMargin(field, scene, frame, light.faces);
    inUse.refine(columnOf(scene, light, frame, around), monitorOfVoxels(request, watch.monitor()));
    light.faces = faces(); // of all voxels
  }
  if (watch.isAborted())
  {
    return {};
  }
  if (inUse.seesChange())
  {
    clearRays();
    request.beginAnew();
  }

  MediumOnDevices<Real>& onDevices = inUse.onDevices();
  const Medium<Real>& medium = onDevices.medium;
  const RaySettings settings = settingsOf(scene, field.lengthScale, medium.steepest.perVoxel);
  ViewKey key{ frame, scene.view.width, scene.view.height, settings.kernel,
    LightKey::of(scene, frame, filmDistance(scene, frame, light.faces), light.faces),
    onDevices.changes };
  const Tracer<Real> tracer(onDevices, request.device, processes, scene.threads);
  const auto coarseTask = [&]
  {
    RaySettings coarse = settings;
    coarse.stepVoxels = longestStep;
    coarse.adaptiveTolerance = std::max(settings.adaptiveTolerance, usualTolerance);
    return makeTask(medium, light, coarse);
  };
  const auto look = [&] { return lookAtLight(tracer, coarseTask(), scene.view); };
  if (scene.choosesScreen && !scene.screenDistance &&
    techniqueOf(scene.cutoff).plane == RecordedPlane::Screen)
  {
    scene.screenDistance = screenDistanceFor(lookAtNeighbours(tracer, coarseTask(), scene.view),
      scene, frame, light, light.faces.ratio * noiseFloor(medium, field, light));
    light = lightOf(scene, field.grid, frame, light.faces);
    key.light = LightKey::of(scene, frame, filmDistance(scene, frame, light.faces), light.faces);
  }
  const std::vector<MovedRay> moved =
    isOfCamera(scene.cutoff) ? std::vector<MovedRay>{} : rays.movedIn(key, look);

  const double exitRefractivity = exitRefractivityOf(scene, medium.ambient);
  // Of straight rays all is of first order, and the bend makes nothing longer.
  const bool bends = settings.kernel.path != PathModel::Straight;
  const double ofVoxels = medium.tree ? medium.tree->statistics().deflectionError : 0;
  return ViewSetup<Real>{ onDevices, tracer, key, light, settings,
    makeTask(medium, light, settings), marginFor(moved, scene, frame, light),
    movedInFocus(moved, scene, frame, light), exitRefractivity,
    { light.faces.ratio * noiseFloor(medium, field, light), light.faces.ratio * ofVoxels },
    projectionOf(scene, frame, light, bends ? (1 + exitRefractivity) * field.lengthScale : 0),
    pixelPlacesOf(frame, scene.view, light) };
}

template std::optional<ViewSetup<float>> Bench::Stages::setUp(
  MediumInUse<float>&, UnfinishedImage&, const Watch&);
template std::optional<ViewSetup<double>> Bench::Stages::setUp(
  MediumInUse<double>&, UnfinishedImage&, const Watch&);

Image Bench::Stages::imageOf(const UnfinishedImage& request) const
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
  image.kScale = request.kScale;
  if (techniqueOf(scene.cutoff).plane == RecordedPlane::Screen)
  {
    image.screenDistance = scene.screenDistance.value_or(image.frame.exit - image.frame.entry);
  }
  image.momentumDrift = request.momentumDrift;
  image.accuracy = request.accuracy;
  image.traceSeconds = request.traceSeconds;
  image.processes = processes && request.device == Device::Cpu ? processes->others() + 1 : 1;
  return image;
}

template <class Real>
Image Bench::Stages::imageOf(const UnfinishedImage& request, const ViewSetup<Real>& view) const
{
  const Medium<Real>& medium = view.medium.medium;
  Image image = imageOf(request);
  image.ambient = medium.ambient;
  image.exitRefractivity = view.exitRefractivity;
  image.steepestChange = medium.steepest.perVoxel;
  std::array<double, 3> steepest = medium.steepest.at;
  for (std::size_t axis = 0; axis < 3; ++axis) // bricks and blocks reach beyond the data
  {
    steepest[axis] =
      std::clamp(steepest[axis], 0., static_cast<double>(request.field.grid.dimensions[axis] - 1));
  }
  image.steepestPlace = placeOf(request.field.grid, { steepest[0], steepest[1], steepest[2] });
  image.pathModel = view.settings.kernel.path;
  image.integrator = view.settings.kernel.integrator;
  if (medium.tree)
  {
    image.medium = medium.tree->statistics();
  }
  return image;
}

bool Bench::Stages::develop(UnfinishedImage& request, const Watch& watch, Image& image)
{
  ProgressiveImage& progressive = *request.image;
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
Image Bench::Stages::proceed(UnfinishedImage& request, const Watch& watch)
{
  MediumInUse<Real> inUse(media, request.field, clearedFor(request));
  const std::optional<ViewSetup<Real>> view = setUp(inUse, request, watch);
  if (!view)
  {
    return abortedImage();
  }
  const RaysKey key{ view->key, view->settings, request.scene.seed, request.device,
    pointsOfPixel(request.scene.samplesPerPixel, request.scene, view->light) };
  work.raySets += rays.prepare(key, view->margin) ? 1 : 0;
  const bool hasAllPasses = PassLoop<Real>(*view, request, watch, rays, cutoffs, work).run();
  if (watch.isAborted())
  {
    return abortedImage();
  }
  EdgeStage<Real> edges(*view, request, watch, edgeRays, work);
  const bool hasAll =
    hasAllPasses && request.image->passes() == request.scene.samplesPerPixel && edges.trace(key);
  Image image = imageOf(request, *view);
  image.finished = hasAll;
  if (watch.isAborted() || !develop(request, watch, image))
  {
    return abortedImage();
  }
  if (image.finished)
  {
    edges.paste(image);
    if (!WaveStage<Real>{ *view, request, watch, waveRays, work }.run(image))
    {
      return abortedImage();
    }
  }
  return image;
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
