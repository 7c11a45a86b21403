// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known of the cells in a box.
#include "CellMeshes.h"

#include "Cells/CellTree.h"

#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"

#include <random>

using filters::CellTree;

namespace
{

void setN(vtkDataSet* data, const ScalarField& field)
{
  data->GetPointData()->SetScalars(addPointArray(data, "N", field));
}

double rough(const Vec& x) { return 1e-4 * std::sin(3 * x[0] + 5 * x[1] * x[1]) + 1e-5 * x[2]; }

Mesh hexahedra(int n, double by)
{
  const Mesh mesh = meshOf(VTK_HEXAHEDRON, n, { unitCell(VTK_HEXAHEDRON, 8) }, by, false);
  setN(mesh, rough);
  return mesh;
}

std::vector<CellTree::Bounds> someBoxes(int count, double low, double high)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(low, high);
  std::vector<CellTree::Bounds> some;
  for (int i = 0; i < count; ++i)
  {
    CellTree::Bounds box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double a = place(random), b = place(random);
      box.low[axis] = std::min(a, b);
      box.high[axis] = std::max(a, b);
    }
    some.push_back(box);
  }
  return some;
}

bool meet(const CellTree::Bounds& box, vtkDataSet* data, vtkIdType cell, double more)
{
  double bounds[6];
  data->GetCellBounds(cell, bounds);
  bool doMeet = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    doMeet = doMeet && bounds[2 * axis] <= box.high[axis] + more &&
      bounds[2 * axis + 1] >= box.low[axis] - more;
  }
  return doMeet;
}

/// Lowest and highest value at the points of cells that meet a box.
std::array<double, 2> rangeIn(vtkDataSet* data, const CellTree::Bounds& box)
{
  std::array<double, 2> range = { HUGE_VAL, -HUGE_VAL };
  vtkDataArray* values = data->GetPointData()->GetScalars();
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (meet(box, data, cell, 0))
    {
      vtkNew<vtkIdList> points;
      data->GetCellPoints(cell, points);
      for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
      {
        const double value = values->GetComponent(points->GetId(i), 0);
        range = { std::min(range[0], value), std::max(range[1], value) };
      }
    }
  }
  return range;
}

/// Boxes of one size, turned around z.
vtkSmartPointer<vtkStructuredGrid> turnedBoxes(const Vec& size, double degrees)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(11, 11, 11);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  for (int k = 0; k < 11; ++k)
  {
    for (int j = 0; j < 11; ++j)
    {
      for (int i = 0; i < 11; ++i)
      {
        const double x = i * size[0], y = j * size[1];
        points->InsertNextPoint(c * x - s * y, s * x + c * y, k * size[2]);
      }
    }
  }
  grid->SetPoints(points);
  setN(grid, rough);
  return grid;
}

} // namespace

TEST(CellTree, NeedsLittleMemory)
{
  const auto grid = turnedBoxes({ 1, 1, 1 }, 30);
  for (const auto& [reconstruction, most] : { std::pair(CellTree::Reconstruction::Linear, 40u),
         std::pair(CellTree::Reconstruction::Smooth, 68u) })
  {
    const CellTree tree({ grid }, reconstruction);
    EXPECT_LT(tree.bytes(), most * tree.size());
    EXPECT_GT(tree.bytes(), 28 * tree.size());
  }
}

// Cells that are hidden, that lie nowhere or have no value do not count.
TEST(CellTree, HasOnlyCellsThatHoldGas)
{
  const double nan = std::nan("");
  const Mesh mesh = hexahedra(3, 0);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(27);
  ghosts->FillValue(0);
  ghosts->SetValue(0, vtkDataSetAttributes::REFINEDCELL);
  ghosts->SetValue(1, vtkDataSetAttributes::DUPLICATECELL); // which is seen
  mesh->GetCellData()->AddArray(ghosts);
  vtkNew<vtkIdList> points;
  mesh->GetCellPoints(26, points);
  const vtkIdType corner = points->GetId(6); // of this cell alone
  for (const double bad : { nan, HUGE_VAL })
  {
    setN(mesh, rough);
    EXPECT_EQ(CellTree({ mesh }).size(), 26u);
    mesh->GetPointData()->GetScalars()->SetComponent(corner, 0, bad);
    EXPECT_EQ(CellTree({ mesh }).size(), 25u);
    setN(mesh, rough);
    mesh->GetPoints()->SetPoint(corner, 1, bad, 1);
    const CellTree tree({ mesh });
    EXPECT_EQ(tree.size(), 25u);
    EXPECT_EQ(tree.bounds().high[1], 1);
    mesh->GetPoints()->SetPoint(corner, 1, 1, 1);
  }
}

