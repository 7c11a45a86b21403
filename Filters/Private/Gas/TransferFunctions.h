// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MediumSettings.h"

#include <array>
#include <string>
#include <vector>

/// Several fields, each through its range and a curve, to one refractivity (Brownlee et al. 2011, sec. 8).
namespace filters
{

struct Leaf;

/// From a field's value to its part of the refractivity: f((x - low) / (high - low)).
class FieldCurve
{
public:
  /// The range is found later if `low` and `high` are equal. Throws std::runtime_error where the curve has values that are not
  /// finite.
  FieldCurve(const TransferCurve& curve, double low, double high);

  bool hasRange() const { return this->Low != this->High; }
  void setRange(double low, double high);

  /// The curve is read from a table of 2^14 intervals of length h, linearly in between: wrong by no more
  /// than h/4 of the change of slope next to a corner and h^2/8 of the second derivative in a curve. A
  /// jump takes one interval. `x` is finite.
  double at(double x) const;

private:
  double Low, High;
  std::vector<double> Table; // empty: a straight line from 0 to 1
};

/// N = scale * mean of the curves.
struct FieldMean
{
  std::vector<FieldCurve> curves;
  double scale = 1;

  double refractivity(const double* values) const;
  bool isDoubtful(const double*) const { return false; }
  std::string warning(const std::string&) const { return ""; }

  /// Gives those curves that have no range yet that of the field over all leaves: of what is finite and
  /// not hidden. A field that is the same everywhere counts as 0.
  void findRanges(const std::vector<Leaf>& leaves) { this->setRanges(this->rangesIn(leaves)); }

  using Range = std::array<double, 2>; // low > high: of nothing
  /// Of the fields of those curves, and what they are given. Ranges of parts of the data are joined in between.
  std::vector<Range> rangesIn(const std::vector<Leaf>& leaves) const;
  void setRanges(const std::vector<Range>& ranges);
};

} // namespace filters
