// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two-dimensional data are extruded across their plane, by Depth.
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkImageDataToPointSet.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

namespace
{

constexpr double height = 0.25; // of the plane

/// A Gaussian of the distance from the axis through the origin, in a square across that axis.
vtkSmartPointer<vtkImageData> plane(int axis, int points, bool ofCells = false)
{
  auto image = cube(points);
  int dimensions[3] = { points, points, points };
  dimensions[axis] = 1;
  double origin[3] = { -1, -1, -1 };
  origin[axis] = height;
  double spacing[3];
  image->GetSpacing(spacing);
  spacing[axis] = 0; // as some writers have it
  image->SetDimensions(dimensions);
  image->SetOrigin(origin);
  image->SetSpacing(spacing);
  const auto field = [axis](Vec x)
  {
    x[static_cast<std::size_t>(axis)] = 0;
    const GaussianColumn column;
    return column.A * std::exp(-dot(x, x) / (column.s * column.s));
  };
  if (ofCells)
  {
    addCellArray(image, "N", field);
  }
  else
  {
    addPointArray(image, "N", field);
  }
  return image;
}

/// As structured points, as cells, or as blocks of images.
std::vector<vtkSmartPointer<vtkDataObject>> asMeshes(vtkImageData* image)
{
  vtkNew<vtkImageDataToPointSet> structured;
  structured->SetInputData(image);
  structured->Update();
  vtkNew<vtkAppendFilter> pixels;
  pixels->SetInputData(image);
  vtkNew<vtkDataSetTriangleFilter> triangles;
  triangles->SetInputConnection(pixels->GetOutputPort());
  triangles->Update();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, image);
  return { structured->GetOutput(), pixels->GetOutput(), triangles->GetOutput(), blocks };
}

/// Looks along an axis onto the plane: a length of 1 of what the plane has.
void expectOnePlaneDeep(vtkSchlierenFilter* filter, int axis, double tolerance)
{
  const Vec directions[3] = { { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } };
  const Vec up = axis == 1 ? Vec{ 0, 0, 1 } : Vec{ 0, 1, 0 };
  filter->SetViewDirection(directions[axis].data());
  filter->SetViewUp(up[0], up[1], up[2]);
  filter->SetParallelScale(0.9);
  filter->SetDepth(1);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  EXPECT_TRUE(complaints->Warnings.empty());
  EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);

  const GaussianColumn column;
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  std::vector<double> deflection, opticalPath;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const double n = column.A * std::exp(-(x[0] * x[0] + x[1] * x[1]) / (column.s * column.s));
    deflection.push_back(-2 * x[0] / (column.s * column.s) * n);
    deflection.push_back(-2 * x[1] / (column.s * column.s) * n);
    opticalPath.push_back(n);
  }
  EXPECT_LT(relativeDifference(valuesOf(filter, "Deflection"), deflection), tolerance);
  EXPECT_LT(relativeDifference(valuesOf(filter, "OpticalPathDifference"), opticalPath), tolerance);
}

} // namespace

TEST(Flat, ImagesOfPointsOrCellsAreAsDeepAsGiven)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool ofCells : { false, true })
    {
      auto filter = bench(plane(axis, 129, ofCells));
      expectOnePlaneDeep(filter, axis, 2e-3);
    }
  }
}

// Seen along its plane it is a column, and as high as a unit: half of it to each side of the plane.
TEST(Flat, ImageIsAColumnFromTheSide)
{
  auto filter = bench(plane(1, 129));
  filter->SetDepth(1);
  filter->SetViewDirection(0, 0, 1); // not as by default, which would be from in front
  filter->SetFocalPoint(0, height, 0);
  filter->SetParallelScale(0.49);
  filter->Update();
  EXPECT_LT(compareWithColumn(filter, GaussianColumn(), { 0, 0, 1 }).deflection, 1e-3);
  EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
}

