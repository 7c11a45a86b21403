// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// A property of the Schlieren filter and what a preset sets it to: a text, or a number.
struct PresetSetting
{
  const char* property;
  double number;
  const char* text; ///< null: the number counts
};

/// A bench as it is set up in laboratories.
struct BenchPreset
{
  const char* name;
  std::vector<PresetSetting> settings;
};

/// All of them. Each sets all properties that any of them sets, so that it leads to the same bench whatever was
/// set before.
const std::vector<BenchPreset>& benchPresets();
