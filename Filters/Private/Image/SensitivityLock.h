// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MediumSettings.h"

#include <optional>
#include <vector>

struct SchlierenSettings;

namespace filters
{

/// What a number that is found for an image belongs to.
struct ImageCircumstances
{
  std::optional<double> time;   ///< unset: data without time steps
  std::vector<double> upstream; ///< times of what makes the data
  std::optional<std::vector<double>>
    data;                     ///< vtkSchlierenFilter::DescribeInputs(); unset: of several times
  MediumSettings properties;  ///< of the medium, in single precision
  std::vector<double> medium; ///< what else there is of it, and, of k, of the kind of cutoff
  std::vector<double> rays;   ///< of k: camera, quality, light
};

/// Camera, quality and light: all of the settings that an automatic k depends on, but the medium and the cutoff.
std::vector<double> settingsOfRays(const SchlierenSettings& settings);

/// Keeps an automatic k, found for one image, for later ones, as vtkSchlierenFilter::LockK says; or another number.
class SensitivityLock
{
public:
  /// The k of an image that is about to be made; unset: it has to be found. Drops the k of before where that does not
  /// hold any more.
  std::optional<double> For(int mode, const ImageCircumstances& now);

  /// The k that was found for the last image requested.
  void Found(double k);

  /// A k from elsewhere, which holds for the next image whatever it is of; unset: none.
  void Give(std::optional<double> k);
  void Drop() { this->Give({}); }

  /// The k of the last image where it was not found for that one.
  std::optional<double> GetKept() const;

private:
  std::optional<double> K;
  std::optional<ImageCircumstances> FoundAt; // unset: K is from elsewhere
  std::optional<ImageCircumstances> Origin;  // FoundAt, or else the first image with K
  std::optional<ImageCircumstances> Last;
};

} // namespace filters
