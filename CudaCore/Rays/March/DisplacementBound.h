// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Medium.h"
#include "Rays/Light.h"
#include "Types.h"

namespace schlieren
{

/// The most that any ray is displaced sideways, the most that its slope differs on the exit plane from that of the
/// undisturbed ray, and the length of what all kicks add to its momentum; infinite where no bound is known. All follow
/// from |dq/ds| <= (1 + nu) |grad nu|.
struct DisplacementBound
{
  double displacement; ///< on the exit plane, data units
  double withinMedium; ///< up to where something bends it for the last time, data units
  double slope;
  double bend;
};

/// The most of q that light has where it enters the data.
double largestKickAtEntry(double largestNu, const Light& light);

/// Bounds a ray that meets the medium's largest gradient all along its path through the grid.
template <class Real>
DisplacementBound boundBySteepest(const Medium<Real>& medium, const Light& light);

/// Bounds the rays of a view and those around it that may be traced, by what each can meet: in columns along the
/// light, as wide as a ray in them may be displaced, of what is steepest at each depth. Rays that are not along w have
/// one column, all of the medium. `step`: in voxels; one kick is for all of a step. `atLeast`: |d nu / d index|
/// that rays may feel everywhere, because they cross cubes in which the gradient is smaller in one step.
template <class Real>
DisplacementBound boundDisplacement(const Medium<Real>& medium, const Light& light,
  const View& view, double stepVoxels, double atLeast);

} // namespace schlieren
