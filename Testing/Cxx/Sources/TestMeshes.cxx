// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every kind of mesh, resampled: the deflection of a Gaussian column against the closed form. The cells are
// moved off the grid's planes, so that points of the grid lie inside them.
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkLagrangeHexahedron.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkTypeInt8Array.h"
#include "vtkUnstructuredGrid.h"

namespace
{

/// Half the length of the meshes along the column.
constexpr double half = 0.1;

/// Coordinates 0...n between -1 and 1, closer together in the middle, where the column is; equally spaced
/// within a cell.
double coordinate(int i, int n, int order = 1)
{
  const auto graded = [n](int corner)
  {
    const double s = 2. * corner / n - 1;
    return 0.6 * s + 0.4 * s * s * s;
  };
  const int first = i - i % order;
  return graded(first) + (graded(first + order) - graded(first)) * (i - first) / order;
}

/// A mesh of (n / order)^3 blocks of (order + 1)^3 points each, out of which `make` forms cells:
/// make(grid, point(i, j, k)) with 0 <= i, j, k <= order.
template <class Make>
vtkSmartPointer<vtkUnstructuredGrid> meshOf(int n, int order, const Make& make)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  // Along the column one cell is enough.
  const int along = order;
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= along; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        points->InsertNextPoint(
          coordinate(i, n, order), half * (2. * j / along - 1), coordinate(k, n, order));
      }
    }
  }
  grid->SetPoints(points);
  grid->Allocate(n * n);
  for (int k = 0; k < n; k += order)
  {
    for (int j = 0; j < along; j += order)
    {
      for (int i = 0; i < n; i += order)
      {
        make(grid.Get(),
          [=](int a, int b, int c)
          { return (static_cast<vtkIdType>(k + c) * (along + 1) + j + b) * (n + 1) + i + a; });
      }
    }
  }
  addPointArray(grid, "N", GaussianColumn());
  return grid;
}

using Point = std::function<vtkIdType(int, int, int)>;
using Ids = std::vector<vtkIdType>;

void insert(vtkUnstructuredGrid* grid, int type, const Ids& ids)
{
  grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
}

Ids corners(const Point& p, int e)
{
  return { p(0, 0, 0), p(e, 0, 0), p(e, e, 0), p(0, e, 0), p(0, 0, e), p(e, 0, e), p(e, e, e),
    p(0, e, e) };
}

void hexahedron(vtkUnstructuredGrid* grid, const Point& p)
{
  insert(grid, VTK_HEXAHEDRON, corners(p, 1));
}

void wedges(vtkUnstructuredGrid* grid, const Point& p)
{
  const Ids c = corners(p, 1);
  insert(grid, VTK_WEDGE, { c[0], c[2], c[1], c[4], c[6], c[5] });
  insert(grid, VTK_WEDGE, { c[0], c[3], c[2], c[4], c[7], c[6] });
}

/// Three pyramids with their tops in the corner 6.
void pyramids(vtkUnstructuredGrid* grid, const Point& p)
{
  const Ids c = corners(p, 1);
  insert(grid, VTK_PYRAMID, { c[0], c[1], c[2], c[3], c[6] });
  insert(grid, VTK_PYRAMID, { c[0], c[4], c[5], c[1], c[6] });
  insert(grid, VTK_PYRAMID, { c[0], c[3], c[7], c[4], c[6] });
}

void polyhedron(vtkUnstructuredGrid* grid, const Point& p)
{
  const Ids c = corners(p, 1);
  const int faces[6][4] = { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 2, 3, 7, 6 },
    { 0, 4, 7, 3 }, { 1, 2, 6, 5 } };
  vtkNew<vtkIdList> stream;
  stream->InsertNextId(6);
  for (const auto& face : faces)
  {
    stream->InsertNextId(4);
    for (const int corner : face)
    {
      stream->InsertNextId(c[static_cast<std::size_t>(corner)]);
    }
  }
  grid->InsertNextCell(VTK_POLYHEDRON, stream);
}

