// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/PlacesInPart.h"
#include "Common/Vectors.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

class vtkGenericCell;

namespace filters
{

/**
 * The functions of all curved cells of one type with the same parametric coordinates, as polynomials
 * of coordinates that are -1 to 1 in the cell. VTK's functions say what they are, once for each kind:
 * those of some cells allocate objects or write to static ones at each call, and VTK's derivatives of
 * Bezier cells are wrong for triangles, tetrahedra and rational weights.
 */
struct CurvedKind
{
  static constexpr int maxOrder = 10; // VTK's

  int type = 0;
  bool isUsable = false; // whether the functions are such polynomials
  Reference reference = Reference::Box;
  std::array<int, 3> orders{};
  std::vector<double> places;  // parametric coordinates of the cell's points
  std::vector<double> factors; // of each point, to the coefficients

  /// Returns the kind of a cell, which is made once for all. `weights`: rational ones of its points,
  /// which its kind does not contain; empty: equal.
  static std::shared_ptr<const CurvedKind> of(
    vtkGenericCell* cell, int type, const std::vector<double>& weights);
  bool isOf(vtkGenericCell* cell, int ofType) const;

  /// Returns the numbers of terms along the axes of a polynomial, and of all.
  std::array<std::size_t, 3> counts() const
  {
    return { static_cast<std::size_t>(this->orders[0]) + 1,
      static_cast<std::size_t>(this->orders[1]) + 1,
      static_cast<std::size_t>(this->orders[2]) + 1 };
  }
  std::size_t size() const
  {
    const std::array<std::size_t, 3> n = this->counts();
    return n[0] * n[1] * n[2];
  }

  /// Calls act(index of a term, its powers) for all that a polynomial has.
  template <class Act>
  void forTerms(const Act& act) const
  {
    CurvedPart shape{};
    shape.reference = this->reference;
    std::copy_n(this->orders.begin(), 3, shape.orders);
    const std::array<std::size_t, 3> n = this->counts();
    for (int i = 0; i <= shape.orders[0]; ++i)
    {
      for (int j = 0; j <= shape.lastAlong1(i); ++j)
      {
        const std::size_t row =
          (static_cast<std::size_t>(i) * n[1] + static_cast<std::size_t>(j)) * n[2];
        for (int k = 0; k <= shape.lastAlong2(i, j); ++k)
        {
          act(row + static_cast<std::size_t>(k), std::array<int, 3>{ i, j, k });
        }
      }
    }
  }

  /// Calls act(index of a term without a power of one axis, distance to the next power, highest power)
  /// for all that a polynomial has.
  template <class Act>
  void forLines(std::size_t axis, const Act& act) const
  {
    const std::array<std::size_t, 3> n = this->counts();
    const std::array<std::size_t, 3> strides{ n[1] * n[2], n[2], 1 };
    const bool isSlanting =
      this->reference == Reference::Simplex || (this->reference == Reference::Wedge && axis < 2);
    const int most = this->orders[axis];
    this->forTerms(
      [&](std::size_t term, const std::array<int, 3>& powers)
      {
        if (powers[axis] == 0)
        {
          const int others =
            powers[0] + powers[1] + (this->reference == Reference::Simplex ? powers[2] : 0);
          act(term, strides[axis], isSlanting ? most - others : most);
        }
      });
  }

  /// Calls act(index of a term, its value, its slopes) at parametric coordinates.
  template <class Act>
  void forTermsAt(const double place[3], const Act& act) const
  {
    double powers[3][maxOrder + 1], slopes[3][maxOrder + 1];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      powers[axis][0] = 1;
      slopes[axis][0] = 0;
      for (int power = 0; power < this->orders[axis]; ++power)
      {
        powers[axis][power + 1] = powers[axis][power] * (2 * place[axis] - 1);
        slopes[axis][power + 1] = powers[axis][power] * 2 * (power + 1);
      }
    }
    this->forTerms(
      [&](std::size_t term, const std::array<int, 3>& of)
      {
        const double x = powers[0][of[0]], y = powers[1][of[1]], z = powers[2][of[2]];
        act(term, x * y * z,
          Vector{ slopes[0][of[0]] * y * z, x * slopes[1][of[1]] * z, x * y * slopes[2][of[2]] });
      });
  }

private:
  bool make(vtkGenericCell* cell, const std::vector<double>& weights);
};

} // namespace filters
