// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Makes the meshes of datasets whose points are merged, and their values.
#include "Sources/SharedPoints.h"

#include "Cells/CellMeans.h"
#include "Cells/MeshArrays.h"
#include "Cells/MeshKey.h"
#include "Input/RefractivitySource.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace filters
{

namespace
{

using Leaves = std::vector<vtkSmartPointer<vtkDataSet>>;

/// Ratio of squared jumps between cells with their own points to squared differences within cells,
/// summed over the mesh, above which cells' means are better than means at points.
constexpr double largeJumps = 0.05;

/// Hashes the set of a cell's points, regardless of their order.
std::uint64_t hashOfPoints(
  const MeshArrays& mesh, vtkIdType cell, const std::vector<std::int32_t>& numbers)
{
  std::uint64_t sum = 0;
  mesh.forPoints(cell,
    [&](vtkIdType point)
    { sum += hashOfPoint(static_cast<std::uint64_t>(numbers[static_cast<std::size_t>(point)])); });
  return sum;
}

/// Copies the weights of curved cells, if the first dataset and others have them.
void copyShapes(const std::vector<std::size_t>& group,
  const std::vector<std::vector<std::int32_t>>& numbers,
  const std::vector<std::vector<unsigned char>>& isLeftOut, const Leaves& leaves,
  vtkUnstructuredGrid* mesh)
{
  const auto newLike = [](vtkDataArray* array, vtkIdType count)
  {
    auto made = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
    made->SetName(array->GetName());
    made->SetNumberOfComponents(array->GetNumberOfComponents());
    made->SetNumberOfTuples(count);
    made->Fill(1);
    return made;
  };
  vtkDataArray* weights = leaves[group[0]]->GetPointData()->GetRationalWeights();
  vtkDataArray* degrees = leaves[group[0]]->GetCellData()->GetHigherOrderDegrees();
  vtkSmartPointer<vtkDataArray> ofPoints, ofCells;
  if (weights)
  {
    ofPoints = newLike(weights, mesh->GetNumberOfPoints());
    mesh->GetPointData()->SetRationalWeights(ofPoints);
  }
  if (degrees)
  {
    ofCells = newLike(degrees, mesh->GetNumberOfCells());
    mesh->GetCellData()->SetHigherOrderDegrees(ofCells);
  }
  vtkIdType next = 0;
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    vtkDataSet* leaf = leaves[group[i]];
    vtkDataArray* pointsOfLeaf = leaf->GetPointData()->GetRationalWeights();
    vtkDataArray* cellsOfLeaf = leaf->GetCellData()->GetHigherOrderDegrees();
    for (std::size_t point = 0; ofPoints && pointsOfLeaf && point < numbers[i].size(); ++point)
    {
      ofPoints->SetTuple(numbers[i][point], static_cast<vtkIdType>(point), pointsOfLeaf);
    }
    for (vtkIdType cell = 0; cell < leaf->GetNumberOfCells(); ++cell)
    {
      if (isLeftOut[i].empty() || !isLeftOut[i][static_cast<std::size_t>(cell)])
      {
        if (ofCells && cellsOfLeaf)
        {
          ofCells->SetTuple(next, cell, cellsOfLeaf);
        }
        ++next;
      }
    }
  }
}

/// The values of joined datasets: means at points, and of cells.
class JoinedValues
{
public:
  JoinedValues(vtkIdType points, vtkIdType cells, bool areOfCells)
    : AreOfCells(areOfCells)
    , Sums(static_cast<std::size_t>(points), 0)
    , Others(static_cast<std::size_t>(points), std::numeric_limits<double>::quiet_NaN())
    , Counts(static_cast<std::size_t>(points), 0)
  {
    this->Ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    this->Ghosts->SetNumberOfValues(cells);
    this->OfCells->SetName(arrayName);
    this->OfCells->SetNumberOfValues(cells);
  }

  /// Adds a dataset. `numbers`: of its points in the mesh; `isLeftOut`: of its cells; empty: none.
  void add(vtkDataSet* leaf, const std::vector<std::int32_t>& numbers,
    const std::vector<unsigned char>& isLeftOut)
  {
    vtkDataArray* cellValues = leaf->GetCellData()->GetScalars();
    if (cellValues && !this->AreOfCells)
    {
      bringToPoints(leaf, false);
      cellValues = nullptr;
    }
    const MeshArrays from(leaf);
    vtkUnsignedCharArray* hidden = leaf->GetCellGhostArray();
    std::vector<unsigned char> isUsed(static_cast<std::size_t>(from.points()), 0);
    for (vtkIdType cell = 0; cell < from.cells(); ++cell)
    {
      if (!isLeftOut.empty() && isLeftOut[static_cast<std::size_t>(cell)])
      {
        continue;
      }
      const unsigned char ghost = hidden ? hidden->GetValue(cell) : 0;
      const auto [mean, isGas] = this->addCell(from, cell, isUsed);
      // Hides a cell without a value, because others may have values at its points.
      this->Ghosts->SetValue(this->Next,
        isGas ? ghost : static_cast<unsigned char>(ghost | vtkDataSetAttributes::HIDDENCELL));
      this->OfCells->SetValue(this->Next, cellValues ? cellValues->GetComponent(cell, 0) : mean);
      ++this->Next;
    }
    for (std::size_t point = 0; point < isUsed.size(); ++point)
    {
      const auto number = static_cast<std::size_t>(numbers[point]);
      const double value = from.values()[point];
      if (isUsed[point])
      {
        this->Sums[number] += value;
        ++this->Counts[number];
      }
      else if (std::isfinite(value))
      {
        this->Others[number] = value;
      }
    }
  }

  /// Returns the sum of squared differences to the means of cells.
  double squaredDifferences() const { return this->Within; }

  /// Returns the sum of squared differences of a dataset's points to the means at points.
  double squaredJumps(vtkDataSet* leaf, const std::vector<std::int32_t>& numbers) const
  {
    const MeshArrays from(leaf);
    double squares = 0;
    for (vtkIdType point = 0; point < from.points(); ++point)
    {
      const auto number = static_cast<std::size_t>(numbers[static_cast<std::size_t>(point)]);
      const double jump = from.values()[point] - this->Sums[number] / this->Counts[number];
      squares += std::isfinite(jump) ? jump * jump : 0;
    }
    return squares;
  }

  void setIn(vtkDataSet* mesh, bool withCells)
  {
    vtkNew<vtkDoubleArray> ofPoints;
    ofPoints->SetName(arrayName);
    ofPoints->SetNumberOfValues(mesh->GetNumberOfPoints());
    for (std::size_t i = 0; i < this->Sums.size(); ++i)
    {
      ofPoints->SetValue(static_cast<vtkIdType>(i),
        this->Counts[i] > 0 ? this->Sums[i] / this->Counts[i] : this->Others[i]);
    }
    mesh->GetPointData()->SetScalars(ofPoints);
    mesh->GetCellData()->AddArray(this->Ghosts);
    if (withCells)
    {
      mesh->GetCellData()->SetScalars(this->OfCells);
    }
  }

private:
  /// Returns the mean of a cell's points, and whether all have values, and marks these points.
  std::pair<double, bool> addCell(
    const MeshArrays& from, vtkIdType cell, std::vector<unsigned char>& isUsed)
  {
    double sum = 0, squares = 0;
    int count = 0;
    from.forPoints(cell,
      [&](vtkIdType point)
      {
        sum += from.values()[point];
        ++count;
      });
    const double mean = sum / count;
    if (this->AreOfCells || !std::isfinite(sum))
    {
      return { mean, this->AreOfCells };
    }
    if (from.isVisible(cell))
    {
      from.forPoints(cell,
        [&](vtkIdType point)
        {
          const double difference = from.values()[point] - mean;
          isUsed[static_cast<std::size_t>(point)] = 1;
          squares += difference * difference;
        });
      this->Within += squares;
    }
    return { mean, true };
  }

  bool AreOfCells;
  std::vector<double> Sums, Others; // of used points, and of points that hidden cells alone have
  std::vector<std::uint32_t> Counts;
  vtkNew<vtkUnsignedCharArray> Ghosts;
  vtkNew<vtkDoubleArray> OfCells;
  vtkIdType Next = 0;
  double Within = 0;
};

} // namespace

