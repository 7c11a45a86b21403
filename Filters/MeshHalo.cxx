// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshHalo.h"

#include "InputDescription.h"

#include "vtkAbstractArray.h"
#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
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
#include <map>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

namespace refractivity
{

namespace
{

/// Of cells, that what is known of a point may depend on: its trend depends on the values at the points of the cells
/// around it, and where these are few on those of the next ones; values that are found from cells do so, too.
constexpr int layersForPoints = 2;
constexpr int layersForCells = 4;

bool isMesh(vtkDataSet* data)
{
  return vtkUnstructuredGrid::SafeDownCast(data) || vtkStructuredGrid::SafeDownCast(data);
}

constexpr const char* numbersName = "NumbersOfPoints"; // see PointName

vtkSmartPointer<vtkDoubleArray> newNumbers(vtkIdType count)
{
  auto numbers = vtkSmartPointer<vtkDoubleArray>::New();
  numbers->SetName(numbersName);
  numbers->SetNumberOfComponents(3);
  numbers->SetNumberOfTuples(count);
  numbers->Fill(0);
  return numbers;
}

/// With each point's indices.
vtkSmartPointer<vtkUnstructuredGrid> unstructured(vtkStructuredGrid* grid)
{
  int extent[6];
  grid->GetExtent(extent);
  const auto numbers = newNumbers(grid->GetNumberOfPoints());
  vtkIdType point = 0;
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        numbers->SetTuple3(point++, i, j, k);
      }
    }
  }
  vtkNew<vtkStructuredGrid> numbered;
  numbered->ShallowCopy(grid);
  numbered->GetPointData()->AddArray(numbers);
  vtkNew<vtkAppendFilter> convert;
  convert->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION);
  convert->AddInputData(numbered);
  convert->Update();
  return convert->GetOutput();
}

/// In the order of their names, whatever way they have come.
void sortArrays(vtkDataSetAttributes* attributes)
{
  std::map<std::string, vtkSmartPointer<vtkAbstractArray>> arrays;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    arrays[array->GetName() ? array->GetName() : ""] = array;
  }
  const vtkSmartPointer<vtkDataArray> scalars = attributes->GetScalars();
  attributes->Initialize();
  for (const auto& array : arrays)
  {
    attributes->AddArray(array.second);
  }
  if (scalars)
  {
    attributes->SetScalars(scalars);
  }
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
  sortArrays(copy->GetPointData());
  sortArrays(copy->GetCellData());
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
    if (auto* grid = vtkStructuredGrid::SafeDownCast(part.data))
    {
      part.data = unstructured(grid);
    }
  }
  return parts;
}

OuterPoints outerPointsOf(vtkUnstructuredGrid* mesh)
{
  constexpr const char* name = "PointOfMesh";
  vtkNew<vtkIdTypeArray> all;
  all->SetName(name);
  all->SetNumberOfValues(mesh->GetNumberOfPoints());
  std::iota(all->GetPointer(0), all->GetPointer(0) + all->GetNumberOfValues(), vtkIdType{ 0 });
  vtkNew<vtkUnstructuredGrid> cells; // all of them, hidden ones too
  cells->CopyStructure(mesh);
  cells->GetPointData()->AddArray(all);
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
      outer.names.push_back({ place, { 0, 0, 0 } });
    }
  }
  auto* numbers = vtkDoubleArray::SafeDownCast(mesh->GetPointData()->GetArray(numbersName));
  if (!numbers)
  {
    const auto counted = newNumbers(mesh->GetNumberOfPoints());
    std::unordered_map<Point, int, HashOfPlace> counts;
    for (std::size_t i = 0; i < outer.ids.size(); ++i)
    {
      counted->SetComponent(outer.ids[i], 0, counts[outer.names[i].place]++);
    }
    mesh->GetPointData()->AddArray(counted);
    numbers = counted;
  }
  for (std::size_t i = 0; i < outer.ids.size(); ++i)
  {
    numbers->GetTypedTuple(outer.ids[i], outer.names[i].number.data());
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
  vtkCellData* ofCells = mesh->GetCellData();
  const bool hasValues = ofCells->GetNumberOfArrays() > (mesh->GetCellGhostArray() ? 1 : 0);
  const int layers = hasValues ? layersForCells : layersForPoints;
  for (int layer = 0; layer < layers; ++layer)
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
  return vtkUnstructuredGrid::SafeDownCast(joinedMesh(parts, numbersName));
}

} // namespace refractivity
