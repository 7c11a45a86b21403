// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MediumSettings.h"

#include <optional>
#include <vector>

struct SchlierenSettings;

namespace filters
{

/// Identifies the data and settings that a value was found for.
struct ImageCircumstances
{
  std::optional<double> time; ///< unset: no time steps
  std::vector<double> data;   ///< vtkSchlierenFilter::DescribeInputs()
  MediumSettings properties;  ///< settings of the medium, in single precision
  std::vector<double> medium; ///< other settings of the medium
  std::vector<double> rays;   ///< for k: camera, quality, light
};

/// Returns all settings that an automatic k depends on, except medium and cutoff.
std::vector<double> settingsOfRays(const SchlierenSettings& settings);

/// Keeps an automatic value, such as k, for later images as vtkSchlierenFilter::KMode says.
class SensitivityLock
{
public:
  /// Drops a k that is not valid for the next image. Returns its k; unset: to be found.
  std::optional<double> For(int mode, const ImageCircumstances& now);

  /// Stores the k found for the last image requested.
  void Found(double k);

  /// Sets the k of the next image, whatever that shows; unset: none.
  void Give(std::optional<double> k);
  void Drop() { this->Give({}); }

  /// Returns the k of the last image if it was found for another one.
  std::optional<double> GetKept() const;

private:
  std::optional<double> K;
  std::optional<ImageCircumstances> FoundAt; // unset: K was given
  std::optional<ImageCircumstances> Origin;  // FoundAt, or else the first image with K
  std::optional<ImageCircumstances> Last;
};

} // namespace filters
