// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of higher order: what is interpolated in them, and which of their faces bound a mesh.
#include "CellMeshes.h"

#include "LagrangeProduct.h"
#include "MeshFaces.h"

#include "vtkCellData.h"

#include <random>

using filters::Faces;
using filters::LagrangeProduct;

namespace
{

/// One Lagrange cell of these orders; its points do not matter.
Mesh lagrangeCell(int type, std::array<int, 3> orders)
{
  auto mesh = Mesh::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdList> ids;
  const int count =
    (orders[0] + 1) * (orders[1] + 1) * (type == VTK_LAGRANGE_HEXAHEDRON ? orders[2] + 1 : 1);
  for (int i = 0; i < count; ++i)
  {
    ids->InsertNextId(points->InsertNextPoint(0, 0, 0));
  }
  mesh->SetPoints(points);
  mesh->InsertNextCell(type, ids);
  vtkNew<vtkDoubleArray> degrees;
  degrees->SetNumberOfComponents(3);
  degrees->InsertNextTuple3(orders[0], orders[1], orders[2]);
  mesh->GetCellData()->SetHigherOrderDegrees(degrees);
  return mesh;
}

/// The same cells, each with points of its own.
Mesh withOwnPoints(vtkUnstructuredGrid* mesh)
{
  auto result = Mesh::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    mesh->GetCellPoints(cell, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      ids->SetId(i, points->InsertNextPoint(mesh->GetPoint(ids->GetId(i))));
    }
    result->InsertNextCell(mesh->GetCellType(cell), ids);
  }
  result->SetPoints(points);
  addPointArray(result, "N", linear);
  return result;
}

Faces facesOf(vtkDataSet* mesh)
{
  mesh->GetPointData()->SetActiveScalars("N");
  return filters::facesOf({ mesh }, filters::WorkProgress());
}

/// How far a place is from the faces of the unit cube.
double toCube(const Vec& x)
{
  double least = HUGE_VAL;
  for (const double along : x)
  {
    least = std::min({ least, std::abs(along), std::abs(along - 1) });
  }
  return least;
}

} // namespace

// Against VTK's functions, of orders that differ from axis to axis, inside of cells and outside.
TEST(CurvedCells, LagrangeProductsAreThoseOfVtk)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.3, 1.3);
  for (const std::array<int, 3>& orders : std::vector<std::array<int, 3>>{
         { 1, 1, 1 }, { 2, 2, 2 }, { 3, 3, 3 }, { 2, 4, 3 }, { 1, 5, 2 }, { 7, 7, 7 } })
  {
    for (const int type : { VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_QUADRILATERAL })
    {
      const Mesh mesh = lagrangeCell(type, orders);
      vtkNew<vtkGenericCell> cell;
      mesh->GetCell(0, cell);
      const auto count = static_cast<std::size_t>(cell->GetNumberOfPoints());
      const std::size_t dimension = type == VTK_LAGRANGE_HEXAHEDRON ? 3 : 2;
      std::vector<Vec> points(count);
      for (Vec& point : points)
      {
        point = { any(random), any(random), any(random) };
      }
      LagrangeProduct product;
      ASSERT_TRUE(product.set(cell));
      for (int n = 0; n < 20; ++n)
      {
        const double place[3] = { any(random), any(random), dimension == 3 ? any(random) : 0 };
        std::vector<double> weights(count), slopes(3 * count), ours(count);
        cell->InterpolateFunctions(place, weights.data());
        cell->InterpolateDerivs(place, slopes.data());
        product.weights(place, ours.data());
        Vec sum, derivatives[3];
        product.evaluate(place, points, sum, derivatives);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          double expected = 0, scale = 0;
          for (std::size_t i = 0; i < count; ++i)
          {
            ASSERT_NEAR(ours[i], weights[i], 1e-12 * (1 + std::abs(weights[i])));
            expected += weights[i] * points[i][axis];
            scale += std::abs(weights[i]);
          }
          EXPECT_NEAR(sum[axis], expected, 1e-13 * scale);
          for (std::size_t along = 0; along < dimension; ++along)
          {
            double slope = 0, size = 0;
            for (std::size_t i = 0; i < count; ++i)
            {
              slope += slopes[i * dimension + along] * points[i][axis];
              size += std::abs(slopes[i * dimension + along]);
            }
            EXPECT_NEAR(derivatives[along][axis], slope, 1e-12 * size);
          }
        }
      }
    }
  }
}

