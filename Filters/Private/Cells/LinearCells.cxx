// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/LinearCells.h"

#include "Cells/CellDivision.h"
#include "Cells/MeshKey.h"
#include "Common/CellTypes.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkConvexPointSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

int typeOf(CellShape shape)
{
  constexpr int types[] = { VTK_TETRA, VTK_WEDGE, VTK_PYRAMID, VTK_HEXAHEDRON };
  return types[static_cast<std::size_t>(shape)];
}

bool isToDivide(int type)
{
  return skeletonOf(type) != CellShape::Other || type == VTK_CONVEX_POINT_SET;
}

/// Cuts the convex hull of points into tetrahedra. Sorts the points, so that neighbours cut their common
/// faces alike. Returns four indices of points for each.
vtkSmartPointer<vtkIdList> tetrahedraOf(vtkPoints* points, vtkIdList* ids)
{
  std::sort(ids->begin(), ids->end());
  const vtkIdType count = ids->GetNumberOfIds();
  vtkNew<vtkConvexPointSet> hull;
  hull->PointIds->SetNumberOfIds(count);
  hull->Points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    hull->PointIds->SetId(i, i);
    hull->Points->SetPoint(i, points->GetPoint(ids->GetId(i)));
  }
  auto tetrahedra = vtkSmartPointer<vtkIdList>::New();
  vtkNew<vtkPoints> notUsed;
  hull->Triangulate(0, tetrahedra, notUsed);
  return tetrahedra;
}

class LinearCells
{
public:
  explicit LinearCells(vtkUnstructuredGrid* mesh)
    : Mesh(mesh)
    , Degrees(mesh->GetCellData()->GetHigherOrderDegrees())
    , Rational(mesh->GetPointData()->GetRationalWeights())
    , AreOfCells(mesh->GetCellData()->GetScalars() != nullptr)
  {
    this->Points->SetDataTypeToDouble();
    this->Points->DeepCopy(mesh->GetPoints());
    this->Values->DeepCopy(mesh->GetPointData()->GetScalars());
    // The functions of cells without rational weights, which are here multiplied by them.
    this->Plain->CopyStructure(mesh);
    this->Plain->GetCellData()->SetHigherOrderDegrees(this->Degrees);
  }

  vtkSmartPointer<vtkUnstructuredGrid> make()
  {
    this->Linear->Allocate(this->Mesh->GetNumberOfCells());
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < this->Mesh->GetNumberOfCells(); ++cell)
    {
      const int type = this->Mesh->GetCellType(cell);
      if (isToDivide(type))
      {
        this->Mesh->GetCellPoints(cell, ids);
        this->divide(cell, type, ids);
        continue;
      }
      type == VTK_POLYHEDRON ? this->Mesh->GetFaceStream(cell, ids)
                             : this->Mesh->GetCellPoints(cell, ids);
      this->Linear->InsertNextCell(type, ids);
      this->Owners->InsertNextId(cell);
    }
    this->Linear->SetPoints(this->Points);
    this->Linear->GetPointData()->SetScalars(this->Values);
    vtkCellData* to = this->Linear->GetCellData();
    to->CopyAllOn();
    to->SetCopyHigherOrderDegrees(0);
    to->CopyAllocate(this->Mesh->GetCellData(), this->Owners->GetNumberOfIds());
    to->CopyData(this->Mesh->GetCellData(), this->Owners);
    return this->Linear;
  }

