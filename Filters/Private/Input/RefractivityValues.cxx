// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/RefractivityValues.h"

#include "Common/AvailableMemory.h"
#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>

namespace filters
{

namespace
{

/// The output arrays of N - offset.
template <class Real>
struct Results
{
  Real* out;
  unsigned char* valid;
  Real invalid;
  double offset;

  void set(vtkIdType i, Real n) const
  {
    const bool isValid = this->valid[i] != 0 && std::isfinite(n);
    this->valid[i] = isValid ? 1 : 0;
    this->out[i] = isValid ? n : this->invalid;
  }
};

/// Multiplies floats as floats: apart from the rounding of the factor, which all points share, the
/// result is as accurate as in double precision.
template <class Real>
struct LinearConversion
{
  Linear model;
  Results<Real> results;

  template <class Array>
  void operator()(Array* array) const
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    using Value = std::decay_t<decltype(*values.begin())>;
    const double scale = this->model.scale, offset = this->model.offset - this->results.offset;
    const auto factor = static_cast<float>(scale);
    const bool isInFloats = std::is_same_v<Value, float> && std::is_same_v<Real, float> &&
      this->model.offset == this->results.offset && std::isnormal(factor);
    vtkSMPTools::For(0, array->GetNumberOfTuples(),
      [&](vtkIdType begin, vtkIdType end)
      {
        const Results<Real> to = this->results; // a copy, which writing bytes cannot change
        for (vtkIdType i = begin; i < end; ++i)
        {
          to.set(i,
            isInFloats ? static_cast<Real>(factor * static_cast<float>(values[i]))
                       : static_cast<Real>(scale * static_cast<double>(values[i]) + offset));
        }
      });
  }
};

template <class Real>
void convertBy(
  const Linear& model, const Arrays& values, const Results<Real>& results, Tally& /*unused*/)
{
  const LinearConversion<Real> conversion{ model, results };
  if (!vtkArrayDispatch::Dispatch::Execute(values[0], conversion))
  {
    conversion(values[0]);
  }
}

/// Handles arrays of any type; the models cost more than the virtual calls of vtkDataArray.
template <class Gas, class Real>
void convertBy(const Gas& model, const Arrays& values, const Results<Real>& results, Tally& tally)
{
  std::atomic<long long> all{ 0 }, doubtful{ 0 }, continued{ 0 };
  vtkSMPTools::For(0, values[0]->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<double> state(values.size());
      Tally mine;
      for (vtkIdType i = begin; i < end; ++i)
      {
        bool isFinite = true;
        for (std::size_t k = 0; k < values.size(); ++k)
        {
          state[k] = values[k]->GetComponent(i, 0);
          isFinite = isFinite && std::isfinite(state[k]);
        }
        if (isFinite && results.valid[i])
        {
          ++mine.all;
          mine.doubtful += model.isDoubtful(state.data()) ? 1 : 0;
          mine.continued += model.isContinued(state.data()) ? 1 : 0;
        }
        const double n = isFinite ? model.refractivity(state.data()) : std::nan("");
        results.set(i, static_cast<Real>(n - results.offset));
      }
      all += mine.all;
      doubtful += mine.doubtful;
      continued += mine.continued;
    });
  tally += { all, doubtful, continued };
}

double refractivityOf(const Linear& model, const double* values)
{
  return model.scale * values[0] + model.offset;
}

template <class Gas>
double refractivityOf(const Gas& model, const double* values)
{
  return model.refractivity(values);
}

/// Returns N at a point; NaN where it is not finite.
double refractivityAt(vtkIdType point, const Arrays& values, const Model& model)
{
  std::vector<double> state;
  for (vtkDataArray* array : values)
  {
    state.push_back(array->GetComponent(point, 0));
    if (!std::isfinite(state.back()))
    {
      return std::nan("");
    }
  }
  const double n =
    std::visit([&](const auto& gas) { return refractivityOf(gas, state.data()); }, model);
  return std::isfinite(n) ? n : std::nan("");
}

