// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Chooses an index model by the names, units and ranges of a flow's arrays, for filters,
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

/// The array of the property Mask.
struct MaskDefault
{
  std::string array; ///< empty: none
  FlowArray::Association association = FlowArray::Points;
};

/// The index model and arrays that a filter uses by default.
struct FlowDefaults
{
  MediumSettings::IndexModels indexModel = MediumSettings::GLADSTONE_DALE;
  FlowArray::Association association = FlowArray::Points;

  /// Properties and their arrays; the first is the one to show the flow by. Empty: no array fits,
  /// and `message` says what is missing.
  std::vector<std::pair<std::string, std::string>> arrays;

  /// Properties and their factors to SI units.
  std::vector<std::pair<std::string, double>> scales;

  /// Arrays and gases of a mixture; whether the arrays are volume fractions.
  std::vector<std::string> fractions;
  std::vector<std::string> gases;
  bool ofVolume = false;

  /// The property UniformPressure, Pa; 0: not used.
  double uniformPressure = 0;

  /// The choice as a text for the user, with names that were not understood; whether there are
  /// none.
  std::string message;
  bool isSure = true;
  /// Names that were not understood, mostly empty.
  std::string note;

  /// Returns the array of a property; empty: none.
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

/// Returns whether an array is not a density: its name or unit is that of something else
/// (temperature, index, gradient, ...), or its values are kelvins and its name is not a density's.
VTKSCHLIERENFILTERS_EXPORT bool isNoDensity(const FlowArray& array);

/// Chooses defaults. Uses an array only if its name says what it is.
VTKSCHLIERENFILTERS_EXPORT FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays);

/// The pressure of air in a room, Pa.
constexpr double pressureOfRoom = 101325;

/// Returns the arrays with a pressure that is the same everywhere, at points and in cells, as if there were one.
VTKSCHLIERENFILTERS_EXPORT std::vector<FlowArray> withUniformPressure(
  std::vector<FlowArray> arrays, double pascals);

/// Chooses defaults where the pressure, Pa, is the same everywhere.
VTKSCHLIERENFILTERS_EXPORT FlowDefaults flowDefaultsAt(
  const std::vector<FlowArray>& arrays, double pascals);

/// Chooses arrays for a given index model.
VTKSCHLIERENFILTERS_EXPORT FlowDefaults flowDefaults(
  const std::vector<FlowArray>& arrays, MediumSettings::IndexModels model);

/// Chooses only the fractions of known gases among the arrays of points or cells; partial densities `withDensity` only.
VTKSCHLIERENFILTERS_EXPORT FlowDefaults flowSpecies(const std::vector<FlowArray>& arrays,
  FlowArray::Association association, bool withDensity = true);

/// Chooses an array that marks bodies or gas by its name, with values on both sides of maskThreshold.
VTKSCHLIERENFILTERS_EXPORT MaskDefault flowMask(const std::vector<FlowArray>& arrays);

/// Returns a note on an array that marks the holes of an overset mesh; mostly empty.
VTKSCHLIERENFILTERS_EXPORT std::string noteOnOverset(const std::vector<FlowArray>& arrays);

/// Returns whether the array's name says that it marks gas, not bodies.
VTKSCHLIERENFILTERS_EXPORT bool marksGas(const std::string& array);

/// Returns whether a choice may depend on the range of an array of this name; others need no range.
VTKSCHLIERENFILTERS_EXPORT bool dependsOnRange(const std::string& name);

/// Returns the factor to SI units by the unit in an array's name for `property` (Density,
/// Temperature, Pressure or, of electrons, IndexArray); 0: no unit, or an unknown one.
VTKSCHLIERENFILTERS_EXPORT double scaleByUnit(
  const std::string& property, const std::string& array);

/// Lists the arrays of one component: "point arrays rho (1 to 1.2), T (280 to 300)". Empty: none.
VTKSCHLIERENFILTERS_EXPORT std::string arraysInWords(const std::vector<FlowArray>& arrays);

/// The input of implausible().
struct FlowInUse
{
  MediumSettings::IndexModels indexModel = MediumSettings::GLADSTONE_DALE;
  /// The densities, or for moist air temperature and pressure, with the ranges in use.
  std::vector<FlowArray> arrays;
  std::vector<double> scales; ///< factors to SI units
  double zero = 0;            ///< of the temperature's unit, K
  bool isScaleGiven = false;  ///< by the user or by a unit
  double constant = 2.26e-4;  ///< Gladstone-Dale constant of the gas, m^3/kg
  bool isConstant = false;    ///< whether all arrays are the same everywhere, up to rounding
  bool isGas = true;          ///< false: the user has given the constant of another material
};

/// A sentence or two about implausible values: the problem, its cause and a remedy; and its kind.
/// Empty if there is no problem.
struct Implausible
{
  std::string kind;
  std::string text;
};
VTKSCHLIERENFILTERS_EXPORT Implausible implausible(const FlowInUse& flow);
