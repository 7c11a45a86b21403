// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What filters take where the user has left arrays, units and the index model open, and what they say of implausible values.
#include "Fixtures.h"

#include "vtkDoubleArray.h"
#include "vtkGasTable.h"
#include "vtkHyperTreeGrid.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <numeric>
#include <tuple>

namespace
{

using Filter = vtkSchlierenFilter;
using Medium = vtkRefractiveIndex;

/// Between `low` and `high`.
ScalarField bump(double low, double high)
{
  return [low, high](const Vec& x) { return low + (high - low) * std::exp(-dot(x, x) / 0.2); };
}

/// A filter of which nothing but the input is set.
vtkSmartPointer<Filter> filterOf(vtkDataObject* input)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputDataObject(input);
  filter->SetImageSize(24, 24);
  return filter;
}

void choose(Filter* filter, int index, const char* name,
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS)
{
  filter->SetInputArrayToProcess(index, 0, 0, association, name);
}

/// What is said in one update.
std::vector<std::string> warningsOf(Filter* filter)
{
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty()) << complaints->Errors[0];
  return complaints->Warnings;
}

void expectSameImage(Filter* left, Filter* given)
{
  EXPECT_EQ(warningsOf(left), std::vector<std::string>());
  given->Update();
  const auto of = valuesOf(given, "OpticalPathDifference");
  EXPECT_GT(largest(of), 0);
  EXPECT_EQ(valuesOf(left, "OpticalPathDifference"), of);
}

/// One array of each kind that is no density before the one that is.
vtkSmartPointer<vtkImageData> flowWithRho()
{
  auto flow = cube(17);
  addPointArray(flow, "Material Id", bump(1, 3));
  addPointArray(flow, "grad_T", bump(0, 1e3));
  addPointArray(flow, "alpha1", bump(0, 1));
  addPointArray(flow, "T", bump(280, 300));
  addPointArray(flow, "rho", bump(1, 1.3));
  flow->GetPointData()->SetActiveScalars("grad_T");
  return flow;
}

} // namespace

TEST(ArrayChoice, TheDensityAmongOthers)
{
  auto flow = flowWithRho();
  auto given = filterOf(flow);
  choose(given, Medium::DENSITY, "rho");
  auto left = filterOf(flow);
  expectSameImage(left, given);
  EXPECT_STREQ(left->GetArraysUsed(), "Density: 'rho'.");

  // In cells, while points have others.
  auto cells = cube(17);
  addPointArray(cells, "node_value", bump(0, 3));
  addCellArray(cells, "density", bump(1, 1.3));
  auto ofCells = filterOf(cells);
  choose(ofCells, Medium::DENSITY, "density", vtkDataObject::FIELD_ASSOCIATION_CELLS);
  expectSameImage(filterOf(cells), ofCells);
}

TEST(ArrayChoice, WhatIsChosenWins)
{
  auto flow = flowWithRho();
  addPointArray(flow, "p", bump(9e4, 1e5));
  addPointArray(flow, "D", bump(1, 1.2));
  auto filter = filterOf(flow);
  choose(filter, Medium::DENSITY, "D");
  EXPECT_EQ(warningsOf(filter), std::vector<std::string>());
  EXPECT_STREQ(filter->GetArraysUsed(), "Density: 'D'.");
  choose(filter, Medium::DENSITY, "rho");
  filter->SetIndexModel(Medium::CIDDOR);
  filter->Update();
  EXPECT_STREQ(filter->GetArraysUsed(), "Temperature: 'T'; Pressure: 'p'.");
  choose(filter, Medium::TEMPERATURE, "D");
  EXPECT_STREQ(filter->GetArraysUsed(), "Temperature: 'D'; Pressure: 'p'.");
}

// A ball that either kind of name marks blocks light, as much as if the mask were chosen; None blocks none.
TEST(ArrayChoice, MasksByTheirNames)
{
  constexpr double radius = 0.5;
  for (const char* name : { "solid", "iblank" })
  {
    SCOPED_TRACE(name);
    const bool isOfGas = std::string(name) == "iblank";
    auto flow = cube(65);
    addPointArray(flow, "rho", bump(1, 1.3));
    addPointArray(
      flow, name, [=](const Vec& x) { return (dot(x, x) < radius * radius) != isOfGas ? 1. : 0.; });
    auto given = filterOf(flow);
    choose(given, Medium::MASK, name);
    auto left = filterOf(flow);
    expectSameImage(left, given);
    const std::vector<double> blocked = valuesOf(left, "BlockedFraction");
    EXPECT_EQ(blocked, valuesOf(given, "BlockedFraction"));
    const double* pixel = vtkImageData::SafeDownCast(left->GetOutputDataObject(0))->GetSpacing();
    EXPECT_NEAR(std::accumulate(blocked.begin(), blocked.end(), 0.) * pixel[0] * pixel[1],
      pi * radius * radius, 0.05);
    EXPECT_EQ(left->GetArraysUsed(), "Density: 'rho'; Mask: '" + std::string(name) + "'.");
    choose(left, Medium::MASK, "None");
    left->Update();
    EXPECT_EQ(largest(valuesOf(left, "BlockedFraction")), 0);
  }
}

