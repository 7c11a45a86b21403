// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ArrayRanges.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationInformationVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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

template <class Array>
void tellRangesOf(Array* array)
{
  const int components = array->GetNumberOfComponents();
  const vtkIdType values = array->GetNumberOfValues();
  if (values == 0)
  {
    return;
  }
  std::vector<Range> ranges(static_cast<std::size_t>(components));
  Range norm; // its square
  const auto* value = array->GetPointer(0);
  for (const auto* end = value + values; value != end; value += components)
  {
    double square = 0;
    for (int component = 0; component < components; ++component)
    {
      const double here = value[component];
      if (!std::isfinite(here))
      {
        return;
      }
      ranges[static_cast<std::size_t>(component)].add(here);
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
void tellRanges(vtkDataArray* array)
{
  if (auto* singles = vtkFloatArray::SafeDownCast(array))
  {
    tellRangesOf(singles);
  }
  else if (auto* doubles = vtkDoubleArray::SafeDownCast(array))
  {
    tellRangesOf(doubles);
  }
}
