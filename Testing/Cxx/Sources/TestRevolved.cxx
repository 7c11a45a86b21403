// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Planes and wedges become bodies of revolution.
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkCellType.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkImageDataToPointSet.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkThreshold.h"
#include "vtkUnstructuredGrid.h"

namespace
{

const GaussianColumn column;

/// The column around the y axis, in the plane of x, or z, and y; from a radius on.
vtkSmartPointer<vtkImageData> section(
  int radial, bool ofCells = false, double from = 0, double to = 1)
{
  constexpr int cells = 80;
  auto image = vtkSmartPointer<vtkImageData>::New();
  int points[3] = { 1, 41, 1 };
  points[radial] = cells + 1;
  double origin[3] = { 0, -1, 0 };
  origin[radial] = from;
  double spacing[3] = { 1, 0.05, 1 };
  spacing[radial] = (to - from) / cells;
  image->SetDimensions(points);
  image->SetOrigin(origin);
  image->SetSpacing(spacing);
  ofCells ? addCellArray(image, "N", column) : static_cast<void>(addPointArray(image, "N", column));
  return image;
}

vtkSmartPointer<vtkUnstructuredGrid> asTriangles(vtkImageData* image)
{
  vtkNew<vtkAppendFilter> pixels;
  pixels->SetInputData(image);
  vtkNew<vtkDataSetTriangleFilter> triangles;
  triangles->SetInputConnection(pixels->GetOutputPort());
  triangles->Update();
  return triangles->GetOutput();
}

vtkSmartPointer<vtkSchlierenFilter> revolved(vtkDataObject* input, bool ofCells = false)
{
  auto filter = bench(input, 64);
  if (ofCells)
  {
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  }
  filter->SetSymmetry(vtkRefractiveIndex::SYMMETRY_AXISYMMETRIC);
  filter->SetParallelScale(0.7);
  filter->SetMediumTolerance(4e-3);
  return filter;
}

std::string warningOf(vtkSchlierenFilter* filter)
{
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty()) << complaints->Errors[0];
  return complaints->Warnings.empty() ? "" : complaints->Warnings[0];
}

/// Of a revolved plane, by an image of a few pixels.
std::string warningOfPlane(vtkImageData* plane)
{
  auto filter = revolved(plane);
  filter->SetImageSize(8, 8);
  filter->SetMediumTolerance(1);
  return warningOf(filter);
}

/// A wedge around an axis, one cell wide, of points from r = 0 to 1 and -1 to 1 along it. `merged`:
/// the radius within which some points of both planes are one, `at` the first of these (-1), the
/// second (1) or between.
vtkSmartPointer<vtkDataSet> wedge(
  int axis, bool isStructured, bool ofCells, double degrees = 5, double merged = 0, double at = 0)
{
  constexpr int away = 81, along = 41;
  const double half = 0.5 * degrees * pi / 180;
  const auto b = static_cast<std::size_t>((axis + 1) % 3),
             c = static_cast<std::size_t>((axis + 2) % 3);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto radiusAt = [=](int i, int j)
  { return i == 1 && merged > 0 ? (j % 3 == 1 ? 0.5 : 1.5) * merged : i / (away - 1.); };
  const auto add = [&](int i, int j, double angle)
  {
    const double r = radiusAt(i, j);
    Vec x{};
    x[static_cast<std::size_t>(axis)] = -1 + j * 0.05;
    x[b] = r * std::cos(angle);
    x[c] = r * std::sin(angle);
    return points->InsertNextPoint(x.data());
  };
  vtkSmartPointer<vtkPointSet> result;
  if (isStructured)
  {
    for (const double angle : { -half, half })
    {
      for (int j = 0; j < along; ++j)
      {
        for (int i = 0; i < away; ++i)
        {
          add(i, j, angle);
        }
      }
    }
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    grid->SetDimensions(away, along, 2);
    result = grid;
  }
  else
  {
    vtkIdType ids[2][along][away];
    for (int j = 0; j < along; ++j)
    {
      for (int i = 0; i < away; ++i)
      {
        const bool isOne = i > 0 && radiusAt(i, j) < merged;
        ids[0][j][i] = add(i, j, isOne ? at * half : -half);
        ids[1][j][i] = i == 0 || isOne ? ids[0][j][i] : add(i, j, half);
      }
    }
    auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
    for (int j = 0; j + 1 < along; ++j)
    {
      for (int i = 0; i + 1 < away; ++i)
      {
        if (i == 0)
        {
          const vtkIdType corners[6] = { ids[0][j][0], ids[0][j][1], ids[1][j][1], ids[0][j + 1][0],
            ids[0][j + 1][1], ids[1][j + 1][1] };
          mesh->InsertNextCell(VTK_WEDGE, 6, corners);
          continue;
        }
        const vtkIdType corners[8] = { ids[0][j][i], ids[0][j][i + 1], ids[0][j + 1][i + 1],
          ids[0][j + 1][i], ids[1][j][i], ids[1][j][i + 1], ids[1][j + 1][i + 1],
          ids[1][j + 1][i] };
        mesh->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
      }
    }
    result = mesh;
  }
  result->SetPoints(points);
  const auto field = [=](const Vec& x)
  { return column.A * std::exp(-(x[b] * x[b] + x[c] * x[c]) / (column.s * column.s)); };
  ofCells ? addCellArray(result, "N", field) : static_cast<void>(addPointArray(result, "N", field));
  return result;
}

} // namespace

