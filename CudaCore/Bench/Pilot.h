// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small patches of an image, made with other settings than the image, to find out how much these change it.
#pragma once

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

/// What a few rays all over the image have met.
struct PilotView
{
  std::int64_t crossed = 0;     ///< rays that have crossed the data and reach the film
  double strongDeflection = 0;  ///< see strongDeflection(), for automatic k
  double largestDeflection = 0; ///< |eps|
  double path = 0;              ///< metres: range of the optical path difference
  double steepestPath =
    0; ///< metres: its change over a pixel, which 99 % of the rays do not exceed
};

/// The longest step that is tried, voxels.
constexpr double longestStep = 2;

/// What goes with a step of Integrator::Adaptive, of third order. `tolerance`: that of steps of half a voxel.
inline double adaptiveToleranceFor(double step, double tolerance)
{
  return tolerance * (2 * step) * (2 * step) * (2 * step);
}

/// A difference between two images at a pixel whose light has crossed the data, in the unit of Scene::targetError.
struct Difference
{
  double value;
  double pixels; ///< of the whole image that it stands for
};
using Differences = std::vector<Difference>;

/// The value that 99 % of the pixels do not exceed; 0 if there are none.
double percentile99(Differences differences);
double largestOf(const Differences& differences);

/// Images of patches of pixels. They are closer together where the few pixels are that have the largest errors: beside
/// bodies, and where rays differ most from their neighbours. Where light is displaced all over the image there is one patch,
/// the image. Rays are traced once for each setting.
template <class Real>
class Pilot
{
public:
  /// What a patch is made with.
  struct Settings
  {
    double step; ///< voxels
    int samples; ///< rays per pixel
  };

  /// Looks at the view. `errors`: see strongDeflection().
  Pilot(PilotBench<Real> bench, const DeflectionErrors& errors);

  const PilotBench<Real>& bench() const { return bench_; }
  const PilotView& view() const { return view_; }

  /// Exposes patches by another cutoff of a scene with the same rays from now on. The cutoff's table stays with its owner.
  void setCutoff(const Scene& scene, const Cutoffs& cutoff)
  {
    bench_.scene = scene;
    cutoff_ = &cutoff;
    for (auto& exposed : exposed_)
    {
      exposed.clear();
    }
  }

  /// Two sets of patches that have no pixel in common: one to choose by, one to verify the choice with.
  enum class Patches
  {
    ToChoose,
    ToVerify
  };

  /// Compares the images of two settings. Aborted: empty.
  Differences compare(
    Patches patches, const Settings& a, const Settings& b, const Monitor& monitor);

private:
  /// A rectangle of pixels on the film, and the one around which the rays start that land there.
  struct Patch
  {
    std::int64_t column, row; ///< its lower left pixel
    double weight;            ///< how many pixels of the image each of its own stands for
    std::int64_t fromColumn, fromRow;
    std::int64_t margin = 0; ///< pixels around that
    std::int64_t columns = edge, rows = edge;

    static constexpr std::int64_t edge = 4; ///< pixels, but for a patch that is the whole image
  };
  using PatchList = std::vector<Patch>;
  /// What of a patch's image is compared.
  struct Values
  {
    std::vector<float> light; ///< a value for each channel of each pixel
    std::vector<double> path; ///< metres
    std::vector<float> moved; ///< two for each pixel, data units: of the background
    std::vector<bool> hasCrossed;
    std::vector<bool> isClear; ///< at the pixel's centre, whose path it has
  };
  using Traced = std::vector<TracedPass>; ///< of each patch
  using Exposed = std::vector<Values>;    ///< of each patch

  /// A ray that has looked at the view, and how far it is moved on the film, pixels.
  struct Scout
  {
    RayFate fate;
    double deflection[2], moved[2];
  };
  /// A square of pixels that may be a patch.
  struct Cell
  {
    std::int64_t column, row;
    double variation; ///< how much the rays there differ from their neighbours
  };
  using Cells = std::vector<Cell>;

  RayTask<Real> taskFor(double step) const;
  void scout(const DeflectionErrors& errors);
  /// Null outside of the view.
  const Scout* scoutAt(std::int64_t column, std::int64_t row) const;
  double variationAt(std::int64_t column, std::int64_t row) const;
  std::vector<double> variationsOnFilm() const;
  void layOut();
  void takeWholeIfCheaper();
  void spread(const Cells& cells, double pixels);
  /// Aims a patch at where the light comes from that lands on it. False if that is from all over the image.
  bool findOrigin(Patch& patch) const;
  /// A set of patches.
  std::size_t indexOf(Patches patches) const
  {
    return isWhole_ ? 0 : static_cast<std::size_t>(patches);
  }
  bool isShifted() const;
  Pass passOf(const Patch& patch, std::int64_t number) const;
  /// The rays of all patches of a set; null if aborted.
  const Traced* trace(Patches patches, double step, int number, const Monitor& monitor);
  /// The images of all patches of a set; null if aborted.
  const Exposed* expose(Patches patches, const Settings& settings, const Monitor& monitor);
  Values expose(
    const Patch& patch, std::size_t index, const std::vector<const Traced*>& passes) const;
  void addDifferences(
    const Values& a, const Values& b, const Patch& patch, Differences& differences) const;

  PilotBench<Real> bench_;
  const Cutoffs* cutoff_ = nullptr;
  PilotView view_;
  std::vector<Scout> scouts_; ///< row by row
  std::int64_t scoutColumns_ = 0, scoutRows_ = 0;
  std::int64_t stride_ = 1; ///< pixels between them
  std::int64_t lost_ = 0;   ///< patches whose light comes from all over the image
  bool isWhole_ = false;    ///< both sets are one patch, the image
  PatchList patches_[2];
  std::map<std::pair<double, int>, Traced> traced_[2];   ///< by step and pass
  std::map<std::pair<double, int>, Exposed> exposed_[2]; ///< by step and rays per pixel
};

} // namespace schlieren
