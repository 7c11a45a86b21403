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
constexpr double pixelsOfSet = 1024;  ///< of patches, about

constexpr std::int64_t around = 2; ///< pixels, what the film knows of a pixel's neighbours

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

  scoutColumns_ = pass.columns;
  scoutRows_ = pass.rows;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  Differences slopes; // of the path: deflections
  for (std::int64_t row = 0; row < pass.rows; ++row)
  {
    for (std::int64_t column = 0; column < pass.columns; ++column)
    {
      const RayExit& exit = traced.exits[static_cast<std::size_t>(row * pass.columns + column)];
      scouts_.push_back({ exit.fate, { exit.deflection[0], exit.deflection[1] }, { 0, 0 } });
      if (exit.fate != RayFate::Left)
      {
        continue;
      }
      const FilmShift shift = shiftOnFilm(exit.deflection, exit.displacement,
        static_cast<double>(column * stride_) + middle, static_cast<double>(row * stride_) + middle,
        pass.tilt, bench_.projection);
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        scouts_.back().moved[axis] = bench_.projection.perDataUnit * shift.moved[axis];
      }
      ++view_.crossed;
      const double* eps = exit.deflection;
      view_.largestDeflection = std::max(view_.largestDeflection, std::hypot(eps[0], eps[1]));
      slopes.push_back({ std::hypot(eps[0], eps[1]), 1 });
      lowest = std::min(lowest, exit.opticalPathDifference);
      highest = std::max(highest, exit.opticalPathDifference);
    }
  }
  view_.path = view_.crossed > 0 ? highest - lowest : 0;
  view_.steepestPath =
    percentile99(slopes) * bench_.settings.lengthScale / bench_.projection.perDataUnit;
  view_.strongDeflection = strongDeflection({ pass, traced.exits.data(), nullptr },
    static_cast<int>(pass.columns), static_cast<int>(pass.rows), errors, threads);
}

template <class Real>
const typename Pilot<Real>::Scout* Pilot<Real>::scoutAt(std::int64_t column, std::int64_t row) const
{
  return column >= 0 && column < scoutColumns_ && row >= 0 && row < scoutRows_
    ? &scouts_[static_cast<std::size_t>(row * scoutColumns_ + column)]
    : nullptr;
}

/// By how much the light of neighbouring rays differs from a linear change. That of fringes changes as the path does, that of
/// cutoffs as the deflection, and that of a screen as the area J on which it lands: by J' / J^2.
template <class Real>
double Pilot<Real>::variationAt(std::int64_t column, std::int64_t row) const
{
  const Technique& technique = techniqueOf(bench_.scene.cutoff);
  const Scout& here = *scoutAt(column, row);
  if (technique.hasFringes)
  {
    return std::hypot(here.deflection[0], here.deflection[1]);
  }
  const bool isOnScreen = technique.plane == RecordedPlane::Screen;
  double variation = 0;
  double slopes[2][2] = { { 1, 0 }, { 0, 1 } }; // of where rays land
  for (const std::int64_t up : { 0, 1 })
  {
    const Scout* before = scoutAt(column - 1 + up, row - up);
    const Scout* after = scoutAt(column + 1 - up, row + up);
    for (std::size_t axis = 0; axis < 2 && before && after; ++axis)
    {
      const auto value = [&](const Scout& scout)
      { return isOnScreen ? scout.moved[axis] : scout.deflection[axis]; };
      variation += std::abs(value(*after) - 2 * value(here) + value(*before));
      slopes[up][axis] +=
        (after->moved[axis] - before->moved[axis]) / (2 * static_cast<double>(stride_));
    }
  }
  const double area = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0];
  constexpr double smallest = 0.1;
  return isOnScreen ? variation / std::max(smallest * smallest, area * area) : variation;
}