TEST(Revolved, PlanesAreAColumnFromAnySide)
{
  for (const int radial : { 0, 2 })
  {
    for (const bool ofCells : { false, true })
    {
      if (radial == 2 && ofCells)
      {
        continue;
      }
      const auto image = section(radial, ofCells);
      vtkNew<vtkImageDataToPointSet> structured;
      structured->SetInputData(image);
      structured->Update();
      const auto triangles = asTriangles(image);
      for (vtkDataSet* input :
        { static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(structured->GetOutput()),
          static_cast<vtkDataSet*>(triangles) })
      {
        if (radial == 2 && input != image)
        {
          continue;
        }
        SCOPED_TRACE(testing::Message() << radial << ' ' << input->GetClassName() << ofCells);
        auto filter = revolved(input, ofCells);
        filter->SetPathModel(vtkSchlierenFilter::STRAIGHT); // as the closed form's
        const std::string warning = warningOf(filter);
        EXPECT_NE(warning.find("revolved around the y axis"), std::string::npos) << warning;
        for (const Vec& direction : { Vec{ 1, 0, 0 }, Vec{ -1, 0, -2 } })
        {
          if (direction[2] == 0 && input != image)
          {
            continue;
          }
          filter->SetViewDirection(direction[0], direction[1], direction[2]);
          filter->Update();
          const ColumnErrors errors = compareWithColumn(filter, column, direction);
          EXPECT_LT(errors.opticalPath, 1e-3);
          EXPECT_LT(errors.deflection, ofCells ? 8e-3 : 4e-3);
        }
        EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
      }
    }
  }
}

// Points half a spacing from the axis, data on the negative side, on both sides, and elsewhere.
TEST(Revolved, PlanesMayLieOtherwise)
{
  const struct
  {
    double from, to, origin;
  } cases[] = { { 0.00625, 1.00625, 0 }, { -1, 0, 0 }, { -1, 1, 0 } };
  for (const auto& one : cases)
  {
    auto filter = revolved(section(0, false, one.from, one.to));
    filter->SetSymmetryAxis(vtkRefractiveIndex::AXIS_Y);
    const std::string warning = warningOf(filter);
    EXPECT_EQ(warning.find("both sides") != std::string::npos, one.from * one.to < 0) << warning;
    const ColumnErrors errors = compareWithColumn(filter, column);
    EXPECT_LT(errors.opticalPath, 1e-3) << one.from;
    EXPECT_LT(errors.deflection, 4e-3) << one.from;
  }
  auto moved = section(0);
  moved->SetOrigin(5, -1, 3);
  auto filter = revolved(moved);
  filter->SetSymmetryAxis(vtkRefractiveIndex::AXIS_Y);
  filter->SetSymmetryOrigin(5, 0, 3);
  filter->SetFocalPoint(5, 0, 3);
  filter->Update();
  auto centred = revolved(section(0));
  centred->SetFocalPoint(0, 0, 0);
  centred->Update();
  EXPECT_LT(relativeDifference(valuesOf(filter, "OpticalPathDifference"),
              valuesOf(centred, "OpticalPathDifference")),
    1e-4);
}

