// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkImageDataToPointSet.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStructuredGrid.h"
#include "vtkThreshold.h"
#include "vtkUniformGrid.h"
#include "vtkUnstructuredGrid.h"

#include <numeric>

namespace
{

constexpr double radius = 0.5;

bool inBall(const Vec& x) { return dot(x, x) < radius * radius; }

double gas(const Vec&) { return 2.7e-4; }

/// Uniform gas around a ball: light is blocked where the ball is, and bent nowhere.
void expectBallInUniformGas(vtkSchlierenFilter* filter, double edge)
{
  filter->SetAmbientRefractivity(-1);
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  vtkDataArray* blocked = arrayOf(filter, "BlockedFraction");
  ASSERT_NE(blocked, nullptr);
  int inside = 0, outside = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const double r = std::hypot(x[0], x[1]);
    if (r < radius - edge)
    {
      EXPECT_EQ(blocked->GetComponent(i, 0), 1) << "r = " << r;
      ++inside;
    }
    else if (r > radius + edge)
    {
      EXPECT_EQ(blocked->GetComponent(i, 0), 0) << "r = " << r;
      ++outside;
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
  EXPECT_LT(largest(valuesOf(filter, "Deflection")), 1e-15);
  EXPECT_LT(largest(valuesOf(filter, "OpticalPathDifference")), 1e-15);
}

} // namespace

TEST(Solids, NanBlocksLightAndBendsNone)
{
  auto image = cube(41);
  addPointArray(image, "N", [](const Vec& x) { return inBall(x) ? std::nan("") : gas(x); });
  expectBallInUniformGas(bench(image, 40), 1.5 * 0.05);
}

TEST(Solids, InfinityBlocksLightAndBendsNone)
{
  auto image = cube(41);
  addPointArray(image, "N", [](const Vec& x) { return inBall(x) ? HUGE_VAL : gas(x); });
  expectBallInUniformGas(bench(image, 40), 1.5 * 0.05);
}

// Hidden points hold 0, as vtkResampleToImage leaves it there: a gradient that must not be seen.
TEST(Solids, BlankedPointsBlockLightAndBendNone)
{
  vtkNew<vtkUniformGrid> grid;
  grid->ShallowCopy(cube(41));
  addPointArray(grid, "N", [](const Vec& x) { return inBall(x) ? 0 : gas(x); });
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    Vec x;
    grid->GetPoint(i, x.data());
    if (inBall(x))
    {
      grid->BlankPoint(i);
    }
  }
  expectBallInUniformGas(bench(grid, 40), 1.5 * 0.05);
}

TEST(Solids, MaskedPointsBlockLightAndBendNone)
{
  auto image = cube(41);
  addPointArray(image, "N", [](const Vec& x) { return inBall(x) ? 0 : gas(x); });
  addPointArray(image, "vtkValidPointMask", [](const Vec& x) { return inBall(x) ? 0 : 1; });
  expectBallInUniformGas(bench(image, 40), 1.5 * 0.05);
}

namespace
{

template <class Grid>
void blankCellsInBall(Grid* grid)
{
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    grid->GetCellBounds(i, bounds);
    if (inBall({ (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2,
          (bounds[4] + bounds[5]) / 2 }))
    {
      grid->BlankCell(i);
    }
  }
}

} // namespace

TEST(Solids, BlankedCellsBlockLightAndBendNone)
{
  // Once with point values, where hidden points hold 0 ...
  vtkNew<vtkUniformGrid> points;
  points->ShallowCopy(cube(41));
  addPointArray(points, "N", [](const Vec& x) { return dot(x, x) < 0.16 ? 0 : gas(x); });
  blankCellsInBall(points.Get());
  expectBallInUniformGas(bench(points, 40), 2 * 0.05);

  // ... and once with cell values.
  vtkNew<vtkUniformGrid> cells;
  cells->ShallowCopy(cube(41));
  addCellArray(cells, "N", [](const Vec& x) { return inBall(x) ? 0 : gas(x); });
  blankCellsInBall(cells.Get());
  expectBallInUniformGas(bench(cells, 40), 2 * 0.05);
}

TEST(Solids, ASingleBlankedCellBlocksLight)
{
  vtkNew<vtkUniformGrid> grid;
  grid->ShallowCopy(cube(12, 1.1));
  addPointArray(grid, "N", gas);
  grid->BlankCell(5, 5, 5); // around the origin
  auto filter = bench(grid, 11);
  filter->Update();
  EXPECT_EQ(arrayOf(filter, "BlockedFraction")->GetComponent(5 * 11 + 5, 0), 1);
  EXPECT_EQ(arrayOf(filter, "BlockedFraction")->GetComponent(5 * 11 + 1, 0), 0);
}

