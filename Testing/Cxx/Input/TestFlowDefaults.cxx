// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is chosen for a flow, by the names, units and ranges of its arrays.
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
  if (chosen.indexModel != MediumSettings::GLADSTONE_DALE ||
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
         "Rho", "rho [kg/m^3]", "Density (kg m^-3)", "rho_avg", "dens", "DENS", "SV_DENSITY",
         "Density_avg", "thermo:rho", "rho.air", "MassDensity", "Mass_density",
         "TimeAveragedDensity", "mean_density", "density_kg_m3", "rho_kgm3", "Density[kg/m^3]",
         "Density (kg/m\xc2\xb3)", "Density [ kg m^-3 ]", "masse volumique", "conserved_density",
         "rho_mixture", "primitive_rho", "gasDensity", "Density_0", "density_gas", "FluidDensity",
         "rho1", "ro", "prim_density", "StaticDensity", "alpha_rho1", "Mean of Density (kg/m^3)",
         "density (gas)", "<greek>r</greek>", "\xcf\x81", "rho [kg m<sup>-3</sup>]",
         "rho_kg_per_m3", "Density {kg/m**3}" })
  {
    EXPECT_EQ(densityScaleOf(name), 1) << name;
  }
}

TEST(FlowDefaults, OtherNamesAreNoDensity)
{
  for (const char* name : { "rhoU", "rhoE", "Number Density", "grad rho", "energy density", "throw",
         "rhodamine", "rho rms", "total", "Avg_Density_Grad", "DensityGradient", "RhoRT", "rhoInf",
         "rhoPrime2Mean", "rho_He", "rho.water", "electron density", "rho [K]", "density (hPa)",
         "alpha1", "Material Id", "cellID", "ids", "Mass", "scalars", "node_value", "log_rho" })
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
  for (const char* name : { "rho_gcc", "density_g_cm3", "Density [g cm^-3]", "rho (gm/cc)",
         "RHO [g/cm**3]", "rho [kg/dm3]", "rho [t/m\xc2\xb3]", "rho [Mg/m3]", "rhoMean [g/ml]" })
  {
    EXPECT_NEAR(densityScaleOf(name), 1000, 1e-9) << name;
  }
  EXPECT_NEAR(densityScaleOf("rho [lbm/ft^3]"), 16.018463, 1e-5);
  EXPECT_NEAR(densityScaleOf("rho [slug/ft3]"), 515.3788, 1e-3);
  EXPECT_NEAR(densityScaleOf("rho [tonne/mm^3]"), 1e12, 1);
  EXPECT_NEAR(densityScaleOf("rho [mg/cm3]"), 1, 1e-12);
  EXPECT_EQ(scaleByUnit("Density", "rho"), 0);
  EXPECT_EQ(scaleByUnit("Pressure", "p_hPa"), 100);
  EXPECT_EQ(scaleByUnit("Pressure", "Pressure (kPa)"), 1000);
  EXPECT_EQ(scaleByUnit("Temperature", "T [K]"), 1);
  EXPECT_NEAR(scaleByUnit("Temperature", "T [degR]"), 5. / 9, 1e-15);
  EXPECT_EQ(scaleByUnit("Temperature", "T [degC]"), 1);
  EXPECT_EQ(scaleByUnit("Temperature", "T_f"), 0); // of a flame
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
  EXPECT_EQ(noMixture.indexModel, MediumSettings::GLADSTONE_DALE);
  EXPECT_TRUE(noMixture.fractions.empty());
}

