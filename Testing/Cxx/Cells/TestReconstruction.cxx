// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is made of values at points, in cells: smoother than what is linear along each edge.
#include "CellMeshes.h"

#include "Cells/CellMeans.h"
#include "Cells/CellSampler.h"
#include "Cells/PointFit.h"

#include "vtkDataSetTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <random>

using filters::CellSampler;
using filters::CellTree;
using schlieren::Lattice;
using Reconstruction = filters::CellTree::Reconstruction;
using filters::operator+;
using filters::operator-;
using filters::operator*;

namespace
{

void setN(vtkDataSet* data, const ScalarField& field)
{
  data->GetPointData()->SetScalars(addPointArray(data, "N", field));
}

/// n^3 boxes in the unit cube, each cut into five tetrahedra, their points moved at random by so many cells.
Mesh jittered(int n, double by)
{
  vtkNew<vtkDataSetTriangleFilter> toTetrahedra;
  toTetrahedra->SetInputData(cube(n + 1));
  toTetrahedra->Update();
  Mesh mesh = toTetrahedra->GetOutput();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-by / n, by / n);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    Vec x;
    mesh->GetPoint(i, x.data());
    for (double& along : x)
    {
      along = (along + 1) / 2;
      const double moved = move(random);
      along += along > 1e-6 && along < 1 - 1e-6 ? moved : 0;
    }
    points->InsertNextPoint(x.data());
  }
  mesh->SetPoints(points);
  return mesh;
}

/// Boxes in the unit cube as hexahedra, their points moved at random by so many cells.
Mesh boxesOf(const std::array<int, 3>& n, double by)
{
  auto mesh = Mesh::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-by, by);
  for (int k = 0; k <= n[2]; ++k)
  {
    for (int j = 0; j <= n[1]; ++j)
    {
      for (int i = 0; i <= n[0]; ++i)
      {
        const int at[3] = { i, j, k };
        double x[3];
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double moved = at[axis] > 0 && at[axis] < n[axis] ? move(random) : 0;
          x[axis] = (at[axis] + moved) / n[axis];
        }
        points->InsertNextPoint(x);
      }
    }
  }
  mesh->SetPoints(points);
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const vtkIdType row = n[0] + 1, layer = row * (n[1] + 1), first = k * layer + j * row + i;
        const vtkIdType ids[8] = { first, first + 1, first + row + 1, first + row, first + layer,
          first + layer + 1, first + layer + row + 1, first + layer + row };
        mesh->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
      }
    }
  }
  return mesh;
}

/// Calls visit(x, weight) for places in a tetrahedron, exact to the second degree in each of 8^depth parts.
template <class Visit>
void forPlacesIn(const std::array<Vec, 4>& corners, int depth, const Visit& visit)
{
  const auto between = [&](std::size_t a, std::size_t b)
  { return 0.5 * (corners[a] + corners[b]); };
  if (depth > 0)
  {
    const Vec m[6] = { between(0, 1), between(0, 2), between(0, 3), between(1, 2), between(1, 3),
      between(2, 3) };
    const std::array<Vec, 4> parts[8] = { { corners[0], m[0], m[1], m[2] },
      { m[0], corners[1], m[3], m[4] }, { m[1], m[3], corners[2], m[5] },
      { m[2], m[4], m[5], corners[3] }, { m[0], m[1], m[2], m[4] }, { m[0], m[1], m[3], m[4] },
      { m[1], m[2], m[4], m[5] }, { m[1], m[3], m[4], m[5] } };
    for (const auto& part : parts)
    {
      forPlacesIn(part, depth - 1, visit);
    }
    return;
  }
  const double volume = std::abs(dot(corners[1] - corners[0],
                          cross(corners[2] - corners[0], corners[3] - corners[0]))) /
    6;
  const Vec sum = corners[0] + corners[1] + corners[2] + corners[3];
  for (const Vec& corner : corners)
  {
    constexpr double near = 0.58541019662496852, far = 0.1381966011250105;
    visit(far * sum + (near - far) * corner, volume / 4);
  }
}

