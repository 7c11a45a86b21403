// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/TargetError.h"

#include "Bench/Ladder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

constexpr double coarsestTolerance = 0.01, finestTolerance = 3e-4;

/// What a medium is made with, usually, and where its error exceeds the target. The usual error of voxels is half of a target of 1 / 256
/// then, where it is largest (a blunt fin, 512 pixels: 0.0016 of full scale in 99 % of the pixels; 0.0036 with 0.006).
constexpr double firstTolerance = 0.0035, refinedTolerance = 0.001;

/// For what the patches have not seen.
constexpr double margin = 1.2;

double sumOf(double a, double b, double c = 0, double d = 0)
{
  return std::sqrt(a * a + b * b + c * c + d * d);
}

/// What may change where voxels move edges of bodies, by what a shift by a pixel would change: they are moved as normally
/// distributed, but for an eighth, which is moved further; each by the medians of eight equal shares of that. `invisible`:
/// pixels of a shift that do not count.
Differences atMovedEdges(const Differences& slopes, double invisible)
{
  constexpr double deviation = 0.02; // pixels
  constexpr std::array<double, 8> shifts{ 0.08, 0.24, 0.40, 0.58, 0.78, 1.01, 1.32, 2.8 };
  Differences moved;
  for (const Difference& slope : slopes)
  {
    for (const double shift : shifts)
    {
      moved.push_back({ std::max(0., deviation * shift - invisible) * slope.value,
        slope.pixels / shifts.size() });
    }
  }
  return moved;
}

