// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the kernel that a task names to its type.
#pragma once

#include "Rays/March/Marcher.h"

namespace schlieren
{

/// Calls visit with an object of the kernel's type, whose scheme is given; of integrators that take several samples
/// a step another one may be.
template <class Scheme, class SchemeApart = Scheme, class Visit>
auto visitKernelOf(const KernelChoice& choice, const Visit& visit)
{
  if (choice.path == PathModel::Straight)
  {
    return visit(Kernel<StraightPath, Leapfrog, Scheme>{});
  }
  switch (choice.integrator)
  {
    case Integrator::Rk4:
      return visit(Kernel<RefractedPath, Rk4, SchemeApart>{});
    case Integrator::Adaptive:
      return visit(Kernel<RefractedPath, Adaptive, SchemeApart>{});
#ifndef SCHLIEREN_WITHOUT_PAPER_METHODS
    case Integrator::Euler:
      return visit(Kernel<RefractedPath, Euler, SchemeApart>{});
#endif
    default:
      return visit(Kernel<RefractedPath, Leapfrog, Scheme>{});
  }
}

/// The same with the scheme that is chosen, for the CPU.
template <class Visit>
auto visitKernel(const KernelChoice& choice, const Visit& visit)
{
  return visitScheme(choice.interpolation,
    [&](auto scheme) { return visitKernelOf<decltype(scheme), SchemeOfTask>(choice, visit); });
}

} // namespace schlieren
