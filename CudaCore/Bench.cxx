// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The one file that sees every stage: runs them in order and keeps their results.
#include "Schlieren.h"

#include "Device/Parallel.h"
#include "Film/CudaFilm.h"
#include "Film/Development.h"
#include "Film/Exposure.h"
#include "Film/PixelMeans.h"
#include "Medium/HomogeneityMap.h"
#include "Medium/Medium.h"
#include "Optics/AutomaticK.h"
#include "Optics/CutoffMaker.h"
#include "Optics/DeflectionHistogram.h"
#include "Optics/Tint.h"
#include "Rays/CudaTracer.h"
#include "Rays/Tracer.h"
#include "StageSettings.h"
#include "Validation.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
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

  Medium<Real> medium;
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

std::int64_t raysThatCrossed(const TracedPass& traced, int threads)
{
  if (traced.onDevice)
  {
    return traced.crossed;
  }
  std::atomic<std::int64_t> crossed{ 0 };
  constexpr std::int64_t raysPerPiece = 1 << 15;
  parallelFor(static_cast<std::int64_t>(traced.exits.size()), raysPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      crossed += std::count_if(traced.exits.begin() + begin, traced.exits.begin() + end,
        [](const RayExit& exit) { return exit.fate != RayFate::Missed; });
    });
  return crossed;
}

} // namespace

struct Bench::Stages
{
  Work work;

  std::optional<MediumKey> mediumKey;
  std::variant<std::monostate, MediumOnDevices<float>, MediumOnDevices<double>> medium;

  std::optional<RaysKey> raysKey;
  std::int64_t heldMargin = 0;
  std::deque<TracedPass> passes; ///< from pass 0 on
  std::deque<TracedPass> spare;  ///< whose memory serves again
  TracedPass scratch;            ///< a pass that is not held
  std::optional<double> strong;  ///< deflection of these rays, once automatic k has asked for it
  std::optional<DeflectionHistogram> histogram; ///< of them, likewise
  std::optional<double> tint; ///< the reference of what they have gathered, likewise
  CutoffMaker cutoffs;

  template <class Real>
  MediumOnDevices<Real>& prepareMedium(const Field& field, const Scene& scene);

  void prepareRays(RaysKey key, std::int64_t margin);

  /// The rays of a pass, held or traced now; null if aborted.
  template <class Real>
  const TracedPass* raysOf(std::int64_t number, const Pass& pass, MediumOnDevices<Real>& held,
    const RayTask<Real>& task, const Field& field, const Scene& scene, const Monitor& monitor,
    Image& image);

  /// Learns from the rays of a pass what has not been asked of them before: how strongly they are bent, for
  /// automatic k, and where they meet the cutoff plane. `noise`: see noiseFloor.
  void ask(const TracedPass& traced, TracedRays rays, std::int64_t number, const Scene& scene,
    double noise);

  /// How fields tint the picture, by the rays of its first pass.
  std::optional<Tint> tintOf(const TracedRays& rays, const Field& field, const Scene& scene);

  template <class Real>
  Image render(const Field& field, const Scene& scene, Device device, const Monitor& monitor);

  /// Gives the device's memory back.
  void leaveDevice();
};

template <class Real>
MediumOnDevices<Real>& Bench::Stages::prepareMedium(const Field& field, const Scene& scene)
{
  const void* samples = field.singles != nullptr ? static_cast<const void*>(field.singles)
                                                 : static_cast<const void*>(field.doubles);
  const Grid& grid = field.grid;
  const MediumKey key{ grid.dimensions, grid.origin, grid.spacing, grid.direction, field.version,
    samples, field.ambient, scene.interpolation, scene.precision };
  if (!mediumKey || mediumKey->tie() != key.tie())
  {
    // Given up first: two media at once might not fit.
    mediumKey.reset();
    raysKey.reset();
    passes.clear();
    spare.clear();
    medium = std::monostate{};
    medium = MediumOnDevices<Real>(buildMedium<Real>(field, scene.interpolation, scene.threads));
    mediumKey = key;
    ++work.mediumBuilds;
  }
  return std::get<MediumOnDevices<Real>>(medium);
}

void Bench::Stages::prepareRays(RaysKey key, std::int64_t margin)
{
  if (raysKey && !key.gradients)
  {
    key.gradients = raysKey->gradients; // more was gathered than is asked for
  }
  if (!raysKey || raysKey->tie() != key.tie() || heldMargin < margin)
  {
    spare = std::move(passes);
    passes.clear();
    strong.reset();
    histogram.reset();
    tint.reset();
    raysKey = key;
    heldMargin = margin;
  }
}

