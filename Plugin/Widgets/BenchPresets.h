// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// A property of the Schlieren filter and its value in a preset: a text or a number.
struct PresetSetting
{
  const char* property;
  double number;
  const char* text; ///< null: the value is the number
};

/// A bench as set up in laboratories.
struct BenchPreset
{
  const char* name;
  std::vector<PresetSetting> settings;
};

/// Returns all presets. Each sets the same properties.
const std::vector<BenchPreset>& benchPresets();
