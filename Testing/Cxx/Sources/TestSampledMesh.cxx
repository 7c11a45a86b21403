// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a mesh has on a lattice. Isoparametric cells interpolate linear fields exactly, however their points
// are moved: that is the truth here.
#include "CellMeshes.h"
#include "Sources/MediumMaker.h"
#include "Walls/GasBoundary.h"

#include "vtkDataSetTriangleFilter.h"

namespace
{

/// What the source of a mesh has on a lattice over all of it.
struct Sampled
{
  std::vector<Vec> points;
  std::vector<double> values;
  std::vector<schlieren::Place> places;
};

/// `n`: points along each axis; of data in a plane z, which are the same along it, one.
Sampled sampled(vtkDataObject* mesh, int n = 21, int threads = 2)
{
  filters::MediumMaker maker;
  maker.settings.IndexModel = MediumSettings::REFRACTIVITY;
  maker.settings.Arrays[MediumSettings::IndexArray].name = "N";
  maker.settings.Outside = static_cast<int>(filters::Outside::Passes);
  maker.numberOfThreads = threads;
  const auto source = maker.make(maker.choose(mesh), nullptr)->Source;
  const schlieren::Box box = source->bounds();
  schlieren::Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isAcross = source->isFlat() && axis == 2;
    const double length = box.high[axis] - box.low[axis];
    lattice.points[axis] = isAcross ? 1 : n;
    lattice.first[axis] = box.low[axis] + (isAcross ? length / 2 : 0);
    lattice.spacing[axis] = length / (n - 1);
  }
  Sampled result;
  const auto size = static_cast<std::size_t>(lattice.size());
  result.values.resize(size);
  result.places.resize(size);
  source->sample(lattice, result.values.data(), result.places.data(), nullptr);
  for (int k = 0; k < lattice.points[2]; ++k)
  {
    for (int j = 0; j < lattice.points[1]; ++j)
    {
      for (int i = 0; i < lattice.points[0]; ++i)
      {
        result.points.push_back({ lattice.first[0] + i * lattice.spacing[0],
          lattice.first[1] + j * lattice.spacing[1], lattice.first[2] + k * lattice.spacing[2] });
      }
    }
  }
  return result;
}

/// The largest error where a linear field is sampled in all of its box, relative to the largest value.
double errorOf(const Sampled& result, bool isFlat)
{
  double error = 0;
  for (std::size_t i = 0; i < result.points.size(); ++i)
  {
    Vec x = result.points[i];
    x[2] = isFlat ? 0 : x[2];
    EXPECT_EQ(result.places[i], schlieren::Place::Gas);
    error = std::max(error, std::abs(result.values[i] - linear(x)));
  }
  return error / 3.25e-4;
}

struct Kind
{
  std::string name;
  int type;
  int count;
  const Frames* frames;
  bool isFlat = false;
};

class MeshCells : public testing::TestWithParam<Kind>
{
};

} // namespace

// Straight and moved; on a lattice that has points on faces, edges and corners of the straight cells.
TEST_P(MeshCells, InterpolateLinearFieldsExactlyAndLeaveNoHoles)
{
  const Kind& kind = GetParam();
  for (const double by : { 0., 0.1 })
  {
    const auto cells = cut(unitCell(kind.type, kind.count), *kind.frames);
    const Mesh mesh = meshOf(kind.type, 2, cells, by, kind.isFlat);
    EXPECT_LT(errorOf(sampled(mesh), kind.isFlat), 1e-7) << by;
  }
}

