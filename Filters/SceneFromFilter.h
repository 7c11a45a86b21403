// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

class RgbPictureReader;
class vtkRefractiveIndex;
class vtkSchlierenFilter;

/// What the filter's properties say, as the tracer wants it. Checked is only what is converted here: the rest
/// the tracer does. Throws std::runtime_error with a message for the user.

/// All but the colours of fields. `medium` and `grid` are those of the picture.
schlieren::Scene sceneFrom(vtkSchlierenFilter* self, vtkRefractiveIndex* medium,
  const schlieren::Grid& grid, RgbPictureReader& pictures);

/// Where the picture lies.
schlieren::Frame frameFrom(vtkSchlierenFilter* self, const schlieren::Grid& grid);

/// Threads to use: what the filter is set to, or else VTK_SMP_MAX_THREADS; 0: coresOfProcess().
int threadsFrom(vtkSchlierenFilter* self);