template <class Real>
const TracedPass* Bench::Stages::raysOf(std::int64_t number, const Pass& pass,
  MediumOnDevices<Real>& held, const RayTask<Real>& task, const Field& field, const Scene& scene,
  const Monitor& monitor, Image& image)
{
  if (static_cast<std::size_t>(number) < passes.size())
  {
    const TracedPass& kept = passes[static_cast<std::size_t>(number)];
    if (field.gradients.count == 0 || !kept.gathered.empty())
    {
      return &kept;
    }
    passes.resize(static_cast<std::size_t>(number)); // traced while nothing was tinted
    tint.reset();
  }
  const auto start = std::chrono::steady_clock::now();
  if (scratch.bytes() == 0 && !spare.empty())
  {
    scratch = std::move(spare.back());
    spare.pop_back();
  }
  const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
  const std::size_t room = scratch.onDevice ? scratch.onDevice->size() : scratch.exits.capacity();
  if (room < rays || room / 2 > rays)
  {
    spare.clear(); // first: two sets of rays at once might not fit
    scratch = {};
  }
  bool finished = false;
  if (image.device == Device::Cuda)
  {
    if (!held.cuda)
    {
      held.cuda = std::make_unique<CudaTracer<Real>>(held.medium);
    }
    using Tracer = CudaTracer<Real>;
    // All passes of a picture in one place.
    const bool isWantedHere =
      field.gradients.count > 0 || (!passes.empty() && !passes.front().onDevice);
    finished = held.cuda->trace(task, pass, { field.gradients.version, held.mapTolerance },
      isWantedHere ? Tracer::Exits::OnHost : Tracer::Exits::OnDevice, scratch, monitor);
  }
  else
  {
    scratch.resize(pass, field.gradients.count);
    finished = traceOnCpu(task, pass, scratch, scene.threads, monitor);
  }
  image.traceSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!finished)
  {
    return nullptr;
  }
  work.raysTraced += raysThatCrossed(scratch, scene.threads);

  if (static_cast<std::size_t>(number) == passes.size() &&
    (passes.size() + 1) * scratch.bytes() <= scene.memoryBudget)
  {
    passes.push_back(std::move(scratch));
    scratch = {};
    return &passes.back();
  }
  return &scratch;
}

void Bench::Stages::ask(
  const TracedPass& traced, TracedRays rays, std::int64_t number, const Scene& scene, double noise)
{
  if (number == 0 && scene.histogramSize > 0 &&
    (!histogram || histogram->size() != scene.histogramSize ||
      histogram->passes() > scene.samplesPerPixel))
  {
    histogram.emplace(scene.histogramSize);
  }
  const bool isKWanted = number == 0 && fullScaleOf(scene.cutoff) > 0 && !scene.kScale && !strong;
  const bool isHistogramWanted = scene.histogramSize > 0 && histogram->passes() == number;
  std::vector<RayExit> fetched;
  if (traced.onDevice && (isKWanted || isHistogramWanted))
  {
    fetched = traced.onDevice->toHost();
    rays.exits = fetched.data();
  }
  if (isKWanted)
  {
    strong = strongDeflection(rays, scene.view.width, scene.view.height, noise, scene.threads);
  }
  if (isHistogramWanted)
  {
    histogram->add(rays, scene.view.width, scene.view.height, scene.threads);
  }
}

std::optional<Tint> Bench::Stages::tintOf(
  const TracedRays& rays, const Field& field, const Scene& scene)
{
  if (field.gradients.count == 0)
  {
    return {};
  }
  if (!tint)
  {
    tint = tintReference(
      rays, scene.fieldColors.size(), scene.view.width, scene.view.height, scene.threads);
  }
  return Tint{ scene.fieldColors, *tint };
}

