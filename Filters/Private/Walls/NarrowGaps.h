// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include <cstdint>
#include <vector>

namespace filters
{

/// A face seen from its cell.
struct Sides
{
  Point middle;
  Point outward; // unit length, or 0
  double height; // approximate height of the cell above the face
  double width;  // smallest edge
};

/// A face with visible cells on one side only.
struct OpenFace
{
  std::vector<std::int32_t> corners; // seen from the gas, counter-clockwise
  Sides sides;
  bool hidesBehind;
  bool isPart; // whether it belongs to a larger face, so that one test point suffices
};

/// Finds faces beside gaps that close within three faces in all directions: at points that faces of both sides share.
/// Cells of different size have such gaps on a curved side, as far as hanging nodes are beside the larger cell's face,
/// and so have curved cells that are divided at different places. Walls between the sides of a thin body stand where it
/// ends, unless it is sharp there. Returns 1 for each such face.
std::vector<unsigned char> areBesideNarrowGaps(
  const std::vector<Point>& points, const std::vector<OpenFace>& faces);

} // namespace filters
