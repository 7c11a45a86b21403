// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Pilot.h"

#include "Bench/EdgeStage.h"
#include "Bench/StageSettings.h"
#include "Device/Parallel.h"
#include "Film/ProgressiveImage.h"
#include "Math/Units.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace schlieren
{

template <class Real>
Pilot<Real>::Pilot(const ViewSetup<Real>& setup, const Scene& scene)
  : setup_(setup)
  , scene_(scene)
  , scouts_(taskFor(longestStep, setup.medium.medium), setup_, scene_)
  , layout_(layOutPatches(scouts_, scene_.view, setup_.margin))
{
  for (std::size_t set = 0; set < 2; ++set)
  {
    for (std::size_t place = 0; place < patchPlaces; ++place)
    {
      groups_[set][place].patches = &layout_.sets[set][place];
      withVoxels_[set][place].patches = &layout_.ofVoxels[place];
      someWithVoxels_[set][place].patches = &layout_.someOfVoxels[place];
    }
  }
  for (std::size_t place = 0; place < patchPlaces; ++place)
  {
    withVoxels_[1][place].ofFiner = Part::All;
    someWithVoxels_[1][place].ofFiner = Part::Some;
  }
}

template <class Real>
RayTask<Real> Pilot<Real>::taskFor(double step, const Medium<Real>& medium) const
{
  RaySettings settings = setup_.settings;
  settings.stepVoxels = step;
  settings.adaptiveTolerance = adaptiveToleranceFor(step, settings.adaptiveTolerance);
  return makeTask(medium, setup_.light, settings);
}

template <class Real>
Pass Pilot<Real>::passOf(const Patch& patch, std::int64_t number, int samples) const
{
  Pass pass{ -patch.margin, -patch.margin, patch.columns + 2 * patch.margin,
    patch.rows + 2 * patch.margin, { 0, 0 } };
  aimPass(pass, number, samples, scene_, setup_.light);
  return pass;
}

template <class Real>
bool Pilot<Real>::trace(Group& group, const PassNumber& first, const Monitor& monitor)
{
  if (isPaused_)
  {
    return false;
  }
  const PatchList& places = *group.patches;
  constexpr std::size_t raysAtOnce = std::size_t{ 1 } << 20;
  std::vector<PassNumber> missing;
  std::vector<PassKey> keys;
  std::vector<Pass> passes;
  std::size_t rays = 0; // of a pass of all patches
  for (const Patch& patch : places)
  {
    rays += Passes(passOf(patch, 0, 1)).rays();
  }
  const std::size_t most =
    layout_.isWhole ? 1 : std::max<std::size_t>(1, raysAtOnce / std::max<std::size_t>(1, rays));
  for (PassNumber pass = first; pass.number < first.set->samples && missing.size() < most;
       ++pass.number)
  {
    if (group.traced.count(keyOf(pass)) == 0)
    {
      missing.push_back(pass);
      keys.push_back(keyOf(pass));
    }
    else if (pass.number == first.number)
    {
      return true;
    }
  }
  // Those of a patch one after the other: they read the same samples of the medium.
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    for (const PassNumber& pass : missing)
    {
      passes.push_back(passOf(places[n], pass.in(n), first.set->samples));
      passes.back().firstColumn += places[n].fromColumn;
      passes.back().firstRow += places[n].fromRow;
    }
  }
  TracedPass& together = group.underWay;
  if (together.tilesDone == 0 || group.keysUnderWay != keys)
  {
    together.resize(passes);
    group.keysUnderWay = keys;
  }
  if (group.ofFiner && !makeFiner(*group.ofFiner, monitor))
  {
    return false;
  }
  MediumOnDevices<Real>& medium = group.ofFiner ? *finer_ : setup_.medium;
  const Tracer<Real> tracer = group.ofFiner ? setup_.tracer.in(medium) : setup_.tracer;
  const bool isTraced = tracer.trace(taskFor(first.set->step, medium.medium), passes, together,
    { {}, monitor.aborted, monitor.paused });
  isPaused_ = monitor.paused && monitor.paused();
  if (!isTraced)
  {
    return false;
  }
  const RayExit* ray = together.exits.data();
  auto pass = passes.begin();
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    const Patch& patch = places[n];
    const double shift[2] = { static_cast<double>(patch.fromColumn - patch.column),
      static_cast<double>(patch.fromRow - patch.row) };
    for (const PassKey& key : keys)
    {
      RayExits& exits = group.traced[key].emplace_back().exits;
      exits.assign(ray, ray + pass->columns * pass->rows);
      ray += exits.size();
      ++pass;
      for (RayExit& exit : exits)
      {
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          exit.displacement[axis] +=
            static_cast<float>(shift[axis] / setup_.projection.perDataUnit);
        }
      }
    }
  }
  together = {};
  return true;
}

