// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Data that are spread over ranks become what one rank would have.
#include "Fixtures.h"
#include "Input/DatasetPieces.h"
#include "Input/GatheredData.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExtractCells.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using namespace filters;

namespace
{

using Extent = std::array<int, 6>;
const Extent whole{ 2, 9, -3, 4, 1, 11 };

double valueAt(const double* x) { return std::sin(3 * x[0]) + x[1] * x[2] / 3; }

/// An array of points or cells, whose values are their places.
void addValues(vtkDataSet* data, const char* name)
{
  vtkNew<vtkDoubleArray> ofPoints, ofCells;
  ofPoints->SetName(name);
  ofCells->SetName("of cells");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    ofPoints->InsertNextValue(valueAt(data->GetPoint(i)));
  }
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    data->GetCellBounds(i, bounds);
    const double middle[3] = { bounds[0] + bounds[1], bounds[2] + bounds[3],
      bounds[4] + bounds[5] };
    ofCells->InsertNextValue(valueAt(middle));
  }
  data->GetPointData()->AddArray(ofPoints);
  data->GetCellData()->AddArray(ofCells);
}

vtkSmartPointer<vtkDataSet> imageOf(Extent extent)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetOrigin(1. / 3, -2. / 7, 1e6 / 3);
  image->SetSpacing(0.1 / 3, 0.2 / 3, 1e-3 / 7);
  const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  image->SetDirectionMatrix(turned);
  image->SetExtent(extent.data());
  addValues(image, "rho");
  return image;
}

vtkSmartPointer<vtkDataSet> rectilinearOf(Extent extent)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetExtent(extent.data());
  vtkSmartPointer<vtkDoubleArray> axes[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    axes[axis] = vtkSmartPointer<vtkDoubleArray>::New();
    for (int i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
    {
      axes[axis]->InsertNextValue(std::exp(0.1 * i));
    }
  }
  grid->SetXCoordinates(axes[0]);
  grid->SetYCoordinates(axes[1]);
  grid->SetZCoordinates(axes[2]);
  addValues(grid, "rho");
  return grid;
}

vtkSmartPointer<vtkDataSet> curvilinearOf(Extent extent)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetExtent(extent.data());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        points->InsertNextPoint((1 + 0.1 * j) * i, 0.3 * j + 0.01 * i * k, k / 3.);
      }
    }
  }
  grid->SetPoints(points);
  addValues(grid, "rho");
  return grid;
}

/// Those cells of the grid whose layer along z is one of these.
vtkSmartPointer<vtkDataSet> meshOf(const Extent& extent)
{
  const vtkSmartPointer<vtkDataSet> all = curvilinearOf(whole);
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(all);
  const vtkIdType ofLayer = vtkIdType{ whole[1] - whole[0] } * (whole[3] - whole[2]);
  vtkNew<vtkIdList> kept;
  for (vtkIdType cell = ofLayer * (extent[4] - whole[4]); cell < ofLayer * (extent[5] - whole[4]);
       ++cell)
  {
    kept->InsertNextId(cell);
  }
  vtkNew<vtkExtractCells> extract;
  extract->SetInputConnection(append->GetOutputPort());
  extract->SetCellList(kept);
  extract->Update();
  extract->GetOutput()->GetPointData()->RemoveArray("vtkOriginalPointIds");
  extract->GetOutput()->GetCellData()->RemoveArray("vtkOriginalCellIds");
  return extract->GetOutput();
}

/// To the last bit.
void expectSame(vtkDataSet* a, vtkDataSet* b)
{
  ASSERT_TRUE(a && b);
  ASSERT_STREQ(a->GetClassName(), b->GetClassName());
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  ASSERT_EQ(a->GetNumberOfCells(), b->GetNumberOfCells());
  if (auto* image = vtkImageData::SafeDownCast(a))
  {
    auto* other = vtkImageData::SafeDownCast(b);
    for (int i = 0; i < 9; ++i)
    {
      EXPECT_EQ(
        image->GetDirectionMatrix()->GetData()[i], other->GetDirectionMatrix()->GetData()[i]);
      EXPECT_EQ(image->GetSpacing()[i % 3], other->GetSpacing()[i % 3]);
      EXPECT_EQ(image->GetOrigin()[i % 3], other->GetOrigin()[i % 3]);
      EXPECT_EQ(image->GetExtent()[i % 6], other->GetExtent()[i % 6]);
    }
  }
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    double one[3], other[3];
    a->GetPoint(i, one);
    b->GetPoint(i, other);
    ASSERT_TRUE(std::equal(one, one + 3, other)) << "point " << i;
  }
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    const char* name = kind == vtkDataObject::POINT ? "rho" : "of cells";
    vtkDataArray* one = a->GetAttributes(kind)->GetArray(name);
    vtkDataArray* other = b->GetAttributes(kind)->GetArray(name);
    ASSERT_TRUE(one && other) << name;
    ASSERT_EQ(one->GetNumberOfTuples(), other->GetNumberOfTuples());
    for (vtkIdType i = 0; i < one->GetNumberOfTuples(); ++i)
    {
      ASSERT_EQ(one->GetComponent(i, 0), other->GetComponent(i, 0)) << name << " " << i;
    }
  }
}

