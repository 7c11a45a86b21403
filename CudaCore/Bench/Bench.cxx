// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The one file that sees every stage: runs them in order and keeps their results.
#include "Schlieren.h"

#include "Bench/CutoffMaker.h"
#include "Bench/RayCache.h"
#include "Bench/StageSettings.h"
#include "Bench/Validation.h"
#include "Device/Parallel.h"
#include "Film/ProgressiveImage.h"
#include "Medium/HomogeneityMap.h"
#include "Medium/Medium.h"
#include "Optics/AutomaticK.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/Cuda/CudaTracer.h"
#include "Rays/Ranks/ProcessTracer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <type_traits>
#include <utility>
#include <variant>

namespace schlieren
{

namespace
{

template <class Real>
struct MediumOnDevices
{
  explicit MediumOnDevices(Medium<Real> ofField)
    : medium(std::move(ofField))
  {
  }

  std::atomic<bool> isInUse{ false };
  Medium<Real> medium;
  std::int64_t changes = 0;                      ///< of its voxels
  std::unique_ptr<CudaTracer<Real>> cuda;        ///< once rays have been traced there
  std::unique_ptr<ProcessTracer<Real>> together; ///< once several processes have traced rays

  std::unique_ptr<HomogeneityMap<Real>> map; ///< once something was to be skipped
  double mapTolerance = 0;                   ///< of nu

  ProcessTracer<Real>& processTracer()
  {
    if (!together)
    {
      together = std::make_unique<ProcessTracer<Real>>(medium);
    }
    return *together;
  }

  /// The map for a tolerance.
  const HomogeneityMap<Real>* mapFor(double tolerance, Interpolation interpolation, int threads)
  {
    const Real limit = static_cast<Real>(tolerance);
    if (!map)
    {
      map = std::make_unique<HomogeneityMap<Real>>(
        buildHomogeneityMap(medium, interpolation, limit, threads));
    }
    else if (mapTolerance != tolerance)
    {
      map->setTolerance(limit, threads);
    }
    mapTolerance = tolerance;
    return map.get();
  }
};

constexpr std::int64_t noChange = -1;

/// The medium of a bench.
template <class Real>
struct MediumOfBench
{
  std::shared_ptr<MediumOnDevices<Real>> shared;
  std::int64_t changesSeen = noChange; ///< those that the bench's rays are of
};

template <class Real>
ExitFaces facesOf(const MediumOfBench<Real>& current, const Scene& scene)
{
  const Medium<Real>& medium = current.shared->medium;
  return exitFacesOf(scene, medium.ambient, medium.largestN);
}

/// While it is there, its bench is at work in the medium.
template <class Real>
class InUse
{
public:
  explicit InUse(MediumOnDevices<Real>& medium)
    : medium_(medium)
    , isMine_(!medium.isInUse.exchange(true))
  {
  }
  ~InUse()
  {
    if (isMine_)
    {
      medium_.isInUse = false;
    }
  }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

  explicit operator bool() const { return isMine_; } ///< false: another is

private:
  MediumOnDevices<Real>& medium_;
  bool isMine_;
};

/// A monitor whose answers are the last ones: once it has said stop, it does.
class Watch
{
public:
  explicit Watch(const Monitor& request)
  {
    monitor_.progress = request.progress;
    if (request.aborted)
    {
      monitor_.aborted = [this, &request] { return isAborted_ = isAborted_ || request.aborted(); };
    }
    if (request.paused)
    {
      monitor_.paused = [this, &request] { return isPaused_ = isPaused_ || request.paused(); };
    }
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  const Monitor& monitor() const { return monitor_; }
  bool mayPause() const { return static_cast<bool>(monitor_.paused); }
  bool isAborted() const { return monitor_.aborted && monitor_.aborted(); }
  bool isPaused() const { return monitor_.paused && monitor_.paused(); }

private:
  Monitor monitor_;
  bool isAborted_ = false;
  bool isPaused_ = false;
};

/// Of the progress of an image, what belongs to making the medium's voxels, where some are to be made.
constexpr double fractionOfVoxels = 0.3;

/// A medium that is there as long as a bench uses it.
template <class Real>
using WeakMedium = std::weak_ptr<MediumOnDevices<Real>>;

} // namespace

struct SharedMedia::Entries
{
  struct Entry
  {
    MediumKey key;
    std::variant<WeakMedium<float>, WeakMedium<double>> medium;

