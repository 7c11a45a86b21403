// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlowDefaults.h"

#include "vtkGasTable.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace
{

std::string lowered(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](char letter)
    { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); });
  return text;
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// The words of an array's name as they are written, "rhoMean" being two, and what stands in brackets.
struct Name
{
  std::vector<std::string> words;
  std::string unit; ///< without blanks, stars and hats, in small letters: "kg/m3"

  explicit Name(const std::string& text)
  {
    const std::size_t open = text.find_first_of("[(");
    const std::size_t close = text.find_last_of("])");
    if (open != std::string::npos && close != std::string::npos && open < close)
    {
      for (const char letter : lowered(text.substr(open + 1, close - open - 1)))
      {
        if (!std::isspace(static_cast<unsigned char>(letter)) && letter != '^' && letter != '*')
        {
          this->unit += letter;
        }
      }
    }
    bool isInWord = false;
    char before = ' ';
    for (const char letter : text.substr(0, open))
    {
      const bool isOfWord = std::isalnum(static_cast<unsigned char>(letter)) != 0;
      const bool beginsWord = std::isupper(static_cast<unsigned char>(letter)) &&
        std::islower(static_cast<unsigned char>(before));
      if (isOfWord && (!isInWord || beginsWord))
      {
        this->words.emplace_back();
      }
      if (isOfWord)
      {
        this->words.back() += letter;
      }
      isInWord = isOfWord;
      before = letter;
    }
  }

  std::string joined() const
  {
    std::string all;
    for (const std::string& word : this->words)
    {
      all += lowered(word);
    }
    return all;
  }

  /// Whether it is one of these names, with nothing else than words that change no meaning. All of it
  /// has to be understood: "rho" is a density, "rhoU" is not.
  bool is(const std::set<std::string>& names) const
  {
    static const std::set<std::string> neutral = { "air", "average", "avg", "cell", "field", "flow",
      "fluid", "gas", "local", "mass", "mean", "mix", "mixture", "node", "point", "static",
      "value" };
    if (names.count(this->joined()))
    {
      return true;
    }
    int found = 0;
    for (const std::string& word : this->words)
    {
      const std::string small = lowered(word);
      if (names.count(small))
      {
        ++found;
      }
      else if (!neutral.count(small))
      {
        return false;
      }
    }
    return found == 1;
  }
};

const std::set<std::string> densities = { "rho", "density" };
const std::set<std::string> temperatures = { "t", "temp", "temperature" };
const std::set<std::string> pressures = { "p", "pres", "press", "pressure" };
const std::set<std::string> indices = { "n", "ior", "refractiveindex", "indexofrefraction",
  "refractionindex" };

/// Arrays that mark bodies with 1, and those that mark gas.
const std::set<std::string> solids = { "solid", "issolid", "solidmask", "solidfraction",
  "alphasolid", "obstacle", "body" };
const std::set<std::string> gases = { "iblank", "blank", "fluid", "isfluid", "fluidmask", "vfrac",
  "volfrac", "fluidfraction" };

/// Factors to kg/m^3, K and Pa.
const std::map<std::string, double> densityUnits = { { "kg/m3", 1 }, { "kgm-3", 1 },
  { "kg/m\xc2\xb3", 1 }, { "g/cm3", 1000 }, { "g/cc", 1000 }, { "gcm-3", 1000 }, { "g/ml", 1000 },
  { "kg/l", 1000 }, { "g/l", 1 }, { "g/m3", 1e-3 }, { "lb/ft3", 16.018463 },
  { "slug/ft3", 515.37882 } };
const std::map<std::string, double> temperatureUnits = { { "k", 1 }, { "kelvin", 1 } };
const std::map<std::string, double> pressureUnits = { { "pa", 1 }, { "n/m2", 1 }, { "hpa", 100 },
  { "mbar", 100 }, { "kpa", 1e3 }, { "mpa", 1e6 }, { "bar", 1e5 }, { "atm", 101325 },
  { "torr", 133.32237 }, { "mmhg", 133.32237 }, { "psi", 6894.7573 } };

/// Whether all of the words are a quantity and, written without brackets, a unit: "p_hPa".
const FlowArray* withUnitAsWord(const FlowArray& array, const std::set<std::string>& names,
  const std::map<std::string, double>& units, double& scale)
{
  Name name(array.name);
  if (name.words.size() > 1)
  {
    const auto unit = units.find(lowered(name.words.back()));
    name.words.pop_back();
    if (unit != units.end() && name.is(names))
    {
      scale = unit->second;
      return &array;
    }
  }
  return nullptr;
}

/// A fraction of a gas that the plugin knows.
struct Fraction
{
  std::string array;
  std::string gas;
  bool ofVolume;
};

/// Gases have formulas of capital and small letters: "Co" is not "CO"; their names do not.
std::string gasOf(const std::string& word)
{
  const std::string name = lowered(word);
  return vtkGasTable::Has(word) ? word : vtkGasTable::Has(name) ? name : std::string();
}

