// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlowDefaults.h"

#include "Common/NumberText.h"

#include "Gas/ArrayNames.h"
#include "Schlieren.h"

#include <algorithm>
#include <cctype>
#include <set>

using filters::ArrayName;
using filters::lowered;
using filters::Quantity;
using filters::Understood;

namespace
{

using filters::textOf;

/// The arrays of withUniformPressure() and withStagnation().
constexpr const char* uniformPressure = "Pressure [Pa]";
constexpr const char* stagnationTemperature = "Temperature [K]";

const std::set<std::string> indices = { "n", "ior", "refractiveindex", "indexofrefraction",
  "refractionindex" };
const std::set<std::string> refractivities = { "refractivity", "nminus1" };
const std::set<std::string> humidities = { "rh", "humidity", "relativehumidity", "relhumidity" };

/// Names of arrays that are 1 in bodies, and of those that are 1 in gas.
const std::set<std::string> solids = { "solid", "issolid", "solidmask", "solidfraction",
  "alphasolid", "obstacle", "body" };
const std::set<std::string> gases = { "iblank", "blank", "fluid", "isfluid", "fluidmask", "vfrac",
  "volfrac", "fluidfraction" };

/// The fraction of a gas of the table.
struct Fraction
{
  std::string array;
  std::string gas;
  bool ofVolume;
};

/// Matches formulas with case ("Co" is not "CO"), names without.
std::string gasOf(const std::string& word)
{
  const std::string name = lowered(word);
  return schlieren::findGas(word) ? word : schlieren::findGas(name) ? name : std::string();
}

bool isFraction(const FlowArray& array, Fraction& fraction)
{
  // Solvers undershoot 0 and overshoot 1 a little.
  if (array.components != 1 || array.range[0] < -0.05 || array.range[1] > 1.05 ||
    array.range[1] <= 0)
  {
    return false;
  }
  const ArrayName name(array.name);
  std::vector<std::string> rest;
  bool isGiven = false;
  bool ofVolume = false;
  for (const std::string& word : name.AllWords())
  {
    const std::string small = lowered(word);
    if (small == "y" || small == "mass" || small == "massfraction")
    {
      isGiven = true;
    }
    else if (small == "x" || small == "mole" || small == "molar" || small == "volume" ||
      small == "molefraction" || small == "volumefraction")
    {
      isGiven = ofVolume = true;
    }
    else if (small != "fraction" && small != "of" && small != "mean")
    {
      rest.push_back(word);
    }
  }
  std::string text;
  for (const std::string& word : rest)
  {
    text += (text.empty() ? "" : " ") + word;
  }
  fraction = { array.name, gasOf(text), ofVolume };
  // Joins what the split at capitals has separated: "YHe", "carbonDioxide", "SiH4".
  if (fraction.gas.empty() && rest.size() > 1)
  {
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    fraction.gas = gasOf(text);
  }
  if (fraction.gas.empty() && rest.size() == 1 && !isGiven && text.size() > 1 &&
    std::string("YyXx").find(text[0]) != std::string::npos)
  {
    fraction.gas = gasOf(text.substr(1));
    fraction.ofVolume = std::tolower(text[0]) == 'x';
  }
  return !fraction.gas.empty();
}

std::string quoted(const std::string& name) { return "'" + name + "'"; }

std::string rangeInWords(const FlowArray& array)
{
  return textOf(array.range[0]) + " to " + textOf(array.range[1]);
}

bool isScalar(const FlowArray& array)
{
  return array.components == 1 && array.range[0] <= array.range[1];
}

/// Returns whether VTK has made the array, which then is no state of a gas.
bool isVtkOwn(const std::string& name) { return name.rfind("vtk", 0) == 0; }

constexpr FlowArray::Association associations[] = { FlowArray::Points, FlowArray::Cells };

/// An array whose name is understood, with its factor to SI units; 0: unknown unit.
struct Found
{
  const FlowArray* array = nullptr;
  double scale = 1;
};

/// Chooses among the arrays of one component.
class Chooser
{
public:
  explicit Chooser(const std::vector<FlowArray>& all)
  {
    std::copy_if(all.begin(), all.end(), std::back_inserter(this->Arrays), isScalar);
  }

  bool isEmpty() const { return this->Arrays.empty(); }

  bool choose()
  {
    return this->refractivity() || this->refractiveIndex() || this->density(true) ||
      this->moistAir();
  }

