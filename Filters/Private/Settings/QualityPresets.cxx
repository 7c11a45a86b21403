// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Settings/QualityPresets.h"

#include "SchlierenSettings.h"

#include "Schlieren.h"

#include <algorithm>
#include <string>

namespace filters
{

namespace
{

template <class Value>
constexpr double numberOf(Value value)
{
  return static_cast<double>(value);
}

constexpr double refracted = numberOf(schlieren::PathModel::Refracted);
constexpr double single = numberOf(schlieren::Precision::Single);
constexpr double twofold = numberOf(schlieren::Precision::Double);

} // namespace

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
const std::array<QualitySetting, 6> qualitySettings{
  //                            Interactive  Fine       Publication  Reference  Automatic
  SETTING(PathModel,            refracted,   refracted, refracted,   refracted, refracted),
  SETTING(StepSize,             2,           1,         1,           1,         2),
  SETTING(SamplesPerPixel,      1,           4,         16,          64,        1),
  SETTING(Precision,            single,      single,    single,      twofold,   single),
  SETTING(MediumTolerance,      0.003,       0.003,     0.001,       0.001,     0.003),
  SETTING(TargetError,          0,           0,         0,           0,         -1),
};

const std::array<QualityError, 3> qualityErrors{ {
  { 0.15,  0.1,  0.2,  1 },  // Interactive
  { 0.03,  0.02, 0.05, 5 },  // Fine
  { 0.006, 0.01, 0.05, 20 }, // Publication
} };
// clang-format on

double interactiveStepSize()
{
  const auto* setting = std::find_if(qualitySettings.begin(), qualitySettings.end(),
    [](const QualitySetting& each) { return std::string(each.Property) == "StepSize"; });
  return setting->Values.front();
}

} // namespace filters