// Of OpenFOAM, and of solvers with structured grids.
TEST(Revolved, WedgesAreAColumn)
{
  const Vec directions[3] = { { 0, 0, -1 }, { 0, 0, -1 }, { 0, 1, 0 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool isStructured : { false, true })
    {
      for (const bool ofCells : { false, true })
      {
        if (isStructured == (axis == 0) || (axis == 2 && ofCells))
        {
          continue;
        }
        SCOPED_TRACE(testing::Message() << axis << isStructured << ofCells);
        auto filter = revolved(wedge(axis, isStructured, ofCells), ofCells);
        const Vec& to = directions[axis];
        const Vec up = axis == 0 ? Vec{ 1, 0, 0 } : axis == 1 ? Vec{ 0, 1, 0 } : Vec{ 0, 0, 1 };
        filter->SetViewDirection(to[0], to[1], to[2]);
        filter->SetViewUp(up[0], up[1], up[2]);
        filter->FaceFlatDataOff();
        const std::string warning = warningOf(filter);
        EXPECT_NE(
          warning.find(std::string("revolved around the ") + "xyz"[axis]), std::string::npos)
          << warning;
        const ColumnErrors errors = compareWithColumn(filter, column); // the axis is up, as y was
        EXPECT_LT(errors.opticalPath, 1e-3);
        EXPECT_LT(errors.deflection, ofCells ? 8e-3 : 4e-3);
      }
    }
  }
}

// By default, and nothing else is; Status says it.
TEST(Revolved, WedgesAreByThemselves)
{
  const struct
  {
    double degrees;
    const char* text;
  } cases[] = { { 5, "a wedge of 5 degrees is revolved around the x axis" },
    { 0.2, "a wedge of 0.2 degrees is revolved around the x axis" } };
  for (const auto& [degrees, text] : cases)
  {
    auto filter = revolved(wedge(0, false, false, degrees));
    filter->SetSymmetry(vtkNew<vtkSchlierenFilter>()->GetSymmetry());
    filter->SetMediumTolerance(0.05);
    EXPECT_EQ(warningOf(filter), "");
    EXPECT_NE(std::string(filter->GetStatus()).find(text), std::string::npos)
      << filter->GetStatus();
    const std::vector<double> path = valuesOf(filter, "OpticalPathDifference");
    filter->SetSymmetry(vtkRefractiveIndex::SYMMETRY_AXISYMMETRIC);
    filter->Update();
    EXPECT_EQ(valuesOf(filter, "OpticalPathDifference"), path);
    filter->SetSymmetry(vtkRefractiveIndex::SYMMETRY_NONE);
    EXPECT_EQ(warningOf(filter), "");
    EXPECT_EQ(std::string(filter->GetStatus()).find("revolved"), std::string::npos);
    EXPECT_LT(largest(valuesOf(filter, "OpticalPathDifference")), 0.2 * largest(path));
  }
  auto plane = revolved(section(0));
  plane->SetSymmetry(vtkRefractiveIndex::SYMMETRY_AUTO);
  EXPECT_NE(warningOf(plane).find("The data are 2-D, across z"), std::string::npos);
}

