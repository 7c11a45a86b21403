// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshHalo.h"

#include "InputDescription.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtractCells.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace refractivity
{

namespace
{

constexpr int layersOfCells = 2; // what the trend at a point may depend on

bool isMesh(vtkDataSet* data)
{
  return vtkUnstructuredGrid::SafeDownCast(data) || vtkStructuredGrid::SafeDownCast(data);
}

vtkSmartPointer<vtkUnstructuredGrid> unstructured(vtkDataSet* data)
{
  vtkNew<vtkAppendFilter> convert;
  convert->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION);
  convert->AddInputData(data);
  convert->Update();
  return convert->GetOutput();
}

/// With an array that says what hides its cells, and which are copies.
vtkSmartPointer<vtkUnstructuredGrid> withFlags(vtkDataSet* mesh, unsigned char added)
{
  auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
  copy->ShallowCopy(mesh);
  vtkUnsignedCharArray* ghosts = copy->GetCellGhostArray();
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(copy->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < copy->GetNumberOfCells(); ++cell)
  {
    const int own = ghosts
      ? ghosts->GetValue(cell) & ~static_cast<int>(vtkDataSetAttributes::DUPLICATECELL)
      : 0;
    flags->SetValue(cell, static_cast<unsigned char>(own | added));
  }
  copy->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  copy->GetCellData()->AddArray(flags);
  return copy;
}

} // namespace

bool areMeshes(vtkDataObject* data)
{
  const std::vector<vtkDataObject*> leaves = leavesOf(data);
  return std::all_of(leaves.begin(), leaves.end(),
    [](vtkDataObject* leaf)
    {
      auto* set = vtkDataSet::SafeDownCast(leaf);
      return !set || set->GetNumberOfPoints() == 0 || isMesh(set);
    });
}

std::vector<Part> meshesOf(vtkDataObject* data, const std::vector<std::string>& arrays)
{
  std::vector<Part> parts = partsOf(data, arrays);
  for (Part& part : parts)
  {
    if (!vtkUnstructuredGrid::SafeDownCast(part.data))
    {
      part.data = unstructured(part.data);
    }
  }
  return parts;
}

OuterPoints outerPointsOf(vtkUnstructuredGrid* mesh)
{
  constexpr const char* name = "PointOfMesh";
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName(name);
  numbers->SetNumberOfValues(mesh->GetNumberOfPoints());
  std::iota(numbers->GetPointer(0), numbers->GetPointer(0) + numbers->GetNumberOfValues(),
    vtkIdType{ 0 });
  vtkNew<vtkUnstructuredGrid> cells; // all of them, hidden ones too
  cells->CopyStructure(mesh);
  cells->GetPointData()->AddArray(numbers);
  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputData(cells);
  surface->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  surface->Update();
  vtkPolyData* polygons = surface->GetOutput();
  vtkDataArray* kept = polygons->GetPointData()->GetArray(name);
  OuterPoints outer;
  for (vtkIdType i = 0; kept && i < polygons->GetNumberOfPoints(); ++i)
  {
    // Points on curved faces have a mean of the numbers.
    const auto id = static_cast<vtkIdType>(
      std::clamp(kept->GetComponent(i, 0), 0., static_cast<double>(mesh->GetNumberOfPoints() - 1)));
    Point place, ofMesh;
    polygons->GetPoint(i, place.data());
    mesh->GetPoint(id, ofMesh.data());
    if (place == ofMesh)
    {
      outer.ids.push_back(id);
      outer.places.push_back(place);
    }
  }
  return outer;
}

vtkSmartPointer<vtkUnstructuredGrid> cellsAround(
  vtkUnstructuredGrid* mesh, const std::vector<vtkIdType>& points)
{
  if (!mesh->GetLinks())
  {
    mesh->BuildLinks();
  }
  std::vector<unsigned char> isCellKnown(static_cast<std::size_t>(mesh->GetNumberOfCells()), 0);
  std::vector<unsigned char> isPointKnown(static_cast<std::size_t>(mesh->GetNumberOfPoints()), 0);
  std::vector<vtkIdType> at = points;
  for (const vtkIdType point : at)
  {
    isPointKnown[static_cast<std::size_t>(point)] = 1;
  }
  vtkNew<vtkIdList> cells, ids;
  for (int layer = 0; layer < layersOfCells; ++layer)
  {
    std::vector<vtkIdType> next;
    for (const vtkIdType point : at)
    {
      mesh->GetPointCells(point, cells);
      for (vtkIdType n = 0; n < cells->GetNumberOfIds(); ++n)
      {
        const vtkIdType cell = cells->GetId(n);
        if (isCellKnown[static_cast<std::size_t>(cell)])
        {
          continue;
        }
        isCellKnown[static_cast<std::size_t>(cell)] = 1;
        mesh->GetCellPoints(cell, ids);
        for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
        {
          unsigned char& isKnown = isPointKnown[static_cast<std::size_t>(ids->GetId(i))];
          if (!isKnown)
          {
            isKnown = 1;
            next.push_back(ids->GetId(i));
          }
        }
      }
    }
    at = std::move(next);
  }
  vtkNew<vtkIdList> chosen;
  for (std::size_t cell = 0; cell < isCellKnown.size(); ++cell)
  {
    if (isCellKnown[cell])
    {
      chosen->InsertNextId(static_cast<vtkIdType>(cell));
    }
  }
  vtkNew<vtkExtractCells> extract;
  extract->SetInputData(mesh);
  extract->SetCellList(chosen);
  extract->Update();
  vtkUnstructuredGrid* around = extract->GetOutput();
  around->GetCellData()->RemoveArray("vtkOriginalCellIds");
  around->GetPointData()->RemoveArray("vtkOriginalPointIds");
  return around;
}

vtkSmartPointer<vtkUnstructuredGrid> withCopies(
  vtkUnstructuredGrid* mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& others)
{
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> flagged{ withFlags(mesh, 0) };
  for (vtkDataSet* other : others)
  {
    flagged.push_back(withFlags(other, vtkDataSetAttributes::DUPLICATECELL));
  }
  if (others.empty())
  {
    return flagged[0];
  }
  const std::vector<vtkDataSet*> parts(flagged.begin(), flagged.end());
  requireSameArrays(parts, vtkDataObject::POINT);
  requireSameArrays(parts, vtkDataObject::CELL);
  return vtkUnstructuredGrid::SafeDownCast(joinedMesh(parts));
}

} // namespace refractivity
