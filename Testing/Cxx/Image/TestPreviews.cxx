// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of fewer pixels, for while a view is turned: the same place, seen roughly.
#include "Fixtures.h"
#include "Image/Preview.h"
#include "Image/RgbImages.h"
#include "Image/SceneFromSettings.h"
#include "Settings/QualityPresets.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace filters;

namespace
{

/// Borders of the pixels, not their centres: left, right, low, high.
std::array<double, 4> bordersOf(vtkImageData* image)
{
  const double* origin = image->GetOrigin();
  const double* spacing = image->GetSpacing();
  const int* size = image->GetDimensions();
  return { origin[0] - 0.5 * spacing[0], origin[0] + (size[0] - 0.5) * spacing[0],
    origin[1] - 0.5 * spacing[1], origin[1] + (size[1] - 0.5) * spacing[1] };
}

/// Means over squares of `edge` pixels, of the components that valuesOf() has.
std::vector<double> boxAverages(vtkAlgorithm* filter, const char* name, int edge)
{
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  const int* size = image->GetDimensions();
  std::vector<double> means;
  for (int row = 0; row < size[1]; row += edge)
  {
    for (int column = 0; column < size[0]; column += edge)
    {
      for (int component = 0; component < std::min(2, array->GetNumberOfComponents()); ++component)
      {
        double sum = 0;
        for (int pixel = 0; pixel < edge * edge; ++pixel)
        {
          const vtkIdType at = (row + pixel / edge) * size[0] + column + pixel % edge;
          sum += array->GetComponent(at, component);
        }
        means.push_back(sum / (edge * edge));
      }
    }
  }
  return means;
}

} // namespace

// Of a smooth flow, whose image changes little within four pixels.
TEST(Preview, IsTheWholeOneAveragedOverBoxes)
{
  for (const int cutoff : { vtkSchlierenFilter::KNIFE_EDGE, vtkSchlierenFilter::SHADOWGRAPH })
  {
    auto filter = bench(columnImage(48), 160);
    filter->SetViewDirection(0.3, 0.2, -1);
    filter->SetFocalPoint(0.2, -0.1, 0.3);
    filter->SetKMode(vtkSchlierenFilter::K_VALUE);
    filter->SetKScale(300);
    filter->SetCutoff(cutoff);
    filter->SetScreenDistance(100);
    filter->Update();
    const auto borders = bordersOf(filter->GetOutput());
    const std::vector<double> deflection = boxAverages(filter, "Deflection", 4);
    const std::vector<double> intensity = boxAverages(filter, "Intensity", 4);

    filter->SetPreviewReduction(4);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 40 * 40);
    for (std::size_t side = 0; side < borders.size(); ++side)
    {
      EXPECT_NEAR(bordersOf(filter->GetOutput())[side], borders[side], 1e-12);
    }
    EXPECT_LT(relativeDifference(valuesOf(filter, "Deflection"), deflection), 0.03);
    EXPECT_LT(relativeDifference(valuesOf(filter, "Intensity"), intensity), 0.03);
  }
}

TEST(Preview, LiesWhereTheInformationSays)
{
  const int sizes[][3] = { { 160, 120, 4 }, { 101, 37, 3 }, { 16, 16, 64 }, { 200, 3, 32 } };
  for (const auto& [width, height, reduction] : sizes)
  {
    SCOPED_TRACE(reduction);
    auto filter = bench(columnImage(48));
    filter->SetImageSize(width, height);
    filter->Update();
    const auto whole = bordersOf(filter->GetOutput());
    filter->SetPreviewReduction(reduction);
    filter->UpdateInformation();
    vtkInformation* info = filter->GetOutputInformation(0);
    filter->Update();
    vtkImageData* image = filter->GetOutput();
    EXPECT_TRUE(std::equal(image->GetExtent(), image->GetExtent() + 6,
      info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())));
    EXPECT_TRUE(
      std::equal(image->GetOrigin(), image->GetOrigin() + 2, info->Get(vtkDataObject::ORIGIN())));
    EXPECT_TRUE(std::equal(
      image->GetSpacing(), image->GetSpacing() + 2, info->Get(vtkDataObject::SPACING())));
    const auto preview = bordersOf(image);
    for (std::size_t side = 0; side < whole.size(); side += 2)
    {
      EXPECT_LE(preview[side], whole[side] + 1e-12);                  // all of it,
      EXPECT_GE(preview[side], whole[side] - image->GetSpacing()[0]); // and hardly more
      EXPECT_GE(preview[side + 1], whole[side + 1] - 1e-12);
      EXPECT_LE(preview[side + 1], whole[side + 1] + image->GetSpacing()[0]);
    }
  }
}

TEST(Preview, HasOneRayPerPixelAndTheRestAsSet)
{
  vtkNew<vtkSchlierenFilter> filter;
  schlieren::Grid grid;
  grid.dimensions = { 41, 41, 21 };
  RgbImageReader images;
  filter->SetQuality(vtkSchlierenFilter::PUBLICATION);
  filter->SetCutoff(vtkSchlierenFilter::INTERFEROGRAM);
  filter->SetFringeSpacing(-10);
  filter->SetSmoothingRadius(2);
  const schlieren::Scene whole = sceneFrom(filter->GetSettings(), grid, images);
  filter->SetPreviewReduction(4);
  const schlieren::Scene preview = sceneFrom(filter->GetSettings(), grid, images);
  EXPECT_EQ(preview.view.width, 128);
  EXPECT_EQ(preview.samplesPerPixel, 1);
  EXPECT_EQ(preview.stepSize, interactiveStepSize());
  EXPECT_GT(interactiveStepSize(), whole.stepSize);
  EXPECT_EQ(preview.fringes.spacing, whole.fringes.spacing); // data units
  EXPECT_EQ(whole.smoothingRadius, 2);
  EXPECT_EQ(preview.smoothingRadius, 0.5);
  EXPECT_EQ(preview.histogramSize, whole.histogramSize);
  EXPECT_EQ(preview.interpolation, whole.interpolation);
  filter->SetStepSize(3);
  EXPECT_EQ(sceneFrom(filter->GetSettings(), grid, images).stepSize, 3);
}

TEST(Preview, ShowsTheSameBackground)
{
  vtkNew<vtkSchlierenFilter> filter;
  schlieren::Grid grid;
  grid.dimensions = { 41, 41, 21 };
  RgbImageReader images;
  const double pixel =
    schlieren::frameOf(grid, sceneFrom(filter->GetSettings(), grid, images).view).pixelSize;
  filter->SetCutoff(vtkSchlierenFilter::BACKGROUND_ORIENTED);
  const auto period = [&](int reduction)
  {
    filter->SetPreviewReduction(reduction);
    const schlieren::Scene scene = sceneFrom(filter->GetSettings(), grid, images);
    return scene.background.pixelsPerPeriod * schlieren::frameOf(grid, scene.view).pixelSize;
  };
  EXPECT_DOUBLE_EQ(period(2), 8 * pixel);
  EXPECT_DOUBLE_EQ(period(4), 16 * pixel); // finer than four of its pixels would be grey
  filter->SetBackgroundPeriod(0.1);
  EXPECT_EQ(sceneFrom(filter->GetSettings(), grid, images).background.period, 0.1);
}

TEST(Preview, HidesNoMistake)
{
  expectOneMessage(
    bench(columnImage(48)).Get(),
    [](vtkSchlierenFilter* filter)
    {
      filter->SetPreviewReduction(4);
      filter->SetImageSize(-1, 40);
    },
    { "ImageSize" }, [](vtkSchlierenFilter* filter) { filter->SetImageSize(40, 40); });
}
