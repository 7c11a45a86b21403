// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/GasChoices.h"

#include "MediumSettings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
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
  std::vector<std::string> names;
  if (settings.IndexModel == MediumSettings::GladstoneDale)
  {
    names = { settings.Gas };
  }
  else if (settings.IndexModel == MediumSettings::Mixture)
  {
    names = settings.MixtureGases;
    names.push_back(settings.BackgroundGas);
  }
  return names;
}

} // namespace

//------------------------------------------------------------------------------
bool isCustom(const std::string& name) { return name.empty() || name == "Custom"; }

//------------------------------------------------------------------------------
const schlieren::Gas* gasFrom(const std::string& property, const std::string& name)
{
  if (isCustom(name))
  {
    return nullptr;
  }
  if (const schlieren::Gas* found = schlieren::findGas(name))
  {
    return found;
  }
  std::string known;
  for (const schlieren::Gas& gas : schlieren::gases())
  {
    known += std::string(gas.name) + " (" + std::string(gas.formula) + "), ";
  }
  throw std::runtime_error(property + " holds '" + name +
    "', which is not in the table of gases. Choose one of: " + known + "or Custom.");
}

//------------------------------------------------------------------------------
double wavelengthOfGases(const MediumSettings& settings)
{
  if (!std::isfinite(settings.Wavelength) || settings.Wavelength <= 0)
  {
    throw std::runtime_error("Wavelength is " + std::to_string(settings.Wavelength) +
      " nm, but a wavelength is positive. Set it to that of the light (helium-neon laser: 632.8).");
  }
  return 1e-9 * settings.Wavelength;
}

//------------------------------------------------------------------------------
bool usesWavelength(const MediumSettings& settings)
{
  const std::vector<std::string> names = namesUsed(settings);
  return settings.IndexModel == MediumSettings::Ciddor ||
    !std::all_of(names.begin(), names.end(), isCustom);
}

//------------------------------------------------------------------------------
std::function<double(double)> dispersionOfGases(const MediumSettings& settings, double reference)
{
  if (settings.IndexModel == MediumSettings::Ciddor)
  {
    const auto at = [](double wavelength) { return schlieren::MoistAir::at(wavelength).dry; };
    return [at, whole = at(reference)](double wavelength) { return at(wavelength) / whole; };
  }
  const std::vector<std::string> names = namesUsed(settings);
  const schlieren::Gas* gas =
    names.empty() || isCustom(names.back()) ? nullptr : schlieren::findGas(names.back());
  if (!gas)
  {
    return nullptr;
  }
  return [gas, whole = gas->constantAt(reference)](double wavelength)
  { return gas->constantAt(wavelength) / whole; };
}

//------------------------------------------------------------------------------
std::string noteOnGases(const MediumSettings& settings)
{
  std::string notes;
  std::set<std::string_view> reported;
  for (const std::string& name : namesUsed(settings))
  {
    const schlieren::Gas* gas = isCustom(name) ? nullptr : schlieren::findGas(name);
    const double wavelength = 1e-9 * settings.Wavelength;
    if (gas && !isMeasuredNear(*gas, wavelength) && reported.insert(gas->name).second)
    {
      notes += (notes.empty() ? "" : " ") + noteOn(*gas, wavelength);
    }
  }
  return notes;
}

} // namespace filters
