// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/ComparisonViews.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filters
{

vtkSmartPointer<vtkUnsignedCharArray> comparisonOf(
  const Plane& photograph, const Plane& simulated, View view, double swipe)
{
  constexpr int fieldsOfBoard = 8; // along the longer side
  const int field = std::max(1, std::max(simulated.columns, simulated.rows) / fieldsOfBoard);
  const auto colorOf = [&](int column, int row) -> std::array<float, 3>
  {
    const float seen = photograph(column, row), made = simulated(column, row);
    const auto grey = [](float value) { return std::array<float, 3>{ value, value, value }; };
    if (!std::isfinite(seen))
    {
      return grey(view == View::Photograph || view == View::Difference ? 0.5f : made);
    }
    switch (view)
    {
      case View::Photograph:
        return grey(seen);
      case View::Over:
        return grey(0.5f * (seen + made));
      case View::Swipe:
        return grey(column + 0.5 < swipe * simulated.columns ? seen : made);
      case View::Chequerboard:
        return grey((column / field + row / field) % 2 == 0 ? seen : made);
      case View::RedCyan:
        return { seen, made, made };
      case View::Difference:
        return grey(0.5f + 0.5f * (seen - made));
      default:
        return grey(made);
    }
  };
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName("Comparison");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(simulated.size()));
  unsigned char* bytes = array->GetPointer(0);
  for (int row = 0; row < simulated.rows; ++row)
  {
    for (int column = 0; column < simulated.columns; ++column)
    {
      for (const float value : colorOf(column, row))
      {
        *bytes++ = static_cast<unsigned char>(std::clamp(value, 0.f, 1.f) * 255.f + 0.5f);
      }
    }
  }
  return array;
}

} // namespace filters
