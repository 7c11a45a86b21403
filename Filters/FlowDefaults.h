// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which index model suits a flow, by the names, units and ranges of its arrays: one decision for filters,
// representation, toolbar and demo.
#pragma once

#include "MediumSettings.h"            // for the index models
#include "vtkSchlierenFiltersModule.h" // for export macro

#include <array>
#include <string>
#include <utility>
#include <vector>

struct FlowArray
{
  enum Association
  {
    Points, ///< as in vtkDataObject::FieldAssociations
    Cells
  };

  std::string name;
  Association association;
  int components;
  std::array<double, 2> range;
};

/// How a Schlieren filter gets the refractive index.
struct FlowDefaults
{
  MediumSettings::Models indexModel = MediumSettings::GladstoneDale;
  FlowArray::Association association = FlowArray::Points;

  /// Properties that take an array, and the array. The first is what the flow is shown by. None: no array
  /// could be used, and `message` says what is missing.
  std::vector<std::pair<std::string, std::string>> arrays;

  /// Properties that take a factor to SI units.
  std::vector<std::pair<std::string, double>> scales;

  /// Of a mixture: arrays and gases, and whether the arrays are fractions of the volume.
  std::vector<std::string> fractions;
  std::vector<std::string> gases;
  bool ofVolume = false;

  /// The property Mask, its association and whether it marks gas rather than bodies; empty: no array does.
  std::string mask;
  FlowArray::Association maskAssociation = FlowArray::Points;
  bool isMaskOfGas = false;

  /// What was chosen, and what was not understood, in words for the user; and whether all of it was.
  std::string message;
  bool isSure = true;
  /// What was not understood alone, mostly empty.
  std::string note;

  /// The array of a property; empty: none.
  std::string arrayOf(const std::string& property) const
  {
    for (const auto& [name, array] : this->arrays)
    {
      if (name == property)
      {
        return array;
      }
    }
    return "";
  }
};

/// Whether an array is surely not a density: by its name or unit it is something else (a temperature, a pressure, an
/// index, a fraction, a gradient, ...), or it has values of a temperature in kelvins and no name of a density.
VTKSCHLIERENFILTERS_EXPORT bool isNoDensity(const FlowArray& array);

/// What is chosen where the user has chosen nothing. An array is taken only where its name says what it is.
VTKSCHLIERENFILTERS_EXPORT FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays);

/// The same for an index model that is given: its arrays alone.
VTKSCHLIERENFILTERS_EXPORT FlowDefaults flowDefaults(
  const std::vector<FlowArray>& arrays, MediumSettings::Models model);

/// The fractions of known gases among the arrays of points or those of cells, and nothing else.
VTKSCHLIERENFILTERS_EXPORT FlowDefaults flowSpecies(
  const std::vector<FlowArray>& arrays, FlowArray::Association association);

/// Whether what is chosen may depend on the range of an array of this name: others need not have theirs.
VTKSCHLIERENFILTERS_EXPORT bool dependsOnRange(const std::string& name);

/// The factor to SI units by the unit in the name of an array that was chosen for `property` (Density, Temperature or
/// Pressure); 0: the name has no unit, or one that is not known.
VTKSCHLIERENFILTERS_EXPORT double scaleByUnit(
  const std::string& property, const std::string& array);

/// The arrays with one component in words, with their ranges: "point arrays rho (1 to 1.2), T (280 to 300)". Empty: none.
VTKSCHLIERENFILTERS_EXPORT std::string arraysInWords(const std::vector<FlowArray>& arrays);

/// What is used of a flow, for implausible().
struct FlowInUse
{
  MediumSettings::Models indexModel = MediumSettings::GladstoneDale;
  /// Of the densities; of moist air the temperature and the pressure. With the ranges of what counts.
  std::vector<FlowArray> arrays;
  std::vector<double> scales; ///< of each, to SI units
  bool isScaleGiven = false;  ///< by the user or by a unit
  double constant = 2.26e-4;  ///< the Gladstone-Dale constant of the gas, m^3/kg
  bool isGas = true;          ///< false: the user has given a constant of something else
};

/// One sentence or two about what no gas is like: what is implausible, why and what to do; and a word for its kind. Both are
/// empty where there is nothing to say.
struct Implausible
{
  std::string kind;
  std::string text;
};
VTKSCHLIERENFILTERS_EXPORT Implausible implausible(const FlowInUse& flow);
