// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Values on the points of a plane grid, and what is done with them before a comparison.
#pragma once

#include "vtkNew.h"

#include <cstddef>
#include <utility>
#include <vector>

class vtkImageData;
class vtkImageInterpolator;

namespace filters
{

/// Values row by row, the lowest row first. Columns and rows are counted from 0.
struct Plane
{
  Plane() = default;
  Plane(int ofColumns, int ofRows, float value = 0)
    : columns(ofColumns)
    , rows(ofRows)
    , values(static_cast<std::size_t>(ofColumns) * static_cast<std::size_t>(ofRows), value)
  {
  }

  std::size_t size() const { return this->values.size(); }
  std::size_t index(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(this->columns) +
      static_cast<std::size_t>(column);
  }
  float& operator()(int column, int row) { return this->values[this->index(column, row)]; }
  float operator()(int column, int row) const { return this->values[this->index(column, row)]; }

  int columns = 0;
  int rows = 0;
  std::vector<float> values;
};

/// Interpolates between the points of a plane, which must outlive it.
class Lookup
{
public:
  explicit Lookup(const Plane& plane);
  ~Lookup();
  Lookup(const Lookup&) = delete;
  Lookup& operator=(const Lookup&) = delete;

  /// Returns the value at a column and a row; `outside` beyond the outermost points.
  float operator()(double column, double row, float outside) const;

private:
  vtkNew<vtkImageData> Image;
  vtkNew<vtkImageInterpolator> Interpolator;
};

/// Returns the means over squares of `factor` x `factor` points; what is left at the last columns and rows is dropped.
Plane shrunk(const Plane& plane, int factor);

/// Smooths with a window close to a Gaussian of this standard deviation, in points: three extended box filters after
/// Gwosdek, Grewenig, Bruhn and Weickert (2011). The outermost values continue beyond the edge.
Plane blurred(const Plane& plane, double sigma);

/// Returns the derivatives per point along rows (to the right) and along columns (up).
std::pair<Plane, Plane> gradientOf(const Plane& plane);

/// Returns the value below which this fraction of the values lies; they are put in another order. 0 of none.
float quantile(std::vector<float>& values, double fraction);

} // namespace filters
