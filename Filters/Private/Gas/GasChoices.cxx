// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/GasChoices.h"

#include "Common/Sentences.h"
#include "Gas/ArrayNames.h"
#include "Gas/RefractivityModels.h"
#include "MediumSettings.h"
#include "NumberText.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <locale>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace filters
{

namespace
{

/// Relative difference of equal wavelengths: more than the 3e-4 between air and vacuum.
constexpr double sameWavelength = 1e-3;

std::string nanometres(double metres)
{
  char text[32];
  std::snprintf(text, sizeof text, "%g", 1e9 * metres);
  return text;
}

bool isMeasuredNear(const schlieren::Gas& gas, double wavelength)
{
  return gas.shortestWavelength * (1 - sameWavelength) <= wavelength &&
    wavelength <= gas.longestWavelength * (1 + sameWavelength);
}

std::string noteOn(const schlieren::Gas& gas, double wavelength)
{
  const std::string name(gas.name), source(gas.source),
    shortest = nanometres(gas.shortestWavelength);
  if (!gas.disperses())
  {
    return "The constant of " + name + " is known at " + shortest + " nm alone and is used at " +
      nanometres(wavelength) + " nm too, though it may be some percent off there (" + source + ").";
  }
  return "Wavelength is " + nanometres(wavelength) + " nm, but the constant of " + name +
    " was measured from " + shortest + " to " + nanometres(gas.longestWavelength) +
    " nm and is continued from there (" + source + ").";
}

/// Lists the names of the gases that the index model uses.
std::vector<std::string> namesUsed(const MediumSettings& settings)
{
  switch (kindOf(settings.IndexModel).gases)
  {
    case IndexGases::One:
      return settings.GladstoneDaleConstant == 0 ? std::vector{ settings.Gas }
                                                 : std::vector<std::string>{};
    case IndexGases::Mixture:
    {
      std::vector<std::string> names = settings.MixtureGases;
      names.push_back(settings.BackgroundGas);
      return names;
    }
    case IndexGases::None:
    case IndexGases::MoistAir:
    case IndexGases::Water:
      break;
  }
  return {};
}

std::string notInTable(const std::string& property, const std::string& name)
{
  return property + " holds '" + name + "', which is not in the table of gases.";
}

std::string allGases()
{
  std::string names;
  for (const schlieren::Gas& gas : schlieren::gases())
  {
    names +=
      (names.empty() ? "" : ", ") + std::string(gas.name) + " (" + std::string(gas.formula) + ")";
  }
  return names;
}

/// Reads a constant and, after spaces, a molar mass, with a decimal point in any locale. Returns how
/// many numbers the text consists of; 0 for any other text.
int readNumbers(const std::string& text, schlieren::Component& component)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  if (!(in >> component.constant))
  {
    return 0;
  }
  if ((in >> std::ws).eof())
  {
    return 1;
  }
  const bool isRead = static_cast<bool>(in >> component.molarMass);
  return isRead && (in >> std::ws).eof() ? 2 : 0;
}

} // namespace

std::string gasOf(const std::string& word)
{
  const std::string name = lowered(word);
  const bool isOfOneCase = word.size() > 1 &&
    (word == name ||
      std::none_of(
        word.begin(), word.end(), [](unsigned char letter) { return std::islower(letter) != 0; }));
  for (const schlieren::Gas& gas : schlieren::gases())
  {
    if (gas.formula == word || gas.name == name ||
      (isOfOneCase && lowered(std::string(gas.formula)) == name))
    {
      return std::string(gas.name == name ? gas.name : gas.formula);
    }
  }
  return "";
}

double constantFrom(const MediumSettings& settings)
{
  if (settings.GladstoneDaleConstant != 0)
  {
    return settings.GladstoneDaleConstant;
  }
  if (settings.Gas == waterName)
  {
    throw std::runtime_error(
      "Gas is water, of which a density hardly gives the index. Set IndexModel to Water, or to "
      "Auto, which takes its temperature.");
  }
  const schlieren::Gas* gas = schlieren::findGas(settings.Gas);
  if (!gas)
  {
    throw std::runtime_error(notInTable("Gas", settings.Gas) + " Choose one of: " + allGases() +
      ", or set GladstoneDaleConstant.");
  }
  return gas->constantAt(wavelengthOfGases(settings));
}

schlieren::Component componentFrom(
  const std::string& property, const std::string& text, const MediumSettings& settings)
{
  if (const schlieren::Gas* gas = schlieren::findGas(text))
  {
    return { gas->constantAt(wavelengthOfGases(settings)), gas->molarMass };
  }
  schlieren::Component component{};
  const int count = readNumbers(text, component);
  if (count == 0)
  {
    throw std::runtime_error(notInTable(property, text) + " Give one of: " + allGases() +
      "; or numbers: the Gladstone-Dale constant in m^3/kg and, for volume fractions, a space and "
      "the molar mass in kg/mol, such as 2.3e-4 0.044.");
  }
  if (count == 1 && (settings.FractionType == 1 || settings.usesGasLaw()))
  {
    throw std::runtime_error(property + " holds '" + text + "', a gas without a molar mass, " +
      (settings.usesGasLaw()
          ? "which the density of a mixture by its temperature and pressure needs. Add it in "
            "kg/mol, such as " +
            text + " 0.044, or choose an array for Density."
          : "by which volume fractions weigh. Add it in kg/mol, such as " + text +
            " 0.044, or set FractionType to Mass."));
  }
  if (component.constant < 0 || component.molarMass <= 0)
  {
    throw std::runtime_error(property + " holds '" + text +
      "', but a Gladstone-Dale constant is not negative, and a molar mass is positive. Give them "
      "in m^3/kg and kg/mol (air: 2.26e-4 0.02896).");
  }
  return component;
}

double wavelengthOfGases(const MediumSettings& settings)
{
  if (!std::isfinite(settings.Wavelength) || settings.Wavelength <= 0)
  {
    throw std::runtime_error("Wavelength is " + textOf(settings.Wavelength) +
      " nm, but a wavelength is positive. Set it to that of the light (helium-neon laser: 632.8).");
  }
  return 1e-9 * settings.Wavelength;
}

bool usesWavelength(const MediumSettings& settings)
{
  const std::vector<std::string> names = namesUsed(settings);
  const IndexGases gases = kindOf(settings.IndexModel).gases;
  return gases == IndexGases::MoistAir || gases == IndexGases::Water ||
    kindOf(settings.IndexModel).arrays == IndexArrays::Electrons ||
    std::any_of(names.begin(), names.end(), schlieren::findGas);
}

std::string noteOnGases(const MediumSettings& settings)
{
  std::string notes;
  std::set<std::string_view> reported;
  for (const std::string& name : namesUsed(settings))
  {
    const schlieren::Gas* gas = schlieren::findGas(name);
    const double wavelength = 1e-9 * settings.Wavelength;
    if (gas && !isMeasuredNear(*gas, wavelength) && reported.insert(gas->name).second)
    {
      addText(notes, noteOn(*gas, wavelength));
    }
  }
  return notes;
}

} // namespace filters
