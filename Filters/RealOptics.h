// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <string>

class vtkSchlierenFilter;

/// What of a scene follows from mirrors, sources and beams that one can buy. A user's mistake is thrown as
/// std::runtime_error with a message for the user.

constexpr double metresPerMillimetre = 1e-3;
constexpr double metresPerNanometre = 1e-9;

/// Whether the sensitivity k counts for the filter's cutoff.
bool usesK(vtkSchlierenFilter* self);

/// Whether k counts and is automatic.
bool choosesK(vtkSchlierenFilter* self);

/// Sets k and the cutoff's offset: those given, those of the optics, or none, which lets the tracer choose.
void setSensitivity(vtkSchlierenFilter* self, schlieren::Scene& scene);

/// What vtkSchlierenFilter::GetSensitivity tells of an image made with this k, which may have been kept from an earlier
/// one; empty for k = 0.
std::string sensitivityInWords(vtkSchlierenFilter* self, double k, bool isKept = false);

/// Like "k = 4000", or "k locked at 4000".
std::string kInWords(double k, bool isKept);

schlieren::LightSource lightSourceFrom(vtkSchlierenFilter* self, const schlieren::Frame& frame);

/// The spacing of finite fringes, data units: from the angle of the beams, as it is given, or that of ten
/// fringes in the picture.
double fringeSpacingFrom(vtkSchlierenFilter* self, const schlieren::Frame& frame);
