// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace filters
{

/// Makes the images of a filter, each at once or time-sliced.
class TimeSlicedImage
{
public:
  TimeSlicedImage();

  /// `seconds`: approximate limit for rays and light, see schlieren::Image::finished; 0: none.
  schlieren::Image Begin(const schlieren::Field& field, const schlieren::Scene& scene,
    double seconds, const schlieren::Monitor& monitor);
  schlieren::Image Resume(double seconds, const schlieren::Monitor& monitor);

  /// Sets the other processes that trace rays: see schlieren::Bench.
  void SetProcesses(schlieren::Processes* processes);

  const schlieren::Work& GetWork() const { return this->Bench.work(); } ///< sum over all images
  const schlieren::Scene& GetScene() const { return this->Scene; }      ///< the last one

  /// Returns a status in one line; see statusInWords().
  std::string GetStatus(const schlieren::Image& image) const;

  /// Returns warnings and, before each, its kind: once for the same rays, and, once, that light is assumed to leave a liquid.
  std::vector<std::pair<std::string, std::string>> GetWarnings(const schlieren::Image& image);

private:
  schlieren::Image Noted(schlieren::Image image);

  schlieren::Bench Bench;
  schlieren::Scene Scene;
  std::int64_t RaysBefore = 0;            // at the start of this image
  double RaysPerSecond = 0;               // at the last tracing
  std::array<std::int64_t, 7> WarnedOf{}; // raySets of each kind of warning
  bool HasNotedExit = false;
};

} // namespace filters
