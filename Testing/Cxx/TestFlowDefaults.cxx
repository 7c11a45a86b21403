// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the window chooses for a flow, by the names, units and ranges of its arrays.
#include "FlowDefaults.h"

#include <gtest/gtest.h>

namespace
{

using Strings = std::vector<std::string>;
using Arrays = std::vector<std::pair<std::string, std::string>>;
using Scales = std::vector<std::pair<std::string, double>>;

FlowArray scalar(const std::string& name, double least, double most,
  FlowArray::Association association = FlowArray::Points)
{
  return { name, association, 1, { least, most } };
}

const FlowArray velocity = { "U", FlowArray::Points, 3, { -1, 1 } };

/// The factor of a density of this name; 0: not taken for a density.
double densityScaleOf(const std::string& name)
{
  const FlowDefaults chosen = flowDefaults({ scalar("Mach", 0, 3), scalar(name, 0.1, 2) });
  if (chosen.indexModel != FlowDefaults::GladstoneDale ||
    chosen.arrays != Arrays{ { "Density", name } })
  {
    return 0;
  }
  return chosen.scales.empty() ? 1 : chosen.scales.front().second;
}

} // namespace

TEST(FlowDefaults, DensityByItsName)
{
  for (const char* name : { "rho", "Density", "RHO", "rhoMean", "density_mean", "air density",
         "Rho", "rho [kg/m^3]", "Density (kg m^-3)", "rho_avg" })
  {
    EXPECT_EQ(densityScaleOf(name), 1) << name;
  }
}

TEST(FlowDefaults, OtherNamesAreNoDensity)
{
  for (const char* name : { "rhoU", "rhoE", "Number Density", "grad rho", "energy density", "throw",
         "rhodamine", "rho rms", "total" })
  {
    EXPECT_EQ(densityScaleOf(name), 0) << name;
  }
}

TEST(FlowDefaults, DensityUnits)
{
  EXPECT_EQ(densityScaleOf("Density (g/cm3)"), 1000);
  EXPECT_EQ(densityScaleOf("Density [g/cc]"), 1000);
  EXPECT_EQ(densityScaleOf("rho (g/cm^3)"), 1000);
  EXPECT_EQ(densityScaleOf("rho [g/l]"), 1);
  EXPECT_EQ(densityScaleOf("rho [g/m3]"), 1e-3);
  const FlowDefaults unknown = flowDefaults({ scalar("rho [stone/acre]", 1, 2) });
  EXPECT_TRUE(unknown.scales.empty());
  EXPECT_NE(unknown.message.find("unit of 'rho [stone/acre]' is not known"), std::string::npos);
}

TEST(FlowDefaults, PointsBeforeCellsAndNeverBoth)
{
  const FlowArray ofCells = scalar("rho", 1, 2, FlowArray::Cells);
  const FlowDefaults cells = flowDefaults({ scalar("Mach", 0, 1), ofCells });
  EXPECT_EQ(cells.association, FlowArray::Cells);
  EXPECT_EQ(cells.arrays, (Arrays{ { "Density", "rho" } }));
  const FlowDefaults points = flowDefaults({ ofCells, scalar("rho", 1, 2) });
  EXPECT_EQ(points.association, FlowArray::Points);

  const FlowDefaults noMixture = flowDefaults({ ofCells, scalar("Y_He", 0, 1) });
  EXPECT_EQ(noMixture.indexModel, FlowDefaults::GladstoneDale);
  EXPECT_TRUE(noMixture.fractions.empty());
}

TEST(FlowDefaults, MixtureOfGasesThatAreKnown)
{
  const FlowDefaults chosen = flowDefaults({ scalar("rho", 0.2, 1.2), scalar("Y_He", 0, 1),
    scalar("YCO2", -1e-6, 0.4), scalar("Y_OH", 0, 0.1), velocity, scalar("T", 300, 400) });
  EXPECT_EQ(chosen.indexModel, FlowDefaults::Mixture);
  EXPECT_EQ(chosen.arrays, (Arrays{ { "Density", "rho" } }));
  EXPECT_EQ(chosen.fractions, (Strings{ "Y_He", "YCO2" }));
  EXPECT_EQ(chosen.gases, (Strings{ "He", "CO2" }));
  EXPECT_FALSE(chosen.ofVolume);
}

