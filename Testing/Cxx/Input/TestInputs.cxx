// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkExtractVOI.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

namespace
{

vtkSmartPointer<vtkUnstructuredGrid> voxels(vtkDataSet* data)
{
  vtkNew<vtkAppendFilter> append;
  append->SetInputData(data);
  append->Update();
  return append->GetOutput();
}

void sampleLike(vtkSchlierenFilter* filter, int points)
{
  filter->SetSamplingDimensions(points, points, points);
}

} // namespace

// On the grid of the cells' centres nothing is averaged: as accurate as point data.
TEST(Inputs, CellArrayOfAnImageIsNotSmoothed)
{
  auto image = cube(129);
  addCellArray(image, "N", GaussianColumn());
  auto filter = bench(image);
  filter->SetParallelScale(0.9);
  filter->Update();
  const ColumnErrors errors = compareWithColumn(filter, GaussianColumn());
  EXPECT_LT(errors.deflection, 1e-3);
  EXPECT_LT(errors.opticalPath, 1e-3);
}

// Two halves that share a face, a block without the array and a surface with it.
TEST(Inputs, BlocksMakeOneImage)
{
  const auto image = columnImage(48);
  vtkNew<vtkMultiBlockDataSet> inner;
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int half = 0; half < 2; ++half)
  {
    vtkNew<vtkExtractVOI> extract;
    extract->SetInputData(image);
    extract->SetVOI(half ? 20 : 0, half ? 47 : 20, 0, 47, 0, 47);
    extract->Update();
    inner->SetBlock(static_cast<unsigned int>(half), voxels(extract->GetOutput()));
  }
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.5);
  sphere->Update();
  vtkNew<vtkPolyData> surface;
  surface->DeepCopy(sphere->GetOutput());
  addPointArray(surface, "N", [](const Vec&) { return 1.; });
  blocks->SetBlock(0, surface);
  blocks->SetBlock(1, inner);
  blocks->SetBlock(2, voxels(cube(3, 0.2)));
  blocks->SetBlock(4, cube(2)); // and 3 is empty

  auto direct = bench(image);
  direct->Update();
  auto composite = bench(blocks);
  sampleLike(composite, 48);
  composite->Update();
  EXPECT_LT(
    relativeDifference(valuesOf(composite, "Deflection"), valuesOf(direct, "Deflection")), 1e-4);
  EXPECT_EQ(largest(valuesOf(composite, "BlockedFraction")), 0);

  // A change deep within the composite is seen.
  auto* leaf = vtkDataSet::SafeDownCast(inner->GetBlock(0));
  addPointArray(leaf, "N", [](const Vec&) { return 0.; });
  leaf->Modified();
  blocks->Modified();
  composite->Update();
  EXPECT_GT(
    relativeDifference(valuesOf(composite, "Deflection"), valuesOf(direct, "Deflection")), 0.5);
}

TEST(Inputs, PartitionedImageKeepsItsGrid)
{
  const auto image = columnImage(40);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, image);
  auto direct = bench(image, 32);
  direct->Update();
  auto partitioned = bench(collection, 32);
  partitioned->Update();
  EXPECT_EQ(valuesOf(partitioned, "Deflection"), valuesOf(direct, "Deflection"));
}

// The extent of an image need not begin at 0.
TEST(Inputs, ExtentMayBeginAnywhere)
{
  const auto image = columnImage(32);
  auto direct = bench(image, 32);
  direct->Update();
  auto shifted = cube(32);
  const double h = shifted->GetSpacing()[0];
  shifted->SetExtent(-5, 26, 7, 38, 100, 131);
  shifted->SetOrigin(-1 + 5 * h, -1 - 7 * h, -1 - 100 * h);
  shifted->GetPointData()->AddArray(image->GetPointData()->GetArray("N"));
  auto filter = bench(shifted, 32);
  filter->Update();
  EXPECT_LT(
    relativeDifference(valuesOf(filter, "Deflection"), valuesOf(direct, "Deflection")), 1e-5);
}

TEST(Inputs, AnArrayIsFoundUnderTheOtherAssociation)
{
  auto image = cube(33);
  addCellArray(image, "N", GaussianColumn());
  auto filter = bench(image, 16); // requests a point array
  Complaints* complaints = new Complaints(filter);
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  EXPECT_FALSE(isEmpty(filter));
  complaints->Delete();
}
