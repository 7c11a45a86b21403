// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where gas ends: which faces bound meshes, which of them are walls, and how far from them the points of lattices
// are.
#include "CutMesh.h"
#include "Surfaces.h"

#include "Walls/GasBoundary.h"

#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiBlockPLOT3DReader.h"
#include "vtkOpenFOAMReader.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkStaticCellLocator.h"
#include "vtkStructuredGrid.h"
#include "vtkThreshold.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <random>

using filters::GasBoundary;
using filters::Outside;
using schlieren::Lattice;
using schlieren::Place;

namespace
{

using Data = vtkSmartPointer<vtkDataSet>;
using Mapping = std::function<Vec(double, double, double)>;

/// A curvilinear grid over the unit cube of its parameters, N = 1 everywhere.
vtkSmartPointer<vtkStructuredGrid> curvilinear(
  int ni, int nj, int nk, const Mapping& place, int type = VTK_DOUBLE)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(ni, nj, nk);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  for (int k = 0; k < nk; ++k)
  {
    for (int j = 0; j < nj; ++j)
    {
      for (int i = 0; i < ni; ++i)
      {
        const Vec x = place(i / (ni - 1.), j / (nj - 1.), k / (nk - 1.));
        points->InsertNextPoint(x.data());
      }
    }
  }
  grid->SetPoints(points);
  addPointArray(grid, "N", [](const Vec&) { return 1; });
  grid->GetPointData()->SetActiveScalars("N");
  return grid;
}

/// Around a sphere of radius 1: poles on z, a seam at y = 0. `part`: of the longitude.
Vec aroundSphere(double r, double latitude, double longitude, double far, double part = 1)
{
  const double radius = std::pow(far, r);
  const double theta = pi * latitude, phi = 2 * pi * part * longitude;
  return { radius * std::sin(theta) * std::cos(phi), radius * std::sin(theta) * std::sin(phi),
    radius * std::cos(theta) };
}

vtkSmartPointer<vtkStructuredGrid> sphereMesh(
  int n, double far, int type = VTK_DOUBLE, double part = 1)
{
  return curvilinear(
    n, n + 1, 2 * n + 1,
    [&](double i, double j, double k) { return aroundSphere(i, j, k, far, part); }, type);
}

/// Turned about an axis across all the others.
Vec turned(Vec x)
{
  const Vec a = unit({ 0.3, 0.7, 0.5 });
  const double angle = 0.6;
  const Vec b = cross(a, x);
  const double along = dot(a, x) * (1 - std::cos(angle));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    x[axis] = x[axis] * std::cos(angle) + b[axis] * std::sin(angle) + along * a[axis];
  }
  return x;
}

void turn(vtkPointSet* data)
{
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    Vec x;
    data->GetPoint(i, x.data());
    data->GetPoints()->SetPoint(i, turned(x).data());
  }
}

/// The cells whose array "gas" is not 0, as an unstructured mesh.
Data gasOf(vtkDataSet* data)
{
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(data);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "gas");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  threshold->SetUpperThreshold(0.5);
  threshold->Update();
  Data gas = threshold->GetOutput();
  gas->GetPointData()->SetActiveScalars("N");
  return gas;
}

/// The cells of a box [0, lengths] whose middles are in gas.
Data blocks(
  const std::array<int, 3>& cells, const Vec& lengths, const std::function<bool(const Vec&)>& isGas)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(cells[0] + 1, cells[1] + 1, cells[2] + 1);
  image->SetSpacing(lengths[0] / cells[0], lengths[1] / cells[1], lengths[2] / cells[2]);
  addPointArray(image, "N", [](const Vec&) { return 1; });
  addCellArray(image, "gas", [&](const Vec& x) { return isGas(x) ? 1 : 0; });
  return gasOf(image);
}

void hide(vtkDataSet* data, const std::function<bool(const Vec&)>& isHidden)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    double b[6];
    data->GetCellBounds(i, b);
    const bool is = isHidden({ (b[0] + b[1]) / 2, (b[2] + b[3]) / 2, (b[4] + b[5]) / 2 });
    ghosts->InsertNextValue(is ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  data->GetCellData()->AddArray(ghosts);
}

/// Which visible cells hold a place.
class Cells
{
public:
  explicit Cells(const std::vector<Data>& leaves)
  {
    for (const Data& leaf : leaves)
    {
      vtkNew<vtkStaticCellLocator> locator;
      locator->SetDataSet(leaf);
      locator->BuildLocator();
      locators_.emplace_back(locator);
      ghosts_.push_back(leaf->GetCellGhostArray());
    }
  }
  bool hold(const Vec& x) const
  {
    vtkNew<vtkGenericCell> cell;
    for (std::size_t i = 0; i < locators_.size(); ++i)
    {
      Vec place = x;
      double coordinates[3], weights[64];
      int sub;
      const vtkIdType found =
        locators_[i]->FindCell(place.data(), 1e-20, cell, sub, coordinates, weights);
      if (found >= 0 && (!ghosts_[i] || ghosts_[i]->GetValue(found) == 0))
      {
        return true;
      }
    }
    return false;
  }
  filters::CellTest test() const
  {
    return [this](const filters::Point& x) { return this->hold(x); };
  }

private:
  std::vector<vtkSmartPointer<vtkStaticCellLocator>> locators_;
  std::vector<vtkUnsignedCharArray*> ghosts_;
};

std::vector<vtkDataSet*> pointers(const std::vector<Data>& leaves)
{
  return { leaves.begin(), leaves.end() };
}

/// Areas of walls and windows.
struct Areas
{
  double wall = 0, window = 0;
};

Areas areasOf(const GasBoundary& boundary)
{
  Areas areas;
  for (std::size_t t = 0; t < boundary.surface().size(); ++t)
  {
    const double area = 0.5 * filters::norm(boundary.surface().normal(t));
    (boundary.isWall(t) ? areas.wall : areas.window) += area;
  }
  return areas;
}

Areas areasOf(const std::vector<Data>& leaves, Outside outside = Outside::Auto)
{
  return areasOf(GasBoundary(pointers(leaves), nullptr, outside, {}));
}

void expectAreas(const Areas& areas, double wall, double window, double tolerance = 1e-6)
{
  EXPECT_NEAR(areas.wall, wall, tolerance * (wall + window));
  EXPECT_NEAR(areas.window, window, tolerance * (wall + window));
}