  bool choose(MediumSettings::Models model)
  {
    this->Result.indexModel = model;
    switch (model)
    {
      case MediumSettings::RefractiveIndex:
        return this->refractiveIndex();
      case MediumSettings::Refractivity:
        return this->refractivity();
      case MediumSettings::Ciddor:
        return this->moistAir();
      default:
        return this->density(model == MediumSettings::Mixture);
    }
  }

  /// Chooses the fractions alone.
  void chooseSpecies(FlowArray::Association association)
  {
    this->Result.association = association;
    this->species();
  }

  FlowDefaults Result;
  std::string Note; ///< names that were not understood

  bool has(Quantity quantity) const
  {
    return std::any_of(this->Arrays.begin(), this->Arrays.end(),
      [quantity](const FlowArray& array)
      { return array.components == 1 && ArrayName(array.name).As(quantity) != Understood::Not; });
  }

private:
  /// Finds the array that best matches a quantity, points before cells.
  Found find(Quantity quantity, FlowArray::Association association)
  {
    Understood best = Understood::Not;
    Found found;
    std::string several; // arrays of species or components, none of which is the total
    int parts = 0;
    bool isOfPhase = false, areLiquids = false;
    for (const FlowArray& array : this->Arrays)
    {
      const ArrayName name(array.name);
      const Understood how = name.As(quantity);
      if (array.association != association || how == Understood::Not || isOfAnother(name, quantity))
      {
        continue;
      }
      if (how >= Understood::AsPart)
      {
        ++parts;
        several += (several.empty() ? "" : ", ") + quoted(array.name);
        areLiquids = areLiquids || name.IsOfLiquid();
      }
      if (how < best)
      {
        best = how;
        isOfPhase = name.IsOfGas();
        const double scale = name.Scale(quantity);
        found = { &array, scale != 0 || name.HasUnit(quantity) ? scale : 1 };
      }
    }
    if (best == Understood::AsSpecies || (best == Understood::AsPart && parts > 1) ||
      (isOfPhase && areLiquids))
    {
      if (found.array && best < Understood::AsPart)
      {
        ++parts;
        several = quoted(found.array->name) + ", " + several;
      }
      this->Note += (parts > 1 ? several + " are" : several + " is") +
        (quantity == Quantity::Density
            ? " of single species or phases: add their densities up, for instance with Calculator. "
            : " of single species or phases. ");
      return {};
    }
    return found;
  }

  /// Returns whether the unit belongs to another quantity.
  static bool isOfAnother(const ArrayName& name, Quantity quantity)
  {
    for (const Quantity other : { Quantity::Density, Quantity::Temperature, Quantity::Pressure })
    {
      if (other != quantity && name.HasUnitOf(other) && !name.HasUnitOf(quantity))
      {
        return true;
      }
    }
    return false;
  }

  const FlowArray* find(const std::set<std::string>& names) const
  {
    for (const FlowArray::Association association : associations)
    {
      for (const FlowArray& array : this->Arrays)
      {
        if (array.association == association && ArrayName(array.name).Is(names))
        {
          return &array;
        }
      }
    }
    return nullptr;
  }

  bool refractivity()
  {
    const FlowArray* array = this->find(refractivities);
    if (!array)
    {
      return false;
    }
    this->take(MediumSettings::Refractivity, array->association, { { "IndexArray", array->name } });
    this->Result.message = "Refractivity n - 1: " + quoted(array->name) + ".";
    return true;
  }

  bool refractiveIndex()
  {
    const FlowArray* array = this->find(indices);
    if (!array || array->range[0] < 0.9 || array->range[1] > 4.5)
    {
      return false;
    }
    this->take(
      MediumSettings::RefractiveIndex, array->association, { { "IndexArray", array->name } });
    this->Result.message = "Refractive index n: " + quoted(array->name) + ".";
    return true;
  }

  void take(MediumSettings::Models model, FlowArray::Association association,
    std::vector<std::pair<std::string, std::string>> arrays)
  {
    this->Result.indexModel = model;
    this->Result.association = association;
    this->Result.arrays = std::move(arrays);
  }

