// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The errors of steps and of rays per pixel, as a pilot's patches show them.
#pragma once

#include "Bench/Pilot.h"
#include "Bench/TargetError.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace schlieren
{

constexpr double longestStepAtWalls = 1, shortestStep = 0.25; // voxels

/// The error of a step by its difference to half of it: 4/3 of it for an order of 2. Beside walls the order is below 1.
constexpr double errorByHalving = 1.5;
/// By how much it falls from n to 4 n, at least.
constexpr double leastGain = 3.5;
/// Of the pixels that are looked at fewer exceed an error than may: these are a sample, and of edges of bodies in small images it can
/// have too few.
constexpr double mayExceedOfSample = 0.8 * mayExceed;

/// How steps are compared.
struct StepRange
{
  double longest;   ///< voxels
  int raysAtBodies; ///< per pixel; elsewhere one

  /// How patches are made to compare a step with others.
  PatchSettings with(double step) const { return { step, 1, raysAtBodies }; }
  /// The error of steps in pixels with so many rays, from such patches. Few rays that go astray, as in glass, are in
  /// many of these pixels.
  double errorOf(const Differences& differences, int samples, double part) const
  {
    const int more = std::max(1, samples / raysAtBodies);
    const double astray = exceededBy(part / more, differences) / more;
    return std::max(exceededBy(part, differences), astray);
  }
};

/// Steps move the edges of bodies by fractions of a pixel, which single rays do not see in nearly all pixels. Those that are
/// longer than the data are one step as half of them is, which would not show their error.
template <class Real>
StepRange stepsFor(const Medium<Real>& medium, bool hasWalls, bool hasFilm)
{
  constexpr int raysAtWalls = 16;
  StepRange steps = hasWalls ? StepRange{ longestStepAtWalls, hasFilm ? raysAtWalls : 1 }
                             : StepRange{ longestStep, 1 };
  if (!medium.tree)
  {
    const std::array<std::int64_t, 3>& points = medium.volume.dimensions;
    const std::int64_t fewest = *std::min_element(points.begin(), points.end());
    steps.longest = std::min(steps.longest, static_cast<double>(fewest - 1));
  }
  return steps;
}

/// So many rays per pixel that the error of fewer is seen beside theirs. Where squares show each of 4 rays lights all of a pixel,
/// as one does: see sideOnFilm().
inline int manyMoreThan(int samples, Cutoff cutoff)
{
  constexpr int fewest = 16;
  return std::max(4 * samples, techniqueOf(cutoff).showsSquares() ? fewest : 1);
}

/// Rays per pixel whose error is not seen beside twice as many.
constexpr int fewRays = 4;

/// Whether the error of so few rays, which light all of a pixel, may be seen beside the most rays only: squares of fewer have
/// more noise than these, with fringes or on a screen.
inline bool needsMostRays(int samples, Cutoff cutoff, bool isOfWholeImage)
{
  return samples <= fewRays && techniqueOf(cutoff).showsSquares() && !isOfWholeImage;
}

/// Finds errors of steps and rays per pixel when they are requested.
template <class Real>
class Ladder
{
public:
  using Patches = typename Pilot<Real>::Patches;

  Ladder(Pilot<Real>& pilot, const StepRange& steps, bool hasFilm, const Monitor& monitor)
    : pilot_(pilot)
    , steps_(steps)
    , hasFilm_(hasFilm)
    , monitor_(monitor)
  {
  }

  double longest() const { return steps_.longest; }
  bool isOfWholeImage() const { return pilot_.isWhole(); }

  /// Looks at all patches from now on.
  void lookAtAll() { looksAtAll_ = true; }

  /// In pixels with so many rays.
  double ofStep(double step, int samples)
  {
    // Not traced any finer. Where light goes astray, shorter steps gain little.
    if (step <= shortestStep)
    {
      const double before = ofStep(2 * step, samples), twoBefore = ofStep(4 * step, samples);
      const double gained = twoBefore > 0 ? before / twoBefore : 0;
      return std::clamp(gained, 0.5, 1.) * before;
    }
    const auto errorIn = [&](const Differences& differences)
    { return steps_.errorOf(differences, samples, mayExceedOfSample); };
    return errorByHalving * differenceOf(steps_.with(step), steps_.with(0.5 * step), errorIn);
  }

  /// `allowed`: where the error of 16 rays is less than that by what 4 gain, it is not measured.
  double ofRays(int samples, double allowed)
  {
    constexpr int cheap = 4;
    constexpr double trust = 0.7, most = 16;
    if (!hasFilm_)
    {
      return 0;
    }
    if (samples > mostCompared)
    {
      return ofRays(mostCompared, 0) / gainFrom(mostCompared, samples);
    }
    if (samples > cheap)
    {
      const double before = ofRays(cheap, allowed);
      const double gain =
        before > 0 ? std::clamp(trust * ofRays(1, allowed) / before, leastGain, most) : leastGain;
      if (before / gain <= allowed)
      {
        return before / gain;
      }
    }
    const auto errorIn = [&](const Differences& differences)
    { return exceededBy(mayExceedOfSample, differences); };
    const auto differenceTo = [&](int more) {
      return differenceOf({ longest(), samples, samples }, { longest(), more, more }, errorIn);
    };
    const Cutoff cutoff = pilot_.scene().cutoff;
    const double difference = differenceTo(manyMoreThan(samples, cutoff));
    return difference > allowed && needsMostRays(samples, cutoff, pilot_.isWhole())
      ? differenceTo(raysPerPixel.back())
      : difference;
  }

  /// With more where edges of bodies are.
  double ofRaysBesideEdges(int samples, int atEdges)
  {
    const auto errorIn = [&](const Differences& differences)
    { return exceededBy(mayExceedOfSample, differences); };
    const int measured = std::min(atEdges, mostCompared);
    const Cutoff cutoff = pilot_.scene().cutoff;
    const int more = manyMoreThan(samples, cutoff), moreAtEdges = manyMoreThan(measured, cutoff);
    return differenceOf({ longest(), samples, measured, true },
      { longest(), more, moreAtEdges, true }, errorIn, 1 / gainFrom(measured, atEdges));
  }

  /// See Pilot::partOfEdges(); 1 where that is unknown.
  double partOfEdges(int samples)
  {
    return pilot_.partOfEdges(longest(), samples, monitor_).value_or(1);
  }

private:
  static constexpr int mostCompared = 16; ///< rays per pixel, with four times as many
  static double gainFrom(int samples, int more)
  {
    return std::pow(leastGain, std::log2(static_cast<double>(more) / samples) / 2);
  }

  template <class ErrorIn>
  double differenceOf(const PatchSettings& a, const PatchSettings& b, const ErrorIn& errorIn,
    double factorAtEdges = 1)
  {
    const auto differenceIn = [&](Patches patches)
    { return errorIn(pilot_.compare(patches, a, b, monitor_, factorAtEdges)); };
    const double difference = differenceIn(Patches::ToChoose);
    return looksAtAll_ ? std::max(difference, differenceIn(Patches::ToVerify)) : difference;
  }

  Pilot<Real>& pilot_;
  bool looksAtAll_ = false;
  StepRange steps_;
  bool hasFilm_;
  const Monitor& monitor_;
};

} // namespace schlieren