    bool isThere() const
    {
      return std::visit([](const auto& current) { return !current.expired(); }, medium);
    }
  };
  std::mutex mutex;
  std::vector<Entry> all;

  void dropThoseGone()
  {
    all.erase(
      std::remove_if(all.begin(), all.end(), [](const Entry& entry) { return !entry.isThere(); }),
      all.end());
  }

  template <class Real>
  std::shared_ptr<MediumOnDevices<Real>> find(const MediumKey& key)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = std::find_if(
      all.begin(), all.end(), [&](const Entry& entry) { return entry.key.tie() == key.tie(); });
    return found != all.end() ? std::get<WeakMedium<Real>>(found->medium).lock() : nullptr;
  }

  template <class Real>
  void add(const MediumKey& key, const std::shared_ptr<MediumOnDevices<Real>>& medium)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    dropThoseGone();
    all.push_back({ key, WeakMedium<Real>(medium) });
  }
};

SharedMedia::SharedMedia()
  : entries_(std::make_unique<Entries>())
{
}

SharedMedia::~SharedMedia() = default;

int SharedMedia::count() const
{
  const std::lock_guard<std::mutex> lock(entries_->mutex);
  entries_->dropThoseGone();
  return static_cast<int>(entries_->all.size());
}

/// What has been requested, and as much of it as there is.
struct Bench::Unfinished
{
  Unfinished(const Field& ofField, const Scene& ofScene)
    : field(ofField)
    , scene(ofScene)
    , image(std::in_place, filmSettingsOf(ofScene))
  {
  }

  const Field field;
  const Scene scene;
  Device device = Device::Cpu;
  std::string deviceNote;
  bool keepsRays = true;                 ///< as far as the budget of memory goes
  std::optional<ProgressiveImage> image; ///< always there
  std::optional<DisplacementBound> bound;
  double kScale = 0;
  double momentumDrift = 0;
  double traceSeconds = 0;
  double progressOfVoxels = 0; ///< fractionOfVoxels where some have been made
  std::int64_t shown = 0;      ///< passes of the last image that was handed out
  bool hasBeenSilent = false;  ///< the last call handed none out

  /// Where the medium has changed under the image.
  void beginAnew()
  {
    image.emplace(filmSettingsOf(scene));
    bound.reset();
    shown = 0;
  }
};

struct Bench::Stages
{
  Work work;
  Processes* processes = nullptr;         ///< null: there are no others
  std::unique_ptr<Unfinished> unfinished; ///< after a pause

  std::shared_ptr<SharedMedia> media; ///< may be null
  std::optional<MediumKey> mediumKey;
  std::variant<std::monostate, MediumOfBench<float>, MediumOfBench<double>> medium;

  RayCache rays;
  CutoffMaker cutoffs;

  template <class Real>
  std::shared_ptr<MediumOnDevices<Real>> makeMedium(const Field& field, const Scene& scene);
  template <class Real>
  MediumOfBench<Real>& prepareMedium(const Field& field, const Scene& scene);
  /// Makes another medium in the place of one that does not do. Where that fails there is none.
  template <class Real>
  void remakeMedium(MediumOfBench<Real>& current, const Field& field, const Scene& scene);
  /// Makes the voxels of a source that a view needs and that are not there. False where these do not fit beside those
  /// of other benches.
  template <class Real>
  bool refineFor(const Column& column, MediumOfBench<Real>& current, const Monitor& monitor,
    Unfinished& request);

