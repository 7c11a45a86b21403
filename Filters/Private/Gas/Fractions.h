// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which arrays are fractions of gases, by their names and ranges.
#pragma once

#include "FlowDefaults.h"

#include <optional>
#include <string>
#include <vector>

namespace filters
{

/// What an array is a fraction of.
enum class FractionOf
{
  Mass,
  Volume,
  Density ///< a partial density, in the unit of the whole one
};

struct Fraction
{
  std::string array;
  std::string gas; ///< of the table; empty: of none
  FractionOf kind;
  bool isSure; ///< false: the name is a letter or two, which say so only beside other fractions
};

/// Returns what an array is a fraction of; nothing if it is none.
std::optional<Fraction> fractionOf(const FlowArray& array);

/// Returns whether all of these names are those of partial densities. Throws std::runtime_error if only some are.
bool arePartialDensities(const std::vector<std::string>& names);

/// Returns a note on fractions that are not among `used`; mostly empty.
std::string noteOnFractions(
  const std::vector<FlowArray>& arrays, const std::vector<std::string>& used);

} // namespace filters
