// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRefractiveIndex.h"
#include "vtkSchlierenFilter.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using Vec = std::array<double, 3>;
using ScalarField = std::function<double(const Vec&)>;

constexpr double pi = 3.14159265358979323846;

inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vec cross(const Vec& a, const Vec& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline Vec unit(const Vec& a)
{
  const double length = std::sqrt(dot(a, a));
  return { a[0] / length, a[1] / length, a[2] / length };
}

/// An image without arrays over the cube of half edge `half` around the origin.
inline vtkSmartPointer<vtkImageData> cube(int points, double half = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(points, points, points);
  const double spacing = 2 * half / (points - 1);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(-half, -half, -half);
  return image;
}

/// Adds a point array with the field's values.
inline vtkDoubleArray* addPointArray(vtkDataSet* data, const char* name, const ScalarField& field)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    Vec x;
    data->GetPoint(i, x.data());
    array->SetValue(i, field(x));
  }
  data->GetPointData()->AddArray(array);
  return array;
}

/// Adds a cell array with the field's values at the cells' centres.
inline void addCellArray(vtkDataSet* data, const char* name, const ScalarField& field)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(data->GetNumberOfCells());
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    data->GetCellBounds(i, bounds);
    array->SetValue(i,
      field(
        { (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, (bounds[4] + bounds[5]) / 2 }));
  }
  data->GetCellData()->AddArray(array);
}

/// Steps of a voxel, and so many rays per pixel, whatever the presets are.
inline void traceEveryVoxel(vtkSchlierenFilter* filter, int samplesPerPixel)
{
  filter->SetStepSize(1);
  filter->SetSamplesPerPixel(samplesPerPixel);
}

/// A filter that takes the array "N" as the refractivity, in vacuum, one ray at each pixel's centre, and for each image a k of its own.
inline vtkSmartPointer<vtkSchlierenFilter> bench(vtkDataObject* input, int pixels = 64)
{
  auto filter = vtkSmartPointer<vtkSchlierenFilter>::New();
  filter->SetInputDataObject(input);
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  filter->SetAmbientRefractivity(0);
  filter->SetKMode(vtkSchlierenFilter::K_AUTOMATIC);
  filter->SetImageSize(pixels, pixels);
  traceEveryVoxel(filter, 1);
  return filter;
}

inline vtkDataArray* arrayOf(vtkAlgorithm* filter, const char* name)
{
  return vtkImageData::SafeDownCast(filter->GetOutputDataObject(0))->GetPointData()->GetArray(name);
}

/// All values of a point array, component by component; of a vector in the image's plane those along u and v.
inline std::vector<double> valuesOf(vtkAlgorithm* filter, const char* name)
{
  std::vector<double> values;
  vtkDataArray* array = arrayOf(filter, name);
  EXPECT_NE(array, nullptr) << name;
  const bool isInPlane = array && array->GetComponentName(2) != nullptr;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < (isInPlane ? 2 : array->GetNumberOfComponents());
         ++component)
    {
      values.push_back(array->GetComponent(i, component));
    }
  }
  return values;
}

inline double fieldValue(vtkAlgorithm* filter, const char* name)
{
  vtkDataArray* array = filter->GetOutputDataObject(0)->GetFieldData()->GetArray(name);
  EXPECT_NE(array, nullptr) << name;
  return array ? array->GetComponent(0, 0) : std::nan("");
}

/// Whether all outputs are.
inline bool isEmpty(vtkAlgorithm* filter)
{
  bool allAre = true;
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    allAre =
      allAre && filter->GetOutputDataObject(port)->GetNumberOfElements(vtkDataObject::POINT) == 0;
  }
  return allAre;
}

/// A value of the array that vtkRefractiveIndex appends, and the point or the middle of the cell that has it.
struct PlacedValue
{
  Vec place;
  double value;
};

/// Lists the values of all datasets of the output.
inline std::vector<PlacedValue> refractivityOf(vtkRefractiveIndex* filter)
{
  std::vector<vtkDataSet*> dataSets;
  vtkDataObject* output = filter->GetOutputDataObject(0);
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(output))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      dataSets.push_back(vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()));
    }
  }
  else
  {
    dataSets.push_back(vtkDataSet::SafeDownCast(output));
  }
  std::vector<PlacedValue> values;
  for (vtkDataSet* data : dataSets)
  {
    vtkDataArray* ofPoints = data->GetPointData()->GetArray("Refractivity");
    vtkDataArray* ofCells = data->GetCellData()->GetArray("Refractivity");
    for (vtkIdType i = 0; ofPoints && i < data->GetNumberOfPoints(); ++i)
    {
      const double* x = data->GetPoint(i);
      values.push_back({ { x[0], x[1], x[2] }, ofPoints->GetComponent(i, 0) });
    }
    for (vtkIdType i = 0; ofCells && i < data->GetNumberOfCells(); ++i)
    {
      double bounds[6];
      data->GetCellBounds(i, bounds);
      values.push_back(
        { { (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, (bounds[4] + bounds[5]) / 2 },
          ofCells->GetComponent(i, 0) });
    }
  }
  return values;
}