/// Calls visit(x, weight) for places in a cell, cut into tetrahedra.
template <class Visit>
void forPlacesIn(vtkCell* cell, int depth, const Visit& visit)
{
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  cell->Triangulate(0, ids, points);
  for (vtkIdType first = 0; first < points->GetNumberOfPoints(); first += 4)
  {
    std::array<Vec, 4> corners;
    for (std::size_t i = 0; i < 4; ++i)
    {
      points->GetPoint(first + static_cast<vtkIdType>(i), corners[i].data());
    }
    forPlacesIn(corners, depth, visit);
  }
}

/// Gives a mesh the means of a field over its cells, as the filter does before it looks into the cells.
void setMeans(vtkDataSet* data, const ScalarField& field, int depth = 1)
{
  vtkNew<vtkDoubleArray> ofCells, ofPoints;
  vtkNew<vtkUnsignedCharArray> valid;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    double sum = 0, volume = 0;
    forPlacesIn(data->GetCell(i), depth,
      [&](const Vec& x, double weight)
      {
        sum += weight * field(x);
        volume += weight;
      });
    ofCells->InsertNextValue(sum / volume);
    valid->InsertNextValue(1);
  }
  ofPoints->SetNumberOfValues(data->GetNumberOfPoints());
  data->GetPointData()->SetScalars(ofPoints);
  data->GetCellData()->SetScalars(ofCells);
  std::vector<filters::CellsAround> around;
  filters::setMeansAroundPoints(filters::MeshArrays(data), ofCells, valid, ofPoints, &around);
  data->GetPointData()->AddArray(filters::arrayOf(around));
}

struct Found
{
  std::vector<double> values;
  std::vector<unsigned char> found;
};

Found sampled(vtkDataSet* mesh, Reconstruction reconstruction, const Lattice& lattice)
{
  const CellTree tree({ mesh }, reconstruction);
  const auto size = static_cast<std::size_t>(lattice.size());
  Found result{ std::vector<double>(size), std::vector<unsigned char>(size) };
  CellSampler(tree).sample(lattice, result.values.data(), result.found.data());
  return result;
}

struct Errors
{
  double deflection, divergence; // rms, of the largest
};

/// Of light along z through what is interpolated in the middle of the unit cube, against that of the field itself.
Errors errorsOf(vtkDataSet* mesh, Reconstruction reconstruction, const ScalarField& field, int n)
{
  const CellTree tree({ mesh }, reconstruction);
  const CellSampler sampler(tree);
  const double h = 1. / n;
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> errors(size * size, 0), truth(size * size, 0);
  std::vector<double> layer(size * size);
  std::vector<unsigned char> found(size * size);
  for (int k = 0; k < n; ++k)
  {
    const Lattice lattice = { { h / 2, h / 2, (k + 0.5) * h }, { h, h, h }, { n, n, 1 } };
    sampler.sample(lattice, layer.data(), found.data());
    for (std::size_t i = 0; i < layer.size(); ++i)
    {
      EXPECT_EQ(found[i], 1);
      const double exact = field({ (static_cast<double>(i % size) + 0.5) * h,
        (static_cast<double>(i / size) + 0.5) * h, (k + 0.5) * h });
      errors[i] += h * (layer[i] - exact);
      truth[i] += h * exact;
    }
  }
  double sums[2] = { 0, 0 }, most[2] = { 0, 0 };
  int count = 0;
  for (std::size_t j = 1; j + 1 < size; ++j)
  {
    for (std::size_t i = 1; i + 1 < size; ++i)
    {
      const std::size_t at = j * size + i;
      const auto derivatives = [&](const std::vector<double>& of)
      {
        const double right = of[at + 1], left = of[at - 1], up = of[at + size],
                     down = of[at - size];
        return std::array<double, 2>{ std::hypot(right - left, up - down) / (2 * h),
          (right + left + up + down - 4 * of[at]) / (h * h) };
      };
      const auto wrong = derivatives(errors), right = derivatives(truth);
      for (std::size_t d = 0; d < 2; ++d)
      {
        sums[d] += wrong[d] * wrong[d];
        most[d] = std::max(most[d], std::abs(right[d]));
      }
      ++count;
    }
  }
  return { std::sqrt(sums[0] / count) / most[0], std::sqrt(sums[1] / count) / most[1] };
}

