// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The one file that sees every stage: runs them in order and keeps their results.
#include "Schlieren.h"

#include "Device/Parallel.h"
#include "Film/ProgressiveImage.h"
#include "Medium/HomogeneityMap.h"
#include "Medium/Medium.h"
#include "Optics/AutomaticK.h"
#include "Optics/CutoffMaker.h"
#include "RayCache.h"
#include "Rays/CudaTracer.h"
#include "Rays/DistributedRays.h"
#include "Rays/DistributedTracer.h"
#include "Rays/TeamTracer.h"
#include "Rays/Tracer.h"
#include "StageSettings.h"
#include "Validation.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <type_traits>
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
  std::int64_t changes = 0;               ///< of its voxels
  std::unique_ptr<CudaTracer<Real>> cuda; ///< once rays have been traced there

  std::unique_ptr<HomogeneityMap<Real>> map; ///< once something was to be skipped
  double mapTolerance = 0;                   ///< of nu

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
  std::int64_t changesSeen = noChange;    ///< those that the bench's rays are of
  std::unique_ptr<TeamTracer<Real>> team; ///< once rays have been traced together with workers
  // Where processes have a part of the medium each, which is then shared with no other bench.
  std::shared_ptr<BrickChannels> owners;
  std::unique_ptr<DistributedTracer<Real>> distributed; ///< once rays have been traced
};

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
  explicit Watch(const Monitor& asked)
  {
    monitor_.progress = asked.progress;
    if (asked.aborted)
    {
      monitor_.aborted = [this, &asked] { return isAborted_ = isAborted_ || asked.aborted(); };
    }
    if (asked.paused)
    {
      monitor_.paused = [this, &asked] { return isPaused_ = isPaused_ || asked.paused(); };
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
      return std::visit([](const auto& held) { return !held.expired(); }, medium);
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

/// What has been asked for, and as much of it as there is.
struct Bench::Unfinished
{
  Unfinished(const Field& ofField, const Scene& ofScene)
    : field(ofField)
    , scene(ofScene)
    , image(std::in_place, ofScene)
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

  /// Where the medium has changed under the progressive.
  void beginAnew()
  {
    image.emplace(scene);
    bound.reset();
    shown = 0;
  }
};

struct Bench::Stages
{
  Work work;
  std::vector<Channel*> workers;
  std::unique_ptr<Unfinished> unfinished; ///< after a pause

  std::shared_ptr<SharedMedia> media; ///< may be null
  std::optional<MediumKey> mediumKey;
  std::variant<std::monostate, MediumOfBench<float>, MediumOfBench<double>> medium;

  RayCache rays;
  CutoffMaker cutoffs;

  /// `owners`: may be null.
  template <class Real>
  std::shared_ptr<MediumOnDevices<Real>> makeMedium(
    const Field& field, const Scene& scene, const std::shared_ptr<BrickOwners>& owners);
  template <class Real>
  MediumOfBench<Real>& prepareMedium(
    const Field& field, const Scene& scene, DistributedMedium distribution);
  template <class Real>
  void distributeMedium(MediumOfBench<Real>& held, const Field& field, const Scene& scene);
  /// What the scene asks for, where it can be had.
  DistributedMedium distributionFor(const Unfinished& asked) const;
  /// Makes the voxels of a source that a view needs and that are not there. False where these do not fit beside those
  /// of other benches.
  template <class Real>
  bool refineFor(
    const Column& column, MediumOfBench<Real>& held, const Monitor& monitor, Unfinished& asked);

  /// Traces a pass, or goes on with it, where `asked` wants that. False if aborted or paused.
  template <class Real>
  bool trace(TracedPass& traced, bool isWantedOnHost, const Pass& pass, MediumOfBench<Real>& held,
    const RayTask<Real>& task, const Monitor& monitor, Unfinished& asked);

  /// Goes on with an image, until it is finished, aborted or paused.
  template <class Real>
  Image goOn(Unfinished& asked, const Watch& watch);

  /// The same on the device of its scene, and keeps what is left after a pause.
  Image render(std::unique_ptr<Unfinished> asked, const Monitor& monitor);

  /// Gives the device's memory back.
  void leaveDevice();

  /// After an error: processes may have lost their parts of it.
  void forgetDistributedMedium();
};

DistributedMedium Bench::Stages::distributionFor(const Unfinished& asked) const
{
  const Field& field = asked.field;
  const Scene& scene = asked.scene;
  const bool canDistribute = !workers.empty() && asked.device == Device::Cpu && field.source &&
    field.source->fields() == 0 &&
    canSuspend({ scene.pathModel, scene.integrator, scene.interpolation });
  return canDistribute ? scene.distributedMedium : DistributedMedium::Off;
}

template <class Real>
std::shared_ptr<MediumOnDevices<Real>> Bench::Stages::makeMedium(
  const Field& field, const Scene& scene, const std::shared_ptr<BrickOwners>& owners)
{
  ++work.mediumBuilds;
  return std::make_shared<MediumOnDevices<Real>>(field.source
      ? buildTree<Real>(field,
          { scene.mediumTolerance, scene.mediumMemory, scene.interpolation, scene.threads, owners })
      : buildMedium<Real>(field, scene.interpolation, scene.threads));
}

template <class Real>
void Bench::Stages::distributeMedium(
  MediumOfBench<Real>& held, const Field& field, const Scene& scene)
{
  held = {}; // first: two media at once might not fit
  held.owners = std::make_shared<BrickChannels>(workers);
  held.shared = makeMedium<Real>(field, scene, held.owners);
}

template <class Real>
MediumOfBench<Real>& Bench::Stages::prepareMedium(
  const Field& field, const Scene& scene, DistributedMedium distribution)
{
  const bool hasSource = field.source != nullptr;
  const void* samples = hasSource ? static_cast<const void*>(field.source.get())
    : field.singles != nullptr    ? static_cast<const void*>(field.singles)
                                  : static_cast<const void*>(field.doubles);
  const Grid& grid = field.grid;
  const MediumKey key{ grid.dimensions, grid.origin, grid.spacing, grid.direction, field.version,
    samples, field.ambient, scene.interpolation, scene.precision,
    hasSource ? scene.mediumTolerance : 0, hasSource ? scene.mediumMemory : 0, distribution };
  const auto* before = std::get_if<MediumOfBench<Real>>(&medium);
  const bool haveOwnersChanged =
    before != nullptr && before->owners && before->owners->channels() != workers;
  if (!mediumKey || mediumKey->tie() != key.tie() || haveOwnersChanged)
  {
    // Given up first: two media at once might not fit.
    mediumKey.reset();
    rays.clear();
    medium = std::monostate{};
    MediumOfBench<Real> held;
    if (distribution == DistributedMedium::On)
    {
      distributeMedium(held, field, scene);
    }
    else if (media)
    {
      held.shared = media->entries_->find<Real>(key);
    }
    if (!held.shared)
    {
      held.shared = makeMedium<Real>(field, scene, nullptr);
      if (media)
      {
        media->entries_->add(key, held.shared);
      }
    }
    medium = std::move(held);
    mediumKey = key;
  }
  return std::get<MediumOfBench<Real>>(medium);
}

template <class Real>
bool Bench::Stages::refineFor(
  const Column& column, MediumOfBench<Real>& held, const Monitor& monitor, Unfinished& asked)
{
  Monitor ofTree;
  ofTree.aborted = monitor.aborted;
  if (monitor.progress)
  {
    ofTree.progress = [&](double fraction)
    {
      asked.progressOfVoxels = fractionOfVoxels;
      monitor.progress(fractionOfVoxels * fraction);
    };
  }
  MediumOnDevices<Real>& shared = *held.shared;
  const Unneeded ofOthers = held.shared.use_count() > 1 ? Unneeded::Stays : Unneeded::Goes;
  if (refine(shared.medium, column, ofTree, ofOthers))
  {
    ++shared.changes;
    shared.cuda.reset();
  }
  return !shared.medium.tree->lacksRoom();
}

template <class Real>
bool Bench::Stages::trace(TracedPass& traced, bool isWantedOnHost, const Pass& pass,
  MediumOfBench<Real>& held, const RayTask<Real>& task, const Monitor& monitor, Unfinished& asked)
{
  MediumOnDevices<Real>& shared = *held.shared;
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t countedBefore = traced.tilesDone > 0 ? traced.crossed : 0;
  const std::uint64_t ofGradients = asked.field.gradients.version;
  bool isTraced = false;
  if (asked.device == Device::Cuda)
  {
    if (!shared.cuda)
    {
      shared.cuda = std::make_unique<CudaTracer<Real>>(shared.medium);
    }
    using Exits = typename CudaTracer<Real>::Exits;
    isTraced = shared.cuda->trace(task, pass, { ofGradients, shared.mapTolerance },
      isWantedOnHost ? Exits::OnHost : Exits::OnDevice, traced, monitor);
  }
  else if (held.owners)
  {
    if (!held.distributed)
    {
      held.distributed = std::make_unique<DistributedTracer<Real>>(shared.medium, *held.owners);
    }
    isTraced = held.distributed->trace(task, pass, traced, asked.scene.threads, monitor);
  }
  else if (!workers.empty())
  {
    if (!held.team)
    {
      held.team = std::make_unique<TeamTracer<Real>>(shared.medium);
    }
    isTraced = held.team->trace(task, pass, { ofGradients, shared.mapTolerance }, workers, traced,
      asked.scene.threads, monitor);
  }
  else
  {
    isTraced = traceOnCpu(task, pass, traced, asked.scene.threads, monitor);
  }
  asked.traceSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (isTraced || asked.device == Device::Cpu)
  {
    work.raysTraced += traced.crossed - countedBefore;
  }
  return isTraced;
}

template <class Real>
Image Bench::Stages::goOn(Unfinished& asked, const Watch& watch)
{
  Image aborted;
  aborted.aborted = true;

  const Field& field = asked.field;
  const Scene& scene = asked.scene;
  const View& view = scene.view;
  Image image;
  image.width = view.width;
  image.height = view.height;
  image.frame = frameOf(field.grid, view);
  image.device = asked.device;
  image.deviceNote = asked.deviceNote;
  image.threads = threadCount(scene.threads);
  image.workers = asked.device == Device::Cpu ? static_cast<int>(workers.size()) : 0;

  const DistributedMedium distribution = distributionFor(asked);
  MediumOfBench<Real>& held = prepareMedium<Real>(field, scene, distribution);
  std::optional<InUse<Real>> inUse(std::in_place, *held.shared);
  const auto useOwn = [&]
  {
    inUse.reset();
    held.team.reset();
    held.distributed.reset();
    held.owners.reset();
    held.shared = makeMedium<Real>(field, scene, nullptr);
    held.changesSeen = noChange;
    inUse.emplace(*held.shared);
  };
  if (!*inUse)
  {
    useOwn();
  }
  image.ambient = held.shared->medium.ambient;
  const Light light = lightOf(scene, field.grid, image.frame);
  if (field.source)
  {
    const Column column = columnOf(scene, light, image.frame);
    if (!refineFor(column, held, watch.monitor(), asked))
    {
      useOwn();
      refineFor(column, held, watch.monitor(), asked);
    }
    const auto isMemoryShort = [&] { return held.shared->medium.tree->statistics().isMemoryShort; };
    if (distribution == DistributedMedium::Auto && !held.owners && isMemoryShort() &&
      !watch.isAborted())
    {
      inUse.reset();
      distributeMedium(held, field, scene);
      inUse.emplace(*held.shared);
      refineFor(column, held, watch.monitor(), asked);
    }
    image.medium = held.shared->medium.tree->statistics();
    if (watch.isAborted())
    {
      return aborted;
    }
  }
  if (held.changesSeen != held.shared->changes)
  {
    held.changesSeen = held.shared->changes;
    held.team.reset();
    held.distributed.reset();
    rays.clear();
    asked.beginAnew();
  }
  const Medium<Real>& ofHeld = held.shared->medium;
  // What differs by rounding only is homogeneous.
  constexpr double rounding = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  const double tolerance =
    std::max(scene.homogeneityTolerance * ofHeld.rangeOfNu, rounding * ofHeld.largestNu);
  if (!asked.bound)
  {
    const bool maySkip = !field.source && scene.homogeneityTolerance > 0;
    asked.bound = boundDisplacement(ofHeld, light, view, scene.stepSize,
      maySkip ? steepestOf(scene.interpolation) * tolerance : 0);
  }
  const DisplacementBound& bound = *asked.bound;
  image.displacementBound = bound.displacement;
  image.displacementWithin = bound.withinMedium;
  const RaySettings settings = settingsOf(scene, field.lengthScale, bound, image.frame);
  image.pathModel = settings.kernel.path;
  // An adaptive step is as long as the medium lets it be without a map.
  const double skips = field.source || settings.kernel.integrator == Integrator::Adaptive
    ? 0
    : scene.homogeneityTolerance;
  const HomogeneityMap<Real>* map =
    skips > 0 ? held.shared->mapFor(tolerance, scene.interpolation, scene.threads) : nullptr;
  image.skippingBound =
    map == nullptr ? 0 : skippingBound(ofHeld, light, tolerance, scene.interpolation);
  const RayTask<Real> task =
    makeTask<Real>(ofHeld, map, ofHeld.gradientsOf(field), light, settings);

  const std::int64_t margin = marginFor(bound, scene, image.frame);
  RaysKey key{ image.frame, view.width, view.height, settings, skips, scene.seed, asked.device, {},
    LightKey::of(scene, filmDistance(scene, image.frame)) };
  if (field.gradients.count > 0)
  {
    key.gradients = field.gradients.version;
  }
  work.raySets += rays.prepare(key, margin) ? 1 : 0;
  const std::int64_t around = rays.margin();
  Pass pass{ -around, -around, view.width + 2 * around, view.height + 2 * around, { 0, 0 } };

  const DeflectionErrors errors{ noiseFloor(ofHeld, field, light), image.medium.deflectionError };
  ProgressiveImage& progressive = *asked.image;
  const auto isNewImageThere = [&]
  { return progressive.isWhole() && progressive.passes() > asked.shown; };
  bool goesOn = !watch.mayPause() || progressive.completeUndisturbed(watch.monitor());
  while (goesOn && progressive.passes() < scene.samplesPerPixel)
  {
    // What has taken more than a call is shown before the next pass hides it.
    if (watch.mayPause() && asked.hasBeenSilent && isNewImageThere())
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
        watch.monitor().progress(asked.progressOfVoxels + (1 - asked.progressOfVoxels) * done);
      };
    }
    aimPass(pass, number, scene, light);
    const double tracedBefore = asked.traceSeconds;
    const TracedPass* traced = rays.raysOf(number, pass, asked.device, field.gradients.count,
      asked.keepsRays ? scene.memoryBudget : 0,
      [&](TracedPass& place, bool isWantedOnHost)
      { return trace(place, isWantedOnHost, pass, held, task, ofPass, asked); });
    const bool hasTraced = asked.traceSeconds > tracedBefore;
    if (traced == nullptr || watch.isAborted() || (hasTraced && watch.isPaused()))
    {
      goesOn = false;
      break;
    }
    asked.momentumDrift = std::max(asked.momentumDrift, traced->worstDrift);
    const TracedRays ofTraced{ pass, traced->exits.data(), traced->gathered.data() };
    rays.ask(*traced, ofTraced, number, scene, errors);
    if (!progressive.isBegun())
    {
      if (techniqueOf(scene.cutoff).hasK())
      {
        asked.kScale = scene.kScale
          ? *scene.kScale
          : automaticK(rays.strongDeflection(), techniqueOf(scene.cutoff).fullScale);
      }
      progressive.begin(
        { cutoffs.cutoffOf(scene, asked.kScale, image.frame.pixelSize),
          projectionOf(scene, image.frame, light, (1 + ofHeld.ambient) * field.lengthScale), margin,
          (view.width + 2 * margin) * (view.height + 2 * margin) *
            passesToHold(scene.samplesPerPixel) },
        rays.tintOf(ofTraced, field, scene));
    }
    ofPass.progress = {};
    goesOn = progressive.add(*traced, pass, rays.holds(*traced) ? Rays::Stay : Rays::Go, ofPass) &&
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
  image.kScale = asked.kScale;
  image.momentumDrift = asked.momentumDrift;
  image.traceSeconds = asked.traceSeconds;
  image.finished = goesOn && progressive.passes() == scene.samplesPerPixel;
  asked.hasBeenSilent = !image.finished && !isNewImageThere();
  if (scene.histogramSize > 0 && !asked.hasBeenSilent)
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
  if (!asked.hasBeenSilent)
  {
    progressive.develop(image);
    asked.shown = progressive.passes();
  }
  image.samples = static_cast<int>(asked.shown);
  return image;
}

void Bench::Stages::leaveDevice()
{
  rays.clear();
  std::visit(
    [](auto& held)
    {
      if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
      {
        held.shared->cuda.reset();
      }
    },
    medium);
}

void Bench::Stages::forgetDistributedMedium()
{
  const bool isDistributed = std::visit(
    [](const auto& held)
    {
      if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
      {
        return held.owners != nullptr;
      }
      return false;
    },
    medium);
  if (isDistributed)
  {
    mediumKey.reset();
    rays.clear();
    medium = std::monostate{};
  }
}

Bench::Bench()
  : stages_(std::make_unique<Stages>())
{
}

Bench::~Bench() = default;
Bench::Bench(Bench&&) noexcept = default;
Bench& Bench::operator=(Bench&&) noexcept = default;

const Work& Bench::work() const { return stages_->work; }

void Bench::setWorkers(std::vector<Channel*> workers) { stages_->workers = std::move(workers); }

void Bench::setMedia(std::shared_ptr<SharedMedia> media) { stages_->media = std::move(media); }

void Bench::giveUp() { stages_->unfinished.reset(); }

bool Bench::isUnfinished() const { return stages_->unfinished != nullptr; }

Image Bench::render(const Field& field, const Scene& scene, const Monitor& monitor)
{
  stages_->unfinished.reset();
  validate(field, scene);
  auto asked = std::make_unique<Unfinished>(field, scene);
  std::string reason;
  const bool hasCuda = scene.device != Device::Cpu && cudaAvailable(&reason);
  if (scene.device == Device::Cuda && !hasCuda)
  {
    throw Error("Device is CUDA, but no CUDA device can be used: " + reason +
      ". Set Device to Auto or CPU, or check the driver with nvidia-smi.");
  }
  asked->device = hasCuda ? Device::Cuda : Device::Cpu;
  return stages_->render(std::move(asked), monitor);
}

Image Bench::resume(const Monitor& monitor)
{
  if (!isUnfinished())
  {
    throw Error("There is no unfinished image to resume. Render one.");
  }
  return stages_->render(std::move(stages_->unfinished), monitor);
}

Image Bench::Stages::render(std::unique_ptr<Unfinished> asked, const Monitor& monitor)
{
  const Watch watch(monitor);
  const auto goOnWith = [&](Unfinished& begun)
  {
    return begun.scene.precision == Precision::Single ? goOn<float>(begun, watch)
                                                      : goOn<double>(begun, watch);
  };
  Image image;
  for (bool isDone = false; !isDone;)
  {
    try
    {
      image = goOnWith(*asked);
      isDone = true;
    }
    catch (const DeviceError& failure)
    {
      leaveDevice();
      auto again = std::make_unique<Unfinished>(asked->field, asked->scene);
      if (asked->keepsRays && dynamic_cast<const OutOfDeviceMemory*>(&failure) != nullptr)
      {
        again->device = asked->device;
        again->keepsRays = false;
      }
      else if (asked->device == Device::Cpu || asked->scene.device == Device::Cuda)
      {
        throw;
      }
      else
      {
        again->deviceNote = failure.what();
      }
      asked = std::move(again);
    }
    catch (...)
    {
      forgetDistributedMedium();
      throw;
    }
  }
  if (!image.finished && !image.aborted)
  {
    unfinished = std::move(asked);
  }
  return image;
}

} // namespace schlieren
