// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays that look at a view before its image is made: where its light is bent, blocked and displaced.
#pragma once

#include "Bench/ViewSetup.h"
#include "Optics/Techniques.h"
#include "Rays/RayExit.h"
#include "Schlieren.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// What a few rays all over the image have met.
struct PilotView
{
  std::int64_t crossed = 0;     ///< rays that have crossed the data and reach the film
  double strongDeflection = 0;  ///< see strongDeflection(), for automatic k
  double largestDeflection = 0; ///< |eps|
  double path = 0;              ///< metres: range of the optical path difference
  double steepestPath =
    0; ///< metres: its change over a pixel, which 99 % of the rays do not exceed
};

/// One of them, and how far it is moved on the film, pixels.
struct Scout
{
  RayFate fate;
  double deflection[2], moved[2];
};

/// The light of a part of an image, whose pixel (0, 0) is at (column, row) of the image, and pixels are `stride` times as
/// large.
Light lightOfPart(const Light& light, double column, double row, double stride);

/// A ray through the middle of each of some thousand squares of pixels.
class Scouts
{
public:
  /// Traces them by a task with the light of the image.
  template <class Real>
  Scouts(RayTask<Real> task, const ViewSetup<Real>& setup, const Scene& scene);

  const PilotView& view() const { return view_; }
  const std::vector<Scout>& all() const { return scouts_; } ///< row by row
  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }
  std::int64_t stride() const { return stride_; } ///< pixels between them

  /// Null outside of the view.
  const Scout* at(std::int64_t column, std::int64_t row) const;

  /// The largest |eps| of those in and around `columns` x `rows` pixels from a pixel on; see PilotView.
  double largestDeflectionAround(
    std::int64_t column, std::int64_t row, std::int64_t columns, std::int64_t rows) const;

  /// Whether pixels receive light from elsewhere. Fringes need the paths of their own pixels, and are in focus.
  bool areShifted() const { return !isOfCamera_ && !technique_->hasFringes; }
  bool areOfCamera() const { return isOfCamera_; }
  /// Whether some light may pass a body that stops that of the source's middle.
  bool areOfExtendedSource() const { return isExtended_; }

  /// By how much the light of rays differs from that of their neighbours, where they land: for each square.
  std::vector<double> variationsOnFilm() const;

private:
  double variationAt(std::int64_t column, std::int64_t row) const;

  const Technique* technique_;
  bool isOfCamera_;
  bool isExtended_;
  PilotView view_;
  std::vector<Scout> scouts_;
  std::int64_t columns_ = 0, rows_ = 0, stride_ = 1;
};

} // namespace schlieren
