// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Curved cells as linear ones between their nodes, and the faces of linear cells that bound a mesh. VTK's functions of a
// cell are the truth of where its nodes are.
#include "CellMeshes.h"

#include "Cells/CellSampler.h"
#include "Cells/CellTree.h"
#include "Cells/LinearCells.h"
#include "Walls/MeshFaces.h"

#include "vtkCellData.h"

#include <random>

using filters::asLinearCells;
using filters::Faces;

namespace
{

struct Kind
{
  std::string name;
  int type, points;
  std::array<int, 3> orders;
  std::size_t parts;
  double volume;
  const Frames* frames = nullptr; // null: not tested in a mesh
  bool isRational = false;
};

const std::vector<Kind>& kinds()
{
  static const std::vector<Kind> all{ { "QuadraticTetrahedra", VTK_QUADRATIC_TETRA, 10, { 2, 2, 2 },
                                        8, 1. / 6, &kuhn },
    { "QuadraticHexahedra", VTK_QUADRATIC_HEXAHEDRON, 20, { 2, 2, 2 }, 8, 1, &boxes },
    { "BiquadraticHexahedra", VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24, { 2, 2, 2 }, 8, 1, &boxes },
    { "TriquadraticHexahedra", VTK_TRIQUADRATIC_HEXAHEDRON, 27, { 2, 2, 2 }, 8, 1, &boxes },
    { "QuadraticWedges", VTK_QUADRATIC_WEDGE, 15, { 2, 2, 2 }, 8, 0.5, &prisms },
    { "QuadraticLinearWedges", VTK_QUADRATIC_LINEAR_WEDGE, 12, { 2, 2, 1 }, 4, 0.5, &prisms },
    { "BiquadraticWedges", VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18, { 2, 2, 2 }, 8, 0.5, &prisms },
    { "QuadraticPyramids", VTK_QUADRATIC_PYRAMID, 13, { 0, 0, 0 }, 10, 1. / 3 },
    { "TriquadraticPyramids", VTK_TRIQUADRATIC_PYRAMID, 19, { 0, 0, 0 }, 10, 1. / 6 },
    { "LagrangeHexahedra", VTK_LAGRANGE_HEXAHEDRON, 64, { 3, 3, 3 }, 27, 1, &boxes },
    { "LinearLagrangeHexahedra", VTK_LAGRANGE_HEXAHEDRON, 8, { 1, 1, 1 }, 1, 1, &boxes },
    { "HexahedraOfThreeOrders", VTK_LAGRANGE_HEXAHEDRON, 60, { 2, 4, 3 }, 24, 1 },
    { "LagrangeTetrahedra", VTK_LAGRANGE_TETRAHEDRON, 20, { 3, 3, 3 }, 27, 1. / 6, &kuhn },
    { "TetrahedraOfOrder4", VTK_LAGRANGE_TETRAHEDRON, 35, { 4, 4, 4 }, 64, 1. / 6, &kuhn },
    { "LagrangeWedges", VTK_LAGRANGE_WEDGE, 40, { 3, 3, 3 }, 27, 0.5, &prisms },
    { "BezierHexahedra", VTK_BEZIER_HEXAHEDRON, 27, { 2, 2, 2 }, 8, 1, &boxes },
    { "RationalHexahedra", VTK_BEZIER_HEXAHEDRON, 27, { 2, 2, 2 }, 8, 1, nullptr, true },
    { "BezierTetrahedra", VTK_BEZIER_TETRAHEDRON, 20, { 3, 3, 3 }, 27, 1. / 6, &kuhn },
    { "RationalTetrahedra", VTK_BEZIER_TETRAHEDRON, 20, { 3, 3, 3 }, 27, 1. / 6, nullptr, true },
    { "BezierWedges", VTK_BEZIER_WEDGE, 18, { 2, 2, 2 }, 8, 0.5, &prisms },
    { "RationalWedges", VTK_BEZIER_WEDGE, 40, { 3, 3, 3 }, 27, 0.5, nullptr, true } };
  return all;
}

std::vector<Kind> kindsInMeshes()
{
  std::vector<Kind> some;
  std::copy_if(kinds().begin(), kinds().end(), std::back_inserter(some),
    [](const Kind& kind) { return kind.frames != nullptr; });
  return some;
}

class CurvedCells : public testing::TestWithParam<Kind>
{
};

class MeshesOfCurvedCells : public testing::TestWithParam<Kind>
{
};

void setOrders(vtkUnstructuredGrid* mesh, const std::array<int, 3>& orders)
{
  vtkNew<vtkDoubleArray> degrees;
  degrees->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    degrees->InsertNextTuple3(orders[0], orders[1], orders[2]);
  }
  mesh->GetCellData()->SetHigherOrderDegrees(degrees);
}

