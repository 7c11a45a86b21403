// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Pilot.h"

#include "Bench/StageSettings.h"
#include "Device/Parallel.h"
#include "Film/ProgressiveImage.h"
#include "Math/Units.h"
#include "Rays/Cpu/CpuTracer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace schlieren
{

namespace
{

constexpr std::int64_t scouts = 4096; ///< rays that look at the view
/// Pixels of a set of patches: a few thousandths of the image's.
constexpr double shareOfPixels = 4e-3;
constexpr double fewestPixels = 320, mostPixels = 1024;

/// Caustics: light that is displaced by no more than this is where it should be, pixels.
constexpr double invisibleShift = 0.05;

/// The light of a part of an image, whose pixel (0, 0) is at (column, row) of the image, and pixels are `stride` times as
/// large.
Light lightOfPart(const Light& light, double column, double row, double stride)
{
  Light part = light;
  part.corner = light.start(column, row);
  part.perColumn = stride * light.perColumn;
  part.perRow = stride * light.perRow;
  part.inclination.atOrigin[0] += column * light.inclination.perPixel;
  part.inclination.atOrigin[1] += row * light.inclination.perPixel;
  part.inclination.perPixel *= stride;
  return part;
}

Projection projectionOfPart(const Projection& projection, double column, double row)
{
  Projection part = projection;
  part.inclination.atOrigin[0] += column * projection.inclination.perPixel;
  part.inclination.atOrigin[1] += row * projection.inclination.perPixel;
  return part;
}

} // namespace

double percentile99(Differences differences)
{
  std::sort(differences.begin(), differences.end(),
    [](const Difference& a, const Difference& b) { return a.value > b.value; });
  double all = 0;
  for (const Difference& one : differences)
  {
    all += one.pixels;
  }
  double above = 0;
  for (const Difference& one : differences)
  {
    above += one.pixels;
    if (above > 0.01 * all)
    {
      return one.value;
    }
  }
  return 0;
}

double largestOf(const Differences& differences)
{
  double largest = 0;
  for (const Difference& one : differences)
  {
    largest = std::max(largest, one.value);
  }
  return largest;
}

template <class Real>
Pilot<Real>::Pilot(PilotBench<Real> bench, const DeflectionErrors& errors)
  : bench_(std::move(bench))
{
  scout(errors);
  layOut();
}

template <class Real>
RayTask<Real> Pilot<Real>::taskFor(double step) const
{
  RaySettings settings = bench_.settings;
  settings.stepVoxels = step;
  settings.adaptiveTolerance = adaptiveToleranceFor(step, settings.adaptiveTolerance);
  return makeTask<Real>(*bench_.medium, nullptr, {}, bench_.light, settings);
}

/// Traces a ray through the middle of each of some thousand squares of pixels.
template <class Real>
void Pilot<Real>::scout(const DeflectionErrors& errors)
{
  const View& view = bench_.scene.view;
  const double pixels = static_cast<double>(view.width) * view.height;
  stride_ = std::max<std::int64_t>(1, std::llround(std::sqrt(pixels / scouts)));
  const double middle = 0.5 * static_cast<double>(stride_ - 1);
  RayTask<Real> task = taskFor(longestStep);
  task.light = lightOfPart(bench_.light, middle, middle, static_cast<double>(stride_));
  const Pass pass{ 0, 0, (view.width + stride_ - 1) / stride_,
    (view.height + stride_ - 1) / stride_, { 0, 0 } };
  TracedPass traced;
  traced.resize(pass, 0);
  const int threads = bench_.scene.threads;
  traceOnCpu(task, pass, traced, threads, {});

  const auto crosses = [&](std::int64_t column, std::int64_t row)
  {
    return column >= 0 && column < pass.columns && row >= 0 && row < pass.rows &&
      traced.exits[static_cast<std::size_t>(row * pass.columns + column)].fate == RayFate::Left;
  };
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::int64_t row = 0; row < pass.rows; ++row)
  {
    for (std::int64_t column = 0; column < pass.columns; ++column)
    {
      if (!crosses(column, row))
      {
        continue;
      }
      bool isWithin = true;
      for (const std::int64_t step : { -1, 1 })
      {
        isWithin = isWithin && crosses(column + step, row) && crosses(column, row + step);
      }
      (isWithin ? within_ : atEdges_).push_back({ column * stride_, row * stride_, 0 });
      ++view_.crossed;
      const RayExit& exit = traced.exits[static_cast<std::size_t>(row * pass.columns + column)];
      const double* eps = exit.deflection;
      view_.largestDeflection = std::max(view_.largestDeflection, std::hypot(eps[0], eps[1]));
      lowest = std::min(lowest, exit.opticalPathDifference);
      highest = std::max(highest, exit.opticalPathDifference);
      const FilmShift shift = shiftOnFilm(exit.deflection, exit.displacement,
        static_cast<double>(column * stride_) + middle, static_cast<double>(row * stride_) + middle,
        pass.tilt, bench_.projection);
      view_.displacement = std::max(view_.displacement,
        bench_.projection.perDataUnit *
          std::max(std::abs(shift.moved[0]), std::abs(shift.moved[1])));
    }
  }
  view_.path = view_.crossed > 0 ? highest - lowest : 0;
  view_.strongDeflection = strongDeflection({ pass, traced.exits.data(), nullptr },
    static_cast<int>(pass.columns), static_cast<int>(pass.rows), errors, threads);
}

