// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"
#include "Input/RefractivitySource.h"

#include <vector>

class vtkImageData;

namespace schlieren
{
class MediumSource;
} // namespace schlieren

namespace filters
{

/// Sets Refractivity and the masks of `grid`, whose axes are along those of the source, in any
/// order and direction. Layers along z of a flat source are equal. `thinSurfaces`: masks points on
/// surfaces of bodies, and within 0.87 voxels of those without inside. Uses several threads; throws
/// Stopped and std::bad_alloc.
void fillGrid(const schlieren::MediumSource& source, Numbers numbers, bool thinSurfaces,
  const WorkProgress& progress, vtkImageData* grid);

/// Samples the source's fields at the grid's points, field after field; NaN: no value.
std::vector<float> fieldsAtGrid(
  const schlieren::MediumSource& source, const WorkProgress& progress, vtkImageData* grid);

/// Masks the points of an image with arrays at which a source with the same axes has a wall.
/// Returns whether there are any.
bool maskWalls(
  const schlieren::MediumSource& source, const WorkProgress& progress, vtkImageData* image);

} // namespace filters
