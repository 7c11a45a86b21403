// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "QualityPresets.h"

#include "SchlierenSettings.h"
#include "vtkSchlierenFilter.h"

#include <algorithm>
#include <string>

namespace filters
{

using Filter = vtkSchlierenFilter;

#define SETTING(name, ...)                                                                      \
  QualitySetting                                                                                \
  {                                                                                             \
#name, [](const AccuracySettings& settings) { return static_cast<double>(settings.name); }, \
      [](AccuracySettings & settings, double value)                                             \
    { settings.name = static_cast<decltype(settings.name)>(value); },                           \
    {                                                                                           \
      __VA_ARGS__                                                                               \
    }                                                                                           \
  }

// clang-format off
const std::array<QualitySetting, 11> qualitySettings{
  //                            Interactive        Draft              Publication        Reference
  SETTING(PathModel,            Filter::AUTO_PATH, Filter::AUTO_PATH, Filter::AUTO_PATH, Filter::REFRACTED),
  SETTING(Integrator,           Filter::LEAPFROG,  Filter::LEAPFROG,  Filter::LEAPFROG,  Filter::ADAPTIVE),
  SETTING(StepSize,             2,                 1,                 1,                 1),
  SETTING(HomogeneityTolerance, 1e-3,              1e-4,              0,                 0),
  SETTING(Interpolation,        Filter::QUADRATIC, Filter::QUADRATIC, Filter::QUADRATIC, Filter::CUBIC),
  SETTING(SamplesPerPixel,      1,                 1,                 16,                64),
  SETTING(FilmEstimator,        Filter::SHEET,     Filter::SHEET,     Filter::SHEET,     Filter::SHEET),
  SETTING(Precision,            Filter::SINGLE,    Filter::SINGLE,    Filter::SINGLE,    Filter::DOUBLE),
  SETTING(AdaptiveTolerance,    1e-5,              1e-5,              1e-5,              1e-5),
  SETTING(PathTolerance,        0.01,              0.01,              0.01,              0.01),
  SETTING(MediumTolerance,      0.02,              0.01,              0.003,             0.001),
};
// clang-format on

//------------------------------------------------------------------------------
double interactiveStepSize()
{
  const auto* setting = std::find_if(qualitySettings.begin(), qualitySettings.end(),
    [](const QualitySetting& each) { return std::string(each.Property) == "StepSize"; });
  return setting->Values[Filter::INTERACTIVE];
}

} // namespace filters
