// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/SamplingBox.h"

#include "vtkBoundingBox.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace filters
{

namespace
{

/// Relative distance below which a face of the box coincides with grid points.
constexpr double rounding = 1e-6;

} // namespace

//------------------------------------------------------------------------------
SamplingBox::SamplingBox(const double given[6])
{
  std::copy_n(given, 6, this->bounds.begin());
  if (!std::all_of(given, given + 6, [](double x) { return std::isfinite(x); }))
  {
    throw std::runtime_error(
      "SamplingBounds holds a number that is not finite. Give the lowest and highest x, y and z "
      "of a box, or zeros for all of the data.");
  }
}

//------------------------------------------------------------------------------
bool SamplingBox::isWanted(const double bounds[6])
{
  bool isAll = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = bounds[2 * axis], high = bounds[2 * axis + 1];
    isAll = isAll && std::isfinite(low) && std::isfinite(high) && low >= high;
  }
  return !isAll;
}

//------------------------------------------------------------------------------
void SamplingBox::isOutside(const double data[6]) const
{
  std::ostringstream text;
  text << "SamplingBounds holds none of the data, which reach from (" << data[0] << ", " << data[2]
       << ", " << data[4] << ") to (" << data[1] << ", " << data[3] << ", " << data[5]
       << "). Give a box that meets them, or zeros for all of the data.";
  throw std::runtime_error(text.str());
}

//------------------------------------------------------------------------------
bool SamplingBox::meets(const double data[6]) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (this->isGivenAlong(axis) &&
      !(data[2 * axis] < this->bounds[2 * axis + 1] && data[2 * axis + 1] > this->bounds[2 * axis]))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
std::array<double, 6> SamplingBox::within(const double data[6]) const
{
  if (!this->meets(data))
  {
    this->isOutside(data);
  }
  std::array<double, 6> result;
  for (std::size_t n = 0; n < 6; ++n)
  {
    result[n] = this->isGivenAlong(n / 2) ? this->bounds[n] : data[n];
  }
  return result;
}

//------------------------------------------------------------------------------
void SamplingBox::crop(vtkImageData* image) const
{
  if (!this->isGiven())
  {
    return;
  }
  double data[6];
  image->GetBounds(data);
  const std::array<double, 6> box = this->within(data);
  vtkBoundingBox ofIndices;
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    const double place[3] = { box[corner & 1], box[2 + (corner >> 1 & 1)], box[4 + (corner >> 2)] };
    double index[3];
    image->TransformPhysicalPointToContinuousIndex(place, index);
    ofIndices.AddPoint(index);
  }
  int extent[6];
  image->GetExtent(extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double lowest = extent[2 * axis], highest = extent[2 * axis + 1];
    const double low = std::floor(ofIndices.GetBound(2 * axis) + rounding);
    const double high = std::ceil(ofIndices.GetBound(2 * axis + 1) - rounding);
    // Keeps at least one cell of depth.
    extent[2 * axis] = static_cast<int>(std::clamp(low, lowest, std::max(lowest, highest - 1)));
    extent[2 * axis + 1] =
      static_cast<int>(std::clamp(high, std::min<double>(extent[2 * axis] + 1, highest), highest));
  }
  image->Crop(extent);
}

//------------------------------------------------------------------------------
std::array<int, 2> SamplingBox::cellsOf(
  std::size_t axis, double origin, double spacing, int count) const
{
  if (!this->isGivenAlong(axis))
  {
    return { 0, count };
  }
  const double first = std::floor((this->bounds[2 * axis] - origin) / spacing + rounding);
  const double end = std::ceil((this->bounds[2 * axis + 1] - origin) / spacing - rounding);
  const int from = static_cast<int>(std::clamp(first, 0., count - 1.));
  return { from, static_cast<int>(std::clamp(end, from + 1., static_cast<double>(count))) };
}

} // namespace filters
