// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sound of 1 Pa in air, on grids: it changes the refractivity by three millionths, of which single precision would keep
// one digit.
#include "BallOnLevels.h"
#include "Surfaces.h"

#include "vtkAppendFilter.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <functional>

namespace
{

constexpr double gladstoneDale = 2.26e-4, atRest = 1.2041, speedOfSound = 343;
constexpr double waveNumber = 2 * pi * 40e3 / speedOfSound;
constexpr double length = 0.04, depth = 0.1;

/// Along x.
double sound(const Vec& x)
{
  return gladstoneDale * (atRest + std::sin(waveNumber * x[0]) / (speedOfSound * speedOfSound));
}

const double amplitude =
  gladstoneDale / (speedOfSound * speedOfSound) * waveNumber * depth / (1 + gladstoneDale * atRest);

vtkSmartPointer<vtkImageData> grid(int points = 321, int layers = 5)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(points, 5, layers);
  image->SetSpacing(length / (points - 1), 0.02 / 4, depth / std::max(layers - 1, 1));
  return image;
}

vtkSmartPointer<vtkImageData> soundOnPoints(const ScalarField& refractivity = sound)
{
  auto image = grid();
  addPointArray(image, "N", refractivity);
  return image;
}

vtkSmartPointer<vtkSchlierenFilter> benchOfSound(vtkDataObject* data)
{
  auto filter = bench(data, 8);
  filter->SetAmbientRefractivity(-1);
  filter->SetImageSize(320, 16);
  filter->SetParallelScale(0.001);
  filter->SetFocalPoint(length / 2, 0.01, depth / 2);
  return filter;
}

/// The largest error of the deflection away from the ends, of the amplitude.
double errorOf(vtkSchlierenFilter* filter, double allDepth = depth)
{
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const std::vector<double> made = valuesOf(filter, "Deflection");
  double worst = 0;
  for (vtkIdType pixel = 0; pixel < image->GetNumberOfPoints(); ++pixel)
  {
    const double x = image->GetPoint(pixel)[0];
    if (x > 0.12 * length && x < 0.88 * length)
    {
      const double right = amplitude * allDepth / depth * std::cos(waveNumber * x);
      worst = std::max(worst, std::abs(made[static_cast<std::size_t>(2 * pixel)] - right));
      worst = std::max(worst, std::abs(made[static_cast<std::size_t>(2 * pixel + 1)]));
    }
  }
  EXPECT_EQ(largest(valuesOf(filter, "BlockedFraction")), 0);
  return worst / (amplitude * allDepth / depth);
}

TEST(WeakSignals, AreRightOnGrids)
{
  EXPECT_LT(errorOf(benchOfSound(soundOnPoints())), 1e-3);

  auto ofCells = grid();
  addCellArray(ofCells, "N", sound);
  auto filter = benchOfSound(ofCells);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  EXPECT_LT(errorOf(filter, 0.75 * depth), 1e-3); // between the middles of the outermost cells

  auto plane = grid(321, 1);
  addPointArray(plane, "N", sound);
  filter = benchOfSound(plane);
  filter->SetDepth(1);
  EXPECT_LT(errorOf(filter, 1), 1e-3);
}

TEST(WeakSignals, AreRightWhereTheSurroundingsAreGiven)
{
  auto filter = benchOfSound(soundOnPoints());
  filter->SetAmbientRefractivity(gladstoneDale * atRest);
  EXPECT_LT(errorOf(filter), 1e-3);
}

TEST(WeakSignals, AreRightBesideAStrongFlow)
{
  // Hot gas at one end.
  EXPECT_LT(errorOf(benchOfSound(soundOnPoints([](const Vec& x)
              { return sound(x) - 1e-4 * (1 + std::tanh((x[0] / length - 0.96) / 0.005)); }))),
    1e-3);
}

TEST(WeakSignals, AreRightOfARefractivityThatWasMadeBefore)
{
  vtkNew<vtkRefractiveIndex> before;
  before->SetInputData(soundOnPoints());
  before->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  before->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  before->Update();
  auto filter = benchOfSound(before->GetOutputDataObject(0));
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Refractivity");
  EXPECT_LT(errorOf(filter), 1e-3);
  EXPECT_NEAR(arrayOf(before, "Refractivity")->GetComponent(0, 0), gladstoneDale * atRest, 1e-11);
}

TEST(WeakSignals, AreRightWithBodiesAndOfMeshes)
{
  auto filter = benchOfSound(soundOnPoints());
  filter->SetInputDataObject(
    1, box({ 0.002, 0.002, 0.01 }, { length / 2, 0.018, depth / 2 })); // out of sight
  filter->SetMediumTolerance(1e-4);
  EXPECT_LT(errorOf(filter), 2e-3);

  vtkNew<vtkAppendFilter> append;
  append->AddInputData(soundOnPoints());
  append->Update();
  filter = benchOfSound(append->GetOutput());
  filter->SetMediumTolerance(1e-4);
  EXPECT_LT(errorOf(filter), 1e-2); // of the cells' gradients, with four cells across
}

TEST(WeakSignals, AreRightOnLevels)
{
  vtkNew<vtkOverlappingAMR> amr;
  initialize(amr, { 2 });
  const double origin[3] = { 0, 0, 0 };
  amr->SetOrigin(origin);
  amr->SetGridDescription(xyzGrid);
  constexpr int cells[3] = { 160, 4, 4 };
  const double spacing[3] = { length / 320, 0.005, depth / 4 };
  amr->SetSpacing(0, spacing);
  for (unsigned int number = 0; number < 2; ++number)
  {
    vtkNew<vtkUniformGrid> block;
    block->SetDimensions(cells[0] + 1, cells[1] + 1, cells[2] + 1);
    block->SetSpacing(spacing);
    block->SetOrigin(number * length / 2, 0, 0);
    addCellArray(block, "N", sound);
    amr->SetAMRBox(
      0, number, vtkAMRBox(block->GetOrigin(), block->GetDimensions(), spacing, origin));
    amr->SetDataSet(0, number, block);
  }
  auto filter = benchOfSound(amr);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  filter->SetMediumTolerance(1e-4);
  EXPECT_LT(errorOf(filter), 2e-3);
}

} // namespace