TEST(Solids, AWallAcrossAllLightIsSaid)
{
  auto image = cube(12);
  addPointArray(
    image, "N", [](const Vec& x) { return std::abs(x[2]) < 0.2 ? std::nan("") : 1e-4; });
  auto filter = bench(image, 10);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_EQ(largest(valuesOf(filter, "Intensity")), 0);
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("All light"), std::string::npos);
  EXPECT_NE(complaints->Warnings[0].find("Outside set to Passes"), std::string::npos);
  EXPECT_NE(complaints->Warnings[0].find("Troubleshooting"), std::string::npos);
  EXPECT_TRUE(complaints->Errors.empty());

  filter->SetKnifeEdgeAngle(90); // the same light: once is enough
  filter->Update();
  EXPECT_EQ(complaints->Warnings.size(), 1u);
  filter->SetViewDirection(-0.1, 0, -1);
  filter->SetParallelScale(0.1);
  filter->Update();
  EXPECT_EQ(complaints->Warnings.size(), 2u);
}

TEST(Solids, LightThatDoesNotComeOutIsSaid)
{
  auto image = cube(16);
  addPointArray(
    image, "N", [](const Vec& x) { return 2 * std::exp(-(x[1] * x[1] + x[2] * x[2]) / 0.1); });
  auto filter = bench(image, 24);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_GT(fieldValue(filter, "RaysLost"), 0);
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("did not come out"), std::string::npos);
  filter->SetKScale(1);
  filter->SetKMode(vtkSchlierenFilter::K_VALUE);
  filter->Update();
  EXPECT_EQ(complaints->Warnings.size(), 1u);
}

// Blanked cells of a curvilinear grid, and a ball that an unstructured grid leaves out.
TEST(Solids, HiddenCellsOfAStructuredGridBlockLight)
{
  vtkNew<vtkImageDataToPointSet> convert;
  convert->SetInputData(cube(41));
  convert->Update();
  vtkNew<vtkStructuredGrid> grid;
  grid->ShallowCopy(convert->GetOutput());
  addPointArray(grid, "N", gas);
  blankCellsInBall(grid.Get());
  auto filter = bench(grid, 40);
  expectBallInUniformGas(filter, 2 * 0.05);
}

TEST(Solids, CellValuesThatAreNanBlockLight)
{
  auto image = cube(41);
  addCellArray(image, "N", [](const Vec& x) { return inBall(x) ? std::nan("") : gas(x); });
  vtkNew<vtkAppendFilter> append;
  append->SetInputData(image);
  append->Update();
  auto filter = bench(append->GetOutput(), 40);
  expectBallInUniformGas(filter, 2 * 0.05);
}

namespace
{

/// A mesh of the cells of a cube within r < 0.9, of which those with r < 0.5 are hidden.
vtkSmartPointer<vtkUnstructuredGrid> shell()
{
  auto image = cube(41);
  addPointArray(image, "N", gas);
  addCellArray(image, "r", [](const Vec& x) { return std::sqrt(dot(x, x)); });
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(image);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "r");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_LOWER);
  threshold->SetLowerThreshold(0.9);
  threshold->Update();
  vtkUnstructuredGrid* mesh = threshold->GetOutput();
  mesh->AllocateCellGhostArray();
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    const bool isHidden = mesh->GetCellData()->GetArray("r")->GetComponent(i, 0) < radius;
    mesh->GetCellGhostArray()->SetValue(i, isHidden ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  return mesh;
}

} // namespace

// Outside of all cells light passes if it may; in hidden cells and in cells with NaN it does not.
TEST(Solids, OutsideOfTheMeshMayLetLightPass)
{
  auto hidden = shell();
  vtkNew<vtkUnstructuredGrid> nan;
  nan->DeepCopy(hidden);
  nan->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  addPointArray(nan, "N", [](const Vec& x) { return inBall(x) ? std::nan("") : gas(x); });
  vtkNew<vtkUnstructuredGrid> nanCells;
  nanCells->DeepCopy(nan);
  addCellArray(nanCells, "N", [](const Vec& x) { return inBall(x) ? std::nan("") : gas(x); });
  nanCells->GetPointData()->RemoveArray("N");
  for (vtkUnstructuredGrid* mesh : { hidden.Get(), nan.Get(), nanCells.Get() })
  {
    auto filter = bench(mesh, 40);
    filter->SetOutside(vtkRefractiveIndex::OUTSIDE_PASSES);
    expectBallInUniformGas(filter, 2 * 0.05);
    filter->SetOutside(vtkRefractiveIndex::OUTSIDE_BLOCKS);
    filter->Update();
    EXPECT_EQ(arrayOf(filter, "BlockedFraction")->GetComponent(0, 0), 1);
  }
}

