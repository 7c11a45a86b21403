// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ArrayChoice.h"

#include "GasChoices.h"
#include "RefractivityValues.h"
#include "vtkRefractiveIndex.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

using Index = vtkRefractiveIndex;

const char* const properties[] = { "Density", "IndexArray", "Temperature", "Pressure", "Humidity" };

/// By the user.
bool isChosen(const Selection& selection)
{
  return !selection.name.empty() || selection.attribute >= 0;
}

/// A mixture needs densities and fractions, moist air three arrays.
std::vector<int> arraysOfModel(int model)
{
  switch (model)
  {
    case Index::CIDDOR:
      return { Index::TEMPERATURE, Index::PRESSURE, Index::HUMIDITY };
    case Index::TRANSFER_FUNCTIONS:
      return {};
    case Index::REFRACTIVE_INDEX:
    case Index::REFRACTIVITY:
      return { Index::INDEX_ARRAY };
    default:
      return { Index::DENSITY };
  }
}

/// The arrays that the user has chosen.
void takeGiven(vtkRefractiveIndex* self, MediumChoice& choice)
{
  for (int index = 0; index < static_cast<int>(choice.arrays.size()); ++index)
  {
    choice.arrays[static_cast<std::size_t>(index)] = selectionFrom(self, index, properties[index]);
  }
}

/// Whether an array that its model needs is not chosen.
bool lacksArrays(const MediumChoice& choice)
{
  const std::vector<int> needed = arraysOfModel(choice.indexModel);
  return std::any_of(needed.begin(), needed.end(),
    [&](int index) {
      return index != Index::HUMIDITY && !isChosen(choice.arrays[static_cast<std::size_t>(index)]);
    });
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

std::string inWords(const MediumChoice& choice)
{
  std::string text;
  for (const int index : arraysOfModel(choice.indexModel))
  {
    const Selection& selection = choice.arrays[static_cast<std::size_t>(index)];
    if (selection.name.empty() || selection.name == "None")
    {
      continue;
    }
    text += (text.empty() ? "" : "; ") + selection.property + ": '" + selection.name + "'";
    const double scale = index == Index::DENSITY ? choice.densityScale
      : index == Index::TEMPERATURE              ? choice.temperatureScale
      : index == Index::PRESSURE                 ? choice.pressureScale
                                                 : 1;
    if (scale != 1)
    {
      char factor[32];
      std::snprintf(factor, sizeof factor, " times %g", scale);
      text += factor;
    }
  }
  for (std::size_t i = 0; i < choice.mixtureArrays.size(); ++i)
  {
    text += (i > 0 ? ", '" : "; fractions: '") + choice.mixtureArrays[i] + "'";
  }
  return text.empty() ? text : text + ".";
}

} // namespace

//------------------------------------------------------------------------------
std::vector<FlowArray> KnownArrays::Get() const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Arrays;
}

//------------------------------------------------------------------------------
void KnownArrays::Note(std::vector<FlowArray> arrays)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (!this->AreAll)
  {
    this->Arrays = std::move(arrays);
  }
}

//------------------------------------------------------------------------------
void KnownArrays::SetOfRanks(std::vector<FlowArray> arrays)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Arrays = std::move(arrays);
  this->AreAll = true;
}

//------------------------------------------------------------------------------
bool KnownArrays::AreOfRanks() const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->AreAll;
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
bool MediumChoice::hasHumidity() const
{
  const std::string& name = this->arrays[Index::HUMIDITY].name;
  return !name.empty() && name != "None";
}

//------------------------------------------------------------------------------
bool isOpen(vtkRefractiveIndex* self)
{
  const int model = self->GetIndexModel();
  if (model == Index::AUTO ||
    (model == Index::GLADSTONE_DALE_MIXTURE && self->GetMixtureArrays().empty()))
  {
    return true;
  }
  MediumChoice choice;
  choice.indexModel = model;
  takeGiven(self, choice);
  return lacksArrays(choice);
}

//------------------------------------------------------------------------------
void noteArrays(vtkRefractiveIndex* self, const std::vector<vtkDataSet*>& data)
{
  if (!isOpen(self) || self->GetKnownArrays()->AreOfRanks())
  {
    return;
  }
  self->GetKnownArrays()->Note(flowArraysOf(data, false));
}

