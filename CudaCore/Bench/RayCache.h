// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/StageSettings.h"
#include "Optics/AutomaticK.h"
#include "Optics/DeflectionHistogram.h"
#include "Optics/Tint.h"
#include "Rays/TracedPass.h"
#include "Rays/TracedRays.h"
#include "Schlieren.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

namespace schlieren
{

/// The rays of a view, pass by pass, and what has been learnt from them. They are kept until others are wanted;
/// so is a pass that has been traced in part.
class RayCache
{
public:
  /// Drops what is cached where it is not that of `key`, or has less around the image than `margin`.
  /// Returns whether it was.
  bool prepare(RaysKey key, std::int64_t margin);
  std::int64_t margin() const { return margin_; } ///< of the rays that are cached

  /// Traces a pass, or resumes it. False if aborted or paused. `isWantedOnHost`: or else where it was traced.
  using Trace = std::function<bool(TracedPass& traced, bool isWantedOnHost)>;

  /// The rays of a pass, cached or traced now; null if aborted or paused. `fields`: whose gradients they gather.
  const TracedPass* raysOf(std::int64_t number, const Pass& pass, Device device, int fields,
    std::size_t memoryBudget, const Trace& trace);
  /// Whether these rays stay where they are when the next pass is requested.
  bool holds(const TracedPass& traced) const { return &traced != &scratch_; }

  /// Learns from the rays of a pass what has not been requested of them before: how strongly they are bent, for
  /// automatic k, and where they meet the cutoff plane.
  void request(const TracedPass& traced, const TracedRays& rays, std::int64_t number,
    const Scene& scene, const DeflectionErrors& errors);
  double strongDeflection() const { return *strong_; }
  Histogram histogram() const { return histogram_->histogram(); }

  /// How fields tint the image, by the rays of its first pass.
  std::optional<Tint> tintOf(const TracedRays& rays, const Field& field, const Scene& scene);

  /// Gives back the memory that only served to make more rays.
  void finish();
  /// All of it, for rays in another medium or on another device.
  void clear();

private:
  /// Makes scratch_ the place for the rays of a pass, where it is not that already.
  void prepareScratch(std::int64_t number, const Pass& pass, Device device, int fields);

  std::optional<RaysKey> key_;
  std::int64_t margin_ = 0;
  std::deque<TracedPass> passes_;                ///< from pass 0 on
  std::deque<TracedPass> spare_;                 ///< whose memory serves again
  TracedPass scratch_;                           ///< a pass that is being traced, or is not cached
  std::int64_t inScratch_ = -1;                  ///< its number; -1: no rays are there
  bool isScratchTraced_ = false;                 ///< all of it
  std::optional<double> strong_;                 ///< deflection, once automatic k has requested it
  std::optional<DeflectionHistogram> histogram_; ///< likewise
  std::optional<double> tint_; ///< the reference of what they have gathered, likewise
};

} // namespace schlieren
