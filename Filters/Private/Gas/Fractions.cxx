// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/Fractions.h"

#include "Gas/ArrayNames.h"
#include "Gas/GasChoices.h"

#include "Schlieren.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

namespace filters
{

namespace
{

/// Words that say that an array is a fraction, and of what. molef: Fluent; massfrac: CONVERGE.
const std::map<std::string, FractionOf> kinds = { { "y", FractionOf::Mass },
  { "yi", FractionOf::Mass }, { "mass", FractionOf::Mass }, { "massf", FractionOf::Mass },
  { "massfrac", FractionOf::Mass }, { "massfraction", FractionOf::Mass },
  { "x", FractionOf::Volume }, { "xi", FractionOf::Volume }, { "mole", FractionOf::Volume },
  { "molar", FractionOf::Volume }, { "molef", FractionOf::Volume },
  { "molefrac", FractionOf::Volume }, { "molefraction", FractionOf::Volume },
  { "volume", FractionOf::Volume }, { "volumefraction", FractionOf::Volume },
  { "rho", FractionOf::Density }, { "density", FractionOf::Density } };

/// Fractions of what is no gas, and other words behind x and y.
const std::set<std::string> others = { "center", "cloud", "component", "direction", "gas", "ice",
  "liquid", "mixture", "phase", "plus", "position", "progress", "star", "void", "water" };

/// Less of an unknown gas changes the index by a per cent or two.
constexpr double least = 0.02;

/// Returns whether a name is a chemical formula of several atoms: "C4H10", or "c4h10".
bool isFormula(const std::string& name)
{
  constexpr std::size_t longest = 16;
  static const std::regex formula("(?=.*[0-9])(((C|H|O|N|I|S|F|Si|Cl|Br|Ar|He)[0-9]*){2,}|"
                                  "([chon][0-9]*){2,})");
  return name.size() <= longest && std::regex_match(name, formula);
}

} // namespace

std::optional<Fraction> fractionOf(const FlowArray& array)
{
  Fraction fraction{ array.name, "", FractionOf::Mass, false };
  std::vector<std::string> rest;
  bool isGiven = false, isCalledFraction = false;
  const ArrayName name(array.name);
  for (const std::string& word : name.AllWords())
  {
    const std::string small = lowered(word);
    const bool hasFraction = small.find("frac") != std::string::npos;
    if (const auto found = kinds.find(small); found != kinds.end())
    {
      fraction.kind = isGiven ? std::max(fraction.kind, found->second) : found->second;
      isGiven = true;
      isCalledFraction =
        isCalledFraction || hasFraction || small.size() <= 2 || small.back() == 'f'; // x, yi, molef
    }
    else if (!hasFraction && small != "of" && small != "mean" && small != "sv")
    {
      rest.push_back(word);
    }
    isCalledFraction = isCalledFraction || hasFraction;
  }
  std::string text, joined;
  for (const std::string& word : rest)
  {
    text += (text.empty() ? "" : " ") + word;
    joined += word; // what the split at capitals has separated: "YHe", "carbonDioxide", "SiH4"
  }
  fraction.gas = gasOf(text);
  fraction.gas = fraction.gas.empty() ? gasOf(joined) : fraction.gas;
  if (fraction.gas.empty() && rest.size() == 1 && !isGiven && text.size() > 1 &&
    std::string("YyXx").find(text[0]) != std::string::npos)
  {
    fraction.gas = gasOf(text.substr(1));
    fraction.kind = std::tolower(text[0]) == 'x' ? FractionOf::Volume : FractionOf::Mass;
    isGiven = true;
  }
  // Solvers undershoot 0 and overshoot 1 a little.
  const bool isPartial = fraction.kind == FractionOf::Density;
  if (array.components != 1 || array.range[0] < -0.05 || array.range[1] <= 0 ||
    (!isPartial && array.range[1] > 1.05))
  {
    return {};
  }
  if (!fraction.gas.empty())
  {
    fraction.isSure = isGiven || text.size() > 2 || (text.size() > 1 && text != lowered(text)) ||
      std::isdigit(static_cast<unsigned char>(text.back()));
    return isPartial && fraction.gas == "air" ? std::nullopt : std::make_optional(fraction);
  }
  const bool isOther = isPartial || !isCalledFraction || rest.empty() ||
    ArrayName(text).IsSomethingElse() ||
    std::any_of(rest.begin(), rest.end(),
      [](const std::string& word) { return others.count(lowered(word)) > 0; });
  return array.range[1] >= least && (!isOther || isFormula(joined)) ? std::make_optional(fraction)
                                                                    : std::nullopt;
}

bool arePartialDensities(const std::vector<std::string>& names)
{
  const auto partial = std::count_if(names.begin(), names.end(),
    [](const std::string& name)
    {
      const auto fraction = fractionOf({ name, FlowArray::Points, 1, { 0, 1 } });
      return fraction && fraction->kind == FractionOf::Density;
    });
  if (partial > 0 && partial < static_cast<std::ptrdiff_t>(names.size()))
  {
    throw std::runtime_error("MixtureArrays has partial densities, by their names, and fractions. "
                             "Give arrays of one kind.");
  }
  return partial > 0;
}

std::string noteOnFractions(
  const std::vector<FlowArray>& arrays, const std::vector<std::string>& used)
{
  const auto isUsed = [&used](const std::string& name)
  { return std::find(used.begin(), used.end(), name) != used.end(); };
  std::set<std::string> gases, names;
  for (const FlowArray& array : arrays)
  {
    const auto fraction = fractionOf(array);
    if (fraction && isUsed(array.name))
    {
      gases.insert(fraction->gas);
    }
  }
  std::string list;
  for (const FlowArray& array : arrays)
  {
    const auto fraction = fractionOf(array);
    if (fraction && !isUsed(array.name) &&
      (fraction->gas.empty() || (fraction->isSure && gases.count(fraction->gas) == 0)) &&
      names.insert(array.name).second)
    {
      list += (list.empty() ? "'" : ", '") + array.name + "'";
    }
  }
  return list.empty() ? ""
                      : list +
      (names.size() == 1 ? " looks like the fraction of a gas and is"
                         : " look like fractions of gases and are") +
      " not used, so what there is of it counts as air or as BackgroundGas. For a mixture, name "
      "all "
      "fractions in MixtureArrays, for points or cells like the density, and their gases or "
      "constants in MixtureGases (Documentation/gases.md).";
}

} // namespace filters
