// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which index model suits a flow, by the names, units and ranges of its arrays.
#pragma once

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
  /// Values of the property IndexModel.
  enum IndexModel
  {
    GladstoneDale = 0,
    RefractiveIndex = 1,
    Refractivity = 2,
    Mixture = 3,
    Ciddor = 4
  };

  IndexModel indexModel = GladstoneDale;
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
};

/// Whether an array is surely not a density, or so likely not that only the user may take it for one: by its name or
/// unit it is a temperature or a pressure, or it has values of a temperature in kelvins and no name of a density.
bool isNoDensity(const FlowArray& array);

FlowDefaults flowDefaults(const std::vector<FlowArray>& arrays);