template <class Real>
const std::vector<PatchPixels>* Pilot<Real>::expose(
  Group& group, const RaySet& set, const Monitor& monitor)
{
  const PatchList& places = *group.patches;
  Exposed& exposed = group.exposed[set];
  for (std::size_t n = exposed.films.size(); n < places.size() && exposed.pixels.empty(); ++n)
  {
    exposed.films.emplace_back(places[n], scene_, cutoff_, setup_.projection, set.samples,
      layout_.isWhole ? scene_.threads : 1);
  }
  const auto withEach = [&](const auto& work)
  {
    parallelFor(static_cast<std::int64_t>(exposed.films.size()), 1, scene_.threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n)
        {
          work(n, exposed.films[n]);
        }
      });
  };
  const auto isTooMuch = [&](const std::vector<TracedPass>& rays)
  {
    return layout_.isWhole &&
      static_cast<std::size_t>(set.samples) * rays.front().bytes() > scene_.memoryBudget;
  };
  while (!exposed.films.empty() && exposed.films.front().passes() < set.samples)
  {
    const PassNumber number{ &set, exposed.films.front().passes() };
    if (!trace(group, number, monitor))
    {
      return nullptr;
    }
    const std::vector<TracedPass>& rays = group.traced[keyOf(number)];
    withEach(
      [&](std::size_t n, PatchFilm& film)
      {
        const Pass pass = passOf(places[n], number.in(n), set.samples);
        film.add(rays[n], pass);
      });
    if (isTooMuch(rays) && number.number + 1 < set.samples)
    {
      group.traced.erase(keyOf(number));
    }
  }
  if (!exposed.films.empty())
  {
    exposed.pixels.resize(places.size());
    withEach([&](std::size_t n, PatchFilm& film) { exposed.pixels[n] = film.develop(); });
    exposed.films.clear();
    const auto last =
      group.traced.find(keyOf({ &set, set.samples - 1 })); // until now its film needed it
    if (isTooMuch(last->second))
    {
      group.traced.erase(last);
    }
  }
  return &exposed.pixels;
}

template <class Real>
bool Pilot<Real>::compare(const Exposure& a, const Exposure& b, double factor, Edges edges,
  const Monitor& monitor, Differences& differences, const std::optional<Choice>& choice)
{
  const std::vector<PatchPixels>* ofA = expose(a.group, a.rays, monitor);
  const std::vector<PatchPixels>* ofB = ofA ? expose(b.group, b.rays, monitor) : nullptr;
  const std::vector<PatchPixels>* by =
    ofB && choice ? expose(a.group, choice->by, monitor) : nullptr;
  if (!ofB || (choice && !by))
  {
    return false;
  }
  for (std::size_t patch = 0; patch < ofB->size(); ++patch)
  {
    std::vector<bool> areCounted;
    if (choice)
    {
      areCounted = (*by)[patch].areAtEdge;
      if (!choice->areAtEdge)
      {
        areCounted.flip();
      }
    }
    addDifferences((*ofA)[patch], (*ofB)[patch], (*a.group.patches)[patch], factor, scene_,
      setup_.projection, differences, edges, choice ? &areCounted : nullptr);
  }
  return true;
}

template <class Real>
Differences Pilot<Real>::compare(Patches patches, const PatchSettings& a, const PatchSettings& b,
  const Monitor& monitor, double factorAtEdges)
{
  Differences all;
  const std::size_t set = layout_.isWhole ? 0 : static_cast<std::size_t>(patches);
  for (std::size_t n = 0; n < patchPlaces; ++n)
  {
    Group& group = groups_[set][n];
    const auto place = static_cast<PatchPlace>(n);
    const auto compareRays = [&](
                               int samplesOfA, int samplesOfB, const std::optional<Choice>& choice)
    {
      const RaySet raysOfA{ a.step, samplesOfA };
      RaySet raysOfB{ b.step, samplesOfB };
      const bool isOfRays = samplesOfB > samplesOfA;
      const bool isOfAperture = setup_.light.pupilTilt > 0; // whose points are as many as the rays
      if (isOfRays && !isOfAperture && !layout_.isWhole)
      {
        constexpr int moreAtBodies = 4, most = 16; // what steps are compared with, too
        raysOfB.areOthers = place == PatchPlace::Border;
        raysOfB.samples = place == PatchPlace::Body
          ? std::max(raysOfB.samples, std::min(moreAtBodies * raysOfB.samples, most))
          : raysOfB.samples;
      }
      // The error falls as one over the number of rays, about. At edges of bodies in focus those of the halves of twice as many
      // are independent; on a screen it falls as the side of the squares that rays light.
      const Technique& technique = techniqueOf(scene_.cutoff);
      const bool areEdges = place == PatchPlace::Body && !layout_.isWhole;
      const double fewer = static_cast<double>(samplesOfA) / raysOfB.samples;
      double part = isOfRays ? 1 - fewer : 1;
      if (raysOfB.areOthers)
      {
        constexpr double partOfOthers = 0.85; // they err, too, and some see nothing of an edge
        part = partOfOthers;
      }
      else if (isOfRays && areEdges && technique.plane == RecordedPlane::Screen)
      {
        part = 1 - std::sqrt(fewer);
      }
      else if (isOfRays && areEdges && technique.plane == RecordedPlane::Focus &&
        !technique.hasFringes && fewer >= 0.5)
      {
        part = std::sqrt(1 - fewer);
      }
      const double factor = (choice && choice->areAtEdge ? factorAtEdges : 1) / part;
      return compare(
        { group, raysOfA }, { group, raysOfB }, factor, Edges::Count, monitor, all, choice);
    };
    bool isDone = false;
    if (place != PatchPlace::Body)
    {
      isDone = compareRays(a.samples, b.samples, {});
    }
    else if (!a.areAtEdges)
    {
      isDone = compareRays(a.samplesAtBodies, b.samplesAtBodies, {});
    }
    else
    {
      const RaySet beside{ a.step, a.samples };
      isDone = compareRays(a.samplesAtBodies, b.samplesAtBodies, Choice{ beside, true }) &&
        compareRays(a.samples, b.samples, Choice{ beside, false });
    }
    if (!isDone)
    {
      return {};
    }
  }
  return all;
}

