// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

namespace schlieren
{

/// How many rays a launch should trace. A launch cannot be stopped and keeps a device from showing windows meanwhile, so
/// it is to last no longer than 100 ms; but each has a price of some microseconds.
///
/// The first launch is so short that a slow device makes it in time. Each that has ended says how long a ray takes that
/// crosses the medium; the next is sized as if all of its rays did. Launches become longer step by step, as rows to come
/// may take longer than those that were measured.
class LaunchPace
{
public:
  static constexpr double target = 0.025; ///< seconds; so what comes may take four times as long
  static constexpr std::int64_t maxRays = std::int64_t{ 1 } << 22;

  /// `steps`: of a ray that crosses the medium, in those of Leapfrog in single precision.
  explicit LaunchPace(double steps)
  {
    constexpr double slowStepsPerSecond = 5e8;
    setRays(target * slowStepsPerSecond / std::max(steps, 1.0));
  }

  std::int64_t rays() const { return rays_; }

  /// What a launch of so many rays took.
  void add(std::int64_t traced, std::int64_t crossed, double seconds)
  {
    constexpr std::int64_t largestGrowth = 2;
    if (crossed > 0 && seconds > 0)
    {
      const std::int64_t most = std::max(rays_, largestGrowth * traced);
      setRays(std::min(target * static_cast<double>(crossed) / seconds, static_cast<double>(most)));
    }
  }

private:
  void setRays(double rays)
  {
    rays_ = static_cast<std::int64_t>(std::clamp(rays, 1.0, static_cast<double>(maxRays)));
  }

  std::int64_t rays_ = 1;
};

} // namespace schlieren
