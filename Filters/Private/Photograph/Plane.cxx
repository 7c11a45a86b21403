// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/Plane.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageInterpolator.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

/// Smooths from row to row with one extended box, 1 within `reach` points and `edge` beyond it.
Plane boxed(const Plane& plane, int reach, double edge)
{
  Plane result(plane.columns, plane.rows);
  const auto columns = static_cast<std::size_t>(plane.columns);
  const auto rowAt = [&](int row)
  { return &plane.values[plane.index(0, std::clamp(row, 0, plane.rows - 1))]; };
  std::vector<double> sums(columns, 0);
  for (int row = -reach; row <= reach; ++row)
  {
    const float* values = rowAt(row);
    for (std::size_t column = 0; column < columns; ++column)
    {
      sums[column] += values[column];
    }
  }
  const double weight = 1 / (2 * reach + 1 + 2 * edge);
  for (int row = 0; row < plane.rows; ++row)
  {
    const float* before = rowAt(row - reach - 1);
    const float* first = rowAt(row - reach);
    const float* behind = rowAt(row + reach + 1);
    float* to = &result.values[result.index(0, row)];
    for (std::size_t column = 0; column < columns; ++column)
    {
      const double ends = double{ before[column] } + double{ behind[column] };
      to[column] = static_cast<float>(weight * (sums[column] + edge * ends));
      sums[column] += double{ behind[column] } - double{ first[column] };
    }
  }
  return result;
}

Plane transposed(const Plane& plane)
{
  constexpr int tile = 16; // of a size that caches hold
  Plane result(plane.rows, plane.columns);
  for (int rows = 0; rows < plane.rows; rows += tile)
  {
    for (int columns = 0; columns < plane.columns; columns += tile)
    {
      for (int row = rows; row < std::min(rows + tile, plane.rows); ++row)
      {
        for (int column = columns; column < std::min(columns + tile, plane.columns); ++column)
        {
          result(row, column) = plane(column, row);
        }
      }
    }
  }
  return result;
}

} // namespace

Lookup::Lookup(const Plane& plane)
{
  vtkNew<vtkFloatArray> array;
  // The interpolator only reads.
  array->SetArray(const_cast<float*>(plane.values.data()), static_cast<vtkIdType>(plane.size()), 1);
  this->Image->SetDimensions(plane.columns, plane.rows, 1);
  this->Image->GetPointData()->SetScalars(array);
  this->Interpolator->SetInterpolationModeToLinear();
  this->Interpolator->Initialize(this->Image);
}

Lookup::~Lookup() = default;

float Lookup::operator()(double column, double row, float outside) const
{
  const double place[3] = { column, row, 0 };
  double value = outside;
  return this->Interpolator->Interpolate(place, &value) ? static_cast<float>(value) : outside;
}

Plane shrunk(const Plane& plane, int factor)
{
  if (factor <= 1)
  {
    return plane;
  }
  Plane result(plane.columns / factor, plane.rows / factor);
  const float weight = 1.f / static_cast<float>(factor * factor);
  for (int row = 0; row < result.rows * factor; ++row)
  {
    const float* from = &plane.values[plane.index(0, row)];
    float* to = &result.values[result.index(0, row / factor)];
    for (int column = 0; column < result.columns; ++column)
    {
      for (int next = 0; next < factor; ++next)
      {
        to[column] += weight * *from++;
      }
    }
  }
  return result;
}

Plane blurred(const Plane& plane, double sigma)
{
  constexpr int boxes = 3;
  const double variance = sigma * sigma / boxes;
  const int reach = static_cast<int>(std::floor(0.5 * (std::sqrt(12 * variance + 1) - 1)));
  const double edge = (2 * reach + 1) * (reach * (reach + 1) - 3 * variance) /
    (6 * (variance - (reach + 1) * (reach + 1)));
  Plane result = plane;
  for (int direction = 0; direction < 2; ++direction)
  {
    for (int box = 0; box < boxes; ++box)
    {
      result = boxed(result, reach, edge);
    }
    result = transposed(result);
  }
  return result;
}

std::pair<Plane, Plane> gradientOf(const Plane& plane)
{
  Plane right(plane.columns, plane.rows), up(plane.columns, plane.rows);
  const auto slope = [](float behind, float before, int points)
  { return points > 0 ? (behind - before) / static_cast<float>(points) : 0; };
  for (int row = 0; row < plane.rows; ++row)
  {
    const int below = std::max(row - 1, 0), above = std::min(row + 1, plane.rows - 1);
    for (int column = 0; column < plane.columns; ++column)
    {
      const int left = std::max(column - 1, 0), next = std::min(column + 1, plane.columns - 1);
      right(column, row) = slope(plane(next, row), plane(left, row), next - left);
      up(column, row) = slope(plane(column, above), plane(column, below), above - below);
    }
  }
  return { std::move(right), std::move(up) };
}

float quantile(std::vector<float>& values, double fraction)
{
  if (values.empty())
  {
    return 0;
  }
  const auto place = values.begin() +
    std::lround(std::clamp(fraction, 0., 1.) * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

} // namespace filters
