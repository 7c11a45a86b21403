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
  std::vector<Term>& terms = this->Terms[0];
  terms.assign(this->Of->size(), Term{});
  const double* factor = this->Of->factors.data();
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
      for (Term& term : terms)
      {
        for (std::size_t of = 0; of < 4; ++of)
        {
          term[of] += *factor * x[of];
        }
        ++factor;
      }
    });
  return true;
}

/// Makes the polynomials of half of a part, in the next depth: those at (x - 1) / 2 or (x + 1) / 2.
void CurvedCell::split(int from, std::size_t axis, bool isUpper)
{
  std::vector<Term>& to = this->Terms[from + 1];
  to = this->Terms[from];
  const double sign = isUpper ? 1 : -1;
  this->Of->forLines(axis,
    [&](std::size_t begin, std::size_t stride, int last)
    {
      const auto at = [&](int power) -> Term&
      { return to[begin + static_cast<std::size_t>(power) * stride]; };
      double scale = 1;
      for (int power = 1; power <= last; ++power)
      {
        scale /= 2;
        for (double& factor : at(power))
        {
          factor *= scale;
        }
      }
      for (int first = 0; first < last; ++first)
      {
        for (int power = last; power > first; --power)
        {
          const Term& more = at(power);
          Term& sum = at(power - 1);
          for (std::size_t of = 0; of < 4; ++of)
          {
            sum[of] += sign * more[of];
          }
        }
      }
    });
}

/// Chooses the axis whose halves are most nearly linear, by the sizes of terms. Halves have half of
/// a linear term, with which others are compared.
std::size_t CurvedCell::axisToSplit(const Part& part) const
{
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
        const double is = std::abs(this->Normal[term][of]);
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

/// Bounds polynomials in a part, with the tolerance at the faces of the cell.
CurvedCell::Bounds CurvedCell::boundsOf(const std::vector<Term>& terms, const Part& part) const
{
  double most[3][CurvedKind::maxOrder + 1]; // of each power
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double half = part.half[axis], at = part.middle[axis];
    const bool isAtFace =
      this->Of->reference != Reference::Box || at < 1.5 * half || at > 1 - 1.5 * half;
    const double farthest = 1 + (isAtFace ? tolerance / half : 1e-6);
    most[axis][0] = 1;
    for (int power = 0; power < this->Of->orders[axis]; ++power)
    {
      most[axis][power + 1] = most[axis][power] * farthest;
    }
  }
  // Terms whose powers are all even have the sign of their factor, or are 0.
  Term odd{}, even{}, evenWithSign{};
  this->Of->forTerms(
    [&](std::size_t term, const std::array<int, 3>& powers)
    {
      const double by = most[0][powers[0]] * most[1][powers[1]] * most[2][powers[2]];
      const double byOfEven = ((powers[0] | powers[1] | powers[2]) & 1) == 0 ? by : 0;
      for (std::size_t of = 0; of < 4 && term > 0; ++of)
      {
        const double factor = terms[term][of], size = std::abs(factor);
        odd[of] += (by - byOfEven) * size;
        even[of] += byOfEven * size;
        evenWithSign[of] += byOfEven * factor;
      }
    });
  Bounds bounds{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    bounds.low[axis] = (evenWithSign[axis] - even[axis]) / 2 - odd[axis];
    bounds.high[axis] = (evenWithSign[axis] + even[axis]) / 2 + odd[axis];
    bounds.sum[axis] = odd[axis] + even[axis];
  }
  return bounds;
}

/// Sets normal coordinates. Returns their bounds.
CurvedCell::Bounds CurvedCell::setNormal(
  const std::vector<Term>& terms, const Part& part, const Vector rows[3])
{
  this->Normal.resize(terms.size());
  this->Of->forTerms(
    [&](std::size_t term, const std::array<int, 3>&)
    {
      const Term& from = terms[term];
      Term& to = this->Normal[term];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        to[axis] = rows[axis][0] * from[0] + rows[axis][1] * from[1] + rows[axis][2] * from[2];
      }
      to[3] = from[3];
    });
  std::fill_n(this->Normal[0].begin(), 3, 0.);
  return this->boundsOf(this->Normal, part);
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

void CurvedCell::show(
  int depth, const Part& part, bool isRegular, const Vector rows[3], const Bounds& bounds)
{
  CurvedPart found{};
  found.reference = this->Of->reference;
  std::copy_n(this->Of->orders.begin(), 3, found.orders);
  found.coefficients = this->Normal[0].data();
  std::copy_n(part.middle.begin(), 3, found.middle);
  std::copy_n(part.half.begin(), 3, found.half);
  found.isRegular = isRegular;
  found.tolerance = tolerance;
  const Term& middle = this->Terms[depth][0];
  (*this->OnVisit)(
    found, this->Origin + Vector{ middle[0], middle[1], middle[2] }, rows, bounds.low, bounds.high);
}

void CurvedCell::divide(int depth, const Part& part)
{
  const std::vector<Term>& terms = this->Terms[depth];
  const Vector middle = this->Origin + Vector{ terms[0][0], terms[0][1], terms[0][2] };
  const Bounds reached = this->boundsOf(terms, part);
  if (this->isBeyondSlant(part) || !(*this->OnEnter)(middle + reached.low, middle + reached.high))
  {
    return;
  }

  const std::array<std::size_t, 3> counts = this->Of->counts();
  const std::size_t linear[3] = { counts[1] * counts[2], counts[2], 1 };
  Vector rows[3], columns[3];
  for (std::size_t along = 0; along < 3; ++along)
  {
    std::copy_n(terms[linear[along]].begin(), 3, columns[along].begin());
  }
  Bounds bounds{};
  const bool isInvertible = invert(columns, rows);
  if (isInvertible)
  {
    bounds = this->setNormal(terms, part, rows);
  }
  const bool isRegular =
    isInvertible && *std::max_element(bounds.sum.begin(), bounds.sum.end()) < 1 + nearlyLinear;
  if (!isRegular && depth == maxSplitsOfRegular && !this->AreOthersNext)
  {
    this->Others.push_back(part);
    this->TermsOfOthers.insert(this->TermsOfOthers.end(), terms.begin(), terms.end());
    return;
  }
  const bool isLast = depth == maxSplits;
  if (!isRegular && (!isInvertible || isLast))
  {
    findFrame(columns, rows);
    bounds = this->setNormal(terms, part, rows);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      rows[axis] = (bounds.sum[axis] > 0 ? 1 / bounds.sum[axis] : 1) * rows[axis];
    }
    bounds = this->setNormal(terms, part, rows);
  }
  if (isRegular || isLast)
  {
    this->show(depth, part, isRegular, rows, bounds);
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
    this->divide(depth + 1, half);
  }
}

void CurvedCell::forParts(const Enter& enter, const Visit& visit)
{
  this->OnEnter = &enter;
  this->OnVisit = &visit;
  this->Others.clear();
  this->TermsOfOthers.clear();
  this->AreOthersNext = false;
  this->divide(0, { { 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, { 0, 0, 0 } });
  this->AreOthersNext = true;
  auto terms = this->TermsOfOthers.begin();
  for (const Part& part : this->Others)
  {
    const auto end = terms + static_cast<std::ptrdiff_t>(this->Of->size());
    this->Terms[maxSplitsOfRegular].assign(terms, end);
    terms = end;
    this->divide(maxSplitsOfRegular, part);
  }
}

} // namespace filters
