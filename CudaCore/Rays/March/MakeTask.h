// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Medium.h"
#include "Rays/March/RayTask.h"

#include <cstdint>

namespace schlieren
{

/// A ray that has taken this many times the steps of a straight one is trapped.
constexpr int trappedFactor = 8;

/// An adaptive ray may take this many times more with the usual tolerance: where the gradient has
/// kinks its steps are short.
constexpr int adaptiveFactor = 64;
constexpr double usualTolerance = 1e-5;

/// Where steps are shorter than voxels because rays bend within one, as in voxels that are much longer than wide, a ray takes
/// this many more at the most, of those for a StepSize of 1. Where nu'' is what steps are chosen for, that is a hundred swings
/// of light that is guided from one end to the other, and steps are wrong by up to a tenth of a swing after them.
constexpr double mostStepsOfBends = 8192;

/// What of a scene matters to rays.
struct RaySettings
{
  KernelChoice kernel{ PathModel::Refracted, Integrator::Leapfrog, Interpolation::Quadratic };
  double stepVoxels = 1;
  double adaptiveTolerance = usualTolerance;
  double lengthScale = 1; ///< metres per data unit
};

/// The medium stays the caller's.
template <class Real>
RayTask<Real> makeTask(const Medium<Real>& medium, const Light& light, const RaySettings& settings);

} // namespace schlieren
