// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Leaf.h"
#include "Gas/RefractivityModels.h"

#include <string>
#include <vector>

/// Finds the arrays that are chosen in datasets, and says what is wrong with them.
namespace filters
{

/// Lists the datasets with all arrays, in the association of the first selection or the other.
/// Throws if some arrays belong to points and some to cells.
std::vector<Leaf> leavesWith(
  const std::vector<Selection>& selections, const std::vector<vtkDataSet*>& dataSets);

/// Throws ArraysMissing: the first array that no dataset has, or that no dataset has all of them.
/// `note`: names that were not understood if no array was chosen.
[[noreturn]] void throwNotFound(const std::vector<Selection>& selections,
  const std::vector<vtkDataSet*>& dataSets, const std::string& note = "");

/// Throws for arrays of several components, or without one value for each point or cell.
void requireScalars(const Leaf& leaf, const std::vector<Selection>& selections,
  const std::vector<vtkDataSet*>& dataSets);

/// Names arrays: "array 'rho'" or "arrays 'T', 'p'".
std::string labelOf(const Arrays& arrays, const std::vector<Selection>& selections);

} // namespace filters
