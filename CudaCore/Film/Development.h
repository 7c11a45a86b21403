// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/CudaFilm.h"
#include "Film/Exposure.h"
#include "Film/Image.h"
#include "Optics/Cutoffs.h"
#include "Rays/CudaPass.h"
#include "Rays/RayExit.h"
#include "Types.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace schlieren
{

/// What of a scene matters to its films.
struct FilmSettings
{
  int width, height; ///< pixels
  int samplesPerPixel;
  std::uint32_t seed;
  double smoothingRadius; ///< pixels
  bool isOfCamera;        ///< there is an image without the flow, too
  int threads;
};

/// The films that an image needs.
Films filmsOf(const FilmSettings& settings, const Cutoffs& cutoff, std::int64_t maxRays);

/// Makes of the films of some passes the image: its light, intensity and colour.
void develop(const Films& films, std::int64_t passes, int threads, Image& image);

/// Smooths intensity and colour.
void smooth(const FilmSettings& settings, Image& image);

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
  /// Both stay with their owner.
  UndisturbedImage(const FilmSettings& settings, const Exposure& exposure)
    : settings_(settings)
    , exposure_(exposure)
  {
  }

  std::int64_t passes() const { return passes_; }

  /// False if aborted or paused before all of the pass is on the films: the next call resumes it. `device`: the same for
  /// all passes of an image. Throws DeviceError.
  bool addPass(Device device, const Monitor& monitor);

  PixelArray<float> develop();

private:
  const FilmSettings& settings_;
  const Exposure& exposure_;
  RayExits
    exits_; ///< empty until the first pass, as the next three, or where the others are in use
  std::unique_ptr<CudaPass> exitsOnDevice_;
  std::unique_ptr<CudaFilm> filmOnDevice_;
  std::optional<Films> films_;
  std::int64_t passes_ = 0;
  std::int64_t nextRow_ = 0; ///< of the pass that is being added
};

/// How far from where they start the mean rays of pixels meet the background: 2 per pixel, data units.
PixelArray<float> backgroundDisplacement(const Image& image, const Projection& projection);

} // namespace schlieren