/// What of that there is where rays land.
template <class Real>
std::vector<double> Pilot<Real>::variationsOnFilm() const
{
  std::vector<double> variations(scouts_.size(), 0);
  for (std::int64_t row = 0; row < scoutRows_; ++row)
  {
    for (std::int64_t column = 0; column < scoutColumns_; ++column)
    {
      const Scout& scout = *scoutAt(column, row);
      const auto landing = [&](std::int64_t from, std::size_t axis, std::int64_t count)
      {
        const double place = static_cast<double>(from) +
          (isShifted() ? scout.moved[axis] / static_cast<double>(stride_) : 0);
        return static_cast<std::int64_t>(
          std::lround(std::clamp(place, 0., static_cast<double>(count - 1))));
      };
      double& there = variations[static_cast<std::size_t>(
        landing(row, 1, scoutRows_) * scoutColumns_ + landing(column, 0, scoutColumns_))];
      there = std::max(there, variationAt(column, row));
    }
  }
  return variations;
}

/// Divides the view into cells, of one scout or as large as a patch, and these into strata.
template <class Real>
void Pilot<Real>::layOut()
{
  const std::int64_t size = (Patch::edge + stride_ - 1) / stride_; // scouts
  const std::vector<double> variations = variationsOnFilm();
  Cells within, atBodies, atBorders;
  for (std::int64_t row = 0; row < scoutRows_; row += size)
  {
    for (std::int64_t column = 0; column < scoutColumns_; column += size)
    {
      bool hasCrossing = false, hasBody = false, hasBorder = false;
      double variation = 0;
      for (std::int64_t j = row - 1; j <= row + size; ++j)
      {
        for (std::int64_t i = column - 1; i <= column + size; ++i)
        {
          const Scout* scout = scoutAt(i, j);
          if (!scout) // what is there is unknown
          {
            hasBorder = true;
            continue;
          }
          const bool isCrossing = scout->fate == RayFate::Left;
          hasCrossing = hasCrossing || isCrossing;
          hasBorder = hasBorder || scout->fate == RayFate::Missed;
          hasBody = hasBody || (!isCrossing && scout->fate != RayFate::Missed);
          variation =
            std::max(variation, variations[static_cast<std::size_t>(j * scoutColumns_ + i)]);
        }
      }
      if (hasCrossing)
      {
        (hasBody        ? atBodies
            : hasBorder ? atBorders
                        : within)
          .push_back({ column * stride_, row * stride_, variation });
      }
    }
  }
  constexpr std::size_t perStrong = 12; // of so many cells one
  Cells sorted = within;
  const auto rank = static_cast<std::ptrdiff_t>(sorted.size() / perStrong);
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end(),
    [](const Cell& a, const Cell& b) { return a.variation > b.variation; });
  const double least = sorted.empty() ? 0 : sorted[static_cast<std::size_t>(rank)].variation;
  const auto weak = std::stable_partition(
    within.begin(), within.end(), [&](const Cell& cell) { return cell.variation > least; });
  spread(Cells(within.begin(), weak), 0.25 * pixelsOfSet);
  spread(Cells(weak, within.end()), 0.375 * pixelsOfSet);
  spread(atBodies, 0.25 * pixelsOfSet);
  spread(atBorders, 0.125 * pixelsOfSet);

  takeWholeIfCheaper();
}

/// Makes the image the only patch where others miss their light, or where the rays around them are more than that takes.
template <class Real>
void Pilot<Real>::takeWholeIfCheaper()
{
  const View& view = bench_.scene.view;
  double moved = 0;
  for (const Scout& scout : scouts_)
  {
    moved = std::max({ moved, std::abs(scout.moved[0]), std::abs(scout.moved[1]) });
  }
  const auto margin =
    static_cast<std::int64_t>(std::min(static_cast<double>(std::max(view.width, view.height)) / 2,
      static_cast<double>(around) + std::ceil(moved)));
  Patch whole{ 0, 0, 1, 0, 0, std::min(bench_.margin, margin), view.width, view.height };
  if (bench_.projection.isOfCamera)
  {
    whole.margin = around;
  }
  const auto raysOf = [](const Patch& patch)
  {
    return static_cast<double>(
      (patch.columns + 2 * patch.margin) * (patch.rows + 2 * patch.margin));
  };
  double rays = 0;
  for (const PatchList& patches : patches_)
  {
    for (const Patch& patch : patches)
    {
      rays += raysOf(patch);
    }
  }
  constexpr double mostLost = 0.02, mostRays = 4; // of both sets
  const double patches = static_cast<double>(patches_[0].size() + patches_[1].size());
  if (static_cast<double>(lost_) > mostLost * patches || rays > mostRays * raysOf(whole))
  {
    isWhole_ = true;
    patches_[0] = { whole };
    patches_[1].clear();
  }
}

