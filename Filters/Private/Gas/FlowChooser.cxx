// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/FlowChooser.h"

#include "Gas/Fractions.h"
#include "Gas/RefractivityModels.h"
#include "NumberText.h"
#include "Schlieren.h"

#include <algorithm>
#include <iterator>

namespace filters
{

const std::set<std::string> indexNames = { "n", "ior", "refractiveindex", "indexofrefraction",
  "refractionindex" };
const std::set<std::string> humidityNames = { "rh", "humidity", "relativehumidity", "relhumidity" };

namespace
{

const std::set<std::string> refractivities = { "refractivity", "nminus1" };

/// Returns the unit of a quantity's values; `zero`: where it begins.
std::string unitInWords(double scale, const std::string& unit, double zero = 0)
{
  return zero > 0 ? std::string(" in degrees ") + (scale == 1 ? "Celsius" : "Fahrenheit")
    : scale == 1  ? " in " + unit
                  : ", " + textOf(scale) + " " + unit + " each";
}

} // namespace

std::string quoted(const std::string& name) { return "'" + name + "'"; }

std::string rangeInWords(const FlowArray& array)
{
  return textOf(array.range[0]) + " to " + textOf(array.range[1]);
}

bool isScalar(const FlowArray& array)
{
  return array.components == 1 && array.range[0] <= array.range[1];
}

FlowChooser::FlowChooser(const std::vector<FlowArray>& all)
{
  std::copy_if(all.begin(), all.end(), std::back_inserter(this->Arrays), isScalar);
}

bool FlowChooser::choose()
{
  return this->refractivity() || this->refractiveIndex() || this->density(true) ||
    this->electrons() || this->state(true);
}

bool FlowChooser::choose(MediumSettings::IndexModels model)
{
  this->Result.indexModel = model;
  const IndexModelKind& kind = kindOf(model);
  switch (kind.arrays)
  {
    case IndexArrays::Index:
      return model == MediumSettings::REFRACTIVE_INDEX ? this->refractiveIndex()
                                                       : this->refractivity();
    case IndexArrays::Air:
      return this->state(false);
    case IndexArrays::Temperature:
      return this->temperature();
    case IndexArrays::Electrons:
      return this->electrons();
    case IndexArrays::Density:
      return this->density(kind.gases == IndexGases::Mixture) ||
        (kind.gases == IndexGases::Mixture && this->state(true));
    case IndexArrays::Fields:
      break; // no names are known for them
  }
  return false;
}

void FlowChooser::chooseSpecies(FlowArray::Association association, bool withDensity)
{
  this->Result.association = association;
  this->species(withDensity);
}

bool FlowChooser::has(Quantity quantity) const
{
  return std::any_of(this->Arrays.begin(), this->Arrays.end(),
    [quantity](const FlowArray& array)
    { return array.components == 1 && ArrayName(array.name).As(quantity) != Understood::Not; });
}

FlowChooser::Found FlowChooser::find(Quantity quantity, FlowArray::Association association)
{
  Understood best = Understood::Not;
  Found found;
  std::string several; // arrays of species or components, none of which is the total
  int parts = 0;
  bool isOfPhase = false, isOfAir = false, areLiquids = false, areSpecies = false;
  for (const FlowArray& array : this->Arrays)
  {
    const ArrayName name(array.name);
    const Understood how = name.As(quantity);
    if (array.association != association || how == Understood::Not || isOfAnother(name, quantity))
    {
      continue;
    }
    if (how >= Understood::AsPart)
    {
      ++parts;
      several += (several.empty() ? "" : ", ") + quoted(array.name);
      areLiquids = areLiquids || name.IsOfLiquid();
      areSpecies = areSpecies || how == Understood::AsSpecies;
    }
    if (how < best)
    {
      best = how;
      isOfPhase = name.IsOfGas();
      isOfAir = name.Joined().find("air") != std::string::npos;
      const double scale = name.Scale(quantity);
      found = { &array, scale != 0 || name.HasUnit(quantity) ? scale : 1,
        quantity == Quantity::Temperature ? name.ZeroInKelvins() : 0 };
    }
  }
  if (best == Understood::AsSpecies || (best == Understood::AsPart && parts > 1) ||
    (isOfPhase && areLiquids) || (isOfAir && areSpecies))
  {
    if (found.array && best < Understood::AsPart)
    {
      ++parts;
      several = quoted(found.array->name) + ", " + several;
    }
    this->Note += (parts > 1 ? several + " are" : several + " is") +
      (quantity == Quantity::Density
          ? " of single species or phases: add their densities up, for instance with Calculator. "
          : " of single species or phases. ");
    return {};
  }
  return found;
}

bool FlowChooser::isOfAnother(const ArrayName& name, Quantity quantity)
{
  for (const Quantity other : { Quantity::Density, Quantity::Temperature, Quantity::Pressure })
  {
    if (other != quantity && name.HasUnitOf(other) && !name.HasUnitOf(quantity))
    {
      return true;
    }
  }
  return false;
}

const FlowArray* FlowChooser::find(const std::set<std::string>& names) const
{
  for (const FlowArray::Association association : associations)
  {
    for (const FlowArray& array : this->Arrays)
    {
      if (array.association == association && ArrayName(array.name).Is(names))
      {
        return &array;
      }
    }
  }
  return nullptr;
}

bool FlowChooser::refractivity()
{
  const FlowArray* array = this->find(refractivities);
  if (!array)
  {
    return false;
  }
  this->take(MediumSettings::REFRACTIVITY, array->association, { { "IndexArray", array->name } });
  this->Result.message = "Refractivity n - 1: " + quoted(array->name) + ".";
  return true;
}

bool FlowChooser::refractiveIndex()
{
  const FlowArray* array = this->find(indexNames);
  if (!array || array->range[0] < 0.9 || array->range[1] > 4.5)
  {
    return false;
  }
  this->take(
    MediumSettings::REFRACTIVE_INDEX, array->association, { { "IndexArray", array->name } });
  this->Result.message = "Refractive index n: " + quoted(array->name) + ".";
  return true;
}

bool FlowChooser::density(bool ofSpecies)
{
  Found found;
  for (const FlowArray::Association association : associations)
  {
    const Found other = this->find(Quantity::Density, association);
    const auto rank = [](const Found& one)
    { return one.array ? ArrayName(one.array->name).As(Quantity::Density) : Understood::Not; };
    found = rank(other) < rank(found) ? other : found;
  }
  if (!found.array)
  {
    return false;
  }
  this->Note.clear(); // it concerns the other association
  if (found.scale == 0)
  {
    found.scale = 1;
    this->Note += "The unit of " + quoted(found.array->name) +
      " is not known: set Density Scale, an advanced property. ";
  }
  this->take(
    this->Result.indexModel, found.array->association, { { "Density", found.array->name } });
  this->Result.message =
    "Density: " + quoted(found.array->name) + unitInWords(found.scale, "kg/m\xc2\xb3");
  if (found.scale != 1)
  {
    this->Result.scales = { { "DensityScale", found.scale } };
  }
  if (ofSpecies)
  {
    this->species(true);
  }
  this->Result.message += this->Result.fractions.empty() ? "; gas: air." : "; the rest: air.";
  if (ofSpecies && this->Result.fractions.empty())
  {
    this->electrons();
  }
  return true;
}

bool FlowChooser::electrons()
{
  constexpr double least = 1e6; // fewer are fractions, of neon, or are relative
  for (const FlowArray::Association association : associations)
  {
    const Found found = this->find(Quantity::Electrons, association);
    const bool isBesideGas = !this->Result.arrays.empty();
    if (!found.array || !(found.array->range[1] * found.scale > least) ||
      (isBesideGas && association != this->Result.association))
    {
      continue;
    }
    this->Result.indexModel = MediumSettings::ELECTRON_DENSITY;
    this->Result.association = association;
    this->Result.arrays.emplace_back("IndexArray", found.array->name);
    this->Result.message += (isBesideGas ? " Electron density: " : "Electron density: ") +
      quoted(found.array->name) + unitInWords(found.scale, "m\xe2\x81\xbb\xc2\xb3") + ".";
    return true;
  }
  return false;
}

void FlowChooser::species(bool withDensity)
{
  std::vector<Fraction> found;
  for (const FlowArray& array : this->Arrays)
  {
    const auto fraction = fractionOf(array);
    if (array.association == this->Result.association && fraction && !fraction->gas.empty() &&
      (withDensity || fraction->kind != FractionOf::Density))
    {
      found.push_back(*fraction);
    }
  }
  if (std::none_of(
        found.begin(), found.end(), [](const Fraction& fraction) { return fraction.isSure; }))
  {
    return;
  }
  // Uses fractions of one kind, and each gas once: files often have several kinds.
  const FractionOf kind = std::min_element(found.begin(), found.end(),
    [](const Fraction& a, const Fraction& b) {
      return a.kind < b.kind;
    })->kind;
  this->Result.ofVolume = kind == FractionOf::Volume;
  std::set<std::string> formulas;
  std::string list;
  for (const Fraction& fraction : found)
  {
    if (fraction.kind == kind &&
      formulas.insert(std::string(schlieren::findGas(fraction.gas)->formula)).second)
    {
      this->Result.fractions.push_back(fraction.array);
      this->Result.gases.push_back(fraction.gas);
      list += (list.empty() ? "" : ", ") + quoted(fraction.array);
    }
  }
  this->Result.indexModel = MediumSettings::GLADSTONE_DALE_MIXTURE;
  this->Result.message += kind == FractionOf::Density ? "; partial densities: "
    : this->Result.ofVolume                           ? "; volume fractions: "
                                                      : "; mass fractions: ";
  this->Result.message += list;
}

bool FlowChooser::areKelvins(const Found& temperature)
{
  const auto& range = temperature.array->range;
  const auto kelvins = [&](double value) { return value * temperature.scale + temperature.zero; };
  if (temperature.scale != 0 && kelvins(range[0]) >= 20 && kelvins(range[1]) >= 150)
  {
    return true;
  }
  const std::string& name = temperature.array->name;
  this->Note += "The temperature " + quoted(name) + " is not in kelvins (" +
    rangeInWords(*temperature.array) + "). If it is in degrees Celsius, say so in its name ('" +
    name + " [degC]'), or add 273.15 with Calculator. ";
  return false;
}

bool FlowChooser::temperature()
{
  for (const FlowArray::Association association : associations)
  {
    const Found found = this->find(Quantity::Temperature, association);
    if (found.array && this->areKelvins(found))
    {
      this->take(MediumSettings::WATER, association, { { "Temperature", found.array->name } });
      this->Result.message = "Water; temperature: " + quoted(found.array->name) +
        unitInWords(found.scale, "K", found.zero) + ".";
      return true;
    }
  }
  return false;
}

bool FlowChooser::state(bool ofSpecies)
{
  return std::any_of(std::begin(associations), std::end(associations),
    [this, ofSpecies](FlowArray::Association association)
    { return this->state(association, ofSpecies); });
}

bool FlowChooser::state(FlowArray::Association association, bool ofSpecies)
{
  const Found temperature = this->find(Quantity::Temperature, association);
  const Found pressure = this->find(Quantity::Pressure, association);
  const double kelvins = temperature.scale;
  double pascals = pressure.scale;
  if (!temperature.array || !pressure.array)
  {
    return false;
  }
  const auto& p = pressure.array->range;
  if (!this->areKelvins(temperature))
  {
    return false;
  }
  if (pascals == 0)
  {
    this->Note += "The unit of the pressure " + quoted(pressure.array->name) + " is not known. ";
    return false;
  }
  if (p[0] <= 0 || ArrayName(pressure.array->name).IsGauge())
  {
    this->Note += "The pressure " + quoted(pressure.array->name) + " is not an absolute one (" +
      rangeInWords(*pressure.array) + "): add what it counts from with Calculator. ";
    return false;
  }
  // Accepts the units of weather models where the values are those of the atmosphere.
  const auto& t = temperature.array->range;
  const bool isOfAtmosphere = t[0] * kelvins + temperature.zero > 150 &&
    t[1] * kelvins + temperature.zero < 350 && p[1] < 1100;
  const bool hasUnit = ArrayName(pressure.array->name).HasUnit(Quantity::Pressure);
  if (!hasUnit && isOfAtmosphere && p[1] > 500)
  {
    pascals = 100;
  }
  else if (!hasUnit && isOfAtmosphere && p[1] > 50 && p[1] < 110)
  {
    pascals = 1000;
  }
  this->take(MediumSettings::CIDDOR, association,
    { { "Temperature", temperature.array->name }, { "Pressure", pressure.array->name } });
  this->Result.message = "Temperature: " + quoted(temperature.array->name) +
    unitInWords(kelvins, "K", temperature.zero) + "; pressure: " + quoted(pressure.array->name) +
    unitInWords(pascals, "Pa");
  if (pascals != 1)
  {
    this->Result.scales.emplace_back("PressureScale", pascals);
  }
  if (ofSpecies)
  {
    this->species(false);
  }
  if (this->Result.fractions.empty())
  {
    this->Result.message = "Air; t" + this->Result.message.substr(1);
    this->humidity(association);
  }
  else
  {
    this->Result.message += "; the rest: air; density: that of an ideal gas";
  }
  this->Result.message += ".";
  return true;
}

void FlowChooser::humidity(FlowArray::Association association)
{
  constexpr double most = 1.05;
  for (const FlowArray& array : this->Arrays)
  {
    if (array.association == association && ArrayName(array.name).Is(humidityNames) &&
      array.range[0] >= 0 && array.range[1] <= most)
    {
      this->Result.arrays.emplace_back("Humidity", array.name);
      this->Result.message += "; relative humidity: " + quoted(array.name);
      return;
    }
  }
}

void FlowChooser::take(MediumSettings::IndexModels model, FlowArray::Association association,
  std::vector<std::pair<std::string, std::string>> arrays)
{
  this->Result.indexModel = model;
  this->Result.association = association;
  this->Result.arrays = std::move(arrays);
}

} // namespace filters