TEST(ArrayChoice, WhereNothingIsKnownOneMessageSaysWhatThereIs)
{
  auto flow = cube(9);
  addPointArray(flow, "ids", bump(1, 1249));
  addCellArray(flow, "Y(O2)", bump(0.1, 0.23));
  expectOneMessage(
    filterOf(flow).Get(), [](Filter*) {},
    { "No array is chosen for Density, and none is known by its name", "ids (",
      "cell arrays Y(O2) (" },
    [](Filter* filter) { choose(filter, Medium::DENSITY, "ids"); });
}

TEST(ArrayChoice, WhatAModelNeedsAndNobodyKnowsIsAMistake)
{
  auto flow = cube(9);
  addPointArray(flow, "rho", bump(1, 1.2));
  addPointArray(flow, "p", bump(9e4, 1e5));
  const auto correct = [](Filter* filter) { filter->SetIndexModel(Medium::AUTO); };
  expectOneMessage(
    filterOf(flow).Get(), [](Filter* filter) { filter->SetIndexModel(Medium::CIDDOR); },
    { "No array is chosen for Temperature", "p (" }, correct);
  expectOneMessage(
    filterOf(flow).Get(),
    [](Filter* filter) { filter->SetIndexModel(Medium::GLADSTONE_DALE_MIXTURE); },
    { "MixtureArrays is empty", "Gladstone-Dale" }, correct);
}

TEST(ArrayChoice, TablesParticlesAndHyperTrees)
{
  auto points = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> places;
  for (int i = 0; i < 4; ++i)
  {
    places->InsertNextPoint(i, i % 2, i / 2);
  }
  points->SetPoints(places);
  addPointArray(points, "rho", bump(1, 2));
  auto flow = flowWithRho();
  const auto correct = [&](Filter* filter) { filter->SetInputDataObject(flow); };
  const std::pair<vtkSmartPointer<vtkDataObject>, std::vector<std::string>> inputs[] = {
    { vtkSmartPointer<vtkTable>::New(),
      { "table", "Table To Structured Grid", "Table To Points" } },
    { vtkSmartPointer<vtkHyperTreeGrid>::New(), { "Hyper Tree Grid To Unstructured Grid" } },
    { points, { "nothing but points", "Point Volume Interpolator", "SPH Volume Interpolator" } },
  };
  for (const auto& [input, words] : inputs)
  {
    const auto make = [data = input](Filter* filter) { filter->SetInputDataObject(data); };
    expectOneMessage(filterOf(flow).Get(), make, words, correct);
  }
}

TEST(ArrayChoice, ImplausibleValuesAreSaidOnce)
{
  const std::tuple<const char*, double, double, const char*> cases[] = { { "rho", 1, 1,
                                                                           "is 1 everywhere" },
    { "rho", 0, 0, "is 0 everywhere" }, { "rho", -0.7, 0.3, "negative" },
    { "Density", 20, 620, "more than that of gases" }, { "density", 2e-4, 1.2e-3, "g/cm" } };
  for (const auto& [name, low, high, words] : cases)
  {
    auto flow = cube(9);
    addPointArray(flow, name, bump(low, high));
    auto filter = filterOf(flow);
    const std::vector<std::string> warnings = warningsOf(filter);
    ASSERT_EQ(warnings.size(), 1u) << words;
    EXPECT_NE(warnings[0].find(words), std::string::npos) << warnings[0];
    filter->SetOutside(Medium::OUTSIDE_PASSES); // the same is said once
    EXPECT_EQ(warningsOf(filter), std::vector<std::string>()) << words;
  }
}

TEST(ArrayChoice, WhatIsConstantUpToRoundingIsSaid)
{
  auto flow = cube(9);
  addPointArray(flow, "rho", [](const Vec& x) { return 1.2 * (1 + 1e-14 * x[0]); });
  auto filter = filterOf(flow);
  const std::vector<std::string> warnings = warningsOf(filter);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("up to rounding"), std::string::npos) << warnings[0];
  addPointArray(flow, "rho", [](const Vec& x) { return 1.2 * (1 + 1e-11 * x[0]); });
  flow->Modified();
  EXPECT_EQ(warningsOf(filterOf(flow)), std::vector<std::string>());
}

TEST(ArrayChoice, GlassInVoxelsIsSaid)
{
  const auto glass = [](double width)
  {
    auto flow = cube(17);
    addPointArray(flow, "n",
      [width](const Vec& x)
      { return 1 + 0.5 * std::clamp(0.5 + (0.51 - std::hypot(x[0], x[1])) / width, 0., 1.); });
    return flow;
  };
  auto filter = filterOf(glass(1e-9));
  filter->SetExitInto(Filter::EXIT_AIR);
  const std::vector<std::string> warnings = warningsOf(filter);
  ASSERT_GE(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("n jumps by 0.5"), std::string::npos) << warnings[0];
  filter->SetInputDataObject(glass(0.4)); // three voxels
  for (const std::string& warning : warningsOf(filter))
  {
    EXPECT_EQ(warning.find("n jumps by"), std::string::npos) << warning;
  }
}