private:
  void divide(vtkIdType cell, int type, vtkIdList* ids)
  {
    const CellShape shape = skeletonOf(type);
    if (shape == CellShape::Other)
    {
      const auto corners = tetrahedraOf(this->Points, ids);
      for (vtkIdType i = 0; i + 3 < corners->GetNumberOfIds(); i += 4)
      {
        const vtkIdType* of = corners->GetPointer(i);
        this->add(cell, VTK_TETRA, 4,
          std::array<vtkIdType, 4>{
            ids->GetId(of[0]), ids->GetId(of[1]), ids->GetId(of[2]), ids->GetId(of[3]) }
            .data());
      }
      return;
    }
    const CellDivision& division = this->divisionOf(cell, type, shape, ids->GetNumberOfIds());
    std::vector<vtkIdType> nodes;
    for (const Node& node : division.nodes)
    {
      nodes.push_back(this->pointOf(node, type, ids->GetPointer(0)));
    }
    for (const CellDivision::Part& part : division.parts)
    {
      std::array<vtkIdType, 8> corners{};
      std::transform(part.nodes.begin(), part.nodes.end(), corners.begin(),
        [&](int node) { return nodes[static_cast<std::size_t>(node)]; });
      this->add(
        cell, typeOf(part.shape), static_cast<vtkIdType>(part.nodes.size()), corners.data());
    }
  }

  void add(vtkIdType cell, int type, vtkIdType count, const vtkIdType* corners)
  {
    this->Linear->InsertNextCell(type, count, corners);
    this->Owners->InsertNextId(cell);
  }

  const CellDivision& divisionOf(vtkIdType cell, int type, CellShape shape, vtkIdType points)
  {
    std::array<double, 5> key{ static_cast<double>(type), static_cast<double>(points) };
    if (this->Degrees)
    {
      this->Degrees->GetTuple(cell, key.data() + 2);
    }
    const auto [found, isNew] = this->Divisions.try_emplace(key);
    if (isNew)
    {
      this->Plain->GetCell(cell, this->Cell);
      found->second = this->AreOfCells
        ? CellDivision::cornersOnly(shape)
        : CellDivision::atNodes(this->Cell->GetRepresentativeCell(), shape);
    }
    return found->second;
  }

  /// Returns the number of a node of a cell with the points `ids`.
  vtkIdType pointOf(const Node& node, int type, const vtkIdType* ids)
  {
    if (node.size() == 1)
    {
      return ids[node[0].first];
    }
    // Keeps what is multiplied from being half of an integer, as fractions may be.
    constexpr double scale = 741455.2; // of 2^20
    const bool isRational =
      this->Rational && type >= VTK_BEZIER_CURVE && type <= VTK_BEZIER_PYRAMID;
    const auto weightOf = [&](const std::pair<int, double>& of)
    { return of.second * (isRational ? this->Rational->GetComponent(ids[of.first], 0) : 1); };
    double sum = 0, value = 0, place[3] = { 0, 0, 0 };
    for (const auto& of : node)
    {
      sum += weightOf(of);
    }
    std::uint64_t hash = 0; // independent of the points' order, which differs between neighbours
    for (const auto& of : node)
    {
      const vtkIdType point = ids[of.first];
      const double weight = weightOf(of) / sum;
      hash += hashOfPoint(static_cast<std::uint64_t>(point)) *
        static_cast<std::uint64_t>(std::llround(scale * weight));
      double x[3];
      this->Points->GetPoint(point, x);
      for (int axis = 0; axis < 3; ++axis)
      {
        place[axis] += weight * x[axis];
      }
      value += weight * this->Values->GetValue(point);
    }
    const auto [found, isNew] = this->Made.try_emplace(hash, 0);
    if (isNew)
    {
      found->second = this->Points->InsertNextPoint(place);
      this->Values->InsertNextValue(value);
    }
    return found->second;
  }

  vtkUnstructuredGrid* Mesh;
  vtkDataArray* Degrees;
  vtkDataArray* Rational;
  const bool AreOfCells;
  vtkNew<vtkUnstructuredGrid> Plain; // without rational weights
  vtkNew<vtkGenericCell> Cell;
  std::map<std::array<double, 5>, CellDivision> Divisions;
  std::unordered_map<std::uint64_t, vtkIdType> Made; // by what they are made of
  vtkSmartPointer<vtkUnstructuredGrid> Linear = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Values;
  vtkNew<vtkIdList> Owners; // of the linear cells
};

} // namespace

vtkSmartPointer<vtkDataSet> asLinearCells(vtkDataSet* data)
{
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);
  auto* types = mesh ? vtkUnsignedCharArray::SafeDownCast(cellTypesOf(mesh)) : nullptr;
  std::array<bool, 256> exists{};
  for (vtkIdType i = 0; types && i < types->GetNumberOfValues(); ++i)
  {
    exists[types->GetValue(i)] = true;
  }
  for (std::size_t type = 0; type < exists.size(); ++type)
  {
    if (exists[type] && isToDivide(static_cast<int>(type)))
    {
      return LinearCells(mesh).make();
    }
  }
  return data;
}

} // namespace filters