const std::vector<std::string> names{ "rho", "of cells" };

std::vector<char> packedData(vtkDataObject* data, const std::vector<std::string>& arrays)
{
  std::vector<char> bytes;
  for (const DatasetPiece& piece : piecesOf(data, arrays))
  {
    pack(piece, bytes);
  }
  return bytes;
}

vtkSmartPointer<vtkDataObject> gatheredOf(const std::vector<vtkDataObject*>& ofRanks)
{
  std::vector<std::vector<char>> packed;
  for (vtkDataObject* data : ofRanks)
  {
    packed.push_back(packedData(data, names));
  }
  return gatheredData(packed);
}

Extent layers(int first, int last)
{
  Extent extent = whole;
  extent[4] = first;
  extent[5] = last;
  return extent;
}

} // namespace

TEST(GatheredData, PartsOfAnImageAreTheImage)
{
  const auto low = imageOf(layers(1, 4)), high = imageOf(layers(4, 11));
  const auto all = gatheredOf({ low, high });
  expectSame(vtkDataSet::SafeDownCast(all), imageOf(whole));
  // In another order, overlapping, from ranks that have nothing.
  const auto more = imageOf(layers(3, 11));
  const vtkNew<vtkImageData> nothing;
  expectSame(vtkDataSet::SafeDownCast(gatheredOf({ nothing, more, nullptr, low })), imageOf(whole));
  // Of one rank alone.
  expectSame(vtkDataSet::SafeDownCast(gatheredOf({ nothing, low })), low);
}

TEST(GatheredData, PartsOfAMeshAreTheMesh)
{
  const auto low = meshOf(layers(1, 4)), high = meshOf(layers(4, 11));
  const auto all = gatheredOf({ low, high });
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(all);
  ASSERT_TRUE(mesh);
  // Points between the pieces are one each.
  const auto expected = meshOf(whole);
  EXPECT_EQ(mesh->GetNumberOfPoints(), expected->GetNumberOfPoints());
  ASSERT_EQ(mesh->GetNumberOfCells(), expected->GetNumberOfCells());
  vtkDataArray* values = mesh->GetPointData()->GetArray("rho");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    ASSERT_EQ(values->GetComponent(i, 0), valueAt(mesh->GetPoint(i)));
  }
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    double one[6], other[6];
    mesh->GetCellBounds(i, one);
    expected->GetCellBounds(i, other);
    ASSERT_TRUE(std::equal(one, one + 6, other));
    ASSERT_EQ(mesh->GetCellData()->GetArray("of cells")->GetComponent(i, 0),
      expected->GetCellData()->GetArray("of cells")->GetComponent(i, 0));
  }
}

TEST(GatheredData, CopiesOfOtherRanksCellsAreLeftOut)
{
  const auto low = meshOf(layers(1, 5)), high = meshOf(layers(4, 11));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  const vtkIdType ofLayer = vtkIdType{ whole[1] - whole[0] } * (whole[3] - whole[2]);
  for (vtkIdType i = 0; i < low->GetNumberOfCells(); ++i)
  {
    ghosts->InsertNextValue(i >= 3 * ofLayer ? vtkDataSetAttributes::DUPLICATECELL
        : i == 0                             ? vtkDataSetAttributes::HIDDENCELL
                                             : 0);
  }
  low->GetCellData()->AddArray(ghosts);
  const auto gathered = gatheredOf({ low, high });
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(gathered);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->GetNumberOfCells(), 10 * ofLayer);
  ASSERT_TRUE(mesh->GetCellGhostArray()); // though one piece has none
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    EXPECT_EQ(
      mesh->GetCellGhostArray()->GetValue(i), i == 0 ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
}

