// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/TransferFunctions.h"

#include "Common/Leaf.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace filters
{

namespace
{

constexpr int intervals = 1 << 14;

/// Marks the values that count: of visible cells, or of visible points that a visible cell has (the
/// values of others are undefined). Null where all count.
vtkSmartPointer<vtkUnsignedCharArray> usedValues(const Leaf& leaf)
{
  vtkDataSet* data = leaf.data;
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  if (!ghosts &&
    (leaf.ofCells || (!data->GetPointGhostArray() && !data->GetPointData()->HasArray(maskName))))
  {
    return nullptr;
  }
  auto used = newMask(leaf.ofCells ? data->GetNumberOfCells() : data->GetNumberOfPoints());
  const auto isHidden = [ghosts](vtkIdType cell)
  { return (ghosts->GetValue(cell) & hiddenCellBits) != 0; };
  if (leaf.ofCells)
  {
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      used->SetValue(cell, isHidden(cell) ? 0 : 1);
    }
    return used;
  }
  if (ghosts)
  {
    used->FillValue(0);
    vtkNew<vtkIdList> points;
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      if (!isHidden(cell))
      {
        data->GetCellPoints(cell, points);
        std::for_each(
          points->begin(), points->end(), [&used](vtkIdType point) { used->SetValue(point, 1); });
      }
    }
  }
  hidePoints(data, used);
  return used;
}

/// Returns the range of finite values that `used`, if given, marks; low > high without any.
std::array<double, 2> rangeOf(vtkDataArray* array, vtkUnsignedCharArray* used)
{
  std::array<double, 2> range{ HUGE_VAL, -HUGE_VAL };
  if (!used)
  {
    array->GetFiniteRange(range.data(), 0);
    return range;
  }
  for (vtkIdType i = 0; i < used->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, 0);
    if (used->GetValue(i) && std::isfinite(value))
    {
      range = { std::min(range[0], value), std::max(range[1], value) };
    }
  }
  return range;
}

} // namespace

FieldCurve::FieldCurve(const TransferCurve& curve, double low, double high)
  : Low(low)
  , High(high)
{
  if (!curve.nodes.empty())
  {
    vtkNew<vtkPiecewiseFunction> function;
    function->SetClamping(curve.isClamped);
    function->SetUseLogScale(curve.isLogarithmic);
    function->AllowDuplicateScalarsOn();
    for (const std::array<double, 4>& node : curve.nodes)
    {
      function->AddPoint(node[0], node[1], node[2], node[3]);
    }
    this->Table.resize(intervals + 1);
    function->GetTable(0, 1, intervals + 1, this->Table.data());
    if (!std::all_of(
          this->Table.begin(), this->Table.end(), [](double y) { return std::isfinite(y); }))
    {
      throw std::runtime_error(
        "One of the TransferFunctions has values that are not finite between 0 and 1. Correct its "
        "points, and do not use a logarithmic scale that begins at 0.");
    }
  }
}

void FieldCurve::setRange(double low, double high)
{
  this->Low = low;
  this->High = high;
}

double FieldCurve::at(double x) const
{
  // Halves the bounds, because their difference may overflow.
  const double length = 0.5 * this->High - 0.5 * this->Low;
  const double t = length == 0 ? 0 : std::clamp((0.5 * x - 0.5 * this->Low) / length, 0., 1.);
  if (this->Table.empty())
  {
    return t;
  }
  const auto i = std::min(static_cast<std::size_t>(t * intervals), std::size_t{ intervals - 1 });
  const double f = t * intervals - static_cast<double>(i);
  return (1 - f) * this->Table[i] + f * this->Table[i + 1];
}

double FieldMean::refractivity(const double* values) const
{
  double sum = 0;
  for (std::size_t i = 0; i < this->curves.size(); ++i)
  {
    sum += this->curves[i].at(values[i]);
  }
  return this->scale * sum / static_cast<double>(this->curves.size());
}

std::vector<FieldMean::Range> FieldMean::rangesIn(const std::vector<Leaf>& leaves) const
{
  const bool isComplete = std::all_of(this->curves.begin(), this->curves.end(),
    [](const FieldCurve& curve) { return curve.hasRange(); });
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Range> ranges(this->curves.size(), { infinity, -infinity });
  for (const Leaf& leaf : isComplete ? std::vector<Leaf>() : leaves)
  {
    const auto used = usedValues(leaf);
    for (std::size_t k = 0; k < ranges.size(); ++k)
    {
      if (!this->curves[k].hasRange())
      {
        const std::array<double, 2> range = rangeOf(leaf.arrays[k], used);
        ranges[k] = { std::min(ranges[k][0], range[0]), std::max(ranges[k][1], range[1]) };
      }
    }
  }
  return ranges;
}

void FieldMean::setRanges(const std::vector<Range>& ranges)
{
  for (std::size_t k = 0; k < std::min(ranges.size(), this->curves.size()); ++k)
  {
    if (!this->curves[k].hasRange() && ranges[k][0] <= ranges[k][1])
    {
      this->curves[k].setRange(ranges[k][0], ranges[k][1]);
    }
  }
}

} // namespace filters
