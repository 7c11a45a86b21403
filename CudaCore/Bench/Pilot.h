// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small patches of an image, made with other settings than the image, to find out how much these change it.
#pragma once

#include "Bench/Differences.h"
#include "Bench/Patches.h"
#include "Bench/Scouts.h"
#include "Film/Shading.h"
#include "Medium/Medium.h"
#include "Optics/AutomaticK.h"
#include "Optics/Cutoffs.h"
#include "Rays/March/MakeTask.h"
#include "Rays/TracedPass.h"
#include "Schlieren.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace schlieren
{

/// What the patches of an image are made with, apart from the settings that are tried.
template <class Real>
struct PilotBench
{
  const Medium<Real>* medium; ///< stays with its owner
  Light light;
  Scene scene;
  Projection projection;
  RaySettings settings;
  std::int64_t margin; ///< pixels around the image from which light may be bent into it
};

/// The longest step that is tried, voxels.
constexpr double longestStep = 2;

/// What goes with a step of Integrator::Adaptive, of third order. `tolerance`: that of steps of half a voxel.
inline double adaptiveToleranceFor(double step, double tolerance)
{
  return tolerance * (2 * step) * (2 * step) * (2 * step);
}

/// What patches are made with.
struct PatchSettings
{
  double step;         ///< voxels
  int samples;         ///< rays per pixel
  int samplesAtBodies; ///< likewise, of patches there
};

/// Images of patches of pixels, see PatchLayout. Rays are traced once for each setting.
template <class Real>
class Pilot
{
public:
  /// Looks at the view. `errors`: see strongDeflection().
  Pilot(PilotBench<Real> bench, const DeflectionErrors& errors);
  Pilot(const Pilot&) = delete; // groups know where the patches are
  Pilot& operator=(const Pilot&) = delete;

  const PilotBench<Real>& bench() const { return bench_; }
  const PilotView& view() const { return scouts_.view(); }

  /// Exposes patches by another cutoff of a scene with the same rays from now on.
  void begin(const Scene& scene, const Cutoffs& cutoff)
  {
    resume(cutoff);
    bench_.scene = scene;
    for (auto& set : groups_)
    {
      for (Group& group : set)
      {
        group.exposed.clear();
      }
    }
  }
  /// Continues after a pause, with the same cutoff, whose table stays with its owner.
  void resume(const Cutoffs& cutoff)
  {
    cutoff_ = &cutoff;
    isPaused_ = false;
  }

  /// Two sets of patches that have no pixel in common: one to choose by, one to verify the choice with.
  enum class Patches
  {
    ToChoose,
    ToVerify
  };

  /// Compares the images of two settings. Aborted or paused: empty.
  Differences compare(
    Patches patches, const PatchSettings& a, const PatchSettings& b, const Monitor& monitor);

  /// Whether the monitor has paused it since then. What it has done is kept.
  bool isPaused() const { return isPaused_; }

private:
  /// What of a patch's image is compared.
  struct Values
  {
    std::vector<float> light; ///< a value for each channel of each pixel
    std::vector<double> path; ///< metres
    std::vector<float> moved; ///< two for each pixel, data units: of the background
    std::vector<bool> hasCrossed;
    std::vector<bool> isClear; ///< at the pixel's centre, whose path it has
  };
  struct Traced
  {
    std::vector<TracedPass> rays; ///< of each patch
    std::int64_t done = 0;        ///< patches
  };
  using Exposed = std::vector<Values>; ///< of each patch

  /// Patches that are made in one way, and what has been made of them.
  struct Group
  {
    const PatchList* patches;
    std::map<std::pair<double, int>, Traced> traced;   ///< by step and pass
    std::map<std::pair<double, int>, Exposed> exposed; ///< by step and rays per pixel
  };

  RayTask<Real> taskFor(double step) const;
  Pass passOf(const Patch& patch, std::int64_t number) const;
  /// The rays of all patches of a group; null if aborted or paused.
  const Traced* trace(Group& group, double step, int number, const Monitor& monitor);
  /// The images of all patches of a group; null if aborted or paused.
  const Exposed* expose(Group& group, double step, int samples, const Monitor& monitor);
  Values expose(
    const Patch& patch, std::size_t index, const std::vector<const Traced*>& passes) const;
  void addDifferences(
    const Values& a, const Values& b, const Patch& patch, Differences& differences) const;

  PilotBench<Real> bench_;
  const Cutoffs* cutoff_ = nullptr;
  Scouts scouts_;
  PatchLayout layout_;
  Group groups_[2][2]; ///< of each set: at bodies, and elsewhere
  bool isPaused_ = false;
};

} // namespace schlieren