/// The same, also where the mesh is turned, and its points are of single precision.
void expectAreasWherever(vtkPointSet* mesh, double wall, double window, double tolerance = 1e-6)
{
  expectAreas(areasOf({ mesh }), wall, window, tolerance);
  turn(mesh);
  expectAreas(areasOf({ mesh }), wall, window, tolerance);
  vtkNew<vtkPoints> single;
  single->SetDataTypeToFloat();
  single->DeepCopy(mesh->GetPoints());
  mesh->SetPoints(single);
  expectAreas(areasOf({ mesh }), wall, window, std::max(tolerance, 1e-4));
}

vtkPointSet* asPoints(const Data& data) { return vtkPointSet::SafeDownCast(data); }

} // namespace

// No faces at the seam, at the poles and on the axis.
TEST(GasBoundary, SphereInItsMeshIsAWall)
{
  for (const int type : { VTK_DOUBLE, VTK_FLOAT })
  {
    const Areas areas = areasOf({ sphereMesh(40, 50, type) });
    EXPECT_NEAR(areas.wall, 4 * pi, 0.01 * 4 * pi);
    EXPECT_NEAR(areas.window, 4 * pi * 2500, 0.01 * 4 * pi * 2500);
  }
}

TEST(GasBoundary, SphereOnItsSymmetryPlaneIsAWall)
{
  auto mesh = sphereMesh(40, 50, VTK_DOUBLE, 0.5);
  expectAreasWherever(mesh, 2 * pi, 2 * pi * 2500 + pi * 2499, 0.005);
  const Areas areas = areasOf({ mesh });
  EXPECT_NEAR(areas.wall, 2 * pi, 0.01 * 2 * pi);
}

// Around a profile with a sharp trailing edge, and on behind it, with points there twice.
TEST(GasBoundary, ProfileInItsCGridIsAWall)
{
  const double far = 10;
  auto mesh = curvilinear(121, 31, 3,
    [&](double i, double j, double k)
    {
      // Around the profile from the lower end of the wake to the upper one.
      const double s = 2 * i - 1; // -1 ... 1
      const double wake = std::abs(s) > 0.5 ? (std::abs(s) - 0.5) * 2 : 0;
      const double c = std::abs(s) < 0.5 ? 1 - std::cos(pi * std::abs(s)) : 1; // 0 ... 1
      const double y0 = wake > 0 ? 0 : std::copysign(0.2 * std::sqrt(c) * (1 - c), s);
      const double x0 = wake > 0 ? 1 + (far - 1) * wake : c;
      // Far away a half circle and two straight lines.
      const double x1 = wake > 0 ? 1 + (far - 1) * wake : 1 - far * std::cos(pi * s);
      const double y1 = wake > 0 ? std::copysign(far, s) : far * std::sin(pi * s);
      return Vec{ x0 + j * j * (x1 - x0), y0 + j * j * (y1 - y0), k };
    });
  double profile = 0;
  for (int i = 30; i < 90; ++i)
  {
    Vec a, b;
    mesh->GetPoint(i, a.data());
    mesh->GetPoint(i + 1, b.data());
    profile += std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  const Areas areas = areasOf({ mesh });
  expectAreasWherever(mesh, profile, areas.window, 1e-6);
  EXPECT_NEAR(areas.window,
    2 * (pi * far * far / 2 + 2 * far * (far - 1)) + pi * far + 2 * (far - 1) + 2 * far, 5);
}

TEST(GasBoundary, PipeIsAllWindow)
{
  // With an axis where cells collapse.
  auto pipe = curvilinear(9, 33, 11,
    [](double r, double phi, double x) {
      return Vec{ 5 * x, r * std::cos(2 * pi * phi), r * std::sin(2 * pi * phi) };
    });
  const double round = 32 * 2 * std::sin(pi / 32) * 5, ends = 32 * std::sin(2 * pi / 32);
  expectAreasWherever(pipe, 0, round + ends);
}

TEST(GasBoundary, TubeWithinAPipeIsAWall)
{
  auto pipe = curvilinear(9, 33, 11,
    [](double r, double phi, double x)
    {
      const double radius = 0.2 + 0.8 * r;
      return Vec{ 5 * x, radius * std::cos(2 * pi * phi), radius * std::sin(2 * pi * phi) };
    });
  const double perimeter = 32 * 2 * std::sin(pi / 32), area = 16 * std::sin(2 * pi / 32);
  expectAreasWherever(pipe, 0.2 * perimeter * 5, perimeter * 5 + 2 * area * 0.96);
}

// Its wall is not convex, and it is widest where a flat side is.
TEST(GasBoundary, NozzleIsAllWindow)
{
  const auto nozzle = [](double inlet, double outlet)
  {
    return curvilinear(9, 33, 41,
      [&](double r, double phi, double x)
      {
        const double radius =
          r * (0.5 + (x < 0.5 ? inlet : outlet) * (1 - std::cos(2 * pi * (x - 0.5))));
        return Vec{ 5 * x, radius * std::cos(2 * pi * phi), radius * std::sin(2 * pi * phi) };
      });
  };
  for (const double outlet : { 0., 0.1, 0.25, 0.4 })
  {
    auto mesh = nozzle(0.25, outlet);
    EXPECT_EQ(areasOf({ mesh }).wall, 0) << outlet;
    turn(mesh);
    EXPECT_EQ(areasOf({ mesh }).wall, 0) << outlet;
  }
}

TEST(GasBoundary, ElbowIsAllWindow)
{
  auto elbow = curvilinear(9, 33, 31,
    [](double r, double phi, double s)
    {
      const double radius = 3 + r * std::cos(2 * pi * phi);
      return Vec{ radius * std::cos(pi / 2 * s), radius * std::sin(pi / 2 * s),
        r * std::sin(2 * pi * phi) };
    });
  EXPECT_EQ(areasOf({ elbow }).wall, 0);
  turn(elbow);
  EXPECT_EQ(areasOf({ elbow }).wall, 0);
}

TEST(GasBoundary, StepInAChannelIsAWall)
{
  for (const bool isForward : { true, false })
  {
    const Data channel = blocks({ 40, 20, 8 }, { 4, 2, 1 },
      [&](const Vec& x) { return x[1] > 0.5 || (isForward ? x[0] < 1 : x[0] > 1); });
    const double top = isForward ? 3 : 1;
    const double all = 2 * (4 * 2 + 4 * 1 + 2 * 1) - 2 * 0.5 * top;
    expectAreasWherever(asPoints(channel), top + 0.5, all - top - 0.5);
  }
}

TEST(GasBoundary, BumpInAFloorIsAWall)
{
  auto channel = curvilinear(41, 21, 5,
    [](double i, double j, double k)
    {
      const double x = 4 * i, floor = 0.1 * std::exp(-8 * (x - 2) * (x - 2));
      return Vec{ x, floor + j * (2 - floor), k };
    });
  for (const bool isTurned : { false, true })
  {
    const Areas areas = areasOf({ channel });
    EXPECT_GT(areas.wall, 1) << isTurned;
    EXPECT_LT(areas.wall, 3) << isTurned;
    turn(channel);
  }
}

TEST(GasBoundary, HoleInABoxIsAWall)
{
  const Data closed = blocks({ 10, 10, 10 }, { 1, 1, 1 },
    [](const Vec& x) {
      return std::max({ std::abs(x[0] - 0.5), std::abs(x[1] - 0.5), std::abs(x[2] - 0.5) }) > 0.2;
    });
  expectAreasWherever(asPoints(closed), 6 * 0.16, 6);
  const Data through = blocks({ 10, 10, 10 }, { 1, 1, 1 },
    [](const Vec& x) { return std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5)) > 0.2; });
  expectAreasWherever(asPoints(through), 4 * 0.4, 6 - 2 * 0.16);
}

