// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/GatheredData.h"

#include "Input/DatasetPieces.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStructuredData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

vtkUnsignedCharArray* ghostsOf(vtkDataSetAttributes* attributes)
{
  return vtkUnsignedCharArray::SafeDownCast(
    attributes->GetArray(vtkDataSetAttributes::GhostArrayName()));
}

/// Clears the flag of copies in all ghost arrays, and keeps that of hidden points and cells. Adds
/// the array to datasets that lack it if others have it.
void forgetCopies(const std::vector<vtkDataSet*>& pieces, int kind)
{
  const int copy = kind == vtkDataObject::CELL
    ? static_cast<int>(vtkDataSetAttributes::DUPLICATECELL)
    : static_cast<int>(vtkDataSetAttributes::DUPLICATEPOINT);
  const bool isNeeded = std::any_of(pieces.begin(), pieces.end(),
    [kind](vtkDataSet* piece) { return ghostsOf(piece->GetAttributes(kind)) != nullptr; });
  for (vtkDataSet* piece : pieces)
  {
    vtkDataSetAttributes* attributes = piece->GetAttributes(kind);
    vtkUnsignedCharArray* ghosts = ghostsOf(attributes);
    vtkNew<vtkUnsignedCharArray> others; // the array may belong to the input
    others->SetName(vtkDataSetAttributes::GhostArrayName());
    others->SetNumberOfValues(piece->GetNumberOfElements(kind));
    for (vtkIdType i = 0; i < others->GetNumberOfValues(); ++i)
    {
      const int flags = ghosts ? ghosts->GetValue(i) & ~copy : 0;
      others->SetValue(i, static_cast<unsigned char>(flags));
    }
    attributes->RemoveArray(vtkDataSetAttributes::GhostArrayName());
    if (isNeeded)
    {
      attributes->AddArray(others);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkDataSet>> joined(
  const std::vector<vtkSmartPointer<vtkDataSet>>& pieces)
{
  const std::vector<vtkDataSet*> all(pieces.begin(), pieces.end());
  const int type = all[0]->GetDataObjectType();
  const bool areOfOneType = std::all_of(all.begin(), all.end(),
    [type](vtkDataSet* piece) { return piece->GetDataObjectType() == type; });
  vtkSmartPointer<vtkDataSet> whole;
  if (all.size() > 1 && areOfOneType)
  {
    for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      forgetCopies(all, kind);
      requireSameArrays(all, kind);
    }
    whole = isGrid(all[0])                                     ? joinedGrid(all)
      : type == VTK_UNSTRUCTURED_GRID || type == VTK_POLY_DATA ? joinedMesh(all)
                                                               : nullptr;
  }
  return whole ? std::vector<vtkSmartPointer<vtkDataSet>>{ whole } : pieces;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> gatheredData(const std::vector<std::vector<char>>& ofRanks)
{
  std::map<Slot, std::vector<vtkSmartPointer<vtkDataSet>>> slots;
  for (const std::vector<char>& bytes : ofRanks)
  {
    Reader reader(bytes);
    while (!reader.IsAtEnd())
    {
      DatasetPiece piece = unpack(reader);
      slots[std::move(piece.slot)].push_back(std::move(piece.data));
    }
  }
  std::vector<vtkSmartPointer<vtkDataSet>> blocks;
  for (const auto& slot : slots)
  {
    const std::vector<vtkSmartPointer<vtkDataSet>> all = joined(slot.second);
    blocks.insert(blocks.end(), all.begin(), all.end());
  }
  if (blocks.size() < 2)
  {
    return blocks.empty() ? nullptr : vtkSmartPointer<vtkDataObject>(blocks[0]);
  }
  auto composite = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t n = 0; n < blocks.size(); ++n)
  {
    composite->SetBlock(static_cast<unsigned int>(n), blocks[n]);
  }
  return composite;
}

} // namespace filters
