// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <functional>
#include <optional>

namespace filters
{

/// What refraction changes: an image by refracted rays less the one by straight rays, both at the k of the first.
class PathDifference
{
public:
  /// A monitor that pauses after such a fraction of the time that there is.
  using MonitorOf = std::function<schlieren::Monitor(double fraction)>;

  PathDifference(schlieren::Bench& refracted, schlieren::Bench& straight)
    : Benches{ &refracted, &straight }
  {
  }

  /// As schlieren::Bench, of two benches that share the time. The light of the image is 1/2 (of a shadowgraph 1) plus half
  /// of the difference; all else that pixels have is the difference; numbers of rays and their time are sums, and the
  /// rest is that of refracted rays.
  schlieren::Image Begin(
    const schlieren::Field& field, const schlieren::Scene& scene, const MonitorOf& monitorOf);
  schlieren::Image Resume(const MonitorOf& monitorOf);

  bool IsUnfinished() const { return this->Field.has_value(); }
  void Cancel(); ///< what is unfinished

private:
  enum Path
  {
    REFRACTED,
    STRAIGHT
  };

  schlieren::Bench* Benches[2];
  std::optional<schlieren::Field> Field; // of what is not finished
  schlieren::Scene Scenes[2];
  std::optional<schlieren::Image> Images[2]; // the newest, where there is one
  double Done[2] = { 0, 0 };
};

} // namespace filters