  bool density(bool ofSpecies)
  {
    Found found;
    for (const FlowArray::Association association : associations)
    {
      const Found other = this->find(Quantity::Density, association);
      const auto rank = [](const Found& one)
      { return one.array ? ArrayName(one.array->name).As(Quantity::Density) : Understood::Not; };
      found = rank(other) < rank(found) ? other : found;
    }
    if (!found.array)
    {
      return false;
    }
    this->Note.clear(); // it concerns the other association
    if (found.scale == 0)
    {
      found.scale = 1;
      this->Note += "The unit of " + quoted(found.array->name) +
        " is not known: set Density Scale, an advanced property. ";
    }
    this->take(
      this->Result.indexModel, found.array->association, { { "Density", found.array->name } });
    this->Result.message = "Density: " + quoted(found.array->name);
    if (found.scale == 1)
    {
      this->Result.message += " in kg/m\xc2\xb3";
    }
    else
    {
      this->Result.scales = { { "DensityScale", found.scale } };
      this->Result.message += ", " + textOf(found.scale) + " kg/m\xc2\xb3 each";
    }
    if (ofSpecies)
    {
      this->species();
    }
    this->Result.message += this->Result.fractions.empty() ? "; gas: air." : "; the rest: air.";
    return true;
  }

  void species()
  {
    std::vector<Fraction> found;
    for (const FlowArray& array : this->Arrays)
    {
      Fraction fraction;
      if (array.association == this->Result.association && isFraction(array, fraction))
      {
        found.push_back(fraction);
      }
    }
    if (found.empty())
    {
      return;
    }
    // Uses fractions of one kind, and each gas once: files often have both kinds.
    this->Result.ofVolume = std::all_of(
      found.begin(), found.end(), [](const Fraction& fraction) { return fraction.ofVolume; });
    std::set<std::string> formulas;
    std::string list;
    for (const Fraction& fraction : found)
    {
      if (fraction.ofVolume == this->Result.ofVolume &&
        formulas.insert(std::string(schlieren::findGas(fraction.gas)->formula)).second)
      {
        this->Result.fractions.push_back(fraction.array);
        this->Result.gases.push_back(fraction.gas);
        list += (list.empty() ? "" : ", ") + quoted(fraction.array);
      }
    }
    this->Result.indexModel = MediumSettings::Mixture;
    this->Result.message += this->Result.ofVolume ? "; volume" : "; mass";
    this->Result.message += " fractions: " + list;
  }

  bool moistAir()
  {
    for (const FlowArray::Association association : associations)
    {
      if (this->moistAir(association))
      {
        return true;
      }
    }
    return false;
  }

  bool moistAir(FlowArray::Association association)
  {
    const Found temperature = this->find(Quantity::Temperature, association);
    const Found pressure = this->find(Quantity::Pressure, association);
    const double kelvins = temperature.scale;
    double pascals = pressure.scale;
    if (!temperature.array || !pressure.array)
    {
      return false;
    }
    const auto& t = temperature.array->range;
    const auto& p = pressure.array->range;
    if (kelvins == 0 || t[0] * kelvins < 20 || t[1] * kelvins < 150)
    {
      this->Note += "The temperature " + quoted(temperature.array->name) + " is not in kelvins (" +
        rangeInWords(*temperature.array) + "): to degrees Celsius, add 273.15 with Calculator. ";
      return false;
    }
    if (pascals == 0)
    {
      this->Note += "The unit of the pressure " + quoted(pressure.array->name) + " is not known. ";
      return false;
    }
    if (p[0] <= 0 || ArrayName(pressure.array->name).IsGauge())
    {
      this->Note += "The pressure " + quoted(pressure.array->name) + " is not an absolute one (" +
        rangeInWords(*pressure.array) + "): add what it counts from with Calculator. ";
      return false;
    }
    // Accepts the units of weather models where the values are those of the atmosphere.
    const bool isOfAtmosphere = t[0] > 150 && t[1] < 350 && p[1] < 1100;
    const bool hasUnit = ArrayName(pressure.array->name).HasUnit(Quantity::Pressure);
    if (!hasUnit && isOfAtmosphere && p[1] > 500)
    {
      pascals = 100;
    }
    else if (!hasUnit && isOfAtmosphere && p[1] > 50 && p[1] < 110)
    {
      pascals = 1000;
    }
    this->take(MediumSettings::Ciddor, association,
      { { "Temperature", temperature.array->name }, { "Pressure", pressure.array->name } });
    this->Result.message = "Air; temperature: " + quoted(temperature.array->name);
    if (kelvins == 1)
    {
      this->Result.message += " in K";
    }
    else
    {
      this->Result.scales.emplace_back("TemperatureScale", kelvins);
      this->Result.message += ", " + textOf(kelvins) + " K each";
    }
    this->Result.message += "; pressure: " + quoted(pressure.array->name);
    if (pascals == 1)
    {
      this->Result.message += " in Pa";
    }
    else
    {
      this->Result.scales.emplace_back("PressureScale", pascals);
      this->Result.message += ", " + textOf(pascals) + " Pa each";
    }
    this->humidity(association);
    this->Result.message += ".";
    return true;
  }