// That of the cells whose bounds meet it, and of no others.
TEST(CellTree, KnowsTheRangeInABox)
{
  const Mesh mesh = hexahedra(9, 0.1);
  const CellTree tree({ mesh });
  for (const CellTree::Bounds& box : someBoxes(100, -0.2, 1.2))
  {
    const CellTree::Content content = tree.content(box);
    EXPECT_EQ((std::array<double, 2>{ content.lowest, content.highest }), rangeIn(mesh, box));
  }
  const CellTree::Content nothing = tree.content({ { 1.01, 0, 0 }, { 2, 1, 1 } });
  EXPECT_GT(nothing.lowest, nothing.highest);
}

// Of a mesh of more cells than are measured, in one tree and in two.
TEST(CellTree, MeasuresTheSameCellsInParts)
{
  const auto gridOf = [](int first, int last)
  {
    auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
    grid->SetExtent(first, last, 0, 50, 0, 40);
    const auto coordinates = [](int begin, int end, double power)
    {
      vtkNew<vtkDoubleArray> values;
      for (int i = begin; i <= end; ++i)
      {
        values->InsertNextValue(std::pow(i / 60., power));
      }
      return vtkSmartPointer<vtkDoubleArray>(values);
    };
    grid->SetXCoordinates(coordinates(first, last, 2));
    grid->SetYCoordinates(coordinates(0, 50, 1.4));
    grid->SetZCoordinates(coordinates(0, 40, 1));
    setN(grid, rough);
    return grid;
  };
  const auto whole = gridOf(0, 60);
  const CellTree tree({ whole });
  std::vector<CellTree::MeasuredCell> cells;
  for (const auto& part : { gridOf(0, 23), gridOf(23, 60) })
  {
    const auto some = CellTree({ part }).measuredCells(whole->GetNumberOfCells());
    cells.insert(cells.end(), some.begin(), some.end());
  }
  EXPECT_LT(cells.size(), static_cast<std::size_t>(whole->GetNumberOfCells()));
  EXPECT_EQ(CellTree::voxelShapeOf(cells), tree.voxelShape());
  // A tenth of the cells are smaller: their sizes are (i + 1)^2 - i^2, ..., in units of the grid.
  EXPECT_NEAR(tree.voxelShape()[0], (2 * 6 + 1) / 60., 2.1 / 60);
}

TEST(CellTree, ProposesVoxelsOfTheCellsShape)
{
  const auto shapeOf = [](const Vec& size, double degrees)
  {
    const auto grid = turnedBoxes(size, degrees);
    return CellTree({ grid }).voxelShape();
  };
  EXPECT_EQ(shapeOf({ 1, 1, 1 }, 0), (Vec{ 1, 1, 1 }));
  EXPECT_EQ(shapeOf({ 1, 0.9, 1.2 }, 0), (Vec{ 1, 1, 1 }));
  EXPECT_EQ(shapeOf({ 1, 0.001, 1 }, 0), (Vec{ 1, 1. / 32, 1 }));
  const Vec flat = shapeOf({ 1, 0.1, 1 }, 0);
  EXPECT_EQ(flat[0], 1);
  EXPECT_NEAR(flat[1], 0.1, 1e-9);
  EXPECT_EQ(shapeOf({ 0.1, 1, 1 }, 45)[0], shapeOf({ 0.1, 1, 1 }, 45)[1]);
}

// Around a cylinder no axis is preferred, but the cylinder's own.
TEST(CellTree, ProposesCubesForOGrids)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(30, 73, 5);
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 5; ++k)
  {
    for (int j = 0; j < 73; ++j)
    {
      for (int i = 0; i < 30; ++i)
      {
        const double r = std::pow(1.1, i), angle = 2 * pi * (j % 72) / 72;
        points->InsertNextPoint(r * std::cos(angle), r * std::sin(angle), k);
      }
    }
  }
  grid->SetPoints(points);
  setN(grid, rough);
  const Vec shape = CellTree({ grid }).voxelShape();
  EXPECT_EQ(shape[0], shape[1]);
  EXPECT_LT(shape[0], 0.2);
  EXPECT_EQ(shape[2], 1);
}
