// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <string>

struct OpticsSettings;
struct SchlierenSettings;

namespace filters
{

/// What of a scene follows from mirrors, sources and beams that one can buy. A user's mistake is thrown as
/// std::runtime_error with a message for the user.

constexpr double metresPerMillimetre = 1e-3;
constexpr double metresPerNanometre = 1e-9;

/// Whether the sensitivity k counts for the cutoff.
bool usesK(const OpticsSettings& optics);

/// Whether k counts and is automatic.
bool choosesK(const OpticsSettings& optics);

/// k and offset of real optics, whether they are used or not; NaN where there is none.
double kOfOptics(const OpticsSettings& optics);
double offsetOfOptics(const OpticsSettings& optics);

/// Sets k and the cutoff's offset: those given, those of the optics, or none, which lets the tracer choose.
void setSensitivity(const OpticsSettings& optics, schlieren::Scene& scene);

/// What vtkSchlierenFilter::GetSensitivity returns for an image made with this k, which may have been kept from an earlier
/// one; empty for k = 0.
std::string sensitivityInWords(const SchlierenSettings& settings, double k, bool isKept = false);

/// Like "k = 4000", or "k locked at 4000".
std::string kInWords(double k, bool isKept);

schlieren::LightSource lightSourceFrom(const OpticsSettings& optics, const schlieren::Frame& frame);

/// The spacing of finite fringes, data units: from the angle of the beams, as it is given, or that of ten
/// fringes in the image.
double fringeSpacingFrom(const SchlierenSettings& settings, const schlieren::Frame& frame);

} // namespace filters
