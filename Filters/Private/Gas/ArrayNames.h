// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the names that solvers give their arrays say: a quantity, a unit, a gas.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace filters
{

std::string lowered(std::string text);

/// Those that a flow may be known by.
enum class Quantity
{
  Density,
  Temperature,
  Pressure
};

/// Finds how well a name is understood as that of a quantity; the lowest is the best.
enum class Understood
{
  Exactly,   ///< the name alone, perhaps with its unit: "rho"
  Wholly,    ///< with words that change no meaning: "gas density"
  AsMean,    ///< a mean over time: "rhoMean"
  AsPart,    ///< of a component that has a number, perhaps the only one: "rho1", "alpha_rho1"
  AsSpecies, ///< of one of several species or phases: "rho_N2", "rho.water"
  Not
};

/// The words of an array's name as they are written, "rhoMean" being two, and what stands in brackets or at its end as a
/// unit.
class ArrayName
{
public:
  explicit ArrayName(const std::string& text);

  /// Of all of the name, brackets included.
  const std::vector<std::string>& AllWords() const { return this->All; }
  /// In small letters, without separators and the unit in brackets.
  std::string Joined() const;

  /// Whether it is one of these names, with nothing else than words that change no meaning. All of it has to be
  /// understood: "rho" is a density, "rhoU" is not.
  bool Is(const std::set<std::string>& names) const;

  Understood As(Quantity quantity) const;

  /// Whether the name has a unit; of `quantity`: the factor to SI units, 0 where it is not known or is no factor.
  bool HasUnit(Quantity quantity) const;
  double Scale(Quantity quantity) const;
  /// Degrees Celsius or Fahrenheit, of which no factor makes kelvins.
  bool IsInDegrees() const;
  /// Whether it says that it counts from the surroundings' pressure.
  bool IsGauge() const;
  /// Whether its unit is one of this quantity.
  bool HasUnitOf(Quantity quantity) const { return this->Scale(quantity) != 0; }

  /// Whether a word is that of a gas, or of a liquid or solid, as of one phase of several.
  bool IsOfGas() const;
  bool IsOfLiquid() const;

  /// Whether a word says that it is nothing of which a gas's index follows: an index, a fraction, a velocity, a
  /// gradient, ...
  bool IsSomethingElse() const;

private:
  struct Parsed
  {
    std::vector<std::string> words; ///< without those of the unit
    std::string unit;               ///< as it is written; empty: none
  };
  Parsed Of(Quantity quantity) const;

  std::vector<std::string> Words; ///< before the brackets and behind them
  std::vector<std::string> All;
  std::string Bracket; ///< what is in the last brackets
};

/// Factor to kg/m^3, K or Pa of a unit as it may be written: "g/cm3", "kg m^-3", "kg per m3", "hPa"; 0: not known.
double scaleOfUnit(Quantity quantity, const std::string& unit);

} // namespace filters
