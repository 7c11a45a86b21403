// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of higher order: what is interpolated in them, and which of their faces bound a mesh.
#include "CellMeshes.h"

#include "Cells/CellSampler.h"
#include "Cells/MeshCell.h"
#include "Cells/PlacesInPart.h"
#include "Walls/MeshFaces.h"

#include "vtkCellData.h"

#include <random>

using filters::Faces;

namespace
{

/// One cell with so many points, all at the origin. `orders`: of those that may differ from axis to axis; 0: of others.
Mesh curvedCell(int type, int count, std::array<int, 3> orders = { 0, 0, 0 })
{
  auto mesh = Mesh::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdList> ids;
  for (int i = 0; i < count; ++i)
  {
    ids->InsertNextId(points->InsertNextPoint(0, 0, 0));
  }
  mesh->SetPoints(points);
  mesh->InsertNextCell(type, ids);
  if (orders[0] > 0)
  {
    vtkNew<vtkDoubleArray> degrees;
    degrees->SetNumberOfComponents(3);
    degrees->InsertNextTuple3(orders[0], orders[1], orders[2]);
    mesh->GetCellData()->SetHigherOrderDegrees(degrees);
  }
  return mesh;
}

/// Calls act(index, powers of u, v, w) for the terms of a part's polynomials.
template <class Act>
void forTerms(const filters::CurvedPart& part, const Act& act)
{
  for (int i = 0; i <= part.orders[0]; ++i)
  {
    for (int j = 0; j <= part.orders[1]; ++j)
    {
      for (int k = 0; k <= part.orders[2]; ++k)
      {
        const int sum = i + (part.reference == filters::Reference::Box ? 0 : j) +
          (part.reference == filters::Reference::Simplex ? k : 0);
        if (sum <= part.orders[0])
        {
          const int term = (i * (part.orders[1] + 1) + j) * (part.orders[2] + 1) + k;
          act(static_cast<std::size_t>(term), std::array<int, 3>{ i, j, k });
        }
      }
    }
  }
}

/// x, y, z and the value at a place in a part, term by term.
std::array<double, 4> sumAt(const filters::CurvedPart& part, const Vec& at)
{
  std::array<double, 4> sum{};
  forTerms(part,
    [&](std::size_t term, const std::array<int, 3>& powers)
    {
      for (std::size_t of = 0; of < 4; ++of)
      {
        sum[of] += part.coefficients[4 * term + of] * std::pow(at[0], powers[0]) *
          std::pow(at[1], powers[1]) * std::pow(at[2], powers[2]);
      }
    });
  return sum;
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

// Places that a cell's own functions map somewhere are found there again, those of rational weights, too, with the value of a
// linear field; and others are not found.
TEST(CurvedCells, SlightlyBentOnesAreInverted)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, 1), moved(-0.05, 0.05);
  struct Kind
  {
    int type, points;
    std::array<int, 3> orders;
    bool isRational;
  };
  constexpr std::array<int, 3> usual = { 0, 0, 0 };
  for (const Kind& kind :
    std::vector<Kind>{ { VTK_LAGRANGE_HEXAHEDRON, 8, { 1, 1, 1 }, false },
      { VTK_LAGRANGE_HEXAHEDRON, 60, { 2, 4, 3 }, false },
      { VTK_LAGRANGE_TETRAHEDRON, 10, usual, false },
      { VTK_LAGRANGE_TETRAHEDRON, 35, usual, false },
      { VTK_LAGRANGE_WEDGE, 18, { 2, 2, 2 }, false },
      { VTK_LAGRANGE_WEDGE, 40, { 3, 3, 3 }, false }, { VTK_QUADRATIC_TETRA, 10, usual, false },
      { VTK_TRIQUADRATIC_HEXAHEDRON, 27, usual, false },
      { VTK_QUADRATIC_PYRAMID, 13, usual, false },
      { VTK_BEZIER_HEXAHEDRON, 27, { 2, 2, 2 }, false },
      { VTK_BEZIER_HEXAHEDRON, 27, { 2, 2, 2 }, true },
      { VTK_BEZIER_TETRAHEDRON, 20, usual, false }, { VTK_BEZIER_TETRAHEDRON, 20, usual, true },
      { VTK_BEZIER_WEDGE, 18, { 2, 2, 2 }, false }, { VTK_BEZIER_WEDGE, 40, { 3, 3, 3 }, true } })
  {
    SCOPED_TRACE(std::to_string(kind.type) + " " + std::to_string(kind.points));
    const Mesh mesh = curvedCell(kind.type, kind.points, kind.orders);
    vtkNew<vtkGenericCell> cell;
    mesh->GetCell(0, cell);
    const double* corners = cell->GetParametricCoords();
    for (vtkIdType i = 0; i < kind.points; ++i)
    {
      mesh->GetPoints()->SetPoint(i, corners[3 * i] + moved(random),
        corners[3 * i + 1] + moved(random), corners[3 * i + 2] + moved(random));
    }
    if (kind.isRational)
    {
      vtkNew<vtkDoubleArray> weights;
      for (int i = 0; i < kind.points; ++i)
      {
        weights->InsertNextValue(1 + any(random));
      }
      mesh->GetPointData()->SetRationalWeights(weights);
    }
    addPointArray(mesh, "N", linear);
    const auto count = static_cast<std::size_t>(kind.points);
    std::vector<double> values(count), functions(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = mesh->GetPointData()->GetArray("N")->GetComponent(static_cast<vtkIdType>(i), 0);
    }
    mesh->GetCell(0, cell);
    filters::MeshCell own;
    own.set(mesh, 0);
    for (int n = 0; n < 100; ++n)
    {
      // Within tetrahedra, wedges and pyramids, too.
      const double place[3] = { 0.33 * any(random), 0.33 * any(random), 0.33 * any(random) };
      cell->InterpolateFunctions(place, functions.data());
      Vec x{ 0, 0, 0 };
      for (std::size_t i = 0; i < count; ++i)
      {
        const double* point = mesh->GetPoint(static_cast<vtkIdType>(i));
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          x[axis] += functions[i] * point[axis];
        }
      }
      double found[3], outside = 0;
      ASSERT_TRUE(own.find(x.data(), found, outside)) << n;
      EXPECT_NEAR(own.valueAt(x.data(), found, values.data()), linear(x), 1e-9);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(found[axis], place[axis], 1e-5);
      }
      x[2] += 2;
      EXPECT_FALSE(own.find(x.data(), found, outside));
    }
  }
}

