// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/PointFit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace filters
{

namespace
{

/// Added to the matrix for second derivatives, in parts of their mean: where points are too few they are
/// small.
constexpr double leastSecond = 1e-5;
/// Added for first derivatives, for points in a plane or on a line.
constexpr double leastFirst = 1e-12;
/// Both for those of means: what first and second derivatives explain nearly alike, as at the boundary, is taken for a
/// first one.
constexpr double leastSecondOfMeans = 1e-2;
constexpr double leastFirstOfMeans = 1e-6;
/// Means have nothing to be compared with along directions in which their places are spread by less than this part of
/// their size, squared.
constexpr double flat = 0.01;
/// Added to squared distances, relative to their mean, so that weights are finite.
constexpr double leastSquare = 1e-6;

constexpr int unknowns = 9; // three first derivatives, six second ones
constexpr std::size_t fewest = 3;

#define SCHLIEREN_CODE_FOR_PACKS "PointFit.inl"
#include "ForInstructions.inl"

} // namespace

void PointFit::clear(std::size_t most, Values ofWhat)
{
  this->values = ofWhat;
  this->neighbours = most;
  this->perNeighbour = ofWhat == Values::Means ? 10 : 4;
  const std::size_t count = this->perNeighbour * points * most;
  this->numbers.resize(std::max(this->numbers.size(), count));
  std::fill_n(this->numbers.begin(), count, 0.);
  std::fill(std::begin(this->counts), std::end(this->counts), 0);
}

std::vector<FitPoints> functionsToFit() { return SCHLIEREN_VARIANTS_OF(fit); }

} // namespace filters
