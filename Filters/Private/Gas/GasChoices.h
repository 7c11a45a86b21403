// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <functional>
#include <string>

struct MediumSettings;

/// Gases that a user has chosen by name. All settings are such as leave nothing open: MediumChoice::settings.
namespace filters
{

/// Whether the name stands for a gas that is not of the table: "Custom" or nothing.
bool isCustom(const std::string& name);

/// The gas of this name or formula; null for a custom one. Throws std::runtime_error, which says what
/// there is to choose from, for a name that is not in the table. `property` is where it was chosen.
const schlieren::Gas* gasFrom(const std::string& property, const std::string& name);

/// The filter's wavelength in metres. Throws std::runtime_error where it is not positive.
double wavelengthOfGases(const MediumSettings& settings);

/// Whether the refractivity depends on the wavelength: for moist air and where gases were chosen by name.
bool usesWavelength(const MediumSettings& settings);

/// The refractivity at a wavelength by that at `reference` (both metres) of the gas that the index model uses:
/// of a mixture, its background; of moist air, the dry part, from which vapour differs by percents of
/// the dispersion. Null where the gas is not known.
std::function<double(double wavelength)> dispersionOfGases(
  const MediumSettings& settings, double reference);

/// What the user should know about the gases that the index model uses: whose constants have not been
/// measured at the filter's wavelength. Mostly empty.
std::string noteOnGases(const MediumSettings& settings);

} // namespace filters