TEST(CurvedCells, OtherCellsAreNoLagrangeProducts)
{
  vtkNew<vtkGenericCell> cell;
  LagrangeProduct product;
  for (const int type : { VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, VTK_LAGRANGE_TETRAHEDRON })
  {
    cell->SetCellType(type);
    EXPECT_FALSE(product.set(cell)) << type;
  }
}

// n^3 cells: the faces of the cube are all that is left, with cells that share points and with cells that do not.
TEST(CurvedCells, FacesWithinAMeshAreNoBoundary)
{
  constexpr int n = 3;
  struct Kind
  {
    int type, points, partsOfFace;
  };
  for (const Kind& kind : { Kind{ VTK_TRIQUADRATIC_HEXAHEDRON, 27, 16 },
         Kind{ VTK_QUADRATIC_HEXAHEDRON, 20, 16 }, Kind{ VTK_LAGRANGE_HEXAHEDRON, 64, 16 } })
  {
    const Mesh mesh = meshOf(kind.type, n, { unitCell(kind.type, kind.points) }, 0.1, false);
    for (const Mesh& one : { mesh, withOwnPoints(mesh) })
    {
      const Faces faces = facesOf(one);
      EXPECT_EQ(faces.size(), static_cast<std::size_t>(6 * n * n * kind.partsOfFace));
      for (std::size_t i = 0; i < faces.points.size(); ++i)
      {
        EXPECT_LT(toCube(faces.points[i]), 1e-12);
        double value = 0;
        for (std::size_t k = faces.firstContributions[i]; k < faces.firstContributions[i + 1]; ++k)
        {
          value += faces.contributions[k].weight *
            one->GetPointData()->GetArray("N")->GetComponent(faces.contributions[k].point, 0);
        }
        EXPECT_NEAR(value, linear(faces.points[i]), 1e-13);
      }
    }
  }
}

// Faces that differ between their corners are two, whatever their corners are.
TEST(CurvedCells, FacesWithAGapBetweenThemAreTwo)
{
  Mesh mesh = withOwnPoints(meshOf(
    VTK_TRIQUADRATIC_HEXAHEDRON, 2, { unitCell(VTK_TRIQUADRATIC_HEXAHEDRON, 27) }, 0, false));
  const std::size_t closed = facesOf(mesh).size();
  for (vtkIdType i = 0; i < 27; ++i) // of the first cell
  {
    double x[3];
    mesh->GetPoint(i, x);
    if (x[0] == 0.5 && x[1] == 0.25 && x[2] == 0.25)
    {
      x[0] = 0.45;
      mesh->GetPoints()->SetPoint(i, x);
    }
  }
  EXPECT_EQ(facesOf(mesh).size(), closed + 2 * 16);
}

// Parts of a tetrahedron's faces cover them once: their areas add up.
TEST(CurvedCells, PartsOfTrianglesCoverThem)
{
  const Mesh mesh = meshOf(VTK_QUADRATIC_TETRA, 1, { unitCell(VTK_QUADRATIC_TETRA, 10) }, 0, false);
  const Faces faces = facesOf(mesh);
  ASSERT_EQ(faces.size(), 4u * 16);
  double area = 0;
  for (std::size_t face = 0; face < faces.size(); ++face)
  {
    ASSERT_EQ(faces.starts[face + 1] - faces.starts[face], 3u);
    const auto corner = [&](std::size_t i)
    { return faces.points[static_cast<std::size_t>(faces.corners[faces.starts[face] + i])]; };
    using filters::operator-;
    area += 0.5 * filters::norm(cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  EXPECT_NEAR(area, 1.5 + std::sqrt(3.) / 2, 1e-12);
}
