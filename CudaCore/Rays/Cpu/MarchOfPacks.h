// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two packs of rays in turn: while one waits for what it has read, the other is computed. Where there is nothing in
// their way but the medium's samples, their steps are loops of their own, whose rays are copies: the compiler keeps
// these in registers.
#pragma once

#include "Medium/Samples/SimdInterpolation.h"
#include "Rays/Cpu/LeavesOfPacks.h"
#include "Rays/Cpu/SimdMarch.h"
#include "Rays/March/Marcher.h"

namespace schlieren
{

/// Takes `most` steps, of which none leaves the grid.
template <class Kernel, class Real, class May>
SCHLIEREN_HD void takeStepsInside(
  March<Kernel, Real, May>& a, March<Kernel, Real, May>& b, std::int32_t most)
{
  using Number = NumberOf<Real>;
  using Path = typename Kernel::Path;
  Ray<Real> ofA = a.ray, ofB = b.ray;
  for (std::int32_t taken = 0; taken < most; ++taken)
  {
    a.advance(ofA, a.cruise, Path::ahead(ofA, a.light, Number(0.5) * a.cruise));
    b.advance(ofB, b.cruise, Path::ahead(ofB, b.light, Number(0.5) * b.cruise));
  }
  a.ray = ofA;
  b.ray = ofB;
  a.steps += most;
  b.steps += most;
}

/// Fewer steps are not worth a loop of their own.
constexpr std::int32_t worthALoop = 4;

/// Some steps of packs that isPlain(), where there are enough of them.
template <class Kernel, class Real, class May>
SCHLIEREN_HD void takePlainSteps(March<Kernel, Real, May>& a, March<Kernel, Real, May>& b)
{
  const std::int32_t inside = minimum(a.stepsInside(), b.stepsInside());
  if (inside >= worthALoop)
  {
    takeStepsInside(a, b, inside);
  }
}

/// Takes the rays of two packs through the medium.
template <class Kernel, class Real, class May>
SCHLIEREN_HD void marchTwo(March<Kernel, Real, May>& a, March<Kernel, Real, May>& b)
{
  // To look again: a tree's leaves are left often.
  const std::int32_t pause = a.isTree() ? 2 : 8;
  std::int32_t next = 0;
  while (a.areUnderWay && b.areUnderWay)
  {
    if (a.steps >= next && a.isPlain() && b.isPlain())
    {
      const std::int32_t before = a.steps;
      takePlainSteps(a, b);
      next = a.steps - before < worthALoop ? a.steps + pause : 0;
    }
    a.takeStep();
    b.takeStep();
  }
  while (a.areUnderWay)
  {
    a.takeStep();
  }
  while (b.areUnderWay)
  {
    b.takeStep();
  }
  a.findDrift();
  b.findDrift();
}

} // namespace schlieren
