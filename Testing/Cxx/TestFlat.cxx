// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two-dimensional data are extruded by one data unit across their plane.
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkExtractVOI.h"
#include "vtkImageDataToPointSet.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLImageDataReader.h"

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

/// Looks along an axis onto the plane: a length of 1 of what the plane has.
void expectOnePlaneDeep(vtkSchlierenFilter* filter, int axis, double tolerance)
{
  const Vec directions[3] = { { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } };
  const Vec up = axis == 1 ? Vec{ 0, 0, 1 } : Vec{ 0, 1, 0 };
  filter->SetViewDirection(directions[axis].data());
  filter->SetViewUp(up[0], up[1], up[2]);
  filter->SetParallelScale(0.9);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find(std::string("one data unit along ") + "xyz"[axis]),
    std::string::npos)
    << complaints->Warnings[0];
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

TEST(Flat, ImageOfPointsOrCellsIsOneUnitDeep)
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
  filter->SetFocalPoint(0, height, 0);
  filter->SetParallelScale(0.49);
  filter->Update();
  EXPECT_LT(compareWithColumn(filter, GaussianColumn()).deflection, 1e-3);
  EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
  vtkNew<vtkImageData> grid;
  vtkNew<vtkRefractiveIndex> medium;
  medium->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  medium->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  medium->ComputeGrid(filter->GetInputDataObject(0, 0), grid);
  EXPECT_EQ(grid->GetBounds()[2], height - 0.5);
  EXPECT_EQ(grid->GetBounds()[3], height + 0.5);
}

TEST(Flat, MeshesAreOneUnitDeep)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    auto image = plane(axis, 129);
    double spacing[3];
    image->GetSpacing(spacing);
    spacing[axis] = 1;
    image->SetSpacing(spacing);
    vtkNew<vtkImageDataToPointSet> structured;
    structured->SetInputData(image);
    structured->Update();
    vtkNew<vtkAppendFilter> pixels;
    pixels->SetInputData(image);
    vtkNew<vtkDataSetTriangleFilter> triangles;
    triangles->SetInputConnection(pixels->GetOutputPort());
    triangles->Update();
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, triangles->GetOutput());
    for (vtkDataObject* input :
      { static_cast<vtkDataObject*>(structured->GetOutput()),
        static_cast<vtkDataObject*>(triangles->GetOutput()), static_cast<vtkDataObject*>(blocks) })
    {
      auto filter = bench(input, 128); // no voxel is smaller than a pixel
      filter->SetMediumTolerance(0.001);
      expectOnePlaneDeep(filter, axis, 2e-3);
    }
  }
}

// One slice of a shock that the file holds 3-D: the same optical path for each unit of length.
TEST(Flat, SliceOfAShockIsAsDeepAsItIsThick)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(SCHLIEREN_TEST_DATA "/oblique_shock_extruded.vti");
  reader->Update();
  vtkImageData* whole = reader->GetOutput();
  vtkNew<vtkExtractVOI> slice;
  slice->SetInputData(whole);
  const int* extent = whole->GetExtent();
  slice->SetVOI(extent[0], extent[1], extent[2], extent[3], extent[4], extent[4]);
  slice->Update();
  const double depth = whole->GetBounds()[5] - whole->GetBounds()[4];
  const auto pathsThrough = [](vtkDataObject* input)
  {
    auto filter = bench(input);
    filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE);
    filter->SetInputArrayToProcess(
      vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");
    filter->SetDensityScale(1e-3); // so weak that no ray is displaced
    filter->Update();
    return valuesOf(filter, "OpticalPathDifference");
  };
  std::vector<double> expected = pathsThrough(whole);
  for (double& path : expected)
  {
    path /= depth;
  }
  EXPECT_LT(relativeDifference(pathsThrough(slice->GetOutput()), expected), 1e-4);
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