/// Calls visit(point) for at most some thousand points of a grid's faces.
template <class Visit>
void forSomeOfFaces(const int (&points)[3], const Visit& visit)
{
  constexpr int mostAlongAxis = 32;
  const vtkIdType strides[3] = { 1, points[0], static_cast<vtkIdType>(points[0]) * points[1] };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const int stepA = (points[a] - 1) / mostAlongAxis + 1;
    const int stepB = (points[b] - 1) / mostAlongAxis + 1;
    for (const int face : { 0, points[axis] - 1 })
    {
      for (int i = 0; i < points[a]; i += stepA)
      {
        for (int j = 0; j < points[b]; j += stepB)
        {
          visit(face * strides[axis] + i * strides[a] + j * strides[b]);
        }
      }
    }
  }
}

/// Estimates the ambient N: the median over some points of the grid's faces, or of all points if
/// none of these is gas; 0 without gas.
double offsetFor(
  vtkImageData* grid, const Arrays& values, const Model& model, vtkUnsignedCharArray* valid)
{
  std::vector<double> found;
  const auto add = [&](vtkIdType point)
  {
    const double n =
      valid && valid->GetValue(point) == 0 ? std::nan("") : refractivityAt(point, values, model);
    if (!std::isnan(n))
    {
      found.push_back(n);
    }
  };
  const vtkIdType count = values[0]->GetNumberOfTuples();
  int points[3];
  grid->GetDimensions(points);
  if (grid->GetNumberOfPoints() == count) // else it is a plane, whose points are all on faces
  {
    forSomeOfFaces(points, add);
  }
  if (found.empty())
  {
    constexpr vtkIdType mostOfAll = 10000;
    for (vtkIdType point = 0; point < count; point += (count - 1) / mostOfAll + 1)
    {
      add(point);
    }
  }
  if (found.empty())
  {
    return 0;
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

template <class Array>
vtkSmartPointer<Array> convertWith(const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, double invalid, double offset, Tally& tally)
{
  using Real = typename Array::ValueType;
  auto refractivity = vtkSmartPointer<Array>::New();
  refractivity->SetName(arrayName);
  setTuples(refractivity, values[0]->GetNumberOfTuples());
  const Results<Real> results{ refractivity->GetPointer(0), valid->GetPointer(0),
    static_cast<Real>(invalid), offset };
  std::visit([&](const auto& chosen) { convertBy(chosen, values, results, tally); }, model);
  return refractivity;
}

} // namespace

template <class Array>
vtkSmartPointer<Array> convert(const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, double invalid, Tally& tally)
{
  return convertWith<Array>(values, model, valid, invalid, 0, tally);
}

template vtkSmartPointer<vtkFloatArray> convert(
  const Arrays&, const Model&, vtkUnsignedCharArray*, double, Tally&);
template vtkSmartPointer<vtkDoubleArray> convert(
  const Arrays&, const Model&, vtkUnsignedCharArray*, double, Tally&);

Tally setArrays(vtkImageData* output, const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, Numbers numbers)
{
  Tally tally;
  const vtkSmartPointer<vtkUnsignedCharArray> mask =
    valid ? vtkSmartPointer<vtkUnsignedCharArray>(valid) : newMask(values[0]->GetNumberOfTuples());
  vtkSmartPointer<vtkDataArray> refractivity;
  if (numbers == Numbers::Doubles)
  {
    refractivity = convertWith<vtkDoubleArray>(values, model, mask, 0, 0, tally);
  }
  else
  {
    double offset = 0;
    if (numbers == Numbers::Differences)
    {
      vtkNew<vtkDoubleArray> ofField;
      ofField->SetName(offsetName);
      ofField->InsertNextValue(offset = offsetFor(output, values, model, valid));
      output->GetFieldData()->AddArray(ofField);
    }
    refractivity = convertWith<vtkFloatArray>(values, model, mask, 0, offset, tally);
  }
  output->GetPointData()->SetScalars(refractivity);
  output->GetPointData()->AddArray(mask);
  return tally;
}

void setOutside(vtkUnsignedCharArray* outside, vtkImageData* output)
{
  vtkDataArray* valid = output->GetPointData()->GetArray(maskName);
  bool isAny = false;
  for (vtkIdType i = 0; i < outside->GetNumberOfValues(); ++i)
  {
    if (valid->GetComponent(i, 0) != 0)
    {
      outside->SetValue(i, 0);
    }
    isAny = isAny || outside->GetValue(i) != 0;
  }
  if (isAny)
  {
    output->GetPointData()->AddArray(outside);
  }
}

} // namespace filters
