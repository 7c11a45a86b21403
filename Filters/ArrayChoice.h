// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which arrays, units and gases a vtkRefractiveIndex uses: what the user has chosen, and where that leaves something open,
// what flowDefaults() chooses of the arrays that there are.
#pragma once

#include "DataParts.h"
#include "FlowDefaults.h"
#include "RefractivitySource.h"

#include <array>
#include <mutex>
#include <string>
#include <vector>

class vtkDataSet;
class vtkRefractiveIndex;

namespace filters
{

/// The arrays of a flow that something is chosen of. Several threads may use it.
class KnownArrays
{
public:
  std::vector<FlowArray> Get() const;

  /// Those of this process, where those of all ranks are not known.
  void Note(std::vector<FlowArray> arrays);
  /// Those of all ranks.
  void SetOfRanks(std::vector<FlowArray> arrays);
  bool AreOfRanks() const;

private:
  mutable std::mutex Mutex;
  std::vector<FlowArray> Arrays;
  bool AreAll = false; // of all ranks
};

/// Finds the arrays of all datasets together, those of one name as one. `hasRanges`: of all of them; else of those alone whose
/// ranges the choice depends on.
std::vector<FlowArray> flowArraysOf(const std::vector<vtkDataSet*>& data, bool hasRanges);
/// The same of several lists.
void addArrays(std::vector<FlowArray>& all, const std::vector<FlowArray>& more);

/// The arrays in a message to another rank.
void putArrays(const std::vector<FlowArray>& arrays, std::vector<char>& message);
std::vector<FlowArray> getArrays(Reader& message);

/// What is used.
struct MediumChoice
{
  int indexModel = 0;              ///< one of vtkRefractiveIndex::IndexModels, never AUTO
  std::array<Selection, 5> arrays; ///< by vtkRefractiveIndex::InputArrays, DENSITY to HUMIDITY
  double densityScale = 1, temperatureScale = 1, pressureScale = 1;
  bool isScaleKnown = false; ///< by the user or by the unit in a name
  std::vector<std::string> mixtureArrays, mixtureGases;
  int fractionType = 0;
  std::string message; ///< in words
  std::string note;    ///< what was not understood of the names, mostly empty

  bool hasHumidity() const;
};

/// Whether something is left open, so that the choice depends on the arrays that there are.
bool isOpen(vtkRefractiveIndex* self);

/// Notes the arrays of the datasets where something is left open.
void noteArrays(vtkRefractiveIndex* self, const std::vector<vtkDataSet*>& data);

MediumChoice choiceOf(vtkRefractiveIndex* self);

/// What is implausible about the values of the arrays that are used, where they count.
Implausible implausibleIn(vtkRefractiveIndex* self, const Source& source);

} // namespace filters
