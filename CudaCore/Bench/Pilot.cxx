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

/// Caustics: light that is displaced by no more than this is where it should be, pixels.
constexpr double invisibleShift = 0.05;

Projection projectionOfPart(const Projection& projection, double column, double row)
{
  Projection part = projection;
  part.inclination.atOrigin[0] += column * projection.inclination.perPixel;
  part.inclination.atOrigin[1] += row * projection.inclination.perPixel;
  return part;
}

} // namespace

template <class Real>
Pilot<Real>::Pilot(PilotBench<Real> bench, const DeflectionErrors& errors)
  : bench_(std::move(bench))
  , scouts_(taskFor(longestStep), bench_.light, bench_.settings.lengthScale, bench_.scene,
      bench_.projection, errors)
  , layout_(layOutPatches(scouts_, bench_.scene.view, bench_.margin))
  , groups_{ { { &layout_.sets[0].atBodies, {}, {} }, { &layout_.sets[0].elsewhere, {}, {} } },
    { { &layout_.sets[1].atBodies, {}, {} }, { &layout_.sets[1].elsewhere, {}, {} } } }
{
}

template <class Real>
RayTask<Real> Pilot<Real>::taskFor(double step) const
{
  RaySettings settings = bench_.settings;
  settings.stepVoxels = step;
  settings.adaptiveTolerance = adaptiveToleranceFor(step, settings.adaptiveTolerance);
  return makeTask<Real>(*bench_.medium, nullptr, {}, bench_.light, settings);
}

template <class Real>
Pass Pilot<Real>::passOf(const Patch& patch, std::int64_t number) const
{
  Pass pass{ -patch.margin, -patch.margin, patch.columns + 2 * patch.margin,
    patch.rows + 2 * patch.margin, { 0, 0 } };
  aimPass(pass, number, bench_.scene, bench_.light);
  return pass;
}

template <class Real>
const typename Pilot<Real>::Traced* Pilot<Real>::trace(
  Group& group, double step, int number, const Monitor& monitor)
{
  Traced& traced = group.traced[{ step, number }];
  const PatchList& places = *group.patches;
  const auto count = static_cast<std::int64_t>(places.size());
  if (isPaused_)
  {
    return nullptr;
  }
  traced.rays.resize(places.size());
  const RayTask<Real> whole = taskFor(step);
  const auto traceOne = [&](std::size_t n)
  {
    const Patch& patch = places[n];
    RayTask<Real> task = whole;
    task.light = lightOfPart(
      bench_.light, static_cast<double>(patch.fromColumn), static_cast<double>(patch.fromRow), 1);
    const Pass pass = passOf(patch, number);
    TracedPass& ofPatch = traced.rays[n];
    ofPatch.resize(pass, 0);
    traceOnCpu(task, pass, ofPatch, layout_.isWhole ? bench_.scene.threads : 1, {});
    const double shift[2] = { static_cast<double>(patch.fromColumn - patch.column),
      static_cast<double>(patch.fromRow - patch.row) };
    for (RayExit& exit : ofPatch.exits)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        exit.displacement[axis] += static_cast<float>(shift[axis] / bench_.projection.perDataUnit);
      }
    }
  };
  if (traced.done < count)
  {
    traced.done = parallelFrom(traced.done, count, 1, bench_.scene.threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t n = begin; n < end; ++n)
        {
          traceOne(static_cast<std::size_t>(n));
        }
      },
      { {}, monitor.aborted, monitor.paused });
    isPaused_ = monitor.paused && monitor.paused();
  }
  return traced.done < count ? nullptr : &traced;
}

