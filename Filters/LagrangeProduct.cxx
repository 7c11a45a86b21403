// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LagrangeProduct.h"

#include "vtkGenericCell.h"
#include "vtkLagrangeHexahedron.h"
#include "vtkLagrangeQuadrilateral.h"

namespace filters
{

bool LagrangeProduct::set(vtkGenericCell* cell)
{
  auto* hexahedron = vtkLagrangeHexahedron::SafeDownCast(cell->GetRepresentativeCell());
  auto* quadrilateral = vtkLagrangeQuadrilateral::SafeDownCast(cell->GetRepresentativeCell());
  if (!hexahedron && !quadrilateral)
  {
    return false;
  }
  const int* order = hexahedron ? hexahedron->GetOrder() : quadrilateral->GetOrder();
  const std::array<std::size_t, 3> nodes = { static_cast<std::size_t>(order[0]) + 1,
    static_cast<std::size_t>(order[1]) + 1,
    hexahedron ? static_cast<std::size_t>(order[2]) + 1 : 1 };
  if (nodes[0] * nodes[1] * nodes[2] != static_cast<std::size_t>(cell->GetNumberOfPoints()))
  {
    return false;
  }
  if (nodes == this->Nodes)
  {
    return true;
  }
  this->Nodes = nodes;
  this->Points.clear();
  for (int k = 0; k < static_cast<int>(nodes[2]); ++k)
  {
    for (int j = 0; j < static_cast<int>(nodes[1]); ++j)
    {
      for (int i = 0; i < static_cast<int>(nodes[0]); ++i)
      {
        this->Points.push_back(static_cast<std::size_t>(hexahedron
            ? vtkLagrangeHexahedron::PointIndexFromIJK(i, j, k, order)
            : vtkLagrangeQuadrilateral::PointIndexFromIJK(i, j, order)));
      }
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Basis[axis].assign(nodes[axis], 1);
    this->Slopes[axis].assign(nodes[axis], 0);
  }
  return true;
}

void LagrangeProduct::findBasis(const double place[3])
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t nodes = this->Nodes[axis];
    const double x = place[axis] * static_cast<double>(nodes - 1); // nodes are at whole numbers
    for (std::size_t node = 0; nodes > 1 && node < nodes; ++node)
    {
      double product = 1, slope = 0;
      for (std::size_t other = 0; other < nodes; ++other)
      {
        if (other != node)
        {
          const double distance = static_cast<double>(node) - static_cast<double>(other);
          const double factor = (x - static_cast<double>(other)) / distance;
          slope = slope * factor + product / distance;
          product *= factor;
        }
      }
      this->Basis[axis][node] = product;
      this->Slopes[axis][node] = slope * static_cast<double>(nodes - 1);
    }
  }
}

void LagrangeProduct::evaluate(
  const double place[3], const std::vector<Vector>& points, Vector& sum, Vector derivatives[3])
{
  this->findBasis(place);
  const std::size_t* point = this->Points.data();
  sum = derivatives[0] = derivatives[1] = derivatives[2] = {};
  for (std::size_t k = 0; k < this->Nodes[2]; ++k)
  {
    Vector inLayer{}, alongX{}, alongY{};
    for (std::size_t j = 0; j < this->Nodes[1]; ++j)
    {
      Vector inRow{}, slope{};
      for (std::size_t i = 0; i < this->Nodes[0]; ++i, ++point)
      {
        inRow = inRow + this->Basis[0][i] * points[*point];
        slope = slope + this->Slopes[0][i] * points[*point];
      }
      inLayer = inLayer + this->Basis[1][j] * inRow;
      alongX = alongX + this->Basis[1][j] * slope;
      alongY = alongY + this->Slopes[1][j] * inRow;
    }
    sum = sum + this->Basis[2][k] * inLayer;
    derivatives[0] = derivatives[0] + this->Basis[2][k] * alongX;
    derivatives[1] = derivatives[1] + this->Basis[2][k] * alongY;
    derivatives[2] = derivatives[2] + this->Slopes[2][k] * inLayer;
  }
}

void LagrangeProduct::weights(const double place[3], double* weights)
{
  this->findBasis(place);
  const std::size_t* point = this->Points.data();
  for (const double z : this->Basis[2])
  {
    for (const double y : this->Basis[1])
    {
      for (const double x : this->Basis[0])
      {
        weights[*point++] = x * y * z;
      }
    }
  }
}

} // namespace filters
