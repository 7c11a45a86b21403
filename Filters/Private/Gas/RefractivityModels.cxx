// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/RefractivityModels.h"

#include "NumberText.h"

#include "Gas/ArrayChoice.h"
#include "Gas/Fractions.h"
#include "Gas/GasChoices.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace filters
{

namespace
{

/// Maximum fraction or relative humidity that rounding and interpolation explain.
constexpr double maxOfAll = 1.01;

void requireFinite(const std::string& name, double value)
{
  if (!std::isfinite(value))
  {
    throw std::runtime_error(name + " is not a finite number. Set it to one.");
  }
}

void requirePressure(const MediumSettings& settings)
{
  requireFinite("PressureScale", settings.PressureScale);
  if (!(settings.UniformPressure >= 0) || std::isinf(settings.UniformPressure))
  {
    throw std::runtime_error("UniformPressure is " + textOf(settings.UniformPressure) +
      ", which is no pressure. Set it to one in Pa (air in a room: 101325), or to 0 to choose an "
      "array.");
  }
}

/// N of a density, or of temperature and pressure, and the fractions of species.
class GasMixture : public StateModel
{
public:
  schlieren::Mixture mixture;
  double densityScale = 1;
  FractionOf fractionsOf = FractionOf::Mass;
  bool usesGasLaw = false;
  int states = 1; // values before the fractions
  double temperatureScale = 1, temperatureZero = 0, pressureScale = 1; // of the gas law
  double uniformPressure = 0;                                          // 0: a value

  double refractivity(const double* values) const override
  {
    const double* fractions = values + this->states;
    const double constant = this->fractionsOf == FractionOf::Volume
      ? this->mixture.constantByVolume(fractions)
      : this->mixture.constantByMass(fractions);
    if (this->usesGasLaw)
    {
      constexpr double gasConstant = 8.31446261815324;
      const double kelvins = this->temperatureScale * values[0] + this->temperatureZero;
      const double pascals =
        this->uniformPressure > 0 ? this->uniformPressure : this->pressureScale * values[1];
      return kelvins > 0 && pascals >= 0
        ? constant * this->molarMass(fractions) * pascals / (gasConstant * kelvins)
        : std::nan("");
    }
    if (this->fractionsOf == FractionOf::Density) // what is not of the species is of the background
    {
      return this->densityScale * (constant + this->mixture.background.constant * (values[0] - 1));
    }
    return schlieren::gladstoneDaleRefractivity(constant, this->densityScale * values[0]);
  }

  bool isDoubtful(const double* values) const override
  {
    const double* fractions = values + this->states;
    const double sum = std::accumulate(fractions, fractions + this->mixture.species.size(), 0.);
    return sum > maxOfAll * (this->fractionsOf == FractionOf::Density ? values[0] : 1);
  }

  std::string warning(const std::string& fraction) const override
  {
    return "The fractions of MixtureArrays add up to more than " + textOf(maxOfAll) + " in " +
      fraction +
      " of the points, which leaves less than nothing to the background gas. Check that they "
      "are fractions of 1 and do not include the background.";
  }

private:
  double molarMass(const double* fractions) const
  {
    const bool ofVolumes = this->fractionsOf == FractionOf::Volume;
    double sum = 0, rest = 1;
    const auto add = [&](double fraction, double mass)
    {
      sum += ofVolumes ? fraction * mass : fraction / mass;
      rest -= fraction;
    };
    for (std::size_t i = 0; i < this->mixture.species.size(); ++i)
    {
      add(fractions[i], this->mixture.species[i].molarMass);
    }
    add(rest, this->mixture.background.molarMass);
    return ofVolumes ? sum : 1 / sum;
  }
};

/// N of temperature, pressure and, if hasHumidity, relative humidity.
class CiddorAir : public StateModel
{
public:
  schlieren::MoistAir air{};
  double temperatureScale = 1, temperatureZero = 0, pressureScale = 1;
  double uniformPressure = 0;  // 0: a value
  bool hasHumidity = false;    // as last value
  double relativeHumidity = 0; // used if not hasHumidity

  double refractivity(const double* values) const override
  {
    return this->air.refractivity(
      this->temperatureIn(values), this->pressureIn(values), this->humidityIn(values));
  }

  bool isDoubtful(const double* values) const override
  {
    return this->hasHumidity && this->humidityIn(values) > maxOfAll;
  }

  bool isContinued(const double* values) const override
  {
    return !schlieren::isWithinCiddorRange(this->temperatureIn(values), this->pressureIn(values));
  }

  std::string noteOnContinued(const std::string& fraction) const override
  {
    return fraction +
      " of the points lie outside the range of Ciddor's equations (-40 to 100 C, 80 to 120 kPa), "
      "which are continued there towards the ideal gas.";
  }

  std::string warning(const std::string& fraction) const override
  {
    return "The relative humidity is more than " + textOf(maxOfAll) + " in " + fraction +
      " of the points, but it is a fraction of saturation. Divide percents by 100 with Calculator "
      "and choose the result for Humidity.";
  }

private:
  double temperatureIn(const double* values) const
  {
    return this->temperatureScale * values[0] + this->temperatureZero;
  }
  double pressureIn(const double* values) const
  {
    return this->uniformPressure > 0 ? this->uniformPressure : this->pressureScale * values[1];
  }
  double humidityIn(const double* values) const
  {
    return this->hasHumidity ? values[this->uniformPressure > 0 ? 1 : 2] : this->relativeHumidity;
  }
};

/// N of a temperature.
class Water : public StateModel
{
public:
  double wavelength = 0; // m
  double temperatureScale = 1, temperatureZero = 0;

  double refractivity(const double* values) const override
  {
    return schlieren::waterRefractivity(this->temperatureIn(values), this->wavelength);
  }

  bool isDoubtful(const double*) const override { return false; }
  std::string warning(const std::string&) const override { return ""; }

  bool isContinued(const double* values) const override
  {
    return !schlieren::isLiquidWater(this->temperatureIn(values));
  }

  std::string noteOnContinued(const std::string& fraction) const override
  {
    return fraction +
      " of the points lie outside 0 to 100 C, where water is liquid, and have the index of the "
      "nearer end.";
  }

private:
  double temperatureIn(const double* values) const
  {
    return this->temperatureScale * values[0] + this->temperatureZero;
  }
};

Model water(const MediumSettings& settings)
{
  auto model = std::make_shared<Water>();
  model->wavelength = 1e-9 * settings.Wavelength;
  if (!schlieren::isWithinWaterWavelengths(model->wavelength))
  {
    throw std::runtime_error("Wavelength is " + textOf(settings.Wavelength) +
      " nm, where the formula for water does not hold. Set it between 200 and 1900 nm.");
  }
  model->temperatureScale = kelvinsOf(settings);
  model->temperatureZero = zeroOf(settings);
  return OfState{ model };
}

/// N of an electron density, n^2 = 1 - n_e / n_c without collisions and magnetic field (I. H. Hutchinson, Principles of
/// Plasma Diagnostics, 2nd ed., 2002, ch. 4), and of the density of a gas beside it.
class Plasma : public StateModel
{
public:
  double scale = 1;        // the factor to m^-3
  double overCritical = 0; // 1 / n_c times that
  bool hasGas = false;     // as last value
  double gas = 0;          // N by its value

  double refractivity(const double* values) const override
  {
    const double over = this->overCritical * values[0];
    return -over / (1 + std::sqrt(1 - over)) + (this->hasGas ? this->gas * values[1] : 0);
  }

  bool isDoubtful(const double* values) const override
  {
    return this->overCritical * values[0] > 1;
  }

  std::string warning(const std::string& fraction) const override
  {
    return "The electron density is above the critical one, " +
      textOf(this->scale / this->overCritical) + " m^-3 at this Wavelength, in " + fraction +
      " of the points, which count as a body, as light does not enter them. Check the unit, m^-3 "
      "unless the array's name has another one, such as 'ne [cm^-3]'.";
  }
};

Linear gladstoneDaleOf(const MediumSettings& settings)
{
  const double constant = constantFrom(settings);
  requireFinite("GladstoneDaleConstant", constant);
  requireFinite("DensityScale", settings.DensityScale);
  return Linear{ constant * settings.DensityScale, 0 };
}

Model gladstoneDale(const MediumSettings& settings) { return gladstoneDaleOf(settings); }

Model plasma(const MediumSettings& settings)
{
  constexpr double electronRadius = 2.8179403205e-15; // classical, m (CODATA 2022)
  auto model = std::make_shared<Plasma>();
  model->scale = perCubicMetreOf(settings);
  if (model->scale == 0)
  {
    throw std::runtime_error("The unit in the name of the electron density '" +
      settings.Arrays[MediumSettings::IndexArray].name +
      "' is not known. Make one in m^-3 with Calculator, and choose it for IndexArray.");
  }
  const double wavelength = wavelengthOfGases(settings);
  model->overCritical = model->scale * electronRadius * wavelength * wavelength / M_PI;
  model->hasGas = settings.Arrays[MediumSettings::DensityArray].isNamed();
  model->gas = model->hasGas ? gladstoneDaleOf(settings).scale : 0;
  return OfState{ model };
}

Model gasMixture(const MediumSettings& settings)
{
  const std::size_t species = settings.MixtureArrays.size();
  if (species == 0)
  {
    throw std::runtime_error(
      "MixtureArrays is empty, so there is no mixture, and no array is known by its name as a "
      "fraction of a gas. Name the arrays of "
      "the fractions, or set IndexModel to Gladstone-Dale for a single gas.");
  }
  if (settings.MixtureGases.size() != species)
  {
    throw std::runtime_error("MixtureArrays and MixtureGases differ in length (" +
      std::to_string(species) + " and " + std::to_string(settings.MixtureGases.size()) +
      "). Give one gas for each array.");
  }
  requireFinite("DensityScale", settings.DensityScale);

  auto model = std::make_shared<GasMixture>();
  model->densityScale = settings.DensityScale;
  model->fractionsOf = arePartialDensities(settings.MixtureArrays) ? FractionOf::Density
    : settings.FractionType == 1                                   ? FractionOf::Volume
                                                                   : FractionOf::Mass;
  if (settings.usesGasLaw())
  {
    if (model->fractionsOf == FractionOf::Density)
    {
      throw std::runtime_error(
        "MixtureArrays has partial densities, but there is no whole one. Choose an array for "
        "Density, which may be their sum (Calculator).");
    }
    requirePressure(settings);
    model->usesGasLaw = true;
    model->states = settings.hasUniformPressure() ? 1 : 2;
    model->temperatureScale = kelvinsOf(settings);
    model->temperatureZero = zeroOf(settings);
    model->pressureScale = settings.PressureScale;
    model->uniformPressure = settings.UniformPressure;
  }
  for (const std::string& gas : settings.MixtureGases)
  {
    model->mixture.species.push_back(componentFrom("MixtureGases", gas, settings));
  }
  model->mixture.background = componentFrom("BackgroundGas", settings.BackgroundGas, settings);
  return OfState{ model };
}

Model ciddorAir(const MediumSettings& settings)
{
  requirePressure(settings);
  const bool hasHumidity = settings.Arrays[MediumSettings::HumidityArray].isNamed();
  const double humidity = settings.RelativeHumidity;
  if (!hasHumidity && !(humidity >= 0 && humidity <= 1))
  {
    throw std::runtime_error("RelativeHumidity is " + textOf(humidity) +
      ", but it is a fraction of saturation. Set it between 0 and 1.");
  }
  const double wavelength = 1e-9 * settings.Wavelength;
  if (!schlieren::isWithinCiddorWavelengths(wavelength))
  {
    throw std::runtime_error("Wavelength is " + textOf(settings.Wavelength) +
      " nm, where Ciddor's equations do not hold. Set it between 300 and 1700 nm.");
  }
  auto model = std::make_shared<CiddorAir>();
  model->air = schlieren::MoistAir::at(wavelength);
  model->temperatureScale = kelvinsOf(settings);
  model->temperatureZero = zeroOf(settings);
  model->pressureScale = settings.PressureScale;
  model->uniformPressure = settings.UniformPressure;
  model->hasHumidity = hasHumidity;
  model->relativeHumidity = humidity;
  return OfState{ model };
}

Model refractiveIndex(const MediumSettings&) { return Linear{ 1, -1 }; }

Model refractivity(const MediumSettings&) { return Linear(); }

Model transferFunctions(const MediumSettings& settings) { return fieldMeanFrom(settings); }

/// The table. A model that has not been chosen yet looks for a density.
constexpr IndexModelKind kinds[] = {
  { MediumSettings::AUTO, IndexArrays::Density, IndexGases::None, refractivity },
  { MediumSettings::GLADSTONE_DALE, IndexArrays::Density, IndexGases::One, gladstoneDale },
  { MediumSettings::REFRACTIVE_INDEX, IndexArrays::Index, IndexGases::None, refractiveIndex },
  { MediumSettings::REFRACTIVITY, IndexArrays::Index, IndexGases::None, refractivity },
  { MediumSettings::GLADSTONE_DALE_MIXTURE, IndexArrays::Density, IndexGases::Mixture, gasMixture },
  { MediumSettings::CIDDOR, IndexArrays::Air, IndexGases::MoistAir, ciddorAir },
  { MediumSettings::WATER, IndexArrays::Temperature, IndexGases::Water, water },
  { MediumSettings::ELECTRON_DENSITY, IndexArrays::Electrons, IndexGases::One, plasma },
  { MediumSettings::TRANSFER_FUNCTIONS, IndexArrays::Fields, IndexGases::None, transferFunctions },
};

} // namespace

const IndexModelKind& kindOf(int indexModel)
{
  const auto found = std::find_if(std::begin(kinds), std::end(kinds),
    [indexModel](const IndexModelKind& kind) { return kind.value == indexModel; });
  if (found == std::end(kinds))
  {
    throw std::runtime_error("IndexModel is " + std::to_string(indexModel) +
      ", which is no index model. Set it to one of the list.");
  }
  return *found;
}

FieldMean fieldMeanFrom(const MediumSettings& settings)
{
  const bool isModel = settings.IndexModel == MediumSettings::TRANSFER_FUNCTIONS;
  const auto& functions = settings.TransferFunctions;
  const std::vector<double>& ranges = settings.FieldRanges;
  const std::size_t fields = settings.Fields.size();
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
  requireFinite("RefractivityScale", settings.RefractivityScale);

  FieldMean model;
  model.scale = settings.RefractivityScale;
  for (std::size_t i = 0; i < fields; ++i)
  {
    const double low = ranges.empty() ? 0 : ranges[2 * i];
    const double high = ranges.empty() ? 0 : ranges[2 * i + 1];
    requireFinite("A value of FieldRanges", low);
    requireFinite("A value of FieldRanges", high);
    model.curves.emplace_back(
      isModel && !functions.empty() ? functions[i] : TransferCurve(), low, high);
  }
  return model;
}

Selection selectionOf(const MediumSettings& settings, std::size_t index)
{
  return { MediumSettings::arrayProperties[index], settings.Arrays[index] };
}

std::vector<Selection> selectionsFrom(const MediumSettings& settings)
{
  const IndexModelKind& kind = kindOf(settings.IndexModel);
  std::vector<Selection> selections;
  for (const std::size_t index : arraysOfModel(settings))
  {
    if (index != MediumSettings::HumidityArray || settings.Arrays[index].isNamed())
    {
      selections.push_back(selectionOf(settings, index));
    }
  }
  if (kind.gases == IndexGases::Mixture)
  {
    for (const std::string& name : settings.MixtureArrays)
    {
      selections.push_back({ "MixtureArrays", { name, -1, selections[0].cellsFirst } });
    }
  }
  if (kind.arrays == IndexArrays::Fields)
  {
    for (const std::string& name : settings.Fields)
    {
      selections.push_back({ "Fields", { name } });
    }
  }
  if (selections.empty())
  {
    selections.push_back({ "Fields", {} }); // named in the message
  }
  return selections;
}

Tally& Tally::operator+=(const Tally& other)
{
  this->all += other.all;
  this->doubtful += other.doubtful;
  this->continued += other.continued;
  return *this;
}

namespace
{

/// Returns a text such as "12 %".
std::string fractionOf(long long some, const Tally& tally)
{
  return textOf(100 * static_cast<double>(some) / static_cast<double>(tally.all), 3) + " %";
}

} // namespace

std::string noteOnContinued(const Model& model, const Tally& tally)
{
  const auto* ofState = std::get_if<OfState>(&model);
  return ofState && tally.continued > 0
    ? ofState->model->noteOnContinued(fractionOf(tally.continued, tally))
    : "";
}

std::string warningFrom(const Model& model, const Tally& tally)
{
  if (tally.doubtful == 0)
  {
    return "";
  }
  const std::string fraction = fractionOf(tally.doubtful, tally);
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