TEST(FlowDefaults, FractionsByTheirNames)
{
  const std::pair<const char*, const char*> names[] = { { "mass fraction of He", "He" },
    { "MassFraction_CO2", "CO2" }, { "massFractionCH4", "CH4" }, { "He", "He" }, { "SF6", "SF6" },
    { "Y_helium", "helium" }, { "Mass Fraction of Carbon Dioxide", "carbon dioxide" },
    { "carbonDioxide", "carbon dioxide" }, { "YH2O", "H2O" }, { "y_n2", "" }, { "Co", "" },
    { "Y", "" }, { "YMean", "" }, { "Xenomorph", "" } };
  for (const auto& [name, gas] : names)
  {
    const FlowDefaults chosen = flowDefaults({ scalar("rho", 0.2, 1.2), scalar(name, 0, 0.9) });
    EXPECT_EQ(chosen.gases, *gas ? Strings{ gas } : Strings{}) << name;
  }
  // Not a fraction by its values.
  EXPECT_TRUE(flowDefaults({ scalar("rho", 1, 2), scalar("He", 0, 250) }).gases.empty());
}

TEST(FlowDefaults, VolumeFractionsOnlyWhereThereAreNoOfMass)
{
  const FlowDefaults moles = flowDefaults({ scalar("rho", 1, 2), scalar("X_He", 0, 1) });
  EXPECT_TRUE(moles.ofVolume);
  EXPECT_EQ(moles.fractions, (Strings{ "X_He" }));
  const FlowDefaults both = flowDefaults({ scalar("rho", 1, 2), scalar("X_He", 0, 1),
    scalar("mole fraction of CO2", 0, 1), scalar("Y_He", 0, 1), scalar("He", 0, 1) });
  EXPECT_FALSE(both.ofVolume);
  EXPECT_EQ(both.fractions, (Strings{ "Y_He" }));
}

TEST(FlowDefaults, MoistAirWhereThereIsNoDensity)
{
  const FlowDefaults chosen =
    flowDefaults({ scalar("p", 9e4, 1.1e5), scalar("T", 280, 1500), velocity });
  EXPECT_EQ(chosen.indexModel, FlowDefaults::Ciddor);
  EXPECT_EQ(chosen.arrays, (Arrays{ { "Temperature", "T" }, { "Pressure", "p" } }));
  EXPECT_TRUE(chosen.scales.empty());
  EXPECT_EQ(flowDefaults({ scalar("p", 9e4, 1.1e5), scalar("T", 280, 300), scalar("rho", 1, 2) })
              .indexModel,
    FlowDefaults::GladstoneDale);
}

TEST(FlowDefaults, PressureUnits)
{
  const auto scaleOf = [](const FlowArray& pressure) -> double
  {
    const FlowDefaults chosen = flowDefaults({ pressure, scalar("Temperature", 280, 320) });
    if (chosen.indexModel != FlowDefaults::Ciddor)
    {
      return 0;
    }
    return chosen.scales.empty() ? 1 : chosen.scales.front().second;
  };
  EXPECT_EQ(scaleOf(scalar("p [hPa]", 1, 2)), 100);
  EXPECT_EQ(scaleOf(scalar("Pressure (kPa)", 90, 110)), 1000);
  EXPECT_EQ(scaleOf(scalar("p_bar", 0.9, 1.1)), 1e5);
  EXPECT_EQ(scaleOf(scalar("static pressure (Pa)", 700, 900)), 1);
  EXPECT_EQ(scaleOf(scalar("p", 700, 1013)), 100); // of weather
  EXPECT_EQ(scaleOf(scalar("p", 80, 101)), 1000);  // of the room
  EXPECT_EQ(scaleOf(scalar("p", 1e4, 1e5)), 1);
  EXPECT_EQ(scaleOf(scalar("p", -20, 30)), 0); // to the surroundings' pressure
  EXPECT_EQ(scaleOf(scalar("p [furlong]", 1, 2)), 0);
  EXPECT_EQ(scaleOf(scalar("p_rgh", 9e4, 1e5)), 0);
  EXPECT_EQ(scaleOf(scalar("total pressure", 9e4, 1e5)), 0);
}

TEST(FlowDefaults, TemperaturesInCelsiusAreReported)
{
  const FlowDefaults chosen = flowDefaults({ scalar("T", 15, 80), scalar("p", 9e4, 1e5) });
  EXPECT_TRUE(chosen.arrays.empty());
  EXPECT_NE(chosen.message.find("'T' is not in kelvins"), std::string::npos);
}

