// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityValues.h"

#include "AvailableMemory.h"
#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace filters
{

namespace
{

/// Where N goes.
template <class Real>
struct Results
{
  Real* out;
  unsigned char* valid;
  bool isValidSet; // else all is valid as yet, and `valid` holds anything
  Real invalid;

  void set(vtkIdType i, double refractivity) const
  {
    const Real n = static_cast<Real>(refractivity);
    const bool isValid = this->valid[i] != 0 && std::isfinite(n);
    this->valid[i] = isValid ? 1 : 0;
    this->out[i] = isValid ? n : this->invalid;
  }
};

/// Block by block, so that what a block has of bad values is found while it is in the cache: there are
/// hardly ever any, and all that is left then is a loop over two arrays.
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
        constexpr vtkIdType block = 2048;
        for (vtkIdType first = begin; first < end; first += block)
        {
          this->ConvertBlock(values.begin() + first, first, std::min(block, end - first));
        }
      });
  }

  template <class Iterator>
  void ConvertBlock(Iterator values, vtkIdType first, vtkIdType count) const
  {
    // A product of floats is rounded as little as one that is computed in double and stored as float,
    // apart from the factor's own rounding, which is the same for all points.
    using Value = std::decay_t<decltype(values[0])>;
    const float factor = static_cast<float>(this->model.scale);
    const bool isInFloats = std::is_same_v<Value, float> && std::is_same_v<Real, float> &&
      this->model.offset == 0 && std::isnormal(factor);
    const bool isGood = isInFloats
      ? this->Store(values, first, count,
          [factor](auto v) { return static_cast<Real>(factor * static_cast<float>(v)); })
      : this->Store(values, first, count,
          [scale = this->model.scale, offset = this->model.offset](auto v)
          { return static_cast<Real>(scale * static_cast<double>(v) + offset); });
    unsigned char* valid = this->results.valid + first;
    const auto bytes = static_cast<std::size_t>(count);
    if (!this->results.isValidSet)
    {
      std::memset(valid, 1, bytes);
    }
    if (!isGood || (this->results.isValidSet && std::memchr(valid, 0, bytes) != nullptr))
    {
      for (vtkIdType i = 0; i < count; ++i)
      {
        this->results.set(first + i, this->results.out[first + i]);
      }
    }
  }

  /// Whether all refractivities are finite.
  template <class Iterator, class Convert>
  bool Store(Iterator values, vtkIdType first, vtkIdType count, const Convert& convert) const
  {
    Real* out = this->results.out + first;
    int bad = 0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      const Real n = convert(values[i]);
      out[i] = n;
      bad |= std::abs(n) <= std::numeric_limits<Real>::max() ? 0 : 1;
    }
    return bad == 0;
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
  if (!results.isValidSet)
  {
    std::fill_n(results.valid, values[0]->GetNumberOfTuples(), static_cast<unsigned char>(1));
  }
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

/// A mask that holds anything.
vtkSmartPointer<vtkUnsignedCharArray> newUnsetMask(vtkIdType count)
{
  auto mask = vtkSmartPointer<vtkUnsignedCharArray>::New();
  mask->SetName(maskName);
  setTuples(mask, count);
  return mask;
}

template <class Array>
vtkSmartPointer<Array> convertWith(const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, bool isValidSet, double invalid, Tally& tally)
{
  using Real = typename Array::ValueType;
  auto refractivity = vtkSmartPointer<Array>::New();
  refractivity->SetName(arrayName);
  setTuples(refractivity, values[0]->GetNumberOfTuples());
  const Results<Real> results{ refractivity->GetPointer(0), valid->GetPointer(0), isValidSet,
    static_cast<Real>(invalid) };
  std::visit([&](const auto& chosen) { convertBy(chosen, values, results, tally); }, model);
  return refractivity;
}

} // namespace

vtkSmartPointer<vtkUnsignedCharArray> newMask(vtkIdType count)
{
  auto mask = newUnsetMask(count);
  vtkSMPTools::Fill(
    mask->GetPointer(0), mask->GetPointer(0) + count, static_cast<unsigned char>(1));
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
  return convertWith<Array>(values, model, valid, true, invalid, tally);
}

template vtkSmartPointer<vtkFloatArray> convert(
  const Arrays&, const Model&, vtkUnsignedCharArray*, double, Tally&);
template vtkSmartPointer<vtkDoubleArray> convert(
  const Arrays&, const Model&, vtkUnsignedCharArray*, double, Tally&);

Tally setArrays(vtkImageData* output, const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, bool doublePrecision)
{
  Tally tally;
  const bool isValidSet = valid != nullptr;
  vtkSmartPointer<vtkUnsignedCharArray> mask = valid;
  if (!isValidSet)
  {
    mask = newUnsetMask(values[0]->GetNumberOfTuples());
  }
  vtkSmartPointer<vtkDataArray> refractivity;
  if (doublePrecision)
  {
    refractivity = convertWith<vtkDoubleArray>(values, model, mask, isValidSet, 0, tally);
  }
  else
  {
    refractivity = convertWith<vtkFloatArray>(values, model, mask, isValidSet, 0, tally);
  }
  output->GetPointData()->SetScalars(refractivity);
  output->GetPointData()->AddArray(mask);
  return tally;
}

} // namespace filters
