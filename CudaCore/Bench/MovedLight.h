// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How far a view's light is moved, by a coarse look at it before its image is made.
#pragma once

#include "Bench/Tracer.h"
#include "Rays/March/RayTask.h"
#include "Types.h"

#include <vector>

namespace schlieren
{

/// How a ray differs from the undisturbed one where it leaves the data.
struct MovedRay
{
  double displacement[2]; ///< on the exit plane along u and v, data units
  double slope[2];        ///< behind it
};

/// Those that leave the data of some hundred to some thousand rays, one of sixty pixels of an image and its surroundings
/// of maxMargin(). Their places in rows of squares differ from band to band of rows, so that what is narrow and along u
/// or v is met, too.
template <class Real>
std::vector<MovedRay> lookAtLight(const Tracer<Real>& tracer, RayTask<Real> task, const View& view);

/// A ray, and the ones to the right of it and above.
struct MovedNeighbours
{
  MovedRay rays[3];
  double apart; ///< pixels
};

/// Those that leave the data of one in each of 128 squares along the larger side of an image, 1/512 of that side apart,
/// whatever its number of pixels.
template <class Real>
std::vector<MovedNeighbours> lookAtNeighbours(
  const Tracer<Real>& tracer, RayTask<Real> task, const View& view);

/// The most that they are moved at a distance behind the exit plane, data units. What lies between them may be moved
/// further: of a Gaussian's slope with a standard deviation as wide as the rays are apart, by less than a fifth.
double maximumShift(const std::vector<MovedRay>& rays, double distance);

} // namespace schlieren
