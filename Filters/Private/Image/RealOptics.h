// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <string>

struct SchlierenSettings;

namespace filters
{

/// Derives scene parameters from mirrors, sources and beams. User errors are thrown as
/// std::runtime_error with a message for the user.

constexpr double metresPerMillimetre = 1e-3;
constexpr double metresPerNanometre = 1e-9;

/// Returns whether the cutoff depends on the sensitivity k.
bool usesK(const SchlierenSettings& optics);

/// Returns whether k is used and automatic.
bool choosesK(const SchlierenSettings& optics);

/// Returns whether there is a screen, at an automatic distance.
bool choosesScreen(const schlieren::Scene& scene);

/// Returns k of real optics, used or not; NaN without real optics.
double kOfOptics(const SchlierenSettings& optics);

/// Sets the cutoff's offset, and k to that given or of the optics, or leaves it to the tracer.
void setSensitivity(const SchlierenSettings& optics, schlieren::Scene& scene);

/// Returns the plate of a phase contrast. Throws std::runtime_error.
schlieren::PhasePlate phasePlateFrom(const SchlierenSettings& optics);

/// Returns the text of vtkSchlierenFilter::GetSensitivity for an image with this k, which may be
/// that of an earlier image (`isKept`); empty for k = 0.
std::string sensitivityInWords(const SchlierenSettings& settings, double k, bool isKept = false);

/// Returns where the camera of a perspective is, what it sees, and how much it blurs the flow; of background-oriented images
/// the deflection that moves the pattern by a pixel, too. Empty for other images in parallel light, and for shadowgraphs.
std::string cameraInWords(
  const SchlierenSettings& settings, const schlieren::Scene& scene, const schlieren::Image& image);

/// Returns that no bench sees deflections as small as full scale, where that is less than a microradian; else an empty text.
std::string weaknessInWords(const SchlierenSettings& settings, double k);

/// Returns "k = 4000" or "k locked at 4000".
std::string kInWords(double k, bool isKept);

schlieren::LightSource lightSourceFrom(const SchlierenSettings& optics);

/// Returns the lens of a view's camera.
schlieren::Lens lensFrom(const SchlierenSettings& settings);

/// Returns the ViewAngle of a sensor behind the lens, degrees: that of `view` without a SensorWidth.
double viewAngleFrom(
  const SchlierenSettings& settings, const schlieren::View& view, const schlieren::Grid& grid);

/// Returns the spacing of finite fringes, data units: given, or by their number in the image's `height`, pixels.
double fringeSpacingFrom(
  const SchlierenSettings& settings, const schlieren::Frame& frame, int height);

} // namespace filters
