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

/// What the refractivity is at one point or cell, given what the arrays hold there. But for Linear, a
/// model says three things:
///   refractivity(values)  N; NaN where there can be no such gas
///   isDoubtful(values)    whether the user should hear of it
///   warning(fraction)      what the user should hear, where the fraction is text such as "12 %"
namespace filters
{

/// Of the only array. Kept apart from the others because it can be fast.
struct Linear
{
  double scale = 1;
  double offset = 0;
};

/// Of the density and the fractions of the species.
struct GasMixture
{
  schlieren::Mixture mixture;
  double densityScale;
  bool ofVolumes; // else of masses

  double refractivity(const double* values) const;
  bool isDoubtful(const double* values) const;
  std::string warning(const std::string& fraction) const;
};

/// Of temperature, pressure and, if hasHumidity, relative humidity.
struct CiddorAir
{
  schlieren::MoistAir air;
  double temperatureScale, pressureScale;
  bool hasHumidity;
  double relativeHumidity; // where it has not

  double refractivity(const double* values) const;
  bool isDoubtful(const double* values) const;
  std::string warning(const std::string& fraction) const;
};

/// All models.
using Model = std::variant<Linear, GasMixture, CiddorAir, FieldMean>;

/// Makes the curves of Fields; straight lines unless the index model is Curves. Throws std::runtime_error where the settings make
/// no sense.
FieldMean fieldMeanFrom(const MediumSettings& settings);

/// Makes the model of settings that leave nothing open (MediumChoice::settings). Throws std::runtime_error where they make no
/// sense.
Model modelFrom(const MediumSettings& settings);

/// An array that is looked for.
struct Selection : ArraySelection
{
  Selection(std::string ofProperty, ArraySelection chosen)
    : ArraySelection(std::move(chosen))
    , property(std::move(ofProperty))
  {
  }

  std::string property; ///< that it was chosen with
};

Selection selectionOf(const MediumSettings& settings, std::size_t index);

/// The arrays that the model takes, in its order; at least one.
std::vector<Selection> selectionsFrom(const MediumSettings& settings);

/// How many of the points or cells that have values are doubtful.
struct Tally
{
  long long all = 0;
  long long doubtful = 0;

  Tally& operator+=(const Tally& other);
};

/// What to warn the user of; empty where nothing is doubtful.
std::string warningFrom(const Model& model, const Tally& tally);

} // namespace filters
