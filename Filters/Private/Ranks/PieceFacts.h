// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/DatasetPieces.h"
#include "Input/OneLayer.h"
#include "Ranks/GhostCells.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace filters
{

/// The description of a piece that is sent to all ranks.
struct PieceFacts
{
  Slot slot;
  std::string arrays;
  struct Numbers
  {
    int type, dimension, layers;
    vtkIdType cells;
    std::uint64_t places;
    PointExtent extent;
    LayerBounds layer;
    std::array<double, 3> wedge; // axis, -1: none; angles of the planes
  } numbers;
};

/// `origin`: of wedges; unset: they do not matter.
PieceFacts factsOf(const DatasetPiece& piece, const std::optional<std::array<double, 3>>& origin);

/// Returns whether pieces lie between the same two planes through an axis, see PieceFacts.
bool areOneWedge(const std::vector<std::array<double, 3>>& pieces);

} // namespace filters
