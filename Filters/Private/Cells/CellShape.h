// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Describes cells whose interpolation is a polynomial of degree 1 in each parametric coordinate:
// tetrahedra, hexahedra, voxels, wedges, and pyramids, hexahedra with a collapsed face.
#pragma once

#include "Common/Vectors.h"

#include "vtkCellType.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace filters
{

// Tolerances of parametric coordinates. Cells with plane faces meet without gaps; others get the
// tolerance of VTK's hexahedra.
constexpr double toleranceOfPlaneFaces = 1e-6;
constexpr double toleranceOfCurvedFaces = 1e-3;

enum class CellShape : unsigned char
{
  Tetrahedron,
  Wedge,
  Pyramid,
  Hexahedron,
  Voxel,
  Other // curved, many-sided and flat ones; see asLinearCells() and withoutPolyhedra()
};

inline CellShape shapeOf(int type)
{
  switch (type)
  {
    case VTK_TETRA:
      return CellShape::Tetrahedron;
    case VTK_WEDGE:
      return CellShape::Wedge;
    case VTK_PYRAMID:
      return CellShape::Pyramid;
    case VTK_HEXAHEDRON:
      return CellShape::Hexahedron;
    case VTK_VOXEL:
      return CellShape::Voxel;
    default:
      return CellShape::Other;
  }
}

constexpr int cornersOf(CellShape shape)
{
  constexpr int corners[] = { 4, 6, 5, 8, 8, 8 }; // in their order; of others, the most
  return corners[static_cast<int>(shape)];
}

/// Coefficients of 1, u, v, w, uv, vw, uw and uvw: coordinates from the middle of the cell.
using Polynomial = std::array<double, 8>;

/// Returns the polynomial with these values at a cell's corners, in VTK's order.
template <CellShape shape>
Polynomial polynomialOf(const double* c)
{
  if constexpr (shape == CellShape::Tetrahedron)
  {
    return { 0.25 * (c[0] + c[1] + c[2] + c[3]), c[1] - c[0], c[2] - c[0], c[3] - c[0], 0, 0, 0,
      0 };
  }
  else if constexpr (shape == CellShape::Wedge)
  {
    const double upper[3] = { c[3] - c[0], c[4] - c[1], c[5] - c[2] };
    const double s = c[1] - c[0], t = c[2] - c[0];
    const double sw = upper[1] - upper[0], tw = upper[2] - upper[0];
    return { (c[0] + c[1] + c[2] + c[3] + c[4] + c[5]) / 6, s + 0.5 * sw, t + 0.5 * tw,
      (upper[0] + upper[1] + upper[2]) / 3, 0, tw, sw, 0 };
  }
  else if constexpr (shape == CellShape::Pyramid)
  {
    const double middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    const double u = 0.5 * (c[1] + c[2] - c[0] - c[3]), v = 0.5 * (c[2] + c[3] - c[0] - c[1]);
    const double uv = c[0] + c[2] - c[1] - c[3];
    return { 0.75 * middle + 0.25 * c[4], 0.75 * u, 0.75 * v, c[4] - middle, 0.75 * uv, -v, -u,
      -uv };
  }
  else
  {
    constexpr bool isVoxel = shape == CellShape::Voxel;
    const double c2 = c[isVoxel ? 3 : 2], c3 = c[isVoxel ? 2 : 3];
    const double c6 = c[isVoxel ? 7 : 6], c7 = c[isVoxel ? 6 : 7];
    // Sums and subtracts along u, then along v and w.
    const double s0 = c[0] + c[1], d0 = c[1] - c[0], s1 = c3 + c2, d1 = c2 - c3;
    const double s2 = c[4] + c[5], d2 = c[5] - c[4], s3 = c7 + c6, d3 = c6 - c7;
    const double ss0 = s0 + s1, ss1 = s2 + s3, sd0 = s1 - s0, sd1 = s3 - s2;
    const double ds0 = d0 + d1, ds1 = d2 + d3, dd0 = d1 - d0, dd1 = d3 - d2;
    return { 0.125 * (ss0 + ss1), 0.25 * (ds0 + ds1), 0.25 * (sd0 + sd1), 0.25 * (ss1 - ss0),
      0.5 * (dd0 + dd1), 0.5 * (sd1 - sd0), 0.5 * (ds1 - ds0), dd1 - dd0 };
  }
}

/// Returns act(constant) for a shape other than Other.
template <class Act>
auto withShape(CellShape shape, const Act& act)
{
  switch (shape)
  {
    case CellShape::Tetrahedron:
      return act(std::integral_constant<CellShape, CellShape::Tetrahedron>());
    case CellShape::Wedge:
      return act(std::integral_constant<CellShape, CellShape::Wedge>());
    case CellShape::Pyramid:
      return act(std::integral_constant<CellShape, CellShape::Pyramid>());
    case CellShape::Voxel:
      return act(std::integral_constant<CellShape, CellShape::Voxel>());
    case CellShape::Hexahedron:
    case CellShape::Other:
      break;
  }
  return act(std::integral_constant<CellShape, CellShape::Hexahedron>());
}

inline Polynomial polynomialOf(CellShape shape, const double* corners)
{
  return withShape(
    shape, [&](const auto of) { return polynomialOf<decltype(of)::value>(corners); });
}

/// Computes the rows of the inverse of a matrix of three columns. Returns whether it is regular.
inline bool invert(const Vector columns[3], Vector inverse[3])
{
  constexpr double flattest = 1e-12; // volume relative to that of the box with the same edges
  inverse[0] = cross(columns[1], columns[2]);
  inverse[1] = cross(columns[2], columns[0]);
  inverse[2] = cross(columns[0], columns[1]);
  const double determinant = dot(columns[0], inverse[0]);
  const double box = std::sqrt(
    dot(columns[0], columns[0]) * dot(columns[1], columns[1]) * dot(columns[2], columns[2]));
  if (!(std::abs(determinant) > flattest * box))
  {
    return false;
  }
  for (int i = 0; i < 3; ++i)
  {
    for (double& x : inverse[i])
    {
      x /= determinant;
    }
  }
  return true;
}

} // namespace filters
