// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/BasisProduct.h"

#include "vtkBezierHexahedron.h"
#include "vtkBezierQuadrilateral.h"
#include "vtkBezierTetra.h"
#include "vtkBezierTriangle.h"
#include "vtkBezierWedge.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

/// Returns the dimensions of the factors of a type of cells; none: it is no product.
std::vector<int> factorsOf(int type)
{
  switch (type)
  {
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_QUADRILATERAL:
    case VTK_BIQUADRATIC_QUAD:
      return { 1, 1 };
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_BEZIER_TRIANGLE:
    case VTK_QUADRATIC_TRIANGLE:
      return { 2 };
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
      return { 1, 1, 1 };
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
    case VTK_QUADRATIC_TETRA:
      return { 3 };
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
      return { 2, 1 };
    default:
      return {};
  }
}

bool isBezier(int type)
{
  return type == VTK_BEZIER_QUADRILATERAL || type == VTK_BEZIER_TRIANGLE ||
    type == VTK_BEZIER_HEXAHEDRON || type == VTK_BEZIER_TETRAHEDRON || type == VTK_BEZIER_WEDGE;
}

/// Returns null for cells without weights.
vtkDoubleArray* rationalWeightsOf(vtkCell* cell)
{
  vtkDoubleArray* weights = nullptr;
  if (auto* hexahedron = vtkBezierHexahedron::SafeDownCast(cell))
  {
    weights = hexahedron->GetRationalWeights();
  }
  else if (auto* tetrahedron = vtkBezierTetra::SafeDownCast(cell))
  {
    weights = tetrahedron->GetRationalWeights();
  }
  else if (auto* wedge = vtkBezierWedge::SafeDownCast(cell))
  {
    weights = wedge->GetRationalWeights();
  }
  else if (auto* quadrilateral = vtkBezierQuadrilateral::SafeDownCast(cell))
  {
    weights = quadrilateral->GetRationalWeights();
  }
  else if (auto* triangle = vtkBezierTriangle::SafeDownCast(cell))
  {
    weights = triangle->GetRationalWeights();
  }
  return weights && weights->GetNumberOfTuples() > 0 ? weights : nullptr;
}

/// Evaluates Silvester's polynomial, the product of (n x - m) / (m + 1), and its slope.
void lagrange(int order, int node, double x, double& value, double& slope)
{
  value = 1;
  slope = 0;
  for (int m = 0; m < node; ++m)
  {
    const double factor = (order * x - m) / (m + 1);
    slope = slope * factor + value * order / (m + 1);
    value *= factor;
  }
}

/// Evaluates x^node / node!, whose product times n! is Bernstein's polynomial, and its slope.
void bernstein(int node, double x, double& value, double& slope)
{
  value = 1;
  slope = 0;
  for (int m = 1; m <= node; ++m)
  {
    slope = value;
    value *= x / m;
  }
}

} // namespace

int orderAlong(const std::vector<double>& places, std::size_t axis)
{
  std::vector<double> values;
  for (std::size_t i = axis; i < places.size(); i += 3)
  {
    values.push_back(places[i]);
  }
  std::sort(values.begin(), values.end());
  const auto end = std::unique(
    values.begin(), values.end(), [](double a, double b) { return std::abs(a - b) < 1e-6; });
  return static_cast<int>(end - values.begin()) - 1;
}

BasisProduct::Factor BasisProduct::factorOf(int dimension, int order)
{
  Factor factor;
  factor.dimension = dimension;
  factor.order = order;
  for (int k = 0; k <= (dimension > 2 ? order : 0); ++k)
  {
    for (int j = 0; j + k <= (dimension > 1 ? order : k); ++j)
    {
      for (int i = 0; i + j + k <= order; ++i)
      {
        factor.nodes.push_back({ order - i - j - k, i, j, k });
      }
    }
  }
  factor.basis.resize(factor.nodes.size());
  for (auto& slopes : factor.slopes)
  {
    slopes.resize(factor.nodes.size());
  }
  return factor;
}

