// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What rays are traced by, and what becomes of them.
#pragma once

#include "Medium/Medium.h"
#include "Rays/Light.h"
#include "Rays/March/Integrators.h"
#include "Rays/RayExit.h"

#include <cstdint>

namespace schlieren
{

struct KernelChoice
{
  PathModel path;
  Integrator integrator;
  Interpolation interpolation;
};

/// All that one ray needs, host and device alike.
template <class Number>
struct RayTask
{
  KernelChoice kernel;
  MediumView<Number> medium;
  Light light;
  Vec3<Number> indexScale; ///< of the light
  Number step;             ///< in units of the light's unit of length
  Number stepAtEdge;       ///< of leaves where gas may end
  bool
    mayCrossLeaves; ///< bent rays may cross a leaf with one step, where its voxels are much longer than wide
  std::int32_t stepLimit;
  double metresPerUnit; ///< of optical path: n_ref * length scale * unit of length
  Number largestQ;      ///< no ray has more of q
  Number allowedBend;   ///< Adaptive: error of q allowed in a step, per unit of length
  Number allowedOffset; ///< Adaptive: the same of the offset
};

/// Rays in plain arrays: what the tracer hands to the marcher and gets back.
template <class Number, int Lanes>
struct RayBatch
{
  double start[3][Lanes]; ///< index coordinates within the domain
  alignas(Lanes *
    sizeof(Number)) Number direction[3][Lanes]; ///< of undisturbed light, along the grid's axes
  Number perLength[3][Lanes]; ///< the same in index coordinates per unit of length
  Number q[3][Lanes];         ///< at the end, as all that follows
  Number offset[3][Lanes];    ///< index coordinates
  Number end[3][Lanes];       ///< local coordinates of the last leaf
  Number length[Lanes];
  Number path[Lanes];
  Number pathError[Lanes];
  Number drift[Lanes]; ///< | |p| / n - 1 | at the end
  RayFate fate[Lanes]; ///< Left: to be traced; anything else: not
  std::int32_t steps[Lanes];
};

} // namespace schlieren
