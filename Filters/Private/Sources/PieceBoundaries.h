// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Collects the boundaries of all ranks' pieces that DataPiece::putBoundary() sends.
#pragma once

#include "Cells/CellTree.h"
#include "Input/DataParts.h"
#include "Sources/ImagePiece.h"
#include "Sources/MeshPiece.h"
#include "Walls/BoundaryFaces.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

struct BoundaryOfMeshes
{
  std::vector<CellTree::MeasuredCell> cells;
  Faces
    faces; ///< each contribution is the value that is sent with the point; `leaf`: the dataset's number on all ranks

  /// Adds the boundary of another rank.
  void add(Reader& reader);
};

struct BoundaryOfImage
{
  std::size_t parts = 0;
  Point origin{};
  std::array<double, 3> spacing{};
  std::array<double, 9> direction{};
  BoundaryFaces faces;
  std::vector<ImagePiece::OuterValue> outer;

  /// Adds the boundary of another rank. Throws std::runtime_error if its axes differ.
  void add(Reader& reader);
};

} // namespace filters
