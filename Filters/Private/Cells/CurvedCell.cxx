// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CurvedCell.h"

#include "Cells/BasisProduct.h"
#include "Cells/CellShape.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace filters
{

namespace
{

constexpr double tolerance = 1e-3; // of parametric coordinates, as VTK's
constexpr int maxOrder = 10;

/// Changes of normal coordinates across a part, relative to linear ones, up to which Newton's method
/// converges from them.
constexpr double nearlyLinear = 0.4;

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

/// Returns the matrix from the coefficients of a polynomial to those of the same one in half of its
/// range, at (x - 1) / 2 or (x + 1) / 2.
std::vector<double> halfOf(int order, bool isUpper)
{
  const auto count = static_cast<std::size_t>(order) + 1;
  std::vector<double> matrix(count * count);
  for (std::size_t m = 0; m < count; ++m)
  {
    double binomial = 1;
    for (std::size_t k = 0; k <= m; ++k)
    {
      const double sign = isUpper || (m - k) % 2 == 0 ? 1 : -1;
      matrix[k * count + m] = sign * std::ldexp(binomial, -static_cast<int>(m));
      binomial *= static_cast<double>(m - k) / static_cast<double>(k + 1);
    }
  }
  return matrix;
}

/// Multiplies `tensor`, with `counts` numbers along the axes, by a matrix along one of them.
void multiplyAlong(const std::vector<double>& matrix, std::size_t axis,
  const std::array<std::size_t, 3>& counts, double* tensor)
{
  const std::size_t count = counts[axis];
  const std::size_t stride = axis == 0 ? counts[1] * counts[2] : (axis == 1 ? counts[2] : 1);
  const std::size_t size = counts[0] * counts[1] * counts[2];
  double line[maxOrder + 1];
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

std::array<std::size_t, 3> countsOf(const std::array<int, 3>& orders)
{
  return { static_cast<std::size_t>(orders[0]) + 1, static_cast<std::size_t>(orders[1]) + 1,
    static_cast<std::size_t>(orders[2]) + 1 };
}

/// Makes an orthogonal frame along the longest columns, so that what is nearly flat is so along one
/// axis.
void findFrame(const Vector columns[3], Vector rows[3])
{
  std::array<Vector, 3> sorted{ columns[0], columns[1], columns[2] };
  std::sort(sorted.begin(), sorted.end(),
    [](const Vector& a, const Vector& b) { return dot(a, a) > dot(b, b); });
  rows[0] = unit(sorted[0]);
  Vector rest[2];
  for (std::size_t i = 0; i < 2; ++i)
  {
    rest[i] = sorted[i + 1] - dot(rows[0], sorted[i + 1]) * rows[0];
  }
  rows[1] = unit(dot(rest[0], rest[0]) >= dot(rest[1], rest[1]) ? rest[0] : rest[1]);
  rows[2] = cross(rows[0], rows[1]);
  if (!(dot(rows[2], rows[2]) > 0.5))
  {
    rows[0] = { 1, 0, 0 };
    rows[1] = { 0, 1, 0 };
    rows[2] = { 0, 0, 1 };
  }
}

/// Returns whether cells of a type differ in their order.
bool hasOrder(int type) { return type >= VTK_HIGHER_ORDER_EDGE; }

} // namespace

/// Calls act(index of a term, its powers) for all that a polynomial has.
template <class Act>
void CurvedCell::forTerms(const Kind& kind, const Act& act)
{
  CurvedPart shape{};
  shape.reference = kind.reference;
  std::copy_n(kind.orders.begin(), 3, shape.orders);
  const std::array<std::size_t, 3> counts = countsOf(kind.orders);
  for (int i = 0; i <= shape.orders[0]; ++i)
  {
    for (int j = 0; j <= shape.lastAlong1(i); ++j)
    {
      const std::size_t row =
        (static_cast<std::size_t>(i) * counts[1] + static_cast<std::size_t>(j)) * counts[2];
      for (int k = 0; k <= shape.lastAlong2(i, j); ++k)
      {
        act(row + static_cast<std::size_t>(k), std::array<int, 3>{ i, j, k });
      }
    }
  }
}

bool CurvedCell::set(const CellTree::Cell& cell)
{
  const int type = cell.block->type(cell.id);
  if (!isCurved(type) || cell.block->data()->GetPointData()->GetRationalWeights())
  {
    return false;
  }
  if (!this->Of || type != this->Of->type || hasOrder(type))
  {
    cell.block->data()->GetCell(cell.id, this->Cell);
    if (!this->Of || !isLike(*this->Of, this->Cell, type))
    {
      this->Of = kindOf(this->Cell, type);
    }
  }
  if (!this->Of->isUsable)
  {
    return false;
  }
  const std::size_t size = this->Of->size();
  std::vector<double>& coefficients = this->Coefficients[0];
  coefficients.assign(4 * size, 0);
  const double* factors = this->Of->factors.data();
  bool isFirst = true;
  cell.block->forPoints(cell.id,
    [&](vtkIdType point)
    {
      double x[4];
      cell.block->coordinates(point, x);
      if (isFirst)
      {
        std::copy_n(x, 3, this->Origin.begin());
        isFirst = false;
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        x[axis] -= this->Origin[axis];
      }
      x[3] = cell.block->values()[point];
      for (std::size_t of = 0; of < 4; ++of)
      {
        double* to = coefficients.data() + of * size;
        for (std::size_t term = 0; term < size; ++term)
        {
          to[term] += factors[term] * x[of];
        }
      }
      factors += size;
    });
  return true;
}

bool CurvedCell::isLike(const Kind& kind, vtkGenericCell* cell, int type)
{
  vtkCell* of = cell->GetRepresentativeCell();
  const double* places = of->GetParametricCoords();
  const auto count = static_cast<std::size_t>(of->GetNumberOfPoints());
  return type == kind.type &&
    (places ? kind.places.size() == 3 * count &&
          std::equal(kind.places.begin(), kind.places.end(), places)
            : kind.places.empty());
}

std::shared_ptr<const CurvedCell::Kind> CurvedCell::kindOf(vtkGenericCell* cell, int type)
{
  static std::mutex lock; // guards the kinds
  static std::vector<std::shared_ptr<const Kind>> kinds;
  const std::lock_guard<std::mutex> guard(lock);
  const auto known = std::find_if(kinds.begin(), kinds.end(),
    [&](const std::shared_ptr<const Kind>& kind) { return isLike(*kind, cell, type); });
  if (known != kinds.end())
  {
    return *known;
  }
  auto kind = std::make_shared<Kind>();
  kind->type = type;
  if (const double* places = cell->GetRepresentativeCell()->GetParametricCoords())
  {
    kind->places.assign(places, places + 3 * cell->GetRepresentativeCell()->GetNumberOfPoints());
    kind->isUsable = make(*kind, cell);
  }
  kinds.push_back(kind);
  return kind;
}

/// Makes the factors of a kind of cells. Returns whether they give the cells' own functions.
bool CurvedCell::make(Kind& kind, vtkGenericCell* cell)
{
  kind.reference = referenceOf(skeletonOf(kind.type));
  std::array<std::vector<double>, 3> fromNodes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int order = orderAlong(kind.places, axis);
    if (order < 1 || order > maxOrder)
    {
      return false;
    }
    kind.orders[axis] = order;
    fromNodes[axis] = powersFromNodes(order);
    kind.halves[axis] = { halfOf(order, false), halfOf(order, true) };
  }
  const std::array<std::size_t, 3> counts = countsOf(kind.orders);
  const std::size_t points = kind.places.size() / 3, size = kind.size();
  BasisProduct product;
  const bool isProduct = product.set(cell, kind.type);
  std::vector<double> weights(points);
  const auto weightsAt = [&](const double place[3])
  {
    isProduct ? product.weights(place, weights.data())
              : cell->InterpolateFunctions(place, weights.data());
  };
  kind.factors.assign(points * size, 0);
  std::size_t node = 0;
  for (int i = 0; i <= kind.orders[0]; ++i)
  {
    for (int j = 0; j <= kind.orders[1]; ++j)
    {
      for (int k = 0; k <= kind.orders[2]; ++k)
      {
        const double place[3] = { (nodeOf(kind.orders[0], i) + 1) / 2,
          (nodeOf(kind.orders[1], j) + 1) / 2, (nodeOf(kind.orders[2], k) + 1) / 2 };
        weightsAt(place);
        for (std::size_t point = 0; point < points; ++point)
        {
          kind.factors[point * size + node] = weights[point];
        }
        ++node;
      }
    }
  }
  for (std::size_t point = 0; point < points; ++point)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      multiplyAlong(fromNodes[axis], axis, counts, kind.factors.data() + point * size);
    }
  }

  const double place[3] = { 0.17, 0.31, 0.23 };
  weightsAt(place);
  for (std::size_t point = 0; point < points; ++point)
  {
    double sum = 0;
    forTerms(kind,
      [&](std::size_t term, const std::array<int, 3>& powers)
      {
        double power = 1;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          power *= std::pow(2 * place[axis] - 1, powers[axis]);
        }
        sum += kind.factors[point * size + term] * power;
      });
    if (!(std::abs(sum - weights[point]) < 1e-9))
    {
      return false;
    }
  }
  return true;
}