/// One cell with its points at their parametric coordinates, moved by at most `by`.
Mesh oneCell(const Kind& kind, double by)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, 1), around(-by, by);
  auto mesh = Mesh::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdList> ids;
  for (int i = 0; i < kind.points; ++i)
  {
    ids->InsertNextId(points->InsertNextPoint(0, 0, 0));
  }
  mesh->SetPoints(points);
  mesh->InsertNextCell(kind.type, ids);
  if (kind.type == VTK_LAGRANGE_HEXAHEDRON)
  {
    setOrders(mesh, kind.orders);
  }
  vtkNew<vtkGenericCell> cell;
  mesh->GetCell(0, cell);
  const double* places = cell->GetParametricCoords();
  for (vtkIdType i = 0; i < kind.points; ++i)
  {
    const double* x = places + 3 * i;
    const double narrows = kind.type == VTK_QUADRATIC_PYRAMID ? x[2] : 0; // towards its top
    points->SetPoint(i, x[0] + narrows * (0.5 - x[0]) + around(random),
      x[1] + narrows * (0.5 - x[1]) + around(random), x[2] + around(random));
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
  addPointArray(mesh, "N", [](const Vec& x) { return std::sin(3 * x[0] + 4 * x[1] + 5 * x[2]); });
  mesh->GetPointData()->SetActiveScalars("N");
  return mesh;
}

/// Parametric coordinates of the nodes, in a lattice; of pyramids, of corners and of the middles of edges and the base.
std::vector<Vec> nodePlaces(const Kind& kind, vtkCell* cell)
{
  std::vector<Vec> places;
  if (kind.orders[0] == 0)
  {
    const double* own = cell->GetParametricCoords();
    for (int i = 0; i < std::min(kind.points, 14); ++i)
    {
      places.push_back({ own[3 * i], own[3 * i + 1], own[3 * i + 2] });
    }
    if (kind.points < 14)
    {
      places.push_back({ 0.5, 0.5, 0 });
    }
    return places;
  }
  for (int k = 0; k <= kind.orders[2]; ++k)
  {
    for (int j = 0; j <= kind.orders[1]; ++j)
    {
      for (int i = 0; i <= kind.orders[0]; ++i)
      {
        const Vec place = { static_cast<double>(i) / kind.orders[0],
          static_cast<double>(j) / kind.orders[1], static_cast<double>(k) / kind.orders[2] };
        const double slant = kind.volume == 1 ? 0
          : kind.volume == 0.5                ? place[0] + place[1]
                                              : place[0] + place[1] + place[2];
        if (slant < 1 + 1e-9)
        {
          places.push_back(place);
        }
      }
    }
  }
  return places;
}

Vec cornerOf(vtkDataSet* mesh, vtkIdType cell, int corner)
{
  Vec x;
  mesh->GetPoint(mesh->GetCell(cell)->GetPointId(corner), x.data());
  return x;
}

/// The volume of a linear cell by its corners, negative for inverted ones: of tetrahedra, and of others by their faces.
double volumeOf(vtkDataSet* mesh, vtkIdType number)
{
  using filters::operator+, filters::operator-, filters::operator*;
  vtkNew<vtkGenericCell> cell;
  mesh->GetCell(number, cell);
  const auto at = [&](vtkIdType point)
  {
    Vec x;
    mesh->GetPoint(point, x.data());
    return x;
  };
  double volume = 0;
  for (int n = 0; n < cell->GetNumberOfFaces(); ++n)
  {
    vtkCell* face = cell->GetFace(n);
    const vtkIdType count = face->GetNumberOfPoints();
    Vec middle{ 0, 0, 0 };
    for (vtkIdType i = 0; i < count; ++i)
    {
      middle = middle + 1. / static_cast<double>(count) * at(face->GetPointId(static_cast<int>(i)));
    }
    for (int i = 0; i < count; ++i)
    {
      const Vec a = at(face->GetPointId(i)),
                b = at(face->GetPointId(static_cast<int>((i + 1) % count)));
      volume += filters::dot(middle, filters::cross(a, b)) / 6;
    }
  }
  return volume;
}

/// Largest error of a field in the unit cube at points of a lattice, all of which are to be found.
double errorIn(vtkDataSet* mesh, const ScalarField& field,
  filters::CellTree::Reconstruction reconstruction, int n = 19)
{
  const double spacing = 1. / (n - 1);
  const schlieren::Lattice lattice{ { 0, 0, 0 }, { spacing, spacing, spacing }, { n, n, n } };
  const auto size = static_cast<std::size_t>(lattice.size());
  std::vector<double> values(size);
  std::vector<unsigned char> found(size);
  const filters::CellTree tree({ mesh }, reconstruction);
  filters::CellSampler(tree).sample(lattice, values.data(), found.data());
  EXPECT_EQ(std::count(found.begin(), found.end(), 1), lattice.size());
  double error = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    error = std::max(error, std::abs(values[i] - field(pointOf(lattice, i))));
  }
  return error;
}

