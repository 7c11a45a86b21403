// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ranks/Ranks.h"
#include "Sources/DataPiece.h"
#include "Walls/GasBoundary.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkDataObject;

namespace filters
{

struct MeshCache;

/// The boundary of the gas of all ranks' pieces, and the ambient N; NaN: no boundary.
struct BoundaryOverRanks
{
  std::shared_ptr<const GasBoundary> boundary;
  double ambient;
};

/// Makes the same boundary on all ranks, of faces that it gathers from all. `keys`: of all ranks'
/// meshes. `facts`: of all data, of which it sets the voxels' shape and the direction. `cache`: of
/// meshes, from one time step to the next.
BoundaryOverRanks findBoundary(const Ranks& ranks, const DataPiece& piece, bool isImage,
  std::vector<std::uint64_t> keys, Outside outside, vtkDataObject* bodies, MeshCache& cache,
  DataPiece::Facts& facts);

} // namespace filters