// Blocks of images that leave a corner of their box out; hidden cells block light all the same.
TEST(Solids, WhatBlocksLeaveOutMayLetLightPass)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const Vec& corner : { Vec{ -1, -1, -1 }, Vec{ 0, -1, -1 }, Vec{ -1, 0, -1 } })
  {
    vtkNew<vtkUniformGrid> block;
    block->SetDimensions(11, 11, 21);
    block->SetSpacing(0.1, 0.1, 0.1);
    block->SetOrigin(corner.data());
    addCellArray(block, "N", gas);
    blocks->SetBlock(blocks->GetNumberOfBlocks(), block);
  }
  vtkUniformGrid::SafeDownCast(blocks->GetBlock(0))->BlankCell(2, 2, 2);
  auto filter = bench(blocks, 20);
  filter->SetAmbientRefractivity(-1);
  for (const bool outsideBlocks : { true, false })
  {
    filter->SetOutside(
      outsideBlocks ? vtkRefractiveIndex::OUTSIDE_BLOCKS : vtkRefractiveIndex::OUTSIDE_PASSES);
    filter->Update();
    auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
    const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
    for (std::size_t i = 0; i < blocked.size(); ++i)
    {
      const double* x = image->GetPoint(static_cast<vtkIdType>(i));
      if (std::abs(x[0]) > 0.1 && std::abs(x[1]) > 0.1 && std::abs(x[0]) < 0.9 &&
        std::abs(x[1]) < 0.9)
      {
        const bool isHidden = std::hypot(x[0] + 0.75, x[1] + 0.75) < 0.04;
        const bool isSafe = isHidden || std::hypot(x[0] + 0.75, x[1] + 0.75) > 0.2;
        const bool isOutside = x[0] > 0 && x[1] > 0;
        if (isSafe)
        {
          EXPECT_EQ(blocked[i], isHidden || (isOutside && outsideBlocks) ? 1 : 0)
            << x[0] << " " << x[1];
        }
      }
    }
    EXPECT_EQ(largest(valuesOf(filter, "Deflection")), 0);
    EXPECT_EQ(largest(blocked), 1);
  }
}

namespace
{

/// A bench of data with nonsense in the ball, and `mask`, 1 there, or (`isOfGas`) everywhere else.
vtkSmartPointer<vtkSchlierenFilter> maskedBench(
  vtkDataSet* data, bool valuesOfCells, bool maskOfCells, bool isOfGas)
{
  const auto values = [](const Vec& x) { return inBall(x) ? 7 * x[0] : gas(x); };
  const auto mask = [isOfGas](const Vec& x) { return inBall(x) != isOfGas ? 1. : 0.; };
  const auto add = [&](bool ofCells, const char* name, const ScalarField& field)
  {
    if (ofCells)
    {
      addCellArray(data, name, field);
    }
    else
    {
      addPointArray(data, name, field);
    }
  };
  add(valuesOfCells, "N", values);
  const char* name = isOfGas ? "iblank" : "mask";
  add(maskOfCells, name, mask);
  auto filter = bench(data, 40);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
  return filter;
}

} // namespace

TEST(Solids, MasksBlockLightAndBendNone)
{
  for (const bool isOfGas : { false, true })
  {
    for (const bool valuesOfCells : { false, true })
    {
      for (const bool maskOfCells : { false, true })
      {
        if (maskOfCells && !valuesOfCells)
        {
          continue; // cells that the ball cuts are not masked, and have points with nonsense
        }
        constexpr int points = 31;
        constexpr double spacing = 2. / (points - 1);
        auto image = cube(points);
        expectBallInUniformGas(
          maskedBench(image, valuesOfCells, maskOfCells, isOfGas), 2 * spacing);
        vtkNew<vtkImageDataToPointSet> toMesh;
        toMesh->SetInputData(cube(points));
        toMesh->Update();
        expectBallInUniformGas(
          maskedBench(toMesh->GetOutput(), valuesOfCells, maskOfCells, isOfGas), 2 * spacing);
      }
    }
  }
}

TEST(Solids, MasksOfBlocksThatHaveNoneAreEmpty)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 2; ++i)
  {
    auto image = cube(21);
    image->SetOrigin(i == 0 ? -1 : 1, -1, -1);
    addCellArray(image, "N", gas);
    if (i == 0)
    {
      addCellArray(image, "mask", [](const Vec& x) { return inBall(x) ? 1. : 0.; });
    }
    blocks->SetBlock(i, image);
  }
  auto filter = bench(blocks, 40);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "mask");
  filter->SetAmbientRefractivity(-1);
  filter->Update();
  const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
  const double* pixel = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0))->GetSpacing();
  EXPECT_NEAR(std::accumulate(blocked.begin(), blocked.end(), 0.) * pixel[0] * pixel[1],
    pi * radius * radius, 0.1);
}

TEST(Solids, BadMasksAreMistakes)
{
  auto image = cube(11);
  auto filter = maskedBench(image, false, false, false);
  const auto mistakeOf = [&]
  {
    auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
    filter->Update();
    EXPECT_EQ(complaints->Errors.size(), 1u);
    EXPECT_TRUE(isEmpty(filter));
    filter->RemoveObserver(complaints);
    filter->GetExecutive()->RemoveObserver(complaints);
    return complaints->Errors.empty() ? std::string() : complaints->Errors[0];
  };
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "iblank");
  EXPECT_NE(mistakeOf().find("no array 'iblank'. Set Mask to one of"), std::string::npos);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  addPointArray(image, "all", [](const Vec&) { return 0.5; });
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "all");
  EXPECT_NE(mistakeOf().find("no valid value"), std::string::npos); // all is hidden
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  filter->Update();
  EXPECT_FALSE(isEmpty(filter));
}
