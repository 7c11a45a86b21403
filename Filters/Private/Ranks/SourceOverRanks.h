// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Gas/RefractivityModels.h"
#include "Ranks/SamplesOverRanks.h"

#include <cstdint>
#include <memory>
#include <string>

class vtkDataObject;

namespace filters
{

class MediumMaker;
struct MeshCache;

struct MadeOverRanks
{
  std::shared_ptr<const SamplesOverRanks> source; ///< null: no gas
  Tally tally{};
  std::string label; ///< see Flow::label
};

/// Makes the source of data in pieces; see PiecesOfRanks. All ranks call it, with the same settings
/// of `maker`, bodies (may be null) and number. Throws std::runtime_error on all ranks.
MadeOverRanks makeOverRanks(MediumMaker& maker, const Ranks& ranks, vtkDataObject* data,
  vtkDataObject* bodies, std::uint64_t number, MeshCache& cache);

} // namespace filters
