// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "GatheredData.h"

#include "DataParts.h"
#include "ImagePlace.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

using namespace refractivity;

namespace
{

/// Of points or cells.
std::array<int, 6> extentOf(vtkDataSet* data, bool ofCells)
{
  std::array<int, 6> extent{ 0, -1, 0, -1, 0, -1 };
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    image->GetExtent(extent.data());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(data))
  {
    rectilinear->GetExtent(extent.data());
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(data))
  {
    structured->GetExtent(extent.data());
  }
  for (std::size_t axis = 0; ofCells && axis < 3; ++axis)
  {
    // Along an axis with one point there is one cell.
    extent[2 * axis + 1] = std::max(extent[2 * axis], extent[2 * axis + 1] - 1);
  }
  return extent;
}

vtkIdType sizeOf(const std::array<int, 6>& extent)
{
  vtkIdType size = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    size *= extent[2 * axis + 1] - extent[2 * axis] + 1;
  }
  return size;
}

vtkUnsignedCharArray* ghostsOf(vtkDataSetAttributes* attributes)
{
  return vtkUnsignedCharArray::SafeDownCast(
    attributes->GetArray(vtkDataSetAttributes::GhostArrayName()));
}

/// Says of no point and no cell that it is a copy of another rank's. What is hidden stays so; all parts have an array
/// that says it, or none has.
void forgetCopies(const std::vector<vtkDataSet*>& parts, int kind)
{
  const int copy = kind == vtkDataObject::CELL
    ? static_cast<int>(vtkDataSetAttributes::DUPLICATECELL)
    : static_cast<int>(vtkDataSetAttributes::DUPLICATEPOINT);
  const bool isNeeded = std::any_of(parts.begin(), parts.end(),
    [kind](vtkDataSet* part) { return ghostsOf(part->GetAttributes(kind)) != nullptr; });
  for (vtkDataSet* part : parts)
  {
    vtkDataSetAttributes* attributes = part->GetAttributes(kind);
    vtkUnsignedCharArray* ghosts = ghostsOf(attributes);
    vtkNew<vtkUnsignedCharArray> others; // it may be the input's
    others->SetName(vtkDataSetAttributes::GhostArrayName());
    others->SetNumberOfValues(part->GetNumberOfElements(kind));
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

/// The arrays of the parts in one grid.
void copyAttributes(const std::vector<vtkDataSet*>& parts, bool ofCells, vtkDataSet* whole)
{
  const int kind = ofCells ? vtkDataObject::CELL : vtkDataObject::POINT;
  const std::array<int, 6> extent = extentOf(whole, ofCells);
  vtkDataSetAttributes* to = whole->GetAttributes(kind);
  to->CopyAllOn();
  to->CopyAllocate(parts[0]->GetAttributes(kind), sizeOf(extent));
  for (vtkDataSet* part : parts)
  {
    to->CopyStructuredData(
      part->GetAttributes(kind), extentOf(part, ofCells).data(), extent.data());
  }
}

/// Along one axis of rectilinear grids.
vtkSmartPointer<vtkDataArray> joinedCoordinates(
  const std::vector<vtkDataSet*>& parts, std::size_t axis, const std::array<int, 6>& extent)
{
  vtkSmartPointer<vtkDataArray> joined;
  for (vtkDataSet* part : parts)
  {
    auto* grid = vtkRectilinearGrid::SafeDownCast(part);
    vtkDataArray* of = axis == 0 ? grid->GetXCoordinates()
      : axis == 1                ? grid->GetYCoordinates()
                                 : grid->GetZCoordinates();
    if (!joined)
    {
      joined.TakeReference(of->NewInstance());
      joined->SetNumberOfTuples(extent[2 * axis + 1] - extent[2 * axis] + 1);
    }
    joined->InsertTuples(
      extentOf(part, false)[2 * axis] - extent[2 * axis], of->GetNumberOfTuples(), 0, of);
  }
  return joined;
}

/// Points of curvilinear grids.
vtkSmartPointer<vtkPoints> joinedPoints(
  const std::vector<vtkDataSet*>& parts, const std::array<int, 6>& extent)
{
  auto joined = vtkSmartPointer<vtkPoints>::New();
  joined->SetDataType(vtkStructuredGrid::SafeDownCast(parts[0])->GetPoints()->GetDataType());
  joined->SetNumberOfPoints(sizeOf(extent));
  for (vtkDataSet* part : parts)
  {
    const std::array<int, 6> of = extentOf(part, false);
    vtkDataArray* from = vtkStructuredGrid::SafeDownCast(part)->GetPoints()->GetData();
    vtkIdType next = 0;
    for (int k = of[4]; k <= of[5]; ++k)
    {
      for (int j = of[2]; j <= of[3]; ++j)
      {
        const int row[3] = { of[0], j, k };
        const vtkIdType length = of[1] - of[0] + 1;
        joined->GetData()->InsertTuples(
          vtkStructuredData::ComputePointIdForExtent(extent.data(), row), length, next, from);
        next += length;
      }
    }
  }
  return joined;
}

/// Whether all points of an extent are in one of the parts.
bool isCovered(const std::vector<vtkDataSet*>& parts, const std::array<int, 6>& extent)
{
  std::vector<bool> isThere(static_cast<std::size_t>(sizeOf(extent)));
  for (vtkDataSet* part : parts)
  {
    const std::array<int, 6> of = extentOf(part, false);
    for (int k = of[4]; k <= of[5]; ++k)
    {
      for (int j = of[2]; j <= of[3]; ++j)
      {
        const int row[3] = { of[0], j, k };
        const auto first = isThere.begin() +
          static_cast<std::ptrdiff_t>(
            vtkStructuredData::ComputePointIdForExtent(extent.data(), row));
        std::fill(first, first + (of[1] - of[0] + 1), true);
      }
    }
  }
  return std::find(isThere.begin(), isThere.end(), false) == isThere.end();
}

/// Parts of one image or grid as one; null where they are none.
vtkSmartPointer<vtkDataSet> joinedGrid(const std::vector<vtkDataSet*>& parts)
{
  std::array<int, 6> extent = extentOf(parts[0], false);
  for (vtkDataSet* part : parts)
  {
    const std::array<int, 6> of = extentOf(part, false);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      extent[2 * axis] = std::min(extent[2 * axis], of[2 * axis]);
      extent[2 * axis + 1] = std::max(extent[2 * axis + 1], of[2 * axis + 1]);
    }
    auto* image = vtkImageData::SafeDownCast(part);
    if (image && !haveSamePlace(image, vtkImageData::SafeDownCast(parts[0])))
    {
      return nullptr;
    }
  }
  vtkIdType points = 0;
  for (vtkDataSet* part : parts)
  {
    points += part->GetNumberOfPoints();
  }
  if (sizeOf(extent) > points || !isCovered(parts, extent))
  {
    return nullptr;
  }
  vtkSmartPointer<vtkDataSet> whole;
  whole.TakeReference(parts[0]->NewInstance());
  if (auto* image = vtkImageData::SafeDownCast(whole))
  {
    auto* first = vtkImageData::SafeDownCast(parts[0]);
    image->SetOrigin(first->GetOrigin());
    image->SetSpacing(first->GetSpacing());
    image->SetDirectionMatrix(first->GetDirectionMatrix());
    image->SetExtent(extent.data());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(whole))
  {
    rectilinear->SetExtent(extent.data());
    rectilinear->SetXCoordinates(joinedCoordinates(parts, 0, extent));
    rectilinear->SetYCoordinates(joinedCoordinates(parts, 1, extent));
    rectilinear->SetZCoordinates(joinedCoordinates(parts, 2, extent));
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(whole))
  {
    structured->SetExtent(extent.data());
    structured->SetPoints(joinedPoints(parts, extent));
  }
  copyAttributes(parts, false, whole);
  copyAttributes(parts, true, whole);
  return whole;
}

bool isGrid(vtkDataSet* data)
{
  return vtkImageData::SafeDownCast(data) || vtkRectilinearGrid::SafeDownCast(data) ||
    vtkStructuredGrid::SafeDownCast(data);
}

/// The parts of one slot, as few datasets as can be.
std::vector<vtkSmartPointer<vtkDataSet>> joined(
  const std::vector<vtkSmartPointer<vtkDataSet>>& parts)
{
  const std::vector<vtkDataSet*> all(parts.begin(), parts.end());
  const int type = all[0]->GetDataObjectType();
  const bool areOfOneType = std::all_of(
    all.begin(), all.end(), [type](vtkDataSet* part) { return part->GetDataObjectType() == type; });
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
  return whole ? std::vector<vtkSmartPointer<vtkDataSet>>{ whole } : parts;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<char> packedData(vtkDataObject* data, const std::vector<std::string>& arrays)
{
  std::vector<char> bytes;
  for (const Part& part : partsOf(data, arrays))
  {
    pack(part, bytes);
  }
  return bytes;
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
      Part part = unpack(reader);
      slots[std::move(part.slot)].push_back(std::move(part.data));
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
