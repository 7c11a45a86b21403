// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Chooses arrays, units and gases: the user's choice if there is one, else flowDefaults().
#pragma once

#include "Common/Message.h"
#include "FlowDefaults.h"
#include "MediumSettings.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Keeps the arrays that defaults are chosen from.
class KnownArrays
{
public:
  const std::vector<FlowArray>& Get() const { return this->Arrays; }

  /// Stores the arrays of this rank, unless those of all ranks are known.
  void Note(std::vector<FlowArray> arrays);
  void SetOfRanks(std::vector<FlowArray> arrays);
  bool AreOfRanks() const { return this->AreAll; }

private:
  std::vector<FlowArray> Arrays;
  bool AreAll = false; // whether Arrays are those of all ranks
};

/// Lists the arrays of all datasets, each name once. `hasRanges`: with the ranges of all of them;
/// else only the ranges that the choice depends on.
std::vector<FlowArray> flowArraysOf(const std::vector<vtkDataSet*>& data, bool hasRanges);
/// Adds arrays to a list, each name once.
void addArrays(std::vector<FlowArray>& all, const std::vector<FlowArray>& more);

/// Writes the arrays to a message for another rank.
void putArrays(const std::vector<FlowArray>& arrays, std::vector<char>& message);
std::vector<FlowArray> getArrays(Reader& message);

/// The complete choice of what is read of the data.
struct MediumChoice
{
  /// Complete settings (model, arrays, factors to SI units, fractions), without unread arrays.
  MediumSettings settings;
  bool isScaleKnown = false; ///< of the density or pressure: whether the user or a unit gives it
  std::string message;       ///< the choice as a text for the user
  std::string warning;       ///< about arrays that are not used; mostly empty
  std::string note;          ///< names that were not understood; mostly empty
};

/// Returns whether the choice depends on the arrays of the data.
bool isOpen(const MediumSettings& settings);

/// Completes `settings` by a choice among the arrays of the data.
MediumChoice choiceOf(const MediumSettings& settings, const std::vector<FlowArray>& known);

/// Returns the factor from the temperature to K, by the unit in the array's name; 1 without one.
double kelvinsOf(const MediumSettings& settings);
/// Returns the zero of that unit, K: of degrees Celsius 273.15.
double zeroOf(const MediumSettings& settings);

/// Returns the factor from the electron density to m^-3, by the unit in the array's name; 1 without one, 0: unknown.
double perCubicMetreOf(const MediumSettings& settings);

/// Returns the indices into MediumSettings::Arrays that the model reads besides fractions and
/// fields.
std::vector<std::size_t> arraysOfModel(const MediumSettings& settings);

} // namespace filters
