// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Chooses arrays, units and gases: what the user has chosen, and where that leaves something open, what flowDefaults()
// chooses of the arrays that there are.
#pragma once

#include "Common/Message.h"
#include "FlowDefaults.h"
#include "MediumSettings.h"

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

class vtkDataSet;

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

/// What is used of data.
struct MediumChoice
{
  /// With nothing left open (IndexModel, arrays, factors of units and fractions), and without arrays that are not read.
  MediumSettings settings;
  bool isScaleKnown = false; ///< by the user or by the unit in a name
  std::string message;       ///< in words
  std::string note;          ///< what was not understood of the names, mostly empty
};

/// Whether something is left open, so that the choice depends on the arrays that there are.
bool isOpen(const MediumSettings& settings);

/// Chooses what `settings` leave open from the arrays of the data.
MediumChoice choiceOf(const MediumSettings& settings, const std::vector<FlowArray>& known);

/// The indices of MediumSettings::Arrays that an index model takes besides fractions and fields.
std::vector<std::size_t> arraysOfModel(int model);

} // namespace filters
