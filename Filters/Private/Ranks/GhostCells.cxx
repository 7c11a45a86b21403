// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/GhostCells.h"

#include "Cells/MeshKey.h"
#include "Input/DatasetPieces.h"

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGhostCellsGenerator.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace filters
{

namespace
{

constexpr const char* idsName = "SchlierenPoints";
constexpr const char* hiddenName = "SchlierenHidden";

vtkSmartPointer<vtkDataSet> emptyOf(int type)
{
  switch (type)
  {
    case VTK_IMAGE_DATA:
      return vtkSmartPointer<vtkImageData>::New();
    case VTK_RECTILINEAR_GRID:
      return vtkSmartPointer<vtkRectilinearGrid>::New();
    case VTK_STRUCTURED_GRID:
      return vtkSmartPointer<vtkStructuredGrid>::New();
    default:
      return vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
}

/// Makes point numbers that are equal on all ranks, from positions and from the count of earlier
/// points at the same one. VTK 9.2 would compare rounded positions.
vtkSmartPointer<vtkIdTypeArray> globalIdsOf(vtkDataSet* mesh)
{
  const vtkIdType count = mesh->GetNumberOfPoints();
  std::vector<std::pair<std::uint64_t, vtkIdType>> places;
  places.reserve(static_cast<std::size_t>(count));
  for (vtkIdType id = 0; id < count; ++id)
  {
    double at[3];
    mesh->GetPoint(id, at);
    for (double& x : at)
    {
      x += 0.; // makes -0 equal 0
    }
    Hash hash;
    hash.add(at, 3);
    places.emplace_back(hash.value(), id);
  }
  std::sort(places.begin(), places.end());
  auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->SetName(idsName);
  ids->SetNumberOfValues(count);
  std::uint64_t before = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    before = n > 0 && places[n].first == places[n - 1].first ? before + 1 : 0;
    Hash hash;
    hash.add(places[n].first);
    hash.add(before);
    ids->SetValue(places[n].second, static_cast<vtkIdType>(hash.value() >> 1));
  }
  return ids;
}

/// Copies the hidden flags of a ghost array to an array that VTK passes on like any other.
void setAsideHidden(vtkDataSet* mesh, int kind)
{
  vtkUnsignedCharArray* ghosts = mesh->GetGhostArray(kind);
  vtkNew<vtkUnsignedCharArray> hidden;
  hidden->SetName(hiddenName);
  hidden->SetNumberOfValues(mesh->GetNumberOfElements(kind));
  for (vtkIdType i = 0; i < hidden->GetNumberOfValues(); ++i)
  {
    hidden->SetValue(i, ghosts ? static_cast<unsigned char>(ghosts->GetValue(i) & ~1) : 0);
  }
  mesh->GetAttributes(kind)->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  mesh->GetAttributes(kind)->AddArray(hidden);
}

/// Restores the flags of copies and of hidden cells and points.
void restoreHidden(vtkDataSet* mesh, int kind)
{
  vtkDataSetAttributes* attributes = mesh->GetAttributes(kind);
  vtkUnsignedCharArray* ghosts = mesh->GetGhostArray(kind);
  auto* hidden = vtkUnsignedCharArray::SafeDownCast(attributes->GetArray(hiddenName));
  const int kept = kind == vtkDataObject::CELL ? 0xff : 0xfe;
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(mesh->GetNumberOfElements(kind));
  for (vtkIdType i = 0; i < flags->GetNumberOfValues(); ++i)
  {
    const int own = (ghosts ? ghosts->GetValue(i) : 0) | (hidden ? hidden->GetValue(i) : 0);
    flags->SetValue(i, static_cast<unsigned char>(own & kept));
  }
  attributes->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  attributes->RemoveArray(hiddenName);
  attributes->AddArray(flags);
}

void crop(vtkDataSet* grid, const PointExtent& extent)
{
  if (auto* image = vtkImageData::SafeDownCast(grid))
  {
    image->Crop(extent.data());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    rectilinear->Crop(extent.data());
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    structured->Crop(extent.data());
  }
}

} // namespace

PointExtent withoutOverlap(const std::vector<PointExtent>& extents, std::size_t n)
{
  PointExtent own = extents[n];
  for (std::size_t before = 0; before < n; ++before)
  {
    const PointExtent& other = extents[before];
    bool overlap = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      overlap = overlap &&
        (own[2 * axis] == own[2 * axis + 1] ||
          std::max(own[2 * axis], other[2 * axis]) <
            std::min(own[2 * axis + 1], other[2 * axis + 1]));
    }
    for (std::size_t axis = 0; overlap && axis < 3; ++axis)
    {
      int& low = own[2 * axis];
      int& high = own[2 * axis + 1];
      if (other[2 * axis] < low && other[2 * axis + 1] < high)
      {
        low = other[2 * axis + 1];
        overlap = false;
      }
      else if (low < other[2 * axis] && high < other[2 * axis + 1])
      {
        high = other[2 * axis];
        overlap = false;
      }
    }
  }
  return own;
}

bool canHaveGhostCells(int type)
{
  return type == VTK_IMAGE_DATA || type == VTK_RECTILINEAR_GRID || type == VTK_STRUCTURED_GRID ||
    type == VTK_UNSTRUCTURED_GRID;
}

vtkSmartPointer<vtkDataSet> withGhostCells(
  vtkDataSet* own, int type, const PointExtent& extent, int layers)
{
  const vtkSmartPointer<vtkDataSet> given = emptyOf(type);
  if (own)
  {
    given->ShallowCopy(own);
    setAsideHidden(given, vtkDataObject::POINT);
    setAsideHidden(given, vtkDataObject::CELL);
    if (isGrid(own))
    {
      crop(given, extent);
    }
    else
    {
      given->GetPointData()->SetGlobalIds(globalIdsOf(given));
    }
  }
  vtkNew<vtkGhostCellsGenerator> generator;
  generator->SetInputData(given);
  generator->BuildIfRequiredOff();
  generator->SetNumberOfGhostLayers(layers);
  generator->Update();
  if (!own)
  {
    return nullptr;
  }
  auto* made = vtkDataSet::SafeDownCast(generator->GetOutputDataObject(0));
  auto result = vtkSmartPointer<vtkDataSet>::Take(made->NewInstance());
  result->ShallowCopy(made);
  result->GetPointData()->SetGlobalIds(nullptr);
  result->GetPointData()->RemoveArray(idsName);
  restoreHidden(result, vtkDataObject::POINT);
  restoreHidden(result, vtkDataObject::CELL);
  return result;
}

} // namespace filters