template <class Real>
bool Pilot<Real>::maySplitRays() const
{
  return !layout_.isWhole && EdgeTiles::arePossible(scene_, setup_.light, setup_.movedInFocus);
}

template <class Real>
std::optional<double> Pilot<Real>::partOfEdges(double step, int samples, const Monitor& monitor)
{
  Group& bodies = groups_[0][static_cast<std::size_t>(PatchPlace::Body)];
  if (!maySplitRays())
  {
    return {};
  }
  const std::vector<PatchPixels>* exposed = expose(bodies, { step, samples }, monitor);
  if (!exposed)
  {
    return {};
  }
  double pixels = 0;
  for (std::size_t patch = 0; patch < exposed->size(); ++patch)
  {
    pixels += (*bodies.patches)[patch].weight * static_cast<double>((*exposed)[patch].withRays);
  }
  return pixels / (static_cast<double>(scene_.view.width) * scene_.view.height);
}

template <class Real>
Differences Pilot<Real>::slopesAtEdges(
  Patches patches, const PatchSettings& settings, const Monitor& monitor)
{
  Differences all;
  const std::size_t set = layout_.isWhole ? 0 : static_cast<std::size_t>(patches);
  for (std::size_t n = 0; n < patchPlaces; ++n)
  {
    Group& group = groups_[set][n];
    const bool isAtBodies = static_cast<PatchPlace>(n) == PatchPlace::Body;
    const std::vector<PatchPixels>* exposed = expose(
      group, { settings.step, isAtBodies ? settings.samplesAtBodies : settings.samples }, monitor);
    if (!exposed)
    {
      return {};
    }
    for (std::size_t patch = 0; patch < exposed->size(); ++patch)
    {
      addSlopesAtEdges((*exposed)[patch], (*group.patches)[patch], scene_, all);
    }
  }
  return all;
}

template <class Real>
bool Pilot<Real>::makeFiner(Part part, const Monitor& monitor)
{
  if (!finer_ || finerPart_ < part)
  {
    const Frame& frame = setup_.key.frame;
    constexpr double mostBent = 4; // pixels, away from straight light
    std::vector<Column::Part> parts;
    for (const PatchList& list : part == Part::All ? layout_.ofVoxels : layout_.someOfVoxels)
    {
      for (const Patch& patch : list)
      {
        const std::int64_t from[2] = { patch.fromColumn, patch.fromRow };
        const std::int64_t size[2] = { patch.columns, patch.rows };
        const double bent = std::min(mostBent,
          scouts_.largestDeflectionAround(from[0], from[1], size[0], size[1]) *
            (frame.exit - frame.entry) / frame.pixelSize);
        Column::Part around{};
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          const double half = 0.5 * static_cast<double>(size[axis]);
          around.middle[axis] =
            frame.origin[axis] + (static_cast<double>(from[axis]) + half - 0.5) * frame.pixelSize;
          around.halfWidth[axis] =
            (half + static_cast<double>(patch.margin) + bent) * frame.pixelSize;
        }
        parts.push_back(around);
      }
    }
    finer_ = std::make_unique<MediumOnDevices<Real>>(
      finerIn(finer_ ? std::move(finer_->medium) : copyOf(setup_.medium.medium), further_,
        std::move(parts), { {}, monitor.aborted, {} }));
    finerPart_ = part;
    if (monitor.aborted && monitor.aborted())
    {
      finer_.reset();
    }
  }
  return finer_ != nullptr;
}

template <class Real>
Differences Pilot<Real>::ofVoxels(
  const PatchSettings& settings, double tolerance, Part part, const Monitor& monitor)
{
  auto& groups = part == Part::All ? withVoxels_ : someWithVoxels_;
  further_ = tolerance;
  Differences all;
  for (std::size_t n = 0; n < patchPlaces; ++n)
  {
    const bool isAtBodies = static_cast<PatchPlace>(n) == PatchPlace::Body;
    const int samples = isAtBodies ? settings.samplesAtBodies : settings.samples;
    const RaySet rays{ settings.step, samples };
    if (!compare(
          { groups[0][n], rays }, { groups[1][n], rays }, 1, Edges::DoNotCount, monitor, all))
    {
      return {};
    }
  }
  return all;
}

template class Pilot<float>;
template class Pilot<double>;

} // namespace schlieren
