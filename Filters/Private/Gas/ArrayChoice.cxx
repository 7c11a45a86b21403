// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/ArrayChoice.h"

#include "Common/Sentences.h"
#include "Gas/ArrayNames.h"
#include "Gas/Fractions.h"
#include "Gas/GasChoices.h"
#include "Gas/RefractivityModels.h"
#include "NumberText.h"

#include <algorithm>
#include <cstdio>

namespace filters
{

namespace
{

using S = MediumSettings;

/// Returns whether the user has left an array open that the model needs.
bool lacksArrays(const MediumSettings& settings)
{
  if (settings.IndexModel == S::GLADSTONE_DALE_MIXTURE)
  {
    return !settings.Arrays[S::DensityArray].isChosen();
  }
  const std::vector<std::size_t> needed = arraysOfModel(settings);
  return std::any_of(needed.begin(), needed.end(),
    [&](std::size_t index)
    { return index != S::HumidityArray && !settings.Arrays[index].isChosen(); });
}

double scaleIn(const FlowDefaults& defaults, const std::string& property)
{
  for (const auto& [name, scale] : defaults.scales)
  {
    if (name == property)
    {
      return scale;
    }
  }
  return 0;
}

std::string inWords(const MediumSettings& settings)
{
  std::string text;
  for (const std::size_t index : arraysOfModel(settings))
  {
    const ArraySelection& selection = settings.Arrays[index];
    if (!selection.isNamed())
    {
      continue;
    }
    text += (text.empty() ? "" : "; ") + std::string(S::arrayProperties[index]) + ": '" +
      selection.name + "'";
    const double scale = index == S::DensityArray ? settings.DensityScale
      : index == S::TemperatureArray              ? kelvinsOf(settings)
      : index == S::PressureArray                 ? settings.PressureScale
      : index == S::IndexArray                    ? perCubicMetreOf(settings)
                                                  : 1;
    if (scale != 1)
    {
      char factor[32];
      std::snprintf(factor, sizeof factor, " times %g", scale);
      text += factor;
    }
    const double zero = index == S::TemperatureArray ? zeroOf(settings) : 0;
    text += zero > 0 ? " plus " + textOf(zero) : "";
  }
  if (settings.hasUniformPressure())
  {
    text += "; pressure: " + textOf(settings.UniformPressure, 6) + " Pa everywhere";
  }
  for (std::size_t i = 0; kindOf(settings.IndexModel).gases == IndexGases::Mixture &&
       i < settings.MixtureArrays.size();
       ++i)
  {
    text += (i > 0 ? ", '" : "; fractions: '") + settings.MixtureArrays[i] + "'";
  }
  text += settings.usesGasLaw() ? "; density: that of an ideal gas" : "";
  if (settings.Arrays[S::MaskArray].isNamed())
  {
    text += (text.empty() ? "" : "; ") + std::string("Mask: '") +
      settings.Arrays[S::MaskArray].name + "'";
  }
  return text.empty() ? text : text + ".";
}

} // namespace

std::vector<std::size_t> arraysOfModel(const MediumSettings& settings)
{
  switch (kindOf(settings.IndexModel).arrays)
  {
    case IndexArrays::Air:
      if (settings.hasUniformPressure())
      {
        return { S::TemperatureArray, S::HumidityArray };
      }
      return { S::TemperatureArray, S::PressureArray, S::HumidityArray };
    case IndexArrays::Fields:
      return {};
    case IndexArrays::Temperature:
      return { S::TemperatureArray };
    case IndexArrays::Index:
      return { S::IndexArray };
    case IndexArrays::Electrons:
      return settings.Arrays[S::DensityArray].isNamed()
        ? std::vector<std::size_t>{ S::IndexArray, S::DensityArray }
        : std::vector<std::size_t>{ S::IndexArray };
    case IndexArrays::Density:
      break;
  }
  if (settings.hasUniformPressure())
  {
    return { S::TemperatureArray };
  }
  return settings.usesGasLaw() ? std::vector<std::size_t>{ S::TemperatureArray, S::PressureArray }
                               : std::vector<std::size_t>{ S::DensityArray };
}

double kelvinsOf(const MediumSettings& settings)
{
  const double byUnit = scaleByUnit("Temperature", settings.Arrays[S::TemperatureArray].name);
  return byUnit != 0 ? byUnit : 1;
}

double zeroOf(const MediumSettings& settings)
{
  return ArrayName(settings.Arrays[S::TemperatureArray].name).ZeroInKelvins();
}

double perCubicMetreOf(const MediumSettings& settings)
{
  const std::string& name = settings.Arrays[S::IndexArray].name;
  return kindOf(settings.IndexModel).arrays == IndexArrays::Electrons &&
      ArrayName(name).HasUnit(Quantity::Electrons)
    ? scaleByUnit("IndexArray", name)
    : 1;
}

bool isOpen(const MediumSettings& settings)
{
  return settings.IndexModel == S::AUTO ||
    (settings.IndexModel == S::GLADSTONE_DALE_MIXTURE && settings.MixtureArrays.empty()) ||
    lacksArrays(settings) || !settings.Arrays[S::MaskArray].isChosen();
}

namespace
{

/// Finds the index model, if open, and arrays for the selections that the user has left open. Returns what is known of
/// the arrays, and sets the note of what is missing.
FlowDefaults chooseArrays(
  const MediumSettings& given, const std::vector<FlowArray>& known, MediumChoice& choice)
{
  MediumSettings& settings = choice.settings;
  const bool isAuto = given.IndexModel == S::AUTO;
  const std::vector<FlowArray> arrays =
    given.UniformPressure > 0 ? withUniformPressure(known, given.UniformPressure) : known;
  FlowDefaults defaults;
  if (isAuto && !settings.Arrays[S::DensityArray].isChosen() && given.MixtureArrays.empty())
  {
    defaults = flowDefaults(arrays);
    settings.IndexModel = defaults.indexModel;
  }
  else
  {
    settings.IndexModel = !isAuto   ? given.IndexModel
      : given.MixtureArrays.empty() ? S::GLADSTONE_DALE
                                    : S::GLADSTONE_DALE_MIXTURE;
    if (lacksArrays(settings))
    {
      defaults =
        flowDefaults(arrays, static_cast<MediumSettings::IndexModels>(settings.IndexModel));
    }
  }
  if (settings.IndexModel == S::GLADSTONE_DALE_MIXTURE && lacksArrays(settings))
  {
    // With a temperature and without a density, it is a model of the gas law.
    ArraySelection& temperature = settings.Arrays[S::TemperatureArray];
    const bool isLaw = defaults.arrayOf("Density").empty();
    temperature = !isLaw       ? ArraySelection()
      : temperature.isChosen() ? temperature
                               : ArraySelection{ defaults.arrayOf("Temperature"), -1,
                                   defaults.association == FlowArray::Cells };
  }
  ArraySelection& density = settings.Arrays[S::DensityArray];
  if (isAuto && settings.IndexModel == S::ELECTRON_DENSITY && !density.isChosen())
  {
    density = { defaults.arrayOf("Density"), -1, defaults.association == FlowArray::Cells };
  }
  for (const std::size_t index : arraysOfModel(settings))
  {
    ArraySelection& selection = settings.Arrays[index];
    // Without an array, the value of the property RelativeHumidity is used.
    if (selection.isChosen() || (index == S::HumidityArray && !isAuto))
    {
      continue;
    }
    selection.name = defaults.arrayOf(S::arrayProperties[index]);
    selection.cellsFirst = defaults.association == FlowArray::Cells;
    if (selection.name.empty() && index != S::HumidityArray)
    {
      choice.note = defaults.note;
    }
  }
  return defaults;
}

FlowArray::Association associationIn(const MediumSettings& settings)
{
  return settings.Arrays[arraysOfModel(settings)[0]].cellsFirst ? FlowArray::Cells
                                                                : FlowArray::Points;
}

/// Returns a note on what the choice leaves out of the data.
std::string noteOnArrays(
  const MediumSettings& given, const std::vector<FlowArray>& known, const MediumSettings& settings)
{
  std::string note = noteOnOverset(known);
  // What the user has chosen needs no note. The window chooses as flowSpecies() does.
  const IndexGases gases = kindOf(settings.IndexModel).gases;
  if (gases == IndexGases::None || gases == IndexGases::Water || given.hasOneGas() ||
    (!given.MixtureArrays.empty() &&
      given.MixtureArrays != flowSpecies(known, associationIn(settings)).fractions))
  {
    return note;
  }
  addText(note, noteOnFractions(known, settings.MixtureArrays));
  return note;
}

/// Takes mass or volume fractions as a mixture, unless the user has chosen one gas.
void chooseMixture(
  const MediumSettings& given, const std::vector<FlowArray>& known, MediumSettings& settings)
{
  const bool isAuto = given.IndexModel == S::AUTO;
  const bool isOneGas = given.hasOneGas();
  const bool mayBeMixture = settings.IndexModel == S::GLADSTONE_DALE_MIXTURE ||
    (isAuto && settings.IndexModel == S::GLADSTONE_DALE && !isOneGas);
  if (isAuto && isOneGas && settings.IndexModel == S::GLADSTONE_DALE_MIXTURE &&
    given.MixtureArrays.empty())
  {
    settings.IndexModel = settings.usesGasLaw() ? S::CIDDOR : S::GLADSTONE_DALE;
  }
  else if (mayBeMixture && given.MixtureArrays.empty())
  {
    const FlowDefaults species =
      flowSpecies(known, associationIn(settings), !settings.usesGasLaw());
    if (!species.fractions.empty())
    {
      settings.IndexModel = S::GLADSTONE_DALE_MIXTURE;
      settings.MixtureArrays = species.fractions;
      settings.MixtureGases = given.MixtureGases.empty() ? species.gases : given.MixtureGases;
      settings.FractionType = species.ofVolume ? 1 : 0;
    }
  }
}

/// Takes electrons beside a density that the user has chosen.
void chooseElectrons(
  const MediumSettings& given, const std::vector<FlowArray>& known, MediumSettings& settings)
{
  if (given.IndexModel != S::AUTO || settings.IndexModel != S::GLADSTONE_DALE)
  {
    return;
  }
  const FlowDefaults electrons = flowDefaults(known, S::ELECTRON_DENSITY);
  if (!electrons.arrays.empty() && electrons.association == associationIn(settings))
  {
    settings.IndexModel = S::ELECTRON_DENSITY;
    settings.Arrays[S::IndexArray] = { electrons.arrayOf("IndexArray"), -1,
      electrons.association == FlowArray::Cells };
  }
}

/// Sets the factors to SI units.
void chooseScales(const MediumSettings& given, const FlowDefaults& defaults, MediumChoice& choice)
{
  MediumSettings& settings = choice.settings;
  const auto scaleOf = [&](std::size_t index, double scale)
  {
    const std::string property = S::arrayProperties[index];
    const std::string& name = settings.Arrays[index].name;
    const double byUnit = scaleByUnit(property, name);
    // A unit that is concluded from values, such as hPa, belongs to the default arrays only.
    const bool isOfDefaults = given.IndexModel == S::AUTO && name == defaults.arrayOf(property);
    const double byValues = isOfDefaults ? scaleIn(defaults, property + "Scale") : 0;
    choice.isScaleKnown = scale != 0 || byUnit != 0 || byValues != 0;
    return scale != 0 ? scale : byUnit != 0 ? byUnit : byValues != 0 ? byValues : 1;
  };
  const IndexArrays arrays = kindOf(settings.IndexModel).arrays;
  if (arrays == IndexArrays::Air || settings.usesGasLaw())
  {
    settings.PressureScale = scaleOf(S::PressureArray, given.PressureScale);
  }
  else if (arrays == IndexArrays::Density || arrays == IndexArrays::Electrons)
  {
    settings.DensityScale = scaleOf(S::DensityArray, given.DensityScale);
  }
}

} // namespace

MediumChoice choiceOf(const MediumSettings& all, const std::vector<FlowArray>& known)
{
  MediumSettings given = all;
  if (given.IndexModel == S::AUTO && given.Gas == waterName)
  {
    given.IndexModel = S::WATER;
  }
  MediumChoice choice;
  choice.settings = given;
  MediumSettings& settings = choice.settings;
  const FlowDefaults defaults = chooseArrays(given, known, choice);
  chooseMixture(given, known, settings);
  chooseElectrons(given, known, settings);
  chooseScales(given, defaults, choice);
  ArraySelection& mask = settings.Arrays[S::MaskArray];
  if (!mask.isChosen())
  {
    const MaskDefault found = flowMask(known);
    mask = { found.array, -1, found.association == FlowArray::Cells };
  }
  // Clears the selections that the model does not read, so that they do not affect comparisons.
  const std::vector<std::size_t> read = arraysOfModel(settings);
  for (std::size_t index = 0; index < settings.Arrays.size(); ++index)
  {
    if (index != S::MaskArray && std::find(read.begin(), read.end(), index) == read.end())
    {
      settings.Arrays[index] = {};
    }
  }
  if (!usesWavelength(settings))
  {
    settings.Wavelength = S().Wavelength; // nor does that of light that nothing disperses
  }
  choice.message = inWords(settings);
  choice.warning = noteOnArrays(given, known, settings);
  return choice;
}

} // namespace filters
