// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"
#include "Input/SamplingBox.h"

#include <array>
#include <optional>
#include <string>

/// Chooses the grid for blocks of images with values in cells, in one or more levels:
/// vtkOverlappingAMR, vtkNonOverlappingAMR, or blocks in any other composite.
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

/// Returns nothing for other leaves: with point arrays, turned, or not on one lattice.
/// `samplingDimensions`: see vtkRefractiveIndex::SetSamplingDimensions.
std::optional<Amr> planAmr(
  const Source& source, const int samplingDimensions[3], const SamplingBox& box);

/// Makes `structure` the grid of the plan.
void gridOf(const Amr& amr, vtkImageData* structure);

} // namespace filters
