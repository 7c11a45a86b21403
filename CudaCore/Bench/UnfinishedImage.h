// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/EdgeTiles.h"
#include "Bench/StageSettings.h"
#include "Film/Exposure.h"
#include "Film/ProgressiveImage.h"
#include "Schlieren.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace schlieren
{

/// An image that has been requested, and as much of it as there is.
struct UnfinishedImage
{
  UnfinishedImage(const Field& ofField, const Scene& ofScene)
    : field(ofField)
    , scene(ofScene)
    , image(std::in_place, filmSettingsOf(ofScene))
  {
  }

  const Field field;
  Scene scene; ///< whose automatic distance of a screen is found
  Device device = Device::Cpu;
  std::string deviceNote;
  bool keepsRays = true;                 ///< as far as the budget of memory goes
  std::optional<ProgressiveImage> image; ///< always there
  Accuracy accuracy;
  double kScale = 0;
  double momentumDrift = 0;
  double traceSeconds = 0;
  double progressOfVoxels =
    0; ///< of the image's progress, what making the medium's voxels has taken
  double progressFrom = 0, progressTo = 1; ///< of the progress that is reported, this image's
  /// Where edges of bodies are, and what those that have been traced so far are replaced by.
  struct Edges
  {
    EdgePixels pixels;
    PatchList tiles;
    std::vector<Image> images;
    RayCounts counts;
    std::size_t chunks = 0; ///< of tiles that are traced together
  };
  std::optional<Edges> edges; ///< once the image has all passes, see EdgeStage
  std::int64_t shown = 0;     ///< passes of the last image that was handed out
  bool hasBeenSilent = false; ///< the last call handed none out

  /// Returns the progress to report of a fraction of this image.
  double progressAt(double fraction) const
  {
    return progressFrom + (progressTo - progressFrom) * fraction;
  }

  /// The same of a fraction of its passes, or of the rays at edges, which follow these.
  double progressOfRays(double fraction, bool areAtEdges = false) const
  {
    constexpr double beforeEdges = 0.8;
    const double before = scene.samplesAtEdges > 0 ? beforeEdges : 1;
    const double done = areAtEdges ? before + (1 - before) * fraction : before * fraction;
    return progressAt(progressOfVoxels + (1 - progressOfVoxels) * done);
  }

  /// Discards the passes of a medium that has changed since.
  void beginAnew()
  {
    image.emplace(filmSettingsOf(scene));
    edges.reset();
    shown = 0;
  }

  /// Whether there is an image that has not been handed out.
  bool isNewImageThere() const { return image->isWhole() && image->passes() > shown; }
};

} // namespace schlieren