/// Puts patches with so many pixels into each set, in some of these cells: one of each few, in the order of rows, so that no
/// column is left out.
template <class Real>
void Pilot<Real>::spread(const Cells& cells, double pixels)
{
  const View& view = bench_.scene.view;
  constexpr std::int64_t edge = Patch::edge;
  const std::int64_t size = std::max(stride_, (edge + stride_ - 1) / stride_ * stride_);
  const auto within = [&](std::int64_t first, std::int64_t pixelsOfView)
  { return std::max<std::int64_t>(0, std::min(first + (size - edge) / 2, pixelsOfView - edge)); };
  const auto most = static_cast<std::size_t>(2 * pixels / static_cast<double>(edge * edge));
  const std::size_t places = std::min(cells.size(), most);
  const double weight = static_cast<double>(cells.size()) * static_cast<double>(size * size) /
    (0.5 * static_cast<double>(places) * static_cast<double>(edge * edge));
  for (std::size_t n = 0; n < places; ++n)
  {
    constexpr double goldenRatio = 0.6180339887498949;
    const double jitter = std::fmod(goldenRatio * static_cast<double>(n + 1), 1.);
    const double perPlace = static_cast<double>(cells.size()) / static_cast<double>(places);
    const Cell& cell =
      cells[static_cast<std::size_t>((static_cast<double>(n) + jitter) * perPlace)];
    const std::int64_t column = within(cell.column, view.width),
                       row = within(cell.row, view.height);
    Patch patch{ column, row, weight, column, row };
    lost_ += findOrigin(patch) ? 0 : 1;
    patches_[n % 2].push_back(patch);
  }
}

/// Whether patches receive light from elsewhere. Fringes need the paths of their own pixels, and are in focus.
template <class Real>
bool Pilot<Real>::isShifted() const
{
  return !bench_.projection.isOfCamera && !techniqueOf(bench_.scene.cutoff).hasFringes;
}