vtkSmartPointer<vtkDataSet> linearCellsOf(vtkUnstructuredGrid* mesh)
{
  mesh->GetPointData()->SetActiveScalars("N");
  return asLinearCells(mesh);
}

Faces facesOf(vtkUnstructuredGrid* mesh)
{
  return filters::facesOf({ linearCellsOf(mesh) }, filters::WorkProgress());
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

// Straight cells are filled by parts that are not inverted.
TEST_P(CurvedCells, AreFilledByTheirParts)
{
  const Kind& kind = GetParam();
  Kind straight = kind;
  straight.isRational = false;
  const auto parts = asLinearCells(oneCell(straight, 0));
  ASSERT_EQ(static_cast<std::size_t>(parts->GetNumberOfCells()), kind.parts);
  const double sign = volumeOf(parts, 0) < 0 ? -1 : 1; // VTK's wedges see their faces from within
  double sum = 0;
  for (vtkIdType i = 0; i < parts->GetNumberOfCells(); ++i)
  {
    const double volume = sign * volumeOf(parts, i);
    EXPECT_GT(volume, 0.1 * kind.volume / static_cast<double>(kind.parts)) << i;
    sum += volume;
  }
  EXPECT_NEAR(sum, kind.volume, 1e-12);
}

// Corners of parts are where the cell's own functions say that its places are, those of rational weights, too, and
// have its values there: all places of a lattice, and no others.
TEST_P(CurvedCells, HavePartsBetweenTheirNodes)
{
  const Kind& kind = GetParam();
  const Mesh mesh = oneCell(kind, 0.05);
  vtkNew<vtkGenericCell> cell;
  mesh->GetCell(0, cell);
  std::vector<double> functions(static_cast<std::size_t>(kind.points));
  std::vector<std::array<double, 4>> nodes; // place and value
  for (const Vec& place : nodePlaces(kind, cell))
  {
    cell->InterpolateFunctions(place.data(), functions.data());
    std::array<double, 4> node{};
    for (vtkIdType point = 0; point < kind.points; ++point)
    {
      const double weight = functions[static_cast<std::size_t>(point)];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        node[axis] += weight * mesh->GetPoint(point)[axis];
      }
      node[3] += weight * mesh->GetPointData()->GetArray("N")->GetComponent(point, 0);
    }
    nodes.push_back(node);
  }
  const auto parts = asLinearCells(mesh);
  std::vector<int> met(nodes.size(), 0);
  for (vtkIdType i = 0; i < parts->GetNumberOfCells(); ++i)
  {
    for (int corner = 0; corner < parts->GetCell(i)->GetNumberOfPoints(); ++corner)
    {
      const Vec x = cornerOf(parts, i, corner);
      const double value =
        parts->GetPointData()->GetScalars()->GetComponent(parts->GetCell(i)->GetPointId(corner), 0);
      const auto node = std::find_if(nodes.begin(), nodes.end(),
        [&](const std::array<double, 4>& of)
        {
          return std::abs(of[0] - x[0]) + std::abs(of[1] - x[1]) + std::abs(of[2] - x[2]) +
            std::abs(of[3] - value) <
            1e-12;
        });
      ASSERT_NE(node, nodes.end()) << i << " " << corner;
      ++met[static_cast<std::size_t>(node - nodes.begin())];
    }
  }
  EXPECT_EQ(std::count(met.begin(), met.end(), 0), 0);
}

