// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/MeshCell.h"

#include "Common/Vectors.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkHexahedron.h"
#include "vtkVoxel.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

// Tolerances of parametric coordinates. Cells with plane faces meet without gaps; others get the
// tolerance of VTK's hexahedra.
constexpr double toleranceOfPlaneFaces = 1e-6;
constexpr double toleranceOfCurvedFaces = 1e-3;

// Steps of Newton's method, which converges quadratically.
constexpr int maxSteps = 15;
constexpr double lastStep = 1e-7;
constexpr int maxWithoutGain = 8; // steps at least half as long as the shortest one
constexpr double farthest = 1;    // distance from the range

/// Computes the rows of the inverse of a matrix of three columns; not finite if it is singular.
void invert(const Vector columns[3], double inverse[3][3])
{
  const Vector rows[3] = { cross(columns[1], columns[2]), cross(columns[2], columns[0]),
    cross(columns[0], columns[1]) };
  const double determinant = dot(columns[0], rows[0]);
  for (int i = 0; i < 3; ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      inverse[i][k] = rows[i][k] / determinant;
    }
  }
}

} // namespace

MeshCell::MeshCell(int flatAxis)
  : FlatAxis(flatAxis)
{
}

MeshCell::Shape MeshCell::shapeOf(int type)
{
  switch (type)
  {
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_VOXEL:
    case VTK_HEXAHEDRON:
    case VTK_PYRAMID: // a hexahedron with a collapsed face
    case VTK_QUADRATIC_PYRAMID:
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_QUADRILATERAL:
    case VTK_BEZIER_HEXAHEDRON:
      return Shape::Box;
    case VTK_TRIANGLE:
    case VTK_TETRA:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_QUADRATIC_TETRA:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TRIANGLE:
    case VTK_BEZIER_TETRAHEDRON:
      return Shape::Simplex;
    case VTK_WEDGE:
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return Shape::Wedge;
    default:
      return Shape::Other;
  }
}

void MeshCell::set(vtkDataSet* data, vtkIdType cell)
{
  if (this->Data == data && this->Number == cell)
  {
    return;
  }
  this->Data = data;
  this->Number = cell;
  this->Type = data->GetCellType(cell);
  this->Form = MeshCell::shapeOf(this->Type);
  this->HasPoints = false;
  data->GetCellPoints(cell, this->Count, this->PointIds, this->Ids);
  switch (this->Type)
  {
    case VTK_TRIANGLE:
    case VTK_TETRA:
    case VTK_VOXEL:
    case VTK_HEXAHEDRON:
      this->IsProduct = false;
      break; // its functions are static
    default:
      data->GetCell(cell, this->Cell);
      this->IsProduct = this->Product.set(this->Cell, this->Type);
  }
  const auto count = static_cast<std::size_t>(this->Count);
  this->Weights.resize(std::max<std::size_t>(count, 8));
  this->Derivatives.resize(3 * this->Weights.size());
}

void MeshCell::setPoints()
{
  this->HasPoints = true;
  this->Points.resize(static_cast<std::size_t>(this->Count));
  this->Length = 0;
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    Vector& point = this->Points[i];
    this->Data->GetPoint(this->PointIds[i], point.data());
    if (i == 0)
    {
      this->Origin = point;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] -= this->Origin[axis];
      this->Length = std::max(this->Length, std::abs(point[axis]));
    }
    if (this->FlatAxis >= 0)
    {
      point[static_cast<std::size_t>(this->FlatAxis)] = 0;
    }
  }
  this->IsWarm = false;
  this->HasInverse = this->isAffine();
  if (this->HasInverse)
  {
    this->setInverse();
  }
}

/// Returns whether coordinates are a linear function of the parametric ones.
bool MeshCell::isAffine() const
{
  switch (this->Type)
  {
    case VTK_TRIANGLE:
    case VTK_TETRA:
    case VTK_PIXEL:
    case VTK_VOXEL:
      return true;
    case VTK_HEXAHEDRON:
      break;
    default:
      return false;
  }
  // Tests for a parallelepiped, where three corners determine each other one.
  const std::vector<Vector>& x = this->Points;
  constexpr int sums[4][3] = { { 2, 1, 3 }, { 5, 1, 4 }, { 7, 3, 4 }, { 6, 2, 4 } };
  for (const auto& sum : sums)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!(std::abs(x[static_cast<std::size_t>(sum[1])][axis] +
              x[static_cast<std::size_t>(sum[2])][axis] -
              x[static_cast<std::size_t>(sum[0])][axis]) <= 1e-12 * this->Length))
      {
        return false;
      }
    }
  }
  return true;
}