  /// Chooses a relative humidity between 0 and 1, not one in percent.
  void humidity(FlowArray::Association association)
  {
    constexpr double most = 1.05;
    for (const FlowArray& array : this->Arrays)
    {
      if (array.association == association && ArrayName(array.name).Is(humidities) &&
        array.range[0] >= 0 && array.range[1] <= most)
      {
        this->Result.arrays.emplace_back("Humidity", array.name);
        this->Result.message += "; relative humidity: " + quoted(array.name);
        return;
      }
    }
  }

  std::vector<FlowArray> Arrays;
};

/// Returns what a chooser has found, or a message about what is missing.
FlowDefaults resultOf(Chooser& chooser, bool isFound, const std::vector<FlowArray>& arrays,
  const std::string& isMissing)
{
  if (isFound)
  {
    chooser.Result.message = chooser.Note + chooser.Result.message;
    chooser.Result.isSure = chooser.Note.empty();
    chooser.Result.note = chooser.Note;
    const std::string mask = flowMask(arrays).array;
    chooser.Result.message += mask.empty() ? ""
                                           : " No gas where " + quoted(mask) + " is " +
        (marksGas(mask) ? "less than 0.5." : "0.5 or more.");
    return chooser.Result;
  }
  FlowDefaults none;
  none.isSure = false;
  none.note = chooser.Note;
  if (chooser.isEmpty())
  {
    none.message = "There is no array with one value at a point or cell, so nothing gives the "
                   "refractive index. Load or compute a density.";
    return none;
  }
  const std::string names = arraysInWords(arrays);
  none.message = chooser.Note + isMissing + (names.empty() ? "" : " There are " + names + ".");
  return none;
}

} // namespace

//------------------------------------------------------------------------------
bool isNoDensity(const FlowArray& array)
{
  const ArrayName name(array.name);
  if (name.As(Quantity::Density) != Understood::Not && !name.HasUnitOf(Quantity::Temperature) &&
    !name.HasUnitOf(Quantity::Pressure))
  {
    return false;
  }
  const std::string words = name.Joined();
  if (name.As(Quantity::Temperature) <= Understood::AsPart ||
    name.As(Quantity::Pressure) <= Understood::AsPart || name.HasUnitOf(Quantity::Temperature) ||
    name.HasUnitOf(Quantity::Pressure) || name.IsSomethingElse() || isVtkOwn(array.name) ||
    solids.count(words) || gases.count(words))
  {
    return true;
  }
  const auto contains = [&words](const char* part)
  { return words.find(part) != std::string::npos; };
  return contains("temperature") || contains("gradient") ||
    (!contains("rho") && !contains("dens") && array.range[0] >= 200 && array.range[1] <= 3000);
}

//------------------------------------------------------------------------------
FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays)
{
  Chooser chooser(arrays);
  const bool isFound = chooser.choose();
  return resultOf(chooser, isFound, arrays,
    "There is no density, nor a temperature together with a pressure, so nothing gives the "
    "refractive index. Load or compute one (Documentation/density.md says how), or choose an array "
    "yourself." +
      std::string(chooser.has(Quantity::Temperature)
          ? " Where the pressure of air is the same everywhere, UniformPressure completes the "
            "temperature (101325 Pa in a room)."
          : chooser.has(Quantity::Pressure)
          ? " Of air without heat and strong shocks, StagnationTemperature completes the pressure "
            "(293.15 K in a room)."
          : ""));
}

