// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"
#include "Input/SamplingBox.h"

#include <array>
#include <string>

/// The grid that everything which is not one image is brought to, where a grid is wanted.
namespace filters
{

/// The grid that covers the 3-D cells (of flat data: the 2-D cells).
struct Resampling
{
  std::array<int, 3> dimensions; // 1 along the flat axis
  double bounds[6];
  int flatAxis;     // -1: none
  double depth;     // along it
  std::string note; // what the user may want to know of the grid
};

/// Most points of a grid that is chosen, not given.
constexpr double maxVoxels = 256. * 256 * 256;

/// SamplingDimensions, each 0 or at least 2. Throws where they are not.
std::array<int, 3> requireDimensions(const int samplingDimensions[3]);

/// Throws where a grid has more points than fit into memory.
void requireFits(const std::array<int, 3>& dimensions);

/// `samplingDimensions`: see vtkRefractiveIndex::SetSamplingDimensions.
Resampling planResampling(
  const Source& source, const int samplingDimensions[3], const SamplingBox& box);

/// The grid of two points along each axis.
Resampling boxOf(const Source& source);

/// Makes `structure` the grid of the plan.
void gridOf(const Resampling& plan, vtkImageData* structure);

} // namespace filters