ErrorSource limitOf(double ofSteps, double ofRays, const KnownErrors& known)
{
  const std::array<std::pair<double, ErrorSource>, 4> all{ {
    { ofSteps, ErrorSource::Steps },
    { ofRays, ErrorSource::RaysPerPixel },
    { known.voxels, ErrorSource::Voxels },
    { known.rounding, ErrorSource::Rounding },
  } };
  const auto most = std::max_element(
    all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return most->first > 0 ? most->second : ErrorSource::None;
}

/// The fewest rays, and then the longest steps, whose errors keep the target together. Where none do, the cheapest ones that
/// come as close to it.
template <class Real>
class Choice
{
public:
  /// `aim`: no more than the target, for what other patches may show.
  Choice(double aim, double target, Ladder<Real>& ladder, const KnownErrors& known)
    : aim_(aim)
    , target_(target)
    , ladder_(ladder)
    , known_(known)
    , settings_{ ladder.longest(), raysPerPixel.front(), {} }
  {
  }

  AccurateSettings cheapest()
  {
    const double fixed = sumOf(known_.voxels, known_.rounding);
    // Where nothing can keep the target, the rest shall not add to that.
    const double least = std::max(0.5 * aim_ / margin, negligible * fixed);
    const double allowed =
      std::sqrt(std::max(aim_ * aim_ / (margin * margin) - fixed * fixed, least * least));
    constexpr double shareOfRays = 0.9; // steps need something, too
    const double ofSteps = (1 - shareOfRays * shareOfRays) * allowed * allowed; // squared
    double most = shareOfRays * allowed;
    // Steps that are to be looked at in any case: where none are short enough, many rays would gain nothing.
    settings_.samples = raysPerPixel.back();
    chooseStep(allowed * allowed);
    if (ofSteps_ > allowed)
    {
      most = std::max(most, std::sqrt(more_ * more_ - 1) * ofSteps_);
      if (more_ >= moreAstray &&
        ladder_.isOfWholeImage()) // each pass takes as long as one of the image
      {
        settings_.samples = raysPerPixel.front();
        ofSteps_ = ladder_.ofStep(settings_.step, settings_.samples);
        spare();
        settings_.accuracy = { aim_, errorNow(), 0, ErrorSource::Steps };
        return settings_;
      }
    }
    chooseRays(most);
    // By something larger that nothing can mend.
    const double beside = ofRays_ > allowed ? negligible * ofRays_ : 0;
    chooseStep(std::max({ allowed * allowed - ofRays_ * ofRays_, ofSteps, beside * beside }));
    double mostOfAll = std::max(aim_, errorNow());
    if (errorNow() > target_)
    {
      mostOfAll = more_ * errorNow();
      spare();
    }
    settings_.accuracy = { aim_, errorNow(), 0, limitOf(ofSteps_, ofRays_, known_) };
    takeFewerBesideEdges(mostOfAll);
    return settings_;
  }

private:
  static constexpr double negligible = 0.3; ///< by something larger
  /// By how much an error that exceeds the target may grow so that it is about the same; and where light goes astray, so that
  /// steps of half the length are hardly better.
  static constexpr double moreUsually = 1.25, moreAstray = 2;

  double errorNow() const
  {
    return margin * sumOf(ofRays_, ofSteps_, known_.voxels, known_.rounding);
  }

  void chooseRays(double most)
  {
    for (const int samples : raysPerPixel)
    {
      settings_.samples = samples;
      ofRays_ = ladder_.ofRays(samples, most);
      if (ofRays_ <= most)
      {
        break;
      }
    }
  }

  /// Takes fewer rays where no edges of bodies are, if with them all of the error is within what is allowed.
  void takeFewerBesideEdges(double most)
  {
    const int atEdges = settings_.samples;
    for (const int samples : raysPerPixel)
    {
      constexpr double mostOfCost = 0.75; // more is not worth looking at it
      const double part = samples < atEdges ? ladder_.partOfEdges(samples) : 1;
      if (part <= 0 || samples + part * atEdges > mostOfCost * atEdges)
      {
        return;
      }
      const double error = ladder_.ofRaysBesideEdges(samples, atEdges);
      const double all = margin * sumOf(error, ofSteps_, known_.voxels, known_.rounding);
      if (all <= most)
      {
        settings_.samples = samples;
        settings_.samplesAtEdges = atEdges;
        settings_.accuracy.reached = all;
        return;
      }
    }
  }

  /// Looks at shorter steps until they suffice, or until none will.
  void chooseStep(double mostSquared)
  {
    constexpr double mostGain = 4, trust = 1.25, hardly = 1.75;
    const double most = std::sqrt(mostSquared);
    double before = std::numeric_limits<double>::infinity();
    for (double step = ladder_.longest(); step >= shortestStep; step *= 0.5)
    {
      settings_.step = step;
      ofSteps_ = ladder_.ofStep(step, settings_.samples);
      const double gain = trust * std::clamp(before / ofSteps_, 1., mostGain);
      const double halvings = std::log2(step / shortestStep);
      if (ofSteps_ <= most)
      {
        break;
      }
      if (ofSteps_ > std::pow(gain, halvings) * most)
      {
        more_ = gain > hardly ? moreUsually : moreAstray;
        break;
      }
      before = ofSteps_;
    }
  }

  /// Takes fewer rays and longer steps, of those that have been looked at, where the target cannot be kept and the error is
  /// about the same.
  void spare()
  {
    const double most = more_ * errorNow();
    const Choice finest = *this;
    double leastCost = static_cast<double>(finest.settings_.samples) / finest.settings_.step;
    for (const int samples : raysPerPixel)
    {
      for (double step = ladder_.longest();
           samples <= finest.settings_.samples && step >= finest.settings_.step; step *= 0.5)
      {
        Choice other = finest;
        other.settings_.samples = samples;
        other.settings_.step = step;
        other.ofRays_ = samples < finest.settings_.samples ? ladder_.ofRays(samples, finest.ofRays_)
                                                           : finest.ofRays_;
        other.ofSteps_ = ladder_.ofStep(step, samples);
        const double cost = samples / step;
        if (cost < leastCost && other.errorNow() <= most)
        {
          leastCost = cost;
          settings_ = other.settings_;
          ofRays_ = other.ofRays_;
          ofSteps_ = other.ofSteps_;
        }
      }
    }
  }

  double aim_, target_;
  Ladder<Real>& ladder_;
  const KnownErrors& known_;
  AccurateSettings settings_;
  double ofRays_ = 0, ofSteps_ = 0;
  double more_ = moreUsually;
};

} // namespace

double toleranceForTarget(const Field& field, const Scene& scene)
{
  double tolerance = firstTolerance;
  if (techniqueOf(scene.cutoff).hasFringes)
  {
    const Box all = field.source->bounds();
    const MediumSource::Content content = field.source->contentOf(all);
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      square += (all.high[axis] - all.low[axis]) * (all.high[axis] - all.low[axis]);
    }
    // A third of the most fringes, each of which is wrong by half of the tolerance.
    const double fringes =
      (content.highest - content.lowest) * std::sqrt(square) * field.lengthScale / scene.wavelength;
    tolerance = fringes > 0 ? 6 * scene.targetError / fringes : coarsestTolerance;
  }
  return std::clamp(tolerance, finestTolerance, coarsestTolerance);
}

/// Whether what is compared is of one ray per pixel, however many there are: of a pattern seen through a pinhole.
template <class Real>
bool needsOneRay(const Pilot<Real>& pilot)
{
  return isOfCamera(pilot.scene().cutoff) && !(pilot.setup().projection.pupilTilt > 0);
}

template <class Real>
bool hasWalls(const Medium<Real>& medium)
{
  return !medium.solid.empty() || (medium.tree && !medium.tree->gasDistances().empty());
}

