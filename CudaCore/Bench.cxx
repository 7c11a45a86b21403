// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The one file that sees every stage: runs them in order and keeps their results.
#include "Schlieren.h"

#include "Device/Parallel.h"
#include "Film/Film.h"
#include "Film/PixelMeans.h"
#include "Film/Shading.h"
#include "Medium/Medium.h"
#include "Optics/AutomaticK.h"
#include "Optics/Cutoffs.h"
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

/// Rays are held for re-shading up to this much memory; passes beyond it are traced again.
constexpr std::size_t mostHeldBytes = std::size_t{ 1 } << 30;

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

/// What held rays were traced with, the medium apart.
struct RaysKey
{
  Frame frame;
  int width, height;
  double stepSize;
  double lengthScale;
  std::uint32_t seed;
  Device device;
  std::optional<std::uint64_t> gradients; ///< version of those that were gathered

  auto tie() const
  {
    return std::tie(frame.u, frame.v, frame.w, frame.origin, frame.pixelSize, frame.entry,
      frame.exit, width, height, stepSize, lengthScale, seed, device, gradients);
  }
};

template <class Real>
struct MediumOnDevices
{
  Medium<Real> medium;
  std::unique_ptr<CudaTracer<Real>> cuda; ///< once rays have been traced there
};

/// Pixels around the picture from which light may be bent into it, at most an eighth of its longer
/// side (or 16). At least one, because the film shares a ray among four pixels. The same for all
/// cutoffs, so that changing the cutoff traces nothing.
std::int64_t marginFor(const DisplacementBound& bound, const Scene& scene, const Frame& frame)
{
  const double depth = frame.exit - frame.entry;
  const double furthest = std::max(depth, scene.screenDistance.value_or(depth));
  const double pixels =
    std::ceil((bound.displacement + furthest * bound.slope) / frame.pixelSize) + 1;
  const double most = std::max(16, std::max(scene.view.width, scene.view.height) / 8);
  return static_cast<std::int64_t>(pixels < most ? pixels : most);
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
  const double voxels = std::max(1., light.depth * length(light.perLength));
  return margin * medium.largestN * rounding * std::sqrt(voxels);
}

/// How far past the exit plane rays meet what the film shows: a screen, or (going back) the middle of
/// the data, where the other cutoffs' camera is in focus. Data units.
double filmDistance(const Scene& scene, const Frame& frame)
{
  const double depth = frame.exit - frame.entry;
  return scene.cutoff == Cutoff::Shadowgraph ? scene.screenDistance.value_or(depth) : -0.5 * depth;
}

/// The picture in tinted light: red, green and blue.
struct ColorFilm
{
  ColorFilm(const Tint& tintOfRays, int width, int height, std::int64_t mostRays)
    : tint(tintOfRays)
    , channels{ Film(width, height, mostRays), Film(width, height, mostRays),
      Film(width, height, mostRays) }
  {
  }

  void splat(double column, double row, double light, const float* gathered)
  {
    const std::array<double, 3> color = tint.of(gathered);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      channels[channel].splat(column, row, light * color[channel]);
    }
  }

  /// Three values per pixel.
  std::vector<float> develop(double raysPerPixel) const
  {
    std::vector<float> picture;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      const std::vector<float> light = channels[channel].develop(raysPerPixel);
      picture.resize(3 * light.size());
      for (std::size_t pixel = 0; pixel < light.size(); ++pixel)
      {
        picture[3 * pixel + channel] = light[pixel];
      }
    }
    return picture;
  }

  Tint tint;
  std::array<Film, 3> channels;
};

