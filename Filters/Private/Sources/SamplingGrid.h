// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"
#include "Input/SamplingBox.h"

#include <array>
#include <string>

/// Chooses the grid for data other than one image.
namespace filters
{

/// A grid that covers the 3-D cells (of flat data: the 2-D cells).
struct Resampling
{
  std::array<int, 3> dimensions; // 1 along the flat axis
  double bounds[6];
  int flatAxis;     // -1: none
  double depth;     // along the flat axis
  std::string note; // about the grid, for the user
};

/// Maximum number of points of a grid that is chosen, not given.
constexpr double maxVoxels = 256. * 256 * 256;

/// Returns SamplingDimensions. Throws unless each is 0 or at least 2.
std::array<int, 3> requireDimensions(const int samplingDimensions[3]);

/// Throws if a grid has more points than fit into memory.
void requireFits(const std::array<int, 3>& dimensions);

/// Chooses a grid. `samplingDimensions`: see vtkRefractiveIndex::SetSamplingDimensions.
Resampling planResampling(
  const Source& source, const int samplingDimensions[3], const SamplingBox& box);

/// Returns the grid of two points along each axis.
Resampling boxOf(const Source& source);

/// Makes `structure` the grid of the plan.
void gridOf(const Resampling& plan, vtkImageData* structure);

} // namespace filters