template <class Real>
Image Bench::Stages::render(
  const Field& field, const Scene& scene, Device device, const Monitor& monitor)
{
  Image aborted;
  aborted.aborted = true;

  const View& view = scene.view;
  Image image;
  image.width = view.width;
  image.height = view.height;
  image.frame = frameOf(field.grid, view);
  image.device = device;
  image.threads = threadCount(scene.threads);

  MediumOnDevices<Real>& held = prepareMedium<Real>(field, scene);
  image.ambient = held.medium.ambient;
  const Light light = lightOf(scene, field.grid, image.frame);
  const DisplacementBound bound = boundDisplacement(held.medium, light);
  image.displacementBound = bound.displacement;
  const RaySettings settings = settingsOf(scene, field.lengthScale, bound, image.frame);
  image.pathModel = settings.kernel.path;
  // An adaptive step is as long as the medium lets it be without a map.
  const double skips =
    settings.kernel.integrator == Integrator::Adaptive ? 0 : scene.homogeneityTolerance;
  // What differs by rounding only is homogeneous.
  constexpr double rounding = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  const double tolerance =
    std::max(skips * held.medium.rangeOfNu, rounding * held.medium.largestNu);
  const HomogeneityMap<Real>* map =
    skips > 0 ? held.mapFor(tolerance, scene.interpolation, scene.threads) : nullptr;
  image.skippingBound =
    map == nullptr ? 0 : skippingBound(held.medium, light, tolerance, scene.interpolation);
  const RayTask<Real> task = makeTask<Real>(
    held.medium, map, FieldGradientsView::of(field.grid, field.gradients), light, settings);

  const std::int64_t margin = marginFor(bound, scene, image.frame);
  RaysKey key{ image.frame, view.width, view.height, settings, skips, scene.seed, device, {},
    LightKey::of(scene, filmDistance(scene, image.frame)) };
  if (field.gradients.count > 0)
  {
    key.gradients = field.gradients.version;
  }
  prepareRays(key, margin);
  Pass pass{ -heldMargin, -heldMargin, view.width + 2 * heldMargin, view.height + 2 * heldMargin,
    { 0, 0 } };
  const std::int64_t mostRays =
    (view.width + 2 * margin) * (view.height + 2 * margin) * passesToHold(scene.samplesPerPixel);
  std::optional<Films> films;
  std::unique_ptr<CudaFilm> filmOnDevice; ///< of passes that lie there
  PixelMeans means(view.width, view.height, scene.threads);
  const Projection projection =
    projectionOf(scene, image.frame, light, (1 + held.medium.ambient) * field.lengthScale);

  const double noise = noiseFloor(held.medium, field, light);
  Cutoffs cutoff;
  RayCounts counts;
  std::vector<TracedRays> waiting; // held passes are exposed together
  for (std::int64_t number = 0; number < scene.samplesPerPixel; ++number)
  {
    Monitor ofPass = monitor;
    if (monitor.progress)
    {
      ofPass.progress = [&](double fraction)
      { monitor.progress((static_cast<double>(number) + fraction) / scene.samplesPerPixel); };
    }
    aimPass(pass, number, scene, light);
    const TracedPass* traced = raysOf(number, pass, held, task, field, scene, ofPass, image);
    if (traced == nullptr || (monitor.aborted && monitor.aborted()))
    {
      return aborted;
    }
    image.momentumDrift = std::max(image.momentumDrift, traced->worstDrift);
    waiting.push_back({ pass, traced->exits.data(), traced->gathered.data() });
    ask(*traced, waiting.back(), number, scene, noise);
    if (number == 0)
    {
      if (fullScaleOf(scene.cutoff) > 0)
      {
        image.kScale =
          scene.kScale ? *scene.kScale : automaticK(*strong, fullScaleOf(scene.cutoff));
      }
      cutoff = cutoffs.cutoffOf(scene, image.kScale, image.frame.pixelSize);
      image.undisturbedLevel = undisturbedLevel(cutoff);
      films = filmsOf(scene, cutoff, tintOf(waiting[0], field, scene), mostRays);
    }
    if (traced->onDevice)
    {
      waiting.clear();
      if (!filmOnDevice)
      {
        filmOnDevice = std::make_unique<CudaFilm>(*films);
      }
      filmOnDevice->expose(
        *traced->onDevice, pass, cutoff, projection, margin, scene.filmEstimator);
      continue;
    }
    const bool isLast = number + 1 == scene.samplesPerPixel;
    if (traced == &scratch || isLast)
    {
      counts.add(
        expose(waiting, cutoff, projection, margin, scene.filmEstimator, scene.threads, *films));
      if (!isLast)
      {
        means.add(waiting);
        waiting.clear();
      }
    }
  }
  if (filmOnDevice)
  {
    counts = filmOnDevice->develop(*films, means);
  }
  image.raysTraced = counts.crossed;
  image.stepsTaken = counts.steps;
  image.raysBlocked = counts.blocked;
  image.raysLost = counts.lost;
  image.saturatedShare = counts.saturatedShare();
  if (scene.histogramSize > 0)
  {
    image.histogram = histogram->histogram();
  }
  develop(*films, scene, image);
  films.reset(); // the means want memory, too
  means.develop(waiting, image);
  if (scene.cutoff == Cutoff::Background)
  {
    image.background = undisturbedPicture(scene, cutoff, projection, margin, mostRays, monitor);
    if (image.background.empty())
    {
      return aborted;
    }
    image.backgroundDisplacement = backgroundDisplacement(image, projection.distance);
  }
  scratch = {};
  spare.clear();
  return image;
}

void Bench::Stages::leaveDevice()
{
  raysKey.reset();
  passes.clear();
  spare.clear();
  scratch = {};
  std::visit(
    [](auto& held)
    {
      if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
      {
        held.cuda.reset();
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

Image Bench::render(const Field& field, const Scene& scene, const Monitor& monitor)
{
  validate(field, scene);

  std::string reason;
  const bool hasCuda = scene.device != Device::Cpu && cudaAvailable(&reason);
  if (scene.device == Device::Cuda && !hasCuda)
  {
    throw Error("Device is CUDA, but no CUDA device can be used: " + reason +
      ". Set Device to Auto or CPU, or check the driver with nvidia-smi.");
  }
  const auto renderOn = [&](Device device)
  {
    return scene.precision == Precision::Single
      ? stages_->render<float>(field, scene, device, monitor)
      : stages_->render<double>(field, scene, device, monitor);
  };
  if (!hasCuda)
  {
    return renderOn(Device::Cpu);
  }
  try
  {
    return renderOn(Device::Cuda);
  }
  catch (const DeviceError& failure)
  {
    stages_->leaveDevice();
    if (scene.device == Device::Cuda)
    {
      throw;
    }
    Image image = renderOn(Device::Cpu);
    image.deviceNote = failure.what();
    return image;
  }
}

} // namespace schlieren