  /// Traces a pass, or resumes it, where `request` wants that. False if aborted or paused.
  template <class Real>
  bool trace(TracedPass& traced, bool isWantedOnHost, const Pass& pass,
    MediumOfBench<Real>& current, const RayTask<Real>& task, const Monitor& monitor,
    Unfinished& request);

  /// Works on an image until it is finished, aborted or paused.
  template <class Real>
  Image proceed(Unfinished& request, const Watch& watch);

  /// The same on the device of its scene, and keeps what is left after a pause.
  Image render(std::unique_ptr<Unfinished> request, const Monitor& monitor);

  /// Gives the device's memory back.
  void leaveDevice();
};

template <class Real>
std::shared_ptr<MediumOnDevices<Real>> Bench::Stages::makeMedium(
  const Field& field, const Scene& scene)
{
  ++work.mediumBuilds;
  return std::make_shared<MediumOnDevices<Real>>(field.source
      ? buildTree<Real>(
          field, { scene.mediumTolerance, scene.mediumMemory, scene.interpolation, scene.threads })
      : buildMedium<Real>(field, scene.interpolation, scene.threads));
}

template <class Real>
void Bench::Stages::remakeMedium(
  MediumOfBench<Real>& current, const Field& field, const Scene& scene)
{
  const std::optional<MediumKey> key = std::exchange(mediumKey, std::nullopt);
  current = {}; // first: two media at once might not fit
  current.shared = makeMedium<Real>(field, scene);
  mediumKey = key;
}

template <class Real>
MediumOfBench<Real>& Bench::Stages::prepareMedium(const Field& field, const Scene& scene)
{
  const bool hasSource = field.source != nullptr;
  const void* samples = hasSource ? static_cast<const void*>(field.source.get())
    : field.singles != nullptr    ? static_cast<const void*>(field.singles)
                                  : static_cast<const void*>(field.doubles);
  const Grid& grid = field.grid;
  const MediumKey key{ grid.dimensions, grid.origin, grid.spacing, grid.direction, field.version,
    samples, field.offset, field.ambient, scene.interpolation, scene.precision,
    hasSource ? scene.mediumTolerance : 0, hasSource ? scene.mediumMemory : 0 };
  if (!mediumKey || mediumKey->tie() != key.tie())
  {
    // Freed first: two media at once might not fit.
    mediumKey.reset();
    rays.clear();
    medium = std::monostate{};
    MediumOfBench<Real> current;
    if (media)
    {
      current.shared = media->entries_->find<Real>(key);
    }
    if (!current.shared)
    {
      current.shared = makeMedium<Real>(field, scene);
      if (media)
      {
        media->entries_->add(key, current.shared);
      }
    }
    medium = std::move(current);
    mediumKey = key;
  }
  return std::get<MediumOfBench<Real>>(medium);
}

template <class Real>
bool Bench::Stages::refineFor(
  const Column& column, MediumOfBench<Real>& current, const Monitor& monitor, Unfinished& request)
{
  Monitor ofTree;
  ofTree.aborted = monitor.aborted;
  if (monitor.progress)
  {
    ofTree.progress = [&](double fraction)
    {
      request.progressOfVoxels = fractionOfVoxels;
      monitor.progress(fractionOfVoxels * fraction);
    };
  }
  MediumOnDevices<Real>& shared = *current.shared;
  const Unneeded ofOthers = current.shared.use_count() > 1 ? Unneeded::Stays : Unneeded::Goes;
  if (refine(shared.medium, column, ofTree, ofOthers))
  {
    ++shared.changes;
    shared.cuda.reset();
    shared.together.reset();
  }
  return !shared.medium.tree->lacksRoom();
}

