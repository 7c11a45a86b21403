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
class vtkObject;

/// Selects what is read of an input. User errors are thrown as std::runtime_error whose message has
/// the problem, its cause and a remedy.
namespace filters
{

/// The data and arrays to read of an input.
struct Flow
{
  std::vector<Leaf> leaves;                     // at least one
  std::vector<vtkSmartPointer<vtkObject>> made; // modified data and arrays: masked, extruded
  vtkImageData* image = nullptr;                // data of the only leaf if its own grid is used
  Model model;
  double depth = 0;            // depth of flat data, see depthOf(); 0: to be chosen
  bool isDepthGiven = false;   // by the user
  double sizeInFarField = 0;   // of what has decided the depth, see chooseDepth()
  bool isOneCellThick = false; // whether flattenLayer() has flattened `leaves`
  int axisOfWedge = -1;        // whether flattenWedge() has; -1: no
  double degreesOfWedge = 0;
  std::string notes;       // for the user, mostly empty
  std::string label;       // for messages: "array 'rho'" or "arrays 'T', 'p'"
  bool isComputed = false; // whether the input has Refractivity
  MediumChoice choice;     // the settings in use
};

/// Thrown if no dataset has the needed arrays; those of other ranks may have them.
class ArraysMissing : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Lists the datasets of an input that have points.
std::vector<vtkDataSet*> dataSetsOf(vtkDataObject* input);

/// Completes `settings` for an input. `known`: notes its arrays, unless it has those of all ranks.
MediumChoice choiceFor(
  const MediumSettings& settings, KnownArrays& known, const std::vector<vtkDataSet*>& dataSets);

/// Selects what to read of an input. `known`: notes its arrays, unless it has those of all ranks.
/// `like`: the flow of other arrays of the same input, which decides whether a layer is
/// flattened; null: flattens if possible.
Flow chooseFlow(const MediumSettings& settings, KnownArrays& known, vtkDataObject* input,
  const Flow* like = nullptr);

/// Lists all arrays that complete settings may read.
std::vector<std::string> arraysOf(const MediumSettings& settings);

/// Checks the values that are used.
Implausible implausibleIn(const Flow& flow);

} // namespace filters
