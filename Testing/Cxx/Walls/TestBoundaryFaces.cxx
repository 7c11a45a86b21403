// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which faces bound meshes, and which of them are walls.
#include "BoundaryMeshes.h"

#include "vtkOpenFOAMReader.h"
#include "vtkPolyData.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"

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
    const GasBoundary boundary =
      boundaryOfLeaves(pointers(pair), nullptr, Outside::Auto, cells.test());
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
// Within a cylinder, through whose side it goes.
TEST(GasBoundary, HeatingCoilIsAWall)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(shared("heating_coil_fluid.vtu").c_str());
  reader->Update();
  const Data mesh = withScalars(reader->GetOutput());
  const GasBoundary boundary = boundaryOfLeaves({ mesh }, nullptr, Outside::Auto, {});
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
  vtkNew<vtkDoubleArray> values;
  values->DeepCopy(mesh->GetPointData()->GetArray("Density"));
  mesh->GetPointData()->SetScalars(values);
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
  const GasBoundary boundary =
    boundaryOfLeaves(pointers({ mesh }), nullptr, Outside::Auto, cells.test());
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

/// A sheared block: x at the given stations, from y(x) + low to y(x) + high, from z = 0 to 0.3.
Data block(const std::vector<double>& stations, const std::function<double(double)>& y, double low,
  double high, int layers)
{
  const auto count = static_cast<int>(stations.size());
  return curvilinear(count, layers + 1, 4,
    [&](double i, double j, double k)
    {
      const double x = stations[static_cast<std::size_t>(std::lround(i * (count - 1)))];
      return Vec{ x, y(x) + low + j * (high - low), 0.3 * k };
    });
}

} // namespace

// A plate of 0.2 of the height of the cells beside it, and of one cell's length or of eight.
TEST(GasBoundary, BluntPlatesThinnerThanCellsAreWalls)
{
  const auto flat = [](double) { return 0.; };
  for (const int length : { 1, 8 })
  {
    std::vector<double> before{ -1, -0.5, 0 }, along, after;
    for (int i = 0; i <= length; ++i)
    {
      along.push_back(0.25 * i);
    }
    const double end = along.back();
    after = { end, end + 0.5, end + 1 };
    std::vector<Data> mesh;
    for (const auto& stations : { before, along, after })
    {
      mesh.push_back(block(stations, flat, -1.01, -0.01, 10));
      mesh.push_back(block(stations, flat, 0.01, 1.01, 10));
    }
    mesh.push_back(block(before, flat, -0.01, 0.01, 1));
    mesh.push_back(block(after, flat, -0.01, 0.01, 1));
    const Cells cells(mesh);
    const Areas areas =
      areasOf(boundaryOfLeaves(pointers(mesh), nullptr, Outside::Auto, cells.test()));
    EXPECT_NEAR(areas.wall, 2 * 0.3 * (end + 0.02), 1e-6);
  }
}
