// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small patches of an image, made with other settings than the image, to find out how much these change it.
#pragma once

#include "Bench/CutoffMaker.h"
#include "Bench/Differences.h"
#include "Bench/PatchFilm.h"
#include "Bench/Patches.h"
#include "Bench/Scouts.h"
#include "Bench/StageSettings.h"
#include "Bench/ViewSetup.h"
#include "Optics/Cutoffs.h"
#include "Rays/TracedPass.h"
#include "Schlieren.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace schlieren
{

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
  bool areAtEdges =
    false; ///< the latter are of pixels that edges light there, and others have `samples`
};

/// Images of patches of pixels, see PatchLayout. Rays are traced once for each setting.
template <class Real>
class Pilot
{
public:
  /// Looks at the view. Where the scene wants errors of all pixels the image is the only patch.
  Pilot(const ViewSetup<Real>& setup, const Scene& scene);
  Pilot(const Pilot&) = delete; // groups know where the patches are
  Pilot& operator=(const Pilot&) = delete;

  const ViewSetup<Real>& setup() const { return setup_; }
  const Scene& scene() const { return scene_; }
  const PilotView& view() const { return scouts_.view(); }
  bool isWhole() const { return layout_.isWhole; } ///< the image is the only patch

  /// Exposes patches by another cutoff of a scene with the same rays from now on. `k`: see Scene::kScale.
  void begin(const Tracer<Real>& tracer, const Scene& scene, double k)
  {
    cutoff_ = cutoffs_.cutoffOf(scene, k, setup_.pixels);
    resume(tracer);
    scene_ = scene;
    for (auto* sets : { &groups_, &withVoxels_, &someWithVoxels_ })
    {
      for (auto& set : *sets)
      {
        for (Group& group : set)
        {
          group.exposed.clear();
        }
      }
    }
  }
  /// Continues after a pause.
  void resume(const Tracer<Real>& tracer)
  {
    setup_.tracer = tracer;
    isPaused_ = false;
  }

  /// Two sets of patches that have no pixel in common: one to choose by, one to verify the choice with.
  enum class Patches
  {
    ToChoose,
    ToVerify
  };

  /// Compares the images of two settings. Aborted or paused: empty. Where `b` has more rays than `a`, the error of these
  /// follows from the differences. Those of `b` at borders are others: a border along rows or columns of pixels can lie so
  /// that no ray of either would be behind it. At bodies there are more of them.
  /// `factorAtEdges`: of the differences there, where rays beside edges are others.
  Differences compare(Patches patches, const PatchSettings& a, const PatchSettings& b,
    const Monitor& monitor, double factorAtEdges = 1);

  /// Whether pixels where edges of bodies are may have other rays than the rest; see EdgeStage.
  bool maySplitRays() const;

  /// About how many rays a pass of the pixels where edges of bodies are has, by one of all pixels; see EdgeStage. Unknown
  /// where edges may not have rays of their own, aborted, or paused.
  std::optional<double> partOfEdges(double step, int samples, const Monitor& monitor);

  /// What a shift of the light by a pixel would change at edges of bodies. Aborted or paused: empty.
  Differences slopesAtEdges(Patches patches, const PatchSettings& settings, const Monitor& monitor);

  /// What a medium within a lower tolerance would change: see MediumTree::refineFurther(). Edges of bodies do not count, of
  /// which it moves rays by whole pixels at the most. Aborted or paused: empty. `part`: of the patches for it.
  enum class Part
  {
    Some,
    All
  };
  Differences ofVoxels(
    const PatchSettings& settings, double tolerance, Part part, const Monitor& monitor);
  /// Frees the medium within a lower tolerance. Its rays stay.
  void dropFiner() { finer_.reset(); }

  /// Whether the monitor has paused it since then. What it has done is kept.
  bool isPaused() const { return isPaused_; }

private:
  struct Exposed
  {
    std::deque<PatchFilm> films; ///< of each patch, until they have all rays
    std::vector<PatchPixels> pixels;
  };

  /// Rays through a patch's pixels.
  struct RaySet
  {
    double step; ///< voxels
    int samples; ///< per pixel
    bool areOthers =
      false; ///< those of the image, or through other points of the pixels in each patch

    bool operator<(const RaySet& other) const
    {
      return std::tie(step, samples, areOthers) <
        std::tie(other.step, other.samples, other.areOthers);
    }
  };
  /// The pass of a patch that has this number in a set of rays.
  struct PassNumber
  {
    const RaySet* set;
    int number;
    std::int64_t in(std::size_t patch) const
    {
      return set->areOthers && number > 0
        ? set->samples * (static_cast<std::int64_t>(patch) + 1) + number
        : number;
    }
  };

  using PassKey = std::tuple<double, int, int, bool>; ///< step, pass; of how many rays, others
  PassKey keyOf(const PassNumber& pass) const
  {
    const RaySet& set = *pass.set;
    const bool areOthers = set.areOthers && pass.number > 0;
    const bool areAlone =
      pass.number > 0 && (areOthers || pointsOfPixel(set.samples, scene_, setup_.light) > 1);
    return { set.step, pass.number, areAlone ? set.samples : 0, areOthers };
  }

  /// Patches of a place, and what has been made of them.
  struct Group
  {
    const PatchList* patches;
    std::optional<Part> ofFiner;                       ///< voxels
    std::map<PassKey, std::vector<TracedPass>> traced; ///< of each patch
    TracedPass underWay;                               ///< some that a pause has interrupted
    std::vector<PassKey> keysUnderWay;
    std::map<RaySet, Exposed> exposed;
  };

  RayTask<Real> taskFor(double step, const Medium<Real>& medium) const;
  /// Makes finer voxels where some patches' light is. False if aborted.
  bool makeFiner(Part part, const Monitor& monitor);
  Pass passOf(const Patch& patch, std::int64_t number, int samples) const;
  /// Traces a pass of all patches of a group where that has not been done, and some of those that come next. False if aborted
  /// or paused.
  bool trace(Group& group, const PassNumber& first, const Monitor& monitor);
  /// The images of all patches of a group; null if aborted or paused.
  const std::vector<PatchPixels>* expose(Group& group, const RaySet& rays, const Monitor& monitor);

  struct Exposure
  {
    Group& group;
    RaySet rays;
  };
  /// Of a group's pixels those that edges of bodies light, or the others, by what these rays show.
  struct Choice
  {
    RaySet by;
    bool areAtEdge;
  };
  /// Adds the differences of a group's patches, or of those of two groups with the same patches. False if aborted or paused.
  bool compare(const Exposure& a, const Exposure& b, double factor, Edges edges,
    const Monitor& monitor, Differences& differences, const std::optional<Choice>& choice = {});

  ViewSetup<Real> setup_;
  Scene scene_;
  CutoffMaker cutoffs_;
  Cutoffs cutoff_{};
  Scouts scouts_;
  PatchLayout layout_;
  Group groups_[2][patchPlaces];     ///< of each set
  Group withVoxels_[2][patchPlaces]; ///< of the image, and finer ones
  Group someWithVoxels_[2][patchPlaces];
  std::unique_ptr<MediumOnDevices<Real>> finer_;
  Part finerPart_ = Part::Some;
  double further_ = 0; ///< its tolerance
  bool isPaused_ = false;
};

} // namespace schlieren