TEST(GasBoundary, FinOnAPlateIsAWall)
{
  for (const double end : { 0.7, 1. }) // as far as the outlet
  {
    const Data data = blocks({ 20, 20, 20 }, { 1, 1, 1 },
      [&](const Vec& x)
      { return x[0] < 0.3 || x[0] > end || x[2] > 0.5 || std::abs(x[1] - 0.5) > 0.1; });
    const double length = end - 0.3, front = (end < 1 ? 2 : 1) * 0.2 * 0.5;
    const double wall = 2 * length * 0.5 + length * 0.2 + front;
    expectAreasWherever(asPoints(data), wall, 6 - length * 0.2 - (end < 1 ? 0 : 0.1));
  }
}

TEST(GasBoundary, ModesChooseWhatIsOutside)
{
  const std::vector<Data> mesh = { sphereMesh(10, 4) };
  const Areas all = areasOf(mesh);
  expectAreas(areasOf(mesh, Outside::Blocks), all.wall + all.window, 0);
  expectAreas(areasOf(mesh, Outside::Passes), 0, all.wall + all.window);
}

// Hidden cells, and points without gas, stop light wherever they are.
TEST(GasBoundary, WhatIsHiddenIsAWall)
{
  const auto isBody = [](const Vec& x) { return x[0] > 0.3 && x[0] < 0.7 && x[2] < 0.3; };
  auto image = cube(11, 0.5);
  image->SetOrigin(0, 0, 0);
  addPointArray(image, "N", [](const Vec&) { return 1; });
  image->GetPointData()->SetActiveScalars("N");
  hide(image, isBody);
  const Data mesh = blocks({ 10, 10, 10 }, { 1, 1, 1 }, [](const Vec&) { return true; });
  hide(mesh, isBody);
  for (const Data& data : { Data(image), mesh })
  {
    for (const Outside outside : { Outside::Auto, Outside::Passes })
    {
      expectAreas(areasOf({ data }, outside), 2 * 0.3 + 0.4, 6 - 0.4 - 2 * 0.12);
    }
  }
  auto holed = cube(11, 0.5);
  holed->SetOrigin(0, 0, 0);
  addPointArray(holed, "N",
    [](const Vec& x) { return x[0] > 0.35 && x[0] < 0.65 && x[2] < 0.25 ? std::nan("") : 1; });
  holed->GetPointData()->SetActiveScalars("N");
  expectAreas(areasOf({ Data(holed) }, Outside::Passes), 2 * 0.3 + 0.4, 6 - 0.4 - 2 * 0.12);
}

// Cells that are nowhere are not there.
TEST(GasBoundary, PointsThatAreNowhereMakeNoFaces)
{
  const auto grid = curvilinear(5, 5, 5,
    [](double i, double j, double k) {
      return i == 0.5 && j == 0.5 && k == 0.5 ? Vec{ std::nan(""), 0, 0 } : Vec{ i, j, k };
    });
  const Data mesh = blocks({ 4, 4, 4 }, { 1, 1, 1 }, [](const Vec&) { return true; });
  asPoints(mesh)->GetPoints()->SetPoint(62, 0, std::nan(""), 0);
  for (const Data& data : { Data(grid), mesh })
  {
    expectAreas(areasOf({ data }), 6 * 0.25, 6); // a cube of 2^3 cells is missing
  }
}

TEST(GasBoundary, FacesBetweenBlocksAreNone)
{
  const auto half = [](double from, double to, int n)
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(n + 1, n + 1, n + 1);
    image->SetOrigin(from, 0, 0);
    image->SetSpacing((to - from) / n, 1. / n, 1. / n);
    addPointArray(image, "N", [](const Vec&) { return 1; });
    image->GetPointData()->SetActiveScalars("N");
    return Data(image);
  };
  expectAreas(areasOf({ half(0, 1, 8), half(1, 3, 8) }), 0, 14);
  // One has another layer of the other's cells.
  const std::vector<Data> same = { half(0, 1, 8), half(0, 1, 8) };
  expectAreas(areasOf(same), 0, 6);
  // Hanging nodes; and blocks that overlap.
  for (const std::vector<Data>& pair : { std::vector<Data>{ half(0, 1, 8), half(1, 3, 16) },
         std::vector<Data>{ half(0, 1.33, 7), half(0.9, 3, 9) } })
  {
    const Cells cells(pair);
    const GasBoundary boundary(pointers(pair), nullptr, Outside::Auto, cells.test());
    const Areas areas = areasOf(boundary);
    EXPECT_EQ(areas.wall, 0);
    for (std::size_t t = 0; t < boundary.surface().size(); ++t)
    {
      const Vec a = boundary.surface().corner(t, 0), b = boundary.surface().corner(t, 1),
                c = boundary.surface().corner(t, 2);
      const bool isAcross = a[0] == b[0] && b[0] == c[0];
      EXPECT_TRUE(!isAcross || a[0] == 0 || a[0] == 3) << a[0];
    }
  }
}

namespace
{

std::string shared(const std::string& name)
{
  return std::string(SCHLIEREN_TEST_DATA) + "/" + name;
}

Data withScalars(vtkDataSet* data)
{
  data->GetCellData()->Initialize();
  addPointArray(data, "N", [](const Vec&) { return 1; });
  data->GetPointData()->SetActiveScalars("N");
  return data;
}

Data bluntFin()
{
  vtkNew<vtkMultiBlockPLOT3DReader> reader;
  reader->SetXYZFileName(shared("bluntfin_plot3d/bluntfinxyz.bin").c_str());
  reader->SetQFileName(shared("bluntfin_plot3d/bluntfinq.bin").c_str());
  reader->Update();
  return withScalars(vtkDataSet::SafeDownCast(reader->GetOutput()->GetBlock(0)));
}

} // namespace