void MeshCell::setInverse()
{
  const std::vector<Vector>& x = this->Points;
  Vector columns[3] = { x[1], x[this->Type == VTK_HEXAHEDRON ? 3 : 2], {} };
  if (this->FlatAxis >= 0)
  {
    columns[2][static_cast<std::size_t>(this->FlatAxis)] = 1;
  }
  else
  {
    columns[2] = x[this->Type == VTK_TETRA ? 3 : 4];
  }
  invert(columns, this->Inverse);
}

void MeshCell::startInTheMiddle()
{
  const double middle = this->Form == Shape::Box ? 0.5 : 0.25;
  this->Place[0] = this->Place[1] = middle;
  this->Place[2] = this->FlatAxis >= 0 ? 0 : (this->Form == Shape::Wedge ? 0.5 : middle);
}

/// Evaluates the coordinates of Place, and their derivatives.
void MeshCell::evaluate(Vector& x, Vector columns[3])
{
  if (this->IsProduct)
  {
    this->Product.evaluate(this->Place, this->Points, x, columns);
    return;
  }
  if (this->Type == VTK_HEXAHEDRON)
  {
    vtkHexahedron::InterpolationFunctions(this->Place, this->Weights.data());
    vtkHexahedron::InterpolationDerivs(this->Place, this->Derivatives.data());
  }
  else
  {
    this->Cell->InterpolateFunctions(this->Place, this->Weights.data());
    this->Cell->InterpolateDerivs(this->Place, this->Derivatives.data());
  }
  const std::size_t count = this->Points.size(), dimension = this->FlatAxis < 0 ? 3 : 2;
  x = columns[0] = columns[1] = columns[2] = {};
  for (std::size_t i = 0; i < count; ++i)
  {
    x = x + this->Weights[i] * this->Points[i];
    for (std::size_t along = 0; along < dimension; ++along)
    {
      columns[along] = columns[along] + this->Derivatives[along * count + i] * this->Points[i];
    }
  }
}

bool MeshCell::isFolded(double smallest)
{
  const double* places = this->Cell->GetParametricCoords();
  if (this->Form == Shape::Other || !places)
  {
    return false;
  }
  if (!this->HasPoints)
  {
    this->setPoints();
  }
  double low = 0, high = 0;
  for (vtkIdType i = 0; i < this->Count; ++i)
  {
    std::copy_n(places + 3 * i, 3, this->Place);
    Vector x, columns[3];
    this->evaluate(x, columns);
    const double volume = dot(columns[0], cross(columns[1], columns[2]));
    low = std::min(low, volume);
    high = std::max(high, volume);
  }
  this->IsWarm = false;
  const double flat = 1e-9 * this->Length * this->Length * this->Length;
  return std::min(high, -low) > std::max(flat, smallest * std::max(high, -low));
}

/// Returns whether Place is at `x`; else sets the step of Newton's method.
bool MeshCell::isAt(const Vector& x, Vector& step)
{
  Vector reached, columns[3];
  this->evaluate(reached, columns);
  const Vector rest = x - reached;
  if (this->FlatAxis >= 0)
  {
    columns[2][static_cast<std::size_t>(this->FlatAxis)] = 1;
  }
  double inverse[3][3];
  invert(columns, inverse);
  for (std::size_t i = 0; i < 3; ++i)
  {
    step[i] = inverse[i][0] * rest[0] + inverse[i][1] * rest[1] + inverse[i][2] * rest[2];
  }
  // Accepts Place in collapsed cells, too, where there is no step.
  return std::max({ std::abs(rest[0]), std::abs(rest[1]), std::abs(rest[2]) }) <=
    1e-14 * this->Length;
}

