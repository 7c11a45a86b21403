// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/ArrayChoice.h"

#include "Common/NumberText.h"
#include "Gas/GasChoices.h"
#include "Gas/RefractivityModels.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace filters
{

namespace
{

using S = MediumSettings;

/// Returns whether the user has left an array open that the model needs.
bool lacksArrays(const MediumSettings& settings)
{
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
                                                  : 1;
    if (scale != 1)
    {
      char factor[32];
      std::snprintf(factor, sizeof factor, " times %g", scale);
      text += factor;
    }
  }
  if (settings.hasUniformPressure())
  {
    text += "; pressure: " + textOf(settings.UniformPressure, 6) + " Pa everywhere";
  }
  if (settings.isIsentropic())
  {
    text += "; isentropic, at rest " + textOf(settings.StagnationTemperature, 6) + " K and " +
      textOf(settings.StagnationPressure, 6) + " Pa";
  }
  for (std::size_t i = 0; kindOf(settings.IndexModel).gases == IndexGases::Mixture &&
       i < settings.MixtureArrays.size();
       ++i)
  {
    text += (i > 0 ? ", '" : "; fractions: '") + settings.MixtureArrays[i] + "'";
  }
  if (settings.Arrays[S::MaskArray].isNamed())
  {
    text += (text.empty() ? "" : "; ") + std::string("Mask: '") +
      settings.Arrays[S::MaskArray].name + "'";
  }
  return text.empty() ? text : text + ".";
}

} // namespace

void KnownArrays::Note(std::vector<FlowArray> arrays)
{
  if (!this->AreAll)
  {
    this->Arrays = std::move(arrays);
  }
}

void KnownArrays::SetOfRanks(std::vector<FlowArray> arrays)
{
  this->Arrays = std::move(arrays);
  this->AreAll = true;
}

void addArrays(std::vector<FlowArray>& all, const std::vector<FlowArray>& more)
{
  for (const FlowArray& array : more)
  {
    const auto same = std::find_if(all.begin(), all.end(),
      [&array](const FlowArray& other)
      { return other.name == array.name && other.association == array.association; });
    if (same == all.end())
    {
      all.push_back(array);
      continue;
    }
    same->components = std::max(same->components, array.components);
    same->range[0] = std::min(same->range[0], array.range[0]);
    same->range[1] = std::max(same->range[1], array.range[1]);
  }
}

std::vector<FlowArray> flowArraysOf(const std::vector<vtkDataSet*>& data, bool hasRanges)
{
  std::vector<FlowArray> all;
  for (vtkDataSet* set : data)
  {
    std::vector<FlowArray> ofSet;
    for (const FlowArray::Association association : { FlowArray::Points, FlowArray::Cells })
    {
      vtkDataSetAttributes* attributes = set->GetAttributes(association);
      for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      {
        vtkDataArray* array = attributes->GetArray(i);
        if (!array || !array->GetName() || array->GetNumberOfTuples() == 0)
        {
          continue;
        }
        FlowArray described{ array->GetName(), association, array->GetNumberOfComponents(),
          { 0, 0 } };
        if (described.components == 1 && (hasRanges || dependsOnRange(described.name)))
        {
          array->GetFiniteRange(described.range.data(), 0);
        }
        ofSet.push_back(std::move(described));
      }
    }
    addArrays(all, ofSet);
  }
  return all;
}

void putArrays(const std::vector<FlowArray>& arrays, std::vector<char>& message)
{
  put(static_cast<std::uint64_t>(arrays.size()), message);
  for (const FlowArray& array : arrays)
  {
    putAll(array.name, message);
    put(array.association, message);
    put(array.components, message);
    put(array.range, message);
  }
}

std::vector<FlowArray> getArrays(Reader& message)
{
  std::vector<FlowArray> arrays;
  const auto count = message.Get<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    FlowArray& array = arrays.emplace_back();
    array.name = message.GetAll<std::string>();
    array.association = message.Get<FlowArray::Association>();
    array.components = message.Get<int>();
    array.range = message.Get<std::array<double, 2>>();
  }
  return arrays;
}

