// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads a flow from a server's description of its data.
#pragma once

#include "FlowDefaults.h"

#include <QString>

#include <string>
#include <vector>

class pqOutputPort;
class pqPipelineSource;
class pqServer;
class vtkSMProxy;

/// Return whether a source has been applied, and a message for one that has not.
bool isApplied(pqPipelineSource* source);
QString notApplied(pqPipelineSource* source);

/// Returns why the server cannot make images; empty if it can.
QString problemOfServer(pqServer* server);

/// Returns why no image can be made of these data, with a remedy; empty if one can.
QString problemOfFlow(pqOutputPort* port);

std::vector<FlowArray> arraysOfFlow(pqOutputPort* port);

/// Makes a flow the active data, as the Pipeline Browser does: its source, and an output only of a source that has several. At
/// *Reset Session*, ParaView may crash where a selected output has lost its source (pqDeleteReaction::canDeleteTree).
void selectFlow(pqOutputPort* port);

/// Returns the range of an array, or of field data, such as numbers in an output; else {0, -1}.
std::array<double, 2> rangeOfArray(pqOutputPort* port, int association, const char* name);

/// What completes a flow without a density: nothing, the pressure of a room for a temperature; that it is water, of a temperature; or an array that the user takes
/// for the density.
struct Completion
{
  enum Kind
  {
    None,
    UniformPressure,
    Water,
    Density
  };

  Kind kind = None;
  std::string array{}; ///< of a Density
};

/// Returns what a button that completes a flow says.
QString inWords(Completion::Kind kind);

/// Chooses defaults of completed arrays.
FlowDefaults completed(const std::vector<FlowArray>& arrays, const Completion& completion);

/// Returns what completes arrays of which flowDefaults() chooses none.
Completion offerFor(const std::vector<FlowArray>& arrays);

/// Sets the properties of a Schlieren or RefractiveIndex filter.
void setFlowDefaults(vtkSMProxy* filter, const FlowDefaults& defaults);
