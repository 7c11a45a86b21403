// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Values beyond those of the points: at smooth extrema, not beside shocks.
#include "CellMeshes.h"

#include "Cells/CellSampler.h"
#include "Cells/Polyhedra.h"
#include "Walls/UnsharedFaces.h"

#include <numeric>

using schlieren::Lattice;

namespace
{

/// Meshes of the unit cube, n cells along its edges, of each kind; `by`: see meshOf().
struct KnownMesh
{
  std::string name;
  vtkSmartPointer<vtkDataSet> data;
};

std::vector<KnownMesh> meshesOf(int n, double by, const ScalarField& field)
{
  std::vector<KnownMesh> meshes;
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, n, kind.cells, by, false);
    mesh->GetPointData()->SetScalars(addPointArray(mesh, "N", field));
    meshes.push_back({ kind.name, mesh });
    if (kind.type == VTK_HEXAHEDRON || kind.type == VTK_WEDGE)
    {
      meshes.push_back(
        { kind.name + " as polyhedra", filters::withoutPolyhedra(asPolyhedra(mesh)) });
    }
    if (kind.type == VTK_HEXAHEDRON)
    {
      vtkNew<vtkStructuredGrid> grid;
      grid->SetDimensions(n + 1, n + 1, n + 1);
      vtkNew<vtkPoints> points;
      points->SetDataTypeToDouble();
      for (vtkIdType i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i)
      {
        const double x = static_cast<double>(i % (n + 1)) / n,
                     y = static_cast<double>(i / (n + 1) % (n + 1)) / n,
                     z = static_cast<double>(i / ((n + 1) * (n + 1))) / n;
        points->InsertNextPoint(moved({ x, y, z }, by).data());
      }
      grid->SetPoints(points);
      grid->GetPointData()->SetScalars(addPointArray(grid, "N", field));
      meshes.push_back({ "Structured", grid });
    }
  }
  return meshes;
}

std::vector<double> sampled(vtkDataSet* mesh, const Lattice& lattice)
{
  const filters::CellTree tree({ mesh }, filters::CellTree::Reconstruction::Smooth);
  std::vector<double> values(static_cast<std::size_t>(lattice.size()));
  std::vector<unsigned char> found(values.size());
  filters::CellSampler(tree).sample(lattice, values.data(), found.data());
  EXPECT_EQ(std::accumulate(found.begin(), found.end(), std::size_t{ 0 }), found.size());
  return values;
}

} // namespace

// Five cells a radius, and the extremum anywhere between points. Limits by the neighbours' range alone make it flat: its
// height is wrong by 0.027 then, and slopes are by 0.29.
TEST(Extrema, SmoothOnesAreKeptBetweenPoints)
{
  constexpr int n = 8;
  for (const double sign : { 1., -1. })
  {
    for (const double by : { 0., 0.05 })
    {
      for (const double at : { 0., 0.25, 0.5 })
      {
        const double middle = (4 + at) / n, width = 5. / n;
        const auto ball = [&](const Vec& x)
        {
          const Vec r = { (x[0] - middle) / width, (x[1] - middle) / width,
            (x[2] - middle) / width };
          return sign * std::exp(-dot(r, r));
        };
        constexpr std::size_t across = 25;
        constexpr double step = 0.08 / n;
        const Lattice lattice = { { middle - 12 * step, middle - 12 * step, middle - 12 * step },
          { step, step, step }, { across, across, across } };
        for (const KnownMesh& mesh : meshesOf(n, by, ball))
        {
          const std::vector<double> values = sampled(mesh.data, lattice);
          double wrong = 0, slope = 0;
          for (std::size_t i = 0; i < values.size(); ++i)
          {
            const double error = values[i] - ball(pointOf(lattice, i));
            wrong = std::max(wrong, std::abs(error));
            if (i % across >= 4)
            {
              slope = std::max(slope,
                std::abs(error - values[i - 4] + ball(pointOf(lattice, i - 4))) / (4 * step));
            }
          }
          EXPECT_LT(wrong, 0.005) << mesh.name << " " << at << " " << by;
          // The steepest slope is 0.86 / width.
          EXPECT_LT(slope * width / 0.86, 0.05) << mesh.name << " " << at << " " << by;
        }
      }
    }
  }
}

// In their middles, too, which are no points of the mesh.
TEST(Polyhedra, QuadraticFieldsAreExact)
{
  const auto field = [](const Vec& x)
  { return 1 + x[0] - x[1] * x[2] + 2 * x[2] * x[2] - 3 * x[0] * x[1] + x[1] * x[1]; };
  const Lattice lattice = { { 0.31, 0.32, 0.33 }, { 0.021, 0.022, 0.023 }, { 18, 17, 16 } };
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 6, kind.cells, 0.05, false);
    mesh->GetPointData()->SetScalars(addPointArray(mesh, "N", field));
    for (const vtkIdType each : { 1, 2 })
    {
      const auto cut = filters::withoutPolyhedra(asPolyhedra(mesh, 0, each));
      const std::vector<double> values = sampled(cut, lattice);
      double error = 0;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        error = std::max(error, std::abs(values[i] - field(pointOf(lattice, i))));
      }
      EXPECT_LT(error, 5e-4) << kind.name << each; // of 0.05 from the corners' mean
    }
  }
}

// Faces between polyhedra and other cells are shared: those left are the cube's.
TEST(Polyhedra, ShareFacesWithOtherCells)
{
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 3, kind.cells, 0.05, false);
    mesh->GetPointData()->SetScalars(addPointArray(mesh, "N", linear));
    const auto facesOf = [](vtkDataSet* data)
    {
      std::vector<vtkIdType> all(static_cast<std::size_t>(data->GetNumberOfCells()));
      std::iota(all.begin(), all.end(), 0);
      return filters::unsharedFaces(filters::MeshArrays(data), all).size();
    };
    EXPECT_EQ(facesOf(filters::withoutPolyhedra(asPolyhedra(mesh, 0, 2))), facesOf(mesh))
      << kind.name;
  }
}
