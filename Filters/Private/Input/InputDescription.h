// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkType.h"

#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace filters
{

/// Returns the newest modification time upstream of a port; 0 without input.
vtkMTimeType upstreamTime(vtkAlgorithm* filter, int port);
/// Returns the newest modification time upstream of all ports.
vtkMTimeType upstreamTime(vtkAlgorithm* filter);

/// Lists the data objects of a composite, or the object itself; none for null.
std::vector<vtkDataObject*> leavesOf(vtkDataObject* data);

/// Returns numbers that differ whenever the refractivity of an input may: the newest time upstream,
/// the times of arrays, and the geometry. Excludes the dataset's own time, which changes whenever a
/// filter upstream passes the same arrays again.
std::vector<double> describeInput(vtkDataObject* input, vtkMTimeType pipelineTime);

} // namespace filters