/// Leaves out duplicate cells of a group. Returns how many points each merged one has, at most 2.
std::vector<unsigned char> SharedPoints::leaveOutDuplicates(
  const std::vector<MeshArrays>& meshes, Group& group)
{
  std::vector<unsigned char> points(
    static_cast<std::size_t>(group.points), 0); // merged points of each
  for (const std::vector<std::int32_t>& numbers : group.numbers)
  {
    for (const std::int32_t number : numbers)
    {
      unsigned char& count = points[static_cast<std::size_t>(number)];
      count = static_cast<unsigned char>(std::min(count + 1, 2));
    }
  }
  struct Best
  {
    std::size_t leaf;
    vtkIdType cell;
    int rank; // 2: visible, 1: a copy, 0: hidden
  };
  std::unordered_map<std::uint64_t, Best> known;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const MeshArrays& mesh = meshes[i];
    group.isLeftOut.emplace_back();
    group.cells += mesh.cells();
    for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
    {
      bool areAllShared = true;
      mesh.forPoints(cell,
        [&](vtkIdType point)
        {
          const std::int32_t number = group.numbers[i][static_cast<std::size_t>(point)];
          areAllShared = areAllShared && points[static_cast<std::size_t>(number)] > 1;
        });
      if (!areAllShared)
      {
        continue;
      }
      const int rank = mesh.isVisible(cell) ? (mesh.isCopy(cell) ? 1 : 2) : 0;
      const auto [place, isNew] =
        known.try_emplace(hashOfPoints(mesh, cell, group.numbers[i]), Best{ i, cell, rank });
      if (!isNew)
      {
        const bool isBetter = rank > place->second.rank;
        const std::size_t leaf = isBetter ? place->second.leaf : i;
        const vtkIdType out = isBetter ? place->second.cell : cell;
        std::vector<unsigned char>& of = group.isLeftOut[leaf];
        of.resize(static_cast<std::size_t>(meshes[leaf].cells()), 0);
        of[static_cast<std::size_t>(out)] = 1;
        --group.cells;
        if (isBetter)
        {
          place->second = { i, cell, rank };
        }
      }
    }
  }
  return points;
}