template <class Real>
bool Bench::Stages::trace(TracedPass& traced, bool isWantedOnHost, const Pass& pass,
  MediumOfBench<Real>& current, const RayTask<Real>& task, const Monitor& monitor,
  Unfinished& request)
{
  MediumOnDevices<Real>& shared = *current.shared;
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t countedBefore = traced.tilesDone > 0 ? traced.crossed : 0;
  const std::uint64_t ofGradients = request.field.gradients.version;
  bool isTraced = false;
  if (request.device == Device::Cuda)
  {
    if (!shared.cuda)
    {
      shared.cuda = std::make_unique<CudaTracer<Real>>(shared.medium);
    }
    using Exits = typename CudaTracer<Real>::Exits;
    const Exits exits = isWantedOnHost ? Exits::OnHost : Exits::OnDevice;
    const TaskVersions versions{ ofGradients, shared.mapTolerance };
    isTraced = processes && ProcessTracer<Real>::haveCuda(*processes)
      ? shared.processTracer().traceOnCuda(
          *shared.cuda, exits, task, pass, versions, *processes, traced, monitor)
      : shared.cuda->trace(task, pass, versions, exits, traced, monitor);
  }
  else if (processes)
  {
    isTraced = shared.processTracer().trace(task, pass, { ofGradients, shared.mapTolerance },
      *processes, traced, request.scene.threads, monitor);
  }
  else
  {
    isTraced = traceOnCpu(task, pass, traced, request.scene.threads, monitor);
  }
  request.traceSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (isTraced || request.device == Device::Cpu)
  {
    work.raysTraced += traced.crossed - countedBefore;
  }
  return isTraced;
}

