// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CurvedCell.h"

#include "Cells/CellShape.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

constexpr double tolerance = 1e-3; // of parametric coordinates, as VTK's

/// Changes of normal coordinates across a part, relative to linear ones, up to which Newton's method
/// converges from them.
constexpr double nearlyLinear = 0.4;

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
    if (!this->Of || !this->Of->isOf(this->Cell, type))
    {
      this->Of = CurvedKind::of(this->Cell, type, {});
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

/// Makes the polynomials of half of a part, in the next depth.
void CurvedCell::split(int from, std::size_t axis, bool isUpper)
{
  const std::array<std::size_t, 3> counts = this->Of->counts();
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
  double halves[CurvedKind::maxOrder + 1] = { 1 };
  for (int power = 0; power < CurvedKind::maxOrder; ++power)
  {
    halves[power + 1] = halves[power] / 2;
  }
  this->Of->forTerms(
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

/// Returns bounds of the powers of coordinates in a part, with the tolerance at the faces of the cell.
CurvedCell::Powers CurvedCell::powersIn(const Part& part) const
{
  Powers powers{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double half = part.half[axis], at = part.middle[axis];
    const bool isAtFace =
      this->Of->reference != Reference::Box || at < 1.5 * half || at > 1 - 1.5 * half;
    const double farthest = 1 + (isAtFace ? tolerance / half : 1e-6);
    powers.along[axis][0] = 1;
    for (int power = 0; power < this->Of->orders[axis]; ++power)
    {
      powers.along[axis][power + 1] = powers.along[axis][power] * farthest;
    }
  }
  return powers;
}

/// Returns whether a part is outside of the face that cuts the box of parametric coordinates.
bool CurvedCell::isBeyondSlant(const Part& part) const
{
  double nearest = 0;
  const std::size_t slanting = this->Of->reference == Reference::Simplex
    ? 3
    : (this->Of->reference == Reference::Wedge ? 2 : 0);
  for (std::size_t axis = 0; axis < slanting; ++axis)
  {
    nearest += part.middle[axis] - part.half[axis];
  }
  return nearest > 1 + 2 * tolerance;
}

void CurvedCell::show(const std::vector<double>& coefficients, const Part& part, bool isRegular,
  const Vector rows[3], const Vector& extent) const
{
  const std::size_t size = this->Of->size();
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
  const Vector middle = { coefficients[0], coefficients[size], coefficients[2 * size] };
  (*this->OnVisit)(found, this->Origin + middle, rows, extent);
}

void CurvedCell::divide(int depth, const Part& part, Visited visited)
{
  const std::size_t size = this->Of->size();
  const std::vector<double>& coefficients = this->Coefficients[depth];
  const Vector middle = { coefficients[0], coefficients[size], coefficients[2 * size] };
  const std::array<std::size_t, 3> counts = this->Of->counts();
  const std::size_t linear[3] = { counts[1] * counts[2], counts[2], 1 };
  const Powers most = this->powersIn(part);
  Vector spread{};
  this->Of->forTerms(
    [&](std::size_t term, const std::array<int, 3>& of)
    {
      for (std::size_t axis = 0; axis < 3 && term > 0; ++axis)
      {
        spread[axis] += most(of) * std::abs(coefficients[axis * size + term]);
      }
    });
  if (this->isBeyondSlant(part) ||
    !(*this->OnEnter)(this->Origin + middle - spread, this->Origin + middle + spread))
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
    this->Of->forTerms(
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
    this->show(coefficients, part, isRegular, rows, extent);
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
