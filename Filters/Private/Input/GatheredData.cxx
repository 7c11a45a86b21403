// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/GatheredData.h"

#include "Input/DatasetPieces.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStaticCleanUnstructuredGrid.h"
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

std::string namesOf(vtkDataSetAttributes* attributes)
{
  std::string names;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    const char* name = attributes->GetAbstractArray(i)->GetName();
    names += std::string(names.empty() ? "'" : ", '") + (name ? name : "") + "'";
  }
  return names.empty() ? "none" : names;
}

bool haveSameArrays(vtkDataSetAttributes* a, vtkDataSetAttributes* b)
{
  bool areSame = a->GetNumberOfArrays() == b->GetNumberOfArrays() && namesOf(a) == namesOf(b);
  for (int i = 0; areSame && i < a->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray *one = a->GetAbstractArray(i), *other = b->GetAbstractArray(i);
    areSame = one->GetDataType() == other->GetDataType() &&
      one->GetNumberOfComponents() == other->GetNumberOfComponents();
  }
  return areSame;
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

/// Copies the arrays of several extents to the whole image.
void copyAttributes(const std::vector<vtkDataSet*>& pieces, bool ofCells, vtkDataSet* whole)
{
  const int kind = ofCells ? vtkDataObject::CELL : vtkDataObject::POINT;
  const std::array<int, 6> extent = extentOf(whole, ofCells);
  vtkDataSetAttributes* to = whole->GetAttributes(kind);
  to->CopyAllOn();
  to->CopyAllocate(pieces[0]->GetAttributes(kind), sizeOf(extent));
  for (vtkDataSet* piece : pieces)
  {
    to->CopyStructuredData(
      piece->GetAttributes(kind), extentOf(piece, ofCells).data(), extent.data());
  }
}

/// Returns whether the images contain all points of an extent.
bool isCovered(const std::vector<vtkDataSet*>& pieces, const std::array<int, 6>& extent)
{
  std::vector<bool> isThere(static_cast<std::size_t>(sizeOf(extent)));
  for (vtkDataSet* piece : pieces)
  {
    const std::array<int, 6> of = extentOf(piece, false);
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

/// Throws std::runtime_error if arrays of points or cells (vtkDataObject::POINT, CELL) differ,
/// because joining would lose some.
void requireSameArrays(const std::vector<vtkDataSet*>& pieces, int kind)
{
  vtkDataSetAttributes* first = pieces[0]->GetAttributes(kind);
  for (vtkDataSet* piece : pieces)
  {
    vtkDataSetAttributes* other = piece->GetAttributes(kind);
    if (!haveSameArrays(first, other))
    {
      const std::string what = kind == vtkDataObject::CELL ? "cells" : "points";
      throw std::runtime_error(
        "The pieces of the input on several ranks have not the same arrays of " + what + ": " +
        namesOf(first) + " on one of them, " + namesOf(other) +
        " on another, or their types differ. Check the reader or filter that has made them.");
    }
  }
}

/// Joins meshes, cells in their order. Merges points that are equal to the last bit.
vtkSmartPointer<vtkDataSet> joinedMesh(const std::vector<vtkDataSet*>& pieces)
{
  if (vtkPolyData::SafeDownCast(pieces[0]))
  {
    vtkNew<vtkAppendPolyData> append;
    for (vtkDataSet* piece : pieces)
    {
      append->AddInputData(vtkPolyData::SafeDownCast(piece));
    }
    append->Update();
    return append->GetOutput();
  }
  vtkNew<vtkAppendFilter> append;
  vtkNew<vtkStaticCleanUnstructuredGrid> merge;
  for (vtkDataSet* piece : pieces)
  {
    append->AddInputData(piece);
  }
  merge->SetInputConnection(append->GetOutputPort());
  merge->ToleranceIsAbsoluteOn();
  merge->SetAbsoluteTolerance(0);
  merge->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION);
  merge->Update();
  merge->SetMergingArray(nullptr); // its destructor leaks the empty name that it begins with
  return merge->GetOutput();
}

/// Returns whether the points of two images with the same indices coincide, to the last bit.
bool haveSamePlace(vtkImageData* a, vtkImageData* b)
{
  const double* direction = a->GetDirectionMatrix()->GetData();
  return std::equal(a->GetOrigin(), a->GetOrigin() + 3, b->GetOrigin()) &&
    std::equal(a->GetSpacing(), a->GetSpacing() + 3, b->GetSpacing()) &&
    std::equal(direction, direction + 9, b->GetDirectionMatrix()->GetData());
}

/// Joins the extents of one image; null for several.
vtkSmartPointer<vtkDataSet> joinedImage(const std::vector<vtkDataSet*>& pieces)
{
  auto* first = vtkImageData::SafeDownCast(pieces[0]);
  std::array<int, 6> extent = extentOf(first, false);
  for (vtkDataSet* piece : pieces)
  {
    const std::array<int, 6> of = extentOf(piece, false);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      extent[2 * axis] = std::min(extent[2 * axis], of[2 * axis]);
      extent[2 * axis + 1] = std::max(extent[2 * axis + 1], of[2 * axis + 1]);
    }
    if (!haveSamePlace(vtkImageData::SafeDownCast(piece), first))
    {
      return nullptr;
    }
  }
  vtkIdType points = 0;
  for (vtkDataSet* piece : pieces)
  {
    points += piece->GetNumberOfPoints();
  }
  if (sizeOf(extent) > points || !isCovered(pieces, extent))
  {
    return nullptr;
  }
  auto whole = vtkSmartPointer<vtkImageData>::New();
  whole->SetOrigin(first->GetOrigin());
  whole->SetSpacing(first->GetSpacing());
  whole->SetDirectionMatrix(first->GetDirectionMatrix());
  whole->SetExtent(extent.data());
  copyAttributes(pieces, false, whole);
  copyAttributes(pieces, true, whole);
  return whole;
}

} // namespace

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
    whole = type == VTK_IMAGE_DATA                             ? joinedImage(all)
      : type == VTK_UNSTRUCTURED_GRID || type == VTK_POLY_DATA ? joinedMesh(all)
                                                               : nullptr;
  }
  return whole ? std::vector<vtkSmartPointer<vtkDataSet>>{ whole } : pieces;
}

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