bool isFraction(const FlowArray& array, Fraction& fraction)
{
  // Solvers leave a little less than nothing and more than all.
  if (array.components != 1 || array.range[0] < -0.05 || array.range[1] > 1.05 ||
    array.range[1] <= 0)
  {
    return false;
  }
  std::vector<std::string> rest;
  bool isGiven = false;
  bool ofVolume = false;
  for (const std::string& word : Name(array.name).words)
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
  // "CamelCase" was taken apart: "YHe", "carbonDioxide"; and formulas: "SiH4".
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

std::string factor(double scale)
{
  std::string text = std::to_string(scale);
  while (contains(text, ".") && (text.back() == '0' || text.back() == '.'))
  {
    const bool isPoint = text.back() == '.';
    text.pop_back();
    if (isPoint)
    {
      break;
    }
  }
  return text;
}

/// The arrays of points, or those of cells.
class Chooser
{
public:
  Chooser(const std::vector<FlowArray>& all, FlowArray::Association association)
  {
    for (const FlowArray& array : all)
    {
      if (array.components == 1 && array.association == association &&
        array.range[0] <= array.range[1])
      {
        this->Arrays.push_back(array);
      }
    }
    this->Result.association = association;
  }

  bool choose()
  {
    return this->refractivity() || this->refractiveIndex() || this->density() || this->moistAir();
  }

  /// Any array, where none is understood.
  bool guess()
  {
    static const std::set<std::string> helpers = { "vtkGhostType", "vtkOriginalPointIds",
      "vtkOriginalCellIds", "vtkValidPointMask" };
    for (const FlowArray& array : this->Arrays)
    {
      const std::string name = Name(array.name).joined();
      if (!helpers.count(array.name) && !isNoDensity(array) && !solids.count(name) &&
        !gases.count(name))
      {
        this->Result.arrays = { { "Density", array.name } };
        this->Result.isSure = false;
        this->Result.message = this->Note + quoted(array.name) +
          " is taken as the density in kg/m\xc2\xb3, for no array is known by its name. Choose "
          "another one, or another Index Model, in the properties panel.";
        return true;
      }
    }
    return false;
  }

  bool isEmpty() const { return this->Arrays.empty(); }

  FlowDefaults Result;
  std::string Note; ///< what was not understood

private:
  /// The array of this quantity; those without other words first.
  const FlowArray* find(const std::set<std::string>& names) const
  {
    const FlowArray* found = nullptr;
    for (const FlowArray& array : this->Arrays)
    {
      const Name name(array.name);
      if (names.count(name.joined()))
      {
        return &array;
      }
      if (!found && name.is(names))
      {
        found = &array;
      }
    }
    return found;
  }

  /// The same of a quantity with a unit. Scale: 0 where the unit is not known.
  const FlowArray* find(const std::set<std::string>& names,
    const std::map<std::string, double>& units, double& scale) const
  {
    scale = 1;
    if (const FlowArray* array = this->find(names))
    {
      const std::string unit = Name(array->name).unit;
      const auto known = units.find(unit);
      scale = unit.empty() ? 1 : known == units.end() ? 0 : known->second;
      return array;
    }
    for (const FlowArray& array : this->Arrays)
    {
      if (const FlowArray* found = withUnitAsWord(array, names, units, scale))
      {
        return found;
      }
    }
    return nullptr;
  }

  bool refractivity()
  {
    const FlowArray* array = this->find({ "refractivity" });
    if (!array)
    {
      return false;
    }
    this->Result.indexModel = FlowDefaults::Refractivity;
    this->Result.arrays = { { "IndexArray", array->name } };
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
    this->Result.indexModel = FlowDefaults::RefractiveIndex;
    this->Result.arrays = { { "IndexArray", array->name } };
    this->Result.message = "Refractive index n: " + quoted(array->name) + ".";
    return true;
  }

  bool density()
  {
    double scale = 1;
    const FlowArray* array = this->find(densities, densityUnits, scale);
    if (!array)
    {
      return false;
    }
    if (scale == 0)
    {
      scale = 1;
      this->Note += "The unit of " + quoted(array->name) +
        " is not known: set Density Scale, an advanced property. ";
    }
    this->Result.arrays = { { "Density", array->name } };
    this->Result.message = "Density: " + quoted(array->name);
    if (scale == 1)
    {
      this->Result.message += " in kg/m\xc2\xb3";
    }
    else
    {
      this->Result.scales = { { "DensityScale", scale } };
      this->Result.message += ", " + factor(scale) + " kg/m\xc2\xb3 each";
    }
    this->species();
    this->Result.message += this->Result.fractions.empty() ? "; gas: air." : "; the rest: air.";
    return true;
  }

  void species()
  {
    std::vector<Fraction> found;
    for (const FlowArray& array : this->Arrays)
    {
      Fraction fraction;
      if (isFraction(array, fraction))
      {
        found.push_back(fraction);
      }
    }
    if (found.empty())
    {
      return;
    }
    // One kind only, and each gas once: both kinds are often written.
    this->Result.ofVolume = std::all_of(
      found.begin(), found.end(), [](const Fraction& fraction) { return fraction.ofVolume; });
    std::set<std::string> formulas;
    std::string list;
    for (const Fraction& fraction : found)
    {
      if (fraction.ofVolume == this->Result.ofVolume &&
        formulas.insert(vtkGasTable::GetFormula(fraction.gas)).second)
      {
        this->Result.fractions.push_back(fraction.array);
        this->Result.gases.push_back(fraction.gas);
        list += (list.empty() ? "" : ", ") + quoted(fraction.array);
      }
    }
    this->Result.indexModel = FlowDefaults::Mixture;
    this->Result.message += this->Result.ofVolume ? "; volume" : "; mass";
    this->Result.message += " fractions: " + list;
  }

  bool moistAir()
  {
    double kelvins = 1;
    double pascals = 1;
    const FlowArray* temperature = this->find(temperatures, temperatureUnits, kelvins);
    const FlowArray* pressure = this->find(pressures, pressureUnits, pascals);
    if (!temperature || !pressure)
    {
      return false;
    }
    if (kelvins == 0 || temperature->range[0] < 20 || temperature->range[1] < 150)
    {
      this->Note += "The temperature " + quoted(temperature->name) + " is not in kelvins. ";
      return false;
    }
    if (pascals == 0)
    {
      this->Note += "The unit of the pressure " + quoted(pressure->name) + " is not known. ";
      return false;
    }
    if (pressure->range[0] <= 0)
    {
      this->Note += "The pressure " + quoted(pressure->name) + " is not an absolute one. ";
      return false;
    }
    // Of the atmosphere, as weather models write it.
    const bool isOfAtmosphere =
      temperature->range[0] > 150 && temperature->range[1] < 350 && pressure->range[1] < 1100;
    const bool hasUnit =
      !Name(pressure->name).unit.empty() || pascals != 1; // where none is given, 1 is assumed
    if (!hasUnit && isOfAtmosphere && pressure->range[1] > 500)
    {
      pascals = 100;
    }
    else if (!hasUnit && isOfAtmosphere && pressure->range[1] > 50 && pressure->range[1] < 110)
    {
      pascals = 1000;
    }
    this->Result.indexModel = FlowDefaults::Ciddor;
    this->Result.arrays = { { "Temperature", temperature->name }, { "Pressure", pressure->name } };
    this->Result.message = "Air; temperature: " + quoted(temperature->name) +
      " in K; pressure: " + quoted(pressure->name);
    if (pascals == 1)
    {
      this->Result.message += " in Pa.";
    }
    else
    {
      this->Result.scales = { { "PressureScale", pascals } };
      this->Result.message += ", " + factor(pascals) + " Pa each.";
    }
    return true;
  }

  std::vector<FlowArray> Arrays;
};

/// What marks bodies, if anything is a body.
void chooseMask(const std::vector<FlowArray>& arrays, FlowDefaults& defaults)
{
  constexpr double threshold = 0.5; // the default of MaskThreshold
  for (const FlowArray& array : arrays)
  {
    const std::string name = Name(array.name).joined();
    const bool isOfGas = gases.count(name) > 0;
    if (defaults.mask.empty() && array.components == 1 && (isOfGas || solids.count(name)) &&
      array.range[0] < threshold && array.range[1] >= threshold)
    {
      defaults.mask = array.name;
      defaults.maskAssociation = array.association;
      defaults.isMaskOfGas = isOfGas;
      defaults.message += " No gas where " + quoted(array.name) + " is " +
        (isOfGas ? "less than 0.5." : "0.5 or more.");
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
bool isNoDensity(const FlowArray& array)
{
  const Name name(array.name);
  const std::string words = name.joined();
  if (name.is(temperatures) || name.is(pressures) || contains(words, "temperature") ||
    temperatureUnits.count(name.unit) || pressureUnits.count(name.unit))
  {
    return true;
  }
  const bool isNamedDensity = contains(words, "rho") || contains(words, "dens");
  return !isNamedDensity && array.range[0] >= 200 && array.range[1] <= 3000;
}

//------------------------------------------------------------------------------
FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays)
{
  std::vector<Chooser> choosers = { { arrays, FlowArray::Points }, { arrays, FlowArray::Cells } };
  for (Chooser& chooser : choosers)
  {
    if (chooser.choose())
    {
      chooser.Result.message = chooser.Note + chooser.Result.message;
      chooser.Result.isSure = chooser.Note.empty();
      chooseMask(arrays, chooser.Result);
      return chooser.Result;
    }
  }
  for (Chooser& chooser : choosers)
  {
    if (chooser.guess())
    {
      chooseMask(arrays, chooser.Result);
      return chooser.Result;
    }
  }
  FlowDefaults none;
  none.isSure = false;
  if (choosers[0].isEmpty() && choosers[1].isEmpty())
  {
    none.message = "There is no array with one value at a point or cell, so nothing gives the "
                   "refractive index. Load or compute a density.";
    return none;
  }
  none.message = choosers[0].Note + choosers[1].Note +
    "There is no density, nor a temperature together with a pressure, so nothing gives the "
    "refractive "
    "index. Load or compute one (Documentation/density.md says how), or choose an array yourself "
    "in "
    "the filter of the menu Filters > Schlieren.";
  return none;
}