template <class Real>
void Pilot<Real>::layOut()
{
  constexpr std::int64_t around = 2; // what the film knows of a pixel's neighbours
  constexpr std::int64_t mostAround = 24;
  const double moved = bench_.projection.isOfCamera ? 0 : std::ceil(view_.displacement);
  margin_ = around +
    static_cast<std::int64_t>(
      std::min({ moved, static_cast<double>(bench_.margin), static_cast<double>(mostAround) }));
  // As many rays around a patch as in it, at most.
  edge_ = std::max<std::int64_t>(4, margin_);
  const double pixels = shareOfPixels * static_cast<double>(view_.crossed * stride_ * stride_);
  const auto patches = static_cast<std::size_t>(
    std::clamp(pixels, fewestPixels, mostPixels) / static_cast<double>(edge_ * edge_));
  spread(within_, std::max<std::size_t>(6, patches * 3 / 4));
  spread(atEdges_, std::max<std::size_t>(2, patches / 4));
}

/// Puts so many patches of each set into some of these cells, at even distances in the order of rows.
template <class Real>
void Pilot<Real>::spread(const PatchList& cells, std::size_t count)
{
  const View& view = bench_.scene.view;
  const auto within = [&](std::int64_t first, std::int64_t size)
  { return std::max<std::int64_t>(0, std::min(first + (stride_ - edge_) / 2, size - edge_)); };
  const std::size_t places = std::min(cells.size(), 2 * count);
  const double weight =
    static_cast<double>(cells.size() * static_cast<std::size_t>(stride_ * stride_)) /
    (0.5 * static_cast<double>(places * static_cast<std::size_t>(edge_ * edge_)));
  for (std::size_t n = 0; n < places; ++n)
  {
    const Patch& cell = cells[n * cells.size() / places];
    patches_[n % 2].push_back(
      { within(cell.column, view.width), within(cell.row, view.height), weight });
  }
}

template <class Real>
Pass Pilot<Real>::passOf(std::int64_t number) const
{
  Pass pass{ -margin_, -margin_, edge_ + 2 * margin_, edge_ + 2 * margin_, { 0, 0 } };
  aimPass(pass, number, bench_.scene, bench_.light);
  return pass;
}

template <class Real>
const typename Pilot<Real>::Traced* Pilot<Real>::trace(
  Patches patches, double step, int number, const Monitor& monitor)
{
  const auto set = static_cast<std::size_t>(patches);
  Traced& traced = traced_[set][{ step, number }];
  const PatchList& places = patches_[set];
  if (traced.size() == places.size())
  {
    return &traced;
  }
  Traced rays(places.size());
  const RayTask<Real> whole = taskFor(step);
  const Pass pass = passOf(number);
  const bool isDone = parallelFor(static_cast<std::int64_t>(places.size()), 1, bench_.scene.threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t n = begin; n < end; ++n)
      {
        const Patch& patch = places[static_cast<std::size_t>(n)];
        RayTask<Real> task = whole;
        task.light = lightOfPart(
          bench_.light, static_cast<double>(patch.column), static_cast<double>(patch.row), 1);
        TracedPass& ofPatch = rays[static_cast<std::size_t>(n)];
        ofPatch.resize(pass, 0);
        traceOnCpu(task, pass, ofPatch, 1, {});
      }
    },
    { {}, monitor.aborted });
  if (!isDone)
  {
    return nullptr;
  }
  traced = std::move(rays);
  return &traced;
}

template <class Real>
typename Pilot<Real>::Values Pilot<Real>::expose(
  const Patch& patch, std::size_t index, const std::vector<const Traced*>& passes) const
{
  const Projection projection = projectionOfPart(
    bench_.projection, static_cast<double>(patch.column), static_cast<double>(patch.row));
  FilmSettings settings = filmSettingsOf(bench_.scene);
  settings.width = settings.height = static_cast<int>(edge_);
  settings.samplesPerPixel = static_cast<int>(passes.size());
  settings.noiseFilter = NoiseFilter::None;
  settings.isOfCamera = false;
  settings.threads = 1;
  ProgressiveImage film(settings);
  const std::int64_t side = edge_ + 2 * margin_;
  film.begin(
    { *cutoff_, projection, margin_, side * side * passesToHold(settings.samplesPerPixel) }, {});
  for (std::size_t number = 0; number < passes.size(); ++number)
  {
    film.add(
      (*passes[number])[index], passOf(static_cast<std::int64_t>(number)), schlieren::Rays::Go, {});
  }
  Image image;
  image.width = image.height = settings.width;
  film.develop(image);

  Values values;
  const PixelArray<float>& light = image.color.empty() ? image.intensity : image.color;
  values.light.assign(light.begin(), light.end());
  values.path.assign(image.opticalPathDifference.begin(), image.opticalPathDifference.end());
  const PixelArray<float> moved = backgroundDisplacement(image, projection);
  values.moved.assign(moved.begin(), moved.end());
  // Also of pixels whose centre is dark.
  const std::int64_t columns = edge_ + 2 * margin_;
  for (std::int64_t row = margin_; row < margin_ + edge_; ++row)
  {
    for (std::int64_t column = margin_; column < margin_ + edge_; ++column)
    {
      const auto ray = static_cast<std::size_t>(row * columns + column);
      values.hasCrossed.push_back(std::any_of(passes.begin(), passes.end(),
        [&](const Traced* pass) { return (*pass)[index].exits[ray].fate == RayFate::Left; }));
    }
  }
  return values;
}