double ball(const Vec& x)
{
  const double s = 0.25; // ten cells
  const Vec r = { (x[0] - 0.5) / s, (x[1] - 0.5) / s, (x[2] - 0.5) / s };
  return 3e-4 * std::exp(-dot(r, r));
}

double quadratic(const Vec& x)
{
  return 1 + x[0] - x[1] * x[2] + 2 * x[2] * x[2] - 3 * x[0] * x[1] + x[1] * x[1];
}

/// Of a curved front at a place, in meshes of all kinds that set(mesh, front) gives its values.
template <class Set>
void expectNoOvershoots(double jump, const Lattice& lattice, const Set& set)
{
  const auto shock = [jump](const Vec& x) { return x[0] + 0.2 * x[1] * x[1] < jump ? 0. : 1.; };
  std::vector<Mesh> meshes = { jittered(16, 0.2) };
  for (const CellKind& kind : linearKinds())
  {
    meshes.push_back(meshOf(kind.type, 8, kind.cells, 0.05, false));
  }
  for (const Mesh& mesh : meshes)
  {
    set(mesh, shock);
    const std::vector<double> values = sampled(mesh, Reconstruction::Smooth, lattice).values;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    EXPECT_GT(*low, -0.0101) << jump;
    EXPECT_LT(*high, 1.0101) << jump;
  }
}

} // namespace

TEST(Reconstruction, ABallOnTetrahedraIsSmooth)
{
  const Mesh mesh = jittered(40, 0.2);
  setN(mesh, ball);
  for (const int n : { 40, 60 })
  {
    const Errors linear = errorsOf(mesh, Reconstruction::Linear, ball, n);
    EXPECT_GT(linear.deflection, 3e-3); // what there is to gain
    EXPECT_GT(linear.divergence, 8e-3);
    const Errors smooth = errorsOf(mesh, Reconstruction::Smooth, ball, n);
    EXPECT_LT(smooth.deflection, 3e-4);
    EXPECT_LT(smooth.divergence, 4e-3);
  }
}

// Where a point has neighbours on all sides.
TEST(Reconstruction, QuadraticFieldsAreExact)
{
  const Lattice lattice = { { 0.31, 0.32, 0.33 }, { 0.021, 0.022, 0.023 }, { 18, 17, 16 } };
  for (const CellKind& kind : linearKinds())
  {
    for (const double by : { 0., 0.1 })
    {
      const Mesh mesh = meshOf(kind.type, 6, kind.cells, by, false);
      setN(mesh, quadratic);
      const Found linear = sampled(mesh, Reconstruction::Linear, lattice);
      const Found smooth = sampled(mesh, Reconstruction::Smooth, lattice);
      double error = 0, wrong = 0;
      for (std::size_t i = 0; i < smooth.values.size(); ++i)
      {
        ASSERT_EQ(smooth.found[i], 1);
        error = std::max(error, std::abs(smooth.values[i] - quadratic(pointOf(lattice, i))));
        wrong = std::max(wrong, std::abs(linear.values[i] - quadratic(pointOf(lattice, i))));
      }
      EXPECT_LT(error, 2e-6) << kind.name;
      EXPECT_GT(wrong, 1e-3) << kind.name;
    }
  }
}