template <class Real>
Image Bench::Stages::proceed(Unfinished& request, const Watch& watch)
{
  Image aborted;
  aborted.aborted = true;

  const Field& field = request.field;
  const Scene& scene = request.scene;
  const View& view = scene.view;
  Image image;
  image.width = view.width;
  image.height = view.height;
  image.frame = frameOf(field.grid, view);
  image.device = request.device;
  image.deviceNote = request.deviceNote;
  image.threads = threadCount(scene.threads);
  image.processes = request.device == Device::Cpu && processes ? processes->others() + 1 : 1;

  MediumOfBench<Real>& current = prepareMedium<Real>(field, scene);
  std::optional<InUse<Real>> inUse(std::in_place, *current.shared);
  const auto useOwn = [&]
  {
    inUse.reset();
    remakeMedium(current, field, scene);
    inUse.emplace(*current.shared);
  };
  if (!*inUse)
  {
    useOwn();
  }
  image.ambient = current.shared->medium.ambient;
  image.exitRefractivity = exitRefractivityOf(scene, image.ambient);
  Light light = lightOf(scene, field.grid, image.frame, facesOf(current, scene));
  if (field.source)
  {
    const Column column = columnOf(scene, light, image.frame);
    if (!refineFor(column, current, watch.monitor(), request))
    {
      useOwn();
      refineFor(column, current, watch.monitor(), request);
    }
    image.medium = current.shared->medium.tree->statistics();
    if (watch.isAborted())
    {
      return aborted;
    }
  }
  if (current.changesSeen != current.shared->changes)
  {
    current.changesSeen = current.shared->changes;
    rays.clear();
    request.beginAnew();
  }
  const Medium<Real>& tracedMedium = current.shared->medium;
  light.faces = facesOf(current, scene); // of all voxels
  // What differs by rounding only is homogeneous.
  constexpr double rounding = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  const double tolerance = std::max(
    scene.homogeneityTolerance * tracedMedium.rangeOfNu, rounding * tracedMedium.largestNu);
  if (!request.bound)
  {
    const bool maySkip = !field.source && scene.homogeneityTolerance > 0;
    request.bound = boundDisplacement(tracedMedium, light, view, scene.stepSize,
      maySkip ? steepestOf(scene.interpolation) * tolerance : 0);
  }
  const DisplacementBound& bound = *request.bound;
  image.displacementBound = bound.displacement;
  image.displacementWithin = bound.withinMedium;
  const SteepestPlace steepest = findSteepest(tracedMedium.slopes);
  image.steepestChange = steepest.perVoxel;
  image.steepestPlace = placeOf(field.grid, steepest.at);
  const RaySettings settings =
    settingsOf(scene, field.lengthScale, bound, image.frame, steepest.perVoxel);
  image.pathModel = settings.kernel.path;
  image.integrator = settings.kernel.integrator;
  // An adaptive step is as long as the medium lets it be without a map.
  const double skips = field.source || settings.kernel.integrator == Integrator::Adaptive
    ? 0
    : scene.homogeneityTolerance;
  const HomogeneityMap<Real>* map =
    skips > 0 ? current.shared->mapFor(tolerance, scene.interpolation, scene.threads) : nullptr;
  image.skippingBound = map == nullptr
    ? 0
    : light.faces.ratio * skippingBound(tracedMedium, light, tolerance, scene.interpolation);
  const RayTask<Real> task =
    makeTask<Real>(tracedMedium, map, tracedMedium.gradientsOf(field), light, settings);

  const std::int64_t margin = marginFor(bound, scene, image.frame, light);
  RaysKey key{ image.frame, view.width, view.height, settings, skips, scene.seed, request.device,
    {},
    LightKey::of(scene, image.frame, filmDistance(scene, image.frame, light.faces), light.faces) };
  if (field.gradients.count > 0)
  {
    key.gradients = field.gradients.version;
  }
  work.raySets += rays.prepare(key, margin) ? 1 : 0;
  const std::int64_t around = rays.margin();
  Pass pass{ -around, -around, view.width + 2 * around, view.height + 2 * around, { 0, 0 } };

  const DeflectionErrors errors{ light.faces.ratio * noiseFloor(tracedMedium, field, light),
    light.faces.ratio * image.medium.deflectionError };
  ProgressiveImage& progressive = *request.image;
  const auto isNewImageThere = [&]
  { return progressive.isWhole() && progressive.passes() > request.shown; };
  bool continues = !watch.mayPause() || progressive.completeUndisturbed(watch.monitor());
  while (continues && progressive.passes() < scene.samplesPerPixel)
  {
    // What has taken more than a call is shown before the next pass hides it.
    if (watch.mayPause() && request.hasBeenSilent && isNewImageThere())
    {
      break;
    }
    const std::int64_t number = progressive.passes();
    Monitor ofPass = watch.monitor();
    if (ofPass.progress)
    {
      ofPass.progress = [&](double fraction)
      {
        const double done = (static_cast<double>(number) + fraction) / scene.samplesPerPixel;
        watch.monitor().progress(request.progressOfVoxels + (1 - request.progressOfVoxels) * done);
      };
    }
    aimPass(pass, number, scene, light);
    const double tracedBefore = request.traceSeconds;
    const TracedPass* traced = rays.raysOf(number, pass, request.device, field.gradients.count,
      request.keepsRays ? scene.memoryBudget : 0,
      [&](TracedPass& place, bool isWantedOnHost)
      { return trace(place, isWantedOnHost, pass, current, task, ofPass, request); });
    const bool hasTraced = request.traceSeconds > tracedBefore;
    if (traced == nullptr || watch.isAborted() || (hasTraced && watch.isPaused()))
    {
      continues = false;
      break;
    }
    request.momentumDrift = std::max(request.momentumDrift, traced->worstDrift);
    const TracedRays ofTraced{ pass, traced->exits.data(), traced->gathered.data() };
    rays.request(*traced, ofTraced, number, scene, errors);
    if (!progressive.isBegun())
    {
      if (techniqueOf(scene.cutoff).hasK())
      {
        request.kScale = scene.kScale
          ? *scene.kScale
          : automaticK(rays.strongDeflection(), techniqueOf(scene.cutoff).fullScale);
      }
      progressive.begin(
        { cutoffs.cutoffOf(scene, request.kScale, image.frame.pixelSize),
          projectionOf(scene, image.frame, light, (1 + image.exitRefractivity) * field.lengthScale),
          margin,
          (view.width + 2 * margin) * (view.height + 2 * margin) *
            passesToHold(scene.samplesPerPixel) },
        rays.tintOf(ofTraced, field, scene));
    }
    ofPass.progress = {};
    continues =
      progressive.add(*traced, pass, rays.holds(*traced) ? Rays::Stay : Rays::Go, ofPass) &&
      (!watch.mayPause() || progressive.completeUndisturbed(ofPass));
    if (watch.isPaused())
    {
      break;
    }
  }
  if (watch.isAborted())
  {
    return aborted;
  }
  if (request.device == Device::Cuda && processes)
  {
    image.processes = processes->ofRays().hasCuda.value_or(false) ? processes->others() + 1 : 1;
  }
  image.kScale = request.kScale;
  image.momentumDrift = request.momentumDrift;
  image.traceSeconds = request.traceSeconds;
  image.finished = continues && progressive.passes() == scene.samplesPerPixel;
  request.hasBeenSilent = !image.finished && !isNewImageThere();
  if (scene.histogramSize > 0 && !request.hasBeenSilent)
  {
    image.histogram = rays.histogram();
  }
  if (image.finished)
  {
    if (!progressive.finish(image, watch.monitor()))
    {
      return aborted;
    }
    rays.finish();
    return image;
  }
  if (!request.hasBeenSilent)
  {
    progressive.develop(image);
    request.shown = progressive.passes();
  }
  image.samples = static_cast<int>(request.shown);
  return image;
}

