// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the window knows of a flow: from the description that a server sends of its data.
#pragma once

#include "FlowDefaults.h"

#include <QString>

class pqOutputPort;
class pqPipelineSource;
class vtkSMProxy;

/// Whether a source has been made by Apply; and what to say where not.
bool isApplied(pqPipelineSource* source);
QString notApplied(pqPipelineSource* source);

/// Why no image can be made of these data and what to do about it; empty: it can.
QString problemOfFlow(pqOutputPort* port);

std::vector<FlowArray> arraysOfFlow(pqOutputPort* port);

/// The range of an array; {0, -1} where there is none. Field data too: as for any filter that gives a
/// number in it.
std::array<double, 2> rangeOfArray(pqOutputPort* port, int association, const char* name);

/// Sets the properties of a Schlieren or RefractiveIndex filter.
void setFlowDefaults(vtkSMProxy* filter, const FlowDefaults& defaults);
