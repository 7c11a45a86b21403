// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The boundaries of all ranks' pieces, as DataPiece::putBoundary() sends them to rank 0.
#pragma once

#include "BoundaryFaces.h"
#include "CellTree.h"
#include "DataParts.h"
#include "ImagePiece.h"
#include "MeshFaces.h"
#include "WeightedMedian.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

struct BoundaryOfMeshes
{
  std::vector<CellTree::Sizes> sizes; // of some cells of each rank
  std::vector<double> cells;          // of each rank
  Faces faces;

  /// Another rank's, which has so many cells.
  void add(Reader& reader, std::int64_t ofRank);
  /// Of cells of all ranks the same part.
  CellTree::Sizes joinedSizes() const;
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

struct BoundaryOfAmr
{
  std::size_t parts = 0;
  BoundaryFaces faces;
  std::vector<WeightedValue> outer;

  /// Another rank's.
  void add(Reader& reader);
};

} // namespace filters