// Every place to which a cell maps is found there again, however much it is distorted and folded, and the field, which is
// linear, is right at all that are found.
TEST(CurvedCells, DistortedCellsAreInvertedEverywhere)
{
  struct Kind
  {
    int type, points;
  };
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 1), around(-1, 1);
  for (const Kind& kind : { Kind{ VTK_QUADRATIC_PYRAMID, 13 }, Kind{ VTK_QUADRATIC_HEXAHEDRON, 20 },
         Kind{ VTK_TRIQUADRATIC_HEXAHEDRON, 27 }, Kind{ VTK_QUADRATIC_WEDGE, 15 },
         Kind{ VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18 }, Kind{ VTK_QUADRATIC_TETRA, 10 },
         Kind{ VTK_LAGRANGE_HEXAHEDRON, 64 }, Kind{ VTK_LAGRANGE_TETRAHEDRON, 20 },
         Kind{ VTK_LAGRANGE_WEDGE, 18 }, Kind{ VTK_BEZIER_HEXAHEDRON, 27 } })
  {
    for (const double distortion : { 0.05, 0.2, 0.5 })
    {
      SCOPED_TRACE(std::to_string(kind.type) + " by " + std::to_string(distortion));
      auto mesh = Mesh::New();
      vtkNew<vtkPoints> points;
      points->SetDataTypeToDouble();
      vtkNew<vtkIdList> ids;
      for (const Vec& x : unitCell(kind.type, kind.points))
      {
        ids->InsertNextId(points->InsertNextPoint(x[0] + distortion * around(random),
          x[1] + distortion * around(random), x[2] + distortion * around(random)));
      }
      mesh->InsertNextCell(kind.type, ids);
      mesh->SetPoints(points);
      addPointArray(mesh, "N", linear);
      mesh->GetPointData()->SetActiveScalars("N");
      vtkNew<vtkGenericCell> cell;
      mesh->GetCell(0, cell);
      const filters::CellTree tree({ mesh });
      const filters::CellSampler sampler(tree);
      std::vector<double> weights(static_cast<std::size_t>(kind.points));
      int lost = 0, tried = 0;
      for (int n = 0; n < 1000; ++n)
      {
        double place[3] = { any(random), any(random), any(random) };
        const bool isWedge = kind.type == VTK_QUADRATIC_WEDGE ||
          kind.type == VTK_BIQUADRATIC_QUADRATIC_WEDGE || kind.type == VTK_LAGRANGE_WEDGE;
        const bool isTetrahedron =
          kind.type == VTK_QUADRATIC_TETRA || kind.type == VTK_LAGRANGE_TETRAHEDRON;
        if (place[0] + place[1] + (isTetrahedron ? place[2] : 0) > 1 && (isWedge || isTetrahedron))
        {
          continue;
        }
        cell->InterpolateFunctions(place, weights.data());
        Vec x{ 0, 0, 0 };
        bool isInBox = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          for (vtkIdType i = 0; i < kind.points; ++i)
          {
            x[axis] += weights[static_cast<std::size_t>(i)] * points->GetPoint(i)[axis];
          }
          isInBox =
            isInBox && x[axis] > tree.bounds().low[axis] && x[axis] < tree.bounds().high[axis];
        }
        if (!isInBox)
        {
          continue;
        }
        double value = 0;
        unsigned char found = 0;
        sampler.sample({ x, { 1, 1, 1 }, { 1, 1, 1 } }, &value, &found);
        ++tried;
        lost += found ? 0 : 1;
        if (found)
        {
          ASSERT_NEAR(value, linear(x), 1e-10);
        }
      }
      EXPECT_GT(tried, 100);
      EXPECT_LE(lost, 3);
      if (distortion < 0.1)
      {
        EXPECT_EQ(lost, 0);
      }
    }
  }
}

