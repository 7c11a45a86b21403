// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <array>
#include <vector>

class vtkPiecewiseFunction;
struct SchlierenSettings;

namespace filters
{

class RgbImageReader;

/// Bins along each axis of the histogram.
constexpr int histogramBins = 256;

/// Converts settings to the tracer's scene. Validates only what is converted; the tracer validates
/// the rest. Throws std::runtime_error with a message for the user.

/// Converts everything but the graded filter, which is an object. `grid`: the medium's.
schlieren::Scene sceneFrom(
  const SchlierenSettings& settings, const schlieren::Grid& grid, RgbImageReader& images);

/// Returns the transmission over the width of a graded filter; null, or without points: a straight line.
std::vector<double> gradedFilterFrom(vtkPiecewiseFunction* function);

/// Returns how light continues behind the flow: as LightModel says, but Phase Contrast is of waves alone.
schlieren::LightModel lightModelOf(const SchlierenSettings& settings);

/// Turns the view to the plane of flat data if the default direction lies in it; see
/// vtkSchlierenFilter::SetFaceFlatData(). `flatAxis`: across the plane, or -1.
SchlierenSettings facing(SchlierenSettings settings, int flatAxis);
/// Returns a note on that for the user; mostly empty.
std::string noteOnView(const SchlierenSettings& settings, int flatAxis);

/// Returns the width and the height of the image, pixels.
std::array<int, 2> imageSizeFrom(const SchlierenSettings& settings, const schlieren::Grid& grid);

/// Returns the frame of the image.
schlieren::Frame frameFrom(const SchlierenSettings& settings, const schlieren::Grid& grid);

} // namespace filters
