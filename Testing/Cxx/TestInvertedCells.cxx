// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells that are inside out are warned of.
#include "CellMeshes.h"

#include "CellShape.h"

#include "vtkMultiBlockDataSet.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{

/// Cells side by side that share no points; those that are chosen are mirrored.
Mesh rowOf(int type, int points, int count, const std::function<bool(int)>& isMirrored)
{
  const std::vector<Vec> unit = unitCell(type, points);
  auto mesh = Mesh::New();
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (int cell = 0; cell < count; ++cell)
  {
    vtkNew<vtkIdList> ids;
    for (const Vec& x : unit)
    {
      const double along = isMirrored(cell) ? 1 - x[0] : x[0];
      ids->InsertNextId(places->InsertNextPoint(along + 1.1 * cell, x[1], x[2]));
    }
    mesh->InsertNextCell(type, ids);
  }
  mesh->SetPoints(places);
  addPointArray(mesh, "N", linear);
  return mesh;
}

std::vector<std::string> warningsOf(vtkDataObject* data)
{
  auto filter = bench(data);
  filter->SetImageSize(24, 16);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  EXPECT_FALSE(isEmpty(filter));
  return complaints->Warnings;
}

} // namespace

TEST(InvertedCells, AreCounted)
{
  for (const auto& [type, points] : std::vector<std::pair<int, int>>{
         { VTK_TETRA, 4 }, { VTK_WEDGE, 6 }, { VTK_PYRAMID, 5 }, { VTK_HEXAHEDRON, 8 } })
  {
    SCOPED_TRACE(type);
    const auto warnings =
      warningsOf(rowOf(type, points, 30, [](int cell) { return cell == 4 || cell == 17; }));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("2 of 30 cells are inside out"), std::string::npos) << warnings[0];
  }
}

TEST(InvertedCells, AreNoneWhereAllAreTheSameWayRound)
{
  for (const bool areMirrored : { false, true })
  {
    EXPECT_TRUE(warningsOf(rowOf(VTK_HEXAHEDRON, 8, 30, [=](int) { return areMirrored; })).empty());
  }
  // One block of each.
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, rowOf(VTK_HEXAHEDRON, 8, 30, [](int) { return false; }));
  blocks->SetBlock(1, rowOf(VTK_HEXAHEDRON, 8, 2, [](int) { return true; }));
  EXPECT_TRUE(warningsOf(blocks).empty());
}

// A point in the middle of an edge that lies beyond its end.
TEST(InvertedCells, CurvedCellsThatFoldAreCounted)
{
  for (const auto& [type, points] : std::vector<std::pair<int, int>>{ { VTK_QUADRATIC_TETRA, 10 },
         { VTK_QUADRATIC_WEDGE, 15 }, { VTK_QUADRATIC_PYRAMID, 13 },
         { VTK_QUADRATIC_HEXAHEDRON, 20 }, { VTK_TRIQUADRATIC_HEXAHEDRON, 27 } })
  {
    SCOPED_TRACE(type);
    const Mesh mesh = rowOf(type, points, 30, [](int) { return false; });
    EXPECT_TRUE(warningsOf(mesh).empty());
    for (const int cell : { 3, 21 })
    {
      vtkNew<vtkIdList> ids;
      mesh->GetCellPoints(cell, ids);
      const vtkIdType middle = ids->GetId(filters::cornersOf(filters::skeletonOf(type)));
      double x[3];
      mesh->GetPoint(middle, x);
      mesh->GetPoints()->SetPoint(middle, x[0] + 0.7, x[1], x[2]);
    }
    mesh->Modified();
    const auto warnings = warningsOf(mesh);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("2 of 30 cells are curved so much"), std::string::npos)
      << warnings[0];
  }
}

TEST(InvertedCells, OfTheSameMeshAreSaidAtEachStep)
{
  const Mesh mesh = rowOf(VTK_HEXAHEDRON, 8, 30, [](int cell) { return cell == 0; });
  auto filter = bench(mesh);
  filter->SetImageSize(24, 16);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  addPointArray(mesh, "N", [](const Vec& x) { return 2 * linear(x); });
  mesh->Modified();
  filter->Update();
  EXPECT_EQ(complaints->Warnings.size(), 2u);
}
