// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes that do not share points where they meet: blocks, appended meshes, discontinuous elements.
#include "CellMeshes.h"

#include "CutMesh.h"
#include "Input/CoincidentPoints.h"
#include "Walls/LatticeSampling.h"

#include "vtkAppendFilter.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"

namespace
{

constexpr double peak = 1e-4, width = 0.35;
constexpr int pixels = 32;

/// A column along z.
double column(const Vec& x)
{
  return peak * (1 + std::exp(-(x[0] * x[0] + x[1] * x[1]) / (width * width)));
}

/// A grid of hexahedra from one corner to the other, so many along each axis.
vtkSmartPointer<vtkStructuredGrid> gridOf(
  const Vec& low, const Vec& high, const std::array<int, 3>& cells)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(cells[0] + 1, cells[1] + 1, cells[2] + 1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k <= cells[2]; ++k)
  {
    for (int j = 0; j <= cells[1]; ++j)
    {
      for (int i = 0; i <= cells[0]; ++i)
      {
        points->InsertNextPoint(low[0] + (high[0] - low[0]) * i / cells[0],
          low[1] + (high[1] - low[1]) * j / cells[1], low[2] + (high[2] - low[2]) * k / cells[2]);
      }
    }
  }
  grid->SetPoints(points);
  return grid;
}

Mesh meshFrom(vtkDataSet* data)
{
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(data);
  append->Update();
  return append->GetOutput();
}

Mesh tetrahedraOf(vtkDataSet* data)
{
  vtkNew<vtkDataSetTriangleFilter> cut;
  cut->SetInputData(data);
  cut->Update();
  return cut->GetOutput();
}

/// What an element makes of a field: the value at a corner, given the places of all.
using ValueInCell = std::function<double(const std::vector<Vec>& corners, std::size_t corner)>;

/// The same cells, each with points of its own, moved by rounding.
Mesh withOwnPoints(vtkDataSet* mesh, const ValueInCell& valueOf)
{
  auto result = Mesh::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("N");
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    mesh->GetCellPoints(cell, ids);
    std::vector<Vec> corners;
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      mesh->GetPoint(ids->GetId(i), corners.emplace_back().data());
      const double rounded = 1 + 1e-15 * static_cast<double>(cell % 5);
      ids->SetId(i,
        points->InsertNextPoint(
          corners.back()[0] * rounded, corners.back()[1] * rounded, corners.back()[2] * rounded));
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      values->InsertNextValue(valueOf(corners, i));
    }
    result->InsertNextCell(mesh->GetCellType(cell), ids);
  }
  result->SetPoints(points);
  result->GetPointData()->AddArray(values);
  return result;
}

Vec middleOf(const std::vector<Vec>& corners)
{
  Vec middle{ 0, 0, 0 };
  for (const Vec& x : corners)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] += x[axis] / static_cast<double>(corners.size());
    }
  }
  return middle;
}

/// Linear in each cell, with the value in the middle, and so much of the differences to the corners.
ValueInCell limited(const ScalarField& field, double part)
{
  return [=](const std::vector<Vec>& corners, std::size_t corner)
  {
    const Vec middle = middleOf(corners);
    double value = field(middle);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vec x = middle;
      x[axis] = corners[corner][axis];
      value += part * (field(x) - field(middle));
    }
    return value;
  };
}

vtkSmartPointer<vtkSchlierenFilter> straightBench(
  vtkDataObject* input, bool ofCells, bool isWhole = true)
{
  auto filter = bench(input, pixels);
  filter->SetPathModel(vtkSchlierenFilter::STRAIGHT);
  if (ofCells)
  {
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  }
  filter->Update();
  if (isWhole)
  {
    EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
  }
  return filter;
}

bool isInTheMiddle(const Vec& x) { return std::max(std::abs(x[0]), std::abs(x[1])) < 0.9; }