/// Adds one pass of rays to the films and to the means. `traced` covers `held`, of which the picture and
/// `margin` pixels around it are used. `colorFilm`: null where nothing tints.
template <class CutoffKind>
void shade(const CutoffKind& cutoff, double distance, const TracedPass& traced, const Pass& held,
  std::int64_t margin, const Scene& scene, Image& image, Film& film, ColorFilm* colorFilm,
  PixelMeans& means)
{
  const std::int64_t width = scene.view.width;
  const std::int64_t height = scene.view.height;
  const Projection projection{ distance, 1 / image.frame.pixelSize };
  std::atomic<std::int64_t> crossed{ 0 }, steps{ 0 }, blocked{ 0 }, lost{ 0 };
  constexpr std::int64_t rowsPerPiece = 16;
  parallelFor(height + 2 * margin, rowsPerPiece, scene.threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::int64_t crossedHere = 0, stepsHere = 0, blockedHere = 0, lostHere = 0;
      for (std::int64_t row = begin - margin; row < end - margin; ++row)
      {
        for (std::int64_t column = -margin; column < width + margin; ++column)
        {
          const auto ray = static_cast<std::size_t>(
            (row - held.firstRow) * held.columns + column - held.firstColumn);
          const RayExit& exit = traced.exits[ray];
          crossedHere += exit.fate != RayFate::Missed ? 1 : 0;
          blockedHere += exit.fate == RayFate::Blocked ? 1 : 0;
          lostHere += exit.fate == RayFate::Trapped || exit.fate == RayFate::Turned ? 1 : 0;
          stepsHere += exit.steps;
          if (column >= 0 && column < width && row >= 0 && row < height)
          {
            means.add(static_cast<std::size_t>(row * width + column), exit);
          }
          if (exit.reachesFilm())
          {
            const Landing at = landingOf(exit, static_cast<double>(column) + held.offset.column,
              static_cast<double>(row) + held.offset.row, projection);
            const double light = cutoff.transmission(exit.deflection);
            film.splat(at.column, at.row, light);
            if (colorFilm != nullptr)
            {
              colorFilm->splat(
                at.column, at.row, light, traced.gathered.data() + ray * scene.fieldColors.size());
            }
          }
        }
      }
      crossed += crossedHere;
      steps += stepsHere;
      blocked += blockedHere;
      lost += lostHere;
    });
  image.raysTraced += crossed;
  image.stepsTaken += steps;
  image.raysBlocked += blocked;
  image.raysLost += lost;
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
  TracedPass scratch;            ///< a pass that is not held

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
    medium = std::monostate{};
    medium = MediumOnDevices<Real>{ buildMedium<Real>(field, scene.interpolation, scene.threads),
      nullptr };
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
    passes.clear();
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
  }
  const auto start = std::chrono::steady_clock::now();
  const FieldGradientsView gradients = FieldGradientsView::of(field.grid, field.gradients);
  scratch.resize(pass, gradients.count);
  bool finished = false;
  if (image.device == Device::Cuda)
  {
    if (!held.cuda)
    {
      held.cuda = std::make_unique<CudaTracer<Real>>(held.medium);
    }
    finished = held.cuda->trace(
      task, scene.interpolation, pass, gradients, field.gradients.version, scratch, monitor);
  }
  else
  {
    finished =
      traceOnCpu(task, scene.interpolation, pass, gradients, scratch, scene.threads, monitor);
  }
  image.traceSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!finished)
  {
    return nullptr;
  }
  work.raysTraced += std::count_if(scratch.exits.begin(), scratch.exits.end(),
    [](const RayExit& exit) { return exit.fate != RayFate::Missed; });

  if (static_cast<std::size_t>(number) == passes.size() &&
    (passes.size() + 1) * scratch.bytes() <= mostHeldBytes)
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
  image.pathModel = PathModel::Refracted;

  MediumOnDevices<Real>& held = prepareMedium<Real>(field, scene);
  image.ambient = held.medium.ambient;
  const Light light = collimatedLight(field.grid, image.frame);
  const DisplacementBound bound = boundDisplacement(held.medium, light);
  image.displacementBound = bound.displacement;
  const RayTask<Real> task = makeTask(held.medium, light, scene.stepSize, field.lengthScale);

  const std::int64_t margin = marginFor(bound, scene, image.frame);
  RaysKey key{ image.frame, view.width, view.height, scene.stepSize, field.lengthScale, scene.seed,
    device, {} };
  if (field.gradients.count > 0)
  {
    key.gradients = field.gradients.version;
  }
  prepareRays(key, margin);
  Pass pass{ -heldMargin, -heldMargin, view.width + 2 * heldMargin, view.height + 2 * heldMargin,
    { 0, 0 } };
  const std::int64_t mostRays =
    (view.width + 2 * margin) * (view.height + 2 * margin) * scene.samplesPerPixel;
  Film film(view.width, view.height, mostRays);
  std::unique_ptr<ColorFilm> colorFilm;
  PixelMeans means(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  const double distance = filmDistance(scene, image.frame);

  for (std::int64_t number = 0; number < scene.samplesPerPixel; ++number)
  {
    Monitor ofPass = monitor;
    if (monitor.progress)
    {
      ofPass.progress = [&](double fraction)
      { monitor.progress((static_cast<double>(number) + fraction) / scene.samplesPerPixel); };
    }
    pass.offset = pixelOffset(number, scene.seed);
    const TracedPass* traced = raysOf(number, pass, held, task, field, scene, ofPass, image);
    if (traced == nullptr || (monitor.aborted && monitor.aborted()))
    {
      return aborted;
    }
    if (number == 0 && field.gradients.count > 0)
    {
      const double reference = tintReference(traced->exits.data(), traced->gathered.data(),
        scene.fieldColors.size(), pass, view.width, view.height);
      colorFilm = std::make_unique<ColorFilm>(
        Tint{ scene.fieldColors, reference }, view.width, view.height, mostRays);
    }
    if (scene.cutoff == Cutoff::Shadowgraph)
    {
      shade(
        Shadowgraph{}, distance, *traced, pass, margin, scene, image, film, colorFilm.get(), means);
      continue;
    }
    if (number == 0)
    {
      image.kScale = scene.kScale ? *scene.kScale
                                  : automaticK(traced->exits.data(), pass, view.width, view.height,
                                      noiseFloor(held.medium, field, light));
    }
    shade(KnifeEdge::at(scene.knifeEdgeAngle, image.kScale, scene.invertCutoff), distance, *traced,
      pass, margin, scene, image, film, colorFilm.get(), means);
  }
  scratch = {};
  image.intensity = film.develop(scene.samplesPerPixel);
  if (colorFilm)
  {
    image.color = colorFilm->develop(scene.samplesPerPixel);
  }
  means.develop(image);
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
