// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchPresets.h"

#include "vtkSchlierenFilter.h"

#include <algorithm>
#include <cstring>

namespace
{

using Filter = vtkSchlierenFilter;

/// Defaults of the filter, for properties that a preset does not mention.
const std::vector<PresetSetting> defaults = {
  { "Cutoff", Filter::KNIFE_EDGE, nullptr },
  { "KnifeEdgeAngle", 0, nullptr },
  { "CutoffOffset", 0, nullptr },
  { "KMode", Filter::K_AUTOMATIC_KEPT, nullptr },
  { "MirrorFocalLength", 1, nullptr },
  { "SourceWidth", 1, nullptr },
  { "SourceLength", 10, nullptr },
  { "ColorFilterImage", 0, "" },
  { "FringeSpacing", 0, nullptr },
  { "FringeAngle", 0, nullptr },
  { "BackgroundPattern", Filter::DOTS, nullptr },
  { "BackgroundDistance", -1, nullptr },
  { "BackgroundPeriod", 0, nullptr },
  { "ScreenDistance", -1, nullptr },
  { "FocusOffset", 0, nullptr },
  { "SourceDistance", 0, nullptr },
  { "SourceShape", Filter::POINT, nullptr },
  { "LightModel", Filter::LIGHT_RAYS, nullptr },
  { "PhasePlateDiameter", 0, nullptr },
  { "PhasePlateDelay", 0.25, nullptr },
  { "PhasePlateTransmission", 1, nullptr },
};

BenchPreset preset(const char* name, const std::vector<PresetSetting>& changes)
{
  BenchPreset made{ name, defaults };
  for (const PresetSetting& change : changes)
  {
    *std::find_if(made.settings.begin(), made.settings.end(),
      [&](const PresetSetting& setting)
      { return std::strcmp(setting.property, change.property) == 0; }) = change;
  }
  return made;
}

} // namespace

const std::vector<BenchPreset>& benchPresets()
{
  static const std::vector<BenchPreset> presets = {
    preset("Knife Edge, vertical", {}),
    preset("Knife Edge, horizontal", { { "KnifeEdgeAngle", 90, nullptr } }),
    preset("Knife Edge, Toepler's bench: mirror of 1 m, slit of 1 mm",
      { { "KMode", Filter::K_BENCH, nullptr }, { "SourceShape", Filter::SLIT, nullptr } }),
    preset("Bright Field", { { "Cutoff", Filter::BRIGHT_FIELD, nullptr } }),
    preset("Dark Field", { { "Cutoff", Filter::DARK_FIELD, nullptr } }),
    preset("Numerical Schlieren", { { "Cutoff", Filter::NUMERICAL_SCHLIEREN, nullptr } }),
    preset("Color Filter, wheel", { { "Cutoff", Filter::COLOR_FILTER, nullptr } }),
    preset("Shadowgraph", { { "Cutoff", Filter::SHADOWGRAPH, nullptr } }),
    preset("Interferogram, infinite fringes", { { "Cutoff", Filter::INTERFEROGRAM, nullptr } }),
    preset("Interferogram, finite fringes",
      { { "Cutoff", Filter::INTERFEROGRAM, nullptr }, { "FringeSpacing", -10, nullptr },
        { "FringeAngle", 90, nullptr } }),
    preset("Phase Contrast, laser", { { "Cutoff", Filter::PHASE_CONTRAST, nullptr } }),
    preset("Background Oriented, dots", { { "Cutoff", Filter::BACKGROUND_ORIENTED, nullptr } }),
  };
  return presets;
}