TEST(Flat, MeshesAreAsDeepAsGiven)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    auto image = plane(axis, 129);
    double spacing[3];
    image->GetSpacing(spacing);
    spacing[axis] = 1;
    image->SetSpacing(spacing);
    for (const vtkSmartPointer<vtkDataObject>& input : asMeshes(image))
    {
      auto filter = bench(input, 128); // no voxel is smaller than a pixel
      filter->SetMediumTolerance(0.001);
      expectOnePlaneDeep(filter, axis, 2e-3);
    }
  }
}

// Hidden cells, and points of which all cells are hidden, are solid in two dimensions, too.
TEST(Flat, HiddenCellsBlock)
{
  for (const bool ofCells : { false, true })
  {
    auto image = plane(2, 33, ofCells);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfValues(image->GetNumberOfCells());
    for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
    {
      ghosts->SetValue(i, i % 32 < 16 ? vtkDataSetAttributes::HIDDENCELL : 0);
    }
    image->GetCellData()->AddArray(ghosts);
    auto filter = bench(image);
    filter->Update();
    const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
    EXPECT_EQ(blocked[64 * 32 + 8], 1);
    EXPECT_EQ(blocked[64 * 32 + 40], 0);
  }
}

namespace
{

/// A bump in a plane of 40 by 20 mm, across an axis; lengths in units of so many mm.
vtkSmartPointer<vtkImageData> bump(double unit, int axis, bool ofCells = false)
{
  const auto across = static_cast<std::size_t>(axis);
  const std::size_t first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  auto image = vtkSmartPointer<vtkImageData>::New();
  int points[3] = { 1, 1, 1 };
  double origin[3] = { 0, 0, 0 };
  points[first] = 81;
  points[second] = 41;
  origin[first] = -20 / unit;
  origin[second] = -10 / unit;
  image->SetDimensions(points);
  image->SetOrigin(origin);
  image->SetSpacing(0.5 / unit, 0.5 / unit, 0.5 / unit);
  const auto field = [=](Vec x)
  {
    x[across] = 0;
    return 1e-4 * std::exp(-dot(x, x) * unit * unit / 16);
  };
  ofCells ? addCellArray(image, "N", field) : static_cast<void>(addPointArray(image, "N", field));
  return image;
}

double largestOf(vtkSchlierenFilter* filter, const char* name)
{
  filter->Update();
  return largest(valuesOf(filter, name));
}

} // namespace

