// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <string>

struct MediumSettings;

/// Gases that a user has chosen by name. All settings are complete (MediumChoice::settings).
namespace filters
{

/// The name of a liquid that is chosen like a gas.
constexpr const char* waterName = "water";

/// Returns the name or formula in the table of a gas that is written so, in capitals, or in small letters; empty: none.
/// A single letter is a formula in capitals only, and "Co" is not "CO".
std::string gasOf(const std::string& word);

/// Returns the Gladstone-Dale constant of a single gas, m^3/kg: the one given, or that of Gas. Throws std::runtime_error that
/// lists the table's gases for an unknown name.
double constantFrom(const MediumSettings& settings);

/// Returns a gas of a mixture, given by a name or formula of the table, or by its Gladstone-Dale
/// constant in m^3/kg and, for volume fractions, its molar mass in kg/mol, such as "2.3e-4 0.044".
/// Throws std::runtime_error for any other text.
schlieren::Component componentFrom(
  const std::string& property, const std::string& text, const MediumSettings& settings);

/// Returns the wavelength in metres. Throws std::runtime_error where it is not positive.
double wavelengthOfGases(const MediumSettings& settings);

/// Returns whether the refractivity depends on the wavelength: moist air, electrons, and gases chosen by name.
bool usesWavelength(const MediumSettings& settings);

/// Returns a warning about gases whose constants were not measured at the wavelength; mostly empty.
std::string noteOnGases(const MediumSettings& settings);

} // namespace filters