TEST(GatheredData, BlocksStayWhatTheyAre)
{
  // One block is spread, one is the first rank's, one the second's; and the pieces of one dataset.
  vtkNew<vtkMultiBlockDataSet> first, second;
  first->SetBlock(0, imageOf(layers(1, 4)));
  second->SetBlock(0, imageOf(layers(4, 11)));
  first->SetBlock(1, curvilinearOf(whole));
  first->SetBlock(2, nullptr);
  second->SetBlock(1, nullptr);
  second->SetBlock(2, rectilinearOf(whole));
  vtkNew<vtkMultiPieceDataSet> some, others;
  some->SetPiece(0, meshOf(layers(1, 2)));
  some->SetPiece(1, meshOf(layers(2, 4)));
  others->SetPiece(0, meshOf(layers(4, 11)));
  first->SetBlock(3, some);
  second->SetBlock(3, others);
  const auto gathered = gatheredOf({ first, second });
  auto* all = vtkMultiBlockDataSet::SafeDownCast(gathered);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->GetNumberOfBlocks(), 4u);
  expectSame(vtkDataSet::SafeDownCast(all->GetBlock(0)), imageOf(whole));
  expectSame(vtkDataSet::SafeDownCast(all->GetBlock(1)), curvilinearOf(whole));
  expectSame(vtkDataSet::SafeDownCast(all->GetBlock(2)), rectilinearOf(whole));
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(all->GetBlock(3));
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->GetNumberOfPoints(), meshOf(whole)->GetNumberOfPoints());
}

TEST(GatheredData, GridsThatAreNoPartsOfOneStayBlocks)
{
  const auto low = imageOf(layers(1, 4)), high = imageOf(layers(6, 11)); // with a gap
  const auto gathered = gatheredOf({ low, high });
  auto* all = vtkMultiBlockDataSet::SafeDownCast(gathered);
  ASSERT_TRUE(all);
  expectSame(vtkDataSet::SafeDownCast(all->GetBlock(0)), low);
  expectSame(vtkDataSet::SafeDownCast(all->GetBlock(1)), high);
  auto* elsewhere = vtkImageData::SafeDownCast(high);
  elsewhere->SetExtent(2, 9, -3, 4, 4, 11);
  elsewhere->SetOrigin(0, 0, 0);
  elsewhere->GetPointData()->Initialize();
  elsewhere->GetCellData()->Initialize();
  addValues(elsewhere, "rho");
  EXPECT_TRUE(vtkMultiBlockDataSet::SafeDownCast(gatheredOf({ low, elsewhere })));
}

TEST(GatheredData, PartsOfOtherGridsStayBlocks)
{
  for (const auto& gridOf : { rectilinearOf, curvilinearOf })
  {
    const auto low = gridOf(layers(1, 4)), high = gridOf(layers(4, 9));
    const auto gathered = gatheredOf({ low, high });
    auto* all = vtkMultiBlockDataSet::SafeDownCast(gathered);
    ASSERT_TRUE(all) << low->GetClassName();
    expectSame(vtkDataSet::SafeDownCast(all->GetBlock(0)), low);
    expectSame(vtkDataSet::SafeDownCast(all->GetBlock(1)), high);
  }
}

TEST(GatheredData, SurfacesAreOneSurface)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkNew<vtkSphereSource> beside;
  beside->SetCenter(3, 0, 0);
  beside->Update();
  const auto gathered = gatheredOf({ sphere->GetOutput(), beside->GetOutput() });
  auto* all = vtkPolyData::SafeDownCast(gathered);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->GetNumberOfPolys(), 2 * sphere->GetOutput()->GetNumberOfPolys());
}

TEST(GatheredData, OnlyArraysThatAreNeededAreSent)
{
  const auto low = imageOf(layers(1, 4)), high = imageOf(layers(4, 11));
  addValues(low, "not needed");
  const auto all = gatheredOf({ low, high });
  EXPECT_FALSE(vtkDataSet::SafeDownCast(all)->GetPointData()->HasArray("not needed"));
  EXPECT_LT(packedData(low, { "rho" }).size(), packedData(low, { "rho", "not needed" }).size());
}

TEST(GatheredData, PartsWithoutAnArrayAreAMistake)
{
  const auto low = meshOf(layers(1, 4)), high = meshOf(layers(4, 11));
  high->GetPointData()->RemoveArray("rho");
  try
  {
    gatheredOf({ low, high });
    FAIL();
  }
  catch (const std::runtime_error& problem)
  {
    EXPECT_NE(
      std::string(problem.what()).find("'rho' on one of them, none on another"), std::string::npos)
      << problem.what();
  }
}

TEST(GatheredData, WhatCannotBeReadIsAMistake)
{
  std::vector<char> packed = packedData(imageOf(whole), names);
  EXPECT_FALSE(gatheredData({}));
  EXPECT_FALSE(gatheredData({ {}, {} }));
  packed.pop_back();
  EXPECT_THROW(gatheredData({ packed }), std::runtime_error);
  packed.resize(5);
  EXPECT_THROW(gatheredData({ packed }), std::runtime_error);
}
