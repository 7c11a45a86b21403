// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Exposure.h"
#include "Film/PixelArray.h"
#include "Optics/Cutoffs.h"
#include "Optics/Tint.h"
#include "Rays/RayExit.h"
#include "Schlieren.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace schlieren
{

/// The films that a scene needs, one of samples among them where its noise filter counts these.
Films filmsOf(
  const Scene& scene, const Cutoffs& cutoff, std::optional<Tint> tint, std::int64_t maxRays);

/// Makes of the films of some passes the image: its light, intensity and colour. Returns what filterNoise wants
/// to know: the samples of each pixel, where they are counted.
PixelArray<float> develop(const Films& films, std::int64_t passes, int threads, Image& image);

/// Takes the noise out of intensity and colour.
void filterNoise(const PixelArray<float>& samples, const Scene& scene, Image& image);

/// How rays come onto films; the same for all passes of an image.
struct Exposure
{
  Cutoffs cutoff;
  Projection projection{};
  std::int64_t margin = 0;
  std::int64_t maxRays = 0; ///< see Film
};

/// What a camera sees without the flow: passes of rays that nothing bends, on films like those of the
/// image, so that where the flow bends nothing either no bit differs.
class UndisturbedImage
{
public:
  /// The scene's stay with their owner.
  UndisturbedImage(const Scene& scene, const Exposure& exposure)
    : scene_(scene)
    , exposure_(exposure)
  {
  }

  std::int64_t passes() const { return passes_; }

  /// False if aborted or paused before all of the pass is on the films: the next call resumes it.
  bool addPass(const Monitor& monitor);

  PixelArray<float> develop() const;

private:
  const Scene& scene_;
  const Exposure& exposure_;
  std::vector<RayExit> exits_; ///< empty until the first pass, as the next
  std::optional<Films> films_;
  std::int64_t passes_ = 0;
  std::int64_t nextRow_ = 0; ///< of the pass that is being added
};

/// How far from where they start the mean rays of pixels meet the background: 2 per pixel, data units.
PixelArray<float> backgroundDisplacement(const Image& image, const Projection& projection);

} // namespace schlieren
