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

#include <atomic>
#include <cmath>

namespace refractivity
{

namespace
{

/// Where N goes.
template <class Real>
struct Results
{
  Real* out;
  unsigned char* valid;
  Real invalid;

  void set(vtkIdType i, double refractivity) const
  {
    const Real n = static_cast<Real>(refractivity);
    const bool isValid = this->valid[i] != 0 && std::isfinite(n);
    this->valid[i] = isValid ? 1 : 0;
    this->out[i] = isValid ? n : this->invalid;
  }
};

template <class Real>
struct LinearConversion
{
  Linear model;
  Results<Real> results;

  template <class Array>
  void operator()(Array* array) const
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    vtkSMPTools::For(0, array->GetNumberOfTuples(),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          this->results.set(
            i, this->model.scale * static_cast<double>(values[i]) + this->model.offset);
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

/// Arrays of any types: what the models compute costs more than the calls of vtkDataArray.
template <class Gas, class Real>
void convertBy(const Gas& model, const Arrays& values, const Results<Real>& results, Tally& tally)
{
  std::atomic<long long> all{ 0 }, doubtful{ 0 };
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
        }
        results.set(i, isFinite ? model.refractivity(state.data()) : std::nan(""));
      }
      all += mine.all;
      doubtful += mine.doubtful;
    });
  tally += { all, doubtful };
}

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
vtkSmartPointer<Array> convert(const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, double invalid, Tally& tally)
{
  using Real = typename Array::ValueType;
  auto refractivity = vtkSmartPointer<Array>::New();
  refractivity->SetName(arrayName);
  refractivity->SetNumberOfValues(values[0]->GetNumberOfTuples());
  const Results<Real> results{ refractivity->GetPointer(0), valid->GetPointer(0),
    static_cast<Real>(invalid) };
  std::visit([&](const auto& chosen) { convertBy(chosen, values, results, tally); }, model);
  return refractivity;
}

template vtkSmartPointer<vtkFloatArray> convert(
  const Arrays&, const Model&, vtkUnsignedCharArray*, double, Tally&);
template vtkSmartPointer<vtkDoubleArray> convert(
  const Arrays&, const Model&, vtkUnsignedCharArray*, double, Tally&);

Tally setArrays(vtkImageData* output, const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, bool doublePrecision)
{
  Tally tally;
  vtkSmartPointer<vtkDataArray> refractivity;
  if (doublePrecision)
  {
    refractivity = convert<vtkDoubleArray>(values, model, valid, 0, tally);
  }
  else
  {
    refractivity = convert<vtkFloatArray>(values, model, valid, 0, tally);
  }
  output->GetPointData()->SetScalars(refractivity);
  output->GetPointData()->AddArray(valid);
  return tally;
}

} // namespace refractivity