// Some meshers merge the points of both planes where these are closer than a limit: to one of them
// or between them.
TEST(Revolved, WedgesMayHaveMergedPointsNearTheAxis)
{
  for (const double at : { -1., 0., 1. })
  {
    auto filter = revolved(wedge(0, false, false, 0.2, 2e-4, at));
    filter->SetViewDirection(0, 0, -1);
    filter->SetViewUp(1, 0, 0);
    filter->FaceFlatDataOff();
    EXPECT_NE(warningOf(filter).find("revolved around the x"), std::string::npos) << at;
    const ColumnErrors errors = compareWithColumn(filter, column);
    EXPECT_LT(errors.opticalPath, 1e-3) << at;
    EXPECT_LT(errors.deflection, 4e-3) << at;
  }
}

namespace
{

/// The half plane of a jet along x that begins somewhere, with gas at rest before it.
vtkSmartPointer<vtkImageData> jet(double start, double uneven, bool isTurned)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  isTurned ? image->SetDimensions(81, 181, 1) : image->SetDimensions(181, 81, 1);
  isTurned ? image->SetSpacing(0.25, 0.5, 1) : image->SetSpacing(0.5, 0.25, 1);
  addPointArray(image, "N",
    [=](const Vec& at)
    {
      const double x = at[isTurned ? 1 : 0], r = at[isTurned ? 0 : 1];
      const double part = std::exp(-r * r / 2.25) / (1 + std::exp(start - x));
      return 1e-6 * (part * (1 + 0.3 * std::sin(x)) + uneven * part * r * std::sin(3 * x));
    });
  return image;
}

} // namespace

// Uniform gas at an axis has no slope there, but says nothing.
TEST(Revolved, JetsTurnAroundTheirAxisWhereverTheyBegin)
{
  for (const double start : { 30., 1., -20. })
  {
    for (const double uneven : { 0., 0.02 })
    {
      for (const bool isTurned : { false, true })
      {
        const std::string warning = warningOfPlane(jet(start, uneven, isTurned));
        EXPECT_NE(
          warning.find(isTurned ? "around the y axis" : "around the x axis"), std::string::npos)
          << start << ' ' << uneven << warning;
        EXPECT_EQ(warning.find("not clear"), std::string::npos)
          << start << ' ' << uneven << warning;
      }
    }
  }
}

// A jet onto a plate is a disc, though that is the longer side; what is smooth at both axes, or at
// none, is said not to be clear.
TEST(Revolved, TheAxisMayBeAlongTheShorterSide)
{
  const auto plane = [](const std::function<double(double, double)>& field)
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(181, 81, 1);
    image->SetSpacing(0.5, 0.25, 1);
    addPointArray(image, "N", [&](const Vec& at) { return 1e-6 * field(at[0], at[1]); });
    return image;
  };
  const std::string disc = warningOfPlane(
    plane([](double r, double z) { return std::exp(-r * r / 30) * std::exp(-z / 4); }));
  EXPECT_NE(disc.find("around the y axis"), std::string::npos) << disc;
  EXPECT_EQ(disc.find("not clear"), std::string::npos) << disc;
  const std::string ball =
    warningOfPlane(plane([](double x, double y) { return std::exp(-(x * x + y * y) / 30); }));
  const std::string oblique =
    warningOfPlane(plane([](double x, double y) { return std::exp(-(x + y) / 5); }));
  for (const std::string& warning : { ball, oblique })
  {
    EXPECT_NE(warning.find("around the x axis"), std::string::npos) << warning;
    EXPECT_NE(warning.find("not clear"), std::string::npos) << warning;
    EXPECT_NE(warning.find("around the y axis instead"), std::string::npos) << warning;
  }
}