// Without a Depth, an image does not depend on the unit of lengths, and is as deep as it is high.
TEST(Flat, TheUnitOfLengthsDoesNotMatter)
{
  for (const bool ofCells : { false, true })
  {
    std::vector<vtkSmartPointer<vtkDataObject>> inputs = asMeshes(bump(1, 2, ofCells));
    inputs.emplace_back(bump(1, 2, ofCells));
    for (std::size_t kind = 0; kind < inputs.size(); ++kind)
    {
      SCOPED_TRACE(testing::Message() << kind << (ofCells ? " cells" : " points"));
      std::vector<double> paths;
      for (const double unit : { 1., 1000., 25.4 })
      {
        auto image = bump(unit, 2, ofCells);
        const auto meshes = asMeshes(image);
        auto filter = bench(kind < meshes.size() ? meshes[kind].Get() : image.Get());
        if (ofCells)
        {
          filter->SetInputArrayToProcess(
            vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
        }
        filter->SetLengthScale(unit * 1e-3);
        filter->SetMediumTolerance(1e-3);
        paths.push_back(largestOf(filter, "OpticalPathDifference"));
      }
      EXPECT_NEAR(paths[0], 1e-4 * 0.02, 4e-8); // half a pixel from the middle
      EXPECT_NEAR(paths[1] / paths[0], 1, 1e-5);
      EXPECT_NEAR(paths[2] / paths[0], 1, 1e-5);
    }
  }
}

// By default whatever plane it is, it is seen from in front, with z up; but not where another view is set.
TEST(Flat, ThePlaneIsSeenFromInFront)
{
  for (const bool isMesh : { false, true })
  {
    std::vector<std::vector<double>> seen;
    for (const int axis : { 2, 1, 0 })
    {
      auto image = bump(1, axis);
      auto filter = bench(isMesh ? asMeshes(image)[0].Get() : image.Get());
      auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
      filter->Update();
      seen.push_back(valuesOf(filter, "OpticalPathDifference"));
      EXPECT_NE(complaints->Warnings.at(0).find(
                  std::string("2-D, across ") + "xyz"[axis] + ": they become 20 data units deep"),
        std::string::npos)
        << complaints->Warnings[0];
      EXPECT_EQ(complaints->Warnings.at(0).find("ViewDirection") != std::string::npos, axis != 2);
      EXPECT_LT(relativeDifference(seen.back(), seen.front()), 1e-3) << axis;
    }
    auto filter = bench(bump(1, 1));
    filter->FaceFlatDataOff();
    filter->Update();
    const auto fromTheSide = valuesOf(filter, "OpticalPathDifference");
    EXPECT_GT(relativeDifference(fromTheSide, seen[0]), 0.1);
    filter->FaceFlatDataOn();
    filter->SetViewDirection(0, 0, -2);
    filter->Update();
    EXPECT_EQ(valuesOf(filter, "OpticalPathDifference"), fromTheSide);
  }
}

namespace
{

/// A disturbance of 1.3 in diameter, in a plane of 40 by 48 across an axis, in units of so many mm.
vtkSmartPointer<vtkStructuredGrid> farField(int axis, double unit, bool ofCells)
{
  const auto across = static_cast<std::size_t>(axis);
  constexpr int points = 121;
  auto mesh = vtkSmartPointer<vtkStructuredGrid>::New();
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  const auto at = [](int i) // points become denser towards the middle
  { return 20 * std::copysign(std::pow(std::abs(i / 60. - 1), 3), i - 60.); };
  for (int j = 0; j < points; ++j)
  {
    for (int i = 0; i < points; ++i)
    {
      Vec x{};
      x[(across + 1) % 3] = at(i) / unit;
      x[(across + 2) % 3] = 1.2 * at(j) / unit;
      places->InsertNextPoint(x.data());
    }
  }
  int dimensions[3] = { points, points, 1 };
  mesh->SetDimensions(dimensions);
  mesh->SetPoints(places);
  const auto field = [=](const Vec& x)
  {
    const double r = std::sqrt(dot(x, x)) * unit;
    // Beyond it there are waves of 2 % of the largest difference.
    return 2.7e-4 + 1e-4 * (r < 0.65 ? std::cos(pi * r / 1.3) + 0.06 : 0.02 * std::sin(9 * r));
  };
  ofCells ? addCellArray(mesh, "N", field) : static_cast<void>(addPointArray(mesh, "N", field));
  return mesh;
}

std::string warningAbout(vtkDataObject* input, bool ofCells, double& depth)
{
  auto filter = bench(input, 9);
  filter->SetMediumTolerance(1);
  filter->SetInputArrayToProcess(vtkRefractiveIndex::INDEX_ARRAY, 0, 0,
    ofCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
    "N");
  filter->SetAmbientRefractivity(2.7e-4);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  const std::string text = complaints->Warnings.at(0);
  const std::string before = "they become ";
  depth = std::stod(text.substr(text.find(before) + before.size()));
  return text;
}

} // namespace

// A plane is not as deep as its far field is wide, but 1.25, 2.5 or 5: what is in it has room in it.
TEST(Flat, AFarFieldIsAsDeepAsTheFlowInIt)
{
  for (const int axis : { 0, 1, 2 })
  {
    for (const bool ofCells : { false, true })
    {
      const double unit = ofCells == (axis == 1) ? 25.4 : 1;
      SCOPED_TRACE(testing::Message() << axis << ofCells << unit);
      const auto mesh = farField(axis, unit, ofCells);
      double depth;
      const std::string text = warningAbout(mesh, ofCells, depth);
      EXPECT_NEAR(depth * unit, 2.5, 1e-3) << text;
      EXPECT_NE(text.find("the flow in them is"), std::string::npos) << text;
      // The order of cells does not matter.
      vtkNew<vtkDataSetTriangleFilter> triangles;
      triangles->SetInputData(mesh);
      triangles->Update();
      double ofOther;
      warningAbout(triangles->GetOutput(), ofCells, ofOther);
      EXPECT_EQ(ofOther, depth);
    }
  }
}

TEST(Flat, APlaneThatIsFullIsAsDeepAsItIsHigh)
{
  const std::pair<const char*, std::function<double(const Vec&)>> flows[] = {
    { "channel", [](const Vec& x) { return 1e-4 * (1 - x[1] * x[1]); } },
    { "mixing layer", [](const Vec& x) { return 1e-4 * std::tanh(8 * x[1] / (1.5 + x[0])); } },
    { "jet", [](const Vec& x) { return 1e-4 * std::exp(-x[1] * x[1] / 0.1); } },
    { "shock", [](const Vec& x) { return x[0] > 0.4 * x[1] ? 3e-4 : 1e-4; } },
    { "still gas", [](const Vec&) { return 1e-4; } }
  };
  for (const auto& [name, field] : flows)
  {
    auto image = plane(2, 65);
    addPointArray(image, "N", field);
    double depth;
    const std::string text = warningAbout(image, false, depth);
    EXPECT_EQ(depth, 2) << name << text;
    EXPECT_NE(text.find("as their shorter side is long"), std::string::npos) << name << text;
  }
}

// An image's own axes may be turned.
TEST(Flat, TurnedFarFieldsAreAsDeep)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(201, 161, 1);
  image->SetOrigin(-5, -4, 0);
  image->SetSpacing(0.05, 0.05, 1);
  addPointArray(
    image, "N", [](const Vec& x) { return 1e-4 * std::exp(-(x[0] * x[0] + x[1] * x[1]) / 0.1); });
  double depth, ofTurned;
  warningAbout(image, false, depth);
  EXPECT_NEAR(depth, 2, 1e-9);
  vtkNew<vtkMatrix3x3> turn;
  turn->SetElement(0, 0, 0.8);
  turn->SetElement(0, 1, -0.6);
  turn->SetElement(1, 0, 0.6);
  turn->SetElement(1, 1, 0.8);
  image->SetDirectionMatrix(turn);
  warningAbout(image, false, ofTurned);
  EXPECT_EQ(ofTurned, depth);
}

// A patch of other gas, in planes of all kinds.
TEST(Flat, SurroundingsAreThoseAtTheEdges)
{
  for (const bool ofCells : { false, true })
  {
    auto image = plane(1, 65);
    image->GetPointData()->Initialize();
    const auto patch = [](const Vec& x) { return std::hypot(x[0], x[2]) < 0.9 ? 4e-4 : 2.7e-4; };
    ofCells ? addCellArray(image, "N", patch) : static_cast<void>(addPointArray(image, "N", patch));
    double spacing[3];
    image->GetSpacing(spacing);
    spacing[1] = 1;
    image->SetSpacing(spacing);
    std::vector<vtkSmartPointer<vtkDataObject>> inputs = asMeshes(image);
    inputs.emplace_back(image);
    for (const auto& input : inputs)
    {
      auto filter = bench(input, 33);
      filter->SetInputArrayToProcess(vtkRefractiveIndex::INDEX_ARRAY, 0, 0,
        ofCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
        "N");
      filter->SetAmbientRefractivity(-1);
      filter->Update();
      EXPECT_NEAR(fieldValue(filter, "AmbientRefractivity"), 2.7e-4, 1e-9)
        << input->GetClassName() << ofCells;
    }
  }
}