/// Largest error of the deflection to the right, by the largest there is, of pixels that are chosen.
double errorOf(vtkSchlierenFilter* filter, const std::function<double(const Vec&)>& expected,
  const std::function<bool(const Vec&)>& isChosen = isInTheMiddle)
{
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  vtkDataArray* deflection = arrayOf(filter, "Deflection");
  double error = 0, most = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Vec x;
    image->GetPoint(i, x.data());
    most = std::max(most, std::abs(expected(x)));
    if (isChosen(x))
    {
      error = std::max(error, std::abs(deflection->GetComponent(i, 0) - expected(x)));
    }
  }
  return error / most;
}

/// Deflection by the column, which is `length` long.
std::function<double(const Vec&)> byColumn(double length)
{
  return [=](const Vec& x) {
    return -2 * x[0] / (width * width) * (column({ x[0], x[1], 0 }) - peak) * length;
  };
}

/// Light is blocked within a square of half edge `inner`, and nowhere beyond one of `outer`.
void expectSquare(vtkSchlierenFilter* filter, double inner, double outer)
{
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  vtkDataArray* blocked = arrayOf(filter, "BlockedFraction");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Vec x;
    image->GetPoint(i, x.data());
    const double reach = std::max(std::abs(x[0]), std::abs(x[1]));
    if (reach < inner || reach > outer)
    {
      EXPECT_EQ(blocked->GetComponent(i, 0), reach < inner ? 1 : 0) << x[0] << " " << x[1];
    }
  }
}

} // namespace

TEST(SharedPoints, PointsAreOneHoweverLargeOthersToleranceIs)
{
  const std::vector<filters::Point> points{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1e-5 }, { 0, 0, 0 },
    { 1, 0, 1e-8 }, { 1, 0, 2e-5 } };
  const std::vector<double> sizes{ 1e3, 1e-3, 0.1, 1e-6, 1, 1e-3 }; // 1000 times the tolerances
  const std::vector<std::int32_t> numbers = filters::coincidentPoints(points, sizes);
  // 2 and 4 are one, and so are 1 and 4; 5 is too far away from them for its own tolerance.
  EXPECT_EQ(numbers, (std::vector<std::int32_t>{ 0, 1, 1, 0, 1, 5 }));
}

TEST(SharedPoints, BlocksHaveNoSeams)
{
  const auto whole = gridOf({ -1, -1, -1 }, { 1, 1, 1 }, { 12, 12, 6 });
  addPointArray(whole, "N", column);
  addCellArray(whole, "N", column);
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkAppendFilter> append;
  for (unsigned number = 0; number < 8; ++number)
  {
    Vec low, high;
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      low[axis] = (number >> axis & 1u) != 0 ? 0 : -1;
      high[axis] = low[axis] + 1;
    }
    const auto grid = gridOf(low, high, { 6, 6, 3 });
    addPointArray(grid, "N", column);
    addCellArray(grid, "N", column);
    vtkSmartPointer<vtkDataSet> block = grid;
    if (number % 2 != 0) // of both kinds
    {
      block = meshFrom(grid);
    }
    blocks->SetBlock(number, block);
    append->AddInputData(block);
  }
  append->Update();
  for (const bool ofCells : { false, true })
  {
    const auto expected = valuesOf(straightBench(whole, ofCells), "Deflection");
    for (vtkDataObject* other :
      std::initializer_list<vtkDataObject*>{ blocks, append->GetOutput() })
    {
      EXPECT_LT(
        relativeDifference(valuesOf(straightBench(other, ofCells), "Deflection"), expected), 1e-3)
        << other->GetClassName() << ofCells;
    }
  }
}

