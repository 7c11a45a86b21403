// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads a quantity, a unit and a gas from the names that solvers give their arrays.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace filters
{

std::string lowered(std::string text);

/// The quantities that are recognized.
enum class Quantity
{
  Density,
  Temperature,
  Pressure,
  Electrons ///< their number per volume
};

/// The ways in which a name matches a quantity, best first.
enum class Understood
{
  Exactly,   ///< the name alone, perhaps with its unit: "rho"
  Wholly,    ///< with words that change no meaning: "gas density"
  AsMean,    ///< a mean over time: "rhoMean"
  AsPart,    ///< a numbered component, perhaps the only one: "rho1", "alpha_rho1"
  AsSpecies, ///< of one of several species or phases: "rho_N2", "rho.water"
  Not
};

/// Splits an array's name into words ("rhoMean" has two) and a unit, in brackets or at the end.
class ArrayName
{
public:
  explicit ArrayName(const std::string& text);

  /// Returns all words, also those in brackets.
  const std::vector<std::string>& AllWords() const { return this->All; }
  /// Returns the name in small letters, without separators and bracketed unit.
  std::string Joined() const;

  /// Returns whether the name is one of these, apart from words that change no meaning: "gas rho"
  /// is a density, "rhoU" is not.
  bool Is(const std::set<std::string>& names) const;

  Understood As(Quantity quantity) const;

  /// Returns whether the name has a unit; with `quantity`: its factor to SI units, 0 where unknown.
  bool HasUnit(Quantity quantity) const;
  double Scale(Quantity quantity) const;
  /// Returns the zero of the temperature's unit, K: that of degrees Celsius or Fahrenheit; of others 0.
  double ZeroInKelvins() const;
  /// Returns whether the name says that a pressure is relative to the surroundings'.
  bool IsGauge() const;
  /// Returns whether the unit belongs to this quantity.
  bool HasUnitOf(Quantity quantity) const { return this->Scale(quantity) != 0; }

  /// Returns whether a word names a gas, or a liquid or solid phase.
  bool IsOfGas() const;
  bool IsOfLiquid() const;

  /// Returns whether a word excludes the name as a state of a gas: an index, a fraction, a
  /// velocity, a gradient, ...
  bool IsSomethingElse() const;

private:
  struct Parsed
  {
    std::vector<std::string> words; ///< without the words of the unit
    std::string unit;               ///< as written; empty: none
  };
  Parsed Of(Quantity quantity) const;

  std::vector<std::string> Words; ///< before and behind the brackets
  std::vector<std::string> All;
  std::string Bracket; ///< the text in the last brackets
};

/// Returns the factor of a unit ("g/cm3", "kg m^-3", "hPa") to kg/m^3, K, Pa or m^-3; 0: unknown.
double scaleOfUnit(Quantity quantity, const std::string& unit);

} // namespace filters
