// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The one file that sees every stage: runs them in order and keeps their results.
#include "Bench/CutoffMaker.h"
#include "Bench/MediumCache.h"
#include "Bench/PassLoop.h"
#include "Bench/RayCache.h"
#include "Bench/StageSettings.h"
#include "Bench/TargetError.h"
#include "Bench/UnfinishedImage.h"
#include "Bench/Validation.h"
#include "Bench/Watch.h"
#include "Device/DeviceError.h"
#include "Schlieren.h"

#include <algorithm>
#include <limits>
#include <utility>

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

Projection projectionFor(const RaySettings& settings, const Light& light,
  const UnfinishedImage& request, const Image& image)
{
  // Of straight rays all is of first order, and the bend makes nothing longer.
  const bool bends = settings.kernel.path != PathModel::Straight;
  return projectionOf(request.scene, image.frame, light,
    bends ? (1 + image.exitRefractivity) * request.field.lengthScale : 0);
}

/// The most that nu may vary in a cube that counts as homogeneous.
template <class Real>
double homogeneityLimit(const Medium<Real>& medium, const Scene& scene)
{
  // What differs by rounding only is homogeneous.
  constexpr double rounding = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  return std::max(scene.homogeneityTolerance * medium.rangeOfNu, rounding * medium.largestNu);
}

Image abortedImage()
{
  Image image;
  image.aborted = true;
  return image;
}

template <class Real>
DeflectionErrors deflectionErrors(
  const Medium<Real>& medium, const Light& light, const Field& field, const Image& image)
{
  return { light.faces.ratio * noiseFloor(medium, field, light),
    light.faces.ratio * image.medium.deflectionError };
}

/// What has been found out about an image whose settings are to keep its target error.
struct Aim
{
  Field field;
  Scene
    scene; ///< with the medium and the path model that the target needs, as far as that is known
  Device device;
  std::unique_ptr<UnfinishedImage> request{}; ///< with all settings, once they are found
  bool isPaused = false;
  bool isShown = false; ///< with one ray per pixel
};

/// How the rays of a view are bounded and to be traced.
struct BoundedRays
{
  BoundKey key;
  DisplacementBound bound;
  RaySettings settings;
};

} // namespace

struct Bench::Stages
{
  Work work;
  Processes* processes = nullptr;              ///< null: there are no others
  std::unique_ptr<UnfinishedImage> unfinished; ///< after a pause
  std::optional<Aim> aim;                      ///< likewise, before that
  MediumCache media{ work };
  RayCache rays;
  CutoffMaker cutoffs;
  TargetCache targets;

  void cancel()
  {
    unfinished.reset();
    aim.reset();
  }

  /// Begins an image with a target error, which renderAim() then makes. One that may be paused is first shown with one ray
  /// per pixel.
  void beginAim(const Field& field, const Scene& scene, Device device);
  /// Finds its settings, and then works on it. Keeps what has been found after a pause.
  Image renderAim(const Monitor& monitor);
  Image renderFirst(const Monitor& monitor);

  /// Works on an image until it is finished, aborted or paused, on the device of its scene, and keeps what is left after a
  /// pause.
  Image render(std::unique_ptr<UnfinishedImage> request, const Monitor& monitor);

private:
  /// What finds the settings for an image in this medium.
  template <class Real>
  Pilot<Real>& pilotFor(MediumOnDevices<Real>& onDevices, const Light& light,
    const UnfinishedImage& request, Image& image);
  /// Finds the settings with the medium and the path model of the scene. False if others are needed, which it then writes
  /// into the scene.
  template <class Real>
  bool findSettings(Aim& ofImage, const Watch& watch);

  /// Drops rays, before their medium goes or after it has changed.
  void clearRays()
  {
    rays.clear();
    targets.clear();
  }
  /// Drops them where another medium is to be made.
  const Scene& clearedFor(const UnfinishedImage& request);
  /// How the rays of an image are bounded and to be traced, and where the medium is steepest.
  template <class Real>
  BoundedRays boundRays(MediumOnDevices<Real>& onDevices, const Light& light,
    const UnfinishedImage& request, Image& image);
  /// Finds the medium's voxels that a view needs, and its light.
  template <class Real>
  Light prepareMedium(
    MediumInUse<Real>& inUse, UnfinishedImage& request, const Watch& watch, Image& image);

  /// The same on the device of the request, without an answer to its failures.
  template <class Real>
  Image proceed(UnfinishedImage& request, const Watch& watch);