INSTANTIATE_TEST_SUITE_P(Types, MeshCells,
  testing::Values(Kind{ "Tetrahedra", VTK_TETRA, 4, &kuhn },
    Kind{ "Hexahedra", VTK_HEXAHEDRON, 8, &boxes }, Kind{ "Wedges", VTK_WEDGE, 6, &prisms },
    Kind{ "QuadraticTetrahedra", VTK_QUADRATIC_TETRA, 10, &kuhn },
    Kind{ "QuadraticHexahedra", VTK_QUADRATIC_HEXAHEDRON, 20, &boxes },
    Kind{ "TriquadraticHexahedra", VTK_TRIQUADRATIC_HEXAHEDRON, 27, &boxes },
    Kind{ "BiquadraticHexahedra", VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24, &boxes },
    Kind{ "QuadraticWedges", VTK_QUADRATIC_WEDGE, 15, &prisms },
    Kind{ "QuadraticLinearWedges", VTK_QUADRATIC_LINEAR_WEDGE, 12, &prisms },
    Kind{ "BiquadraticWedges", VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18, &prisms },
    Kind{ "LagrangeHexahedra", VTK_LAGRANGE_HEXAHEDRON, 64, &boxes },
    Kind{ "LagrangeTetrahedra", VTK_LAGRANGE_TETRAHEDRON, 20, &kuhn },
    Kind{ "LagrangeWedges", VTK_LAGRANGE_WEDGE, 40, &prisms },
    Kind{ "Triangles", VTK_TRIANGLE, 3, &prisms, true }, Kind{ "Quads", VTK_QUAD, 4, &boxes, true },
    Kind{ "QuadraticTriangles", VTK_QUADRATIC_TRIANGLE, 6, &prisms, true },
    Kind{ "QuadraticQuads", VTK_QUADRATIC_QUAD, 8, &boxes, true },
    Kind{ "LagrangeQuads", VTK_LAGRANGE_QUADRILATERAL, 16, &boxes, true },
    Kind{ "LagrangeTriangles", VTK_LAGRANGE_TRIANGLE, 10, &prisms, true }),
  [](const auto& tested) { return tested.param.name; });

namespace
{

Mesh tetrahedra(int n = 20, double by = 0)
{
  vtkNew<vtkDataSetTriangleFilter> toTetrahedra;
  toTetrahedra->SetInputData(cube(n + 1));
  toTetrahedra->Update();
  Mesh mesh = toTetrahedra->GetOutput();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    Vec x;
    mesh->GetPoint(i, x.data());
    for (double& along : x)
    {
      along = (along + 1) / 2;
    }
    mesh->GetPoints()->SetPoint(i, moved(x, by).data());
  }
  mesh->GetPoints()->Modified();
  addPointArray(mesh, "N", [](const Vec& x) { return std::sin(1e4 * (x[0] + x[1] + 2 * x[2])); });
  return mesh;
}

} // namespace

// Most points of the lattice are shared by several cells, of which any other would give another value.
TEST(SampledMesh, AnyNumberOfThreadsGivesTheSameValues)
{
  const Mesh mesh = tetrahedra(20, 0.1);
  const Sampled one = sampled(mesh, 21, 1);
  for (const int threads : { 2, 7 })
  {
    const Sampled more = sampled(mesh, 21, threads);
    EXPECT_EQ(more.values, one.values) << threads;
    EXPECT_EQ(more.places, one.places) << threads;
  }
}

TEST(SampledMesh, HiddenCellsAreABody)
{
  const Mesh mesh = tetrahedra();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(mesh->GetNumberOfCells());
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    mesh->GetCellBounds(i, bounds);
    const bool isCut = bounds[0] > 0.5 && bounds[2] > 0.5;
    ghosts->SetValue(i, isCut ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  mesh->GetCellData()->AddArray(ghosts);
  const Sampled result = sampled(mesh, 31);
  const auto count = [&](schlieren::Place place)
  { return std::count(result.places.begin(), result.places.end(), place); };
  EXPECT_EQ(count(schlieren::Place::Window), 0);
  EXPECT_GT(count(schlieren::Place::Wall), 10 * 10 * 31);
}

// The medium and all of the fields that tint it.
TEST(SampledMesh, TintsReadTheMeshOnce)
{
  const Mesh mesh = tetrahedra();
  addPointArray(mesh, "N", [](const Vec& x) { return 1e-4 * x[0] * x[1]; });
  addPointArray(mesh, "A", [](const Vec& x) { return x[0]; });
  addPointArray(mesh, "B", [](const Vec& x) { return x[1]; });
  auto filter = bench(mesh);
  filter->AddField("A");
  filter->AddField("B");
  filter->SetColorByField(true);
  filter->Update();
  EXPECT_FALSE(isEmpty(filter));
  EXPECT_EQ(filter->GetMeshBuilds(), 1);
}
