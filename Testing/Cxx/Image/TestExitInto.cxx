// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What light enters where it leaves the data: a tank of water, n = 1.333 + slope y, seen along z.
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkUnstructuredGrid.h"

namespace
{

constexpr double depth = 2;
constexpr double slope = 2e-3;
constexpr double inAir = slope * depth / 1.0002718;

vtkSmartPointer<vtkImageData> tank()
{
  auto image = cube(21);
  addPointArray(image, "N", [](const Vec& x) { return 0.333 + slope * x[1]; });
  return image;
}

vtkSmartPointer<vtkSchlierenFilter> tankOnBench(vtkDataObject* data)
{
  auto filter = bench(data, 9);
  filter->SetAutoAmbientRefractivity(true);
  filter->SetLockAmbient(false);
  return filter;
}

/// Along v in the middle.
double middleOf(vtkSchlierenFilter* filter, const char* name)
{
  filter->Update();
  return arrayOf(filter, name)->GetComponent(4 * 9 + 4, 1);
}

std::size_t count(const std::vector<std::string>& texts, const char* word)
{
  return static_cast<std::size_t>(std::count_if(texts.begin(), texts.end(),
    [word](const std::string& text) { return text.find(word) != std::string::npos; }));
}

} // namespace

TEST(ExitInto, IsAirOfALiquidAndSaysSoOnce)
{
  auto filter = tankOnBench(tank());
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  EXPECT_NEAR(middleOf(filter, "Deflection"), inAir, 1e-3 * inAir);
  EXPECT_EQ(fieldValue(filter, "ExitRefractivity"), 2.718e-4);
  EXPECT_EQ(count(complaints->Warnings, "ExitInto"), 1u);
  filter->SetViewAngle(5);
  EXPECT_NEAR(middleOf(filter, "Deflection"), inAir, 1e-3 * inAir);
  EXPECT_EQ(count(complaints->Warnings, "ExitInto"), 1u);
  filter->SetExitInto(vtkSchlierenFilter::EXIT_AIR);
  EXPECT_NEAR(middleOf(filter, "Deflection"), inAir, 1e-3 * inAir);
  filter->SetExitInto(vtkSchlierenFilter::EXIT_SURROUNDINGS);
  EXPECT_NEAR(middleOf(filter, "Deflection"), inAir / 1.333, 1e-3 * inAir);
  EXPECT_NEAR(fieldValue(filter, "ExitRefractivity"), 0.333, 1e-3);
  filter->SetExitInto(vtkSchlierenFilter::EXIT_CUSTOM);
  filter->SetExitRefractivity(0.5);
  EXPECT_NEAR(middleOf(filter, "Deflection"), inAir / 1.5, 1e-3 * inAir);
  EXPECT_EQ(fieldValue(filter, "ExitRefractivity"), 0.5);
  EXPECT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_TRUE(complaints->Errors.empty());
}

TEST(ExitInto, IsWhatTheSurroundingsAreSaidToBe)
{
  auto filter = tankOnBench(tank());
  filter->SetAutoAmbientRefractivity(false);
  filter->SetAmbientRefractivity(2.7e-4);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  EXPECT_NEAR(middleOf(filter, "Deflection"), inAir, 1e-3 * inAir);
  EXPECT_TRUE(complaints->Warnings.empty());
}

TEST(ExitInto, IsAirOfAMeshOfALiquid)
{
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(tank());
  append->Update();
  for (const bool isAutomatic : { true, false })
  {
    auto filter = tankOnBench(append->GetOutput());
    filter->SetAutoAmbientRefractivity(isAutomatic);
    filter->SetAmbientRefractivity(2.7e-4);
    EXPECT_NEAR(middleOf(filter, "Deflection"), inAir, 2e-3 * inAir) << isAutomatic;
  }
}

TEST(ExitInto, PutsPatternsIntoAir)
{
  auto filter = tankOnBench(tank());
  filter->SetCutoff(vtkSchlierenFilter::BACKGROUND_ORIENTED);
  filter->SetBackgroundDistance(10);
  const double expected = slope * depth * (depth / 2 / 1.333 + 10);
  EXPECT_NEAR(middleOf(filter, "BackgroundDisplacement"), expected, 1e-3 * expected);
}

TEST(ExitInto, RefusesWhatNoMediumHas)
{
  auto filter = tankOnBench(tank());
  expectOneMessage(
    filter.Get(),
    [](vtkSchlierenFilter* of)
    {
      of->SetExitInto(vtkSchlierenFilter::EXIT_CUSTOM);
      of->SetExitRefractivity(-1);
    },
    { "ExitRefractivity", "-1" },
    [](vtkSchlierenFilter* of) { of->SetExitInto(vtkSchlierenFilter::EXIT_AIR); });
}

/// What steps cannot resolve is said, with the place.
TEST(Jumps, AreNamedWhereRaysDoNotResolveThem)
{
  auto image = cube(41);
  addPointArray(image, "N", [](const Vec& x) { return x[2] > 0.2 && x[2] < 0.4 ? 0.5 : 3e-4; });
  auto filter = bench(image, 9);
  filter->SetPathModel(vtkSchlierenFilter::REFRACTED);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_LT(fieldValue(filter, "MomentumDrift"), 1e-3);
  EXPECT_TRUE(complaints->Warnings.empty());
  EXPECT_NE(std::string(filter->GetStatus()).find("short steps"), std::string::npos);
}

TEST(Jumps, LongStepsThroughAStrongMediumAreSaid)
{
  auto image = cube(41);
  addPointArray(image, "N",
    [](const Vec& x) { return 0.3 * std::exp(-4 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2])); });
  auto filter = bench(image, 9);
  filter->SetStepSize(16);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_GT(fieldValue(filter, "MomentumDrift"), 0.01);
  ASSERT_EQ(count(complaints->Warnings, "MomentumDrift"), 1u);
  EXPECT_NE(complaints->Warnings[0].find("StepSize"), std::string::npos);
  EXPECT_NE(complaints->Warnings[0].find("Threshold"), std::string::npos);
}
