// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Makes the meshes of datasets whose points are merged, and their values.
#include "Sources/SharedPoints.h"

#include "Cells/CellMeans.h"
#include "Cells/MeshArrays.h"
#include "Cells/MeshKey.h"
#include "Common/Vectors.h"
#include "Input/Flow.h"
#include "Walls/MeshFaces.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace filters
{

namespace
{

using Leaves = std::vector<vtkSmartPointer<vtkDataSet>>;
using LeafNumbers = std::vector<std::vector<std::int32_t>>;

/// Leaves out cells (-1) whose points are all merged and the same as another's: of such cells it
/// keeps a visible one if there is any, or else a copy.
LeafNumbers withoutDoubles(
  const std::vector<MeshArrays>& meshes, const LeafNumbers& points, std::size_t numberOfPoints)
{
  std::vector<unsigned char> uses(numberOfPoints, 0); // none, one or more
  for (const std::vector<std::int32_t>& numbers : points)
  {
    for (const std::int32_t number : numbers)
    {
      unsigned char& of = uses[static_cast<std::size_t>(number)];
      of = of > 0 ? 2 : 1;
    }
  }
  LeafNumbers cells(meshes.size());
  std::unordered_set<std::uint64_t> known;
  for (const int rank : { 2, 1, 0 }) // visible, a copy, hidden
  {
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      const MeshArrays& mesh = meshes[i];
      cells[i].resize(static_cast<std::size_t>(mesh.cells()), 0);
      for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
      {
        if ((mesh.isVisible(cell) ? (mesh.isCopy(cell) ? 1 : 2) : 0) != rank)
        {
          continue;
        }
        bool areMerged = true;
        std::uint64_t hash = 0;
        mesh.forPoints(cell,
          [&](vtkIdType point)
          {
            const std::int32_t number = points[i][static_cast<std::size_t>(point)];
            areMerged = areMerged && uses[static_cast<std::size_t>(number)] > 1;
            hash += hashOfPoint(static_cast<std::uint64_t>(number));
          });
        if (areMerged && !known.insert(hash).second)
        {
          cells[i][static_cast<std::size_t>(cell)] = -1;
        }
      }
    }
  }
  return cells;
}

/// Adds a leaf's cells with the mesh's points, and numbers them.
void addCells(vtkDataSet* leaf, const MeshArrays& from, const std::vector<std::int32_t>& points,
  std::vector<std::int32_t>& cells, vtkUnstructuredGrid* mesh)
{
  const auto numberOf = [&](vtkIdType point) { return points[static_cast<std::size_t>(point)]; };
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < from.cells(); ++cell)
  {
    std::int32_t& number = cells[static_cast<std::size_t>(cell)];
    if (number < 0)
    {
      continue;
    }
    ids->Reset();
    if (from.type(cell) == VTK_POLYHEDRON)
    {
      // For each face the number of points, and the points.
      vtkUnstructuredGrid::SafeDownCast(leaf)->GetFaceStream(cell, ids);
      vtkIdType next = 1;
      for (vtkIdType face = 0; face < ids->GetId(0); ++face)
      {
        const vtkIdType end = next + 1 + ids->GetId(next);
        for (++next; next < end; ++next)
        {
          ids->SetId(next, numberOf(ids->GetId(next)));
        }
      }
    }
    else
    {
      from.forPoints(cell, [&](vtkIdType point) { ids->InsertNextId(numberOf(point)); });
    }
    number = static_cast<std::int32_t>(mesh->InsertNextCell(from.type(cell), ids));
  }
}

/// Makes the mesh without values, and numbers the leaves' cells in it; -1: one that is left out.
vtkSmartPointer<vtkUnstructuredGrid> emptyMeshOf(
  const JoinedLeaves& group, const Leaves& leaves, LeafNumbers& cellNumbers)
{
  std::vector<MeshArrays> meshes;
  vtkIdType cells = 0;
  for (const std::size_t leaf : group.leaves)
  {
    meshes.emplace_back(leaves[leaf]);
    cells += meshes.back().cells();
  }
  cellNumbers = withoutDoubles(meshes, group.points, group.count);
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  places->SetNumberOfPoints(static_cast<vtkIdType>(group.count));
  mesh->SetPoints(places);
  mesh->AllocateEstimate(cells, 8);
  mesh->GetCells()->Use32BitStorage();
  for (std::size_t i = meshes.size(); i-- > 0;) // the first of equal points stays
  {
    for (std::size_t point = group.points[i].size(); point-- > 0;)
    {
      Point x;
      meshes[i].coordinates(static_cast<vtkIdType>(point), x.data());
      places->SetPoint(group.points[i][point], x.data());
    }
  }
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    addCells(leaves[group.leaves[i]], meshes[i], group.points[i], cellNumbers[i], mesh);
  }
  vtkNew<vtkUnsignedCharArray> doubles;
  doubles->SetName(doublesName);
  doubles->SetNumberOfValues(static_cast<vtkIdType>(group.count));
  doubles->Fill(0);
  for (const std::int32_t point : group.doubles)
  {
    doubles->SetValue(point, 1);
  }
  mesh->GetPointData()->AddArray(doubles);
  return mesh;
}

} // namespace

