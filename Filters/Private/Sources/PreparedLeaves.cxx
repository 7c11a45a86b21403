// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/PreparedLeaves.h"

#include "Cells/CellMeans.h"
#include "Cells/LinearCells.h"
#include "Cells/MeshArrays.h"
#include "Cells/Polyhedra.h"
#include "Common/AvailableMemory.h"
#include "Input/FlatData.h"
#include "Input/RefractivityValues.h"
#include "Sources/SharedPoints.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace filters
{

namespace
{

vtkSmartPointer<vtkDataSet> withoutArrays(vtkDataSet* data)
{
  auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  copy->CopyStructure(data);
  return copy;
}

/// Makes a leaf of N alone, at points (NaN: invalid) or in cells, with other cells hidden.
vtkSmartPointer<vtkDataSet> withValues(
  const Leaf& leaf, int dimension, const Model& model, Tally& tally)
{
  vtkDataSet* data = leaf.data;
  const vtkIdType cells = data->GetNumberOfCells();
  auto valid = newMask(cells);
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  vtkSMPTools::For(0, cells,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const bool isHidden = ghosts && (ghosts->GetValue(i) & hiddenCellBits);
        valid->SetValue(i, isHidden || dimensionOfCell(data, i) != dimension ? 0 : 1);
      }
    });

  auto prepared = withoutArrays(data);
  // Copies what shapes curved cells, until they are divided.
  prepared->GetPointData()->SetRationalWeights(data->GetPointData()->GetRationalWeights());
  prepared->GetCellData()->SetHigherOrderDegrees(data->GetCellData()->GetHigherOrderDegrees());
  if (leaf.ofCells)
  {
    const auto ofCells = convert<vtkDoubleArray>(leaf.arrays, model, valid, 0, tally);
    ofCells->SetName(arrayName);
    prepared->GetCellData()->SetScalars(ofCells);
    vtkNew<vtkDoubleArray> ofPoints; // values follow
    ofPoints->SetName(arrayName);
    setTuples(ofPoints, data->GetNumberOfPoints());
    ofPoints->Fill(0);
    prepared->GetPointData()->SetScalars(ofPoints);
  }
  else
  {
    auto validPoints = newMask(data->GetNumberOfPoints());
    hidePoints(data, validPoints);
    prepared->GetPointData()->SetScalars(convert<vtkDoubleArray>(
      leaf.arrays, model, validPoints, std::numeric_limits<double>::quiet_NaN(), tally));
  }

  vtkNew<vtkUnsignedCharArray> hidden;
  hidden->SetName(vtkDataSetAttributes::GhostArrayName());
  hidden->SetNumberOfValues(cells);
  vtkSMPTools::For(0, cells,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const int copy =
          ghosts ? ghosts->GetValue(i) & static_cast<int>(vtkDataSetAttributes::DUPLICATECELL) : 0;
        const int hides =
          valid->GetValue(i) ? 0 : static_cast<int>(vtkDataSetAttributes::HIDDENCELL);
        hidden->SetValue(i, static_cast<unsigned char>(copy | hides));
      }
    });
  prepared->GetCellData()->AddArray(hidden);
  return prepared;
}

} // namespace

std::vector<vtkDataSet*> pointersTo(const MeshLeaves& leaves)
{
  return { leaves.begin(), leaves.end() };
}

bool hasCells(vtkDataSet* data, int dimension)
{
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    if (dimensionOfCell(data, i) == dimension)
    {
      return true;
    }
  }
  return false;
}

MeshLeaves preparedLeaves(const Flow& flow, Tally& tally)
{
  const int dimension = flatAxisOf(flow) < 0 ? 3 : 2;
  MeshLeaves leaves;
  for (const Leaf& leaf : flow.leaves)
  {
    if (hasCells(leaf.data, dimension))
    {
      leaves.push_back(asLinearCells(withValues(leaf, dimension, flow.model, tally)));
    }
  }
  leaves = withSharedPoints(leaves);
  for (vtkSmartPointer<vtkDataSet>& leaf : leaves)
  {
    if (leaf->GetCellData()->GetScalars())
    {
      bringToPoints(leaf, true);
    }
    leaf = withoutPolyhedra(leaf);
  }
  return leaves;
}

} // namespace filters