void quadraticHexahedron(vtkUnstructuredGrid* grid, const Point& p)
{
  Ids ids = corners(p, 2);
  for (const Ids& middles : { Ids{ p(1, 0, 0), p(2, 1, 0), p(1, 2, 0), p(0, 1, 0) },
         Ids{ p(1, 0, 2), p(2, 1, 2), p(1, 2, 2), p(0, 1, 2) },
         Ids{ p(0, 0, 1), p(2, 0, 1), p(2, 2, 1), p(0, 2, 1) } })
  {
    ids.insert(ids.end(), middles.begin(), middles.end());
  }
  insert(grid, VTK_QUADRATIC_HEXAHEDRON, ids);
}

/// Six around the diagonal from corner 0 to corner 6.
void quadraticTetrahedra(vtkUnstructuredGrid* grid, const Point& p)
{
  using Place = std::array<int, 3>;
  const Place ways[6] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 1, 0, 2 }, { 0, 2, 1 },
    { 2, 1, 0 } };
  for (int way = 0; way < 6; ++way)
  {
    Place at[4] = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 2, 2, 2 } };
    at[1][static_cast<std::size_t>(ways[way][0])] = 2;
    at[2] = at[1];
    at[2][static_cast<std::size_t>(ways[way][1])] = 2;
    if (way >= 3)
    {
      std::swap(at[1], at[2]); // keeps the volume positive
    }
    const auto middle = [&](int a, int b)
    { return p((at[a][0] + at[b][0]) / 2, (at[a][1] + at[b][1]) / 2, (at[a][2] + at[b][2]) / 2); };
    insert(grid, VTK_QUADRATIC_TETRA,
      { middle(0, 0), middle(1, 1), middle(2, 2), middle(3, 3), middle(0, 1), middle(1, 2),
        middle(0, 2), middle(0, 3), middle(1, 3), middle(2, 3) });
  }
}

void cubicHexahedron(vtkUnstructuredGrid* grid, const Point& p)
{
  const int order[4] = { 3, 3, 3, 64 };
  Ids ids(64);
  for (int c = 0; c <= 3; ++c)
  {
    for (int b = 0; b <= 3; ++b)
    {
      for (int a = 0; a <= 3; ++a)
      {
        ids[static_cast<std::size_t>(vtkLagrangeHexahedron::PointIndexFromIJK(a, b, c, order))] =
          p(a, b, c);
      }
    }
  }
  insert(grid, VTK_LAGRANGE_HEXAHEDRON, ids);
}

vtkSmartPointer<vtkDataObject> tetrahedra()
{
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->SetInputData(meshOf(192, 1, hexahedron));
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkDataObject> structured(int first = 0, int last = 192)
{
  auto hexahedra = meshOf(192, 1, hexahedron);
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(last - first + 1, 2, 193);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < hexahedra->GetNumberOfPoints(); ++i)
  {
    const vtkIdType column = i % 193;
    if (column >= first && column <= last)
    {
      points->InsertNextPoint(hexahedra->GetPoint(i));
    }
  }
  grid->SetPoints(points);
  addPointArray(grid, "N", GaussianColumn());
  return grid;
}

vtkSmartPointer<vtkDataObject> rectilinear()
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(193, 2, 193);
  vtkNew<vtkDoubleArray> across, along;
  for (int i = 0; i <= 192; ++i)
  {
    across->InsertNextValue(coordinate(i, 192));
  }
  for (int i = 0; i <= 1; ++i)
  {
    along->InsertNextValue(half * (2 * i - 1));
  }
  grid->SetXCoordinates(across);
  grid->SetYCoordinates(along);
  grid->SetZCoordinates(across);
  addPointArray(grid, "N", GaussianColumn());
  return grid;
}

vtkSmartPointer<vtkDataObject> collection()
{
  auto blocks = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  blocks->SetPartition(0, 0, structured(0, 80));
  blocks->SetPartition(0, 1, structured(80, 120));
  blocks->SetPartition(1, 0, structured(120, 192));
  return blocks;
}

struct Mesh
{
  std::string name;
  std::function<vtkSmartPointer<vtkDataObject>()> make;
};

class Meshes : public testing::TestWithParam<Mesh>
{
};

} // namespace

TEST_P(Meshes, DeflectionMatchesTheClosedForm)
{
  auto filter = bench(GetParam().make());
  filter->FaceFlatDataOff(); // some are one cell thick
  filter->SetImageSize(64, 4);
  filter->SetParallelScale(0.9 * 4 / 64);
  filter->Update();
  const ColumnErrors errors = compareWithColumn(filter, GaussianColumn());
  EXPECT_LT(errors.deflection, 4e-3);
  EXPECT_LT(errors.opticalPath, 4e-3);
  EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
}

