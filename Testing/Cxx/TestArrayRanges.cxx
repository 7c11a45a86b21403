// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Ranges that are set in advance are those that VTK finds.
#include "ArrayRanges.h"
#include "Fixtures.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <limits>

using namespace filters;

namespace
{

template <class Array>
void fill(Array* array, int components, double extra)
{
  array->SetNumberOfComponents(components);
  for (int tuple = 0; tuple < 50; ++tuple)
  {
    for (int component = 0; component < components; ++component)
    {
      array->InsertNextValue(static_cast<typename Array::ValueType>(
        20 + 5 * std::sin(1.7 * tuple + component) * (component + 1)));
    }
  }
  array->SetComponent(7, components - 1, extra);
}

template <class Array>
void expectTheSame(int components, double extra)
{
  vtkNew<Array> given, found;
  fill(given.Get(), components, extra);
  fill(found.Get(), components, extra);
  setRanges(given);
  for (int component = -1; component < components; ++component)
  {
    double by[2], of[2];
    given->GetRange(by, component);
    found->GetRange(of, component);
    EXPECT_DOUBLE_EQ(by[0], of[0]) << component;
    EXPECT_DOUBLE_EQ(by[1], of[1]) << component;
    given->GetFiniteRange(by, component);
    found->GetFiniteRange(of, component);
    EXPECT_DOUBLE_EQ(by[0], of[0]) << component;
    EXPECT_DOUBLE_EQ(by[1], of[1]) << component;
  }
}

} // namespace

TEST(ArrayRanges, AreThoseThatVtkFinds)
{
  for (const double extra : { 9., -9., std::nan(""), std::numeric_limits<double>::infinity() })
  {
    for (const int components : { 1, 2, 3 })
    {
      expectTheSame<vtkFloatArray>(components, extra);
      expectTheSame<vtkDoubleArray>(components, extra);
      if (std::isfinite(extra))
      {
        expectTheSame<vtkTypeInt64Array>(components, extra);
        expectTheSame<vtkUnsignedCharArray>(components, std::abs(extra));
      }
    }
  }
}

TEST(ArrayRanges, AreUsedAndGoWithTheValues)
{
  vtkNew<vtkFloatArray> array;
  fill(array.Get(), 2, 0.25);
  setRanges(array);
  // Behind its back, without Modified(): what was set counts.
  array->GetPointer(0)[0] = 77;
  EXPECT_LT(array->GetRange(0)[1], 26);
  EXPECT_LT(array->GetRange(-1)[1], 40);
  array->Modified();
  EXPECT_EQ(array->GetRange(0)[1], 77);
  EXPECT_GT(array->GetRange(-1)[1], 76);
}

TEST(ArrayRanges, AreLeftToVtkOtherwise)
{
  vtkNew<vtkFloatArray> empty;
  setRanges(empty);
  vtkNew<vtkSOADataArrayTemplate<float>> apart;
  apart->InsertNextValue(3);
  setRanges(apart);
  EXPECT_EQ(apart->GetRange(0)[1], 3);
}