  /// An image without light.
  Image begin(const UnfinishedImage& request) const;
  /// Finds what the rays of an image are traced by, and drops other rays.
  template <class Real>
  RaysOfImage<Real> prepareRays(
    MediumOnDevices<Real>& medium, const Light& light, UnfinishedImage& request, Image& image);
  /// Writes what there is of an image into it. False if aborted.
  bool develop(bool hasAllPasses, UnfinishedImage& request, const Watch& watch, Image& image);

  /// What replaces a request that a device has failed; null where nothing can.
  static std::unique_ptr<UnfinishedImage> instead(
    const UnfinishedImage& request, const DeviceError& failure);
};

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
BoundedRays Bench::Stages::boundRays(MediumOnDevices<Real>& onDevices, const Light& light,
  const UnfinishedImage& request, Image& image)
{
  const Field& field = request.field;
  const Scene& scene = request.scene;
  const Medium<Real>& medium = onDevices.medium;
  const bool maySkip = !field.source && scene.homogeneityTolerance > 0;
  const double atLeast =
    maySkip ? steepestOf(scene.interpolation) * homogeneityLimit(medium, scene) : 0;
  // Steps for a target error are no longer than those that are tried first.
  const double step = scene.targetError > 0 ? longestStep : scene.stepSize;
  const BoundKey key{ image.frame, scene.view.width, scene.view.height, step, atLeast,
    LightKey::of(scene, image.frame, filmDistance(scene, image.frame, light.faces), light.faces),
    onDevices.changes };
  const DisplacementBound bound =
    rays.boundOf(key, [&] { return boundDisplacement(medium, light, scene.view, step, atLeast); });
  image.displacementBound = bound.displacement;
  image.displacementWithin = bound.withinMedium;
  const SteepestPlace& steepest = onDevices.steepest();
  image.steepestChange = steepest.perVoxel;
  image.steepestPlace = placeOf(field.grid, steepest.at);
  const RaySettings settings =
    settingsOf(scene, field.lengthScale, bound, image.frame, steepest.perVoxel);
  image.pathModel = settings.kernel.path;
  image.integrator = settings.kernel.integrator;
  return { key, bound, settings };
}

template <class Real>
RaysOfImage<Real> Bench::Stages::prepareRays(
  MediumOnDevices<Real>& onDevices, const Light& light, UnfinishedImage& request, Image& image)
{
  const Field& field = request.field;
  const Scene& scene = request.scene;
  const View& view = scene.view;
  const Medium<Real>& medium = onDevices.medium;
  const auto [boundKey, bound, settings] = boundRays(onDevices, light, request, image);

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

  const std::int64_t margin = marginFor(bound, scene, image.frame, light);
  RaysKey key{ image.frame, view.width, view.height, settings, skips, scene.seed, request.device,
    {}, boundKey.light };
  if (field.gradients.count > 0)
  {
    key.gradients = field.gradients.version;
  }
  work.raySets += rays.prepare(key, margin) ? 1 : 0;
  return { onDevices, makeTask<Real>(medium, map, medium.gradientsOf(field), light, settings),
    margin, deflectionErrors(medium, light, field, image),
    projectionFor(settings, light, request, image), image.frame.pixelSize };
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
    inUse.refine(columnOf(scene, light, image.frame), monitorOfVoxels(request, watch.monitor()));
    image.medium = inUse.medium().tree->statistics();
  }
  light.faces = facesOf(inUse.medium(), scene); // of all voxels
  return light;
}

template <class Real>
Pilot<Real>& Bench::Stages::pilotFor(MediumOnDevices<Real>& onDevices, const Light& light,
  const UnfinishedImage& request, Image& image)
{
  const Field& field = request.field;
  const Scene& scene = request.scene;
  const BoundedRays bounded = boundRays(onDevices, light, request, image);
  const Projection projection = projectionFor(bounded.settings, light, request, image);
  return targets.pilotOf<Real>({ bounded.key, bounded.settings.kernel, field.lengthScale,
                                 projection, scene.filmEstimator, scene.seed },
    [&]
    {
      const PilotBench<Real> bench{ &onDevices.medium, light, scene, projection, bounded.settings,
        marginFor(bounded.bound, scene, image.frame, light) };
      return std::make_unique<Pilot<Real>>(
        bench, deflectionErrors(onDevices.medium, light, field, image));
    });
}

