// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Values in cells on lattices: against closed forms, and against what VTK says of each cell.
#include "CellMeshes.h"

#include "Cells/CellSampler.h"
#include "Cells/LinearCells.h"
#include "Cells/PlacesInCell.h"
#include "Cells/Polyhedra.h"

#include "vtkDataSetTriangleFilter.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkXMLUnstructuredGridReader.h"

using filters::CellSampler;
using filters::CellTree;
using schlieren::Lattice;

namespace
{

struct Found
{
  std::vector<double> values;
  std::vector<unsigned char> found;
};

Found sampled(const std::vector<vtkDataSet*>& blocks, const Lattice& lattice)
{
  const CellTree tree(blocks);
  const auto size = static_cast<std::size_t>(lattice.size());
  Found result{ std::vector<double>(size, -1), std::vector<unsigned char>(size, 9) };
  CellSampler(tree).sample(lattice, result.values.data(), result.found.data());
  return result;
}

/// A lattice whose points at the ends lie on the faces of the unit cube.
Lattice unitLattice(int n)
{
  const double spacing = 1. / (n - 1);
  return { { 0, 0, 0 }, { spacing, spacing, spacing }, { n, n, n } };
}

/// Finds the parametric coordinates of a place by VTK's functions and Newton's method. Returns by how much the worst one
/// is out of its range; infinite where it is not found.
double coordinatesOf(vtkCell* cell, const Vec& x, Vec& at)
{
  const auto count = static_cast<std::size_t>(cell->GetNumberOfPoints());
  std::vector<double> functions(count), slopes(3 * count);
  at = { 0.3, 0.3, 0.3 };
  for (int step = 0; step < 20; ++step)
  {
    cell->InterpolateFunctions(at.data(), functions.data());
    cell->InterpolateDerivs(at.data(), slopes.data());
    Vec rest = x, columns[3]{}, rows[3];
    for (std::size_t i = 0; i < count; ++i)
    {
      Vec point;
      cell->GetPoints()->GetPoint(static_cast<vtkIdType>(i), point.data());
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        rest[axis] -= functions[i] * point[axis];
        for (std::size_t along = 0; along < 3; ++along)
        {
          columns[along][axis] += slopes[along * count + i] * point[axis];
        }
      }
    }
    if (std::max({ std::abs(rest[0]), std::abs(rest[1]), std::abs(rest[2]) }) < 1e-14)
    {
      break;
    }
    if (step == 19 || !filters::invert(columns, rows))
    {
      return HUGE_VAL;
    }
    for (std::size_t along = 0; along < 3; ++along)
    {
      at[along] = std::clamp(at[along] + filters::dot(rows[along], rest), -1., 2.);
    }
  }
  const double slant = cell->GetCellType() == VTK_TETRA ? at[0] + at[1] + at[2]
    : cell->GetCellType() == VTK_WEDGE                  ? at[0] + at[1]
                                                        : 0;
  return std::max({ 0., -at[0], -at[1], -at[2], at[0] - 1, at[1] - 1, at[2] - 1, slant - 1 });
}

/// Of all cells, in their order, the first that holds a point best.
Found eachCell(vtkDataSet* block, const Lattice& lattice)
{
  Found result;
  for (std::size_t i = 0; i < static_cast<std::size_t>(lattice.size()); ++i)
  {
    const Vec x = pointOf(lattice, i);
    double value = 0,
           least =
             1e-4; // how far out of a cell points may be: less than neighbours on this lattice are
    bool isFound = false;
    for (vtkIdType number = 0; number < block->GetNumberOfCells(); ++number)
    {
      double bounds[6];
      block->GetCellBounds(number, bounds);
      if (x[0] < bounds[0] - 0.1 || x[0] > bounds[1] + 0.1 || x[1] < bounds[2] - 0.1 ||
        x[1] > bounds[3] + 0.1 || x[2] < bounds[4] - 0.1 || x[2] > bounds[5] + 0.1)
      {
        continue;
      }
      vtkCell* cell = block->GetCell(number);
      Vec at;
      const double miss = coordinatesOf(cell, x, at);
      if (miss >= least)
      {
        continue;
      }
      least = miss;
      isFound = true;
      double functions[8];
      cell->InterpolateFunctions(at.data(), functions);
      value = 0;
      for (int k = 0; k < cell->GetNumberOfPoints(); ++k)
      {
        value +=
          functions[k] * block->GetPointData()->GetScalars()->GetComponent(cell->GetPointId(k), 0);
      }
    }
    result.values.push_back(value);
    result.found.push_back(isFound ? 1 : 0);
  }
  return result;
}