TEST(Reconstruction, PointsKeepTheirValues)
{
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 3, kind.cells, 0.1, false);
    setN(mesh, [](const Vec& x) { return std::sin(1e4 * (x[0] + x[1] + 2 * x[2])); });
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      Vec x;
      mesh->GetPoint(i, x.data());
      const Found found = sampled(mesh, Reconstruction::Smooth, { x, { 1, 1, 1 }, { 1, 1, 1 } });
      EXPECT_EQ(found.found[0], 1);
      EXPECT_NEAR(found.values[0], mesh->GetPointData()->GetScalars()->GetComponent(i, 0), 1e-11);
    }
  }
}

// Across faces, too: no step along a line is larger than the slopes make it.
TEST(Reconstruction, IsContinuous)
{
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 4, kind.cells, 0.1, false);
    setN(mesh, [](const Vec& x) { return std::sin(9 * x[0]) * std::cos(7 * x[1] + 5 * x[2]); });
    const Lattice lattice = { { 5e-6, 0.345, 0.456 }, { 1e-5, 0.1, 0.1 }, { 100000, 2, 2 } };
    const Found found = sampled(mesh, Reconstruction::Smooth, lattice);
    double most = 0;
    for (std::size_t i = 1; i < found.values.size(); ++i)
    {
      most =
        i % 100000 == 0 ? most : std::max(most, std::abs(found.values[i] - found.values[i - 1]));
    }
    EXPECT_LT(most, 1e-3) << kind.name;
  }
}

TEST(Reconstruction, ShocksHaveNoOvershoots)
{
  for (const double jump : { 0.5, 0.27 })
  {
    expectNoOvershoots(jump, { { 0, 0, 0 }, { 0.02, 0.02, 0.02 }, { 51, 51, 51 } },
      [](const Mesh& mesh, const auto& shock) { setN(mesh, shock); });
  }
}

// What the tree says of a box is true of all that is interpolated there.
TEST(Reconstruction, StaysInTheKnownRange)
{
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 5, kind.cells, 0.1, false);
    setN(mesh, [](const Vec& x) { return std::sin(9 * x[0]) * std::cos(12 * x[1] + 5 * x[2]); });
    const CellTree tree({ mesh }, Reconstruction::Smooth);
    for (double at = 0.05; at < 0.9; at += 0.04)
    {
      Found found{ std::vector<double>(4096), std::vector<unsigned char>(4096) };
      CellSampler(tree).sample({ { at, 0.94 - at, at }, { 0.004, 0.004, 0.004 }, { 16, 16, 16 } },
        found.values.data(), found.found.data());
      const CellTree::Content content =
        tree.content({ { at, 0.94 - at, at }, { at + 0.06, 1 - at, at + 0.06 } });
      for (std::size_t i = 0; i < found.values.size(); ++i)
      {
        if (found.found[i])
        {
          ASSERT_GE(found.values[i], content.lowest - 1e-12);
          ASSERT_LE(found.values[i], content.highest + 1e-12);
        }
      }
    }
  }
}

// Cells a thousandth as thick as wide: quadratic fields stay exact, in their thickness, too.
TEST(Reconstruction, TakesStretchedCells)
{
  const auto field = [](const Vec& x)
  {
    const double z = 1e3 * (x[2] - 0.3 * x[0]);
    return 1 + x[0] * x[1] + z * z - x[1] * z;
  };
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 6, kind.cells, 0.1, false);
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      double x[3];
      mesh->GetPoint(i, x);
      mesh->GetPoints()->SetPoint(i, x[0], x[1], 1e-3 * x[2] + 0.3 * x[0]);
    }
    setN(mesh, field);
    const Lattice lattice = { { 0.5, 0.32, 0.15036 }, { 1e-4, 0.022, 3e-5 }, { 5, 17, 10 } };
    const Found found = sampled(mesh, Reconstruction::Smooth, lattice);
    int inside = 0;
    for (std::size_t i = 0; i < found.values.size(); ++i)
    {
      if (found.found[i])
      {
        ++inside;
        ASSERT_NEAR(found.values[i], field(pointOf(lattice, i)), 1e-5) << kind.name;
      }
    }
    EXPECT_GT(inside, 600);
  }
}