// Within a cylinder, through whose side it goes.
TEST(GasBoundary, HeatingCoilIsAWall)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(shared("heating_coil_fluid.vtu").c_str());
  reader->Update();
  const Data mesh = withScalars(reader->GetOutput());
  const GasBoundary boundary({ mesh }, nullptr, Outside::Auto, {});
  for (std::size_t t = 0; t < boundary.surface().size(); ++t)
  {
    bool isInSide[3] = { true, true, true };
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const Vec x = boundary.surface().corner(t, corner);
      isInSide[0] = isInSide[0] && std::hypot(x[0], x[1]) > 0.999;
      isInSide[1] = isInSide[1] && x[2] < 1e-6;
      isInSide[2] = isInSide[2] && x[2] > 2.25 - 1e-6;
    }
    ASSERT_EQ(boundary.isWall(t), !isInSide[0] && !isInSide[1] && !isInSide[2]) << t;
  }
  EXPECT_GT(areasOf(boundary).wall, 7);
}

// Half of a fin with a round leading edge.
TEST(GasBoundary, BluntFinIsAWall)
{
  const Data mesh = bluntFin();
  double bounds[6];
  mesh->GetBounds(bounds);
  const double fin = (bounds[1] - 0.5 + pi / 4) * bounds[5];
  EXPECT_NEAR(areasOf({ mesh }).wall, fin, 0.002 * fin);
}

// The wing has no thickness: it is known by the density of its sides, and is there from both of them. Before and behind it the
// mesh is cut, too, but nothing differs.
TEST(GasBoundary, SheetsInAMeshAreKnownByTheirValues)
{
  vtkNew<vtkXMLStructuredGridReader> reader;
  reader->SetFileName(shared("deltawing.vts").c_str());
  reader->Update();
  const Data mesh = withScalars(reader->GetOutput());
  EXPECT_EQ(areasOf({ mesh }).wall, 0);
  mesh->GetPointData()->SetActiveScalars("Density");
  double bounds[6];
  mesh->GetBounds(bounds);
  const double span = 0.268, wing = span / 2; // half of it, 1 long
  EXPECT_NEAR(areasOf({ mesh }).wall, 2 * wing, 0.02 * wing);
  EXPECT_NEAR(areasOf({ mesh }, Outside::Passes).wall, 0, 1e-12);
}

TEST(GasBoundary, OnlyValuesThatDifferMakeASheet)
{
  const auto mesh = cutMesh(20);
  const auto wallWith = [&](const std::function<double(const Vec&)>& jump)
  {
    setJump(mesh, jump);
    return areasOf({ mesh }).wall;
  };
  const auto isInPlate = [](const Vec& x)
  { return std::abs(x[0]) < 0.45 && std::abs(x[1]) < 0.45; };
  EXPECT_EQ(wallWith([](const Vec&) { return 0; }), 0);
  // A plate of 9 by 9 points. Its sides count both.
  const double plate = 2 * std::pow(0.1 * 8, 2);
  EXPECT_NEAR(wallWith([&](const Vec& x) { return isInPlate(x) ? 0.2 : 0; }), plate, 1e-9);
  // That its values nearly come together at its edges does not matter; that they are about the same everywhere does.
  EXPECT_NEAR(
    wallWith([&](const Vec& x) { return isInPlate(x) ? 0.3 * (0.46 - std::abs(x[0])) : 0; }), plate,
    1e-9);
  EXPECT_EQ(wallWith([&](const Vec& x) { return isInPlate(x) ? 0.01 : 0; }), 0);
  EXPECT_EQ(wallWith([](const Vec&) { return 1e-4; }), 0);
  // An interface on which values differ a little, and much at a shock.
  EXPECT_EQ(wallWith([](const Vec& x) { return std::abs(x[0]) < 0.06 ? 0.3 : 0.005; }), 0);
  // Where nothing is known of the flow but rounding.
  mesh->GetPointData()->RemoveArray("N");
  vtkIdType point = 0;
  addPointArray(mesh, "N", [&](const Vec&) { return 1 + 1e-9 * static_cast<double>(point++ % 7); });
  mesh->GetPointData()->SetActiveScalars("N");
  EXPECT_EQ(areasOf({ mesh }).wall, 0);
}

TEST(GasBoundary, BetweenDatasetsThereAreNoSheets)
{
  std::vector<Data> leaves;
  for (const double value : { 1., 2. })
  {
    const auto grid = curvilinear(5, 5, 5,
      [&](double i, double j, double k) -> Vec {
        return { i, j, k + value };
      });
    grid->GetPointData()->RemoveArray("N");
    addPointArray(grid, "N", [&](const Vec& x) { return value + x[0]; });
    grid->GetPointData()->SetActiveScalars("N");
    leaves.emplace_back(grid);
  }
  EXPECT_EQ(areasOf(leaves).wall, 0);
}

TEST(GasBoundary, LightEndsAtASheet)
{
  const auto mesh = cutMesh(20);
  setJump(
    mesh, [](const Vec& x) { return std::abs(x[0]) < 0.45 && std::abs(x[1]) < 0.45 ? 0.2 : 0; });
  const Cells cells(std::vector<Data>{ mesh });
  const GasBoundary boundary(pointers({ mesh }), nullptr, Outside::Auto, cells.test());
  const auto valuesOn = [](const Data& data)
  {
    return [data](const filters::CutFaces& cuts)
    { return filters::valuesAt(cuts.firstContributions, cuts.contributions, pointers({ data })); };
  };
  EXPECT_TRUE(boundary.hasSheetsOf(valuesOn(mesh)));
  const auto other = cutMesh(20);
  setJump(other, [](const Vec&) { return 0; });
  EXPECT_FALSE(boundary.hasSheetsOf(valuesOn(other)));
  const Lattice lattice{ { -0.97, -0.97, -0.2 }, { 0.0511, 0.0511, 0.0511 }, { 38, 38, 9 } };
  const std::vector<unsigned char> isInCell(static_cast<std::size_t>(lattice.size()), 1);
  std::vector<Place> places(isInCell.size());
  std::vector<float> distances(isInCell.size());
  boundary.sample(lattice, isInCell.data(), places.data(), distances.data());
  for (int j = 0; j < 38; ++j)
  {
    for (int i = 0; i < 38; ++i)
    {
      int walls = 0;
      for (int k = 0; k < 9; ++k)
      {
        walls += places[static_cast<std::size_t>((k * 38 + j) * 38 + i)] == Place::Wall ? 1 : 0;
      }
      const double x = std::abs(lattice.first[0] + 0.0511 * i),
                   y = std::abs(lattice.first[1] + 0.0511 * j);
      if (std::max(x, y) < 0.38)
      {
        EXPECT_EQ(walls, 1);
      }
      else if (std::max(x, y) > 0.46)
      {
        EXPECT_EQ(walls, 0);
      }
    }
  }
}

