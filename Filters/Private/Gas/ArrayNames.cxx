// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Gas/ArrayNames.h"

#include "Gas/GasChoices.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>

namespace filters
{

namespace
{

using Names = std::set<std::string>;

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

void replaceAll(std::string& text, const std::string& what, const std::string& by)
{
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
  {
    text.replace(at, what.size(), by);
  }
}

/// Splits a text before capitals of "CamelCase" and at all characters but letters and digits.
std::vector<std::string> wordsOf(const std::string& text)
{
  std::vector<std::string> words;
  bool isInWord = false;
  char before = ' ';
  for (const char letter : text)
  {
    const bool isOfWord = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    const bool beginsWord = std::isupper(static_cast<unsigned char>(letter)) &&
      std::islower(static_cast<unsigned char>(before));
    if (isOfWord && (!isInWord || beginsWord))
    {
      words.emplace_back();
    }
    if (isOfWord)
    {
      words.back() += letter;
    }
    isInWord = isOfWord;
    before = letter;
  }
  return words;
}

std::string joined(const std::vector<std::string>& words)
{
  std::string all;
  for (const std::string& word : words)
  {
    all += lowered(word);
  }
  return all;
}

constexpr const char* digits = "0123456789";

bool isNumber(const std::string& word)
{
  return !word.empty() && word.find_first_not_of(digits) == std::string::npos;
}

std::string withoutDigits(std::string word)
{
  return word.erase(word.find_last_not_of(digits) + 1);
}

/// Densities in several languages; dens: FLASH, Athena++; ro: CFL3D.
const Names densities = { "rho", "density", "dens", "ro", "massdensity", "massevolumique", "dichte",
  "densidad", "densit" };
const Names temperatures = { "t", "temp", "temperature" };
const Names pressures = { "p", "pres", "press", "prs", "pressure" };
const Names electrons = { "ne", "nelec", "nelectron", "nelectrons", "electrondensity",
  "electronnumberdensity", "edens" };

const Names& namesOf(Quantity quantity)
{
  return quantity == Quantity::Density  ? densities
    : quantity == Quantity::Temperature ? temperatures
    : quantity == Quantity::Electrons   ? electrons
                                        : pressures;
}

/// Words that change no meaning. sv: Fluent; thermo: OpenFOAM; prim, cons: AMR codes.
const Names neutral = { "abs", "absolute", "air", "carrier", "cell", "conservative", "conserved",
  "cons", "data", "field", "flow", "flowfield", "fluid", "gas", "gasphase", "inst", "instantaneous",
  "local", "mass", "mix", "mixture", "monitor", "node", "of", "point", "prim", "primitive",
  "solution", "static", "sv", "the", "thermo", "val", "value" };
const Names means = { "average", "averaged", "avg", "ave", "bar", "favre", "filtered", "mean",
  "reynolds", "time", "timeaverage", "timeaveraged" };
/// Phases for which the gas's relation of index and density does not hold.
const Names others = { "fuel", "liq", "liquid", "oil", "particle", "particles", "solid", "water" };

/// Masses in kilograms; for lengths, the volume in cubic metres of a cube with that side.
const std::map<std::string, double> masses = { { "kg", 1 }, { "kilogram", 1 }, { "kilograms", 1 },
  { "g", 1e-3 }, { "gm", 1e-3 }, { "gr", 1e-3 }, { "gram", 1e-3 }, { "grams", 1e-3 },
  { "mg", 1e-6 }, { "t", 1e3 }, { "ton", 1e3 }, { "tonne", 1e3 }, { "lb", 0.45359237 },
  { "lbm", 0.45359237 }, { "lbs", 0.45359237 }, { "slug", 14.593903 }, { "slugs", 14.593903 } };
const std::map<std::string, double> cubes = { { "m", 1 }, { "meter", 1 }, { "metre", 1 },
  { "dm", 1e-3 }, { "cm", 1e-6 }, { "mm", 1e-9 }, { "km", 1e9 }, { "in", 1.6387064e-5 },
  { "inch", 1.6387064e-5 }, { "ft", 0.028316846592 }, { "foot", 0.028316846592 } };
const std::map<std::string, double> volumes = { { "l", 1e-3 }, { "liter", 1e-3 }, { "litre", 1e-3 },
  { "dl", 1e-4 }, { "ml", 1e-6 }, { "cc", 1e-6 }, { "ccm", 1e-6 } };

constexpr double celsius = 273.15, fahrenheit = 459.67 * 5 / 9; // their zero, K
/// Units of temperature: their size and their zero, K.
const std::map<std::string, std::pair<double, double>> temperatureUnits = { { "k", { 1, 0 } },
  { "kelvin", { 1, 0 } }, { "degk", { 1, 0 } }, { "r", { 5. / 9, 0 } }, { "degr", { 5. / 9, 0 } },
  { "rankine", { 5. / 9, 0 } }, { "c", { 1, celsius } }, { "degc", { 1, celsius } },
  { "celsius", { 1, celsius } }, { "degcelsius", { 1, celsius } },
  { "degreescelsius", { 1, celsius } }, { "f", { 5. / 9, fahrenheit } },
  { "degf", { 5. / 9, fahrenheit } }, { "fahrenheit", { 5. / 9, fahrenheit } },
  { "degfahrenheit", { 5. / 9, fahrenheit } } };
const std::map<std::string, double> pascals = { { "pa", 1 }, { "pascal", 1 }, { "n/m2", 1 },
  { "nm-2", 1 }, { "j/m3", 1 }, { "kg/(ms2)", 1 }, { "kg/m/s2", 1 }, { "kgm-1s-2", 1 },
  { "hpa", 100 }, { "mbar", 100 }, { "kpa", 1e3 }, { "mpa", 1e6 }, { "n/mm2", 1e6 }, { "gpa", 1e9 },
  { "bar", 1e5 }, { "bara", 1e5 }, { "atm", 101325 }, { "torr", 133.32237 }, { "mmhg", 133.32237 },
  { "inhg", 3386.389 }, { "psi", 6894.7573 }, { "psia", 6894.7573 }, { "lbf/in2", 6894.7573 },
  { "psf", 47.880259 }, { "lbf/ft2", 47.880259 }, { "dyn/cm2", 0.1 }, { "dyne/cm2", 0.1 },
  { "dynes/cm2", 0.1 }, { "ba", 0.1 }, { "barye", 0.1 }, { "erg/cm3", 0.1 } };
const Names gauges = { "gauge", "gage", "psig", "barg", "pag", "kpag", "relative", "rel",
  "perturbation", "dynamic", "hydrostatic", "rgh", "prgh", "coefficient", "cp" };

/// Unifies the spelling of a unit: "kg m^{-3}", "kg/m**3", "kg per m3", "kg/m³".
std::string plainUnit(const std::string& text)
{
  std::string unit = text;
  replaceAll(unit, "Mg", "t"); // but mg
  unit = lowered(unit);
  for (const auto& [what, by] : std::initializer_list<std::pair<const char*, const char*>>{
         { "\xc2\xb2", "2" }, { "\xc2\xb3", "3" }, { "\xe2\x81\xbb", "-" }, { "\xc2\xb9", "1" },
         { "\xc2\xb7", "" }, { "\xe2\x8b\x85", "" }, { "\xc2\xb0", "deg" }, { "\xe2\x88\x92", "-" },
         { "<sup>", "" }, { "</sup>", "" }, { "<sub>", "" }, { "</sub>", "" }, { "cubic", "" } })
  {
    replaceAll(unit, what, by);
  }
  std::string plain;
  for (const char letter : unit)
  {
    if (!std::isspace(static_cast<unsigned char>(letter)) &&
      std::string("^*{}_.$\\").find(letter) == std::string::npos)
    {
      plain += letter;
    }
  }
  replaceAll(plain, "per", "/");
  return plain;
}

/// Removes rounding errors of products of factors: g/ml is exactly 1000.
double rounded(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return std::strtod(text, nullptr);
}

/// Returns the cubic metres of "/m3", "m-3", "(m3)", "cc", and "m3" within a name; 0: unknown.
double volumeOf(std::string unit)
{
  if (!unit.empty() && unit[0] == '/')
  {
    unit.erase(0, 1);
  }
  if (unit.size() > 2 && unit.front() == '(' && unit.back() == ')')
  {
    unit = unit.substr(1, unit.size() - 2);
  }
  for (const auto& [volume, cubicMetres] : volumes)
  {
    if (unit == volume || unit == volume + "-1")
    {
      return cubicMetres;
    }
  }
  for (const auto& [length, cubicMetres] : cubes)
  {
    if (unit == length + "3" || unit == length + "-3")
    {
      return cubicMetres;
    }
  }
  return 0;
}

/// Returns the factor of a number by a volume: "m-3", "1/cm3", "#/cc".
double numberScale(const std::string& unit)
{
  const bool hasNumerator = !unit.empty() && (unit[0] == '1' || unit[0] == '#');
  const double cubicMetres = volumeOf(hasNumerator ? unit.substr(1) : unit);
  return cubicMetres > 0 ? rounded(1 / cubicMetres) : 0;
}

/// Returns the factor of a mass by a volume: "kg/m3", "kgm-3", "g/cc", and "kgm3" within a name.
double densityScale(const std::string& unit)
{
  for (const auto& [mass, kilograms] : masses)
  {
    if (unit.compare(0, mass.size(), mass) != 0)
    {
      continue;
    }
    if (const double cubicMetres = volumeOf(unit.substr(mass.size())); cubicMetres > 0)
    {
      return rounded(kilograms / cubicMetres);
    }
  }
  return 0;
}

Understood understood(const std::vector<std::string>& words, const Names& names)
{
  const std::string all = joined(words);
  if (names.count(all))
  {
    return Understood::Exactly;
  }
  int found = 0;
  Understood how = Understood::Wholly;
  const auto atLeast = [&how](Understood other) { how = std::max(how, other); };
  for (const std::string& word : words)
  {
    const std::string small = lowered(word);
    if (names.count(small))
    {
      ++found;
    }
    else if (small.size() > 1 && names.count(withoutDigits(small)))
    {
      ++found;
      atLeast(Understood::AsPart);
    }
    else if (small.rfind("alpha", 0) == 0 && names.count(withoutDigits(small.substr(5))))
    {
      ++found; // "alpharho1"
      atLeast(Understood::AsPart);
    }
    else if (means.count(small))
    {
      atLeast(Understood::AsMean);
    }
    else if (isNumber(small) || small == "alpha")
    {
      atLeast(Understood::AsPart);
    }
    else if (neutral.count(small))
    {
      continue;
    }
    else if (others.count(small) || !gasOf(word).empty())
    {
      atLeast(Understood::AsSpecies);
    }
    else
    {
      return Understood::Not;
    }
  }
  return found == 1 ? how : Understood::Not;
}

bool anyIs(const std::vector<std::string>& words, const Names& names)
{
  return std::any_of(words.begin(), words.end(),
    [&](const std::string& word) { return names.count(lowered(word)) > 0; });
}

/// Returns whether a bracket has words instead of a unit: "density (gas)".
bool areWords(const std::string& bracket)
{
  const std::vector<std::string> words = wordsOf(bracket);
  return !words.empty() &&
    std::all_of(words.begin(), words.end(),
      [](const std::string& word)
      {
        const std::string small = lowered(word);
        return neutral.count(small) || means.count(small) || others.count(small);
      });
}

} // namespace

std::string lowered(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](char letter)
    { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); });
  return text;
}

