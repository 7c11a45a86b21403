// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlowDefaults.h"

#include "Gas/FlowChooser.h"
#include "Gas/Fractions.h"
#include "NumberText.h"

#include <algorithm>
#include <set>

using namespace filters;

namespace
{

/// The array of withUniformPressure().
constexpr const char* uniformPressure = "Pressure [Pa]";

/// The array of OpenFOAM's overset meshes.
constexpr const char* oversetCells = "celltypes";

/// Names of arrays that are 1 in bodies, and of those that are 1 in gas.
const std::set<std::string> solids = { "solid", "issolid", "solidmask", "solidfraction",
  "alphasolid", "obstacle", "body" };
const std::set<std::string> gases = { "iblank", "blank", "fluid", "isfluid", "fluidmask", "vfrac",
  "volfrac", "fluidfraction" };

/// Returns whether VTK has made the array, which then is no state of a gas.
bool isVtkOwn(const std::string& name) { return name.rfind("vtk", 0) == 0; }

/// Returns a note on arrays that hold several quantities at each place; mostly empty. Those with 6 and 9 components are
/// tensors.
std::string noteOnStates(const std::vector<FlowArray>& arrays)
{
  for (const FlowArray& array : arrays)
  {
    if (array.components > 3 && array.components != 6 && array.components != 9)
    {
      return quoted(array.name) + " has " + std::to_string(array.components) +
        " components, perhaps the conserved quantities. Make an array of the density, mostly the "
        "first one, with "
        "Calculator: '" +
        array.name + "_0'. ";
    }
  }
  return "";
}

/// Returns what a chooser has found, or a message about what is missing.
FlowDefaults resultOf(FlowChooser& chooser, bool isFound, const std::vector<FlowArray>& arrays,
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
  chooser.Note += noteOnStates(arrays);
  none.note = chooser.Note;
  if (chooser.isEmpty())
  {
    none.message = chooser.Note +
      "There is no array with one value at a point or cell, so nothing gives the "
      "refractive index. Load or compute a density.";
    return none;
  }
  const std::string names = arraysInWords(arrays);
  none.message = chooser.Note + isMissing + (names.empty() ? "" : " There are " + names + ".");
  return none;
}

} // namespace

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

FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays)
{
  FlowChooser chooser(arrays);
  const bool isFound = chooser.choose();
  return resultOf(chooser, isFound, arrays,
    "There is no density, nor a temperature together with a pressure, so nothing gives the "
    "refractive index. Load or compute one (Documentation/density.md says how), or choose an array "
    "yourself." +
      std::string(chooser.has(Quantity::Temperature)
          ? " Where the pressure of air is the same everywhere, UniformPressure completes the "
            "temperature (101325 Pa in a room)."
          : ""));
}

std::vector<FlowArray> withUniformPressure(std::vector<FlowArray> arrays, double pascals)
{
  for (const FlowArray::Association association : associations)
  {
    arrays.push_back({ uniformPressure, association, 1, { pascals, pascals } });
  }
  return arrays;
}

FlowDefaults flowDefaultsAt(const std::vector<FlowArray>& arrays, double pascals)
{
  FlowDefaults defaults = flowDefaults(withUniformPressure(arrays, pascals));
  const auto found = std::find(defaults.arrays.begin(), defaults.arrays.end(),
    std::pair<std::string, std::string>("Pressure", uniformPressure));
  if (found != defaults.arrays.end())
  {
    defaults.arrays.erase(found);
    const std::string array = quoted(uniformPressure) + " in Pa";
    defaults.message.replace(
      defaults.message.find(array), array.size(), textOf(pascals, 6) + " Pa everywhere");
    defaults.uniformPressure = pascals;
  }
  return defaults;
}

FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays, MediumSettings::IndexModels model)
{
  FlowChooser chooser(arrays);
  const bool isFound = chooser.choose(model);
  FlowDefaults result =
    resultOf(chooser, isFound, arrays, "No array is known by its name: choose it yourself.");
  result.indexModel = model;
  return result;
}

FlowDefaults flowSpecies(
  const std::vector<FlowArray>& arrays, FlowArray::Association association, bool withDensity)
{
  FlowChooser chooser(arrays);
  chooser.chooseSpecies(association, withDensity);
  return chooser.Result;
}

MaskDefault flowMask(const std::vector<FlowArray>& arrays)
{
  const auto found = std::find_if(arrays.begin(), arrays.end(),
    [](const FlowArray& array)
    {
      constexpr double threshold = MediumSettings::maskThreshold;
      const bool isMask = marksGas(array.name) || solids.count(ArrayName(array.name).Joined()) > 0;
      return array.components == 1 && isMask && array.range[0] < threshold &&
        array.range[1] >= threshold;
    });
  return found == arrays.end() ? MaskDefault() : MaskDefault{ found->name, found->association };
}

std::string noteOnOverset(const std::vector<FlowArray>& arrays)
{
  const auto found = std::find_if(arrays.begin(), arrays.end(),
    [](const FlowArray& array)
    { return ArrayName(array.name).Joined() == oversetCells && array.range[1] >= 2; });
  return found == arrays.end() ? ""
                               : quoted(found->name) +
      " marks cells of an overset mesh that are no part of the flow (2: holes), and these are "
      "taken as gas. Remove "
      "them with Threshold, from 0 to 1.5.";
}

bool marksGas(const std::string& array) { return gases.count(ArrayName(array).Joined()) > 0; }

bool dependsOnRange(const std::string& text)
{
  const ArrayName name(text);
  const std::string words = name.Joined();
  return name.As(Quantity::Temperature) != Understood::Not ||
    name.As(Quantity::Pressure) != Understood::Not ||
    name.As(Quantity::Electrons) != Understood::Not || name.Is(indexNames) ||
    name.Is(humidityNames) || solids.count(words) || gases.count(words) || words == oversetCells ||
    fractionOf({ text, FlowArray::Points, 1, { 0, 1 } });
}

double scaleByUnit(const std::string& property, const std::string& array)
{
  return ArrayName(array).Scale(property == "Density" ? Quantity::Density
      : property == "Temperature"                     ? Quantity::Temperature
      : property == "IndexArray"                      ? Quantity::Electrons
                                                      : Quantity::Pressure);
}

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
