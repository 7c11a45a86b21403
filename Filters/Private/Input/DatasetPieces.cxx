// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/DatasetPieces.h"

#include "Input/RefractivitySource.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtractCells.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStaticCleanUnstructuredGrid.h"
#include "vtkStructuredData.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace filters
{

namespace
{

void addPieces(vtkDataObject* data, const Slot& slot, std::vector<DatasetPiece>& pieces)
{
  const auto below = [&slot](int child)
  {
    Slot of = slot;
    of.push_back(child);
    return of;
  };
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    const bool areParts = vtkPartitionedDataSet::SafeDownCast(data) != nullptr;
    auto iterator = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
    iterator->VisitOnlyLeavesOff();
    iterator->TraverseSubTreeOff();
    iterator->SkipEmptyNodesOff();
    int child = 0;
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      addPieces(iterator->GetCurrentDataObject(), areParts ? slot : below(child), pieces);
      ++child;
    }
  }
  else if (auto* amr = vtkUniformGridAMR::SafeDownCast(data))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(amr->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      addPieces(iterator->GetCurrentDataObject(),
        below(static_cast<int>(iterator->GetCurrentFlatIndex())), pieces);
    }
  }
  else if (auto* leaf = vtkDataSet::SafeDownCast(data))
  {
    if (leaf->GetNumberOfPoints() > 0)
    {
      pieces.push_back({ slot, leaf });
    }
  }
}

/// Copies the arrays that are needed, ordered by name, so that all ranks have the same order.
void keepArrays(
  vtkDataSetAttributes* from, const std::vector<std::string>& names, vtkDataSetAttributes* to)
{
  std::map<std::string, vtkDataArray*> kept;
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = from->GetArray(i);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    const bool isKnown = name == vtkDataSetAttributes::GhostArrayName() || name == arrayName ||
      name == maskName || name == transparentName;
    if (array && (isKnown || std::find(names.begin(), names.end(), name) != names.end()))
    {
      kept[name] = array;
    }
  }
  to->Initialize();
  for (const auto& array : kept)
  {
    to->AddArray(array.second);
  }
  if (vtkDataArray* scalars = from->GetScalars())
  {
    to->SetScalars(scalars); // selections without a name refer to them
  }
}

/// Removes copies of other ranks' cells, and keeps hidden ones, unlike RemoveGhostCells().
vtkSmartPointer<vtkDataSet> withoutCopies(vtkUnstructuredGrid* mesh)
{
  vtkUnsignedCharArray* ghosts = mesh->GetCellGhostArray();
  vtkNew<vtkIdList> own;
  for (vtkIdType cell = 0; ghosts && cell < mesh->GetNumberOfCells(); ++cell)
  {
    if (!(ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL))
    {
      own->InsertNextId(cell);
    }
  }
  if (!ghosts || own->GetNumberOfIds() == mesh->GetNumberOfCells())
  {
    return mesh;
  }
  return extractedCells(mesh, own);
}

/// Copies the needed arrays and the cells that are not copies of other ranks'.
vtkSmartPointer<vtkDataSet> sparseCopy(vtkDataSet* data, const std::vector<std::string>& names)
{
  vtkSmartPointer<vtkDataSet> copy;
  if (vtkImageData::SafeDownCast(data))
  {
    copy = vtkSmartPointer<vtkImageData>::New(); // replaces vtkUniformGrid, which VTK cannot send
  }
  else
  {
    copy.TakeReference(data->NewInstance());
  }
  copy->ShallowCopy(data);
  copy->GetFieldData()->Initialize();
  keepArrays(data->GetPointData(), names, copy->GetPointData());
  keepArrays(data->GetCellData(), names, copy->GetCellData());
  if (auto* mesh = vtkUnstructuredGrid::SafeDownCast(copy))
  {
    return withoutCopies(mesh);
  }
  if (auto* surface = vtkPolyData::SafeDownCast(copy))
  {
    surface->RemoveGhostCells();
  }
  return copy;
}

/// An image's geometry, because VTK's format omits the direction and rounds the rest.
struct Place
{
  std::array<double, 9> direction{};
  std::array<double, 3> origin{}, spacing{};
};

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

/// Copies the arrays of several extents to the whole grid.
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

