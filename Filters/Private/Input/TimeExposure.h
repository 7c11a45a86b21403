// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace filters
{

/// The time steps and weights of an image that is the mean over an interval of time, like a
/// camera's exposure. The interval is centred at the image's time and clipped to the data's times.
/// The instants are the midpoints of equal subintervals.
class TimeExposure
{
public:
  struct Instant
  {
    double time = 0;
    /// The two Steps around it (or twice the same), and its position between them, 0 to 1.
    std::size_t earlier = 0, later = 0;
    double ratio = 0;
  };

  /// No exposure: the image shows one instant.
  TimeExposure() = default;

  /// `steps`: times of the data; empty: the data have any time within `first` ... `last`.
  TimeExposure(const std::vector<double>& steps, double first, double last, double time,
    double length, int samples);

  bool IsNone() const { return this->Instants.empty(); }

  /// Returns a text such as "mean of 8 instants from 0.1 to 0.2".
  std::string GetWords() const;

  std::vector<double> Steps; ///< times of the data that are needed, increasing
  std::vector<Instant> Instants;
  double Time = 0; ///< time of the image
  double Begin = 0, End = 0;
};

} // namespace filters