vtkSmartPointer<vtkDataSet> meshOf(const JoinedLeaves& group, const Leaves& leaves)
{
  const bool areOfCells = std::all_of(group.leaves.begin(), group.leaves.end(),
    [&](std::size_t leaf) { return leaves[leaf]->GetCellData()->GetScalars() != nullptr; });
  LeafNumbers cellNumbers;
  const auto mesh = emptyMeshOf(group, leaves, cellNumbers);
  vtkNew<vtkDoubleArray> ofPoints, ofCells;
  vtkNew<vtkUnsignedCharArray> ghosts;
  ofPoints->SetName(arrayName);
  ofPoints->SetNumberOfValues(mesh->GetNumberOfPoints());
  ofPoints->Fill(std::numeric_limits<double>::quiet_NaN()); // without visible cells
  ofCells->SetName(arrayName);
  ofCells->SetNumberOfValues(mesh->GetNumberOfCells());
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(mesh->GetNumberOfCells());
  std::vector<int> counts(static_cast<std::size_t>(mesh->GetNumberOfPoints()), 0);
  for (std::size_t i = 0; i < group.leaves.size(); ++i)
  {
    vtkDataSet* leaf = leaves[group.leaves[i]];
    vtkDataArray* cellValues = leaf->GetCellData()->GetScalars();
    if (cellValues && !areOfCells)
    {
      bringToPoints(leaf, false);
    }
    const MeshArrays from(leaf);
    vtkUnsignedCharArray* hidden = leaf->GetCellGhostArray();
    std::vector<unsigned char> isUsed(static_cast<std::size_t>(from.points()), 0);
    for (vtkIdType cell = 0; cell < from.cells(); ++cell)
    {
      const std::int32_t number = cellNumbers[i][static_cast<std::size_t>(cell)];
      if (number < 0)
      {
        continue;
      }
      bool isGas = true;
      from.forPoints(
        cell, [&](vtkIdType point) { isGas = isGas && std::isfinite(from.values()[point]); });
      from.forPoints(cell,
        [&](vtkIdType point)
        {
          unsigned char& is = isUsed[static_cast<std::size_t>(point)];
          is = is || (isGas && from.isVisible(cell)) ? 1 : 0;
        });
      // Hides a cell without a value, because others may have values at its points.
      const int ghost = (hidden ? hidden->GetValue(cell) : 0) |
        (isGas ? 0 : static_cast<int>(vtkDataSetAttributes::HIDDENCELL));
      ghosts->SetValue(number, static_cast<unsigned char>(ghost));
      ofCells->SetValue(number, areOfCells ? cellValues->GetComponent(cell, 0) : 0);
    }
    for (std::size_t point = 0; point < isUsed.size(); ++point)
    {
      const std::int32_t number = group.points[i][point];
      const double value = from.values()[point];
      int& count = counts[static_cast<std::size_t>(number)];
      if (isUsed[point])
      {
        ofPoints->SetValue(number, (count++ > 0 ? ofPoints->GetValue(number) : 0) + value);
      }
      else if (count == 0 && std::isfinite(value))
      {
        ofPoints->SetValue(number, value);
      }
    }
  }
  for (vtkIdType point = 0; point < ofPoints->GetNumberOfValues(); ++point)
  {
    const int count = std::max(1, counts[static_cast<std::size_t>(point)]);
    ofPoints->SetValue(point, ofPoints->GetValue(point) / count);
  }
  mesh->GetPointData()->SetScalars(ofPoints);
  mesh->GetCellData()->AddArray(ghosts);
  if (areOfCells)
  {
    mesh->GetCellData()->SetScalars(ofCells);
  }
  return mesh;
}

} // namespace filters
