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
  std::array<double, 4> Values; ///< for each preset, in the order of vtkSchlierenFilter::Qualities
};

/// The only definition of the presets; the XML's defaults equal the first one.
extern const std::array<QualitySetting, 11> qualitySettings;

/// Returns StepSize of the fastest preset.
double interactiveStepSize();

} // namespace filters
