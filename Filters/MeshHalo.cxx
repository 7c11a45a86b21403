// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshHalo.h"

#include "FlatData.h"
#include "ImagePiece.h"
#include "InputDescription.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
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

namespace filters
{

namespace
{

/// Of cells, that what is known of a point may depend on: its trend depends on the values at the points of the cells
/// around it, and where these are few on those of the next ones; values that are found from cells do so, too.
constexpr int layersForPoints = 2;
constexpr int layersForCells = 4;

bool isMesh(vtkDataSet* data)
{
  return vtkUnstructuredGrid::SafeDownCast(data) || vtkStructuredGrid::SafeDownCast(data) ||
    vtkRectilinearGrid::SafeDownCast(data);
}

/// Whether there are values of cells.
bool hasCellValues(vtkDataSet* mesh)
{
  return mesh->GetCellData()->GetNumberOfArrays() > (mesh->GetCellGhostArray() ? 1 : 0);
}

constexpr const char* numbersName = "NumbersOfPoints"; // see PointName

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

/// With arrays of cells and points that say what hides them, and which cells are copies.
vtkSmartPointer<vtkDataSet> withFlags(vtkDataSet* mesh, unsigned char added)
{
  auto copy = vtkSmartPointer<vtkDataSet>::Take(mesh->NewInstance());
  copy->ShallowCopy(mesh);
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    const bool ofCells = kind == vtkDataObject::CELL;
    const int copied = ofCells ? static_cast<int>(vtkDataSetAttributes::DUPLICATECELL)
                               : static_cast<int>(vtkDataSetAttributes::DUPLICATEPOINT);
    vtkUnsignedCharArray* ghosts = copy->GetGhostArray(kind);
    vtkNew<vtkUnsignedCharArray> flags;
    flags->SetName(vtkDataSetAttributes::GhostArrayName());
    flags->SetNumberOfValues(copy->GetNumberOfElements(kind));
    for (vtkIdType i = 0; i < flags->GetNumberOfValues(); ++i)
    {
      const int own = ghosts ? ghosts->GetValue(i) & ~copied : 0;
      flags->SetValue(i, static_cast<unsigned char>(own | (ofCells ? added : 0)));
    }
    vtkDataSetAttributes* attributes = copy->GetAttributes(kind);
    attributes->RemoveArray(vtkDataSetAttributes::GhostArrayName());
    attributes->AddArray(flags);
    sortArrays(attributes);
  }
  return copy;
}

} // namespace

std::int32_t pieceKindsOf(vtkDataObject* data)
{
  if (auto* image = vtkImageData::SafeDownCast(data); image && image->GetNumberOfPoints() > 0)
  {
    return dimensionOf(image) == 3 ? PieceOfImage : NoPieces;
  }
  bool areAll = true, areImages = true;
  int dimension = -1; // there are none
  for (vtkDataObject* leaf : leavesOf(data))
  {
    auto* set = vtkDataSet::SafeDownCast(leaf);
    if (set && set->GetNumberOfPoints() > 0)
    {
      const bool isOneImage = vtkImageData::SafeDownCast(set) != nullptr;
      areAll = areAll && (isMesh(set) || isOneImage);
      areImages = areImages && isOneImage;
      dimension = std::max(dimension, dimensionOf(set));
    }
  }
  if (!areAll || (dimension >= 0 && dimension < 3))
  {
    return NoPieces;
  }
  const std::int32_t kinds = areImages ? PiecesOfMeshes | PiecesOfBlocks : PiecesOfMeshes;
  return dimension < 0 ? kinds | PieceOfImage : kinds;
}

Outline outlineOf(vtkDataSet* data)
{
  Outline outer;
  if (isGrid(data))
  {
    outer.isGrid = true;
    outer.extent = extentOf(data, false);
    outer.layers = hasCellValues(data) ? layersForCells : layersForPoints;
    if (auto* image = vtkImageData::SafeDownCast(data))
    {
      outer.layers = ImagePiece::layers;
      image->GetOrigin(outer.place.data());
      image->GetSpacing(outer.place.data() + 3);
      std::copy_n(image->GetDirectionMatrix()->GetData(), 9, outer.place.data() + 6);
    }
    return outer;
  }
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);
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
      outer.names.push_back({ place, 0 });
    }
  }
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName(numbersName);
  numbers->SetNumberOfValues(mesh->GetNumberOfPoints());
  numbers->Fill(0);
  std::unordered_map<Point, int, HashOfPlace> counts;
  for (std::size_t i = 0; i < outer.ids.size(); ++i)
  {
    outer.names[i].number = counts[outer.names[i].place]++;
    numbers->SetValue(outer.ids[i], outer.names[i].number);
  }
  mesh->GetPointData()->AddArray(numbers);
  return outer;
}

Outline::Extent neededOf(const Outline::Extent& grid, const Outline::Extent& other, int layers)
{
  Outline::Extent needed{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    needed[2 * axis] = std::max(grid[2 * axis], other[2 * axis] - layers);
    needed[2 * axis + 1] = std::min(grid[2 * axis + 1], other[2 * axis + 1] + layers);
    if (needed[2 * axis] >= needed[2 * axis + 1]) // no cells
    {
      return { 0, -1, 0, -1, 0, -1 };
    }
  }
  return needed;
}

vtkSmartPointer<vtkDataSet> cellsAround(
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
  const int layers = hasCellValues(mesh) ? layersForCells : layersForPoints;
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
  return extractedCells(mesh, chosen);
}

vtkSmartPointer<vtkDataSet> cellsWithin(vtkDataSet* grid, const Outline::Extent& extent)
{
  auto within = vtkSmartPointer<vtkDataSet>::Take(grid->NewInstance());
  within->ShallowCopy(grid);
  within->Crop(extent.data());
  return within;
}

vtkSmartPointer<vtkDataSet> withCopies(
  vtkDataSet* mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& others)
{
  if (others.empty() && isGrid(mesh))
  {
    return mesh; // cells that are marked as copies may be other blocks'
  }
  const vtkSmartPointer<vtkDataSet> own = withFlags(mesh, 0);
  if (others.empty())
  {
    return own;
  }
  std::vector<vtkSmartPointer<vtkDataSet>> flagged{ own };
  for (vtkDataSet* other : others)
  {
    flagged.push_back(withFlags(other, vtkDataSetAttributes::DUPLICATECELL));
  }
  if (isGrid(mesh))
  {
    std::swap(flagged.front(), flagged.back()); // where they overlap, what is written last counts
  }
  const std::vector<vtkDataSet*> parts(flagged.begin(), flagged.end());
  requireSameArrays(parts, vtkDataObject::POINT);
  requireSameArrays(parts, vtkDataObject::CELL);
  if (!isGrid(mesh))
  {
    return joinedMesh(parts, numbersName);
  }
  const vtkSmartPointer<vtkDataSet> joined = joinedGrid(parts);
  return joined ? joined : own;
}

} // namespace filters