void setN(vtkDataSet* data, const ScalarField& field)
{
  data->GetPointData()->SetScalars(addPointArray(data, "N", field));
}

double rough(const Vec& x) { return std::sin(1e4 * (x[0] + x[1] + 2 * x[2])); }

/// The largest error of a linear field at points that were found; all are to be found.
double errorOf(const Found& found, const Lattice& lattice)
{
  double error = 0;
  EXPECT_EQ(std::count(found.found.begin(), found.found.end(), 1), lattice.size());
  for (std::size_t i = 0; i < found.values.size(); ++i)
  {
    error = std::max(error, std::abs(found.values[i] - linear(pointOf(lattice, i))));
  }
  return error;
}

double difference(const Found& a, const Found& b)
{
  EXPECT_EQ(a.found, b.found);
  double most = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
  {
    most = std::max(most, std::abs(a.values[i] - b.values[i]));
  }
  return most;
}

class CellsOnLattices : public testing::TestWithParam<CellKind>
{
};

/// The cells of a mesh with others in between.
Mesh with(vtkUnstructuredGrid* good, int type, const std::vector<std::vector<vtkIdType>>& bad,
  vtkPoints* points)
{
  auto mesh = Mesh::New();
  mesh->SetPoints(points);
  for (const std::vector<vtkIdType>& cell : bad)
  {
    mesh->InsertNextCell(type, static_cast<vtkIdType>(cell.size()), cell.data());
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < good->GetNumberOfCells(); ++i)
  {
    good->GetCellPoints(i, ids);
    mesh->InsertNextCell(good->GetCellType(i), ids);
  }
  return mesh;
}

} // namespace

TEST_P(CellsOnLattices, InterpolateLinearFieldsExactlyAndLeaveNoHoles)
{
  for (const double by : { 0., 0.1 })
  {
    const Mesh mesh = meshOf(GetParam().type, 3, GetParam().cells, by, false);
    setN(mesh, linear);
    for (const int n : { 2, 4, 19, 31 })
    {
      EXPECT_LT(errorOf(sampled({ mesh }, unitLattice(n)), unitLattice(n)), 1e-15) << n;
    }
  }
}

TEST_P(CellsOnLattices, AreWhatEachCellSays)
{
  const Mesh mesh = meshOf(GetParam().type, 3, GetParam().cells, 0.1, false);
  setN(mesh, rough);
  const Lattice lattice = { { -0.103, -0.101, -0.107 }, { 0.11, 0.1, 0.09 }, { 11, 12, 13 } };
  EXPECT_LT(difference(sampled({ mesh }, lattice), eachCell(mesh, lattice)), 5e-12);
}

INSTANTIATE_TEST_SUITE_P(Types, CellsOnLattices, testing::ValuesIn(linearKinds()),
  [](const auto& tested) { return tested.param.name; });