bool BasisProduct::set(vtkGenericCell* cell, int type)
{
  vtkCell* of = cell->GetRepresentativeCell();
  const double* places = of->GetParametricCoords();
  const auto count = static_cast<std::size_t>(of->GetNumberOfPoints());
  if (!places || factorsOf(type).empty())
  {
    return false;
  }
  vtkDoubleArray* rational = rationalWeightsOf(of);
  this->Rational.clear();
  for (std::size_t i = 0; rational && i < count; ++i)
  {
    this->Rational.push_back(rational->GetValue(static_cast<vtkIdType>(i)));
  }
  if (type != this->Type || this->Places.size() != 3 * count ||
    !std::equal(this->Places.begin(), this->Places.end(), places))
  {
    this->Type = type;
    this->Places.assign(places, places + 3 * count);
    this->IsUsable = this->make(type) && this->isLike(of, type);
  }
  return this->IsUsable;
}

bool BasisProduct::make(int type)
{
  this->IsBezier = isBezier(type);
  this->Factors = {};
  const std::vector<int> dimensions = factorsOf(type);
  const std::size_t count = this->Places.size() / 3;
  std::size_t axis = 0, product = 1;
  for (std::size_t i = 0; i < dimensions.size(); ++i)
  {
    const int order = orderAlong(this->Places, axis);
    if (order < 1 || order > 20)
    {
      return false;
    }
    this->Factors[i] = factorOf(dimensions[i], order);
    product *= this->Factors[i].nodes.size();
    axis += static_cast<std::size_t>(dimensions[i]);
  }
  if (product != count)
  {
    return false;
  }
  // Finds the index of each point among the nodes.
  this->Points.assign(count, count);
  for (std::size_t point = 0; point < count; ++point)
  {
    std::size_t number = 0, step = 1;
    axis = 0;
    for (const Factor& factor : this->Factors)
    {
      if (factor.dimension == 0)
      {
        continue;
      }
      std::array<int, 4> node{ factor.order, 0, 0, 0 };
      for (int i = 1; i <= factor.dimension; ++i)
      {
        const double at = this->Places[3 * point + axis++] * factor.order;
        node[static_cast<std::size_t>(i)] = static_cast<int>(std::lround(at));
        node[0] -= node[static_cast<std::size_t>(i)];
      }
      const auto found = std::find(factor.nodes.begin(), factor.nodes.end(), node);
      if (found == factor.nodes.end())
      {
        return false;
      }
      number += step * static_cast<std::size_t>(found - factor.nodes.begin());
      step *= factor.nodes.size();
    }
    this->Points[number] = point;
  }
  return std::find(this->Points.begin(), this->Points.end(), count) == this->Points.end();
}

/// Returns whether VTK's functions give the same at a test point.
bool BasisProduct::isLike(vtkCell* cell, int type)
{
  const std::size_t count = this->Places.size() / 3;
  const bool isFlat = type == VTK_LAGRANGE_QUADRILATERAL || type == VTK_BEZIER_QUADRILATERAL ||
    type == VTK_BIQUADRATIC_QUAD || type == VTK_LAGRANGE_TRIANGLE || type == VTK_BEZIER_TRIANGLE ||
    type == VTK_QUADRATIC_TRIANGLE;
  const double place[3] = { 0.17, 0.31, isFlat ? 0 : 0.23 };
  std::vector<double> own(count), others(count);
  this->weights(place, own.data());
  cell->InterpolateFunctions(place, others.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!(std::abs(own[i] - others[i]) < 1e-8))
    {
      return false;
    }
  }
  return true;
}

void BasisProduct::findBasis(Factor& factor, const double* place) const
{
  // Evaluates the basis by each barycentric coordinate for all nodes.
  constexpr std::size_t most = 21;
  double values[4][most], slopes[4][most];
  double left = 1;
  for (int i = 0; i < factor.dimension; ++i)
  {
    left -= place[i];
  }
  for (int coordinate = 0; coordinate <= factor.dimension; ++coordinate)
  {
    const double x = coordinate == 0 ? left : place[coordinate - 1];
    for (int node = 0; node <= factor.order; ++node)
    {
      double &value = values[coordinate][node], &slope = slopes[coordinate][node];
      if (this->IsBezier)
      {
        bernstein(node, x, value, slope);
      }
      else
      {
        lagrange(factor.order, node, x, value, slope);
      }
    }
  }
  double factorial = 1;
  for (int i = 2; this->IsBezier && i <= factor.order; ++i)
  {
    factorial *= i;
  }
  for (std::size_t n = 0; n < factor.nodes.size(); ++n)
  {
    const std::array<int, 4>& node = factor.nodes[n];
    double all = factorial, byLeft = factorial * slopes[0][node[0]];
    all *= values[0][node[0]];
    for (int i = 1; i <= factor.dimension; ++i)
    {
      all *= values[i][node[static_cast<std::size_t>(i)]];
      byLeft *= values[i][node[static_cast<std::size_t>(i)]];
    }
    factor.basis[n] = all;
    for (int along = 1; along <= factor.dimension; ++along)
    {
      double by = factorial * values[0][node[0]];
      for (int i = 1; i <= factor.dimension; ++i)
      {
        const auto at = static_cast<std::size_t>(i);
        by *= i == along ? slopes[i][node[at]] : values[i][node[at]];
      }
      factor.slopes[static_cast<std::size_t>(along - 1)][n] = by - byLeft;
    }
  }
}