double scaleOfUnit(Quantity quantity, const std::string& text)
{
  const std::string unit = plainUnit(text);
  if (quantity == Quantity::Density)
  {
    return densityScale(unit);
  }
  if (quantity == Quantity::Electrons)
  {
    return numberScale(unit);
  }
  if (quantity == Quantity::Pressure && contains(text, "mPa"))
  {
    return unit == "mpa" ? 1e-3 : 0;
  }
  if (quantity == Quantity::Temperature)
  {
    const auto found = temperatureUnits.find(unit);
    const bool isIndex = text == "c" || text == "f"; // "T_f", of a flame
    return found == temperatureUnits.end() || isIndex ? 0 : found->second.first;
  }
  const auto found = pascals.find(unit);
  return found == pascals.end() ? 0 : found->second;
}

ArrayName::ArrayName(const std::string& written)
{
  std::string text = written;
  replaceAll(text, "<greek>r</greek>", "rho"); // Tecplot
  replaceAll(text, "\xcf\x81", "rho");
  this->All = wordsOf(text);
  const std::size_t open = text.find_first_of("[(");
  const std::size_t close = text.find_last_of("])");
  if (open != std::string::npos && close != std::string::npos && open < close)
  {
    this->Bracket = text.substr(open + 1, close - open - 1);
    if (areWords(this->Bracket))
    {
      this->Bracket.clear();
    }
    else
    {
      text.erase(open, close - open + 1);
    }
  }
  this->Words = wordsOf(text);
}

