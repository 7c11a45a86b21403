// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MediumSettings.h"

#include <array>
#include <string>
#include <vector>

/// Maps several fields by ranges and curves to a refractivity (Brownlee et al. 2011, sec. 8).
namespace filters
{

struct Leaf;

/// Maps a field's value x to its contribution: f((x - low) / (high - low)).
class FieldCurve
{
public:
  /// Leaves the range open if `low` and `high` are equal. Throws std::runtime_error for curves with
  /// values that are not finite.
  FieldCurve(const TransferCurve& curve, double low, double high);

  bool hasRange() const { return this->Low != this->High; }
  void setRange(double low, double high);

  /// Interpolates a table of 2^14 intervals of length h. The error is at most h/4 of the change of
  /// slope at a corner and h^2/8 of the second derivative; jumps take one interval. `x` is finite.
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
  bool isContinued(const double*) const { return false; }
  std::string warning(const std::string&) const { return ""; }

  /// Sets open ranges to those of the fields' finite and visible values over all leaves. A field
  /// that is constant contributes 0.
  void findRanges(const std::vector<Leaf>& leaves) { this->setRanges(this->rangesIn(leaves)); }

  using Range = std::array<double, 2>; // low > high: no values
  /// Two steps, between which ranges of blocks or ranks are joined: finds and sets the open ranges.
  std::vector<Range> rangesIn(const std::vector<Leaf>& leaves) const;
  void setRanges(const std::vector<Range>& ranges);
};

} // namespace filters
