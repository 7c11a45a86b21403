// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Gas/TransferFunctions.h"
#include "Input/Flow.h"
#include "Ranks/PiecesOfRanks.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace filters
{

class MediumMaker;

/// What a rank reads of its pieces.
struct ChoiceOverRanks
{
  vtkSmartPointer<vtkDataObject> data; ///< of the pieces; null: none with the arrays
  Flow flow;                           ///< of `data`
  std::string label;                   ///< see Flow::label; that of any rank
};

/// Lets all ranks choose among the arrays of all.
void shareArrays(const Ranks& ranks, MediumMaker& maker, vtkDataObject* own);

/// Chooses arrays on all ranks, and finds the ranges on all ranks of fields that are relative to
/// them. Throws ArraysMissing if no rank has them.
ChoiceOverRanks chooseOverRanks(const Ranks& ranks, MediumMaker& maker,
  const std::vector<PiecesOfRanks::Piece>& pieces, bool areImages);

} // namespace filters
