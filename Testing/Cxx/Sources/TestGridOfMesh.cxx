// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a mesh becomes on a grid. Isoparametric cells interpolate linear fields exactly, however their points
// are moved: that is the truth here.
#include "CellMeshes.h"
#include "Sources/MediumMaker.h"
#include "WatchedProgress.h"

#include "vtkDataSetTriangleFilter.h"

namespace
{

vtkSmartPointer<vtkRefractiveIndex> reader(int n = 21, int threads = 2)
{
  auto filter = vtkSmartPointer<vtkRefractiveIndex>::New();
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  filter->SetSamplingDimensions(n, n, n);
  filter->SetDoublePrecision(true);
  filter->SetNumberOfThreads(threads);
  return filter;
}

struct Sampled
{
  std::vector<double> values, valid;
  vtkSmartPointer<vtkImageData> image = vtkSmartPointer<vtkImageData>::New();
};

Sampled sampled(vtkRefractiveIndex* filter, vtkDataObject* mesh)
{
  Sampled result;
  filter->GetMaker().convert(mesh, result.image, nullptr, filters::Numbers::Singles);
  for (vtkIdType i = 0; i < result.image->GetNumberOfPoints(); ++i)
  {
    vtkPointData* arrays = result.image->GetPointData();
    result.values.push_back(arrays->GetArray("Refractivity")->GetComponent(i, 0));
    result.valid.push_back(arrays->GetArray("vtkValidPointMask")->GetComponent(i, 0));
  }
  return result;
}

/// The largest error where a linear field is sampled in all of its box, relative to the largest value.
double errorOf(const Sampled& result)
{
  double error = 0;
  int holes = 0;
  for (vtkIdType i = 0; i < result.image->GetNumberOfPoints(); ++i)
  {
    Vec x;
    result.image->GetPoint(i, x.data());
    const auto at = static_cast<std::size_t>(i);
    if (result.valid[at] == 0)
    {
      ++holes;
    }
    else
    {
      error = std::max(error, std::abs(result.values[at] - linear(x)));
    }
  }
  EXPECT_EQ(holes, 0);
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

// Straight and moved; on a grid that has points on faces, edges and corners of the straight cells.
TEST_P(MeshCells, InterpolateLinearFieldsExactlyAndLeaveNoHoles)
{
  const Kind& kind = GetParam();
  for (const double by : { 0., 0.1 })
  {
    const auto cells = cut(unitCell(kind.type, kind.count), *kind.frames);
    const Mesh mesh = meshOf(kind.type, 2, cells, by, kind.isFlat);
    if (kind.isFlat)
    {
      auto filter = reader();
      filter->SetSamplingDimensions(21, 21, 0);
      const Sampled result = sampled(filter, mesh);
      double error = 0;
      for (vtkIdType i = 0; i < result.image->GetNumberOfPoints(); ++i)
      {
        Vec x;
        result.image->GetPoint(i, x.data());
        x[2] = 0;
        ASSERT_EQ(result.valid[static_cast<std::size_t>(i)], 1);
        error = std::max(error, std::abs(result.values[static_cast<std::size_t>(i)] - linear(x)));
      }
      EXPECT_LT(error, 1e-7 * 3e-4) << by;
    }
    else
    {
      EXPECT_LT(errorOf(sampled(reader(), mesh)), 1e-7) << by;
    }
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

// Most points of the grid are shared by several cells, of which any other would give another value.
TEST(GridOfMesh, AnyNumberOfThreadsGivesTheSameValues)
{
  const Mesh mesh = tetrahedra(20, 0.1);
  const Sampled one = sampled(reader(21, 1), mesh);
  for (const int threads : { 2, 7 })
  {
    const Sampled more = sampled(reader(21, threads), mesh);
    EXPECT_EQ(more.values, one.values) << threads;
    EXPECT_EQ(more.valid, one.valid) << threads;
  }
}

TEST(GridOfMesh, HiddenCellsAreABody)
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
  auto filter = reader(31);
  filter->SetOutside(vtkRefractiveIndex::OUTSIDE_PASSES);
  const Sampled result = sampled(filter, mesh);
  EXPECT_FALSE(result.image->GetPointData()->HasArray("TransparentPointMask"));
  EXPECT_GT(std::count(result.valid.begin(), result.valid.end(), 0.), 10 * 10 * 31);
}

// The medium and all of the fields that tint it.
TEST(GridOfMesh, TintsReadTheMeshOnce)
{
  const Mesh mesh = tetrahedra();
  addPointArray(mesh, "A", [](const Vec& x) { return x[0]; });
  addPointArray(mesh, "B", [](const Vec& x) { return x[1]; });
  auto filter = bench(mesh);
  filter->AddField("A");
  filter->AddField("B");
  filter->SetSamplingDimensions(21, 21, 21);
  filter->SetColorByField(true);
  filter->Update();
  EXPECT_FALSE(isEmpty(filter));
  EXPECT_EQ(filter->GetMeshBuilds(), 1);
}

TEST(GridOfMesh, StopsAndStartsAnew)
{
  auto filter = reader(64, 1);
  const Mesh mesh = tetrahedra();
  filter->SetInputData(mesh);
  {
    const WatchedProgress watch(filter, 0.3);
    filter->Update();
    EXPECT_TRUE(isEmpty(filter));
  }
  filter->Modified();
  filter->Update();
  EXPECT_FALSE(isEmpty(filter));
}
