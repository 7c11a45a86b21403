// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/DatasetPieces.h"

#include "Input/Flow.h"

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
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <stdexcept>

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
  // Precedes trees, because AMR is one since VTK 9.6, whose levels would be the pieces of one dataset each.
  if (auto* amr = vtkUniformGridAMR::SafeDownCast(data))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(amr->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      addPieces(iterator->GetCurrentDataObject(),
        below(static_cast<int>(iterator->GetCurrentFlatIndex())), pieces);
    }
  }
  else if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
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

} // namespace filters
