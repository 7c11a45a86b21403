// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace filters
{

/// An image that is the mean over an interval of time, as a camera's shutter makes it: which data it takes, and when.
/// The interval lies around the time of the image, so that what moves is where a short exposure shows it, and as much
/// of it before as after. It ends where the data do. The instants are the middles of equal parts of it.
class TimeExposure
{
public:
  struct Instant
  {
    double time = 0;
    /// What it lies between: numbers of Steps, either the same or neighbours; and its place, 0 to 1, between them.
    std::size_t earlier = 0, later = 0;
    double ratio = 0;
  };

  /// None: the image is of one instant.
  TimeExposure() = default;

  /// `steps`: those of the data; none: the data have any time within `first` ... `last`.
  TimeExposure(const std::vector<double>& steps, double first, double last, double time,
    double length, int samples);

  bool IsNone() const { return this->Instants.empty(); }

  /// Like "mean of 8 instants from 0.1 to 0.2".
  std::string GetWords() const;

  std::vector<double> Steps; ///< times of the data that are needed, rising
  std::vector<Instant> Instants;
  double Time = 0; ///< of the image
  double Begin = 0, End = 0;
};

} // namespace filters
