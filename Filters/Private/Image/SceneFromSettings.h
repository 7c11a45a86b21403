// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <memory>

class vtkPiecewiseFunction;
struct MediumSettings;
struct ResourceSettings;
struct SchlierenSettings;

namespace filters
{

class RgbImageReader;

/// What a view shows behind the flow.
struct BackgroundScene
{
  std::shared_ptr<const schlieren::RgbImage> image; ///< null: not known
  double distance = -1;                             ///< data units; negative: one data depth
};

/// What the settings say, as the tracer wants it. Checked is only what is converted here: the rest the tracer does.
/// Throws std::runtime_error with a message for the user.

/// All but what comes from objects. `grid` is that of the medium.
schlieren::Scene sceneFrom(
  const SchlierenSettings& settings, const schlieren::Grid& grid, RgbImageReader& images);

/// What comes from objects, where the scene needs it: the graded filter (null: a straight line), and the dispersion of
/// white light. The colours of fields are apart.
void addObjects(
  schlieren::Scene& scene, vtkPiecewiseFunction* gradedFilter, const MediumSettings& medium);

/// What is behind the flow, where the settings want it.
void addBackground(
  schlieren::Scene& scene, const SchlierenSettings& settings, const BackgroundScene& background);

/// Looks onto the plane of flat data where the view would be along it by default; see vtkSchlierenFilter::SetFaceFlatData().
/// `flatAxis`: across the plane, or -1.
SchlierenSettings facing(SchlierenSettings settings, int flatAxis);
/// What the user should know of that; mostly empty.
std::string noteOnView(const SchlierenSettings& settings, int flatAxis);

/// Where the image lies.
schlieren::Frame frameFrom(const SchlierenSettings& settings, const schlieren::Grid& grid);

/// Threads to use: those given, or else VTK_SMP_MAX_THREADS; 0: coresOfProcess().
int threadsFrom(const ResourceSettings& resources);

} // namespace filters