/// Looks at the squares between four scouts: which of them are spread over the patch?
template <class Real>
bool Pilot<Real>::findOrigin(Patch& patch) const
{
  constexpr double mostAround = 24;
  const double low[2] = { static_cast<double>(patch.column) - 1,
    static_cast<double>(patch.row) - 1 };
  double least[2] = { 0, 0 }, most[2] = { 0, 0 };
  bool isFound = false;
  for (std::int64_t row = 0; row + 1 < scoutRows_ && !bench_.projection.isOfCamera; ++row)
  {
    for (std::int64_t column = 0; column + 1 < scoutColumns_; ++column)
    {
      constexpr double infinite = std::numeric_limits<double>::infinity();
      double lowMoved[2] = { infinite, infinite }, highMoved[2] = { -infinite, -infinite };
      double lowPlace[2] = { infinite, infinite }, highPlace[2] = { -infinite, -infinite };
      for (std::int64_t corner = 0; corner < 4; ++corner)
      {
        const std::int64_t at[2] = { column + corner % 2, row + corner / 2 };
        const Scout& scout = *scoutAt(at[0], at[1]);
        if (scout.fate != RayFate::Left && scout.fate != RayFate::Missed)
        {
          continue;
        }
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          const double place =
            (static_cast<double>(at[axis]) + 0.5) * static_cast<double>(stride_) - 0.5 +
            scout.moved[axis];
          lowMoved[axis] = std::min(lowMoved[axis], scout.moved[axis]);
          highMoved[axis] = std::max(highMoved[axis], scout.moved[axis]);
          lowPlace[axis] = std::min(lowPlace[axis], place);
          highPlace[axis] = std::max(highPlace[axis], place);
        }
      }
      bool isOver = true;
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        isOver = isOver && lowPlace[axis] <= low[axis] + static_cast<double>(Patch::edge) + 1 &&
          highPlace[axis] >= low[axis];
      }
      for (std::size_t axis = 0; axis < 2 && isOver; ++axis)
      {
        least[axis] = isFound ? std::min(least[axis], lowMoved[axis]) : lowMoved[axis];
        most[axis] = isFound ? std::max(most[axis], highMoved[axis]) : highMoved[axis];
      }
      isFound = isFound || isOver;
    }
  }
  double spreadOf = 0;
  std::int64_t moved[2] = { 0, 0 };
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double middle = isShifted() ? std::round(0.5 * (least[axis] + most[axis])) : 0;
    moved[axis] = static_cast<std::int64_t>(middle);
    spreadOf = std::max({ spreadOf, most[axis] - middle, middle - least[axis] });
  }
  patch.fromColumn = patch.column - moved[0];
  patch.fromRow = patch.row - moved[1];
  patch.margin = static_cast<std::int64_t>(
    std::min(static_cast<double>(around) + std::ceil(spreadOf), mostAround));
  return spreadOf <= mostAround;
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
  Patches patches, double step, int number, const Monitor& monitor)
{
  const std::size_t set = indexOf(patches);
  Traced& traced = traced_[set][{ step, number }];
  const PatchList& places = patches_[set];
  if (traced.size() == places.size())
  {
    return &traced;
  }
  Traced rays(places.size());
  const RayTask<Real> whole = taskFor(step);
  const bool isDone = parallelFor(static_cast<std::int64_t>(places.size()), 1, bench_.scene.threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t n = begin; n < end; ++n)
      {
        const Patch& patch = places[static_cast<std::size_t>(n)];
        RayTask<Real> task = whole;
        task.light = lightOfPart(bench_.light, static_cast<double>(patch.fromColumn),
          static_cast<double>(patch.fromRow), 1);
        const Pass pass = passOf(patch, number);
        TracedPass& ofPatch = rays[static_cast<std::size_t>(n)];
        ofPatch.resize(pass, 0);
        traceOnCpu(task, pass, ofPatch, isWhole_ ? bench_.scene.threads : 1, {});
        const double shift[2] = { static_cast<double>(patch.fromColumn - patch.column),
          static_cast<double>(patch.fromRow - patch.row) };
        for (RayExit& exit : ofPatch.exits)
        {
          for (std::size_t axis = 0; axis < 2; ++axis)
          {
            exit.displacement[axis] +=
              static_cast<float>(shift[axis] / bench_.projection.perDataUnit);
          }
        }
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
    bench_.projection, static_cast<double>(patch.fromColumn), static_cast<double>(patch.fromRow));
  FilmSettings settings = filmSettingsOf(bench_.scene);
  settings.width = static_cast<int>(patch.columns);
  settings.height = static_cast<int>(patch.rows);
  settings.samplesPerPixel = static_cast<int>(passes.size());
  settings.noiseFilter = NoiseFilter::None;
  settings.isOfCamera = false;
  settings.threads = isWhole_ ? bench_.scene.threads : 1;
  ProgressiveImage film(settings);
  const std::int64_t columns = patch.columns + 2 * patch.margin;
  const std::int64_t rays = columns * (patch.rows + 2 * patch.margin);
  film.begin(
    { *cutoff_, projection, patch.margin, rays * passesToHold(settings.samplesPerPixel) }, {});
  for (std::size_t number = 0; number < passes.size(); ++number)
  {
    film.add((*passes[number])[index], passOf(patch, static_cast<std::int64_t>(number)),
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
          [&](const Traced* pass) { return (*pass)[index].exits[ray].fate == RayFate::Left; }));
      values.isClear.push_back(passes.front()->at(index).exits[ray].reachesFilm());
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
  Patches patches, const Settings& settings, const Monitor& monitor)
{
  const std::size_t set = indexOf(patches);
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
    addDifferences((*ofA)[n], (*ofB)[n], patches_[indexOf(patches)][n], all);
  }
  return all;
}

template class Pilot<float>;
template class Pilot<double>;

} // namespace schlieren
