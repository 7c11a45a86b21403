// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/MeshCell.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

// Steps of Newton's method, which converges quadratically.
constexpr int maxSteps = 15;
constexpr double lastStep = 1e-7;
constexpr int maxWithoutGain = 8; // steps at least half as long as the shortest one
constexpr double farthest = 1;    // distance from the range

} // namespace

void MeshCell::set(vtkDataSet* data, vtkIdType cell)
{
  if (this->Data == data && this->Number == cell)
  {
    return;
  }
  this->Data = data;
  this->Number = cell;
  this->HasPoints = false;
  data->GetCell(cell, this->Cell);
  const int type = this->Cell->GetCellType();
  this->Shape = skeletonOf(type);
  vtkIdList* ids = this->Cell->GetPointIds();
  this->Rational.assign(static_cast<std::size_t>(ids->GetNumberOfIds()), 1);
  vtkDataArray* rational = data->GetPointData()->GetRationalWeights();
  if (rational && type >= VTK_BEZIER_CURVE && type <= VTK_BEZIER_PYRAMID)
  {
    for (std::size_t i = 0; i < this->Rational.size(); ++i)
    {
      this->Rational[i] = rational->GetComponent(ids->GetId(static_cast<vtkIdType>(i)), 0);
    }
  }
  if (!isCurved(type))
  {
    this->Kind = nullptr;
  }
  else if (!this->Kind || !this->Kind->isOf(this->Cell, type))
  {
    this->Kind = CurvedKind::of(this->Cell, type, this->Rational);
  }
  this->Weights.resize(this->Rational.size());
  this->Derivatives.resize(3 * this->Weights.size());
}

void MeshCell::setPoints()
{
  this->HasPoints = true;
  this->IsWarm = false;
  this->Points.resize(this->Weights.size());
  this->Length = 0;
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    Vector& point = this->Points[i];
    this->Data->GetPoint(this->Cell->GetPointId(static_cast<int>(i)), point.data());
    if (i == 0)
    {
      this->Origin = point;
    }
    point = point - this->Origin;
    this->Length =
      std::max({ this->Length, std::abs(point[0]), std::abs(point[1]), std::abs(point[2]) });
  }
  if (!this->isPolynomial())
  {
    return;
  }
  this->Coefficients.assign(this->Kind->size(), {});
  const double* factor = this->Kind->factors.data();
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    const Vector weighted = this->Rational[i] * this->Points[i];
    for (std::array<double, 4>& coefficients : this->Coefficients)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        coefficients[axis] += *factor * weighted[axis];
      }
      coefficients[3] += *factor++ * this->Rational[i];
    }
  }
}

void MeshCell::startInTheMiddle()
{
  const bool isBox = this->Shape != CellShape::Tetrahedron && this->Shape != CellShape::Wedge;
  this->Place[0] = this->Place[1] = isBox ? 0.5 : 0.25;
  this->Place[2] = this->Shape == CellShape::Tetrahedron ? 0.25 : 0.5;
}

/// Evaluates the coordinates of Place, and their derivatives.
void MeshCell::evaluate(Vector& x, Vector columns[3])
{
  x = columns[0] = columns[1] = columns[2] = {};
  if (this->isPolynomial())
  {
    double weight = 0;
    Vector slopesOfWeight{};
    this->Kind->forTermsAt(this->Place,
      [&](std::size_t term, double value, const Vector& slopes)
      {
        const std::array<double, 4>& coefficients = this->Coefficients[term];
        const Vector by{ coefficients[0], coefficients[1], coefficients[2] };
        x = x + value * by;
        for (std::size_t along = 0; along < 3; ++along)
        {
          columns[along] = columns[along] + slopes[along] * by;
        }
        weight += value * coefficients[3];
        slopesOfWeight = slopesOfWeight + coefficients[3] * slopes;
      });
    x = (1 / weight) * x;
    for (std::size_t along = 0; along < 3; ++along)
    {
      columns[along] = (1 / weight) * (columns[along] - slopesOfWeight[along] * x);
    }
    return;
  }
  this->Cell->InterpolateFunctions(this->Place, this->Weights.data());
  this->Cell->InterpolateDerivs(this->Place, this->Derivatives.data());
  const std::size_t count = this->Points.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    x = x + this->Weights[i] * this->Points[i];
    for (std::size_t along = 0; along < 3; ++along)
    {
      columns[along] = columns[along] + this->Derivatives[along * count + i] * this->Points[i];
    }
  }
}