// However the nodes within a mesh are moved.
TEST_P(MeshesOfCurvedCells, InterpolateLinearFieldsExactlyAndLeaveNoHoles)
{
  const Kind& kind = GetParam();
  for (const double by : { 0., 0.1 })
  {
    const Mesh mesh =
      meshOf(kind.type, 2, cut(unitCell(kind.type, kind.points), *kind.frames), by, false);
    EXPECT_LT(
      errorIn(linearCellsOf(mesh), linear, filters::CellTree::Reconstruction::Linear), 1e-15)
      << by;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CurvedCells, testing::ValuesIn(kinds()),
  [](const testing::TestParamInfo<Kind>& kind) { return kind.param.name; });
INSTANTIATE_TEST_SUITE_P(Kinds, MeshesOfCurvedCells, testing::ValuesIn(kindsInMeshes()),
  [](const testing::TestParamInfo<Kind>& kind) { return kind.param.name; });

// Cells that have all nodes of a lattice are as good as linear cells between them, whose errors fall with the square of
// the distance of nodes where interpolation is linear along edges: to 1 / 3.4 at least with half of it.
TEST(LinearCells, ErrorsAreThoseOfLinearCellsBetweenTheNodes)
{
  using Reconstruction = filters::CellTree::Reconstruction;
  const ScalarField wave = [](const Vec& x)
  { return 1e-4 * std::sin(2 * x[0] + 1) * std::sin(3 * x[1] - 1) * std::sin(2 * x[2] + 2); };
  const auto withWave = [&](int type, int n, const std::vector<Vec>& corners)
  {
    const Mesh mesh = meshOf(type, n, { corners }, 0.05, false);
    addPointArray(mesh, "N", wave);
    return linearCellsOf(mesh);
  };
  for (const Kind& kind : { kinds()[3], kinds()[9] })
  {
    std::array<double, 2> errors{};
    for (const int n : { 1, 2 })
    {
      const auto curved = withWave(kind.type, 2 * n, unitCell(kind.type, kind.points));
      const auto fine =
        withWave(VTK_HEXAHEDRON, 2 * n * kind.orders[0], unitCell(VTK_HEXAHEDRON, 8));
      for (const auto reconstruction : { Reconstruction::Smooth, Reconstruction::Linear })
      {
        errors[static_cast<std::size_t>(n - 1)] = errorIn(curved, wave, reconstruction, 31);
        EXPECT_NEAR(
          errors[static_cast<std::size_t>(n - 1)], errorIn(fine, wave, reconstruction, 31), 1e-15)
          << kind.name;
      }
    }
    EXPECT_LT(errors[1], errors[0] / 3.4) << kind.name;
  }
}

// n^3 cells: the faces of the cube are all that is left, so nodes that serendipity cells lack are common to neighbours.
TEST(LinearCells, FacesWithinAMeshAreNoBoundary)
{
  constexpr int n = 3;
  for (const Kind& kind : kinds())
  {
    if (kind.frames != &boxes)
    {
      continue;
    }
    const Mesh mesh = meshOf(kind.type, n, { unitCell(kind.type, kind.points) }, 0.1, false);
    const auto parts = linearCellsOf(mesh);
    const Faces faces = facesOf(mesh);
    EXPECT_EQ(faces.size(), static_cast<std::size_t>(6 * n * n * kind.orders[0] * kind.orders[0]))
      << kind.name;
    for (std::size_t i = 0; i < faces.points.size(); ++i)
    {
      EXPECT_LT(toCube(faces.points[i]), 1e-12);
      EXPECT_NEAR(parts->GetPointData()->GetScalars()->GetComponent(faces.origins[i].point, 0),
        linear(faces.points[i]), 1e-15);
    }
  }
}

// Values of cells are those of linear cells with the same corners, which are hidden as the cells are.
TEST(LinearCells, WithValuesOfCellsAreTheirCorners)
{
  for (const Kind& kind : kinds())
  {
    const Mesh mesh = oneCell(kind, 0.05);
    vtkNew<vtkDoubleArray> values;
    values->InsertNextValue(7);
    mesh->GetCellData()->SetScalars(values);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->InsertNextValue(vtkDataSetAttributes::HIDDENCELL);
    mesh->GetCellData()->AddArray(ghosts);
    const auto linearCell = asLinearCells(mesh);
    ASSERT_EQ(linearCell->GetNumberOfCells(), 1) << kind.name;
    EXPECT_TRUE(linearCell->GetCell(0)->IsLinear());
    EXPECT_EQ(linearCell->GetCellData()->GetScalars()->GetComponent(0, 0), 7);
    EXPECT_EQ(linearCell->GetCellGhostArray()->GetValue(0), vtkDataSetAttributes::HIDDENCELL);
    for (int corner = 0; corner < linearCell->GetCell(0)->GetNumberOfPoints(); ++corner)
    {
      EXPECT_EQ(cornerOf(linearCell, 0, corner), cornerOf(mesh, 0, corner)) << kind.name;
    }
  }
}

TEST(LinearCells, ConvexPointSetsBecomeTetrahedra)
{
  const Mesh mesh = meshOf(VTK_CONVEX_POINT_SET, 2, { unitCell(VTK_HEXAHEDRON, 8) }, 0, false);
  const auto parts = linearCellsOf(mesh);
  double sum = 0;
  for (vtkIdType i = 0; i < parts->GetNumberOfCells(); ++i)
  {
    ASSERT_EQ(parts->GetCellType(i), VTK_TETRA);
    sum += std::abs(volumeOf(parts, i));
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_LT(errorIn(parts, linear, filters::CellTree::Reconstruction::Linear), 1e-15);
}

TEST(LinearCells, LinearCellsStayWhatTheyAre)
{
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 2, kind.cells, 0.1, false);
    EXPECT_EQ(linearCellsOf(mesh), mesh) << kind.name;
  }
}