std::vector<std::size_t> arraysOfModel(const MediumSettings& settings)
{
  switch (kindOf(settings.IndexModel).arrays)
  {
    case IndexArrays::Air:
      if (settings.hasUniformPressure())
      {
        return { S::TemperatureArray, S::HumidityArray };
      }
      if (settings.isIsentropic())
      {
        return { S::PressureArray, S::HumidityArray };
      }
      return { S::TemperatureArray, S::PressureArray, S::HumidityArray };
    case IndexArrays::Fields:
      return {};
    case IndexArrays::Index:
      return { S::IndexArray };
    case IndexArrays::Density:
      break;
  }
  return { S::DensityArray };
}

double kelvinsOf(const MediumSettings& settings)
{
  const double byUnit = scaleByUnit("Temperature", settings.Arrays[S::TemperatureArray].name);
  return byUnit != 0 ? byUnit : 1;
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
  const std::vector<FlowArray> arrays = given.UniformPressure > 0
    ? withUniformPressure(known, given.UniformPressure)
    : given.StagnationTemperature > 0 ? withStagnation(known, given.StagnationTemperature)
                                      : known;
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

/// Takes mass or volume fractions as a mixture, unless the user has chosen one gas.
void chooseMixture(
  const MediumSettings& given, const std::vector<FlowArray>& known, MediumSettings& settings)
{
  const bool isAuto = given.IndexModel == S::AUTO;
  // A gas of the user's own excludes mixtures.
  const bool isOneGas =
    !isCustom(given.Gas) || given.GladstoneDaleConstant != MediumSettings::defaultConstant;
  const bool mayBeMixture = settings.IndexModel == S::GLADSTONE_DALE_MIXTURE ||
    (isAuto && settings.IndexModel == S::GLADSTONE_DALE && !isOneGas);
  if (isAuto && isOneGas && settings.IndexModel == S::GLADSTONE_DALE_MIXTURE &&
    given.MixtureArrays.empty())
  {
    settings.IndexModel = S::GLADSTONE_DALE;
  }
  else if (mayBeMixture && given.MixtureArrays.empty())
  {
    const FlowDefaults species = flowSpecies(
      known, settings.Arrays[S::DensityArray].cellsFirst ? FlowArray::Cells : FlowArray::Points);
    if (!species.fractions.empty())
    {
      settings.IndexModel = S::GLADSTONE_DALE_MIXTURE;
      settings.MixtureArrays = species.fractions;
      settings.MixtureGases = given.MixtureGases.empty() ? species.gases : given.MixtureGases;
      settings.FractionType = species.ofVolume ? 1 : 0;
    }
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
  if (arrays == IndexArrays::Air)
  {
    settings.PressureScale = scaleOf(S::PressureArray, given.PressureScale);
  }
  else if (arrays == IndexArrays::Density)
  {
    settings.DensityScale = scaleOf(S::DensityArray, given.DensityScale);
  }
}

} // namespace

MediumChoice choiceOf(const MediumSettings& given, const std::vector<FlowArray>& known)
{
  MediumChoice choice;
  choice.settings = given;
  MediumSettings& settings = choice.settings;
  const FlowDefaults defaults = chooseArrays(given, known, choice);
  chooseMixture(given, known, settings);
  chooseScales(given, defaults, choice);
  ArraySelection& mask = settings.Arrays[S::MaskArray];
  if (!mask.isChosen())
  {
    const MaskDefault found = flowMask(known);
    mask = { found.array, -1, found.association == FlowArray::Cells };
  }
  if (settings.MaskedSide < 0)
  {
    settings.MaskedSide = marksGas(mask.name) ? 1 : 0;
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
  return choice;
}

} // namespace filters
