// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Leaf.h"
#include "Gas/ArrayChoice.h"
#include "Gas/RefractivityModels.h"

#include "vtkSmartPointer.h"

#include <stdexcept>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkImageData;

/// What is read of an input. A user's mistake is thrown as std::runtime_error, with a message
/// that says the problem, why it is one and what to do.
namespace filters
{

/// What to read from an input.
struct Source
{
  std::vector<Leaf> leaves; // at least one
  std::vector<vtkSmartPointer<vtkDataSet>>
    made;                        // their data that are not the input's: masked, extruded
  vtkImageData* image = nullptr; // the data of the only leaf, where it keeps its own grid
  Model model;
  double depth = 0;            // of flat data, see depthOf(); 0: to be chosen
  bool isDepthGiven = false;   // by the user
  bool isOneCellThick = false; // what `leaves` have was: see flattenLayer()
  int axisOfWedge = -1;        // likewise: see flattenWedge(); -1: none
  std::string noteOnGases;     // what the user should know once, mostly empty
  std::string label;           // for messages: "array 'rho'" or "arrays 'T', 'p'"
  bool isComputed = false;     // the refractivity was computed before
  MediumChoice choice;         // what is used
};

/// Thrown where no dataset has the arrays that are needed; others, on other ranks, may have them.
class ArraysMissing : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The datasets within an input that have points.
std::vector<vtkDataSet*> dataSetsOf(vtkDataObject* input);

/// Chooses what `settings` leave open for an input. `known`: notes its arrays, unless it has those of all ranks.
MediumChoice choiceFor(
  const MediumSettings& settings, KnownArrays& known, const std::vector<vtkDataSet*>& dataSets);

/// Chooses what to read of an input. `known`: notes its arrays, unless it has those of all ranks. `like`: what was chosen of the
/// same input for other arrays; data that are one layer of cells become flat only if they have there. Null: if they can.
Source chooseSource(const MediumSettings& settings, KnownArrays& known, vtkDataObject* input,
  const Source* like = nullptr);

/// The names of all arrays that may be read of an input by settings that leave nothing open.
std::vector<std::string> arraysOf(const MediumSettings& settings);

/// What is implausible about the values of the arrays that are used, where they count.
Implausible implausibleIn(const Source& source);

} // namespace filters
