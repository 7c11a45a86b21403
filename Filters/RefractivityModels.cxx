// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityModels.h"

#include "ArrayChoice.h"
#include "GasChoices.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRefractiveIndex.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

namespace filters
{

namespace
{

/// Fractions (and relative humidities) above 1 by more than rounding and interpolation explain.
constexpr double maxOfAll = 1.01;

std::string textOf(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void requireFinite(const std::string& name, double value)
{
  if (!std::isfinite(value))
  {
    throw std::runtime_error(name + " is not a finite number. Set it to one.");
  }
}

void requireConstant(const std::string& name, double value)
{
  requireFinite(name, value);
  if (value < 0)
  {
    throw std::runtime_error(name + " holds " + textOf(value) +
      ", but a Gladstone-Dale constant is not negative. Give it in m^3/kg (air: 2.26e-4).");
  }
}

void requireMolarMass(const std::string& name, double value)
{
  requireFinite(name, value);
  if (value <= 0)
  {
    throw std::runtime_error(name + " holds " + textOf(value) +
      ", but a molar mass is positive. Give it in kg/mol (air: 0.0289647).");
  }
}

/// One value is needed for each species.
void requireOneEach(const char* name, std::size_t count, std::size_t species)
{
  if (count != species)
  {
    throw std::runtime_error("MixtureArrays and " + std::string(name) + " differ in length (" +
      std::to_string(species) + " and " + std::to_string(count) +
      "). Give one value for each array.");
  }
}

Linear gladstoneDale(vtkRefractiveIndex* self, const MediumChoice& choice)
{
  const schlieren::Gas* gas = gasFrom("Gas", self->GetGas());
  const double constant =
    gas ? gas->constantAt(wavelengthOfGases(self)) : self->GetGladstoneDaleConstant();
  requireFinite("GladstoneDaleConstant", constant);
  requireFinite("DensityScale", choice.densityScale);
  return { constant * choice.densityScale, 0 };
}

/// What the species and the background are made of where they were chosen by name, null elsewhere; the
/// background is the last.
std::vector<const schlieren::Gas*> gasesOfMixture(
  vtkRefractiveIndex* self, const MediumChoice& choice)
{
  const std::size_t species = choice.mixtureArrays.size();
  std::vector<const schlieren::Gas*> gases;
  if (!choice.mixtureGases.empty())
  {
    requireOneEach("MixtureGases", choice.mixtureGases.size(), species);
    for (const std::string& name : choice.mixtureGases)
    {
      gases.push_back(gasFrom("MixtureGases", name));
    }
  }
  gases.resize(species);
  gases.push_back(gasFrom("BackgroundGas", self->GetBackgroundGas()));
  return gases;
}

GasMixture gasMixture(vtkRefractiveIndex* self, const MediumChoice& choice)
{
  const std::vector<double>& constants = self->GetMixtureConstants();
  const std::vector<double>& molarMasses = self->GetMixtureMolarMasses();
  const std::size_t species = choice.mixtureArrays.size();
  if (species == 0)
  {
    throw std::runtime_error(
      "MixtureArrays is empty, so there is no mixture, and no array is known by its name as a "
      "fraction of a gas. Name the arrays of "
      "the fractions, or set IndexModel to Gladstone-Dale for a single gas.");
  }
  requireFinite("DensityScale", choice.densityScale);
  const std::vector<const schlieren::Gas*> gases = gasesOfMixture(self, choice);
  const bool allNamed = std::find(gases.begin(), gases.end() - 1, nullptr) == gases.end() - 1;

  GasMixture model;
  model.densityScale = choice.densityScale;
  model.ofVolumes = choice.fractionType == vtkRefractiveIndex::VOLUME;
  if (!allNamed)
  {
    requireOneEach("MixtureConstants", constants.size(), species);
    if (model.ofVolumes && molarMasses.empty())
    {
      throw std::runtime_error("MixtureMolarMasses is empty, but volume fractions weigh by the "
                               "gases' masses. Give the molar mass of each gas in kg/mol (helium: "
                               "0.0040026), or set FractionType to Mass.");
    }
    if (model.ofVolumes)
    {
      requireOneEach("MixtureMolarMasses", molarMasses.size(), species);
    }
  }
  const auto component = [&](std::size_t i)
  {
    schlieren::Component part;
    if (gases[i])
    {
      part.constant = gases[i]->constantAt(wavelengthOfGases(self));
      part.molarMass = gases[i]->molarMass;
      return part;
    }
    const bool isBackground = i == species;
    part.constant = isBackground ? self->GetBackgroundConstant() : constants[i];
    requireConstant(isBackground ? "BackgroundConstant" : "MixtureConstants", part.constant);
    if (model.ofVolumes)
    {
      part.molarMass = isBackground ? self->GetBackgroundMolarMass() : molarMasses[i];
      requireMolarMass(isBackground ? "BackgroundMolarMass" : "MixtureMolarMasses", part.molarMass);
    }
    return part;
  };
  for (std::size_t i = 0; i < species; ++i)
  {
    model.mixture.species.push_back(component(i));
  }
  model.mixture.background = component(species);
  return model;
}

CiddorAir ciddorAir(vtkRefractiveIndex* self, const MediumChoice& choice)
{
  requireFinite("TemperatureScale", choice.temperatureScale);
  requireFinite("PressureScale", choice.pressureScale);
  const bool hasHumidity = choice.hasHumidity();
  const double humidity = self->GetRelativeHumidity();
  if (!hasHumidity && !(humidity >= 0 && humidity <= 1))
  {
    throw std::runtime_error("RelativeHumidity is " + textOf(humidity) +
      ", but it is a fraction of saturation. Set it between 0 and 1.");
  }
  if (!(self->GetCO2() >= 0 && self->GetCO2() <= 1e6))
  {
    throw std::runtime_error("CO2 is " + textOf(self->GetCO2()) +
      ", which is no number of parts per million. Set it between 0 and 1e6 (air: 450).");
  }
  const double wavelength = 1e-9 * self->GetWavelength();
  if (!schlieren::isWithinCiddorWavelengths(wavelength))
  {
    throw std::runtime_error("Wavelength is " + textOf(self->GetWavelength()) +
      " nm, where Ciddor's equations do not hold. Set it between 300 and 1700 nm.");
  }
  return { schlieren::MoistAir::at(wavelength, self->GetCO2()), choice.temperatureScale,
    choice.pressureScale, hasHumidity, humidity };
}

} // namespace

//------------------------------------------------------------------------------
double GasMixture::refractivity(const double* values) const
{
  const double constant = this->ofVolumes ? this->mixture.constantByVolume(values + 1)
                                          : this->mixture.constantByMass(values + 1);
  return schlieren::gladstoneDaleRefractivity(constant, this->densityScale * values[0]);
}

bool GasMixture::isDoubtful(const double* values) const
{
  double sum = 0;
  for (std::size_t i = 1; i <= this->mixture.species.size(); ++i)
  {
    sum += values[i];
  }
  return sum > maxOfAll;
}

std::string GasMixture::warning(const std::string& fraction) const
{
  return "The fractions of MixtureArrays add up to more than " + textOf(maxOfAll) + " in " +
    fraction +
    " of the points, which leaves less than nothing to the background gas. Check that they "
    "are fractions of 1 and do not include the background.";
}

//------------------------------------------------------------------------------
double CiddorAir::refractivity(const double* values) const
{
  return this->air.refractivity(this->temperatureScale * values[0], this->pressureScale * values[1],
    this->hasHumidity ? values[2] : this->relativeHumidity);
}

bool CiddorAir::isDoubtful(const double* values) const
{
  return !schlieren::isWithinCiddorRange(
           this->temperatureScale * values[0], this->pressureScale * values[1]) ||
    (this->hasHumidity && values[2] > maxOfAll);
}

std::string CiddorAir::warning(const std::string& fraction) const
{
  return fraction +
    " of the points lie outside the range of Ciddor's equations (-40 to 100 C, 80 to "
    "120 kPa, relative humidity to 1). There they are continued towards the ideal gas. "
    "If so many surprise you, check that TemperatureScale and PressureScale give K and "
    "Pa, and that humidity is from 0 to 1.";
}

//------------------------------------------------------------------------------
FieldMean fieldMeanFrom(vtkRefractiveIndex* self)
{
  const bool isModel = self->GetIndexModel() == vtkRefractiveIndex::TRANSFER_FUNCTIONS;
  const auto& functions = self->GetTransferFunctions();
  const std::vector<double>& ranges = self->GetFieldRanges();
  const std::size_t fields = self->GetFields().size();
  if (isModel && !functions.empty() && functions.size() != fields)
  {
    throw std::runtime_error("Fields and TransferFunctions differ in length (" +
      std::to_string(fields) + " and " + std::to_string(functions.size()) +
      "). Give one function for each field, or none for straight lines.");
  }
  if (!ranges.empty() && ranges.size() != 2 * fields)
  {
    throw std::runtime_error("FieldRanges holds " + std::to_string(ranges.size()) + " values for " +
      std::to_string(fields) + " fields. Give two for each, or none for the fields' own ranges.");
  }
  requireFinite("RefractivityScale", self->GetRefractivityScale());

  FieldMean model;
  model.scale = self->GetRefractivityScale();
  for (std::size_t i = 0; i < fields; ++i)
  {
    const double low = ranges.empty() ? 0 : ranges[2 * i];
    const double high = ranges.empty() ? 0 : ranges[2 * i + 1];
    requireFinite("A value of FieldRanges", low);
    requireFinite("A value of FieldRanges", high);
    model.curves.emplace_back(isModel && !functions.empty() ? functions[i] : nullptr, low, high);
  }
  return model;
}

//------------------------------------------------------------------------------
Model modelFrom(vtkRefractiveIndex* self)
{
  const MediumChoice choice = choiceOf(self);
  switch (choice.indexModel)
  {
    case vtkRefractiveIndex::GLADSTONE_DALE:
      return gladstoneDale(self, choice);
    case vtkRefractiveIndex::GLADSTONE_DALE_MIXTURE:
      return gasMixture(self, choice);
    case vtkRefractiveIndex::CIDDOR:
      return ciddorAir(self, choice);
    case vtkRefractiveIndex::TRANSFER_FUNCTIONS:
      return fieldMeanFrom(self);
    case vtkRefractiveIndex::REFRACTIVE_INDEX:
      return Linear{ 1, -1 };
    default:
      return Linear();
  }
}

//------------------------------------------------------------------------------
Selection selectionFrom(vtkRefractiveIndex* self, int index, const char* property)
{
  vtkInformation* info = self->GetInputArrayInformation(index);
  Selection selection;
  selection.property = property;
  if (const char* name = info->Get(vtkDataObject::FIELD_NAME()))
  {
    selection.name = name;
  }
  else if (info->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    selection.attribute = info->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  selection.cellsFirst =
    info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  return selection;
}

//------------------------------------------------------------------------------
std::vector<Selection> selectionsFrom(vtkRefractiveIndex* self)
{
  using Index = vtkRefractiveIndex;
  const MediumChoice choice = choiceOf(self);
  std::vector<Selection> selections;
  switch (choice.indexModel)
  {
    case Index::GLADSTONE_DALE:
      selections = { choice.arrays[Index::DENSITY] };
      break;
    case Index::GLADSTONE_DALE_MIXTURE:
      selections = { choice.arrays[Index::DENSITY] };
      for (const std::string& name : choice.mixtureArrays)
      {
        selections.push_back({ "MixtureArrays", name, -1, selections[0].cellsFirst });
      }
      break;
    case Index::CIDDOR:
      selections = { choice.arrays[Index::TEMPERATURE], choice.arrays[Index::PRESSURE] };
      if (choice.hasHumidity())
      {
        selections.push_back(choice.arrays[Index::HUMIDITY]);
      }
      break;
    case Index::TRANSFER_FUNCTIONS:
      for (const std::string& name : self->GetFields())
      {
        selections.push_back({ "Fields", name });
      }
      if (selections.empty())
      {
        selections.push_back({ "Fields", "" }); // for the message
      }
      break;
    default:
      selections = { choice.arrays[Index::INDEX_ARRAY] };
      break;
  }
  return selections;
}

//------------------------------------------------------------------------------
Tally& Tally::operator+=(const Tally& other)
{
  this->all += other.all;
  this->doubtful += other.doubtful;
  return *this;
}

std::string warningFrom(const Model& model, const Tally& tally)
{
  if (tally.doubtful == 0)
  {
    return "";
  }
  char fraction[32];
  std::snprintf(fraction, sizeof fraction, "%.3g %%",
    100 * static_cast<double>(tally.doubtful) / static_cast<double>(tally.all));
  return std::visit(
    [&fraction](const auto& chosen) -> std::string
    {
      if constexpr (std::is_same_v<std::decay_t<decltype(chosen)>, Linear>)
      {
        return "";
      }
      else
      {
        return chosen.warning(fraction);
      }
    },
    model);
}

} // namespace filters
