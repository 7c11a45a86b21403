// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells that are folded, which are counted and warned of, and those that are merely numbered the other way round, which are
// sampled as others are.
#include "CellMeshes.h"

#include "Cells/CellSampler.h"
#include "Cells/FoldedCells.h"

#include <cstdint>

using filters::CellTree;
using filters::FoldedCells;

namespace
{

std::vector<CellKind> kinds()
{
  std::vector<CellKind> all = linearKinds();
  all.push_back({ "QuadraticHexahedra", VTK_QUADRATIC_HEXAHEDRON,
    cut(unitCell(VTK_QUADRATIC_HEXAHEDRON, 20), boxes) });
  all.push_back({ "LagrangeTetrahedra", VTK_LAGRANGE_TETRAHEDRON,
    cut(unitCell(VTK_LAGRANGE_TETRAHEDRON, 20), kuhn) });
  all.push_back(
    { "QuadraticWedges", VTK_QUADRATIC_WEDGE, cut(unitCell(VTK_QUADRATIC_WEDGE, 15), prisms) });
  return all;
}

FoldedCells foldedIn(vtkDataSet* mesh)
{
  mesh->GetPointData()->SetActiveScalars("N");
  return CellTree({ mesh }).mesh()->folded;
}

/// The largest error of the linear field at points in the unit cube, all of which are to be found.
double errorOf(vtkDataSet* mesh)
{
  constexpr int n = 24;
  constexpr double spacing = 0.98 / (n - 1);
  const schlieren::Lattice lattice{ { 0.01, 0.01, 0.01 }, { spacing, spacing, spacing },
    { n, n, n } };
  const auto size = static_cast<std::size_t>(lattice.size());
  std::vector<double> values(size);
  std::vector<unsigned char> found(size);
  const CellTree tree({ mesh });
  filters::CellSampler(tree).sample(lattice, values.data(), found.data());
  EXPECT_EQ(std::count(found.begin(), found.end(), 1), lattice.size());
  double error = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    error = std::max(error, std::abs(values[i] - linear(pointOf(lattice, i))));
  }
  return error;
}

/// The same mesh in a mirror, so that all cells are left-handed. The field follows.
Mesh mirrored(vtkUnstructuredGrid* mesh)
{
  auto result = Mesh::New();
  result->DeepCopy(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    points->InsertNextPoint(1 - x[0], x[1], x[2]);
  }
  result->SetPoints(points);
  addPointArray(result, "N", linear);
  return result;
}

/// Moves the point that is nearest to `from`.
void move(vtkUnstructuredGrid* mesh, Vec from, const Vec& by)
{
  const vtkIdType point = mesh->FindPoint(from.data());
  double x[3];
  mesh->GetPoint(point, x);
  mesh->GetPoints()->SetPoint(point, x[0] + by[0], x[1] + by[1], x[2] + by[2]);
  mesh->Modified();
  addPointArray(mesh, "N", linear);
}

class FoldedCellsOf : public testing::TestWithParam<CellKind>
{
};

} // namespace

TEST_P(FoldedCellsOf, AreNoneInBentAndMirroredMeshes)
{
  const Mesh mesh = meshOf(GetParam().type, 4, GetParam().cells, 0.1, false);
  for (const Mesh& one : { mesh, mirrored(mesh) })
  {
    EXPECT_EQ(foldedIn(one).count, 0);
    EXPECT_LT(errorOf(one), 1e-10);
  }
}

// A point beyond its neighbours is in cells on the other side, whose volumes change their sign.
TEST_P(FoldedCellsOf, AreAroundPointsBeyondTheirNeighbours)
{
  const Mesh mesh = meshOf(GetParam().type, 4, GetParam().cells, 0, false);
  move(mesh, { 0.5, 0.5, 0.5 }, { 0.4, 0.03, 0.02 });
  for (const Mesh& one : { mesh, mirrored(mesh) })
  {
    const FoldedCells folded = foldedIn(one);
    EXPECT_GT(folded.count, 0);
    EXPECT_LE(folded.count, 24);
    for (const double along : folded.place)
    {
      EXPECT_GT(along, 0.2);
      EXPECT_LT(along, 0.8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FoldedCellsOf, testing::ValuesIn(kinds()),
  [](const testing::TestParamInfo<CellKind>& kind) { return kind.param.name; });

TEST(FoldedCells, AreNoneWhereCellsAreNumberedTheOtherWayRound)
{
  const Mesh mesh = meshOf(VTK_HEXAHEDRON, 6, { unitCell(VTK_HEXAHEDRON, 8) }, 0.1, false);
  for (const vtkIdType each : { 1, 2, 7, 100 })
  {
    const Mesh one = withSwapped(mesh, upsideDown, each);
    EXPECT_EQ(foldedIn(one).count, 0) << each;
    EXPECT_LT(errorOf(one), 1e-10) << each;
  }
}

// As where a writer mixes up hexahedra and voxels.
TEST(FoldedCells, AreThoseWithPointsInAWrongOrder)
{
  const Mesh mesh = meshOf(VTK_HEXAHEDRON, 4, { unitCell(VTK_HEXAHEDRON, 8) }, 0.1, false);
  const Mesh wrong = withSwapped(mesh, { { 2, 3 }, { 6, 7 } });
  EXPECT_EQ(foldedIn(wrong).count, mesh->GetNumberOfCells());
}

// Around the axis of a mesh, edges and corners have no volume.
TEST(FoldedCells, AreNoneInCollapsedHexahedra)
{
  const auto grid = ballWithPoles();
  addPointArray(grid, "N", linear);
  EXPECT_EQ(foldedIn(grid).count, 0);
}

TEST(FoldedCells, AreWarnedOfOnce)
{
  const Mesh mesh = meshOf(VTK_HEXAHEDRON, 4, { unitCell(VTK_HEXAHEDRON, 8) }, 0, false);
  move(mesh, { 0.5, 0.5, 0.5 }, { 0.4, 0.03, 0.02 });
  auto filter = bench(mesh, 16);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  const std::string count = std::to_string(foldedIn(mesh).count);
  EXPECT_NE(complaints->Warnings[0].find(": " + count + " cells are folded"), std::string::npos)
    << complaints->Warnings[0];
  addPointArray(mesh, "N", [](const Vec& x) { return 2 * linear(x); }); // the next time step
  mesh->Modified();
  filter->Update();
  EXPECT_EQ(complaints->Warnings.size(), 1u);
}