TEST(FlowDefaults, TemperatureOrPressureAloneIsNoDensity)
{
  for (const FlowArray& array :
    { scalar("T", 290, 310), scalar("temp", 15, 80), scalar("Temperature", 300, 301),
      scalar("wallTemperature", 0, 1), scalar("x [K]", 1, 2), scalar("temperature_K", 1, 2),
      scalar("field", 250, 2500), scalar("p", 9e4, 1e5), scalar("q (hPa)", 900, 1013) })
  {
    const FlowDefaults chosen = flowDefaults({ velocity, array });
    EXPECT_TRUE(chosen.arrays.empty()) << array.name;
    EXPECT_FALSE(chosen.isSure) << array.name;
    EXPECT_NE(chosen.message.find("no density, nor a temperature together with a pressure"),
      std::string::npos)
      << chosen.message;
    EXPECT_NE(chosen.message.find("Documentation/density.md"), std::string::npos);
    // The only other array is a guess.
    EXPECT_EQ(
      flowDefaults({ array, scalar("Mach", 0, 2) }).arrays, (Arrays{ { "Density", "Mach" } }))
      << array.name;
  }
  EXPECT_EQ(flowDefaults({ scalar("water dens", 990, 1000) }).arrays,
    (Arrays{ { "Density", "water dens" } }));
}

TEST(FlowDefaults, RefractiveIndexByNameAndRange)
{
  for (const char* name : { "n", "RefractiveIndex", "Index of Refraction", "IOR" })
  {
    const FlowDefaults chosen = flowDefaults({ scalar("rho", 1, 2), scalar(name, 1.33, 1.5) });
    EXPECT_EQ(chosen.indexModel, FlowDefaults::RefractiveIndex) << name;
    EXPECT_EQ(chosen.arrays, (Arrays{ { "IndexArray", name } }));
  }
  // A number density.
  EXPECT_EQ(flowDefaults({ scalar("n", 0, 1e20), scalar("rho", 1, 2) }).indexModel,
    FlowDefaults::GladstoneDale);
}

TEST(FlowDefaults, WhatTheFilterMadeIsTakenAsItIs)
{
  const FlowDefaults chosen =
    flowDefaults({ scalar("vtkValidPointMask", 0, 1), scalar("Refractivity", 0, 3e-4) });
  EXPECT_EQ(chosen.indexModel, FlowDefaults::Refractivity);
  EXPECT_EQ(chosen.arrays, (Arrays{ { "IndexArray", "Refractivity" } }));
}

TEST(FlowDefaults, AGuessIsReported)
{
  const FlowDefaults chosen = flowDefaults(
    { velocity, scalar("vtkGhostType", 0, 1), scalar("Mach", 0, 2), scalar("k", 0, 1) });
  EXPECT_EQ(chosen.arrays, (Arrays{ { "Density", "Mach" } }));
  EXPECT_NE(chosen.message.find("'Mach' is taken as the density"), std::string::npos);
  EXPECT_FALSE(chosen.isSure);
  EXPECT_TRUE(flowDefaults({ scalar("rho", 1, 2) }).isSure);
  EXPECT_FALSE(flowDefaults({ scalar("rho [stone/acre]", 1, 2) }).isSure);
}

TEST(FlowDefaults, NothingToChooseFrom)
{
  EXPECT_TRUE(flowDefaults({}).arrays.empty());
  EXPECT_TRUE(flowDefaults({ velocity }).arrays.empty());
  // An array without values.
  EXPECT_TRUE(flowDefaults({ scalar("rho", 1e299, -1e299) }).arrays.empty());
}

TEST(FlowDefaults, MasksByTheirNames)
{
  const FlowArray density = scalar("rho", 1, 2);
  const FlowDefaults solid = flowDefaults({ scalar("solid", 0, 1, FlowArray::Cells), density });
  EXPECT_EQ(solid.arrays, (Arrays{ { "Density", "rho" } }));
  EXPECT_EQ(solid.mask, "solid");
  EXPECT_EQ(solid.maskAssociation, FlowArray::Cells);
  EXPECT_FALSE(solid.isMaskOfGas);
  EXPECT_NE(solid.message.find("No gas where 'solid' is 0.5 or more."), std::string::npos);
  for (const char* name : { "iblank", "IBlank", "vfrac", "Vol_Frac" })
  {
    const FlowDefaults gas = flowDefaults({ density, scalar(name, -2, 1) });
    EXPECT_EQ(gas.mask, name);
    EXPECT_TRUE(gas.isMaskOfGas) << name;
  }
  // Nothing is masked; not a mask; and a mask is no density.
  EXPECT_EQ(flowDefaults({ density, scalar("solid", 0, 0) }).mask, "");
  EXPECT_EQ(flowDefaults({ density, scalar("solid stress", 0, 1) }).mask, "");
  const FlowDefaults guess = flowDefaults({ scalar("solid", 0, 1), scalar("f", 1, 2) });
  EXPECT_EQ(guess.arrays, (Arrays{ { "Density", "f" } }));
}
