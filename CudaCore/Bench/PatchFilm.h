// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/Differences.h"
#include "Bench/EdgeTiles.h"
#include "Bench/Patches.h"
#include "Film/ProgressiveImage.h"
#include "Schlieren.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// Caustics: light on a screen that is displaced by no more than this is where it should be, pixels.
constexpr double invisibleShift = 0.05;

/// What of a patch's image is compared.
struct PatchPixels
{
  std::vector<float> light; ///< a value for each channel of each pixel
  std::vector<double> path; ///< metres
  std::vector<float> moved; ///< two for each pixel, data units: of the background
  ///@{
  /// Whether any of its rays has met the data, or a body in it; whether any gives light; whether a body stops any.
  std::vector<bool> hasMet, isLit, isStopped;
  ///@}
  std::vector<bool> isClear;   ///< at the pixel's centre, whose path it has
  std::vector<bool> areAtEdge; ///< see EdgePixels::isLit()
  std::int64_t withRays = 0;   ///< how many have rays then
};

/// Exposes a patch.
class PatchFilm
{
public:
  /// Of so many rays per pixel. `projection`: of the image; `cutoff`: its table stays with its owner.
  PatchFilm(const Patch& patch, const Scene& scene, const Cutoffs& cutoff,
    const Projection& projection, int samples, int threads);

  void add(const TracedPass& traced, const Pass& pass);
  int passes() const { return static_cast<int>(film_.passes()); }
  PatchPixels develop();
  Image image(); ///< of the patch

private:
  Patch patch_;
  Projection projection_;
  FilmSettings settings_;
  ProgressiveImage film_;
  PatchPixels pixels_;            ///< what of them the passes have shown
  std::vector<RaysOfPixel> rays_; ///< so far, of the patch and its margin; how many are blocked
};

/// Pixels in which a body stops some rays.
enum class Edges
{
  Count,
  DoNotCount
};

/// Adds the differences of pixels, times a factor, as the technique's reader sees them: see Scene::targetError. `areCounted`: which;
/// null: all.
void addDifferences(const PatchPixels& a, const PatchPixels& b, const Patch& patch, double factor,
  const Scene& scene, const Projection& projection, Differences& differences, Edges edges,
  const std::vector<bool>* areCounted = nullptr);

/// Adds what a shift of the light by a pixel would change where edges of bodies are, and nothing elsewhere.
void addSlopesAtEdges(
  const PatchPixels& pixels, const Patch& patch, const Scene& scene, Differences& differences);

} // namespace schlieren