INSTANTIATE_TEST_SUITE_P(Inputs, Meshes,
  testing::Values(Mesh{ "Hexahedra", [] { return meshOf(192, 1, hexahedron); } },
    Mesh{ "Tetrahedra", tetrahedra }, Mesh{ "Wedges", [] { return meshOf(192, 1, wedges); } },
    Mesh{ "Pyramids", [] { return meshOf(192, 1, pyramids); } },
    Mesh{ "Polyhedra", [] { return meshOf(192, 1, polyhedron); } },
    Mesh{ "QuadraticHexahedra", [] { return meshOf(96, 2, quadraticHexahedron); } },
    Mesh{ "QuadraticTetrahedra", [] { return meshOf(64, 2, quadraticTetrahedra); } },
    Mesh{ "CubicHexahedra", [] { return meshOf(60, 3, cubicHexahedron); } },
    Mesh{ "Structured", [] { return structured(); } }, Mesh{ "Rectilinear", rectilinear },
    Mesh{ "Collection", collection }),
  [](const auto& tested) { return tested.param.name; });

// Spacings of 1:1000, chosen from the cells: a domain a thousandth as deep as it is wide.
TEST(Extremes, ThinDomainsAreSampledAsFinelyAsTheirCells)
{
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(65, 65, 65);
  vtkNew<vtkDoubleArray> across, through;
  for (int i = 0; i <= 64; ++i)
  {
    across->InsertNextValue(i / 32. - 1);
    through->InsertNextValue((i / 32. - 1) * 1e-3);
  }
  grid->SetXCoordinates(across);
  grid->SetYCoordinates(across);
  grid->SetZCoordinates(through);
  addPointArray(grid, "N",
    [](const Vec& x) {
      return GaussianColumn()({ x[0], x[1], x[2] * 1000 });
    });
  auto filter = bench(grid);
  filter->SetParallelScale(0.9);
  filter->Update();
  // The same column, seen through a thousandth of its depth.
  const GaussianColumn column;
  auto* output = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  std::vector<double> deflection;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    deflection.push_back(column.deflection(output->GetPoint(i)[0]) * 1e-3);
    deflection.push_back(0);
  }
  EXPECT_LT(relativeDifference(valuesOf(filter, "Deflection"), deflection), 3e-3);
  // Not of voxels that are as long across as through.
  EXPECT_LT(fieldValue(filter, "SmallestVoxel"), 2e-3 / 10);
  EXPECT_LT(fieldValue(filter, "MediumVoxels"), 4e6);
}

// Cells of 1:100 towards a wall, with a layer of 20 of the smallest: within 7 % on the chosen grid. Cubic
// voxels, as many as points, are off by 96 %.
TEST(Extremes, LayersAtWallsAreSampledAsFinelyAsTheirCells)
{
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(33, 65, 33);
  vtkNew<vtkDoubleArray> across, up;
  double y = 0, size = 1;
  for (int i = 0; i < 65; ++i)
  {
    up->InsertNextValue(y);
    y += size;
    size *= std::pow(100, 1. / 63);
  }
  for (int i = 0; i < 65; ++i)
  {
    up->SetValue(i, up->GetValue(i) / up->GetValue(64));
  }
  for (int i = 0; i < 33; ++i)
  {
    across->InsertNextValue(i / 32.);
  }
  grid->SetXCoordinates(across);
  grid->SetYCoordinates(up);
  grid->SetZCoordinates(across);
  const double width = 20 * up->GetValue(1);
  const auto layer = [width](double at) { return 1e-6 * std::exp(-at * at / (width * width)); };
  addPointArray(grid, "N", [&](const Vec& x) { return layer(x[1]); });
  auto filter = bench(grid, 128);
  filter->SetFocalPoint(0.5, 2 * width, 0.5);
  filter->SetParallelScale(2 * width);
  filter->Update();
  auto* output = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  std::vector<double> deflection;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double at = output->GetPoint(i)[1];
    deflection.push_back(0);
    deflection.push_back(-2 * at / (width * width) * layer(at));
  }
  EXPECT_LT(relativeDifference(valuesOf(filter, "Deflection"), deflection), 0.07);
}
