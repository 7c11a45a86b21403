// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityModels.h"

#include "vtkPiecewiseFunction.h"
#include "vtkRefractiveIndex.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

namespace refractivity
{

namespace
{

/// Fractions (and relative humidities) above 1 by more than rounding and interpolation explain.
constexpr double mostOfAll = 1.01;

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

Linear gladstoneDale(vtkRefractiveIndex* self)
{
  requireFinite("GladstoneDaleConstant", self->GetGladstoneDaleConstant());
  requireFinite("DensityScale", self->GetDensityScale());
  return { self->GetGladstoneDaleConstant() * self->GetDensityScale(), 0 };
}

GasMixture gasMixture(vtkRefractiveIndex* self)
{
  const std::vector<double>& constants = self->GetMixtureConstants();
  const std::vector<double>& molarMasses = self->GetMixtureMolarMasses();
  const std::size_t species = self->GetMixtureArrays().size();
  if (species == 0)
  {
    throw std::runtime_error(
      "MixtureArrays is empty, so there is no mixture. Name the arrays of "
      "the fractions, or set IndexModel to Gladstone-Dale for a single gas.");
  }
  requireOneEach("MixtureConstants", constants.size(), species);
  requireConstant("BackgroundConstant", self->GetBackgroundConstant());
  requireFinite("DensityScale", self->GetDensityScale());

  GasMixture model;
  model.densityScale = self->GetDensityScale();
  model.ofVolumes = self->GetFractionType() == vtkRefractiveIndex::VOLUME;
  model.mixture.background.constant = self->GetBackgroundConstant();
  for (const double constant : constants)
  {
    requireConstant("MixtureConstants", constant);
    schlieren::Component component;
    component.constant = constant;
    model.mixture.species.push_back(component);
  }
  if (model.ofVolumes)
  {
    if (molarMasses.empty())
    {
      throw std::runtime_error("MixtureMolarMasses is empty, but volume fractions weigh by the "
                               "gases' masses. Give the molar mass of each gas in kg/mol (helium: "
                               "0.0040026), or set FractionType to Mass.");
    }
    requireOneEach("MixtureMolarMasses", molarMasses.size(), species);
    requireMolarMass("BackgroundMolarMass", self->GetBackgroundMolarMass());
    model.mixture.background.molarMass = self->GetBackgroundMolarMass();
    for (std::size_t i = 0; i < species; ++i)
    {
      requireMolarMass("MixtureMolarMasses", molarMasses[i]);
      model.mixture.species[i].molarMass = molarMasses[i];
    }
  }
  return model;
}

CiddorAir ciddorAir(vtkRefractiveIndex* self)
{
  requireFinite("TemperatureScale", self->GetTemperatureScale());
  requireFinite("PressureScale", self->GetPressureScale());
  const bool hasHumidity = self->HasHumidityArray();
  const double humidity = self->GetRelativeHumidity();
  if (!hasHumidity && !(humidity >= 0 && humidity <= 1))
  {
    throw std::runtime_error("RelativeHumidity is " + textOf(humidity) +
      ", but it is a share of saturation. Set it between 0 and 1.");
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
  return { schlieren::MoistAir::at(wavelength, self->GetCO2()), self->GetTemperatureScale(),
    self->GetPressureScale(), hasHumidity, humidity };
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
  return sum > mostOfAll;
}

std::string GasMixture::warning(const std::string& share) const
{
  return "The fractions of MixtureArrays add up to more than " + textOf(mostOfAll) + " in " +
    share +
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
    (this->hasHumidity && values[2] > mostOfAll);
}

std::string CiddorAir::warning(const std::string& share) const
{
  return share +
    " of the points lie outside the range of Ciddor's equations (-40 to 100 C, 80 to "
    "120 kPa, relative humidity to 1). There they are continued towards the ideal gas. "
    "If so many surprise you, check that TemperatureScale and PressureScale give K and "
    "Pa, and that humidity is a share of 1.";
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
  switch (self->GetIndexModel())
  {
    case vtkRefractiveIndex::GLADSTONE_DALE:
      return gladstoneDale(self);
    case vtkRefractiveIndex::GLADSTONE_DALE_MIXTURE:
      return gasMixture(self);
    case vtkRefractiveIndex::CIDDOR:
      return ciddorAir(self);
    case vtkRefractiveIndex::TRANSFER_FUNCTIONS:
      return fieldMeanFrom(self);
    case vtkRefractiveIndex::REFRACTIVE_INDEX:
      return Linear{ 1, -1 };
    default:
      return Linear();
  }
}

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
  char share[32];
  std::snprintf(share, sizeof share, "%.3g %%",
    100 * static_cast<double>(tally.doubtful) / static_cast<double>(tally.all));
  return std::visit(
    [&share](const auto& chosen) -> std::string
    {
      if constexpr (std::is_same_v<std::decay_t<decltype(chosen)>, Linear>)
      {
        return "";
      }
      else
      {
        return chosen.warning(share);
      }
    },
    model);
}

} // namespace refractivity