// An O-grid: its first and last points along the angle coincide but for rounding, where the field is steep.
TEST(SharedPoints, AGridThatMeetsItselfHasNoSeam)
{
  constexpr double inner = 0.2, outer = 1.2;
  const auto grid = gridOf({ 0, inner, -0.5 }, { 2 * pi, outer, 0.5 }, { 48, 24, 2 });
  vtkPoints* points = grid->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Vec x;
    points->GetPoint(i, x.data());
    points->SetPoint(i, -x[1] * std::sin(x[0]), x[1] * std::cos(x[0]), x[2]);
  }
  const ScalarField field = [](const Vec& x) { return column({ x[0], x[1] - 0.7, 0 }); };
  addPointArray(grid, "N", field);
  addCellArray(grid, "N", field);
  const auto expected = [](const Vec& x) { return byColumn(1)({ x[0], x[1] - 0.7, 0 }); };
  const auto isAround = [](const Vec& x)
  {
    const double r = std::hypot(x[0], x[1]);
    return r > inner + 0.1 && r < outer - 0.1;
  };
  // 0.083 and 0.26 with a seam
  EXPECT_LT(errorOf(straightBench(grid, false, false), expected, isAround), 0.05);
  EXPECT_LT(errorOf(straightBench(grid, true, false), expected, isAround), 0.08);
}

// What is continuous is as with shared points; where values jump, what is left is hardly worse.
TEST(SharedPoints, DiscontinuousElementsAreAsGoodAsOthers)
{
  const auto grid = gridOf({ -1, -1, -0.5 }, { 1, 1, 0.5 }, { 28, 28, 2 });
  const auto expected = byColumn(1);
  const auto atCorner = [](const std::vector<Vec>& corners, std::size_t corner)
  { return column(corners[corner]); };
  for (const vtkSmartPointer<vtkDataSet>& mesh :
    std::vector<vtkSmartPointer<vtkDataSet>>{ meshFrom(grid), tetrahedraOf(grid) })
  {
    addPointArray(mesh, "N", column);
    const double shared = errorOf(straightBench(mesh, false), expected);
    EXPECT_LT(shared, 0.04);
    const double own = errorOf(straightBench(withOwnPoints(mesh, atCorner), false), expected);
    EXPECT_NEAR(own, shared, 0.02 * shared);
    for (const double part : { 0., 0.5 })
    {
      const Mesh jumping = withOwnPoints(mesh, limited(column, part));
      EXPECT_LT(errorOf(straightBench(jumping, false), expected), 1.5 * shared + 0.02) << part;
    }
  }
}

// Across one or two cells; a code holds it there. Light passes, and is bent as much as the field says.
TEST(SharedPoints, ShocksInDiscontinuousElementsAreNoWalls)
{
  const auto grid = gridOf({ -1, -1, -1 }, { 1, 1, 1 }, { 30, 3, 30 });
  constexpr double thickness = 0.05; // of a shock from 10 to 90 %: 2.2 of these, 1.6 cells
  const ScalarField field = [](const Vec& x)
  { return peak * (2 + std::tanh((x[2] + 0.5 * x[0]) / thickness)); };
  const auto expected = [](const Vec& x)
  {
    return 0.5 * peak *
      (std::tanh((1 + 0.5 * x[0]) / thickness) - std::tanh((-1 + 0.5 * x[0]) / thickness));
  };
  for (const double part : { 0., 0.5, 1. })
  {
    const Mesh mesh = withOwnPoints(grid, limited(field, part));
    auto filter = bench(mesh, pixels);
    filter->SetPathModel(vtkSchlierenFilter::STRAIGHT);
    filter->Update();
    EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0) << part;
    EXPECT_LT(errorOf(filter, expected), 0.15) << part;
  }
}

// A cell without a value hides itself alone, though others have values at its points.
TEST(SharedPoints, ACellWithoutAValueStaysOne)
{
  const auto grid = gridOf({ -1, -1, -1 }, { 1, 1, 1 }, { 5, 5, 1 });
  const Mesh mesh = withOwnPoints(grid,
    [](const std::vector<Vec>& corners, std::size_t corner)
    {
      const Vec middle = middleOf(corners);
      const bool isHole = std::max(std::abs(middle[0]), std::abs(middle[1])) < 0.1;
      return isHole ? std::nan("") : column(corners[corner]);
    });
  auto filter = bench(mesh, pixels);
  expectSquare(filter, 0.15, 0.25);
}
