// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellTree.h"
#include "Cells/CurvedKind.h"
#include "Common/Vectors.h"

#include "vtkGenericCell.h"
#include "vtkNew.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace filters
{

/**
 * A curved cell as polynomials of its parametric coordinates, divided into parts in which these are
 * nearly linear. So points outside of the cell are rejected by the bounds of the parts, and Newton's
 * method converges in a few steps, however much the cell is bent. For one thread.
 */
class CurvedCell
{
public:
  /// Returns whether the cell is curved and its coordinates are polynomials: those of cells with
  /// rational weights are not.
  bool set(const CellTree::Cell& cell);

  /// Is called with bounds of coordinates, and returns whether to continue there.
  using Enter = std::function<bool(const Vector& low, const Vector& high)>;
  /// Is called with a part; the origin of its normal coordinates, the rows of the matrix that makes
  /// them, and their bounds.
  using Visit = std::function<void(const CurvedPart& part, const Vector& middle,
    const Vector rows[3], const Vector& low, const Vector& high)>;

  /// Visits the parts, those that are folded or collapsed last, in an order that does not depend on
  /// what is entered.
  void forParts(const Enter& enter, const Visit& visit);

private:
  // Of regular parts that are visited first, and of all.
  static constexpr int maxSplitsOfRegular = 9, maxSplits = 12, maxSplitsAlongAxis = 6;

  /// Of x, y, z and the value, for one term.
  using Term = std::array<double, 4>;
  struct Part
  {
    std::array<double, 3> middle, half;
    std::array<int, 3> splits;
  };
  /// What polynomials reach.
  struct Bounds
  {
    Vector low, high;
    Vector sum; // of all terms but the first, whatever their signs
  };

  Bounds boundsOf(const std::vector<Term>& terms, const Part& part) const;
  Bounds setNormal(const std::vector<Term>& terms, const Part& part, const Vector rows[3]);
  bool isBeyondSlant(const Part& part) const;
  void show(
    int depth, const Part& part, bool isRegular, const Vector rows[3], const Bounds& bounds);
  void split(int from, std::size_t axis, bool isUpper);
  void divide(int depth, const Part& part);
  std::size_t axisToSplit(const Part& part) const;

  std::shared_ptr<const CurvedKind> Of;
  Vector Origin{};
  vtkNew<vtkGenericCell> Cell;
  std::vector<Term> Terms[maxSplits + 1]; // by depth
  std::vector<Term> Normal;               // with normal coordinates in place of x, y and z
  // Folded or collapsed parts of depth maxSplitsOfRegular, and their terms one after another.
  std::vector<Part> Others;
  std::vector<Term> TermsOfOthers;
  bool AreOthersNext = false;
  const Enter* OnEnter = nullptr;
  const Visit* OnVisit = nullptr;
};

} // namespace filters