// A ball that the mesh leaves out is solid, and its shadow round.
TEST(Revolved, BodiesOnTheAxisAreSolid)
{
  constexpr double radius = 0.4;
  vtkNew<vtkStructuredGrid> mesh;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  constexpr int around = 91, outward = 41;
  for (int j = 0; j < outward; ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const double r = radius + (1 - radius) * j / (outward - 1), angle = pi * i / (around - 1);
      points->InsertNextPoint(r * std::cos(angle), i + 1 == around ? 0 : r * std::sin(angle), 0);
    }
  }
  mesh->SetDimensions(around, outward, 1);
  mesh->SetPoints(points);
  addPointArray(mesh, "N", [](const Vec& x) { return 1e-6 * x[0]; });
  auto filter = revolved(mesh);
  for (const Vec& direction : { Vec{ 0, 0, -1 }, Vec{ -1, 0, 0 }, Vec{ 1, 1, 1 } })
  {
    filter->SetViewDirection(direction[0], direction[1], direction[2]);
    filter->Update();
    auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
    double shadow = 0;
    for (const double blocked : valuesOf(filter, "BlockedFraction"))
    {
      shadow += blocked * image->GetSpacing()[0] * image->GetSpacing()[1];
    }
    EXPECT_NEAR(shadow / (pi * radius * radius), 1, 0.01);
  }
}

// An image of 128 points at least along its longest side, for volume rendering.
TEST(Revolved, RefractiveIndexIsAnImage)
{
  vtkNew<vtkRefractiveIndex> index;
  index->SetInputData(section(0));
  index->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  index->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  index->SetSymmetry(vtkRefractiveIndex::SYMMETRY_AXISYMMETRIC);
  vtkNew<vtkThreshold> consumer; // requests what was announced before there were data
  consumer->SetInputConnection(index->GetOutputPort());
  consumer->Update();
  auto* image = vtkImageData::SafeDownCast(index->GetOutputDataObject(0));
  ASSERT_NE(image, nullptr);
  const int* points = image->GetDimensions();
  EXPECT_GE(*std::max_element(points, points + 3), 128);
  EXPECT_LE(*std::max_element(points, points + 3), 256);
  EXPECT_NEAR(image->GetSpacing()[0], image->GetSpacing()[2], 0.02 * image->GetSpacing()[0]);
  double worst = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const bool isGas = arrayOf(index, "vtkValidPointMask")->GetComponent(i, 0) == 1;
    const double n = arrayOf(index, "Refractivity")->GetComponent(i, 0);
    worst = std::max(worst, std::abs(n - (isGas ? column({ x[0], x[1], x[2] }) : 0)));
    EXPECT_EQ(isGas, arrayOf(index, "TransparentPointMask")->GetComponent(i, 0) == 0);
  }
  EXPECT_LT(worst, 2e-3 * column.A);

  const vtkMTimeType made = image->GetUpdateTime();
  consumer->Update();
  index->Update();
  EXPECT_EQ(image->GetUpdateTime(), made);
  // Light bends in it as in the plane.
  auto filter = bench(image);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Refractivity");
  filter->SetParallelScale(0.7);
  filter->Update();
  EXPECT_LT(compareWithColumn(filter, column).opticalPath, 2e-3);

  index->SetSymmetry(vtkRefractiveIndex::SYMMETRY_NONE);
  index->Update();
  EXPECT_EQ(index->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT),
    section(0)->GetNumberOfPoints());
}

TEST(Revolved, MistakesAreReported)
{
  const auto solid = cube(5);
  addPointArray(solid, "N", column);
  auto filter = revolved(solid);
  expectOneMessage(
    filter.Get(), [](vtkSchlierenFilter*) {}, { "Symmetry", "3-D" },
    [](vtkSchlierenFilter* f) { f->SetSymmetry(vtkRefractiveIndex::SYMMETRY_NONE); });
  auto across = revolved(section(0));
  expectOneMessage(
    across.Get(), [](vtkSchlierenFilter* f) { f->SetSymmetryAxis(vtkRefractiveIndex::AXIS_Z); },
    { "SymmetryAxis is Z", "across" },
    [](vtkSchlierenFilter* f) { f->SetSymmetryAxis(vtkRefractiveIndex::AXIS_Y); });
}