bool MeshCell::iterate(const Vector& x)
{
  double shortest = HUGE_VAL;
  int withoutGain = 0;
  for (int i = 0; i < maxSteps; ++i)
  {
    Vector step;
    if (this->isAt(x, step))
    {
      return true;
    }
    double size = 0, moved = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double next = std::clamp(this->Place[axis] + step[axis], -farthest, 1 + farthest);
      size = std::max(size, std::abs(step[axis]));
      moved = std::max(moved, std::abs(next - this->Place[axis]));
      this->Place[axis] = next;
    }
    if (size <= lastStep)
    {
      return true;
    }
    withoutGain = size < 0.5 * shortest ? 0 : withoutGain + 1;
    shortest = std::min(shortest, size);
    if (!std::isfinite(step[0] + step[1] + step[2]) || moved == 0 || withoutGain == maxWithoutGain)
    {
      return false;
    }
  }
  return false;
}

bool MeshCell::find(const double x[3], double coordinates[3], double& outside)
{
  if (this->Form == Shape::Other)
  {
    int part = 0;
    double nearest[3], distance = 0;
    outside = 0;
    return this->Cell->EvaluatePosition(
             x, nearest, part, coordinates, distance, this->Weights.data()) == 1;
  }
  if (!this->HasPoints)
  {
    this->setPoints();
  }
  Vector from = { x[0] - this->Origin[0], x[1] - this->Origin[1], x[2] - this->Origin[2] };
  if (this->FlatAxis >= 0)
  {
    from[static_cast<std::size_t>(this->FlatAxis)] = 0;
  }
  const double tolerance = this->HasInverse ? toleranceOfPlaneFaces : toleranceOfCurvedFaces;
  if (this->HasInverse)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double* row = this->Inverse[i];
      coordinates[i] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
    }
  }
  else
  {
    // Starts from the last point, mostly a neighbour. Curved cells may have other solutions
    // outside.
    this->IsWarm = this->IsWarm && this->iterate(from) && this->missOf(this->Place) <= tolerance;
    if (!this->IsWarm)
    {
      this->startInTheMiddle();
      this->IsWarm = this->iterate(from) && this->missOf(this->Place) <= tolerance;
    }
    std::copy_n(this->Place, 3, coordinates);
    outside = this->missOf(coordinates);
    return this->IsWarm;
  }
  outside = this->missOf(coordinates);
  return outside <= tolerance;
}

/// Returns how far the worst coordinate is outside of its range; infinite for NaN.
double MeshCell::missOf(const double p[3]) const
{
  if (!std::isfinite(p[0] + p[1] + p[2]))
  {
    return HUGE_VAL;
  }
  const double miss = std::max({ 0., -p[0], -p[1], -p[2] });
  switch (this->Form)
  {
    case Shape::Simplex:
      return std::max(miss, p[0] + p[1] + p[2] - 1);
    case Shape::Wedge:
      return std::max({ miss, p[0] + p[1] - 1, p[2] - 1 });
    default:
      return std::max({ miss, p[0] - 1, p[1] - 1, p[2] - 1 });
  }
}

double MeshCell::valueAt(const double x[3], const double coordinates[3], const double* values)
{
  const double* p = coordinates;
  double* weights = this->Weights.data();
  switch (this->Type)
  {
    case VTK_TRIANGLE:
    case VTK_TETRA:
      weights[0] = 1 - p[0] - p[1] - p[2];
      std::copy_n(p, 3, weights + 1);
      break;
    case VTK_VOXEL:
      vtkVoxel::InterpolationFunctions(p, weights);
      break;
    case VTK_HEXAHEDRON:
      vtkHexahedron::InterpolationFunctions(p, weights);
      break;
    default:
      if (this->Form == Shape::Other)
      {
        int part = 0;
        double nearest[3], again[3], distance = 0;
        this->Cell->EvaluatePosition(x, nearest, part, again, distance, weights);
      }
      else if (this->IsProduct)
      {
        this->Product.weights(p, weights);
      }
      else
      {
        this->Cell->InterpolateFunctions(p, weights);
      }
  }
  double sum = 0;
  for (vtkIdType i = 0; i < this->Count; ++i)
  {
    sum += weights[i] * values[this->PointIds[i]];
  }
  return sum;
}

} // namespace filters
