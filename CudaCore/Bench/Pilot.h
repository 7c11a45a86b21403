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
  double displacement = 0;      ///< pixels on the film, at most
};

/// The longest step that is tried, voxels.
constexpr double longestStep = 2;

/// What goes with a step of Integrator::Adaptive, of third order, by the tolerance of the longest step.
inline double adaptiveToleranceFor(double step, double ofLongest)
{
  const double ratio = step / longestStep;
  return ofLongest * ratio * ratio * ratio;
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

/// Images of patches of pixels, spread evenly over where light crosses the data; closer together beside where it does not,
/// as at bodies. Rays are traced once for each setting.
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
  struct Patch
  {
    std::int64_t column, row; ///< its lower left pixel
    double weight;            ///< how often others like it are in the image
  };
  using PatchList = std::vector<Patch>;
  /// What of a patch's image is compared.
  struct Values
  {
    std::vector<float> light; ///< a value for each channel of each pixel
    std::vector<double> path; ///< metres
    std::vector<float> moved; ///< two for each pixel, data units: of the background
    std::vector<bool> hasCrossed;
  };
  using Traced = std::vector<TracedPass>; ///< of each patch
  using Exposed = std::vector<Values>;    ///< of each patch

  RayTask<Real> taskFor(double step) const;
  void scout(const DeflectionErrors& errors);
  void layOut();
  void spread(const PatchList& cells, std::size_t count);
  Pass passOf(std::int64_t number) const;
  /// The rays of all patches of a set; null if aborted.
  const Traced* trace(Patches patches, double step, int number, const Monitor& monitor);
  /// The images of all patches of a set; null if aborted.
  const Exposed* expose(Patches patches, const Settings& settings, const Monitor& monitor);
  Values expose(
    const Patch& patch, std::size_t index, const std::vector<const Traced*>& passes) const;
  void addDifferences(
    const Values& a, const Values& b, double weight, Differences& differences) const;

  PilotBench<Real> bench_;
  const Cutoffs* cutoff_ = nullptr;
  PilotView view_;
  PatchList within_, atEdges_; ///< cells of the view where light crosses the data, row by row
  std::int64_t stride_ = 1;    ///< pixels between them
  std::int64_t edge_ = 4;      ///< pixels of a patch
  std::int64_t margin_ = 2;    ///< of a patch
  PatchList patches_[2];
  std::map<std::pair<double, int>, Traced> traced_[2];   ///< by step and pass
  std::map<std::pair<double, int>, Exposed> exposed_[2]; ///< by step and rays per pixel
};

} // namespace schlieren