TEST(ArrayChoice, FractionsThatAreNotUsedAreSaidOnce)
{
  auto flow = cube(9);
  addPointArray(flow, "rho", bump(1, 1.2));
  addPointArray(flow, "Y_N2", bump(0.7, 0.77));
  addPointArray(flow, "N2", bump(0.7, 0.77)); // the same gas
  addPointArray(flow, "Y_SiH4", bump(0, 0.3));
  addPointArray(flow, "Y_OH", bump(0, 1e-3)); // too little
  addPointArray(flow, "yPlus", bump(0, 1));
  addPointArray(flow, "mixture fraction", bump(0, 1));
  addCellArray(flow, "Y_He", bump(0, 1)); // not where the density is
  auto filter = filterOf(flow);
  const std::vector<std::string> warnings = warningsOf(filter);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(": 'Y_SiH4', 'Y_He' look like fractions of gases"), std::string::npos)
    << warnings[0];
  filter->SetOutside(Medium::OUTSIDE_PASSES);
  EXPECT_EQ(warningsOf(filter), std::vector<std::string>());
  // The user's own choice needs no word.
  auto chosen = filterOf(flow);
  chosen->SetGas("nitrogen");
  EXPECT_EQ(warningsOf(chosen), std::vector<std::string>());
}

TEST(ArrayChoice, BlocksThatAreLeftOutAreSaid)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetBlock(0, flowWithRho());
  blocks->SetBlock(1, vtkSmartPointer<vtkHyperTreeGrid>::New());
  const std::vector<std::string> warnings = warningsOf(filterOf(blocks));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("A block of the input, which is left out, is a hyper-tree grid"),
    std::string::npos)
    << warnings[0];
}

TEST(ArrayChoice, MessagesAreShort)
{
  auto flow = cube(3);
  addPointArray(flow, (std::string(4999, 'x') + "\xc3\xa9").c_str(), bump(0, 9));
  auto filter = filterOf(flow);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_LT(complaints->Errors[0].size(), 2200u); // with VTK's own words
  EXPECT_NE(complaints->Errors[0].find(" [...] "), std::string::npos);
  EXPECT_NE(complaints->Errors[0].find("UniformPressure"), std::string::npos);
}

// The same image as of kelvins, of air and of a mixture whose density follows from the temperature.
TEST(ArrayChoice, DegreesBecomeKelvins)
{
  const auto flowOf = [](const char* name, double size, double zero)
  {
    auto flow = cube(17);
    addPointArray(flow, name, [=](const Vec& x) { return (bump(290, 350)(x) - zero) / size; });
    addPointArray(flow, "p", bump(9e4, 1e5));
    addPointArray(flow, "Y_He", bump(0, 0.5));
    return flow;
  };
  for (const char* gas : { "nitrogen", "air" }) // one, and the mixture
  {
    const auto imageOf = [&](vtkImageData* flow)
    {
      auto filter = filterOf(flow);
      filter->SetGas(gas);
      EXPECT_EQ(warningsOf(filter), std::vector<std::string>());
      return filter;
    };
    auto kelvins = imageOf(flowOf("T", 1, 0));
    for (const auto& [name, size, zero, words] :
      { std::make_tuple("T [degC]", 1., 273.15, "Temperature: 'T [degC]' plus 273.15"),
        std::make_tuple("temperature_F", 5. / 9, 459.67 * 5 / 9,
          "Temperature: 'temperature_F' times 0.555556 plus 255.372") })
    {
      auto degrees = imageOf(flowOf(name, size, zero));
      EXPECT_LT(relativeDifference(valuesOf(degrees, "OpticalPathDifference"),
                  valuesOf(kelvins, "OpticalPathDifference")),
        1e-5)
        << name;
      EXPECT_EQ(std::string(degrees->GetArraysUsed()).rfind(words, 0), 0u)
        << degrees->GetArraysUsed();
    }
  }
}

TEST(ArrayChoice, CelsiusAndGaugePressuresAreSaid)
{
  auto flow = cube(9);
  addPointArray(flow, "T", bump(280, 300));
  addPointArray(flow, "Tc", bump(15, 80));
  addPointArray(flow, "p", bump(9e4, 1e5));
  addPointArray(flow, "p_gauge", bump(10, 30));
  for (const auto& [temperature, pressure, words] :
    { std::make_tuple("Tc", "p", "degrees Celsius"), std::make_tuple("T", "p_gauge", "absolute") })
  {
    auto filter = filterOf(flow);
    filter->SetIndexModel(Medium::CIDDOR);
    choose(filter, Medium::TEMPERATURE, temperature);
    choose(filter, Medium::PRESSURE, pressure);
    const std::vector<std::string> warnings = warningsOf(filter);
    ASSERT_GE(warnings.size(), 1u) << words;
    EXPECT_NE(warnings[0].find(words), std::string::npos) << warnings[0];
    EXPECT_EQ(warnings.size(), 1u) << warnings[1];
  }
}