TEST(FlowDefaults, MixtureOfGasesThatAreKnown)
{
  const FlowDefaults chosen = flowDefaults({ scalar("rho", 0.2, 1.2), scalar("Y_He", 0, 1),
    scalar("YCO2", -1e-6, 0.4), scalar("Y_OH", 0, 0.1), velocity, scalar("T", 300, 400) });
  EXPECT_EQ(chosen.indexModel, MediumSettings::GLADSTONE_DALE_MIXTURE);
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
    { "carbonDioxide", "carbon dioxide" }, { "YH2O", "H2O" }, { "y_n2", "N2" }, { "Co", "" },
    // Fluent, CONVERGE and others
    { "ch4", "CH4" }, { "molef-ch4", "CH4" }, { "mass_fraction_of_ch4", "CH4" },
    { "MASSFRAC_CH4", "CH4" }, { "Yi_CH4", "CH4" }, { "rho_CH4", "CH4" }, { "rhoY(CH4)", "CH4" },
    { "c3h8", "C3H8" }, { "Y_NH3", "NH3" }, { "Y_O", "O" }, { "NO", "NO" }, { "AR", "Ar" },
    // Of a letter or two it is not known alone.
    { "N", "" }, { "O", "" }, { "no", "" }, { "he", "" }, { "rho_u", "" }, { "y_plus", "" },
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

TEST(FlowDefaults, LettersAreGasesBesideOthers)
{
  const FlowDefaults air = flowDefaults({ scalar("rho", 1e-3, 1), scalar("N2", 0, 0.77),
    scalar("N", 0, 0.3), scalar("O", 0, 0.2), scalar("NO", 0, 0.1), scalar("n", 0, 0.5) });
  EXPECT_EQ(air.gases, (Strings{ "N2", "N", "O", "NO" }));
}

TEST(FlowDefaults, PartialDensitiesWhereThereAreNoFractions)
{
  const FlowArray density = scalar("rho", 1, 40), partial = scalar("rho_CH4", 0, 30);
  EXPECT_EQ(flowDefaults({ density, partial }).fractions, (Strings{ "rho_CH4" }));
  EXPECT_EQ(
    flowDefaults({ density, partial, scalar("Y_N2", 0, 1) }).fractions, (Strings{ "Y_N2" }));
  // Without the whole density nothing is known.
  EXPECT_TRUE(flowDefaults({ partial, scalar("rho_air", 0, 1) }).fractions.empty());
}

TEST(FlowDefaults, DensityOfAnIdealGasWhereThereAreFractions)
{
  const std::vector<FlowArray> flame = { scalar("T", 290, 2100), scalar("p", 1e5, 1e5),
    scalar("CH4", 0, 1), scalar("O2", 0, 0.23), scalar("RH", 0, 0.5) };
  const FlowDefaults chosen = flowDefaults(flame);
  EXPECT_EQ(chosen.indexModel, MediumSettings::GLADSTONE_DALE_MIXTURE);
  EXPECT_EQ(chosen.arrays, (Arrays{ { "Temperature", "T" }, { "Pressure", "p" } }));
  EXPECT_EQ(chosen.fractions, (Strings{ "CH4", "O2" }));
  EXPECT_NE(chosen.message.find("density: that of an ideal gas"), std::string::npos);
  EXPECT_EQ(flowDefaults(flame, MediumSettings::CIDDOR).indexModel, MediumSettings::CIDDOR);
}

TEST(FlowDefaults, ArraysOfSeveralQuantitiesAndHolesAreSaid)
{
  FlowArray state = scalar("Q", 0, 0);
  state.components = 5;
  EXPECT_NE(flowDefaults({ state }).message.find("'Q_0'"), std::string::npos);
  EXPECT_EQ(flowDefaults({ velocity }).message.find("_0'"), std::string::npos);
  EXPECT_NE(noteOnOverset({ scalar("cellTypes", 0, 2) }).find("Threshold"), std::string::npos);
  EXPECT_EQ(noteOnOverset({ scalar("cellTypes", 0, 1) }), "");
}

TEST(FlowDefaults, MoistAirWhereThereIsNoDensity)
{
  const FlowDefaults chosen =
    flowDefaults({ scalar("p", 9e4, 1.1e5), scalar("T", 280, 1500), velocity });
  EXPECT_EQ(chosen.indexModel, MediumSettings::CIDDOR);
  EXPECT_EQ(chosen.arrays, (Arrays{ { "Temperature", "T" }, { "Pressure", "p" } }));
  EXPECT_TRUE(chosen.scales.empty());
  EXPECT_EQ(flowDefaults({ scalar("p", 9e4, 1.1e5), scalar("T", 280, 300), scalar("rho", 1, 2) })
              .indexModel,
    MediumSettings::GLADSTONE_DALE);
}

TEST(FlowDefaults, ElectronsBesideAGasOrAlone)
{
  const double high = 1e25;
  const std::pair<const char*, double> names[] = { { "ne", 0 }, { "n_e", 0 },
    { "electron_density", 0 }, { "ElectronNumberDensity", 0 }, { "neMean", 0 }, { "ne [m^-3]", 1 },
    { "ne [cm^-3]", 1e6 }, { "n_e (1/cm3)", 1e6 }, { "ne_cm-3", 1e6 },
    { "Electron Density [#/cc]", 1e6 }, { "ne [m\xe2\x81\xbb\xc2\xb3]", 1 }, { "ne_per_m3", 1 } };
  for (const auto& [name, scale] : names)
  {
    const FlowDefaults alone = flowDefaults({ scalar(name, 0, high), scalar("Mach", 0, 2) });
    EXPECT_EQ(alone.indexModel, MediumSettings::ELECTRON_DENSITY) << name;
    EXPECT_EQ(alone.arrays, (Arrays{ { "IndexArray", name } }));
    EXPECT_EQ(scaleByUnit("IndexArray", name), scale) << name;
  }
  const FlowArray electrons = scalar("ne", 0, high);
  const FlowDefaults both = flowDefaults({ scalar("rho", 1, 2), electrons });
  EXPECT_EQ(both.indexModel, MediumSettings::ELECTRON_DENSITY);
  EXPECT_EQ(both.arrays, (Arrays{ { "Density", "rho" }, { "IndexArray", "ne" } }));
  EXPECT_EQ(both.message,
    "Density: 'rho' in kg/m\xc2\xb3; gas: air. Electron density: 'ne' in "
    "m\xe2\x81\xbb\xc2\xb3.");
  // Neon, a quantity relative to another, one in cells beside a gas at points, and one beside a mixture.
  for (const FlowArray& other : { scalar("ne", 0, 1), scalar("n_e", 0, 0.5), scalar("nu", 0, high),
         scalar("ne", 0, high, FlowArray::Cells), scalar("ne [1/acre]", 0, high) })
  {
    EXPECT_EQ(flowDefaults({ scalar("rho", 1, 2), other }).arrays, (Arrays{ { "Density", "rho" } }))
      << other.name;
  }
  EXPECT_EQ(flowDefaults({ scalar("rho", 1, 2), scalar("Y_He", 0, 1), electrons }).indexModel,
    MediumSettings::GLADSTONE_DALE_MIXTURE);
}

TEST(FlowDefaults, PressureUnits)
{
  const auto scaleOf = [](const FlowArray& pressure) -> double
  {
    const FlowDefaults chosen = flowDefaults({ pressure, scalar("Temperature", 280, 320) });
    if (chosen.indexModel != MediumSettings::CIDDOR)
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

TEST(FlowDefaults, TemperaturesInCelsiusAreConvertedWhereTheirNamesSaySo)
{
  for (const char* name : { "T [degC]",
         "T [\xc2\xb0"
         "C]",
         "T (C)", "temperature_C", "Temperature_Celsius", "TempDegC", "T [deg C]" })
  {
    const FlowDefaults chosen = flowDefaults({ scalar(name, 15, 80), scalar("p", 9e4, 1e5) });
    EXPECT_EQ(chosen.arrayOf("Temperature"), name) << chosen.message;
    EXPECT_NE(chosen.message.find(std::string("'") + name + "' in degrees Celsius; pressure"),
      std::string::npos)
      << chosen.message;
  }
  EXPECT_NE(flowDefaults({ scalar("T_F", 60, 180), scalar("p", 9e4, 1e5) })
              .message.find("'T_F' in degrees Fahrenheit"),
    std::string::npos);
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
    EXPECT_TRUE(isNoDensity(array)) << array.name;
    // The only other array is no density because of that.
    EXPECT_TRUE(flowDefaults({ array, scalar("Mach", 0, 2) }).arrays.empty()) << array.name;
  }
  EXPECT_FALSE(isNoDensity(scalar("water dens", 990, 1000)));
}

TEST(FlowDefaults, RefractiveIndexByNameAndRange)
{
  for (const char* name : { "n", "RefractiveIndex", "Index of Refraction", "IOR" })
  {
    const FlowDefaults chosen = flowDefaults({ scalar("rho", 1, 2), scalar(name, 1.33, 1.5) });
    EXPECT_EQ(chosen.indexModel, MediumSettings::REFRACTIVE_INDEX) << name;
    EXPECT_EQ(chosen.arrays, (Arrays{ { "IndexArray", name } }));
  }
  // A number density.
  EXPECT_EQ(flowDefaults({ scalar("n", 0, 1e20), scalar("rho", 1, 2) }).indexModel,
    MediumSettings::GLADSTONE_DALE);
}

TEST(FlowDefaults, WhatTheFilterMadeIsTakenAsItIs)
{
  const FlowDefaults chosen =
    flowDefaults({ scalar("vtkValidPointMask", 0, 1), scalar("Refractivity", 0, 3e-4) });
  EXPECT_EQ(chosen.indexModel, MediumSettings::REFRACTIVITY);
  EXPECT_EQ(chosen.arrays, (Arrays{ { "IndexArray", "Refractivity" } }));
}

TEST(FlowDefaults, NothingIsGuessedAndAllThatThereIsIsNamed)
{
  const FlowDefaults chosen = flowDefaults({ velocity, scalar("vtkGhostType", 0, 1),
    scalar("Mach", 0, 2), scalar("k", 0, 1, FlowArray::Cells) });
  EXPECT_TRUE(chosen.arrays.empty());
  EXPECT_FALSE(chosen.isSure);
  EXPECT_NE(chosen.message.find("There are point arrays Mach (0 to 2); cell arrays k (0 to 1)."),
    std::string::npos)
    << chosen.message;
  EXPECT_TRUE(flowDefaults({ scalar("rho", 1, 2) }).isSure);
  EXPECT_FALSE(flowDefaults({ scalar("rho [stone/acre]", 1, 2) }).isSure);
}

// Of solvers' own files: the density is the one that is named so, wherever it stands.
TEST(FlowDefaults, SetsOfArraysThatSolversWrite)
{
  const auto cells = [](const char* name, double low, double high)
  { return scalar(name, low, high, FlowArray::Cells); };
  const std::pair<std::vector<FlowArray>, const char*> sets[] = {
    { { scalar("Material Id", 2, 3), scalar("rho", 6, 13) }, "rho" },
    { { scalar("RhoRT", 101324.9, 101325.1), scalar("density", .2, 1.1),
        scalar("temp", 298, 1580) },
      "density" },
    { { cells("density", .2, .5), scalar("node_value", 0, 3) }, "density" },
    { { cells("cellID", 0, 4095), cells("p", 9e4, 1.2e5), cells("rho", 1, 1.4),
        cells("T", 280, 320) },
      "rho" },
    { { scalar("Avg_Density_Grad", -1, 1), scalar("Density", .5, 1.3), scalar("Mach", 0, 2) },
      "Density" },
    { { scalar("alpha1", 0, 1), scalar("alpha_rho1", 0, 1), scalar("pres", 9e4, 2e5),
        scalar("rho", .1, 1.2) },
      "rho" },
    { { scalar("grad_T", 0, 1e3), scalar("rho", 1, 1.2) }, "rho" },
    { { scalar("rhoMean", 1, 1.2), scalar("rho", 1, 1.2) }, "rho" },
    { { scalar("T", 280, 300), scalar("p", 9e4, 1e5), cells("rho", 1, 1.2) }, "rho" },
    { { scalar("Y(H)", 0, 1e-5), scalar("Y(O2)", .1, .23) }, "" },
    { { scalar("ids", 1, 1249) }, "" },
    // Of parts none is the density.
    { { scalar("alpha_rho1", 0, 1), scalar("alpha_rho2", 0, 1000) }, "" },
    { { scalar("rho.air", 1, 1.2), scalar("rho.water", 998, 999) }, "" },
    { { scalar("Density_0", 0, 1), scalar("Density_1", 0, 1) }, "" },
  };
  for (const auto& [arrays, density] : sets)
  {
    EXPECT_EQ(flowDefaults(arrays).arrayOf("Density"), density) << arrays[0].name;
  }
  EXPECT_NE(flowDefaults({ scalar("alpha_rho1", 0, 1), scalar("alpha_rho2", 0, 1000) })
              .message.find("'alpha_rho1', 'alpha_rho2' are of single species or phases"),
    std::string::npos);
  // Combustion: the fractions of known gases, too.
  const FlowDefaults flame = flowDefaults({ scalar("density", .2, 1.1), scalar("temp", 298, 1580),
    scalar("Y(H2)", 0, .1), scalar("Y(O2)", 0, .23), scalar("Y(OH)", 0, .01) });
  EXPECT_EQ(flame.indexModel, MediumSettings::GLADSTONE_DALE_MIXTURE);
  EXPECT_EQ(flame.fractions, (Strings{ "Y(H2)", "Y(O2)" }));
  EXPECT_EQ(flame.gases, (Strings{ "H2", "O2" }));
}

TEST(FlowDefaults, ArraysOfAModelThatIsGiven)
{
  const std::vector<FlowArray> all = { scalar("p", 9e4, 1e5), scalar("T", 280, 300),
    scalar("RH", 0, 0.8), scalar("rho", 1, 1.2), scalar("ior", 1, 1.0003),
    scalar("Refractivity", 0, 3e-4) };
  const FlowDefaults air = flowDefaults(all, MediumSettings::CIDDOR);
  EXPECT_EQ(
    air.arrays, (Arrays{ { "Temperature", "T" }, { "Pressure", "p" }, { "Humidity", "RH" } }));
  EXPECT_EQ(flowDefaults(all, MediumSettings::GLADSTONE_DALE).arrayOf("Density"), "rho");
  EXPECT_EQ(flowDefaults(all, MediumSettings::REFRACTIVE_INDEX).arrayOf("IndexArray"), "ior");
  EXPECT_EQ(flowDefaults(all, MediumSettings::REFRACTIVITY).arrayOf("IndexArray"), "Refractivity");
  EXPECT_TRUE(flowDefaults({ scalar("f", 0, 1) }, MediumSettings::CIDDOR).arrays.empty());
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
  const FlowArray density = scalar("rho", 1, 2), body = scalar("solid", 0, 1, FlowArray::Cells);
  EXPECT_EQ(flowMask({ density, body }).array, "solid");
  EXPECT_EQ(flowMask({ density, body }).association, FlowArray::Cells);
  EXPECT_FALSE(marksGas("solid"));
  const FlowDefaults solid = flowDefaults({ body, density });
  EXPECT_EQ(solid.arrays, (Arrays{ { "Density", "rho" } }));
  EXPECT_NE(solid.message.find("No gas where 'solid' is 0.5 or more."), std::string::npos);
  for (const char* name : { "iblank", "IBlank", "vfrac", "Vol_Frac" })
  {
    EXPECT_EQ(flowMask({ density, scalar(name, -2, 1) }).array, name);
    EXPECT_TRUE(marksGas(name)) << name;
  }
  // Nothing is masked; not a mask; and a mask is no density.
  EXPECT_EQ(flowMask({ density, scalar("solid", 0, 0) }).array, "");
  EXPECT_EQ(flowMask({ density, scalar("solid", 0, 0.3) }).array, "");
  EXPECT_EQ(flowMask({ density, scalar("solid", 0, 0.5) }).array, "solid");
  EXPECT_EQ(flowMask({ density, scalar("solid stress", 0, 1) }).array, "");
  EXPECT_TRUE(isNoDensity(scalar("solid", 0, 1)));
}

namespace
{

/// What is said of a density of this range.
std::string kindOf(
  const char* name, double low, double high, double scale = 1, bool isGiven = false)
{
  FlowInUse flow;
  flow.arrays = { scalar(name, low, high) };
  flow.scales = { scale };
  flow.isScaleGiven = isGiven;
  return implausible(flow).kind;
}

std::string kindOfAir(
  const FlowArray& temperature, const FlowArray& pressure, double pascals = 1, double zero = 0)
{
  FlowInUse flow;
  flow.indexModel = MediumSettings::CIDDOR;
  flow.arrays = { temperature, pressure };
  flow.scales = { 1, pascals };
  flow.zero = zero;
  return implausible(flow).kind;
}

} // namespace

TEST(Implausible, Densities)
{
  EXPECT_EQ(kindOf("rho", 0.1, 8), "");
  EXPECT_EQ(kindOf("rho", 0, 1.2), "");   // a jet into a vacuum
  EXPECT_EQ(kindOf("rho", 0.5, 100), ""); // an engine
  EXPECT_EQ(kindOf("rho", 1, 1), "constant");
  EXPECT_EQ(kindOf("rho", 0, 0), "zero");
  EXPECT_EQ(kindOf("rho", -0.7, 0.3), "negative");
  EXPECT_EQ(kindOf("rho", -1e-5, 1.2), "");       // a solver's undershoot
  EXPECT_EQ(kindOf("Density", 20, 620), "dense"); // of FDS: a temperature
  EXPECT_EQ(kindOf("Density", 20, 40), "dense");
  EXPECT_EQ(kindOf("density", 2e-4, 1.2e-3), "thin"); // in g/cm3
  EXPECT_EQ(kindOf("density", 2e-4, 1.2e-3, 1000, true), "");
  EXPECT_EQ(kindOf("density", 2e-4, 1.2e-3, 1, true), ""); // the user says so
  EXPECT_EQ(kindOf("grad_T", 0, 1), "no density");
  EXPECT_EQ(kindOf("rho [stone/acre]", 1, 2), "unit");
}

TEST(Implausible, LiquidsOfWhichTheUserGivesTheIndexOrTheConstant)
{
  FlowInUse water;
  water.arrays = { scalar("rho", 990, 1000) };
  water.scales = { 1 };
  EXPECT_EQ(implausible(water).kind, "dense");
  water.isGas = false;
  EXPECT_EQ(implausible(water).kind, "");
  water.indexModel = MediumSettings::REFRACTIVE_INDEX;
  water.arrays = { scalar("n", 1.33, 1.33) };
  EXPECT_EQ(implausible(water).kind, "");
}

TEST(Implausible, MoistAir)
{
  const FlowArray kelvins = scalar("T", 280, 320), pascals = scalar("p", 9e4, 1.1e5);
  EXPECT_EQ(kindOfAir(kelvins, pascals), "");
  EXPECT_EQ(kindOfAir(scalar("T", 15, 80), pascals), "Celsius");
  EXPECT_EQ(kindOfAir(scalar("T", 20, 1500), pascals), "Celsius");
  EXPECT_EQ(kindOfAir(scalar("T", -20, 1500), pascals), "Celsius");
  EXPECT_EQ(kindOfAir(scalar("T", 0, 320), pascals), "");  // 0 in bodies
  EXPECT_EQ(kindOfAir(scalar("T", 50, 320), pascals), ""); // of a hypersonic tunnel
  EXPECT_EQ(kindOfAir(scalar("T [degC]", 15, 80), pascals, 1, 273.15), "");
  EXPECT_EQ(kindOfAir(scalar("T [degC]", -280, 20), pascals, 1, 273.15), "Celsius");
  EXPECT_EQ(kindOfAir(kelvins, scalar("p", -20, 30)), "gauge");
  EXPECT_EQ(kindOfAir(kelvins, scalar("p_gauge", 10, 30)), "gauge");
  EXPECT_EQ(kindOfAir(kelvins, scalar("p", 700, 1013)), "pressure");
  EXPECT_EQ(kindOfAir(kelvins, scalar("p", 700, 1013), 100), "");
  EXPECT_EQ(kindOfAir(kelvins, scalar("p", 0.9, 1.1)), "pressure");
}

TEST(FlowDefaults, UniformPressureCompletesATemperature)
{
  const std::vector<FlowArray> warm = { velocity, scalar("T", 290, 320, FlowArray::Cells) };
  EXPECT_TRUE(flowDefaults(warm).arrays.empty());
  const FlowDefaults room = flowDefaultsAt(warm, pressureOfRoom);
  EXPECT_EQ(room.indexModel, MediumSettings::CIDDOR);
  EXPECT_EQ(room.association, FlowArray::Cells);
  EXPECT_EQ(room.arrays, (Arrays{ { "Temperature", "T" } }));
  EXPECT_EQ(room.uniformPressure, 101325);
  EXPECT_TRUE(room.isSure);
  EXPECT_EQ(room.message, "Air; temperature: 'T' in K; pressure: 101325 Pa everywhere.");

  // Neither what a flow has itself, nor what may be degrees Celsius.
  EXPECT_EQ(flowDefaultsAt({ scalar("rho", 1, 2) }, pressureOfRoom).uniformPressure, 0);
  EXPECT_EQ(flowDefaultsAt({ scalar("T", 290, 320), scalar("p", 9e4, 1e5) }, pressureOfRoom)
              .arrayOf("Pressure"),
    "p");
  EXPECT_TRUE(flowDefaultsAt({ scalar("T", 20, 50) }, pressureOfRoom).arrays.empty());
  EXPECT_EQ(flowDefaultsAt({ scalar("T [degC]", 20, 50) }, pressureOfRoom).message,
    "Air; temperature: 'T [degC]' in degrees Celsius; pressure: 101325 Pa everywhere.");
}
