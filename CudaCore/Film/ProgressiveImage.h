// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/CentreValues.h"
#include "Film/CudaFilm.h"
#include "Film/Development.h"
#include "Film/Exposure.h"
#include "Rays/TracedPass.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace schlieren
{

/// Whether the rays of a pass stay where they are until the image is finished.
enum class Rays
{
  Stay,
  Go
};

/// An image that is summed up pass by pass, as a whole or in pieces: not a bit of it depends on where it was
/// stopped. Where `paused` of the monitor is set, passes are exposed one by one, so that there is an image
/// to show; else those that stay are exposed together, which is faster. The rays of a pass light a part of the film, see
/// sideOf(): what is shown before all passes are there has them light all of it.
class ProgressiveImage
{
public:
  explicit ProgressiveImage(const FilmSettings& settings);
  ProgressiveImage(const ProgressiveImage&) = delete;
  ProgressiveImage& operator=(const ProgressiveImage&) = delete;

  /// What the first pass has to be traced for.
  void begin(const Exposure& exposure);
  bool isBegun() const { return films_.has_value(); }
  const Cutoffs& cutoff() const { return exposure_.cutoff; } ///< once begun

  /// Passes that have been added.
  std::int64_t passes() const { return passes_; }

  /// Adds the next pass. False if aborted or paused before all of its light is on the films: the same pass is
  /// then to be added again.
  bool add(const TracedPass& traced, const Pass& pass, Rays rays, const Monitor& monitor);

  /// Makes what a camera sees without the flow have as many passes, where that is wanted. False if aborted or
  /// paused before.
  bool completeUndisturbed(const Monitor& monitor);

  /// Whether the films hold whole passes, and could be developed.
  bool isWhole() const;

  /// Writes what the passes so far make into `image`. More may follow.
  void develop(Image& image);

  Image centres()
    const; ///< what its light carries, and what of it bodies stop: of the passes so far

  /// Writes the result into `image`, with what has been left for the end, and gives all memory back. False
  /// if aborted.
  bool finish(Image& image, const Monitor& monitor);

private:
  /// What is shown until all passes are there.
  struct SoFar
  {
    void add(std::vector<TracedRays> rays, const Exposure& exposure, int threads);
    void add(const CudaPass& rays, Pass pass, const Exposure& exposure);

    Films films;
    std::unique_ptr<CudaFilm> onDevice{};
    std::int64_t passes = 0;
  };
  SoFar& filmSoFar();

  void developCounts(Image& image);
  void developCentres(Image& image) const;
  void developUndisturbed(Image& image);

  FilmSettings settings_;
  Exposure exposure_;
  std::optional<Films> films_;
  bool isOnDevice_ = false;                ///< the passes lie there
  std::unique_ptr<CudaFilm> filmOnDevice_; ///< of these
  std::optional<SoFar> soFar_;
  CentreValues centres_;
  RayCounts counts_;
  std::vector<TracedRays> waiting_; ///< not in centres_ yet
  std::int64_t passes_ = 0;
  std::int64_t nextRow_ = 0; ///< of the pass that is being added
  std::optional<UndisturbedImage> undisturbed_;
};

} // namespace schlieren
