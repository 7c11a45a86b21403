// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityValues.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

namespace refractivity
{

namespace
{

template <class Real>
struct Conversion
{
  Model model;
  Real* out;
  unsigned char* valid;
  Real invalid;

  template <class Array>
  void operator()(Array* array) const
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    vtkSMPTools::For(0, array->GetNumberOfTuples(),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const double value = static_cast<double>(values[i]);
          const Real n = static_cast<Real>(this->model.scale * value + this->model.offset);
          const bool isValid = this->valid[i] != 0 && std::isfinite(n);
          this->valid[i] = isValid ? 1 : 0;
          this->out[i] = isValid ? n : this->invalid;
        }
      });
  }
};

} // namespace

vtkSmartPointer<vtkUnsignedCharArray> newMask(vtkIdType count)
{
  auto mask = vtkSmartPointer<vtkUnsignedCharArray>::New();
  mask->SetName(maskName);
  mask->SetNumberOfValues(count);
  mask->FillValue(1);
  return mask;
}

void hidePoints(vtkDataSet* data, vtkUnsignedCharArray* valid)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (vtkUnsignedCharArray* ghosts = data->GetPointGhostArray())
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENPOINT)
      {
        valid->SetValue(i, 0);
      }
    }
  }
  vtkDataArray* mask = data->GetPointData()->GetArray(maskName);
  if (mask && mask->GetNumberOfComponents() == 1 && mask->GetNumberOfTuples() == count)
  {
    const auto values = vtk::DataArrayValueRange<1>(mask);
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (values[i] == 0)
      {
        valid->SetValue(i, 0);
      }
    }
  }
}

template <class Array>
vtkSmartPointer<Array> convert(
  vtkDataArray* values, const Model& model, vtkUnsignedCharArray* valid, double invalid)
{
  using Real = typename Array::ValueType;
  auto refractivity = vtkSmartPointer<Array>::New();
  refractivity->SetName(arrayName);
  refractivity->SetNumberOfValues(values->GetNumberOfTuples());
  const Conversion<Real> conversion{ model, refractivity->GetPointer(0), valid->GetPointer(0),
    static_cast<Real>(invalid) };
  if (!vtkArrayDispatch::Dispatch::Execute(values, conversion))
  {
    conversion(values);
  }
  return refractivity;
}

template vtkSmartPointer<vtkFloatArray> convert(
  vtkDataArray*, const Model&, vtkUnsignedCharArray*, double);
template vtkSmartPointer<vtkDoubleArray> convert(
  vtkDataArray*, const Model&, vtkUnsignedCharArray*, double);

void setArrays(vtkImageData* output, vtkDataArray* values, const Model& model,
  vtkUnsignedCharArray* valid, bool doublePrecision)
{
  vtkSmartPointer<vtkDataArray> refractivity;
  if (doublePrecision)
  {
    refractivity = convert<vtkDoubleArray>(values, model, valid, 0);
  }
  else
  {
    refractivity = convert<vtkFloatArray>(values, model, valid, 0);
  }
  output->GetPointData()->SetScalars(refractivity);
  output->GetPointData()->AddArray(valid);
}

} // namespace refractivity
