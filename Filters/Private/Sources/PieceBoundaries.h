// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The boundaries of all ranks' pieces, as DataPiece::putBoundary() sends them to all.
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

  /// Another rank's.
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

  /// Another rank's. Throws std::runtime_error where it has other axes.
  void add(Reader& reader);
};

} // namespace filters