std::string ArrayName::Joined() const { return joined(this->Words); }

bool ArrayName::Is(const std::set<std::string>& names) const
{
  return understood(this->Words, names) <= Understood::AsMean;
}

ArrayName::Parsed ArrayName::Of(Quantity quantity) const
{
  Parsed parsed{ this->Words, this->Bracket };
  constexpr std::size_t most = 5; // maximum number of words in a unit: "kg", "per", "m", "3"
  for (std::size_t count = std::min(most, this->Words.size()); parsed.unit.empty() && count > 0;
       --count)
  {
    const auto begin = this->Words.end() - static_cast<std::ptrdiff_t>(count);
    const std::string unit = std::accumulate(begin, this->Words.end(), std::string());
    const std::vector<std::string> rest(this->Words.begin(), begin);
    const bool isUnit = scaleOfUnit(quantity, unit) != 0 ||
      (quantity == Quantity::Temperature && temperatureUnits.count(lowered(unit)));
    if (isUnit && understood(rest, namesOf(quantity)) != Understood::Not)
    {
      parsed = { rest, unit };
    }
  }
  return parsed;
}

Understood ArrayName::As(Quantity quantity) const
{
  return understood(this->Of(quantity).words, namesOf(quantity));
}

bool ArrayName::HasUnit(Quantity quantity) const { return !this->Of(quantity).unit.empty(); }

