// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Gas/TransferFunctions.h"
#include "MediumSettings.h"

#include "Schlieren.h"

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// Models of the refractivity at a point or cell as a function of its arrays. All but Linear have
///   refractivity(values)  N; NaN for states that no gas can have
///   isDoubtful(values)    whether the state deserves a warning
///   warning(fraction)     the warning; the fraction is a text such as "12 %"
namespace filters
{

/// N = a x + b of one array; separate from the others because it can be fast.
struct Linear
{
  double scale = 1;
  double offset = 0;
};

/// N of a density and the fractions of species.
struct GasMixture
{
  schlieren::Mixture mixture;
  double densityScale;
  bool ofVolumes; // volume fractions instead of mass fractions

  double refractivity(const double* values) const;
  bool isDoubtful(const double* values) const;
  std::string warning(const std::string& fraction) const;
};

/// Returns the temperature of air that came from rest to this fraction of its pressure, or beyond, without heat.
double isentropicTemperature(double atRest, double fraction);

/// N of temperature, pressure and, if hasHumidity, relative humidity.
struct CiddorAir
{
  schlieren::MoistAir air;
  double temperatureScale, pressureScale;
  double uniformPressure;       // 0: a value
  double stagnationTemperature; // 0: the first value; else it follows from the pressure
  double stagnationPressure;
  bool hasHumidity;        // as last value
  double relativeHumidity; // used if not hasHumidity

  double refractivity(const double* values) const;
  bool isDoubtful(const double* values) const;
  std::string warning(const std::string& fraction) const;

private:
  double temperatureIn(const double* values) const
  {
    return this->stagnationTemperature > 0 ? isentropicTemperature(this->stagnationTemperature,
                                               this->pressureIn(values) / this->stagnationPressure)
                                           : this->temperatureScale * values[0];
  }
  double pressureIn(const double* values) const
  {
    return this->uniformPressure > 0
      ? this->uniformPressure
      : this->pressureScale * values[this->stagnationTemperature > 0 ? 0 : 1];
  }
  double humidityIn(const double* values) const
  {
    const bool hasOneOther = this->uniformPressure > 0 || this->stagnationTemperature > 0;
    return this->hasHumidity ? values[hasOneOther ? 1 : 2] : this->relativeHumidity;
  }
};

/// Any model.
using Model = std::variant<Linear, GasMixture, CiddorAir, FieldMean>;

/// Makes the curves of Fields, straight lines unless the model is Curves. Throws std::runtime_error
/// for inconsistent settings.
FieldMean fieldMeanFrom(const MediumSettings& settings);

/// Makes the model of complete settings. Throws std::runtime_error for inconsistent ones.
Model modelFrom(const MediumSettings& settings);

/// An array to look for.
struct Selection : ArraySelection
{
  Selection(std::string ofProperty, ArraySelection chosen)
    : ArraySelection(std::move(chosen))
    , property(std::move(ofProperty))
  {
  }

  std::string property; ///< that chose it
};

Selection selectionOf(const MediumSettings& settings, std::size_t index);

/// Lists the arrays that the model reads, at least one, in its order.
std::vector<Selection> selectionsFrom(const MediumSettings& settings);

/// Counts doubtful points or cells among those that have values.
struct Tally
{
  long long all = 0;
  long long doubtful = 0;

  Tally& operator+=(const Tally& other);
};

/// Returns a warning about doubtful values; empty without any.
std::string warningFrom(const Model& model, const Tally& tally);

} // namespace filters