/// Joins the coordinates of rectilinear grids along an axis.
vtkSmartPointer<vtkDataArray> joinedCoordinates(
  const std::vector<vtkDataSet*>& pieces, std::size_t axis, const std::array<int, 6>& extent)
{
  vtkSmartPointer<vtkDataArray> joined;
  for (vtkDataSet* piece : pieces)
  {
    auto* grid = vtkRectilinearGrid::SafeDownCast(piece);
    vtkDataArray* of = axis == 0 ? grid->GetXCoordinates()
      : axis == 1                ? grid->GetYCoordinates()
                                 : grid->GetZCoordinates();
    if (!joined)
    {
      joined.TakeReference(of->NewInstance());
      joined->SetNumberOfTuples(extent[2 * axis + 1] - extent[2 * axis] + 1);
    }
    joined->InsertTuples(
      extentOf(piece, false)[2 * axis] - extent[2 * axis], of->GetNumberOfTuples(), 0, of);
  }
  return joined;
}

/// Joins the points of curvilinear grids.
vtkSmartPointer<vtkPoints> joinedPoints(
  const std::vector<vtkDataSet*>& pieces, const std::array<int, 6>& extent)
{
  auto joined = vtkSmartPointer<vtkPoints>::New();
  joined->SetDataType(vtkStructuredGrid::SafeDownCast(pieces[0])->GetPoints()->GetDataType());
  joined->SetNumberOfPoints(sizeOf(extent));
  for (vtkDataSet* piece : pieces)
  {
    const std::array<int, 6> of = extentOf(piece, false);
    vtkDataArray* from = vtkStructuredGrid::SafeDownCast(piece)->GetPoints()->GetData();
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

/// Returns whether the grids contain all points of an extent.
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

/// Returns whether a grid's points lie where the same indices of the whole do. Readers may number
/// the grids of each rank from 0.
bool liesIn(vtkDataSet* piece, vtkDataSet* whole)
{
  const std::array<int, 6> of = extentOf(piece, false), all = extentOf(whole, false);
  vtkIdType next = 0;
  for (int k = of[4]; k <= of[5]; ++k)
  {
    for (int j = of[2]; j <= of[3]; ++j)
    {
      for (int i = of[0]; i <= of[1]; ++i)
      {
        const int index[3] = { i, j, k };
        double own[3], ofWhole[3];
        piece->GetPoint(next++, own);
        whole->GetPoint(vtkStructuredData::ComputePointIdForExtent(all.data(), index), ofWhole);
        if (!std::equal(own, own + 3, ofWhole))
        {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace

bool isGrid(vtkDataSet* data)
{
  return vtkImageData::SafeDownCast(data) || vtkRectilinearGrid::SafeDownCast(data) ||
    vtkStructuredGrid::SafeDownCast(data);
}

std::array<int, 6> extentOf(vtkDataSet* data, bool ofCells)
{
  std::array<int, 6> extent{ 0, -1, 0, -1, 0, -1 };
  if (isGrid(data))
  {
    std::copy_n(data->GetInformation()->Get(vtkDataObject::DATA_EXTENT()), 6, extent.begin());
  }
  for (std::size_t axis = 0; ofCells && axis < 3; ++axis)
  {
    // An axis with one point has one cell.
    extent[2 * axis + 1] = std::max(extent[2 * axis], extent[2 * axis + 1] - 1);
  }
  return extent;
}

std::vector<DatasetPiece> piecesOf(vtkDataObject* data, const std::vector<std::string>& arrays)
{
  std::vector<DatasetPiece> pieces;
  addPieces(data, {}, pieces);
  for (DatasetPiece& piece : pieces)
  {
    piece.data = sparseCopy(piece.data, arrays);
  }
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                 [](const DatasetPiece& piece) { return piece.data->GetNumberOfPoints() == 0; }),
    pieces.end());
  return pieces;
}

vtkSmartPointer<vtkUnstructuredGrid> extractedCells(vtkUnstructuredGrid* mesh, vtkIdList* cells)
{
  vtkNew<vtkExtractCells> extract;
  extract->SetInputData(mesh);
  extract->SetCellList(cells);
  extract->Update();
  vtkUnstructuredGrid* extracted = extract->GetOutput();
  extracted->GetCellData()->RemoveArray("vtkOriginalCellIds");
  extracted->GetPointData()->RemoveArray("vtkOriginalPointIds");
  return extracted;
}

void pack(const DatasetPiece& piece, std::vector<char>& bytes)
{
  vtkNew<vtkCharArray> buffer;
  if (!vtkCommunicator::MarshalDataObject(piece.data, buffer))
  {
    throw std::runtime_error(std::string("Data of the type ") + piece.data->GetClassName() +
      " are spread over several ranks and cannot be sent from rank to rank. Use one process, or "
      "take the data from before the filter that has spread them.");
  }
  const auto length = static_cast<std::int64_t>(piece.slot.size());
  put(&length, 1, bytes);
  put(piece.slot.data(), piece.slot.size(), bytes);
  Place place;
  if (auto* image = vtkImageData::SafeDownCast(piece.data))
  {
    std::copy_n(image->GetDirectionMatrix()->GetData(), 9, place.direction.begin());
    image->GetOrigin(place.origin.data());
    image->GetSpacing(place.spacing.data());
  }
  put(&place, 1, bytes);
  const std::int64_t size = buffer->GetNumberOfValues();
  put(&size, 1, bytes);
  put(buffer->GetPointer(0), static_cast<std::size_t>(size), bytes);
}

DatasetPiece unpack(Reader& reader)
{
  DatasetPiece piece;
  std::int64_t length = 0;
  reader.Get(&length, 1);
  piece.slot.resize(static_cast<std::size_t>(length));
  reader.Get(piece.slot.data(), piece.slot.size());
  Place place;
  reader.Get(&place, 1);
  std::int64_t size = 0;
  reader.Get(&size, 1);
  vtkNew<vtkCharArray> buffer;
  buffer->SetNumberOfValues(size);
  reader.Get(buffer->GetPointer(0), static_cast<std::size_t>(size));
  piece.data = vtkDataSet::SafeDownCast(
    vtkCommunicator::UnMarshalDataObject(buffer.GetPointer()).GetPointer());
  if (!piece.data)
  {
    throw std::runtime_error("VTK cannot read what another rank has sent of its data.");
  }
  if (vtkImageData::SafeDownCast(piece.data))
  {
    vtkNew<vtkImageData> image; // VTK returns vtkStructuredPoints
    image->ShallowCopy(piece.data);
    image->SetDirectionMatrix(place.direction.data());
    image->SetOrigin(place.origin.data());
    image->SetSpacing(place.spacing.data());
    piece.data = image;
  }
  return piece;
}

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

vtkSmartPointer<vtkDataSet> joinedMesh(
  const std::vector<vtkDataSet*>& pieces, const char* alsoTheSame)
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
  merge->SetMergingArray(alsoTheSame);
  merge->Update();
  merge->SetMergingArray(nullptr); // its destructor leaks the name
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

vtkSmartPointer<vtkDataSet> joinedGrid(const std::vector<vtkDataSet*>& pieces)
{
  std::array<int, 6> extent = extentOf(pieces[0], false);
  for (vtkDataSet* piece : pieces)
  {
    const std::array<int, 6> of = extentOf(piece, false);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      extent[2 * axis] = std::min(extent[2 * axis], of[2 * axis]);
      extent[2 * axis + 1] = std::max(extent[2 * axis + 1], of[2 * axis + 1]);
    }
    auto* image = vtkImageData::SafeDownCast(piece);
    if (image && !haveSamePlace(image, vtkImageData::SafeDownCast(pieces[0])))
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
  vtkSmartPointer<vtkDataSet> whole;
  whole.TakeReference(pieces[0]->NewInstance());
  if (auto* image = vtkImageData::SafeDownCast(whole))
  {
    auto* first = vtkImageData::SafeDownCast(pieces[0]);
    image->SetOrigin(first->GetOrigin());
    image->SetSpacing(first->GetSpacing());
    image->SetDirectionMatrix(first->GetDirectionMatrix());
    image->SetExtent(extent.data());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(whole))
  {
    rectilinear->SetExtent(extent.data());
    rectilinear->SetXCoordinates(joinedCoordinates(pieces, 0, extent));
    rectilinear->SetYCoordinates(joinedCoordinates(pieces, 1, extent));
    rectilinear->SetZCoordinates(joinedCoordinates(pieces, 2, extent));
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(whole))
  {
    structured->SetExtent(extent.data());
    structured->SetPoints(joinedPoints(pieces, extent));
  }
  if (!vtkImageData::SafeDownCast(whole) &&
    !std::all_of(
      pieces.begin(), pieces.end(), [&](vtkDataSet* piece) { return liesIn(piece, whole); }))
  {
    return nullptr;
  }
  copyAttributes(pieces, false, whole);
  copyAttributes(pieces, true, whole);
  return whole;
}

} // namespace filters