/// Makes the mesh of a group.
void SharedPoints::addGroup(const Leaves& leaves, Group group)
{
  std::vector<MeshArrays> meshes;
  meshes.reserve(group.leaves.size());
  for (const std::size_t leaf : group.leaves)
  {
    meshes.emplace_back(leaves[leaf]);
  }
  const std::vector<unsigned char> points = leaveOutDuplicates(meshes, group);
  group.mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  places->SetNumberOfPoints(group.points);
  group.mesh->SetPoints(places);
  const bool hasPolyhedra = std::any_of(meshes.begin(), meshes.end(),
    [](const MeshArrays& mesh)
    {
      const std::vector<int> types = mesh.types();
      return std::find(types.begin(), types.end(), VTK_POLYHEDRON) != types.end();
    });
  if (hasPolyhedra)
  {
    group.mesh->AllocateEstimate(group.cells, 8);
    group.mesh->GetCells()->Use32BitStorage();
  }
  // Others go directly into the arrays, because InsertNextCell() takes several times as long.
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkTypeInt32Array> starts, corners;
  types->Allocate(hasPolyhedra ? 0 : group.cells);
  starts->Allocate(hasPolyhedra ? 0 : group.cells + 1);
  corners->Allocate(hasPolyhedra ? 0 : 8 * group.cells);
  starts->InsertNextValue(0);
  std::vector<unsigned char> isKnown(points.size(), 0);
  std::vector<unsigned char> cellsOfPoints; // of a leaf's points: at most two
  std::size_t used = 0, alone = 0;
  vtkNew<vtkIdList> ids;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const MeshArrays& mesh = meshes[i];
    const std::vector<std::int32_t>& numbers = group.numbers[i];
    for (vtkIdType point = 0; point < mesh.points(); ++point)
    {
      const auto number = static_cast<std::size_t>(numbers[static_cast<std::size_t>(point)]);
      if (!isKnown[number])
      {
        isKnown[number] = 1;
        Point x;
        mesh.coordinates(point, x.data());
        places->SetPoint(static_cast<vtkIdType>(number), x.data());
      }
    }
    cellsOfPoints.assign(static_cast<std::size_t>(mesh.points()), 0);
    auto* polyhedra = vtkUnstructuredGrid::SafeDownCast(leaves[group.leaves[i]]);
    for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
    {
      if (!group.isLeftOut[i].empty() && group.isLeftOut[i][static_cast<std::size_t>(cell)])
      {
        continue;
      }
      ids->Reset();
      mesh.forPoints(cell,
        [&](vtkIdType point)
        {
          const auto at = static_cast<std::size_t>(point);
          hasPolyhedra ? ids->InsertNextId(numbers[at]) : corners->InsertNextValue(numbers[at]);
          cellsOfPoints[at] = static_cast<unsigned char>(std::min(cellsOfPoints[at] + 1, 2));
        });
      if (!hasPolyhedra)
      {
        types->InsertNextValue(static_cast<unsigned char>(mesh.type(cell)));
        starts->InsertNextValue(static_cast<vtkTypeInt32>(corners->GetNumberOfValues()));
        continue;
      }
      if (mesh.type(cell) == VTK_POLYHEDRON)
      {
        polyhedra->GetFaceStream(cell, ids); // for each face the number of points, and the points
        vtkIdType next = 1;
        for (vtkIdType face = 0; face < ids->GetId(0); ++face)
        {
          const vtkIdType end = next + 1 + ids->GetId(next);
          for (++next; next < end; ++next)
          {
            ids->SetId(next, numbers[static_cast<std::size_t>(ids->GetId(next))]);
          }
        }
      }
      group.mesh->InsertNextCell(mesh.type(cell), ids);
    }
    for (std::size_t point = 0; point < cellsOfPoints.size(); ++point)
    {
      used += cellsOfPoints[point] > 0 ? 1 : 0;
      alone += cellsOfPoints[point] == 1 && points[static_cast<std::size_t>(numbers[point])] > 1;
    }
  }
  if (!hasPolyhedra)
  {
    vtkNew<vtkCellArray> cells;
    cells->SetData(starts, corners);
    group.mesh->SetCells(types, cells);
  }
  group.areAllApart = 2 * alone > used;
  this->Groups.push_back(std::move(group));
}