inline double largest(const std::vector<double>& values)
{
  double result = 0;
  for (const double value : values)
  {
    result = std::max(result, std::abs(value));
  }
  return result;
}

/// The largest difference of two arrays, relative to the largest value of the second.
inline double relativeDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  EXPECT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 0u);
  std::vector<double> difference;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    // Not std::max: NaN must not pass.
    difference.push_back(std::isfinite(a[i] - b[i]) ? a[i] - b[i] : HUGE_VAL);
  }
  return largest(difference) / largest(b);
}

/// Collects what a filter and its executive complain about.
class Complaints : public vtkCommand
{
public:
  explicit Complaints(vtkAlgorithm* filter)
  {
    for (vtkObject* object :
      { static_cast<vtkObject*>(filter), static_cast<vtkObject*>(filter->GetExecutive()) })
    {
      object->AddObserver(vtkCommand::ErrorEvent, this);
      object->AddObserver(vtkCommand::WarningEvent, this);
    }
  }

  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings)
      .emplace_back(static_cast<const char*>(data));
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

/// Makes a mistake, expects one message with all of `words` and an empty image, puts the mistake right
/// and expects an image.
template <class Filter, class Make, class Correct>
void expectOneMessage(
  Filter* filter, const Make& make, const std::vector<std::string>& words, const Correct& correct)
{
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  make(filter);
  filter->Update();
  filter->Update(); // a view that is drawn again requests again
  EXPECT_TRUE(isEmpty(filter));
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_TRUE(complaints->Warnings.empty());
  for (const std::string& word : words)
  {
    EXPECT_NE(complaints->Errors[0].find(word), std::string::npos)
      << "no '" << word << "' in: " << complaints->Errors[0];
  }

  correct(filter);
  filter->Update();
  EXPECT_EQ(complaints->Errors.size(), 1u);
  EXPECT_FALSE(isEmpty(filter));
}

/// The axes of an image, as vtkCamera has them.
struct Axes
{
  Axes(const Vec& viewDirection, const Vec& viewUp)
    : u(unit(cross(viewDirection, viewUp)))
    , v(unit(cross(u, viewDirection)))
  {
  }

  Vec u, v;
};

/// A column A exp(-r^2/s^2) around the y axis and what it does to light that crosses it.
struct GaussianColumn
{
  double A = 2.7e-4;
  double s = 0.3;

  double operator()(const Vec& x) const
  {
    return this->A * std::exp(-(x[0] * x[0] + x[2] * x[2]) / (this->s * this->s));
  }
  /// For a ray at the distance b from the axis, positive along the deflection that is returned.
  double deflection(double b) const
  {
    return -2 * std::sqrt(pi) * this->A * b / this->s * std::exp(-b * b / (this->s * this->s));
  }
  double opticalPath(double b) const
  {
    return std::sqrt(pi) * this->A * this->s * std::exp(-b * b / (this->s * this->s));
  }
};

/// A cube with that column as its array "N".
inline vtkSmartPointer<vtkImageData> columnImage(int points = 24)
{
  auto image = cube(points);
  addPointArray(image, "N", GaussianColumn());
  return image;
}

/// Compares the image of a column with the closed form: largest errors of the deflection and of the
/// optical path difference, relative to their largest values.
struct ColumnErrors
{
  double deflection = 0;
  double opticalPath = 0;
};

inline ColumnErrors compareWithColumn(vtkSchlierenFilter* filter, const GaussianColumn& column,
  const Vec& viewDirection = { 0, 0, -1 }, const Vec& viewUp = { 0, 1, 0 })
{
  const Axes axes(viewDirection, viewUp);
  const Vec h = unit(cross(viewDirection, { 0, 1, 0 })); // across the column and the light
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  std::vector<double> deflection, opticalPath;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const double b = x[0] * dot(axes.u, h) + x[1] * dot(axes.v, h);
    deflection.push_back(column.deflection(b) * dot(axes.u, h));
    deflection.push_back(column.deflection(b) * dot(axes.v, h));
    opticalPath.push_back(column.opticalPath(b) * filter->GetLengthScale());
  }
  return { relativeDifference(valuesOf(filter, "Deflection"), deflection),
    relativeDifference(valuesOf(filter, "OpticalPathDifference"), opticalPath) };
}
