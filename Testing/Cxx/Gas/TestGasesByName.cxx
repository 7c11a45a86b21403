// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Gases chosen by name: vtkGasTable, Gas, MixtureGases and BackgroundGas.
#include "Fixtures.h"

#include "vtkGasTable.h"

#include <cmath>
#include <limits>
#include <locale>

namespace
{

constexpr double rho = 1.2;
constexpr double fraction = 0.25;
using Index = vtkRefractiveIndex;

vtkSmartPointer<Index> filterOf(int model)
{
  auto image = cube(4);
  addPointArray(image, "rho", [](const Vec&) { return rho; });
  // A constant one is warned of.
  image->GetPointData()->GetArray("rho")->SetComponent(1, 0, 1.001 * rho);
  addPointArray(image, "Y", [](const Vec&) { return fraction; });
  addPointArray(image, "Z", [](const Vec&) { return 0.5; });
  auto filter = vtkSmartPointer<Index>::New();
  filter->SetInputDataObject(image);
  filter->SetIndexModel(model);
  filter->SetInputArrayToProcess(
    Index::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");
  return filter;
}

vtkSmartPointer<Index> mixtureOf(std::initializer_list<const char*> gases)
{
  auto filter = filterOf(Index::GLADSTONE_DALE_MIXTURE);
  const char* arrays[] = { "Y", "Z" };
  int i = 0;
  for (const char* gas : gases)
  {
    filter->AddMixtureArray(arrays[i++]);
    filter->AddMixtureGas(gas);
  }
  return filter;
}

/// The constant that the filter uses: N / rho.
double constantOf(Index* filter)
{
  filter->Update();
  vtkDataArray* n = arrayOf(filter, "Refractivity");
  return n && n->GetNumberOfTuples() > 0 ? n->GetComponent(0, 0) / rho : std::nan("");
}

std::vector<std::string> warningsOf(Index* filter)
{
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Modified();
  filter->Update();
  EXPECT_TRUE(complaints->Errors.empty());
  return complaints->Warnings;
}

constexpr double rounding = 1e-14;

} // namespace

TEST(GasByName, IsAirOrOfTheConstantGiven)
{
  auto filter = filterOf(Index::GLADSTONE_DALE);
  EXPECT_STREQ(filter->GetGas(), "air");
  EXPECT_NEAR(constantOf(filter), vtkGasTable::GetConstant("air", 632.8), 1e-18);
  EXPECT_NEAR(constantOf(filter) / 2.26e-4, 1, 2e-3);
  filter->SetGladstoneDaleConstant(3e-4);
  filter->SetWavelength(400);
  EXPECT_NEAR(constantOf(filter), 3e-4, 1e-18);
  filter->SetGas("Custom"); // as older state files have it
  EXPECT_NEAR(constantOf(filter), 3e-4, 1e-18);
}

TEST(GasByName, TableHoldsNothingElse)
{
  EXPECT_GE(vtkGasTable::GetNumberOfGases(), 15);
  for (int i = 0; i < vtkGasTable::GetNumberOfGases(); ++i)
  {
    const std::string name = vtkGasTable::GetName(i);
    EXPECT_TRUE(vtkGasTable::Has(name));
    EXPECT_TRUE(vtkGasTable::Has(vtkGasTable::GetFormula(name)));
    EXPECT_FALSE(vtkGasTable::GetSource(name).empty());
    EXPECT_LE(vtkGasTable::GetShortestWavelength(name), vtkGasTable::GetLongestWavelength(name));
  }
  EXPECT_NEAR(vtkGasTable::GetMolarMass("He"), 4.0026e-3, 1e-6);
  EXPECT_NEAR(vtkGasTable::GetShortestWavelength("neon"), 589.3, 1e-9);
  EXPECT_EQ(vtkGasTable::GetName(-1), "");
  EXPECT_EQ(vtkGasTable::GetName(vtkGasTable::GetNumberOfGases()), "");
  for (const char* none : { "phlogiston", "", "Custom" })
  {
    EXPECT_FALSE(vtkGasTable::Has(none));
    EXPECT_EQ(vtkGasTable::GetFormula(none), "");
    EXPECT_EQ(vtkGasTable::GetSource(none), "");
    EXPECT_TRUE(std::isnan(vtkGasTable::GetConstant(none, 633)));
    EXPECT_TRUE(std::isnan(vtkGasTable::GetMolarMass(none)));
  }
}

// A decimal point is one also where a program has set a language with commas.
TEST(MixtureByName, NumbersDependOnNoLocale)
{
  const std::locale global;
  struct Comma : std::numpunct<char>
  {
    char do_decimal_point() const override { return ','; }
  };
  std::locale::global(std::locale(global, new Comma));
  EXPECT_NEAR(constantOf(mixtureOf({ "5e-4", "2.5e-4" })),
    fraction * 5e-4 + 0.5 * 2.5e-4 + (0.5 - fraction) * vtkGasTable::GetConstant("air", 632.8),
    rounding * 1e-4);
  std::locale::global(global);
}

// It is a line beside the arrays, and nothing to be warned of.
TEST(GasByName, NotMeasuredAtTheWavelengthIsSaidBesideTheArrays)
{
  const auto note = [](Index* filter)
  {
    EXPECT_TRUE(warningsOf(filter).empty());
    const std::string used = filter->GetArraysUsed();
    return used.substr(used.find('.') + 1); // behind "Density: 'rho'."
  };
  auto filter = filterOf(Index::GLADSTONE_DALE);
  EXPECT_EQ(note(filter), "");
  filter->SetGas("krypton");
  for (const char* word : { "krypton", "632.8 nm", "140.4 to 623.4 nm", "Bideau-Mehu" })
  {
    EXPECT_NE(note(filter).find(word), std::string::npos) << note(filter);
  }
  filter->SetGas("neon");
  EXPECT_NE(note(filter).find("589.3 nm alone"), std::string::npos) << note(filter);
  // 632.8 nm is the laser's wavelength in air; SF6 was measured at 633 nm.
  for (const char* gas : { "SF6", "helium", "air" })
  {
    filter->SetGas(gas);
    EXPECT_EQ(note(filter), "") << gas;
  }
  filter->SetGas("neon");
  filter->SetWavelength(589.3);
  EXPECT_EQ(note(filter), "");

  filter = mixtureOf({ "neon", "Ne" });
  filter->SetBackgroundGas("krypton");
  const std::string ofMixture = note(filter);
  EXPECT_NE(ofMixture.find("krypton"), std::string::npos) << ofMixture;
  EXPECT_EQ(ofMixture.find("neon"), ofMixture.rfind("neon")) << ofMixture;
  // A gas that is not used is no reason for it.
  filter = filterOf(Index::GLADSTONE_DALE);
  filter->SetBackgroundGas("neon");
  EXPECT_EQ(note(filter), "");
}

TEST(GasByName, MistakesAreReportedOnce)
{
  const auto set = [](const char* gas) { return [gas](Index* f) { f->SetGas(gas); }; };
  expectOneMessage(filterOf(Index::GLADSTONE_DALE).Get(), set("phlogiston"),
    { "Gas holds 'phlogiston'", "helium (He)", "sulfur hexafluoride (SF6)",
      "GladstoneDaleConstant" },
    set("helium"));
  const auto background = [](const char* gas)
  { return [gas](Index* f) { f->SetBackgroundGas(gas); }; };
  expectOneMessage(mixtureOf({ "He" }).Get(), background("ether"),
    { "BackgroundGas holds 'ether'", "helium (He)" }, background("air"));
  const auto replace = [](std::vector<const char*> gases)
  {
    return [gases](Index* f)
    {
      f->ClearMixtureGases();
      for (const char* gas : gases)
      {
        f->AddMixtureGas(gas);
      }
    };
  };
  expectOneMessage(mixtureOf({ "He" }).Get(), replace({ "he" }),
    { "MixtureGases holds 'he'", "helium (He)" }, replace({ "He" }));
  expectOneMessage(mixtureOf({ "He" }).Get(), replace({ "He", "Ar" }),
    { "MixtureArrays and MixtureGases differ in length (1 and 2)" }, replace({ "He" }));
  for (const double wrong : { 0., -1., std::numeric_limits<double>::quiet_NaN() })
  {
    auto filter = filterOf(Index::GLADSTONE_DALE);
    filter->SetGas("helium");
    expectOneMessage(
      filter.Get(), [&](Index* f) { f->SetWavelength(wrong); }, { "Wavelength is", "positive" },
      [](Index* f) { f->SetWavelength(500); });
  }
}