/// Makes the polynomials of half of a part, in the next depth.
void CurvedCell::split(int from, std::size_t axis, bool isUpper)
{
  const std::array<std::size_t, 3> counts = countsOf(this->Of->orders);
  const std::size_t size = this->Of->size();
  std::vector<double>& to = this->Coefficients[from + 1];
  to = this->Coefficients[from];
  for (std::size_t of = 0; of < 4; ++of)
  {
    multiplyAlong(this->Of->halves[axis][isUpper ? 1 : 0], axis, counts, to.data() + of * size);
  }
}

/// Chooses the axis whose halves are most nearly linear, by the sizes of terms. Halves have half of
/// a linear term, with which others are compared.
std::size_t CurvedCell::axisToSplit(const Part& part) const
{
  const std::size_t size = this->Of->size();
  std::array<double, 3> gains{};
  double halves[maxOrder + 1] = { 1 };
  for (int power = 0; power < maxOrder; ++power)
  {
    halves[power + 1] = halves[power] / 2;
  }
  forTerms(*this->Of,
    [&](std::size_t term, const std::array<int, 3>& powers)
    {
      for (std::size_t of = 0; of < 3 && powers[0] + powers[1] + powers[2] > 1; ++of)
      {
        const double is = std::abs(this->Normal[of * size + term]);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          gains[axis] += is * (1 - (of == axis ? 2 : 1) * halves[powers[axis]]);
        }
      }
    });
  std::size_t best = 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (part.splits[axis] < maxSplitsAlongAxis && (best == 3 || gains[axis] > gains[best]))
    {
      best = axis;
    }
  }
  return best;
}