// An axisymmetric case of OpenFOAM: its plane sides are no walls.
TEST(GasBoundary, WedgeIsAllWindow)
{
  vtkNew<vtkOpenFOAMReader> reader;
  reader->SetFileName(shared("ladenburg_openfoam/ladenburg.foam").c_str());
  reader->UpdateInformation();
  reader->SetTimeValue(0.00045);
  reader->Update();
  const Data mesh = withScalars(vtkDataSet::SafeDownCast(reader->GetOutput()->GetBlock(0)));
  const Areas areas = areasOf({ mesh });
  EXPECT_EQ(areas.wall, 0);
  EXPECT_GT(areas.window, 0);
}

namespace
{

/// What a ray sees of a lattice: distances with 15 bits, interpolated trilinearly.
class Samples
{
public:
  Samples(const GasBoundary& boundary, const Lattice& lattice,
    const std::function<bool(const Vec&)>& isInCell)
    : places(static_cast<std::size_t>(lattice.size()))
    , distances(places.size())
    , lattice_(lattice)
  {
    std::vector<unsigned char> inCell(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      inCell[i] = isInCell(this->point(i)) ? 1 : 0;
    }
    boundary.sample(lattice, inCell.data(), places.data(), distances.data());
  }

  Vec point(std::size_t i) const
  {
    const auto n = static_cast<int>(i);
    const int nx = lattice_.points[0], ny = lattice_.points[1];
    const int at[3] = { n % nx, n / nx % ny, n / nx / ny };
    Vec x;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      x[axis] = lattice_.first[axis] + at[axis] * lattice_.spacing[axis];
    }
    return x;
  }
  double at(const Vec& x) const
  {
    std::size_t first[3];
    double part[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double at = (x[axis] - lattice_.first[axis]) / lattice_.spacing[axis];
      first[axis] =
        static_cast<std::size_t>(std::clamp(std::floor(at), 0., lattice_.points[axis] - 2.));
      part[axis] = at - static_cast<double>(first[axis]);
    }
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      double weight = 1;
      std::size_t at[3];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const unsigned upper = corner >> axis & 1;
        weight *= upper ? part[axis] : 1 - part[axis];
        at[axis] = first[axis] + upper;
      }
      const auto nx = static_cast<std::size_t>(lattice_.points[0]);
      const auto ny = static_cast<std::size_t>(lattice_.points[1]);
      sum += weight * std::round(8192 * distances[(at[2] * ny + at[1]) * nx + at[0]]) / 8192;
    }
    return sum;
  }
  /// Whether light goes from one place to another.
  bool lets(const Vec& from, const Vec& to, double step) const
  {
    Vec line{ to[0] - from[0], to[1] - from[1], to[2] - from[2] };
    const double length = std::sqrt(dot(line, line));
    const int steps = static_cast<int>(std::ceil(length / step));
    for (int i = 0; i <= steps; ++i)
    {
      const double s = static_cast<double>(i) / steps;
      if (this->at({ from[0] + s * line[0], from[1] + s * line[1], from[2] + s * line[2] }) < 0)
      {
        return false;
      }
    }
    return true;
  }

  std::vector<Place> places;
  std::vector<float> distances;

private:
  Lattice lattice_;
};

Lattice latticeAround(const Vec& middle, const Vec& half, double h)
{
  Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lattice.points[axis] = static_cast<int>(2 * half[axis] / h) + 1;
    lattice.spacing[axis] = h;
    lattice.first[axis] = middle[axis] - half[axis] + 0.123 * h;
  }
  return lattice;
}

} // namespace

// Where distances change sign along rays through the sphere's middle.
TEST(GasBoundary, SphereIsWhereItIs)
{
  const auto mesh = sphereMesh(160, 4);
  const GasBoundary boundary({ mesh }, nullptr, Outside::Auto, {});
  for (const double h : { 0.04, 0.02, 0.01 })
  {
    double worst = 0, sum = 0;
    int rays = 0;
    for (const Vec& to : { Vec{ 1, 0, 0 }, Vec{ 0.6, 0.64, 0.48 }, Vec{ 0, -0.6, 0.8 } })
    {
      const Lattice lattice = latticeAround(to, { 10 * h, 10 * h, 10 * h }, h);
      const Samples samples(boundary, lattice, [](const Vec& x) { return dot(x, x) > 1; });
      for (double y = -3 * h; y <= 3 * h; y += 0.47 * h)
      {
        for (double z = -3 * h; z <= 3 * h; z += 0.47 * h)
        {
          const Vec along = unit({ to[0] + y, to[1] + z, to[2] + y - z });
          double low = 1 - 3 * h, high = 1 + 3 * h;
          EXPECT_LT(samples.at({ low * along[0], low * along[1], low * along[2] }), 0);
          for (int i = 0; i < 40; ++i)
          {
            const double r = 0.5 * (low + high);
            (samples.at({ r * along[0], r * along[1], r * along[2] }) < 0 ? low : high) = r;
          }
          worst = std::max(worst, std::abs(low - 1) / h);
          sum += (low - 1) / h;
          ++rays;
        }
      }
    }
    EXPECT_LT(worst, 0.02);
    EXPECT_LT(std::abs(2 * h * sum / rays), 0.003);
  }
}

namespace
{

Data gasAround()
{
  auto image = cube(5, 10);
  addPointArray(image, "N", [](const Vec&) { return 1; });
  image->GetPointData()->SetActiveScalars("N");
  return Data(image);
}

bool always(const Vec&) { return true; }

} // namespace

