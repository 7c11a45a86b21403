// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Gas/RefractivityModels.h"
#include "Ranks/SamplesOverRanks.h"
#include "Sources/MeshPiece.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataObject;

namespace filters
{

class MediumMaker;

/// What of a source depends on the meshes alone, and not on their values: each rank keeps it from one time step to the next.
struct KeptOverRanks
{
  std::shared_ptr<PieceMesh> piece;
  std::vector<std::uint64_t> keys; ///< of all ranks' pieces, and of bodies and Outside
  std::shared_ptr<const GasBoundary> boundary;
  std::vector<Contribution>
    contributions; ///< of all ranks' values to those at the boundary's points
  std::array<double, 3> voxelShape{};
  std::shared_ptr<LatticesOfMesh> lattices; ///< null: as yet there has been one step only
  std::int64_t builds = 0;                  ///< how often it was another mesh
};

struct MadeOverRanks
{
  std::shared_ptr<const SamplesOverRanks> source; ///< null: there is no gas
  bool hasGas = false, meetsBodies = false;
  Tally tally{};
  std::string label; ///< of the arrays; see Source::label
};

/// Makes the source of data of which each rank has some; see PartsOfRanks. All ranks call it, with the same settings
/// of `maker`, the same bodies (may be null) and the same number. Throws std::runtime_error, on all ranks.
MadeOverRanks makeOverRanks(MediumMaker& maker, const Ranks& ranks, vtkDataObject* data,
  vtkDataObject* bodies, bool hasFields, std::uint64_t number, KeptOverRanks& kept);

} // namespace filters
