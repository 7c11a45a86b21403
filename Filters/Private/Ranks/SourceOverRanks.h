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

/// The state that depends on meshes alone, kept by each rank between time steps.
struct KeptOverRanks
{
  std::shared_ptr<PieceMesh> piece;
  std::vector<std::uint64_t> keys; ///< of all ranks' pieces, bodies and Outside
  std::shared_ptr<const GasBoundary> boundary;
  std::vector<Contribution> contributions; ///< of all ranks' values to those at boundary points
  std::array<double, 3> voxelShape{};
  std::shared_ptr<LatticesOfMesh> lattices; ///< null in the first time step
  std::int64_t builds = 0;                  ///< number of different meshes
};

struct MadeOverRanks
{
  std::shared_ptr<const SamplesOverRanks> source; ///< null: no gas
  bool hasGas = false, meetsBodies = false;
  Tally tally{};
  std::string label; ///< see Source::label
};

/// Makes the source of data in pieces; see PiecesOfRanks. All ranks call it, with the same settings
/// of `maker`, bodies (may be null) and number. Throws std::runtime_error on all ranks.
MadeOverRanks makeOverRanks(MediumMaker& maker, const Ranks& ranks, vtkDataObject* data,
  vtkDataObject* bodies, bool hasFields, std::uint64_t number, KeptOverRanks& kept);

} // namespace filters