template <class Real>
bool Bench::Stages::findSettings(Aim& ofImage, const Watch& watch)
{
  const Field& field = ofImage.field;
  Scene& scene = ofImage.scene;
  UnfinishedImage request(field, scene);
  Image image = begin(request);
  MediumInUse<Real> inUse(media, field, clearedFor(request));
  const Light light = prepareMedium(inUse, request, watch, image);
  if (watch.isAborted())
  {
    return true;
  }
  if (inUse.seesChange())
  {
    clearRays();
  }
  const Medium<Real>& medium = inUse.medium();
  Pilot<Real>& pilot = pilotFor(inUse.onDevices(), light, request, image);
  const double k = scene.kScale.value_or(
    automaticK(pilot.view().strongDeflection, techniqueOf(scene.cutoff).fullScale));
  CutoffMaker maker;
  const Cutoffs cutoff = maker.cutoffOf(scene, k, image.frame.pixelSize);
  if (ofImage.isPaused)
  {
    pilot.resume(cutoff);
  }
  else
  {
    pilot.begin(scene, cutoff);
  }
  const KnownErrors known = knownErrors(
    pilot.bench(), pilot.view(), deflectionErrors(medium, light, field, image).medium, k);
  if (refine(known, image.medium.isMemoryShort, scene))
  {
    return false;
  }
  const bool hasWalls =
    !medium.solid.empty() || (medium.tree && !medium.tree->gasDistances().empty());
  const AccurateSettings chosen =
    chooseFor(pilot, hasWalls, known, targets.lastFor(scene), watch.monitor());
  ofImage.isPaused = pilot.isPaused();
  if (watch.isAborted() || ofImage.isPaused)
  {
    return true;
  }
  targets.keep(scene, chosen);
  Scene accurate = scene;
  accurate.stepSize = chosen.step;
  accurate.adaptiveTolerance = adaptiveToleranceFor(chosen.step, scene.adaptiveTolerance);
  accurate.samplesPerPixel = chosen.samples;
  ofImage.request = std::make_unique<UnfinishedImage>(field, accurate);
  ofImage.request->device = ofImage.device;
  ofImage.request->accuracy = chosen.accuracy;
  return true;
}

void Bench::Stages::beginAim(const Field& field, const Scene& scene, Device device)
{
  aim.emplace(Aim{ field, scene, device });
  Scene& accurate = aim->scene;
  accurate.interpolation = Interpolation::Cubic;
  accurate.homogeneityTolerance = 0;
  if (field.source)
  {
    accurate.mediumTolerance = toleranceForTarget(field, scene);
  }
  media.adopt(field, accurate);
}

Image Bench::Stages::renderFirst(const Monitor& monitor)
{
  Aim ofImage = std::move(*aim);
  aim.reset();
  std::unique_ptr<UnfinishedImage> request = std::move(unfinished);
  if (!request)
  {
    Scene first = ofImage.scene;
    first.targetError = 0;
    first.stepSize = longestStep;
    first.samplesPerPixel = 1;
    request = std::make_unique<UnfinishedImage>(ofImage.field, first);
    request->device = ofImage.device;
  }
  Image image = render(std::move(request), monitor);
  if (!image.aborted)
  {
    ofImage.isShown = image.finished;
    image.finished = false;
    aim = std::move(ofImage);
  }
  return image;
}

Image Bench::Stages::renderAim(const Monitor& monitor)
{
  if (monitor.paused && !aim->isShown)
  {
    return renderFirst(monitor);
  }
  Aim ofImage = std::move(*aim);
  aim.reset();
  {
    const Watch watch(monitor);
    const auto find = [&]
    {
      return ofImage.scene.precision == Precision::Single ? findSettings<float>(ofImage, watch)
                                                          : findSettings<double>(ofImage, watch);
    };
    while (!watch.isAborted() && !find())
    {
    }
  }
  if (ofImage.request)
  {
    return render(std::move(ofImage.request), monitor);
  }
  if (!ofImage.isPaused)
  {
    return abortedImage();
  }
  Image nothing = begin(UnfinishedImage(ofImage.field, ofImage.scene));
  nothing.finished = false;
  aim = std::move(ofImage);
  return nothing;
}

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

  const RaysOfImage<Real> ofImage = prepareRays(inUse.onDevices(), light, request, image);
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
  return develop(hasAllPasses, request, watch, image) ? std::move(image) : abortedImage();
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
