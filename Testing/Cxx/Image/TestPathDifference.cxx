// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// PathModel DIFFERENCE: the image by refracted rays less the one by straight rays.
#include "CutMesh.h"
#include "Fixtures.h"

#include "vtkStringArray.h"

namespace
{

using Filter = vtkSchlierenFilter;

/// Light through its middle is displaced by some pixels.
vtkSmartPointer<vtkImageData> denseColumn(double refractivity = 0.02)
{
  auto image = cube(32);
  addPointArray(image, "N", GaussianColumn{ refractivity });
  addPointArray(image, "f", [](const Vec& x) { return x[0] + x[1] * x[1]; });
  return image;
}

vtkSmartPointer<Filter> benchFor(vtkDataObject* input, int pathModel)
{
  auto filter = bench(input, 48);
  filter->SetPathModel(pathModel);
  return filter;
}

/// Compares an array with scale (that by refracted less that by straight rays) + middle.
void expectDifference(Filter* difference, Filter* refracted, Filter* straight, const char* name,
  double middle = 0, double scale = 1)
{
  SCOPED_TRACE(name);
  const std::vector<double> values = valuesOf(difference, name);
  const std::vector<double> one = valuesOf(refracted, name), other = valuesOf(straight, name);
  ASSERT_FALSE(values.empty());
  ASSERT_EQ(values.size(), one.size());
  ASSERT_EQ(values.size(), other.size());
  double largestOfAll = 0, worst = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    largestOfAll = std::max({ largestOfAll, std::abs(one[i]), std::abs(other[i]) });
    worst = std::max(worst, std::abs(values[i] - middle - scale * (one[i] - other[i])));
  }
  EXPECT_LT(worst, 1e-6 * std::max(1., largestOfAll));
}

} // namespace

TEST(PathDifference, IsThatOfTwoImages)
{
  const auto image = denseColumn();
  auto difference = benchFor(image, Filter::DIFFERENCE);
  auto refracted = benchFor(image, Filter::REFRACTED);
  auto straight = benchFor(image, Filter::STRAIGHT);
  straight->AutoKScaleOff();
  for (int cutoff = Filter::KNIFE_EDGE; cutoff <= Filter::BACKGROUND_ORIENTED; ++cutoff)
  {
    SCOPED_TRACE(cutoff);
    for (Filter* filter : { difference.Get(), refracted.Get(), straight.Get() })
    {
      filter->SetCutoff(cutoff);
    }
    refracted->Update();
    straight->SetKScale(Filter::CutoffHasK(cutoff) ? fieldValue(refracted, "KScale") : 1);
    straight->Update();
    difference->Update();
    const double middle = Filter::CutoffHasScreen(cutoff) ? 1 : 0.5;
    EXPECT_EQ(fieldValue(difference, "KScale"), fieldValue(refracted, "KScale"));
    EXPECT_EQ(fieldValue(difference, "UndisturbedLevel"), middle);
    expectDifference(difference, refracted, straight, "Intensity", middle, 0.5);
    for (const char* name :
      { "Deflection", "OpticalPathDifference", "Displacement", "BlockedFraction" })
    {
      expectDifference(difference, refracted, straight, name);
    }
    const std::vector<double> light = valuesOf(difference, "Intensity");
    const auto [darkest, brightest] = std::minmax_element(light.begin(), light.end());
    EXPECT_GT(*brightest - *darkest, 0.005); // there is something to see
  }
  expectDifference(difference, refracted, straight, "BackgroundDisplacement");
  auto* name = vtkStringArray::SafeDownCast(
    difference->GetOutput()->GetFieldData()->GetAbstractArray("PathModel"));
  ASSERT_NE(name, nullptr);
  EXPECT_EQ(name->GetValue(0), "Difference");
  EXPECT_NE(std::string(difference->GetStatus()).find("refracted rays less straight ones"),
    std::string::npos);
}

// What refraction changes is of second order in the refractivity.
TEST(PathDifference, QuartersWithHalfOfTheRefractivity)
{
  const auto largestOf = [](double refractivity)
  {
    auto filter = benchFor(denseColumn(refractivity), Filter::DIFFERENCE);
    filter->SetPrecision(Filter::DOUBLE);
    filter->Update();
    return largest(valuesOf(filter, "Deflection"));
  };
  const double ofTwo = largestOf(2e-3), ofOne = largestOf(1e-3);
  EXPECT_GT(ofOne, 1e-6);
  EXPECT_NEAR(ofTwo / ofOne, 4, 0.05);
}

TEST(PathDifference, TracesBothOnceForAllCutoffs)
{
  auto filter = benchFor(denseColumn(), Filter::DIFFERENCE);
  filter->Update();
  EXPECT_EQ(filter->GetMediumBuilds(), 1);
  const vtkTypeInt64 rays = filter->GetTotalRaysTraced();
  EXPECT_GE(rays, 2 * 48 * 48 * 9 / 10);
  filter->SetKnifeEdgeAngle(90);
  filter->Update();
  filter->SetCutoff(Filter::CIRCULAR);
  filter->Update();
  EXPECT_EQ(filter->GetTotalRaysTraced(), rays);
  filter->SetPathModel(Filter::REFRACTED); // its rays are there
  filter->Update();
  EXPECT_EQ(filter->GetTotalRaysTraced(), rays);
  EXPECT_EQ(filter->GetMediumBuilds(), 1);
}

TEST(PathDifference, OfAMeshHasOneMedium)
{
  const auto mesh = cutMesh(12);
  addPointArray(mesh, "N", GaussianColumn{ 0.02 });
  auto difference = benchFor(mesh, Filter::DIFFERENCE);
  difference->Update();
  EXPECT_EQ(difference->GetMediumBuilds(), 1);
  auto refracted = benchFor(mesh, Filter::REFRACTED);
  refracted->Update();
  auto straight = benchFor(mesh, Filter::STRAIGHT);
  straight->AutoKScaleOff();
  straight->SetKScale(fieldValue(refracted, "KScale"));
  straight->Update();
  expectDifference(difference, refracted, straight, "Intensity", 0.5, 0.5);
  expectDifference(difference, refracted, straight, "Deflection");
}