/// Compares as the technique's reader does: see Scene::targetError.
template <class Real>
void Pilot<Real>::addDifferences(
  const Values& a, const Values& b, double weight, Differences& differences) const
{
  const std::size_t pixels = b.hasCrossed.size();
  const std::size_t channels = a.light.size() / pixels;
  const Technique& technique = techniqueOf(bench_.scene.cutoff);
  const auto edge = static_cast<std::size_t>(edge_);
  const auto slopeAt = [&](std::size_t pixel)
  {
    // What a shift by a pixel would change, at the most.
    double slope = 0;
    const std::size_t column = pixel % edge, row = pixel / edge;
    const auto look = [&](bool isThere, std::size_t other)
    {
      slope = isThere
        ? std::max(slope, std::abs(static_cast<double>(b.light[other] - b.light[pixel])))
        : slope;
    };
    look(column > 0, pixel - 1);
    look(column + 1 < edge, pixel + 1);
    look(row > 0, pixel - edge);
    look(row + 1 < edge, pixel + edge);
    return slope;
  };
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    if (!b.hasCrossed[pixel])
    {
      continue;
    }
    double ofLight = 0;
    for (std::size_t channel = 0; channel < channels; ++channel)
    {
      const std::size_t at = channels * pixel + channel;
      ofLight = std::max(
        ofLight, std::abs(static_cast<double>(a.light[at]) - static_cast<double>(b.light[at])));
    }
    switch (technique.plane)
    {
      case RecordedPlane::Background:
        differences.push_back({ bench_.projection.perDataUnit *
            std::hypot(static_cast<double>(a.moved[2 * pixel] - b.moved[2 * pixel]),
              static_cast<double>(a.moved[2 * pixel + 1] - b.moved[2 * pixel + 1])),
          weight });
        continue;
      case RecordedPlane::Screen:
        differences.push_back({ std::max(0., ofLight - invisibleShift * slopeAt(pixel)), weight });
        continue;
      case RecordedPlane::Focus:
        break;
    }
    if (technique.hasFringes)
    {
      // The light of a fringe changes by pi of its range in a fringe, at the most.
      const double ofPath = std::abs(a.path[pixel] - b.path[pixel]) / bench_.scene.wavelength;
      differences.push_back({ std::max(ofLight / pi, ofPath), weight });
      continue;
    }
    differences.push_back({ ofLight, weight });
  }
}

template <class Real>
const typename Pilot<Real>::Exposed* Pilot<Real>::expose(
  Patches patches, const Settings& settings, const Monitor& monitor)
{
  const auto set = static_cast<std::size_t>(patches);
  const auto [found, isNew] = exposed_[set].try_emplace({ settings.step, settings.samples });
  if (!isNew)
  {
    return &found->second;
  }
  std::vector<const Traced*> passes;
  for (int number = 0; number < settings.samples; ++number)
  {
    passes.push_back(trace(patches, settings.step, number, monitor));
    if (!passes.back())
    {
      exposed_[set].erase(found);
      return nullptr;
    }
  }
  const PatchList& places = patches_[set];
  found->second.resize(places.size());
  parallelFor(static_cast<std::int64_t>(places.size()), 1, bench_.scene.threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n)
      {
        found->second[n] = expose(places[n], n, passes);
      }
    });
  return &found->second;
}

template <class Real>
Differences Pilot<Real>::compare(
  Patches patches, const Settings& a, const Settings& b, const Monitor& monitor)
{
  const Exposed* ofA = expose(patches, a, monitor);
  const Exposed* ofB = ofA ? expose(patches, b, monitor) : nullptr;
  Differences all;
  for (std::size_t n = 0; ofB && n < ofB->size(); ++n)
  {
    addDifferences(
      (*ofA)[n], (*ofB)[n], patches_[static_cast<std::size_t>(patches)][n].weight, all);
  }
  return all;
}

template class Pilot<float>;
template class Pilot<double>;

} // namespace schlieren
