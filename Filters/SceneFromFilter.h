// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

class vtkSchlierenFilter;

/// What the filter's properties say, as the tracer wants it. Nothing is checked here: the tracer does.
schlieren::View viewFrom(vtkSchlierenFilter* self);
schlieren::Scene sceneFrom(vtkSchlierenFilter* self); ///< but for the colours of fields

/// Threads to use: what the filter is set to, or else VTK_SMP_MAX_THREADS; 0: all cores.
int threadsFrom(vtkSchlierenFilter* self);
