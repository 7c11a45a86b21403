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
  /// them, and how far they extend from 0.
  using Visit = std::function<void(
    const CurvedPart& part, const Vector& middle, const Vector rows[3], const Vector& extent)>;

  /// Visits the parts, those that are folded or collapsed last, in an order that does not depend on
  /// what is entered.
  void forParts(const Enter& enter, const Visit& visit);

private:
  // Of regular parts that are visited first, and of all.
  static constexpr int maxSplitsOfRegular = 9, maxSplits = 12, maxSplitsAlongAxis = 6;

  struct Part
  {
    std::array<double, 3> middle, half;
    std::array<int, 3> splits;
  };
  /// Which parts are visited.
  enum class Visited
  {
    Regular,
    Others
  };

  struct Powers
  {
    double along[3][CurvedKind::maxOrder + 1];

    double operator()(const std::array<int, 3>& of) const // of a term
    {
      return this->along[0][of[0]] * this->along[1][of[1]] * this->along[2][of[2]];
    }
  };

  Powers powersIn(const Part& part) const;
  bool isBeyondSlant(const Part& part) const;
  void show(const std::vector<double>& coefficients, const Part& part, bool isRegular,
    const Vector rows[3], const Vector& extent) const;
  void split(int from, std::size_t axis, bool isUpper);
  void divide(int depth, const Part& part, Visited visited);
  std::size_t axisToSplit(const Part& part) const;

  std::shared_ptr<const CurvedKind> Of;
  Vector Origin{};
  vtkNew<vtkGenericCell> Cell;
  std::vector<double> Coefficients[maxSplits + 1]; // of x, y, z and the value, by depth
  std::vector<double> Normal;                      // those of normal coordinates
  bool HasOthers = false;
  const Enter* OnEnter = nullptr;
  const Visit* OnVisit = nullptr;
};

} // namespace filters