double ArrayName::Scale(Quantity quantity) const
{
  return scaleOfUnit(quantity, this->Of(quantity).unit);
}

double ArrayName::ZeroInKelvins() const
{
  const auto found = temperatureUnits.find(plainUnit(this->Of(Quantity::Temperature).unit));
  return this->HasUnitOf(Quantity::Temperature) ? found->second.second : 0;
}

bool ArrayName::IsGauge() const
{
  return gauges.count(plainUnit(this->Bracket)) > 0 || gauges.count(this->Joined()) > 0 ||
    anyIs(this->All, gauges);
}

bool ArrayName::IsOfGas() const
{
  static const Names phases = { "air", "carrier", "gas", "gasphase" };
  return anyIs(this->All, phases);
}

bool ArrayName::IsOfLiquid() const { return anyIs(this->All, others); }

bool ArrayName::IsSomethingElse() const
{
  static const Names elsewhere = { "alpha", "angle", "area", "block", "blocks", "cfl", "charge",
    "concentration", "coord", "coordinate", "coordinates", "count", "cp", "current", "deviation",
    "displacement", "distance", "div", "divergence", "dt", "element", "energy", "enthalpy",
    "entropy", "epsilon", "error", "fraction", "gamma", "ghost", "global", "grad", "gradient",
    "helicity", "iblank", "id", "ids", "index", "k", "lambda2", "level", "lnx", "mach", "magnitude",
    "mask", "material", "momentum", "mu", "node", "normal", "normals", "nu", "nut", "nutilda",
    "number", "obstacle", "omega", "part", "partition", "phi", "pressure", "proc", "process",
    "processor", "q", "qcriterion", "rank", "region", "residual", "rhoe", "rhou", "rhov", "rhow",
    "rms", "schlieren", "solid", "species", "speed", "strain", "stress", "tau", "temperature",
    "tke", "type", "u", "v", "vel", "velocity", "viscosity", "visc", "volume", "vorticity", "w",
    "wall", "x", "y", "yplus", "z", "zone" };
  return std::any_of(this->All.begin(), this->All.end(),
    [](const std::string& word)
    {
      const std::string small = lowered(word);
      return elsewhere.count(small) > 0 || elsewhere.count(withoutDigits(small)) > 0;
    });
}

} // namespace filters
