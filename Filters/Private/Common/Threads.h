// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSMPTools.h"

namespace filters
{

/// Returns the threads for a value of NumberOfThreads: `given`, or VTK_SMP_MAX_THREADS for 0; 0 if
/// that is not set: the process's cores.
int threadsFrom(int given);

/// Configures VTK's loops, which use one core or all of them in most builds of ParaView.
vtkSMPTools::Config loopsWith(int threads);

} // namespace filters
