// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/CutoffMaker.h"
#include "Bench/RayCache.h"
#include "Bench/UnfinishedImage.h"
#include "Bench/ViewSetup.h"
#include "Bench/Watch.h"
#include "Schlieren.h"

#include <cstdint>

namespace schlieren
{

/// Traces and exposes the passes of an image until all are on the film or the monitor stops it.
template <class Real>
class PassLoop
{
public:
  /// All stay with their owner.
  PassLoop(const ViewSetup<Real>& view, UnfinishedImage& request, const Watch& watch,
    RayCache& rays, CutoffMaker& cutoffs, Work& work);

  /// False if aborted or paused before all of a pass was on the film.
  bool run();

private:
  /// Adds the next pass. False if aborted or paused before all of it is on the film.
  bool addPass();
  Monitor monitorOfPass(std::int64_t number) const;
  /// Makes what a camera sees without the flow have as many passes, where it may be shown before the end.
  bool completeUndisturbed(const Monitor& monitor);
  /// Makes the cutoff, by what the rays of the first pass have shown.
  void begin();

  /// Traces a pass, or resumes it. False if aborted or paused.
  bool trace(TracedPass& traced, bool isWantedOnHost, const Monitor& monitor);

  const ViewSetup<Real>& view_;
  UnfinishedImage& request_;
  const Watch& watch_;
  RayCache& rays_;
  CutoffMaker& cutoffs_;
  Work& work_;
  Pass pass_; ///< the next one
};

} // namespace schlieren
