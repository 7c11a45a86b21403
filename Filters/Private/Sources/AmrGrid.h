// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"
#include "Input/SamplingBox.h"

#include <array>
#include <optional>
#include <string>

/// The grid that blocks of images are brought to whose cells hold the values, in one or more levels of refinement:
/// vtkOverlappingAMR, vtkNonOverlappingAMR, or blocks of images in any other composite.
namespace filters
{

struct Amr
{
  std::vector<AmrLevel> levels;
  std::size_t used; // level whose cell centres become the grid
  CellBox cells;    // cells of that level in the grid
  std::array<int, 3> dimensions;
  std::array<double, 3> origin, spacing; // of the output
  std::string note;                      // about the grid, for the user
};

/// Nothing where the leaves are no such blocks: with point arrays, turned, or not on one lattice.
/// `samplingDimensions`: see vtkRefractiveIndex::SetSamplingDimensions.
std::optional<Amr> planAmr(
  const Source& source, const int samplingDimensions[3], const SamplingBox& box);

/// Makes `structure` the grid of the plan.
void gridOf(const Amr& amr, vtkImageData* structure);

} // namespace filters