// Structured data have no lists of points; what VTK says of their cells is the truth.
TEST(CellSampler, TakesStructuredData)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 5, 6);
  image->SetSpacing(1. / 3, 1. / 4, 1. / 5);
  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(4, 5, 6);
  vtkNew<vtkStructuredGrid> curvilinear;
  curvilinear->SetDimensions(4, 5, 6);
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkDoubleArray> places;
    for (int i = 0; i < 4 + axis; ++i)
    {
      places->InsertNextValue(std::pow(i / (3. + axis), 1.5));
    }
    axis == 0
      ? rectilinear->SetXCoordinates(places)
      : (axis == 1 ? rectilinear->SetYCoordinates(places) : rectilinear->SetZCoordinates(places));
  }
  for (const bool isDouble : { false, true })
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(isDouble ? VTK_DOUBLE : VTK_FLOAT);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      Vec x;
      image->GetPoint(i, x.data());
      points->InsertNextPoint(moved(x, 0.1).data());
    }
    curvilinear->SetPoints(points);
    for (vtkDataSet* data : { static_cast<vtkDataSet*>(image),
           static_cast<vtkDataSet*>(rectilinear), static_cast<vtkDataSet*>(curvilinear) })
    {
      setN(data, rough);
      const Lattice lattice = { { -0.1, -0.1, -0.1 }, { 0.06, 0.07, 0.08 }, { 20, 18, 16 } };
      EXPECT_LT(difference(sampled({ data }, lattice), eachCell(data, lattice)), 1e-11);
    }
  }
}

TEST(CellSampler, TheFirstOfOverlappingBlocksCounts)
{
  std::vector<vtkSmartPointer<vtkDataSet>> blocks;
  std::vector<vtkDataSet*> all;
  for (int i = 0; i < 3; ++i)
  {
    const CellKind kind = linearKinds()[static_cast<std::size_t>(i)];
    const Mesh mesh = meshOf(kind.type, 2 + i, kind.cells, 0.1, false);
    setN(mesh, [i](const Vec&) { return 1 + i; });
    blocks.emplace_back(mesh);
    all.push_back(mesh);
  }
  const Found result = sampled(all, unitLattice(17));
  for (const double value : result.values)
  {
    EXPECT_NEAR(value, 1, 1e-14);
  }
}

// A hidden cell, and one of whose points has no value: others may hold their points, else nothing is found.
TEST(CellSampler, FindsNothingWhereThereIsNoGas)
{
  const Mesh mesh = meshOf(VTK_HEXAHEDRON, 3, { unitCell(VTK_HEXAHEDRON, 8) }, 0, false);
  setN(mesh, linear);
  const Mesh behind = Mesh::New();
  behind->DeepCopy(mesh);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(27);
  ghosts->FillValue(0);
  ghosts->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  mesh->GetCellData()->AddArray(ghosts);
  vtkNew<vtkIdList> points;
  mesh->GetCellPoints(26, points);
  mesh->GetPointData()->GetScalars()->SetComponent(points->GetId(6), 0, std::nan(""));
  const Lattice lattice = unitLattice(20); // no point on a face inside
  const Found result = sampled({ mesh }, lattice);
  for (std::size_t i = 0; i < result.found.size(); ++i)
  {
    const Vec x = pointOf(lattice, i);
    const bool isIn =
      std::max({ x[0], x[1], x[2] }) < 1. / 3 || std::min({ x[0], x[1], x[2] }) > 2. / 3;
    EXPECT_EQ(result.found[i], isIn ? 0 : 1) << x[0] << " " << x[1] << " " << x[2];
    if (isIn)
    {
      EXPECT_EQ(result.values[i], 0);
    }
  }
  EXPECT_LT(errorOf(sampled({ mesh, behind }, lattice), lattice), 1e-15);
}

TEST(CellSampler, BadCellsHarmNoOthers)
{
  const Mesh good = meshOf(VTK_HEXAHEDRON, 3, { unitCell(VTK_HEXAHEDRON, 8) }, 0.1, false);
  const Lattice lattice = unitLattice(16);
  for (const double far : { 0.5, std::nan(""), HUGE_VAL, 1e30 })
  {
    vtkNew<vtkPoints> points;
    points->DeepCopy(good->GetPoints());
    const vtkIdType bad = points->InsertNextPoint(far, 0.5, 0.5);
    const std::pair<int, std::size_t> types[] = { { VTK_HEXAHEDRON, 8 }, { VTK_WEDGE, 6 },
      { VTK_PYRAMID, 5 }, { VTK_TETRA, 4 }, { VTK_VOXEL, 8 } };
    for (const auto& [type, count] : types)
    {
      std::vector<vtkIdType> none = { 0, 0, 0, 0, bad, bad, bad, bad },
                             flat = { 0, 1, 2, 3, 0, 1, 2, 3 };
      none.resize(count);
      flat.resize(count);
      const Mesh mesh = with(good, type, { none, flat }, points);
      setN(mesh, linear);
      EXPECT_LT(errorOf(sampled({ mesh }, lattice), lattice), far == 1e30 ? 1e-12 : 1e-15)
        << far << " " << type;
    }
  }
  // Inside out, all of them or some.
  for (const vtkIdType each : { 1, 2, 7 })
  {
    const Mesh turned = withSwapped(good, upsideDown, each);
    setN(turned, linear);
    EXPECT_LT(errorOf(sampled({ turned }, lattice), lattice), 1e-15) << each;
  }
}

