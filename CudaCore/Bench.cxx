// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The one file that sees every stage: runs them in order and keeps their results.
#include "Schlieren.h"

#include "Device/Parallel.h"
#include "Film/CudaFilm.h"
#include "Film/Exposure.h"
#include "Film/NoiseFilters.h"
#include "Film/PixelMeans.h"
#include "Medium/HomogeneityMap.h"
#include "Medium/Medium.h"
#include "Optics/AutomaticK.h"
#include "Optics/CutoffMaker.h"
#include "Optics/DeflectionHistogram.h"
#include "Optics/Tint.h"
#include "Rays/CudaTracer.h"
#include "Rays/Light.h"
#include "Rays/Tracer.h"
#include "Validation.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <tuple>
#include <type_traits>
#include <variant>

namespace schlieren
{

namespace
{

/// What a held medium was built from.
struct MediumKey
{
  std::array<std::int64_t, 3> dimensions;
  Vector origin;
  Vector spacing;
  std::array<double, 9> direction;
  std::uint64_t version;
  const void* samples;
  std::optional<double> ambient;
  Interpolation interpolation;
  Precision precision;

  auto tie() const
  {
    return std::tie(
      dimensions, origin, spacing, direction, version, samples, ambient, interpolation, precision);
  }
};

/// Where the light of held rays came from. What does not matter to it has its default.
struct LightKey
{
  bool isOfCamera = false;
  std::optional<double> distance;
  SourceShape shape = SourceShape::Point;
  double width = 0, length = 0; ///< of an extended source, as the next two
  double angle = 0;
  double film = 0;

  auto tie() const { return std::tie(isOfCamera, distance, shape, width, length, angle, film); }

  static LightKey of(const Scene& scene, double film)
  {
    LightKey key;
    key.isOfCamera = scene.cutoff == Cutoff::Background;
    if (key.isOfCamera)
    {
      return key;
    }
    key.distance = scene.source.distance;
    key.shape = scene.source.shape;
    if (key.shape != SourceShape::Point)
    {
      key.width = scene.source.width;
      key.film = film;
    }
    if (key.shape == SourceShape::Slit)
    {
      key.length = scene.source.length;
      key.angle = scene.knifeEdgeAngle;
    }
    return key;
  }
};

/// What held rays were traced with, the medium apart.
struct RaysKey
{
  Frame frame;
  int width, height;
  RaySettings settings;
  double homogeneityTolerance;
  std::uint32_t seed;
  Device device;
  std::optional<std::uint64_t> gradients; ///< version of those that were gathered
  LightKey light;