// All instructions that this processor has; each point by itself, whatever the others are.
TEST(Reconstruction, FitsOfPointsAreQuadratic)
{
  using filters::PointFit;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> one(-1, 1);
  for (const filters::FitPoints fitPoints : filters::functionsToFit())
  {
    for (const double stretch : { 1., 1e-3 })
    {
      PointFit fit, alone;
      fit.clear(40);
      alone.clear(40);
      std::array<Vec, PointFit::points> gradients;
      for (std::size_t point = 0; point < PointFit::points; ++point)
      {
        gradients[point] = { one(random), one(random) / stretch, one(random) };
        const Vec second = { one(random), one(random), one(random) };
        const int count = point == 5 ? 2 : 12 + 4 * static_cast<int>(point);
        for (int i = 0; i < count; ++i)
        {
          const Vec x = { one(random), stretch * one(random), one(random) };
          const double value = dot(gradients[point], x) + second[0] * x[0] * x[0] +
            second[1] * x[0] * x[2] + second[2] * x[2] * x[2];
          fit.add(point, x.data(), value);
          if (point == 3)
          {
            alone.add(point, x.data(), value);
          }
        }
      }
      fitPoints(fit);
      fitPoints(alone);
      for (std::size_t point = 0; point < PointFit::points; ++point)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double expected = point == 5 ? 0 : gradients[point][axis]; // two say nothing
          const double unit = axis == 1 ? 1 / stretch : 1;
          EXPECT_NEAR(fit.gradient[axis][point], expected, 1e-3 * unit) << point << " " << axis;
        }
        EXPECT_LT(fit.unfit[point], point == 5 ? HUGE_VAL : 1e-4);
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(alone.gradient[axis][3], fit.gradient[axis][3]);
        EXPECT_EQ(alone.gradient[axis][4], 0);
      }
      EXPECT_EQ(alone.unfit[3], fit.unfit[3]);
    }
  }
}

// Ten cells a radius. The mean of the cells around each point is worse by far.
TEST(CellMeans, ABallIsSmooth)
{
  const Mesh tetrahedra = jittered(40, 0.2);
  const Mesh hexahedra = boxesOf({ 40, 40, 40 }, 0.15);
  for (const Mesh& mesh : { tetrahedra, hexahedra })
  {
    setMeans(mesh, ball);
    const Errors smooth = errorsOf(mesh, Reconstruction::Smooth, ball, 60);
    EXPECT_LT(smooth.deflection, 1e-3);
    EXPECT_LT(smooth.divergence, 1e-2);
    mesh->GetPointData()->RemoveArray(filters::cellsAroundName);
    const Errors averaged = errorsOf(mesh, Reconstruction::Smooth, ball, 60);
    EXPECT_GT(averaged.deflection, 6e-3); // what there is to gain
    EXPECT_GT(averaged.divergence, 3e-2);
  }
}

TEST(CellMeans, QuadraticFieldsAreExact)
{
  const Lattice lattice = { { 0.41, 0.42, 0.43 }, { 0.011, 0.012, 0.013 }, { 15, 14, 13 } };
  for (const CellKind& kind : linearKinds())
  {
    for (const double by : { 0., 0.1 })
    {
      const Mesh mesh = meshOf(kind.type, 9, kind.cells, by, false);
      setMeans(mesh, quadratic, 0);
      const Found found = sampled(mesh, Reconstruction::Smooth, lattice);
      double error = 0;
      for (std::size_t i = 0; i < found.values.size(); ++i)
      {
        ASSERT_EQ(found.found[i], 1);
        error = std::max(error, std::abs(found.values[i] - quadratic(pointOf(lattice, i))));
      }
      EXPECT_LT(error, by > 0 ? 1e-3 : 1e-4) << kind.name << by; // of half a unit between cells
    }
  }
}

