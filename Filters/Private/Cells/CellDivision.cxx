// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CellDivision.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkHigherOrderHexahedron.h"
#include "vtkHigherOrderTetra.h"
#include "vtkHigherOrderWedge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace filters
{

namespace
{

/// Function value below which a point does not contribute to a node.
constexpr double nothing = 1e-9;

/// Parts of a lattice of nodes, by offsets. Octahedra in tetrahedra are cut along one diagonal.
using Offset = std::array<int, 3>;
struct PartAt
{
  CellShape shape;
  std::vector<Offset> corners;
};
const std::vector<PartAt>& partsOf(CellShape shape)
{
  constexpr CellShape t = CellShape::Tetrahedron, w = CellShape::Wedge, h = CellShape::Hexahedron;
  constexpr Offset o{ 0, 0, 0 }, x{ 1, 0, 0 }, y{ 0, 1, 0 }, z{ 0, 0, 1 }, xy{ 1, 1, 0 },
    yz{ 0, 1, 1 }, xz{ 1, 0, 1 }, xyz{ 1, 1, 1 };
  static const std::vector<PartAt> boxes{ { h, { o, x, xy, y, z, xz, xyz, yz } } },
    wedges{ { w, { o, x, y, z, xz, yz } }, { w, { x, xy, y, xz, xyz, yz } } },
    tetrahedra{ { t, { o, x, y, z } }, { t, { x, yz, y, z } }, { t, { x, yz, z, xz } },
      { t, { x, yz, xz, xy } }, { t, { x, yz, xy, y } }, { t, { xyz, xz, yz, xy } } };
  return shape == h ? boxes : (shape == w ? wedges : tetrahedra);
}

/// Returns the segments along each axis.
std::array<int, 3> ordersOf(vtkCell* cell)
{
  if (auto* box = vtkHigherOrderHexahedron::SafeDownCast(cell))
  {
    return { box->GetOrder(0), box->GetOrder(1), box->GetOrder(2) };
  }
  if (auto* wedge = vtkHigherOrderWedge::SafeDownCast(cell))
  {
    return { wedge->GetOrder(0), wedge->GetOrder(1), wedge->GetOrder(2) };
  }
  if (auto* tetrahedron = vtkHigherOrderTetra::SafeDownCast(cell))
  {
    const auto order = static_cast<int>(tetrahedron->GetOrder());
    return { order, order, order };
  }
  return { 2, 2, cell->GetCellType() == VTK_QUADRATIC_LINEAR_WEDGE ? 1 : 2 };
}

} // namespace

CellShape skeletonOf(int type)
{
  switch (type)
  {
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
      return CellShape::Hexahedron;
    case VTK_QUADRATIC_TETRA:
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
      return CellShape::Tetrahedron;
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return CellShape::Wedge;
    case VTK_QUADRATIC_PYRAMID:
    case VTK_TRIQUADRATIC_PYRAMID:
      return CellShape::Pyramid;
    default:
      return CellShape::Other;
  }
}

void CellDivision::addPoints(int count)
{
  for (int i = 0; i < count; ++i)
  {
    this->nodes.push_back({ { i, 1. } });
  }
}

/// Adds what the cell's functions say of a place in it. Returns its number.
int CellDivision::addNode(vtkCell* cell, const std::array<double, 3>& place)
{
  std::vector<double> functions(static_cast<std::size_t>(cell->GetNumberOfPoints()));
  cell->InterpolateFunctions(place.data(), functions.data());
  Node& node = this->nodes.emplace_back();
  for (std::size_t i = 0; i < functions.size(); ++i)
  {
    if (std::abs(functions[i]) > nothing)
    {
      node.emplace_back(static_cast<int>(i), functions[i]);
    }
  }
  return static_cast<int>(this->nodes.size()) - 1;
}

/// Divides a pyramid at the middles of its edges and of its base: into one at each corner, one upside
/// down, and a tetrahedron at each triangular side.
void CellDivision::dividePyramid(vtkCell* cell)
{
  constexpr CellShape t = CellShape::Tetrahedron, p = CellShape::Pyramid;
  const bool hasMiddle = cell->GetNumberOfPoints() > 13; // of its base
  this->addPoints(hasMiddle ? 14 : 13);
  const int base = hasMiddle ? 13 : this->addNode(cell, { 0.5, 0.5, 0 });
  this->parts = { { p, { 0, 5, base, 8, 9 } }, { p, { 5, 1, 6, base, 10 } },
    { p, { base, 6, 2, 7, 11 } }, { p, { 8, base, 7, 3, 12 } }, { p, { 9, 10, 11, 12, 4 } },
    { p, { 9, 12, 11, 10, base } }, { t, { 5, 9, 10, base } }, { t, { 6, 10, 11, base } },
    { t, { 7, 11, 12, base } }, { t, { 8, 12, 9, base } } };
}

void CellDivision::divideLattice(vtkCell* cell, CellShape shape)
{
  const std::array<int, 3> n = ordersOf(cell);
  // The lattice of nodes; -1: beyond the slanting face.
  std::vector<int> numbers;
  const auto has = [&](int i, int j, int k)
  {
    return shape == CellShape::Hexahedron ||
      i + j + (shape == CellShape::Tetrahedron ? k : 0) <= n[0];
  };
  for (int k = 0; k <= n[2]; ++k)
  {
    for (int j = 0; j <= n[1]; ++j)
    {
      for (int i = 0; i <= n[0]; ++i)
      {
        numbers.push_back(has(i, j, k)
            ? this->addNode(cell,
                { static_cast<double>(i) / n[0], static_cast<double>(j) / n[1],
                  static_cast<double>(k) / n[2] })
            : -1);
      }
    }
  }
  const auto add = [&](const PartAt& part, int i, int j, int k)
  {
    std::vector<int> corners;
    for (const Offset& of : part.corners)
    {
      const int row = (k + of[2]) * (n[1] + 1) + j + of[1];
      corners.push_back(numbers[static_cast<std::size_t>(row * (n[0] + 1) + i + of[0])]);
    }
    if (*std::min_element(corners.begin(), corners.end()) >= 0)
    {
      this->parts.push_back({ part.shape, std::move(corners) });
    }
  };
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        for (const PartAt& part : partsOf(shape))
        {
          add(part, i, j, k);
        }
      }
    }
  }
}

CellDivision CellDivision::atNodes(vtkCell* cell, CellShape skeleton)
{
  CellDivision division;
  skeleton == CellShape::Pyramid ? division.dividePyramid(cell)
                                 : division.divideLattice(cell, skeleton);
  return division;
}

CellDivision CellDivision::cornersOnly(CellShape skeleton)
{
  CellDivision division;
  division.addPoints(cornersOf(skeleton));
  std::vector<int> corners(division.nodes.size());
  std::iota(corners.begin(), corners.end(), 0);
  division.parts.push_back({ skeleton, std::move(corners) });
  return division;
}

} // namespace filters
