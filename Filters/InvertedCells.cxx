// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "InvertedCells.h"

#include "CellShape.h"
#include "MeshArrays.h"
#include "MeshCell.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

namespace filters
{

namespace
{

/// How many cells of a shape there are in a block, by the sign of their determinants.
struct Signs
{
  std::size_t negative = 0, positive = 0;
};
using SignsByKind = std::map<std::pair<const MeshArrays*, CellShape>, Signs>;

struct Findings
{
  SignsByKind signs;
  std::size_t folded = 0; // of curved cells
};

/// More than this part of all are no mistake, but made so.
constexpr double maxInverted = 0.1;

/// Which corners the edges in the middle of a cell lead from (-) and to (+), along each parametric coordinate.
using Weights = std::array<std::array<signed char, 8>, 3>;

Weights weightsOf(CellShape shape)
{
  switch (shape)
  {
    case CellShape::Tetrahedron:
      return { { { -1, 1 }, { -1, 0, 1 }, { -1, 0, 0, 1 } } };
    case CellShape::Wedge:
      return { { { -1, 1, 0, -1, 1, 0 }, { -1, 0, 1, -1, 0, 1 }, { -1, -1, -1, 1, 1, 1 } } };
    case CellShape::Pyramid:
      return { { { -1, 1, 1, -1 }, { -1, -1, 1, 1 }, { -1, -1, -1, -1, 4 } } };
    default: // Hexahedron
      return { { { -1, 1, 1, -1, -1, 1, 1, -1 }, { -1, -1, 1, 1, -1, -1, 1, 1 },
        { -1, -1, -1, -1, 1, 1, 1, 1 } } };
  }
}

/// The sign of the determinant in the middle of a cell; 0 where it is flat.
int signOf(const CellTree::Cell& cell, CellShape shape)
{
  const int count = cornersOf(shape);
  vtkIdType points[8];
  cell.block->points(cell.id, count, points);
  const Weights weights = weightsOf(shape);
  double edges[3][3] = {};
  for (int i = 0; i < count; ++i)
  {
    double x[3];
    cell.block->coordinates(points[i], x);
    for (std::size_t along = 0; along < 3; ++along)
    {
      const double weight = weights[along][static_cast<std::size_t>(i)];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        edges[along][axis] += weight * x[axis];
      }
    }
  }
  const auto& [a, b, c] = edges;
  const double determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) +
    a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  const auto length = [](const double(&v)[3]) { return std::hypot(v[0], v[1], v[2]); };
  constexpr double flat = 1e-9;
  const double least = flat * length(a) * length(b) * length(c);
  return determinant > least ? 1 : determinant < -least ? -1 : 0;
}

Findings look(const CellTree& cells)
{
  Findings all;
  std::mutex mutex;
  constexpr vtkIdType part = 1 << 16;
  vtkSMPTools::For(0, static_cast<vtkIdType>(cells.size()), part,
    [&](vtkIdType begin, vtkIdType end)
    {
      Findings found;
      MeshCell curved(-1);
      for (vtkIdType place = begin; place < end; ++place)
      {
        const CellTree::Cell cell = cells.cell(cells.number(static_cast<std::size_t>(place)));
        const CellShape shape = shapeOf(cell.block->type(cell.id));
        if (shape == CellShape::Other && isCurved(cell.block->type(cell.id)))
        {
          curved.set(cell.block->data(), cell.id);
          found.folded += curved.isFolded() ? 1 : 0;
        }
        if (shape == CellShape::Voxel || shape == CellShape::Other)
        {
          continue;
        }
        if (const int sign = signOf(cell, shape); sign != 0)
        {
          Signs& signs = found.signs[{ cell.block, shape }];
          ++(sign < 0 ? signs.negative : signs.positive);
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      all.folded += found.folded;
      for (const auto& [kind, signs] : found.signs)
      {
        all.signs[kind].negative += signs.negative;
        all.signs[kind].positive += signs.positive;
      }
    });
  return all;
}

} // namespace

std::string warningOfInvertedCells(const CellTree& cells)
{
  const Findings found = look(cells);
  std::size_t inverted = 0;
  for (const auto& [kind, signs] : found.signs)
  {
    const std::size_t fewer = std::min(signs.negative, signs.positive);
    const auto both = static_cast<double>(signs.negative + signs.positive);
    inverted += static_cast<double>(fewer) <= maxInverted * both ? fewer : 0;
  }
  std::string folded;
  if (found.folded > 0)
  {
    folded = std::to_string(found.folded) + " of " + std::to_string(cells.size()) +
      " cells are curved so much that they fold over themselves, and places in them may not be "
      "found, where light passes as "
      "through a hole. Make the mesh finer there, or its cells linear (Tessellate).";
  }
  if (inverted == 0)
  {
    return folded;
  }
  return (folded.empty() ? "" : folded + " ") + std::to_string(inverted) + " of " +
    std::to_string(cells.size()) +
    " cells are inside out (negative volume, where others of their kind have a positive one, or "
    "the reverse): the mesh is folded there, or their points are in a wrong order. Their values "
    "are used as they are. Look for them with the filter Mesh Quality.";
}

} // namespace filters