// Up to the boundary: values continue as far as the points, not only to the cells' middles.
TEST(CellMeans, LinearFieldsReachTheBoundary)
{
  const auto field = [](const Vec& x) { return 2 + x[0] - 0.5 * x[1] + 0.25 * x[2]; };
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 5, kind.cells, 0.1, false);
    setMeans(mesh, field, 0);
    const Lattice lattice = { { 0, 0, 0 }, { 0.05, 0.05, 0.05 }, { 21, 21, 21 } };
    const Found found = sampled(mesh, Reconstruction::Smooth, lattice);
    double error = 0;
    for (std::size_t i = 0; i < found.values.size(); ++i)
    {
      error = std::max(error, std::abs(found.values[i] - field(pointOf(lattice, i))));
    }
    EXPECT_LT(error, 4e-3) << kind.name; // of a tenth between cells' middles and the boundary
  }
}

// But for the boundary, where two cells in a row do not distinguish a shock from a slope.
TEST(CellMeans, ShocksHaveNoOvershoots)
{
  for (const double jump : { 0.5, 0.45, 0.61 })
  {
    expectNoOvershoots(jump, { { 0.16, 0.16, 0.16 }, { 0.02, 0.02, 0.02 }, { 35, 35, 35 } },
      [](const Mesh& mesh, const auto& shock) { setMeans(mesh, shock, 2); });
  }
}

// What is made of cells has their means: of a wave that 16 cells are long, and at a front of three.
TEST(CellMeans, AreKept)
{
  const auto wave = [](const Vec& x) { return std::sin(2 * pi * (x[0] + 0.5 * x[1])); };
  const auto front = [](const Vec& x) { return std::tanh(20 * (x[0] + 0.3 * x[1] - 0.6)); };
  for (const CellKind& kind : linearKinds())
  {
    const Mesh mesh = meshOf(kind.type, 16, kind.cells, 0.1, false);
    for (const auto& [field, most] :
      { std::pair<ScalarField, double>{ wave, 0.005 }, { front, 0.05 } })
    {
      setMeans(mesh, field);
      const CellTree tree({ mesh }, Reconstruction::Smooth);
      const CellSampler sampler(tree);
      double squares = 0;
      int count = 0;
      for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); i += 17)
      {
        double bounds[6];
        mesh->GetCellBounds(i, bounds);
        if (*std::min_element(bounds, bounds + 6) < 0.1 ||
          *std::max_element(bounds, bounds + 6) > 0.9)
        {
          continue;
        }
        double sum = 0, volume = 0;
        forPlacesIn(mesh->GetCell(i), 1,
          [&](const Vec& x, double weight)
          {
            double value = 0;
            unsigned char isFound = 0;
            sampler.sample({ x, { 1, 1, 1 }, { 1, 1, 1 } }, &value, &isFound);
            EXPECT_EQ(isFound, 1);
            sum += weight * value;
            volume += weight;
          });
        const double error = sum / volume - mesh->GetCellData()->GetScalars()->GetComponent(i, 0);
        squares += error * error;
        ++count;
      }
      EXPECT_LT(std::sqrt(squares / count), most) << kind.name;
    }
  }
}

// One layer of cells knows nothing of what changes across it, however its thickness varies.
TEST(CellMeans, OneLayerOfCellsIsUniformAcross)
{
  const auto field = [](const Vec& x) { return std::sin(9 * x[1]) + std::cos(7 * x[0]); };
  const Mesh mesh = boxesOf({ 20, 20, 1 }, 0);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    mesh->GetPoints()->SetPoint(i, x[0], x[1], 0.3 * x[1] * (x[2] - 0.5)); // a wedge
  }
  setMeans(mesh, field);
  const CellTree tree({ mesh }, Reconstruction::Smooth);
  double error = 0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    Vec x;
    mesh->GetPoint(i, x.data());
    const bool isInside = x[0] > 0.15 && x[0] < 0.85 && x[1] > 0.15 && x[1] < 0.85;
    const double value = tree.cell(0).block->values()[i];
    error = isInside ? std::max(error, std::abs(value - field(x))) : error;
  }
  EXPECT_LT(error, 0.004);
}
