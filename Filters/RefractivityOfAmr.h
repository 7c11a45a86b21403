// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrLevels.h"
#include "SamplingBox.h"

#include <array>
#include <optional>
#include <string>

/// The refractivity of blocks of images whose cells hold the values, in one or more levels of refinement:
/// vtkOverlappingAMR, vtkNonOverlappingAMR, or blocks of images in any other composite.
///
/// Every level becomes one grid of cells over the whole domain: what its blocks hold; else, under finer
/// blocks, the mean of the finer cells; else the mean over the cell's place of a polynomial through the next
/// coarser level (fourth degree, one axis after the other). So a block meets its neighbours as if they were
/// one grid. Values are taken for the means over their cells, as finite volumes have them: taken for values
/// at the centres, they would differ from level to level, by 1/24 of the second derivative and of the
/// difference of the squared edges, and so print the borders of the levels into an image.
///
/// Hidden cells and NaN are solid and never interpolated from; cells under refined ones are not solid.
namespace filters
{

struct Amr
{
  std::vector<AmrLevel> levels;
  std::size_t used; // the level that becomes the grid; finer ones are averaged
  CellBox cells;    // of that level: what of it is wanted
  std::array<int, 3> dimensions;
  std::array<double, 3> origin, spacing; // of the output
  std::string note;                      // what the user should hear of the grid
};

/// Nothing where the leaves are no such blocks: with point arrays, turned, or not on one lattice.
/// `samplingDimensions`: see vtkRefractiveIndex::SetSamplingDimensions.
std::optional<Amr> planAmr(
  const Source& source, const int samplingDimensions[3], const SamplingBox& box);

/// Makes `structure` the grid of the plan.
void gridOf(const Amr& amr, vtkImageData* structure);

/// Fills `output` as planned. N is formed in the cells of the input, before anything is interpolated.
Tally convertAmr(const Amr& amr, const Source& source, Numbers numbers, vtkImageData* output);

} // namespace filters
