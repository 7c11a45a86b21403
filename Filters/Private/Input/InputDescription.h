// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkType.h"

#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace filters
{

/// The newest time of everything that the input of a port comes from; 0 where there is none.
vtkMTimeType upstreamTime(vtkAlgorithm* filter, int port);
/// The same of all ports.
vtkMTimeType upstreamTime(vtkAlgorithm* filter);

/// What a composite holds, or else the data itself; nothing for null.
std::vector<vtkDataObject*> leavesOf(vtkDataObject* data);

/// Everything that the refractivity of an input may depend on, so that equal numbers mean equal data:
/// the newest time of everything upstream, the times of the input's arrays, and its geometry. Not the
/// dataset's own time, which is a new one whenever a filter upstream hands the same arrays on.
std::vector<double> describeInput(vtkDataObject* input, vtkMTimeType pipelineTime);

} // namespace filters
