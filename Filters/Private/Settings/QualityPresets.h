// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

struct AccuracySettings;

namespace filters
{

/// A property that the presets of Quality set.
struct QualitySetting
{
  const char* Property;
  double (*Get)(const AccuracySettings&);
  void (*Set)(AccuracySettings&, double);
  std::array<double, 4> Values; ///< in each preset, in the order of vtkSchlierenFilter::Qualities
};

/// All of them. What the presets are is written there alone; the XML's defaults are those of the first.
extern const std::array<QualitySetting, 11> qualitySettings;

/// StepSize of the fastest preset.
double interactiveStepSize();

} // namespace filters