void Bench::Stages::leaveDevice()
{
  rays.clear();
  std::visit(
    [](auto& current)
    {
      if constexpr (!std::is_same_v<std::decay_t<decltype(current)>, std::monostate>)
      {
        if (current.shared)
        {
          current.shared->cuda.reset();
        }
      }
    },
    medium);
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

void Bench::setMedia(std::shared_ptr<SharedMedia> media) { stages_->media = std::move(media); }

void Bench::cancel() { stages_->unfinished.reset(); }

bool Bench::isUnfinished() const { return stages_->unfinished != nullptr; }

Image Bench::render(const Field& field, const Scene& scene, const Monitor& monitor)
{
  stages_->unfinished.reset();
  validate(field, scene);
  auto request = std::make_unique<Unfinished>(field, scene);
  std::string reason;
  const bool hasCuda = scene.device != Device::Cpu && cudaAvailable(&reason);
  if (scene.device == Device::Cuda && !hasCuda)
  {
    throw Error("Device is CUDA, but no CUDA device can be used: " + reason +
      ". Set Device to Auto or CPU, or check the driver with nvidia-smi.");
  }
  request->device = hasCuda ? Device::Cuda : Device::Cpu;
  return stages_->render(std::move(request), monitor);
}

Image Bench::resume(const Monitor& monitor)
{
  if (!isUnfinished())
  {
    throw Error("There is no unfinished image to resume. Render one.");
  }
  return stages_->render(std::move(stages_->unfinished), monitor);
}

Image Bench::Stages::render(std::unique_ptr<Unfinished> request, const Monitor& monitor)
{
  const Watch watch(monitor);
  const auto proceedWith = [&](Unfinished& one)
  {
    return one.scene.precision == Precision::Single ? proceed<float>(one, watch)
                                                    : proceed<double>(one, watch);
  };
  Image image;
  for (bool isDone = false; !isDone;)
  {
    try
    {
      image = proceedWith(*request);
      isDone = true;
    }
    catch (const DeviceError& failure)
    {
      leaveDevice();
      auto again = std::make_unique<Unfinished>(request->field, request->scene);
      if (request->keepsRays && dynamic_cast<const OutOfDeviceMemory*>(&failure) != nullptr)
      {
        again->device = request->device;
        again->keepsRays = false;
      }
      else if (request->device == Device::Cpu || request->scene.device == Device::Cuda)
      {
        throw;
      }
      else
      {
        again->deviceNote = failure.what();
      }
      request = std::move(again);
    }
    catch (...) // what another process may have thrown, after some of the rays
    {
      rays.clear();
      throw;
    }
  }
  if (!image.finished && !image.aborted)
  {
    unfinished = std::move(request);
  }
  return image;
}

} // namespace schlieren