// Plates within the mesh, thinner than a voxel, in any direction; rays through them that keep clear of the rims.
TEST(GasBoundary, NothingLeaksThroughThinPlates)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  int rays = 0;
  for (const double thickness : { 0., 0.01, 0.3, 0.7, 1., 1.5 }) // voxels
  {
    for (int turned = 0; turned < 8; ++turned)
    {
      // A box of gas with a plate left out, or a sheet in the gas.
      const double h = 0.1;
      auto body = thickness > 0 ? box({ 1.6, 1.6, thickness * h })
                                : plate({ -0.8, -0.8, 0 }, { 0.8, -0.8, 0 }, { -0.8, 0.8, 0 });
      const Vec axis = unit({ any(random), any(random), any(random) });
      const Vec shift{ 0.1 * any(random), 0.1 * any(random), 0.1 * any(random) };
      vtkNew<vtkTransform> transform;
      if (turned > 0) // else along the lattice
      {
        transform->Translate(shift.data());
        transform->RotateWXYZ(180 * any(random), axis.data());
      }
      vtkNew<vtkTransformPolyDataFilter> turn;
      turn->SetTransform(transform);
      turn->SetInputData(body);
      turn->Update();
      const Data gas = gasAround();
      const GasBoundary boundary({ gas }, turn->GetOutput(), Outside::Auto, {});
      Lattice lattice = latticeAround({ 0, 0, 0 }, { 1.2, 1.2, 1.2 }, h);
      if (turned == 0)
      {
        lattice.first = { -1.2, -1.2, -1.2 }; // with points on the plate
      }
      const Samples samples(boundary, lattice, always);
      for (int ray = 0; ray < 200; ++ray)
      {
        Vec from{ 0.6 * any(random), 0.6 * any(random), 0.3 },
          to{ 0.6 * any(random), 0.6 * any(random), -0.3 };
        transform->TransformPoint(from.data(), from.data());
        transform->TransformPoint(to.data(), to.data());
        EXPECT_FALSE(samples.lets(from, to, 0.1 * h)) << thickness << " " << turned;
        EXPECT_FALSE(samples.lets(from, to, 0.45 * h)) << thickness << " " << turned;
        // Beside it there is gas.
        Vec back{ from[0], from[1], from[2] };
        EXPECT_GT(samples.at(back), 0) << thickness << " " << turned;
        ++rays;
      }
    }
  }
  EXPECT_EQ(rays, 6 * 8 * 200);
}

TEST(GasBoundary, PlatesAreAboutAVoxelThick)
{
  const double h = 0.1;
  const Data gas = gasAround();
  for (double z = 0; z < 0.1; z += 0.013)
  {
    const auto sheet = plate({ -0.8, -0.8, z }, { 0.8, -0.8, z }, { -0.8, 0.8, z });
    const GasBoundary boundary({ gas }, sheet, Outside::Auto, {});
    const Samples samples(boundary, latticeAround({ 0, 0, 0 }, { 1.2, 1.2, 1.2 }, h), always);
    double thickness = 0, deepest = 0;
    for (double at = -0.5; at < 0.5; at += 0.001)
    {
      const double distance = samples.at({ 0.03, 0.04, at });
      thickness += distance < 0 ? 0.001 / h : 0;
      deepest = std::min(deepest, distance);
    }
    EXPECT_NEAR(thickness, 1, 0.4) << z;
    EXPECT_LT(deepest, -0.4) << z;
  }
}

// Distances from a box's faces are exact; at its edges the silhouette misses by a part of a voxel.
TEST(GasBoundary, ABoxKeepsItsFacesAndEdges)
{
  const double h = 0.1;
  const auto isGas = [](const Vec& x) {
    return std::max({ std::abs(x[0]), std::abs(x[1]), std::abs(x[2]) }) > 0.5;
  };
  const Data gas = gasAround();
  const GasBoundary boundary({ gas }, box({ 1, 1, 1 }), Outside::Auto, {});
  const Lattice lattice = latticeAround({ 0, 0, 0 }, { 1, 1, 1 }, h);
  const Samples samples(boundary, lattice, always);
  for (std::size_t i = 0; i < samples.places.size(); ++i)
  {
    const Vec x = samples.point(i);
    EXPECT_EQ(samples.places[i], isGas(x) ? Place::Gas : Place::Wall);
    const double depth = 0.5 - std::max({ std::abs(x[0]), std::abs(x[1]), std::abs(x[2]) });
    double outside = 0;
    for (const double coordinate : x)
    {
      outside += std::pow(std::max(0., std::abs(coordinate) - 0.5), 2);
    }
    const double truth = std::clamp((depth > 0 ? -depth : std::sqrt(outside)) / h, -3., 3.);
    EXPECT_NEAR(samples.distances[i], truth, 1e-3);
  }
  double worst = 0; // of a line of sight along z
  for (double x = 0.3; x < 0.7; x += 0.003)
  {
    for (double y = 0.3; y < 0.7; y += 0.003)
    {
      const bool isStopped = samples.at({ x, y, 0.01 }) < 0;
      const double d = std::max(x, y) - 0.5;
      worst = std::max(worst, isStopped == (d < 0) ? 0. : std::abs(d) / h);
    }
  }
  EXPECT_LT(worst, 0.5);
}

TEST(GasBoundary, ClosedBodiesAreSolidHoweverTheyAreTurned)
{
  const Data gas = gasAround();
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1);
  source->SetThetaResolution(60);
  source->SetPhiResolution(60);
  source->Update();
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputConnection(source->GetOutputPort());
  reverse->Update();
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, source->GetOutput());
  nested->SetBlock(1, box({ 0.5, 0.5, 0.5 }));
  nested->SetBlock(2, box({ 1, 0.2, 0.2 }, { 1, 0, 0 }));
  const Lattice lattice = latticeAround({ 0, 0, 0 }, { 1.3, 1.3, 1.3 }, 0.1);
  const GasBoundary one({ gas }, source->GetOutput(), Outside::Auto, {});
  const GasBoundary turned({ gas }, reverse->GetOutput(), Outside::Auto, {});
  const GasBoundary several({ gas }, nested, Outside::Auto, {});
  const Samples a(one, lattice, always), b(turned, lattice, always), c(several, lattice, always);
  EXPECT_EQ(a.distances, b.distances);
  for (std::size_t i = 0; i < a.places.size(); ++i)
  {
    const Vec x = a.point(i);
    const double r = std::sqrt(dot(x, x));
    if (std::abs(r - 1) > 0.01)
    {
      EXPECT_EQ(a.places[i], r < 1 ? Place::Wall : Place::Gas);
    }
    EXPECT_NEAR(a.distances[i], std::clamp((r - 1) / 0.1, -3., 3.), 0.03);
    const bool isInBar = std::abs(x[0] - 1) < 0.5 && std::max(std::abs(x[1]), std::abs(x[2])) < 0.1;
    EXPECT_EQ(c.places[i], isInBar ? Place::Wall : a.places[i]);
  }
  EXPECT_EQ(one.kindAt({ 0.1, 0.2, 0 }, true), Place::Wall);
  EXPECT_EQ(one.kindAt({ 3, 0.2, 0 }, true), Place::Gas);
  EXPECT_TRUE(one.facesIn({ { 0.9, -0.1, -0.1 }, { 1.1, 0.1, 0.1 } }).wall);
  EXPECT_FALSE(one.facesIn({ { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 } }).wall);
  EXPECT_TRUE(one.facesIn({ { 9, 9, 9 }, { 11, 11, 11 } }).window);
}