//------------------------------------------------------------------------------
MediumChoice choiceOf(vtkRefractiveIndex* self)
{
  const std::vector<FlowArray> known = self->GetKnownArrays()->Get();
  MediumChoice choice;
  takeGiven(self, choice);
  choice.mixtureArrays = self->GetMixtureArrays();
  choice.mixtureGases = self->GetMixtureGases();
  choice.fractionType = self->GetFractionType();
  const Selection& density = choice.arrays[Index::DENSITY];
  const bool isAuto = self->GetIndexModel() == Index::AUTO;
  FlowDefaults defaults;
  if (isAuto && !isChosen(density) && choice.mixtureArrays.empty())
  {
    defaults = flowDefaults(known);
    choice.indexModel = defaults.indexModel;
  }
  else
  {
    choice.indexModel = !isAuto      ? self->GetIndexModel()
      : choice.mixtureArrays.empty() ? static_cast<int>(Index::GLADSTONE_DALE)
                                     : static_cast<int>(Index::GLADSTONE_DALE_MIXTURE);
    if (lacksArrays(choice))
    {
      defaults = flowDefaults(known, static_cast<FlowDefaults::IndexModel>(choice.indexModel));
    }
  }
  // Arrays that are not chosen.
  for (const int index : arraysOfModel(choice.indexModel))
  {
    Selection& selection = choice.arrays[static_cast<std::size_t>(index)];
    // Without an array RelativeHumidity counts.
    if (isChosen(selection) || (index == Index::HUMIDITY && !isAuto))
    {
      continue;
    }
    selection.name = defaults.arrayOf(selection.property);
    selection.cellsFirst = defaults.association == FlowArray::Cells;
    if (selection.name.empty() && index != Index::HUMIDITY)
    {
      choice.note = defaults.note;
    }
  }
  // The gases of a density: with a gas of the user's own there is no mixture.
  const bool isOneGas = !isCustom(self->GetGas()) ||
    self->GetGladstoneDaleConstant() != Index::DefaultGladstoneDaleConstant;
  const bool mayBeMixture = choice.indexModel == Index::GLADSTONE_DALE_MIXTURE ||
    (isAuto && choice.indexModel == Index::GLADSTONE_DALE && !isOneGas);
  if (isAuto && isOneGas && choice.indexModel == Index::GLADSTONE_DALE_MIXTURE &&
    choice.mixtureArrays.empty())
  {
    choice.indexModel = Index::GLADSTONE_DALE;
  }
  else if (mayBeMixture && choice.mixtureArrays.empty())
  {
    const FlowDefaults species =
      flowSpecies(known, density.cellsFirst ? FlowArray::Cells : FlowArray::Points);
    if (!species.fractions.empty())
    {
      choice.indexModel = Index::GLADSTONE_DALE_MIXTURE;
      choice.mixtureArrays = species.fractions;
      choice.mixtureGases = choice.mixtureGases.empty() ? species.gases : choice.mixtureGases;
      choice.fractionType = species.ofVolume ? Index::VOLUME : Index::MASS;
    }
  }
  // Factors to SI units.
  const auto scaleOf = [&](int index, double given)
  {
    const Selection& selection = choice.arrays[static_cast<std::size_t>(index)];
    const double byUnit = scaleByUnit(selection.property, selection.name);
    // What is guessed by values, as hPa are, belongs to arrays that were not chosen.
    const bool isOfDefaults = isAuto && selection.name == defaults.arrayOf(selection.property);
    const double byValues = isOfDefaults ? scaleIn(defaults, selection.property + "Scale") : 0;
    const bool isKnown = given != 0 || byUnit != 0 || byValues != 0;
    choice.isScaleKnown = choice.isScaleKnown || isKnown;
    return given != 0 ? given : byUnit != 0 ? byUnit : byValues != 0 ? byValues : 1;
  };
  if (choice.indexModel == Index::CIDDOR)
  {
    choice.temperatureScale = scaleOf(Index::TEMPERATURE, self->GetTemperatureScale());
    choice.isScaleKnown = false; // that of the pressure counts
    choice.pressureScale = scaleOf(Index::PRESSURE, self->GetPressureScale());
  }
  else if (choice.indexModel == Index::GLADSTONE_DALE ||
    choice.indexModel == Index::GLADSTONE_DALE_MIXTURE)
  {
    choice.densityScale = scaleOf(Index::DENSITY, self->GetDensityScale());
  }
  choice.message = inWords(choice);
  return choice;
}

//------------------------------------------------------------------------------
Implausible implausibleIn(vtkRefractiveIndex* self, const Source& source)
{
  const MediumChoice choice = choiceOf(self);
  if (source.isComputed || choice.indexModel == Index::TRANSFER_FUNCTIONS)
  {
    return {};
  }
  const bool isMoistAir = choice.indexModel == Index::CIDDOR;
  FlowInUse flow;
  flow.indexModel = static_cast<FlowDefaults::IndexModel>(choice.indexModel);
  flow.isScaleGiven = choice.isScaleKnown;
  flow.scales = isMoistAir ? std::vector<double>{ choice.temperatureScale, choice.pressureScale }
                           : std::vector<double>{ choice.densityScale };
  const bool isOfTable = !isCustom(self->GetGas());
  flow.isGas = choice.indexModel == Index::GLADSTONE_DALE_MIXTURE || isOfTable ||
    self->GetGladstoneDaleConstant() == Index::DefaultGladstoneDaleConstant;
  if (isOfTable && choice.indexModel == Index::GLADSTONE_DALE)
  {
    flow.constant = self->GetGladstoneDaleConstantUsed();
  }
  const std::vector<int> indices = arraysOfModel(choice.indexModel);
  for (std::size_t i = 0; i < flow.scales.size(); ++i)
  {
    const Selection& selection = choice.arrays[static_cast<std::size_t>(indices[i])];
    FlowArray array{ selection.name, selection.cellsFirst ? FlowArray::Cells : FlowArray::Points, 1,
      { std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest() } };
    for (const Leaf& leaf : source.leaves)
    {
      double range[2];
      vtkUnsignedCharArray* ghosts =
        leaf.ofCells ? leaf.data->GetCellGhostArray() : leaf.data->GetPointGhostArray();
      ghosts ? leaf.arrays[i]->GetFiniteRange(range, 0, ghosts->GetPointer(0),
                 leaf.ofCells ? hiddenCellBits
                              : static_cast<unsigned char>(vtkDataSetAttributes::HIDDENPOINT))
             : leaf.arrays[i]->GetFiniteRange(range, 0);
      array.range[0] = std::min(array.range[0], range[0]);
      array.range[1] = std::max(array.range[1], range[1]);
      if (array.name.empty() && leaf.arrays[i]->GetName())
      {
        array.name = leaf.arrays[i]->GetName();
      }
    }
    flow.arrays.push_back(std::move(array));
  }
  return implausible(flow);
}

} // namespace filters