vtkSmartPointer<vtkDataSet> SharedPoints::joinedOf(const Group& group, const Leaves& leaves)
{
  bool areAllOfCells = true;
  for (const std::size_t leaf : group.leaves)
  {
    areAllOfCells = areAllOfCells && leaves[leaf]->GetCellData()->GetScalars();
  }
  JoinedValues values(group.points, group.cells, areAllOfCells);
  for (std::size_t i = 0; i < group.leaves.size(); ++i)
  {
    values.add(leaves[group.leaves[i]], group.numbers[i], group.isLeftOut[i]);
  }
  double jumps = 0;
  for (std::size_t i = 0; i < group.leaves.size() && group.areAllApart && !areAllOfCells; ++i)
  {
    jumps += values.squaredJumps(leaves[group.leaves[i]], group.numbers[i]);
  }
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->CopyStructure(group.mesh);
  copyShapes(group.leaves, group.numbers, group.isLeftOut, leaves, mesh);
  values.setIn(mesh, areAllOfCells || jumps > largeJumps * values.squaredDifferences());
  return mesh;
}

Leaves SharedPoints::joined(const Leaves& leaves) const
{
  std::vector<const Group*> groups(leaves.size(), nullptr);
  for (const Group& group : this->Groups)
  {
    for (const std::size_t leaf : group.leaves)
    {
      groups[leaf] = &group;
    }
  }
  Leaves result;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
  {
    if (!groups[leaf])
    {
      result.push_back(leaves[leaf]);
    }
    else if (groups[leaf]->leaves[0] == leaf)
    {
      result.push_back(joinedOf(*groups[leaf], leaves));
    }
  }
  return result;
}

} // namespace filters
