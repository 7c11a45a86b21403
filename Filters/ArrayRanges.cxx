// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ArrayRanges.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationInformationVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace filters
{

namespace
{

struct Range
{
  double ends[2] = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };

  void add(double value)
  {
    this->ends[0] = std::min(this->ends[0], value);
    this->ends[1] = std::max(this->ends[1], value);
  }
};

struct RangeSetter
{
  template <class Array>
  void operator()(Array* array) const;
};

template <class Array>
void RangeSetter::operator()(Array* array) const
{
  const int components = array->GetNumberOfComponents();
  if (array->GetNumberOfValues() == 0)
  {
    return;
  }
  std::vector<Range> ranges(static_cast<std::size_t>(components));
  Range norm; // its square
  const auto values = vtk::DataArrayValueRange(array);
  for (auto value = values.cbegin(); value != values.cend();)
  {
    double square = 0;
    for (Range& range : ranges)
    {
      const auto here = static_cast<double>(*value++);
      if (!std::isfinite(here))
      {
        return;
      }
      range.add(here);
      square += here * here;
    }
    norm.add(square);
  }

  vtkInformation* info = array->GetInformation();
  // All values are finite, so both kinds of ranges are the same.
  for (vtkInformationInformationVectorKey* key :
    { vtkAbstractArray::PER_COMPONENT(), vtkAbstractArray::PER_FINITE_COMPONENT() })
  {
    vtkNew<vtkInformationVector> all;
    all->SetNumberOfInformationObjects(components);
    for (int component = 0; component < components; ++component)
    {
      all->GetInformationObject(component)->Set(
        vtkDataArray::COMPONENT_RANGE(), ranges[static_cast<std::size_t>(component)].ends, 2);
    }
    info->Set(key, all);
  }
  if (components > 1)
  {
    const double ofNorm[2] = { std::sqrt(norm.ends[0]), std::sqrt(norm.ends[1]) };
    info->Set(vtkDataArray::L2_NORM_RANGE(), ofNorm, 2);
    info->Set(vtkDataArray::L2_NORM_FINITE_RANGE(), ofNorm, 2);
  }
}

} // namespace

//------------------------------------------------------------------------------
void setRanges(vtkDataArray* array) { vtkArrayDispatch::Dispatch::Execute(array, RangeSetter{}); }

} // namespace filters