template <class Real>
StepRange stepsFor(const Pilot<Real>& pilot)
{
  const Medium<Real>& medium = pilot.setup().medium.medium;
  return stepsFor(medium, hasWalls(medium), !needsOneRay(pilot));
}

bool hasFinerMedium(const Scene& scene, bool isMemoryShort)
{
  return scene.mediumTolerance > refinedTolerance && !isMemoryShort;
}

/// Whether voxels are too large for the target.
bool areTooLarge(const KnownErrors& known, const Scene& scene)
{
  return known.voxels > scene.targetError / margin;
}

template <class Real>
KnownErrors knownErrors(Pilot<Real>& pilot, const Monitor& monitor)
{
  const Scene& scene = pilot.scene();
  KnownErrors known;
  if (techniqueOf(scene.cutoff).hasFringes && scene.precision == Precision::Single)
  {
    constexpr double roundingOfPath = 1.7e-7; // of itself
    known.rounding = roundingOfPath * pilot.view().path / scene.wavelength;
  }
  if (const MediumTree<Real>* tree = pilot.setup().medium.medium.tree.get())
  {
    const double tolerance = scene.mediumTolerance;
    const double further = tolerance * (tolerance > refinedTolerance ? 1. / 8 : 1. / 3);
    constexpr double step = 0.5;
    using Part = typename Pilot<Real>::Part;
    const auto lookAt = [&](Part part)
    {
      PatchSettings settings = stepsFor(pilot).with(step);
      const auto look = [&]
      {
        // What is compared errs, too, in proportion to its tolerance.
        known.voxels = exceededBy(mayExceed, pilot.ofVoxels(settings, further, part, monitor)) /
          (1 - further / tolerance);
      };
      look();
      // Single rays see in finer voxels what the mean of a pixel does not.
      if (areTooLarge(known, scene) && !needsOneRay(pilot) && !pilot.isPaused())
      {
        constexpr int ofMean = 16;
        settings.samples = settings.samplesAtBodies = ofMean;
        look();
      }
    };
    // Finer voxels take long, and some may show that those of the image do not suffice.
    if (hasFinerMedium(scene, tree->statistics().isMemoryShort))
    {
      lookAt(Part::Some);
    }
    if (!areTooLarge(known, scene) && !pilot.isPaused())
    {
      lookAt(Part::All);
    }
    if (!pilot.isPaused())
    {
      pilot.dropFiner();
    }
  }
  return known;
}

bool refine(const KnownErrors& known, bool isMemoryShort, Scene& scene)
{
  constexpr double shareOfRounding = 0.25;
  if (scene.precision == Precision::Single &&
    known.rounding > shareOfRounding * scene.targetError / margin)
  {
    scene.precision = Precision::Double;
    return true;
  }
  if (areTooLarge(known, scene) && hasFinerMedium(scene, isMemoryShort))
  {
    scene.mediumTolerance = refinedTolerance;
    return true;
  }
  return false;
}

/// Fringes that so many rays cannot resolve are grey at best, whatever is chosen.
template <class Real>
bool areFringesResolved(const Pilot<Real>& pilot)
{
  const double finest = std::sqrt(raysPerPixel.back()); // by pixel
  const Scene& scene = pilot.scene();
  return !techniqueOf(scene.cutoff).hasFringes ||
    pilot.view().steepestPath / scene.wavelength <= finest;
}

/// Finds what other patches say of settings, and writes it into them. Nothing if aborted. `looksAtRays`: also at what more rays
/// would change.
template <class Real>
void verify(AccurateSettings& settings, Pilot<Real>& pilot, const StepRange& steps,
  const KnownErrors& known, bool looksAtRays, const Monitor& monitor)
{
  using Patches = typename Pilot<Real>::Patches;
  const Scene& scene = pilot.scene();
  // No steps are traced that are finer than the shortest, whose error is half of that of twice its length at the most.
  const double step = std::max(settings.step, 2 * shortestStep);
  const double bySteps = errorByHalving * settings.step / step;
  const Differences ofSteps =
    pilot.compare(Patches::ToVerify, steps.with(step), steps.with(0.5 * step), monitor);
  Differences ofRays;
  if (!needsOneRay(pilot) && looksAtRays)
  {
    const int samples = settings.samples, atEdges = settings.samplesAtEdges;
    const auto compare = [&](int fewer, int more)
    {
      const bool isSplit = atEdges > 0;
      return pilot.compare(Patches::ToVerify,
        { steps.longest, fewer, isSplit ? atEdges : fewer, isSplit },
        { steps.longest, more, isSplit ? 2 * atEdges : more, isSplit }, monitor);
    };
    const bool isOnScreen = techniqueOf(scene.cutoff).plane == RecordedPlane::Screen;
    // Where the image is the patch, that would take longer than the image, and these rays are traced.
    const bool isTraced = samples > fewRays && pilot.isWhole();
    ofRays = isTraced
      ? compare(samples / fewRays, samples)
      : compare(samples,
          samples <= fewRays || isOnScreen ? manyMoreThan(samples, scene.cutoff) : 2 * samples);
    constexpr double notable = 0.5;
    if (exceededBy(mayExceedOfSample, ofRays) > notable * scene.targetError &&
      areFringesResolved(pilot) && needsMostRays(samples, scene.cutoff, pilot.isWhole()))
    {
      ofRays = compare(samples, raysPerPixel.back());
    }
    for (Difference& one : ofRays)
    {
      one.value /= isTraced ? leastGain : 1;
    }
  }
  const auto sum = [&](double errorOfSteps, double errorOfRays)
  { return sumOf(bySteps * errorOfSteps, errorOfRays, known.voxels, known.rounding); };
  settings.accuracy.target = scene.targetError;
  settings.accuracy.reached = sum(steps.errorOf(ofSteps, settings.samples, mayExceedOfSample),
    exceededBy(mayExceedOfSample, ofRays));
  settings.accuracy.largest = sum(largestOf(ofSteps), largestOf(ofRays));
}

