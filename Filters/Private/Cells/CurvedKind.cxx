// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CurvedKind.h"

#include "Cells/CellShape.h"

#include "vtkGenericCell.h"

#include <cmath>
#include <mutex>
#include <utility>

namespace filters
{

namespace
{

Reference referenceOf(CellShape skeleton)
{
  return skeleton == CellShape::Tetrahedron
    ? Reference::Simplex
    : (skeleton == CellShape::Wedge ? Reference::Wedge : Reference::Box);
}

double nodeOf(int order, int i) { return -1 + 2. * i / order; }

/// Returns the matrix from values at equidistant nodes to coefficients of powers, row by row, by
/// expanding Lagrange's polynomials.
std::vector<double> powersFromNodes(int order)
{
  const auto count = static_cast<std::size_t>(order) + 1;
  std::vector<double> matrix(count * count);
  for (int node = 0; node <= order; ++node)
  {
    std::vector<double> polynomial{ 1 };
    for (int other = 0; other <= order; ++other)
    {
      if (other == node)
      {
        continue;
      }
      const double scale = 1 / (nodeOf(order, node) - nodeOf(order, other));
      std::vector<double> next(polynomial.size() + 1);
      for (std::size_t k = 0; k < polynomial.size(); ++k)
      {
        next[k + 1] += scale * polynomial[k];
        next[k] -= scale * nodeOf(order, other) * polynomial[k];
      }
      polynomial = std::move(next);
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      matrix[k * count + static_cast<std::size_t>(node)] = polynomial[k];
    }
  }
  return matrix;
}

/// Returns the number of different parametric coordinates along an axis, less one.
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

/// Multiplies `tensor`, with `counts` numbers along the axes, by a matrix along one of them.
void multiplyAlong(const std::vector<double>& matrix, std::size_t axis,
  const std::array<std::size_t, 3>& counts, double* tensor)
{
  const std::size_t count = counts[axis];
  const std::size_t stride = axis == 0 ? counts[1] * counts[2] : (axis == 1 ? counts[2] : 1);
  const std::size_t size = counts[0] * counts[1] * counts[2];
  double line[CurvedKind::maxOrder + 1];
  for (std::size_t outer = 0; outer < size; outer += stride * count)
  {
    for (std::size_t begin = outer; begin < outer + stride; ++begin)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        line[i] = tensor[begin + i * stride];
      }
      for (std::size_t k = 0; k < count; ++k)
      {
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
        {
          sum += matrix[k * count + i] * line[i];
        }
        tensor[begin + k * stride] = sum;
      }
    }
  }
}

} // namespace

bool CurvedKind::isOf(vtkGenericCell* cell, int ofType) const
{
  vtkCell* of = cell->GetRepresentativeCell();
  const double* others = of->GetParametricCoords();
  const auto count = static_cast<std::size_t>(of->GetNumberOfPoints());
  return ofType == this->type &&
    (others ? this->places.size() == 3 * count &&
          std::equal(this->places.begin(), this->places.end(), others)
            : this->places.empty());
}

std::shared_ptr<const CurvedKind> CurvedKind::of(
  vtkGenericCell* cell, int type, const std::vector<double>& weights)
{
  static std::mutex lock; // guards the kinds
  static std::vector<std::shared_ptr<const CurvedKind>> kinds;
  const std::lock_guard<std::mutex> guard(lock);
  const auto known = std::find_if(kinds.begin(), kinds.end(),
    [&](const std::shared_ptr<const CurvedKind>& kind) { return kind->isOf(cell, type); });
  if (known != kinds.end())
  {
    return *known;
  }
  auto kind = std::make_shared<CurvedKind>();
  kind->type = type;
  vtkCell* representative = cell->GetRepresentativeCell();
  if (const double* places = representative->GetParametricCoords())
  {
    kind->places.assign(places, places + 3 * representative->GetNumberOfPoints());
    kind->isUsable = kind->make(cell, weights);
  }
  kinds.push_back(kind);
  return kind;
}

/// Makes the factors. Returns whether they give the cell's own functions.
bool CurvedKind::make(vtkGenericCell* cell, const std::vector<double>& weights)
{
  this->reference = referenceOf(skeletonOf(this->type));
  std::array<std::vector<double>, 3> fromNodes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int order = orderAlong(this->places, axis);
    if (order < 1 || order > maxOrder)
    {
      return false;
    }
    this->orders[axis] = order;
    fromNodes[axis] = powersFromNodes(order);
  }
  const std::size_t points = this->places.size() / 3;
  std::vector<double> functions(points);
  const auto evaluate = [&](const double place[3])
  {
    cell->InterpolateFunctions(place, functions.data());
    double sum = 0; // of the functions without rational weights: 1 but for a common factor
    for (std::size_t point = 0; point < weights.size(); ++point)
    {
      functions[point] /= weights[point];
      sum += functions[point];
    }
    for (std::size_t point = 0; point < weights.size(); ++point)
    {
      functions[point] /= sum;
    }
  };
  this->factors.assign(points * this->size(), 0);
  std::size_t node = 0;
  for (int i = 0; i <= this->orders[0]; ++i)
  {
    for (int j = 0; j <= this->orders[1]; ++j)
    {
      for (int k = 0; k <= this->orders[2]; ++k, ++node)
      {
        const double place[3] = { (nodeOf(this->orders[0], i) + 1) / 2,
          (nodeOf(this->orders[1], j) + 1) / 2, (nodeOf(this->orders[2], k) + 1) / 2 };
        evaluate(place);
        for (std::size_t point = 0; point < points; ++point)
        {
          this->factors[point * this->size() + node] = functions[point];
        }
      }
    }
  }
  for (std::size_t point = 0; point < points; ++point)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      multiplyAlong(
        fromNodes[axis], axis, this->counts(), this->factors.data() + point * this->size());
    }
  }

  const double place[3] = { 0.17, 0.31, 0.23 };
  evaluate(place);
  for (std::size_t point = 0; point < points; ++point)
  {
    double sum = 0;
    this->forTermsAt(place,
      [&](std::size_t term, double value, const Vector&)
      { sum += this->factors[point * this->size() + term] * value; });
    if (!(std::abs(sum - functions[point]) < 1e-9))
    {
      return false;
    }
  }
  return true;
}

} // namespace filters
