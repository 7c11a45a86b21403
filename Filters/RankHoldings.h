// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

class vtkDataObject;

namespace filters
{

namespace ranks
{

/// What a rank has of an input: numbers of points and cells, bounds, and a number that is the same only if the meshes are.
using Holdings = std::array<double, 9>;
Holdings holdingsOf(vtkDataObject* input); // may be null

/// What a rank has of its inputs: of the data, and of bodies.
struct InputsOfRank
{
  Holdings holdings[2] = {};
  std::int32_t pieceKinds = 0; // of the data, see pieceKindsOf()
};
InputsOfRank inputsOfRank(vtkDataObject* data, vtkDataObject* bodies);
/// What all ranks have of one input.
std::vector<Holdings> holdingsOf(std::size_t input, const std::vector<InputsOfRank>& ofRanks);

/// The ranks that have data which rank 0 and those before them have not.
std::vector<std::size_t> ranksWithMore(const std::vector<Holdings>& ofRanks);

/// Whether there are none but rank 0.
bool hasRank0All(const std::vector<Holdings>& ofRanks);

} // namespace ranks

} // namespace filters