  auto tie() const
  {
    return std::tuple_cat(light.tie(),
      std::tie(frame.u, frame.v, frame.w, frame.origin, frame.pixelSize, frame.entry, frame.exit,
        width, height, settings.kernel.path, settings.kernel.integrator, settings.stepVoxels,
        settings.adaptiveTolerance, settings.lengthScale, homogeneityTolerance, seed, device,
        gradients));
  }
};

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

/// How a scene's rays are to be traced where no ray is displaced further than `bound`. What does not matter
/// to them has its default, so that changing it traces nothing.
RaySettings settingsOf(
  const Scene& scene, double lengthScale, const DisplacementBound& bound, const Frame& frame)
{
  RaySettings settings;
  const bool straightWillDo = scene.pathModel == PathModel::Auto &&
    bound.displacement <= scene.pathTolerance * frame.pixelSize;
  settings.kernel.path = straightWillDo || scene.pathModel == PathModel::Straight
    ? PathModel::Straight
    : PathModel::Refracted;
  settings.kernel.interpolation = scene.interpolation;
  if (settings.kernel.path == PathModel::Refracted)
  {
    settings.kernel.integrator = scene.integrator;
  }
  if (settings.kernel.integrator == Integrator::Adaptive)
  {
    settings.adaptiveTolerance = scene.adaptiveTolerance;
  }
  settings.stepVoxels = scene.stepSize;
  settings.lengthScale = lengthScale;
  return settings;
}

/// Of the deflection, for rays that cross cubes in which nu varies by no more than `tolerance` in one step
/// each: see NuRange, with the whole way through the grid as the way through cubes.
template <class Real>
double skippingBound(
  const Medium<Real>& medium, const Light& light, double tolerance, Interpolation interpolation)
{
  const double steepest = visitScheme(
    interpolation, [](auto scheme) { return static_cast<double>(decltype(scheme)::steepest); });
  const double way = light.depth / light.smallestCosine();
  return 2 * steepest * tolerance * length(light.indexScale) * way * (1 + medium.largestNu);
}

/// A deflection that the rounding of the samples alone can make: each step's gradient is wrong by one
/// rounding of N per voxel, and over a ray these errors add up like a random walk. With a margin of 16.
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

/// How far past the plane where rays leave the data they meet what the film shows: a screen; the background
/// that a camera sees; or (going back) the plane in focus of the other cutoffs' camera. Data units.
double filmDistance(const Scene& scene, const Frame& frame)
{
  const double depth = frame.exit - frame.entry;
  switch (scene.cutoff)
  {
    case Cutoff::Shadowgraph:
      return scene.screenDistance.value_or(depth);
    case Cutoff::Background:
      return scene.background.distance.value_or(depth);
    default:
      return -0.5 * depth + scene.focusOffset;
  }
}

/// Pixels around the picture from which light may be bent into it, at most an eighth of its longer
/// side (or 16). At least one, because the film shares a ray among four pixels. The same for all
/// cutoffs, so that changing the cutoff traces nothing, but for a camera's rays, which stay in their pixel.
std::int64_t marginFor(const DisplacementBound& bound, const Scene& scene, const Frame& frame)
{
  if (scene.cutoff == Cutoff::Background)
  {
    return 1;
  }
  const double depth = frame.exit - frame.entry;
  double furthest = 0; // data units of the picture
  for (const double film :
    { scene.screenDistance.value_or(depth), -0.5 * depth + scene.focusOffset, -0.5 * depth })
  {
    const double magnification =
      scene.source.distance ? 1 + (film + 0.5 * depth) / *scene.source.distance : 1;
    const double moved = bound.displacement + std::abs(film) * bound.slope;
    furthest = std::max(furthest, magnification > 0 ? moved / magnification : 0);
  }
  const double pixels = std::ceil(furthest / frame.pixelSize) + 1;
  const auto most = static_cast<double>(mostMargin(scene.view));
  return static_cast<std::int64_t>(pixels < most ? pixels : most);
}

Light lightOf(const Scene& scene, const Grid& grid, const Frame& frame)
{
  return scene.cutoff == Cutoff::Background
    ? reversedLight(grid, frame)
    : lightFrom(scene.source, filmDistance(scene, frame), grid, scene.view, frame);
}

Projection projectionOf(
  const Scene& scene, const Frame& frame, const Light& light, double pathPerDataUnit)
{
  Projection projection{ filmDistance(scene, frame), 1 / (frame.pixelSize * light.magnification),
    pathPerDataUnit, light.inclination };
  projection.isOfCamera = scene.cutoff == Cutoff::Background;
  if (!projection.isOfCamera && scene.source.distance)
  {
    projection.perSourceDistance = 1 / (*scene.source.distance * light.magnification);
  }
  return projection;
}

Films filmsOf(
  const Scene& scene, const Cutoffs& cutoff, std::optional<Tint> tint, std::int64_t mostRays)
{
  const View& view = scene.view;
  Films films(channelsOf(cutoff), std::move(tint), view.width, view.height, mostRays);
  if (countsSamples(scene.noiseFilter, scene.noiseFilterRadius))
  {
    films.samples = std::make_unique<Films>(
      Shadowgraph::channels, std::nullopt, view.width, view.height, mostRays);
  }
  return films;
}

/// What the noise filter wants to know; empty if nothing.
PixelArray<float> samplesOn(const Films& films, const Scene& scene)
{
  return films.samples ? films.samples->developIntensity(1, scene.threads) : PixelArray<float>();
}

/// What a camera sees without the flow: passes of rays that nothing bends, on films like those of the
/// picture, so that where the flow bends nothing either no bit differs. Empty if aborted.
PixelArray<float> undisturbedPicture(const Scene& scene, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, std::int64_t mostRays, const Monitor& monitor)
{
  Pass pass{ -margin, -margin, scene.view.width + 2 * margin, scene.view.height + 2 * margin,
    { 0, 0 } };
  const std::vector<RayExit> exits(static_cast<std::size_t>(pass.columns * pass.rows));
  Films films = filmsOf(scene, cutoff, {}, mostRays);
  for (std::int64_t number = 0; number < scene.samplesPerPixel; ++number)
  {
    if (monitor.aborted && monitor.aborted())
    {
      return {};
    }
    pass.offset = pixelOffset(number, scene.seed);
    expose({ { pass, exits.data(), nullptr } }, cutoff, projection, margin, scene.filmEstimator,
      scene.threads, films);
  }
  return filtered(films.developIntensity(scene.samplesPerPixel, scene.threads), scene.view.width,
    scene.view.height, scene.noiseFilter, scene.noiseFilterRadius, samplesOn(films, scene),
    scene.threads);
}

/// How far from where they start the mean rays of pixels meet the background.
PixelArray<float> backgroundDisplacement(const Image& image, double distance)
{
  PixelArray<float> moved(image.displacement.size());
  for (std::size_t i = 0; i < moved.size(); i += 2)
  {
    const double eps[2] = { static_cast<double>(image.deflection[i]),
      static_cast<double>(image.deflection[i + 1]) };
    const double way = distance / std::sqrt(std::max(1 - eps[0] * eps[0] - eps[1] * eps[1], 1e-30));
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      moved[i + axis] =
        static_cast<float>(static_cast<double>(image.displacement[i + axis]) + way * eps[axis]);
    }
  }
  return moved;
}

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

