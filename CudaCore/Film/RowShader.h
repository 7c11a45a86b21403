// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Exposure.h"
#include "Film/Shading.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>

namespace schlieren
{

/// Where on the film rays land; nowhere at first.
struct RowRange
{
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void add(double y)
  {
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
  }
};

/// Shades an image's rays, row by row of where they start. Whoever deposits them knows no cutoff.
template <int planes>
class RowShader
{
public:
  RowShader(std::int64_t columnCount, std::int64_t rowCount, bool givesPhase)
    : columns(columnCount)
    , rows(rowCount)
    , isOfPhase(givesPhase)
  {
  }
  RowShader(const RowShader&) = delete;
  RowShader& operator=(const RowShader&) = delete;
  virtual ~RowShader() = default;

  const std::int64_t columns, rows; ///< the margin among them
  const bool isOfPhase;             ///< see FringePhase

  /// The rays of a pass that start in a row (from 0 on). Returns the rows of the film (from the first to the
  /// last pixel) that some of them land in.
  virtual RowRange shade(
    const TracedRays& pass, std::int64_t row, FilmRay<planes>* rays, RayCounts& counts) const = 0;
};

/// `planes`: those of the films. The projection and the films stay with their owner.
template <int planes>
std::unique_ptr<const RowShader<planes>> rowShader(
  const Cutoffs& cutoff, const Projection& projection, const Films& films, std::int64_t margin);

} // namespace schlieren