// Places whose coordinates and values are known are found in a part, whatever instructions are used.
TEST(CurvedCells, AllInstructionsFindPlacesInParts)
{
  constexpr int count = 93; // no multiple of any pack
  std::mt19937 random(7);
  std::uniform_real_distribution<double> around(-1, 1);
  const auto all = filters::functionsToLocateInPart();
  ASSERT_GE(all.size(), 1u);
  for (const filters::CurvedPart& kind :
    { filters::CurvedPart{ filters::Reference::Box, { 2, 4, 1 }, nullptr, { 0.75, 0.5, 0.125 },
        { 0.25, 0.5, 0.125 }, true, 1e-3 },
      filters::CurvedPart{ filters::Reference::Wedge, { 3, 3, 2 }, nullptr, { 0.5, 0.25, 0.5 },
        { 0.25, 0.25, 0.5 }, true, 1e-3 },
      filters::CurvedPart{ filters::Reference::Simplex, { 4, 4, 4 }, nullptr, { 0.25, 0.25, 0.5 },
        { 0.25, 0.25, 0.25 }, true, 1e-3 } })
  {
    filters::CurvedPart part = kind;
    std::vector<double> coefficients(500);
    forTerms(part,
      [&](std::size_t term, const std::array<int, 3>& powers)
      {
        const bool isLinear = powers[0] + powers[1] + powers[2] == 1;
        for (std::size_t of = 0; of < 4; ++of)
        {
          const bool isOwn = isLinear && of < 3 && powers[of] == 1;
          coefficients[4 * term + of] = (isOwn ? 1 : 0) + (of == 3 ? 1 : 0.01) * around(random);
        }
      });
    part.coefficients = coefficients.data();
    filters::CellPoints points;
    double values[count], misses[count];
    for (int i = 0; i < filters::CellPoints::room; ++i)
    {
      const Vec at = { around(random), around(random), around(random) };
      const std::array<double, 4> sum = sumAt(part, at);
      Vec place;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        points.normal[axis][i] = sum[axis];
        place[axis] = part.middle[axis] + part.half[axis] * at[axis];
      }
      if (i < count)
      {
        values[i] = sum[3];
        const bool isBox = part.reference == filters::Reference::Box;
        const bool isSimplex = part.reference == filters::Reference::Simplex;
        const double slant = place[0] + place[1] + (isSimplex ? place[2] : 0) - 1;
        misses[i] = std::max({ 0., -place[0], -place[1], -place[2], place[0] - 1, place[1] - 1,
          place[2] - 1, isBox ? 0. : slant });
      }
    }
    EXPECT_GT(std::count(misses, misses + count, 0), count / 5);
    for (const auto locate : all)
    {
      for (const bool isRegular : { true, false })
      {
        part.isRegular = isRegular;
        locate(part, count, points);
        for (int i = 0; i < count; ++i)
        {
          EXPECT_NEAR(points.miss[i], misses[i], 1e-9) << i;
          EXPECT_NEAR(points.value[i], values[i], 1e-9) << i;
        }
      }
    }
  }
}