  if (scene.histogramSize > 0 &&
    (!histogram || histogram->size() != scene.histogramSize ||
      histogram->passes() > scene.samplesPerPixel))
  {
    histogram.emplace(scene.histogramSize);
  }
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
    pass.offset = pixelOffset(number, scene.seed);
    if (scene.cutoff != Cutoff::Background)
    {
      const std::array<double, 2> place =
        sourcePoint(scene.source, scene.knifeEdgeAngle, number, scene.seed);
      pass.tilt[0] = place[0] / light.magnification;
      pass.tilt[1] = place[1] / light.magnification;
    }
    const TracedPass* traced = raysOf(number, pass, held, task, field, scene, ofPass, image);
    if (traced == nullptr || (monitor.aborted && monitor.aborted()))
    {
      return aborted;
    }
    image.momentumDrift = std::max(image.momentumDrift, traced->worstDrift);
    waiting.push_back({ pass, traced->exits.data(), traced->gathered.data() });
    const double fullScale = fullScaleOf(scene.cutoff);
    const bool isKWanted = number == 0 && fullScale > 0 && !scene.kScale && !strong;
    const bool isHistogramWanted = scene.histogramSize > 0 && histogram->passes() == number;
    std::vector<RayExit> fetched;
    if (traced->onDevice && (isKWanted || isHistogramWanted))
    {
      fetched = traced->onDevice->toHost();
      waiting.back().exits = fetched.data();
    }
    if (isKWanted)
    {
      strong = strongDeflection(
        waiting[0], view.width, view.height, noiseFloor(held.medium, field, light), scene.threads);
    }
    if (isHistogramWanted)
    {
      histogram->add(waiting.back(), view.width, view.height, scene.threads);
    }
    if (number == 0)
    {
      std::optional<Tint> tintOfRays;
      if (field.gradients.count > 0)
      {
        if (!tint)
        {
          tint = tintReference(
            waiting[0], scene.fieldColors.size(), view.width, view.height, scene.threads);
        }
        tintOfRays = Tint{ scene.fieldColors, *tint };
      }
      if (fullScale > 0)
      {
        image.kScale = scene.kScale ? *scene.kScale : automaticK(*strong, fullScale);
      }
      cutoff = cutoffs.cutoffOf(scene, image.kScale, image.frame.pixelSize);
      image.undisturbedLevel = undisturbedLevel(cutoff);
      films = filmsOf(scene, cutoff, std::move(tintOfRays), mostRays);
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
  image.light = films->balance(scene.samplesPerPixel);
  image.intensity = films->developIntensity(scene.samplesPerPixel, scene.threads);
  if (films->isColored())
  {
    image.color = films->developColor(scene.samplesPerPixel, scene.threads);
  }
  const PixelArray<float> samples = samplesOn(*films, scene);
  films.reset(); // the means want memory, too
  for (PixelArray<float>* picture : { &image.intensity, &image.color })
  {
    *picture = filtered(std::move(*picture), view.width, view.height, scene.noiseFilter,
      scene.noiseFilterRadius, samples, scene.threads);
  }
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
