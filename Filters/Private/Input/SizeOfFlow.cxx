// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/SizeOfFlow.h"

#include "Input/FlatData.h"
#include "Input/RefractivityValues.h"

#include "vtkBoundingBox.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

/// N in the cells of a plane.
class CellsOfPlane
{
public:
  CellsOfPlane(const Flow& flow, int flat)
    : Of(flow)
    , First(flat == 0 ? 1 : 0)
    , Second(flat == 2 ? 1 : 2)
  {
    for (int i = 0; flow.image && i < 2; ++i)
    {
      this->Counts[i] = flow.image->GetDimensions()[i == 0 ? this->First : this->Second] - 1;
      this->Ids->SetNumberOfIds(4);
    }
    Tally tally;
    for (const Leaf& leaf : flow.leaves)
    {
      this->Values.push_back(convert<vtkDoubleArray>(
        leaf.arrays, flow.model, visibleOf(leaf), std::numeric_limits<double>::quiet_NaN(), tally));
    }
  }

  /// Calls visit(bounds, lowest, highest) for the cells with gas. Bounds: along the plane's axes.
  template <class Visit>
  void forAll(const Visit& visit) const
  {
    for (std::size_t leaf = 0; leaf < this->Values.size(); ++leaf)
    {
      vtkDataSet* data = this->Of.leaves[leaf].data;
      vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
      for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
      {
        const bool isHidden = ghosts && (ghosts->GetValue(cell) & hiddenCellBits) != 0;
        if (isHidden || dimensionOfCell(data, cell) != 2)
        {
          continue;
        }
        const auto [low, high] = this->rangeIn(leaf, cell);
        if (low <= high) // else there is no gas
        {
          visit(this->boundsOf(data, cell), low, high);
        }
      }
    }
  }

private:
  std::array<double, 2> rangeIn(std::size_t leaf, vtkIdType cell) const
  {
    vtkDoubleArray* values = this->Values[leaf];
    if (this->Of.leaves[leaf].ofCells)
    {
      return { values->GetValue(cell), values->GetValue(cell) };
    }
    std::array<double, 2> range{ std::numeric_limits<double>::infinity(),
      -std::numeric_limits<double>::infinity() };
    if (this->Of.image)
    {
      const vtkIdType row = cell / this->Counts[0], point = cell + row;
      for (int corner = 0; corner < 4; ++corner)
      {
        this->Ids->SetId(corner, point + corner % 2 + corner / 2 * (this->Counts[0] + 1));
      }
    }
    else
    {
      this->Of.leaves[leaf].data->GetCellPoints(cell, this->Ids);
    }
    for (const vtkIdType point : *this->Ids)
    {
      range = { std::fmin(range[0], values->GetValue(point)),
        std::fmax(range[1], values->GetValue(point)) };
    }
    return range;
  }
  std::array<double, 4> boundsOf(vtkDataSet* data, vtkIdType cell) const
  {
    if (this->Of.image) // along its own axes
    {
      const double* spacing = this->Of.image->GetSpacing();
      const double i = static_cast<double>(cell % this->Counts[0]) * spacing[this->First],
                   j = static_cast<double>(cell / this->Counts[0]) * spacing[this->Second];
      return { i, i + spacing[this->First], j, j + spacing[this->Second] };
    }
    double bounds[6];
    data->GetCellBounds(cell, bounds);
    return { bounds[2 * this->First], bounds[2 * this->First + 1], bounds[2 * this->Second],
      bounds[2 * this->Second + 1] };
  }

  const Flow& Of;
  int First, Second;
  vtkIdType Counts[2] = { 0, 0 }; // of cells, of an image
  std::vector<vtkSmartPointer<vtkDoubleArray>> Values;
  vtkNew<vtkIdList> Ids;
};

} // namespace

double sizeOfFlow(const Flow& flow, int flat)
{
  const CellsOfPlane cells(flow, flat);
  vtkIdType all = 0, number = 0;
  for (const Leaf& leaf : flow.leaves)
  {
    all += leaf.data->GetNumberOfCells();
  }
  const vtkIdType every = 1 + all / static_cast<vtkIdType>(schlieren::mostOuterValues);
  std::vector<schlieren::WeightedValue> values;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  cells.forAll(
    [&](const std::array<double, 4>& bounds, double low, double high)
    {
      const double area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2]);
      if (number++ % every == 0)
      {
        values.push_back({ 0.5 * (low + high), area });
      }
      lowest = std::min(lowest, low);
      highest = std::max(highest, high);
    });
  const double around = schlieren::weightedMedian(std::move(values));
  const double least = leastOfFlow * std::max(highest - around, around - lowest);
  vtkBoundingBox box;
  cells.forAll(
    [&](const std::array<double, 4>& bounds, double low, double high)
    {
      if (std::max(high - around, around - low) > least)
      {
        box.AddPoint(bounds[0], bounds[2], 0);
        box.AddPoint(bounds[1], bounds[3], 0);
      }
    });
  return box.IsValid() ? std::min(box.GetLength(0), box.GetLength(1)) : 0;
}

} // namespace filters