void BasisProduct::findBases(const double place[3])
{
  const double* from = place;
  for (Factor& factor : this->Factors)
  {
    if (factor.dimension == 0)
    {
      factor.basis.assign(1, 1);
      factor.slopes[0].assign(1, 0);
      continue;
    }
    this->findBasis(factor, from);
    from += factor.dimension;
  }
}

void BasisProduct::sumUp(
  const std::vector<Vector>& points, Vector& sum, Vector derivatives[3]) const
{
  const auto& [first, second, third] = this->Factors;
  const auto inFirst = static_cast<std::size_t>(first.dimension);
  const std::size_t* point = this->Points.data();
  sum = derivatives[0] = derivatives[1] = derivatives[2] = {};
  for (std::size_t k = 0; k < third.basis.size(); ++k)
  {
    Vector inLayer{}, alongFirst[3]{}, alongSecond{};
    for (std::size_t j = 0; j < second.basis.size(); ++j)
    {
      Vector inRow{}, slopes[3]{};
      for (std::size_t i = 0; i < first.basis.size(); ++i, ++point)
      {
        const Vector& x = points[*point];
        inRow = inRow + first.basis[i] * x;
        for (std::size_t axis = 0; axis < inFirst; ++axis)
        {
          slopes[axis] = slopes[axis] + first.slopes[axis][i] * x;
        }
      }
      inLayer = inLayer + second.basis[j] * inRow;
      alongSecond = alongSecond + second.slopes[0][j] * inRow;
      for (std::size_t axis = 0; axis < inFirst; ++axis)
      {
        alongFirst[axis] = alongFirst[axis] + second.basis[j] * slopes[axis];
      }
    }
    sum = sum + third.basis[k] * inLayer;
    for (std::size_t axis = 0; axis < inFirst; ++axis)
    {
      derivatives[axis] = derivatives[axis] + third.basis[k] * alongFirst[axis];
    }
    if (inFirst < 3)
    {
      derivatives[inFirst] = derivatives[inFirst] + third.basis[k] * alongSecond;
    }
    if (inFirst < 2)
    {
      derivatives[2] = derivatives[2] + third.slopes[0][k] * inLayer;
    }
  }
}

void BasisProduct::evaluate(
  const double place[3], const std::vector<Vector>& points, Vector& sum, Vector derivatives[3])
{
  this->findBases(place);
  if (this->Rational.empty())
  {
    this->sumUp(points, sum, derivatives);
    return;
  }
  this->Weighted.resize(points.size());
  this->WeightsAlone.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    this->Weighted[i] = this->Rational[i] * points[i];
    this->WeightsAlone[i] = { this->Rational[i], 0, 0 };
  }
  Vector whole, slopes[3];
  this->sumUp(this->Weighted, sum, derivatives);
  this->sumUp(this->WeightsAlone, whole, slopes);
  sum = (1 / whole[0]) * sum;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    derivatives[axis] = (1 / whole[0]) * (derivatives[axis] - slopes[axis][0] * sum);
  }
}

void BasisProduct::weights(const double place[3], double* weights)
{
  this->findBases(place);
  const std::size_t* point = this->Points.data();
  double whole = 0;
  for (const double z : this->Factors[2].basis)
  {
    for (const double y : this->Factors[1].basis)
    {
      for (const double x : this->Factors[0].basis)
      {
        const double rational = this->Rational.empty() ? 1 : this->Rational[*point];
        weights[*point++] = x * y * z * rational;
        whole += x * y * z * rational;
      }
    }
  }
  for (std::size_t i = 0; !this->Rational.empty() && i < this->Points.size(); ++i)
  {
    weights[i] /= whole;
  }
}

} // namespace filters
