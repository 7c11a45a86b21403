// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <functional>
#include <string>

struct MediumSettings;

/// Gases that a user has chosen by name. All settings are complete (MediumChoice::settings).
namespace filters
{

/// Returns whether the name is "Custom" or empty.
bool isCustom(const std::string& name);

/// Finds a gas by name or formula; null for a custom one. Throws std::runtime_error that lists the
/// table's gases for an unknown name. `property` names the source of the choice in the message.
const schlieren::Gas* gasFrom(const std::string& property, const std::string& name);

/// Returns the wavelength in metres. Throws std::runtime_error where it is not positive.
double wavelengthOfGases(const MediumSettings& settings);

/// Returns whether the refractivity depends on the wavelength: moist air, and gases chosen by name.
bool usesWavelength(const MediumSettings& settings);

/// Returns the ratio of the refractivity at a wavelength to that at `reference` (both in metres)
/// for the gas of the index model: of a mixture, its background; of moist air, dry air, from whose
/// dispersion that of vapour differs by percents. Null for unknown gases.
std::function<double(double wavelength)> dispersionOfGases(
  const MediumSettings& settings, double reference);

/// Returns a warning about gases whose constants were not measured at the wavelength; mostly empty.
std::string noteOnGases(const MediumSettings& settings);

} // namespace filters