// u² on one axis: half of the space is there twice, the other half is not.
TEST(CurvedCells, AllInstructionsLeaveOutWhatIsBeyondAFold)
{
  std::vector<double> coefficients(4 * 3 * 2 * 2);
  const auto at = [&](std::size_t i, std::size_t j, std::size_t k)
  { return &coefficients[4 * ((i * 2 + j) * 2 + k)]; };
  at(2, 0, 0)[0] = 1;
  at(0, 1, 0)[1] = 1;
  at(0, 0, 1)[2] = 1;
  at(2, 0, 0)[3] = 3;
  at(0, 1, 0)[3] = 2;
  const filters::CurvedPart part{ filters::Reference::Box, { 2, 1, 1 }, coefficients.data(),
    { 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, false, 1e-3 };
  filters::CellPoints points{};
  constexpr int count = 61;
  for (int i = 0; i < count; ++i)
  {
    points.normal[0][i] = (i + 0.5) / 31 - 1;
    points.normal[1][i] = 0.8 * std::sin(i);
    points.normal[2][i] = 0.8 * std::cos(i);
  }
  for (const auto locate : filters::functionsToLocateInPart())
  {
    locate(part, count, points);
    for (int i = 0; i < count; ++i)
    {
      if (points.normal[0][i] < 0)
      {
        EXPECT_EQ(points.miss[i], HUGE_VAL) << i;
      }
      else
      {
        EXPECT_EQ(points.miss[i], 0) << i;
        EXPECT_NEAR(points.value[i], 3 * points.normal[0][i] + 2 * points.normal[1][i], 1e-9) << i;
      }
    }
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

TEST(MeshFaces, FacesOfLinearCellsBoundThem)
{
  std::vector<CellKind> kinds = linearKinds();
  kinds.push_back({ "Voxels", VTK_VOXEL, { unitCell(VTK_VOXEL, 8) } });
  for (const CellKind& kind : kinds)
  {
    const Mesh mesh = meshOf(kind.type, 3, kind.cells, 0, false);
    addPointArray(mesh, "N", linear);
    const Faces faces = facesOf(mesh);
    using filters::operator+, filters::operator-, filters::operator*;
    double sum = 0; // of areas, whose faces' corners are in order
    for (std::size_t face = 0; face < faces.size(); ++face)
    {
      const auto at = [&](std::size_t i) -> const filters::Point&
      { return faces.points[static_cast<std::size_t>(faces.corners[i])]; };
      const std::size_t first = faces.starts[face];
      filters::Point area{ 0, 0, 0 };
      for (std::size_t i = first + 1; i + 1 < faces.starts[face + 1]; ++i)
      {
        area = area + 0.5 * filters::cross(at(i) - at(first), at(i + 1) - at(first));
      }
      sum += filters::norm(area);
    }
    EXPECT_NEAR(sum, 6, 1e-9) << kind.name;
  }
}