void CurvedCell::divide(int depth, const Part& part, Visited visited)
{
  const std::size_t size = this->Of->size();
  const std::vector<double>& coefficients = this->Coefficients[depth];
  const Vector middle = { coefficients[0], coefficients[size], coefficients[2 * size] };
  const std::array<std::size_t, 3> counts = countsOf(this->Of->orders);
  const std::size_t linear[3] = { counts[1] * counts[2], counts[2], 1 };
  // Allows for the tolerance at the faces of the cell.
  double powers[3][maxOrder + 1];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double half = part.half[axis], at = part.middle[axis];
    const bool isAtFace =
      this->Of->reference != Reference::Box || at < 1.5 * half || at > 1 - 1.5 * half;
    const double farthest = 1 + (isAtFace ? tolerance / half : 1e-6);
    powers[axis][0] = 1;
    for (int power = 0; power < this->Of->orders[axis]; ++power)
    {
      powers[axis][power + 1] = powers[axis][power] * farthest;
    }
  }
  const auto most = [&](const std::array<int, 3>& of)
  { return powers[0][of[0]] * powers[1][of[1]] * powers[2][of[2]]; };
  Vector spread{};
  forTerms(*this->Of,
    [&](std::size_t term, const std::array<int, 3>& of)
    {
      for (std::size_t axis = 0; axis < 3 && term > 0; ++axis)
      {
        spread[axis] += most(of) * std::abs(coefficients[axis * size + term]);
      }
    });
  if (!(*this->OnEnter)(this->Origin + middle - spread, this->Origin + middle + spread))
  {
    return;
  }
  double nearest = 0; // to the face that cuts the box of parametric coordinates
  const std::size_t slanting = this->Of->reference == Reference::Simplex
    ? 3
    : (this->Of->reference == Reference::Wedge ? 2 : 0);
  for (std::size_t axis = 0; axis < slanting; ++axis)
  {
    nearest += part.middle[axis] - part.half[axis];
  }
  if (nearest > 1 + 2 * tolerance)
  {
    return;
  }

  Vector rows[3], columns[3]{}, extent{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t along = 0; along < 3; ++along)
    {
      columns[along][axis] = coefficients[axis * size + linear[along]];
    }
  }
  this->Normal.resize(3 * size);
  const auto setNormal = [&]
  {
    extent = {};
    forTerms(*this->Of,
      [&](std::size_t term, const std::array<int, 3>& of)
      {
        const Vector by = { coefficients[term], coefficients[size + term],
          coefficients[2 * size + term] };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double is = term == 0 ? 0 : dot(rows[axis], by);
          this->Normal[axis * size + term] = is;
          extent[axis] += most(of) * std::abs(is);
        }
      });
  };
  const bool isInvertible = invert(columns, rows);
  if (isInvertible)
  {
    setNormal();
  }
  const bool isRegular =
    isInvertible && *std::max_element(extent.begin(), extent.end()) < 1 + nearlyLinear;
  const bool isLast = depth == maxSplits;
  if (isRegular ? visited == Visited::Others && depth <= maxSplitsOfRegular
                : visited == Visited::Regular && depth == maxSplitsOfRegular)
  {
    this->HasOthers = this->HasOthers || !isRegular;
    return;
  }
  if (!isRegular && (!isInvertible || isLast))
  {
    findFrame(columns, rows);
    setNormal();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      rows[axis] = (extent[axis] > 0 ? 1 / extent[axis] : 1) * rows[axis];
    }
    setNormal();
  }
  if (isRegular || isLast)
  {
    CurvedPart found{};
    found.reference = this->Of->reference;
    std::copy_n(this->Of->orders.begin(), 3, found.orders);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      found.coefficients[axis] = this->Normal.data() + axis * size;
    }
    found.coefficients[3] = coefficients.data() + 3 * size;
    std::copy_n(part.middle.begin(), 3, found.middle);
    std::copy_n(part.half.begin(), 3, found.half);
    found.isRegular = isRegular;
    found.tolerance = tolerance;
    (*this->OnVisit)(found, this->Origin + middle, rows, extent);
    return;
  }
  const std::size_t axis = this->axisToSplit(part);
  for (const bool isUpper : { false, true })
  {
    this->split(depth, axis, isUpper);
    Part half = part;
    half.half[axis] /= 2;
    half.middle[axis] += isUpper ? half.half[axis] : -half.half[axis];
    ++half.splits[axis];
    this->divide(depth + 1, half, visited);
  }
}

void CurvedCell::forParts(const Enter& enter, const Visit& visit)
{
  this->OnEnter = &enter;
  this->OnVisit = &visit;
  const Part whole{ { 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, { 0, 0, 0 } };
  this->HasOthers = false;
  this->divide(0, whole, Visited::Regular);
  if (this->HasOthers)
  {
    this->divide(0, whole, Visited::Others);
  }
}

} // namespace filters