// The sphere from inside its mesh, a box within the sphere, and places outside of the far field.
TEST(GasBoundary, PlacesOutsideAreOfTheNearestFace)
{
  const Data mesh = sphereMesh(30, 4);
  const GasBoundary boundary({ mesh }, nullptr, Outside::Auto, {});
  const auto isIn = [](const Vec& x) { return dot(x, x) > 1 && dot(x, x) < 16; };
  EXPECT_EQ(boundary.kindAt({ 0, 0, 0.1 }, false), Place::Wall);
  EXPECT_EQ(boundary.kindAt({ 0, 4.1, 0.1 }, false), Place::Window);
  const Samples inside(boundary, latticeAround({ 0, 0, 0 }, { 0.4, 0.4, 0.4 }, 0.1), isIn);
  const Samples outside(boundary, latticeAround({ 4, 4, 4 }, { 1, 1, 1 }, 0.1), isIn);
  const Samples far(boundary, latticeAround({ 4.2, 0, 0 }, { 1, 1, 1 }, 0.1), isIn);
  const Samples near(boundary, latticeAround({ 0, 0, 0 }, { 1.5, 1.5, 1.5 }, 0.1), isIn);
  const Samples gas(boundary, latticeAround({ 2.5, 0, 0 }, { 0.4, 0.4, 0.4 }, 0.1), isIn);
  for (const auto& [samples, kind] :
    { std::pair(&inside, Place::Wall), std::pair(&outside, Place::Window),
      std::pair(&far, Place::Window), std::pair(&near, Place::Wall), std::pair(&gas, Place::Gas) })
  {
    for (std::size_t i = 0; i < samples->places.size(); ++i)
    {
      EXPECT_EQ(samples->places[i], isIn(samples->point(i)) ? Place::Gas : kind);
    }
  }
  EXPECT_EQ(inside.distances[100], -3);
  EXPECT_EQ(gas.distances[100], 3);
}

TEST(GasBoundary, AmbientIsThatOfTheFarField)
{
  auto mesh = sphereMesh(20, 4);
  addPointArray(mesh, "N", [](const Vec& x) { return dot(x, x) < 15 ? 7 : (x[0] > 2 ? 3 : 2); });
  mesh->GetPointData()->SetActiveScalars("N");
  for (const Outside outside : { Outside::Auto, Outside::Blocks, Outside::Passes })
  {
    EXPECT_EQ(GasBoundary({ mesh }, nullptr, outside, {}).ambient({ mesh }), 2);
  }
}

// Where blocks meet there is gas, also if their points differ, and if curved sides leave gaps.
TEST(GasBoundary, GasContinuesFromBlockToBlock)
{
  const auto ring = [](double from, double to, int around)
  {
    return Data(curvilinear(5, around + 1, 5,
      [&](double i, double j, double k)
      {
        const double r = from + i * (to - from), phi = pi / 2 * j;
        return Vec{ r * std::cos(phi), r * std::sin(phi), k };
      }));
  };
  const std::vector<Data> hanging = { ring(1, 2, 8), ring(2, 3, 16) };
  const std::vector<Data> overlapping = { ring(1, 2.2, 8), ring(1.9, 3, 13) };
  for (const std::vector<Data>& blocks : { hanging, overlapping })
  {
    const Cells cells(blocks);
    const GasBoundary boundary(pointers(blocks), nullptr, Outside::Auto, cells.test());
    for (const double h : { 0.1, 0.02 })
    {
      const double size = std::min(0.4, 15 * h);
      const Samples samples(boundary, latticeAround({ 1.43, 1.41, 0.5 }, { size, size, size }, h),
        [&](const Vec& x) { return cells.hold(x); });
      for (std::size_t i = 0; i < samples.places.size(); ++i)
      {
        const Vec x = samples.point(i);
        EXPECT_EQ(samples.places[i], cells.hold(x) ? Place::Gas : Place::Window);
        EXPECT_GE(samples.distances[i], -1.f / 4096);
        const double toSide =
          std::min({ x[2], 1 - x[2], std::hypot(x[0], x[1]) - 1, 3 - std::hypot(x[0], x[1]) }) / h;
        EXPECT_TRUE(toSide < 4 || samples.distances[i] == 3 || !cells.hold(x)) << toSide;
      }
    }
  }
}

// Cells of higher order with hanging nodes.
TEST(GasBoundary, CurvedCellsHaveNoWallsWithin)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(shared("blob_lagrange_hex.vtu").c_str());
  reader->Update();
  const Data mesh = withScalars(reader->GetOutput());
  double b[6];
  mesh->GetBounds(b);
  const double lengths[3] = { b[1] - b[0], b[3] - b[2], b[5] - b[4] };
  const auto isWithin = [&](const Vec& x) // it fills its box
  {
    return x[0] > b[0] && x[0] < b[1] && x[1] > b[2] && x[1] < b[3] && x[2] > b[4] && x[2] < b[5];
  };
  const double box =
    2 * (lengths[0] * lengths[1] + lengths[1] * lengths[2] + lengths[2] * lengths[0]);
  expectAreas(areasOf(GasBoundary({ mesh }, nullptr, Outside::Auto, isWithin)), 0, box, 1e-4);
}

// The fin, half of which is modelled, opens in the plane of symmetry and in the plate that it stands on. Far from its
// sides, all that is above the plate is within it, however fine the lattice is.
TEST(GasBoundary, BodiesThatOpenInTwoSidesOfTheBoxAreWallUpToTheirEdge)
{
  const Data mesh = bluntFin(); // half as thick as 0.5, from y = 0 on; the plate is at z = 0
  const GasBoundary boundary({ mesh }, nullptr, Outside::Auto, {});
  for (const double h : { 0.002, 0.0075, 0.015, 0.02 })
  {
    const Samples samples(boundary, { { 2, h / 2, h / 2 }, { h, h, h }, { 18, 18, 18 } },
      [](const Vec&) { return false; });
    for (std::size_t i = 0; i < samples.places.size(); ++i)
    {
      ASSERT_EQ(samples.places[i], Place::Wall) << h << " " << i;
    }
    const double below = -h / 2;
    const Samples around(boundary, { { 2, below, below }, { h, h, h }, { 18, 18, 18 } },
      [](const Vec&) { return false; });
    for (std::size_t i = 0; i < around.places.size(); ++i)
    {
      const Vec x = around.point(i);
      ASSERT_TRUE(x[1] < 0 || x[2] < 0 || around.places[i] == Place::Wall) << h << " " << i;
    }
  }
}

