// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/Placing.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReslice.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

namespace filters
{

namespace
{

vtkDataArray* valuesOf(vtkImageData* photograph)
{
  vtkDataArray* values = photograph->GetPointData()->GetScalars();
  return values ? values : photograph->GetPointData()->GetArray(0);
}

/// Adds each pixel's luminance to the mean of its square.
struct AddLuminance
{
  template <class Array>
  void operator()(Array* array, int columns, int factor, double white, Plane& sums) const
  {
    const auto tuples = vtk::DataArrayTupleRange(array);
    const bool isColored = array->GetNumberOfComponents() >= 3;
    const double scale = 1 / (white * factor * factor);
    for (int row = 0; row < sums.rows * factor; ++row)
    {
      for (int column = 0; column < sums.columns * factor; ++column)
      {
        const auto pixel = tuples[vtkIdType{ row } * columns + column];
        const auto value = [&](int component) { return static_cast<double>(pixel[component]); };
        const double light =
          isColored ? 0.2126 * value(0) + 0.7152 * value(1) + 0.0722 * value(2) : value(0);
        sums(column / factor, row / factor) += static_cast<float>(scale * light);
      }
    }
  }
};

} // namespace

Point2 Place::inImage(const Point2& ofPhotograph) const
{
  const std::complex<double> from(
    this->aspect * (ofPhotograph[0] - this->anchor[0]), ofPhotograph[1] - this->anchor[1]);
  const auto to = std::polar(this->scale, this->rotation) * from;
  return { this->position[0] + to.real(), this->position[1] + to.imag() };
}

Point2 Place::inPhotograph(const Point2& ofImage) const
{
  const std::complex<double> to(ofImage[0] - this->position[0], ofImage[1] - this->position[1]);
  const auto from = to / std::polar(this->scale, this->rotation);
  return { this->anchor[0] + from.real() / this->aspect, this->anchor[1] + from.imag() };
}

Place placeByPoints(
  const Point2& from1, const Point2& from2, const Point2& to1, const Point2& to2, double aspect)
{
  const std::complex<double> from(aspect * (from2[0] - from1[0]), from2[1] - from1[1]);
  const std::complex<double> to(to2[0] - to1[0], to2[1] - to1[1]);
  const auto turn = to / from;
  if (!(std::abs(turn) > 0) || !std::isfinite(std::abs(turn)))
  {
    throw std::runtime_error(
      "Both points of the photograph, or of the flow, are at one place. Set "
      "PhotographPoint1 and 2 and FlowPoint1 and 2 to two different places.");
  }
  return { from1, to1, std::abs(turn), std::arg(turn), aspect };
}

Grid::Grid(vtkImageData* image)
  : columns(image->GetDimensions()[0])
  , rows(image->GetDimensions()[1])
  , spacing{ image->GetSpacing()[0], image->GetSpacing()[1] }
{
  for (int axis = 0; axis < 2; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    this->origin[a] = image->GetOrigin()[axis] + image->GetExtent()[2 * axis] * this->spacing[a];
  }
}

double whiteOf(vtkImageData* photograph, vtkImageData* other)
{
  double largest = 0;
  bool areBytes = false;
  for (vtkImageData* one : { photograph, other })
  {
    vtkDataArray* values = one ? valuesOf(one) : nullptr;
    for (int component = 0; values && component < std::min(values->GetNumberOfComponents(), 3);
         ++component)
    {
      largest = std::max(largest, values->GetFiniteRange(component)[1]);
      areBytes = areBytes || values->GetDataType() == VTK_UNSIGNED_CHAR;
    }
  }
  if (!areBytes && largest <= 1)
  {
    return 1;
  }
  int bits = 8;
  while (std::exp2(bits) - 1 < largest)
  {
    bits += 2;
  }
  return std::exp2(bits) - 1;
}

Plane luminanceOf(vtkImageData* photograph, double white, int factor, Grid& grid)
{
  vtkDataArray* values = valuesOf(photograph);
  if (!values || photograph->GetDimensions()[0] < 2 * factor ||
    photograph->GetDimensions()[1] < 2 * factor)
  {
    throw std::runtime_error(
      "The photograph has no values at the points of a plane. Read it with a "
      "reader of images, such as that of PNG files.");
  }
  grid = Grid(photograph);
  Plane sums(grid.columns / factor, grid.rows / factor);
  using Dispatch = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::AllTypes>;
  const AddLuminance add;
  if (!Dispatch::Execute(values, add, grid.columns, factor, white, sums))
  {
    add(values, grid.columns, factor, white, sums);
  }
  grid.origin = grid.at(0.5 * (factor - 1), 0.5 * (factor - 1));
  grid.columns = sums.columns;
  grid.rows = sums.rows;
  for (double& distance : grid.spacing)
  {
    distance *= factor;
  }
  return sums;
}

Plane resampled(const Plane& photograph, const Grid& from, const Place& place, const Grid& image)
{
  vtkNew<vtkImageData> input;
  input->SetDimensions(from.columns, from.rows, 1);
  input->SetOrigin(from.origin[0], from.origin[1], 0);
  input->SetSpacing(from.spacing[0], from.spacing[1], 1);
  vtkNew<vtkFloatArray> array;
  // The filter only reads.
  array->SetArray(
    const_cast<float*>(photograph.values.data()), static_cast<vtkIdType>(photograph.size()), 1);
  input->GetPointData()->SetScalars(array);

  vtkNew<vtkMatrix4x4> axes; // from the image to the photograph
  const Point2 zero = place.inPhotograph({ 0, 0 });
  for (int axis = 0; axis < 2; ++axis)
  {
    const Point2 end = place.inPhotograph({ axis == 0 ? 1. : 0., axis == 1 ? 1. : 0. });
    for (int row = 0; row < 2; ++row)
    {
      const auto r = static_cast<std::size_t>(row);
      axes->SetElement(row, axis, end[r] - zero[r]);
      axes->SetElement(row, 3, zero[r]);
    }
  }
  vtkNew<vtkImageReslice> reslice;
  reslice->SetInputData(input);
  reslice->SetResliceAxes(axes);
  reslice->SetOutputDimensionality(2);
  reslice->SetOutputOrigin(image.origin[0], image.origin[1], 0);
  reslice->SetOutputSpacing(image.spacing[0], image.spacing[1], 1);
  reslice->SetOutputExtent(0, image.columns - 1, 0, image.rows - 1, 0, 0);
  reslice->SetInterpolationModeToLinear();
  reslice->SetBackgroundLevel(std::numeric_limits<double>::quiet_NaN());
  reslice->BorderOff();
  reslice->Update();
  Plane result(image.columns, image.rows);
  const auto values =
    vtk::DataArrayValueRange<1>(reslice->GetOutput()->GetPointData()->GetScalars());
  std::transform(values.begin(), values.end(), result.values.begin(),
    [](double value) { return static_cast<float>(value); });
  return result;
}

} // namespace filters