template <class Real>
AccurateSettings chooseFor(Pilot<Real>& pilot, const KnownErrors& ofMedium,
  const AccurateSettings* before, const Monitor& monitor)
{
  const Medium<Real>& medium = pilot.setup().medium.medium;
  const Scene& scene = pilot.scene();
  const double target = scene.targetError;
  const bool hasFilm = !needsOneRay(pilot);
  const StepRange steps = stepsFor(pilot);
  const auto isAborted = [&] { return monitor.aborted && monitor.aborted(); };
  KnownErrors known = ofMedium;
  const RecordedPlane plane = techniqueOf(scene.cutoff).plane;
  if (medium.tree && hasWalls(medium) && plane != RecordedPlane::Background)
  {
    // Of the patches that are looked at in each view, whatever is chosen.
    const Differences slopes =
      pilot.slopesAtEdges(Pilot<Real>::Patches::ToVerify, steps.with(steps.longest), monitor);
    const double invisible = plane == RecordedPlane::Screen ? invisibleShift : 0;
    known.voxels =
      sumOf(known.voxels, exceededBy(mayExceedOfSample, atMovedEdges(slopes, invisible)));
  }
  AccurateSettings settings{};
  if (before)
  {
    constexpr double wasteful = 0.2;
    settings = *before;
    settings.accuracy = {}; // of that image
    settings.step = std::min(settings.step, steps.longest);
    if (settings.samplesAtEdges > 0 && !pilot.maySplitRays())
    {
      settings.samples = std::exchange(settings.samplesAtEdges, 0);
    }
    verify(settings, pilot, steps, known, true, monitor);
    const bool isCheapest = settings.samples == raysPerPixel.front() &&
      settings.samplesAtEdges == 0 && settings.step >= steps.longest;
    if (isAborted() ||
      (settings.accuracy.isKept() && (isCheapest || settings.accuracy.reached > wasteful * target)))
    {
      return settings;
    }
  }
  const bool isResolved = areFringesResolved(pilot);
  Ladder<Real> ladder(pilot, steps, isResolved && hasFilm, monitor);
  double aim = target;
  for (int tries = 0; tries < 3 && !isAborted(); ++tries)
  {
    const AccurateSettings last = settings;
    settings = Choice<Real>(aim, target, ladder, known).cheapest();
    const bool canBeKept = settings.accuracy.reached <= target;
    const bool isSame = tries > 0 && settings.step == last.step &&
      settings.samples == last.samples && settings.samplesAtEdges == last.samplesAtEdges;
    const bool isHopeless = !canBeKept && settings.accuracy.limit == ErrorSource::Steps;
    verify(settings, pilot, steps, known, !(isHopeless && pilot.isWhole()), monitor);
    if (isSame || !canBeKept || settings.accuracy.isKept() || !isResolved)
    {
      break;
    }
    ladder.lookAtAll();
    aim *= std::clamp(0.8 * target / settings.accuracy.reached, 0.25, 0.8);
  }
  return settings;
}

template KnownErrors knownErrors(Pilot<float>&, const Monitor&);
template KnownErrors knownErrors(Pilot<double>&, const Monitor&);
template AccurateSettings chooseFor(
  Pilot<float>&, const KnownErrors&, const AccurateSettings* before, const Monitor&);
template AccurateSettings chooseFor(
  Pilot<double>&, const KnownErrors&, const AccurateSettings* before, const Monitor&);

} // namespace schlieren
