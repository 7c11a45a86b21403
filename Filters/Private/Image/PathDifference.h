// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <functional>
#include <optional>

namespace filters
{

/// Subtracts the image of straight rays from that of refracted rays, both with k of the latter.
class PathDifference
{
public:
  /// Returns a monitor that pauses after a fraction of the available time.
  using MonitorOf = std::function<schlieren::Monitor(double fraction)>;

  PathDifference(schlieren::Bench& refracted, schlieren::Bench& straight)
    : Benches{ &refracted, &straight }
  {
  }

  /// Renders as schlieren::Bench does, with two benches in turn. The light is 1/2 (of a shadowgraph
  /// 1) plus half of the difference; the other pixel arrays are differences; numbers and times of
  /// rays are sums; all else is that of refracted rays.
  schlieren::Image Begin(
    const schlieren::Field& field, const schlieren::Scene& scene, const MonitorOf& monitorOf);
  schlieren::Image Resume(const MonitorOf& monitorOf);

  bool IsUnfinished() const { return this->Field.has_value(); }
  void Cancel(); ///< drops unfinished work

private:
  enum Path
  {
    REFRACTED,
    STRAIGHT
  };

  schlieren::Bench* Benches[2];
  std::optional<schlieren::Field> Field; // of unfinished images
  schlieren::Scene Scenes[2];
  std::optional<schlieren::Image> Images[2]; // latest images
  double Done[2] = { 0, 0 };
};

} // namespace filters
