// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"
#include "Sources/MediumMaker.h"

class vtkImageData;

namespace schlieren
{
class MediumSource;
} // namespace schlieren

namespace filters
{

/// Samples the body of revolution of `choice` on a grid of cubes, which are as large as the cells of the plane, with 128
/// to 256 points along the longest side: Refractivity, vtkValidPointMask and TransparentPointMask. `source`: made of
/// the same choice.
void sampleRevolved(const schlieren::MediumSource& source, const Choice& choice,
  const WorkProgress& progress, vtkImageData* image);

} // namespace filters