// A hexahedron with edges, faces or all but a wedge collapsed, as around the axis of a mesh.
TEST(CellSampler, CollapsedHexahedraLeaveNoHoles)
{
  const auto grid = ballWithPoles();
  setN(grid, linear);
  for (const int n : { 5, 17, 32 })
  {
    const double spacing = 1.04 / (n - 1); // with points on the axis, for odd n
    const Lattice lattice = { { -0.52, -0.52, -0.52 }, { spacing, spacing, spacing }, { n, n, n } };
    EXPECT_LT(errorOf(sampled({ grid }, lattice), lattice), 1e-11) << n;
  }
}

TEST(CellSampler, TakesCellsFarAway)
{
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 3, kind.cells, 0.1, false);
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      double x[3];
      mesh->GetPoint(i, x);
      mesh->GetPoints()->SetPoint(i, 1e7 + 1e-2 * x[0], 1e7 + 1e-2 * x[1], 1e7 + 1e-2 * x[2]);
    }
    setN(mesh, linear);
    const double* bounds = mesh->GetBounds();
    Lattice lattice;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lattice.first[axis] = bounds[2 * axis];
      lattice.spacing[axis] = (bounds[2 * axis + 1] - bounds[2 * axis]) / 20;
      lattice.points[axis] = 21;
    }
    const Found found = sampled({ mesh }, lattice);
    EXPECT_EQ(std::count(found.found.begin(), found.found.end(), 1), lattice.size()) << kind.name;
  }
}

// Each point is itself, whatever is computed along with it.
TEST(CellSampler, AllInstructionsGiveTheSame)
{
  filters::NormalCell cell{ filters::CellShape::Hexahedron, false, true,
    { { 0.1, -0.2, 0.15, 0.05 }, { 0.2, 0.1, 0.1, -0.1 }, { -0.1, 0.1, 0.05, 0.2 } },
    { 1, 2, 3, 4, 5, 6, 7, 8 },
    { { 2, 1, 1, 2, 1, 3, 1, 2 }, { 3, 2, 1, 1, 2, 1, 2, 1 }, { 1, 3, 2, 2, 1, 1, 1, 3 } },
    { { -2, 0, 0, 1, 0, 0, 0, 0 }, { 9, 0, 1, 1, 0, 0, 0, 0 } } };
  const auto all = filters::functionsToLocate();
  ASSERT_GE(all.size(), 1u);
  const auto setPoints = [](filters::CellPoints& points, int first, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        points.normal[axis][i] = 0.8 * std::sin((first + i + 1) * (axis + 1.3));
      }
    }
  };
  filters::CellPoints expected;
  setPoints(expected, 0, 100);
  all[0](cell, 93, expected);
  int inside = 0;
  for (const auto locate : all)
  {
    filters::CellPoints together, alone;
    setPoints(together, 0, 100);
    locate(cell, 93, together);
    for (int i = 0; i < 93; ++i)
    {
      setPoints(alone, i, 8);
      locate(cell, 1, alone);
      EXPECT_EQ(alone.miss[0], together.miss[i]);
      EXPECT_EQ(alone.value[0], together.value[i]);
      if (together.miss[i] < 1e-3)
      {
        ++inside;
        EXPECT_NEAR(together.value[i], expected.value[i], 1e-12);
        EXPECT_NEAR(together.miss[i], expected.miss[i], 1e-12);
      }
    }
  }
  EXPECT_GT(inside, 8 * static_cast<int>(all.size()));
}