template <class Real>
typename Pilot<Real>::Values Pilot<Real>::expose(
  const Patch& patch, std::size_t index, const std::vector<const Traced*>& passes) const
{
  const Projection projection = projectionOfPart(
    bench_.projection, static_cast<double>(patch.fromColumn), static_cast<double>(patch.fromRow));
  FilmSettings settings = filmSettingsOf(bench_.scene);
  settings.width = static_cast<int>(patch.columns);
  settings.height = static_cast<int>(patch.rows);
  settings.samplesPerPixel = static_cast<int>(passes.size());
  settings.noiseFilter = NoiseFilter::None;
  settings.isOfCamera = false;
  settings.threads = layout_.isWhole ? bench_.scene.threads : 1;
  ProgressiveImage film(settings);
  const std::int64_t columns = patch.columns + 2 * patch.margin;
  const std::int64_t rays = columns * (patch.rows + 2 * patch.margin);
  film.begin(
    { *cutoff_, projection, patch.margin, rays * passesToHold(settings.samplesPerPixel) }, {});
  for (std::size_t number = 0; number < passes.size(); ++number)
  {
    film.add(passes[number]->rays[index], passOf(patch, static_cast<std::int64_t>(number)),
      schlieren::Rays::Go, {});
  }
  Image image;
  image.width = settings.width;
  image.height = settings.height;
  film.develop(image);

  Values values;
  const PixelArray<float>& light = image.color.empty() ? image.intensity : image.color;
  values.light.assign(light.begin(), light.end());
  values.path.assign(image.opticalPathDifference.begin(), image.opticalPathDifference.end());
  const PixelArray<float> moved = backgroundDisplacement(image, projection);
  values.moved.assign(moved.begin(), moved.end());
  // Also of pixels whose centre is dark. What lands on a patch from elsewhere counts as a whole.
  const bool isOfPlace = patch.fromColumn == patch.column && patch.fromRow == patch.row;
  for (std::int64_t row = patch.margin; row < patch.margin + patch.rows; ++row)
  {
    for (std::int64_t column = patch.margin; column < patch.margin + patch.columns; ++column)
    {
      const auto ray = static_cast<std::size_t>(row * columns + column);
      values.hasCrossed.push_back(!isOfPlace ||
        std::any_of(passes.begin(), passes.end(),
          [&](const Traced* pass) { return pass->rays[index].exits[ray].fate == RayFate::Left; }));
      values.isClear.push_back(passes.front()->rays[index].exits[ray].reachesFilm());
    }
  }
  return values;
}

/// Compares as the technique's reader does: see Scene::targetError.
template <class Real>
void Pilot<Real>::addDifferences(
  const Values& a, const Values& b, const Patch& patch, Differences& differences) const
{
  const std::size_t pixels = b.hasCrossed.size();
  const std::size_t channels = a.light.size() / pixels;
  const Technique& technique = techniqueOf(bench_.scene.cutoff);
  const double weight = patch.weight;
  const auto columns = static_cast<std::size_t>(patch.columns);
  const auto rows = static_cast<std::size_t>(patch.rows);
  const auto slopeAt = [&](std::size_t pixel)
  {
    // What a shift by a pixel would change, at the most.
    double slope = 0;
    const std::size_t column = pixel % columns, row = pixel / columns;
    const auto look = [&](bool isThere, std::size_t other)
    {
      slope = isThere
        ? std::max(slope, std::abs(static_cast<double>(b.light[other] - b.light[pixel])))
        : slope;
    };
    look(column > 0, pixel - 1);
    look(column + 1 < columns, pixel + 1);
    look(row > 0, pixel - columns);
    look(row + 1 < rows, pixel + columns);
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
      const double ofPath =
        b.isClear[pixel] ? std::abs(a.path[pixel] - b.path[pixel]) / bench_.scene.wavelength : 0;
      differences.push_back({ std::max(ofLight / pi, ofPath), weight });
      continue;
    }
    differences.push_back({ ofLight, weight });
  }
}

template <class Real>
const typename Pilot<Real>::Exposed* Pilot<Real>::expose(
  Group& group, double step, int samples, const Monitor& monitor)
{
  const auto inserted = group.exposed.try_emplace({ step, samples });
  Exposed& exposed = inserted.first->second;
  if (!inserted.second)
  {
    return &exposed;
  }
  std::vector<const Traced*> passes;
  for (int number = 0; number < samples; ++number)
  {
    passes.push_back(trace(group, step, number, monitor));
    if (!passes.back())
    {
      group.exposed.erase(inserted.first);
      return nullptr;
    }
  }
  const PatchList& places = *group.patches;
  exposed.resize(places.size());
  parallelFor(static_cast<std::int64_t>(places.size()), 1, bench_.scene.threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n)
      {
        exposed[n] = expose(places[n], n, passes);
      }
    });
  return &exposed;
}

template <class Real>
Differences Pilot<Real>::compare(
  Patches patches, const PatchSettings& a, const PatchSettings& b, const Monitor& monitor)
{
  Differences all;
  const std::size_t set = layout_.isWhole ? 0 : static_cast<std::size_t>(patches);
  for (std::size_t place = 0; place < 2; ++place)
  {
    Group& group = groups_[set][place];
    const auto expose = [&](const PatchSettings& settings)
    {
      return this->expose(
        group, settings.step, place == 0 ? settings.samplesAtBodies : settings.samples, monitor);
    };
    const Exposed* ofA = expose(a);
    const Exposed* ofB = ofA ? expose(b) : nullptr;
    if (!ofB)
    {
      return {};
    }
    for (std::size_t n = 0; n < ofB->size(); ++n)
    {
      addDifferences((*ofA)[n], (*ofB)[n], (*group.patches)[n], all);
    }
  }
  return all;
}

template class Pilot<float>;
template class Pilot<double>;

} // namespace schlieren
