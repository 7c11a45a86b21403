// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The cheapest settings that keep a target error, found from blocks of the image: see Scene::targetError.
//
// Errors of single settings are independent and add up in quadrature. That of a step is the difference to half of it, that
// of rays per pixel the difference to four times as many, times a factor for what these lack in their turn.
#pragma once

#include "Bench/Pilot.h"
#include "Film/Image.h"

namespace schlieren
{

/// Errors that are known without blocks, in the unit of the target.
struct KnownErrors
{
  double voxels = 0;
  double rounding = 0;
};

/// What keeps the target, or comes closest.
struct AccurateSettings
{
  double step; ///< voxels
  int samples; ///< rays per pixel
  Accuracy accuracy;
};

/// The tolerance of a source's medium for a target: no coarser than 0.01. Of an interferogram it follows from the most
/// fringes that the data can make.
double toleranceForTarget(const Field& field, const Scene& scene);

/// The errors of a medium for a view. `k`: see Scene::kScale.
template <class Real>
KnownErrors knownErrors(
  const PilotBench<Real>& bench, const PilotView& view, double deflectionError, double k);

/// Whether a medium with finer voxels or in double precision is needed: `scene` has its settings then.
bool changeMedium(const KnownErrors& known, bool isMemoryShort, Scene& scene);

/// The steps to begin with, voxels.
constexpr double longestStep = 2;

/// Chooses settings, verifies them with other pixels, and chooses finer ones, at most twice, where that shows that they do
/// not keep the target. Nothing is chosen if aborted.
template <class Real>
AccurateSettings chooseFor(double target, Pilot<Real>& pilot, const Scene& scene, bool hasWalls,
  const KnownErrors& known, const Monitor& monitor);

} // namespace schlieren