// A cylinder from side to side of its mesh: what is beside its ends is known from the nearest face.
TEST(GasBoundary, BesideTheEndsOfAProfileIsWindow)
{
  const Data mesh = curvilinear(31, 65, 3,
    [](double i, double j, double k)
    {
      const double r = std::pow(5, i);
      return Vec{ r * std::cos(2 * pi * j), r * std::sin(2 * pi * j), k };
    });
  const GasBoundary boundary({ mesh }, nullptr, Outside::Auto, {});
  const auto isIn = [](const Vec& x) { return std::hypot(x[0], x[1]) > 1 && x[2] > 0 && x[2] < 1; };
  const Samples samples(boundary, latticeAround({ 1, 0, 0 }, { 0.8, 0.8, 0.8 }, 0.1), isIn);
  for (std::size_t i = 0; i < samples.places.size(); ++i)
  {
    const Vec x = samples.point(i);
    const double r = std::hypot(x[0], x[1]);
    const bool isBehind = r < 1 && -x[2] < 1 - r;
    const bool isWithinReach = std::hypot(1 - r, std::min(x[2], 0.)) < 0.29;
    if (isWithinReach && std::abs(-x[2] - (1 - r)) > 0.02)
    {
      EXPECT_EQ(samples.places[i], isIn(x) ? Place::Gas : (isBehind ? Place::Wall : Place::Window))
        << x[0] << " " << x[1] << " " << x[2];
    }
  }
}

// Holes in meshes that are thinner than a voxel.
TEST(GasBoundary, NothingLeaksThroughThinHoles)
{
  const double h = 0.1;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const double thickness : { 0.02, 0.05, 0.12 })
  {
    // Cells of any thickness; those in the middle are left out but at the rim.
    const auto z = [&](double k)
    { return std::abs(k - 0.5) < 0.06 ? std::copysign(thickness / 2, k - 0.5) : 4 * (k - 0.5); };
    auto mesh = curvilinear(21, 21, 22,
      [&](double i, double j, double k) {
        return Vec{ 4 * i - 2, 4 * j - 2, z(k) };
      });
    addCellArray(mesh, "gas",
      [&](const Vec& x)
      { return std::abs(x[2]) > 1e-9 || std::max(std::abs(x[0]), std::abs(x[1])) > 1 ? 1 : 0; });
    const Data holed = gasOf(mesh);
    turn(asPoints(holed));
    const Cells cells({ holed });
    const GasBoundary boundary({ holed }, nullptr, Outside::Auto, {});
    EXPECT_NEAR(areasOf(boundary).wall, 8 + 8 * thickness, 1e-6);
    const Samples samples(boundary, latticeAround({ 0, 0, 0 }, { 1.5, 1.5, 1.5 }, h),
      [&](const Vec& x) { return cells.hold(x); });
    for (int ray = 0; ray < 300; ++ray)
    {
      const Vec from = turned({ 0.8 * any(random), 0.8 * any(random), 0.3 });
      const Vec to = turned({ 0.8 * any(random), 0.8 * any(random), -0.3 });
      EXPECT_FALSE(samples.lets(from, to, 0.45 * h)) << thickness;
    }
  }
}

// Around a prism of many sides: lines between two points of the gas may cut off its edges.
TEST(GasBoundary, NearlyPlaneWallsAreNoThickerThanTheyAre)
{
  constexpr int sides = 24;
  const auto mesh = curvilinear(5, sides + 1, 5,
    [](double i, double j, double k)
    {
      const double r = 0.7 + i;
      return Vec{ r * std::cos(2 * pi * j), r * std::sin(2 * pi * j), 2 * k - 1 };
    });
  turn(mesh);
  const Cells cells({ mesh });
  const GasBoundary boundary({ mesh }, nullptr, Outside::Auto, {});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.05, 0.05);
  for (int i = 0; i < 4; ++i)
  {
    const Samples samples(boundary,
      latticeAround({ any(random), any(random), any(random) }, { 0.9, 0.9, 0.5 }, 0.05),
      [&](const Vec& x) { return cells.hold(x); });
    int thicker = 0, within = 0;
    for (std::size_t n = 0; n < samples.places.size(); ++n)
    {
      const bool isGas = cells.hold(samples.point(n));
      within += isGas ? 1 : 0;
      thicker += isGas && samples.places[n] != Place::Gas ? 1 : 0;
    }
    EXPECT_GT(within, 10000);
    EXPECT_EQ(thicker, 0);
  }
}

// Two plates that meet in an edge, at any angle; rays from outside to between them.
TEST(GasBoundary, NothingLeaksIntoFolds)
{
  const double h = 0.1;
  for (unsigned int seed = 1; seed <= 4; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double angle : { 10., 15., 20., 25., 30., 40., 60., 90., 150. })
    {
      const double s = std::sin(angle * pi / 360), c = std::cos(angle * pi / 360);
      for (int i = 0; i < 5; ++i)
      {
        vtkNew<vtkMultiBlockDataSet> fold; // along y, its edge at o
        const Vec o{ 0.1 * any(random), 0, 0.1 * any(random) };
        fold->SetBlock(0, plate({ o[0], -1, o[2] }, { o[0], 1, o[2] }, { o[0] + s, -1, o[2] - c }));
        fold->SetBlock(1, plate({ o[0], -1, o[2] }, { o[0], 1, o[2] }, { o[0] - s, -1, o[2] - c }));
        const GasBoundary boundary({ gasAround() }, fold, Outside::Auto, {});
        const Samples samples(boundary, latticeAround({ 0, 0, 0 }, { 1.2, 0.5, 1.2 }, h), always);
        int leaks = 0;
        for (int ray = 0; ray < 100; ++ray)
        {
          const Vec from{ o[0] + 0.3 * any(random), 0.3 * any(random), o[2] + 0.3 };
          const Vec to{ o[0] + 0.5 * s * any(random), 0.3 * any(random), o[2] - 0.6 };
          leaks += samples.lets(from, to, 0.2 * h) ? 1 : 0;
        }
        EXPECT_EQ(leaks, 0) << seed << " " << angle << " " << i;
      }
    }
  }
}
