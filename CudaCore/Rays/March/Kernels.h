// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the kernel that a task names to its type.
#pragma once

#include "Rays/March/Marcher.h"

namespace schlieren
{

/// Calls visit with an object of the kernel's type, whose scheme is given; of the integrator that takes several samples
/// a step another one may be.
template <class Scheme, class SchemeApart = Scheme, class Visit>
auto visitKernelOf(const KernelChoice& choice, const Visit& visit)
{
  if (choice.path == PathModel::Straight)
  {
    return visit(Kernel<StraightPath, Leapfrog, Scheme>{});
  }
  return choice.integrator == Integrator::Adaptive
    ? visit(Kernel<RefractedPath, Adaptive, SchemeApart>{})
    : visit(Kernel<RefractedPath, Leapfrog, Scheme>{});
}

/// The same with the scheme that is chosen, for the CPU.
template <class Visit>
auto visitKernel(const KernelChoice& choice, const Visit& visit)
{
  return visitScheme(choice.interpolation,
    [&](auto scheme) { return visitKernelOf<decltype(scheme), SchemeOfTask>(choice, visit); });
}

} // namespace schlieren