bool MeshCell::isFolded(double smallest)
{
  const double* places = this->Cell->GetParametricCoords();
  if (!places)
  {
    return false;
  }
  if (!this->HasPoints)
  {
    this->setPoints();
  }
  double low = 0, high = 0;
  for (std::size_t i = 0; i < this->Points.size(); ++i)
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
  const Vector rows[3] = { cross(columns[1], columns[2]), cross(columns[2], columns[0]),
    cross(columns[0], columns[1]) };
  const double determinant = dot(columns[0], rows[0]);
  for (std::size_t i = 0; i < 3; ++i)
  {
    step[i] = dot(rows[i], rest) / determinant;
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
  if (this->Shape == CellShape::Other)
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
  const Vector from = Vector{ x[0], x[1], x[2] } - this->Origin;
  const int type = this->Cell->GetCellType();
  const double tolerance =
    type == VTK_TETRA || type == VTK_VOXEL ? toleranceOfPlaneFaces : toleranceOfCurvedFaces;
  const auto isFound = [&]
  { return this->iterate(from) && this->missOf(this->Place) <= tolerance; };
  // Starts from the last point, mostly a neighbour. Curved cells may have other solutions outside.
  this->IsWarm = this->IsWarm && isFound();
  if (!this->IsWarm)
  {
    this->startInTheMiddle();
    this->IsWarm = isFound();
  }
  std::copy_n(this->Place, 3, coordinates);
  outside = this->missOf(coordinates);
  return this->IsWarm;
}

/// Returns how far the worst coordinate is outside of its range; infinite for NaN.
double MeshCell::missOf(const double p[3]) const
{
  if (!std::isfinite(p[0] + p[1] + p[2]))
  {
    return HUGE_VAL;
  }
  const double miss = std::max({ 0., -p[0], -p[1], -p[2] });
  switch (this->Shape)
  {
    case CellShape::Tetrahedron:
      return std::max(miss, p[0] + p[1] + p[2] - 1);
    case CellShape::Wedge:
      return std::max({ miss, p[0] + p[1] - 1, p[2] - 1 });
    default:
      return std::max({ miss, p[0] - 1, p[1] - 1, p[2] - 1 });
  }
}

double MeshCell::valueAt(const double x[3], const double coordinates[3], const double* values)
{
  if (this->Shape == CellShape::Other)
  {
    int part = 0;
    double nearest[3], again[3], distance = 0;
    this->Cell->EvaluatePosition(x, nearest, part, again, distance, this->Weights.data());
  }
  else if (this->isPolynomial())
  {
    std::fill(this->Weights.begin(), this->Weights.end(), 0.);
    this->Kind->forTermsAt(coordinates,
      [&](std::size_t term, double value, const Vector&)
      {
        for (std::size_t i = 0; i < this->Weights.size(); ++i)
        {
          this->Weights[i] += this->Kind->factors[i * this->Kind->size() + term] * value;
        }
      });
    double whole = 0;
    for (std::size_t i = 0; i < this->Weights.size(); ++i)
    {
      whole += this->Weights[i] *= this->Rational[i];
    }
    for (double& weight : this->Weights)
    {
      weight /= whole;
    }
  }
  else
  {
    this->Cell->InterpolateFunctions(coordinates, this->Weights.data());
  }
  double sum = 0;
  for (std::size_t i = 0; i < this->Weights.size(); ++i)
  {
    sum += this->Weights[i] * values[this->Cell->GetPointId(static_cast<int>(i))];
  }
  return sum;
}

} // namespace filters