namespace
{

std::vector<FlowArray> withConstant(std::vector<FlowArray> arrays, const char* name, double value)
{
  for (const FlowArray::Association association : associations)
  {
    arrays.push_back({ name, association, 1, { value, value } });
  }
  return arrays;
}

/// Takes the array of withConstant() out of the choice, and says what is in its place. Returns whether it was there.
bool replaceConstant(
  FlowDefaults& defaults, const char* property, const char* name, const std::string& words)
{
  if (defaults.arrayOf(property) != name)
  {
    return false;
  }
  const auto chosen = std::make_pair(std::string(property), std::string(name));
  defaults.arrays.erase(
    std::remove(defaults.arrays.begin(), defaults.arrays.end(), chosen), defaults.arrays.end());
  const std::string array = quoted(name) + (chosen.first == "Pressure" ? " in Pa" : " in K");
  defaults.message.replace(defaults.message.find(array), array.size(), words);
  return true;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<FlowArray> withUniformPressure(std::vector<FlowArray> arrays, double pascals)
{
  return withConstant(std::move(arrays), uniformPressure, pascals);
}

//------------------------------------------------------------------------------
FlowDefaults flowDefaultsAt(const std::vector<FlowArray>& arrays, double pascals)
{
  FlowDefaults defaults = flowDefaults(withUniformPressure(arrays, pascals));
  if (replaceConstant(defaults, "Pressure", uniformPressure, textOf(pascals, 6) + " Pa everywhere"))
  {
    defaults.uniformPressure = pascals;
  }
  return defaults;
}

//------------------------------------------------------------------------------
std::vector<FlowArray> withStagnation(std::vector<FlowArray> arrays, double kelvins)
{
  return withConstant(std::move(arrays), stagnationTemperature, kelvins);
}

//------------------------------------------------------------------------------
FlowDefaults flowDefaultsFromRest(const std::vector<FlowArray>& arrays, double kelvins)
{
  FlowDefaults defaults = flowDefaults(withStagnation(arrays, kelvins));
  if (replaceConstant(defaults, "Temperature", stagnationTemperature,
        "isentropic, " + textOf(kelvins, 6) + " K at rest"))
  {
    defaults.stagnationTemperature = kelvins;
  }
  return defaults;
}

//------------------------------------------------------------------------------
FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays, MediumSettings::Models model)
{
  Chooser chooser(arrays);
  const bool isFound = chooser.choose(model);
  FlowDefaults result =
    resultOf(chooser, isFound, arrays, "No array is known by its name: choose it yourself.");
  result.indexModel = model;
  return result;
}

//------------------------------------------------------------------------------
FlowDefaults flowSpecies(const std::vector<FlowArray>& arrays, FlowArray::Association association)
{
  Chooser chooser(arrays);
  chooser.chooseSpecies(association);
  return chooser.Result;
}

//------------------------------------------------------------------------------
MaskDefault flowMask(const std::vector<FlowArray>& arrays, double threshold)
{
  const auto found = std::find_if(arrays.begin(), arrays.end(),
    [threshold](const FlowArray& array)
    {
      const bool isMask = marksGas(array.name) || solids.count(ArrayName(array.name).Joined()) > 0;
      return array.components == 1 && isMask && array.range[0] < threshold &&
        array.range[1] >= threshold;
    });
  return found == arrays.end() ? MaskDefault() : MaskDefault{ found->name, found->association };
}

//------------------------------------------------------------------------------
bool marksGas(const std::string& array) { return gases.count(ArrayName(array).Joined()) > 0; }

//------------------------------------------------------------------------------
bool dependsOnRange(const std::string& text)
{
  const ArrayName name(text);
  const std::string words = name.Joined();
  Fraction fraction;
  return name.As(Quantity::Temperature) != Understood::Not ||
    name.As(Quantity::Pressure) != Understood::Not || name.Is(indices) || name.Is(humidities) ||
    solids.count(words) || gases.count(words) ||
    isFraction({ text, FlowArray::Points, 1, { 0, 1 } }, fraction);
}

//------------------------------------------------------------------------------
double scaleByUnit(const std::string& property, const std::string& array)
{
  return ArrayName(array).Scale(property == "Density" ? Quantity::Density
      : property == "Temperature"                     ? Quantity::Temperature
                                                      : Quantity::Pressure);
}

//------------------------------------------------------------------------------
std::string arraysInWords(const std::vector<FlowArray>& arrays)
{
  std::string text;
  for (const FlowArray::Association association : associations)
  {
    std::string separator = text.empty() ? "" : "; ";
    separator += association == FlowArray::Cells ? "cell arrays " : "point arrays ";
    for (const FlowArray& array : arrays)
    {
      if (isScalar(array) && array.association == association && !isVtkOwn(array.name))
      {
        text += separator + array.name + " (" + rangeInWords(array) + ")";
        separator = ", ";
      }
    }
  }
  return text;
}
