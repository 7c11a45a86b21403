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
  std::array<double, 5> Values; ///< for each preset, in the order of vtkSchlierenFilter::Qualities
};

/// The only definition of the presets; the XML's defaults equal the first one.
extern const std::array<QualitySetting, 6> qualitySettings;

/// What is measured of a preset; see quality.md.
struct QualityError
{
  double Light =
    0; ///< that 99 % of the pixels keep: fraction of full scale, or of undisturbed light
  double Fringes = 0; ///< the same of interferograms
  double Pixels = 0;  ///< the same of displacements seen by a camera
  double Time = 0;    ///< of another view, relative to that of the fastest preset
};

/// For each preset before the one that these are compared with.
extern const std::array<QualityError, 3> qualityErrors;

/// Returns StepSize of the fastest preset.
double interactiveStepSize();

} // namespace filters
