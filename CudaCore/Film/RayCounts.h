// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/RayExit.h"

#include <cstdint>

namespace schlieren
{

/// What became of the rays of a picture.
struct RayCounts
{
  std::int64_t crossed = 0; ///< the grid
  std::int64_t steps = 0;   ///< of all rays
  std::int64_t blocked = 0;
  std::int64_t lost = 0; ///< trapped or turned back

  SCHLIEREN_HD void add(const RayExit& exit)
  {
    crossed += exit.fate != RayFate::Missed ? 1 : 0;
    steps += exit.steps;
    blocked += exit.fate == RayFate::Blocked ? 1 : 0;
    lost += exit.fate == RayFate::Trapped || exit.fate == RayFate::Turned ? 1 : 0;
  }

  void add(const RayCounts& others)
  {
    crossed += others.crossed;
    steps += others.steps;
    blocked += others.blocked;
    lost += others.lost;
  }
};

} // namespace schlieren
