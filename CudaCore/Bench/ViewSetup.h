// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/MediumCache.h"
#include "Bench/RayCache.h"
#include "Bench/Tracer.h"
#include "Film/Shading.h"
#include "Optics/AutomaticK.h"
#include "Rays/March/MakeTask.h"
#include "Types.h"

#include <cstdint>

namespace schlieren
{

/// What an image is made by besides its scene: made once, when the medium has what the view needs of it.
template <class Real>
struct ViewSetup
{
  MediumOnDevices<Real>& medium; ///< stays with its owner
  Tracer<Real> tracer;
  ViewKey key;
  Light light; ///< with the faces of all voxels
  RaySettings settings;
  RayTask<Real> task;
  std::int64_t margin;     ///< pixels around the image from which light may be bent into it
  double movedInFocus;     ///< see there
  double exitRefractivity; ///< of what light leaves the data into
  DeflectionErrors errors;
  Projection projection; ///< of the film
  PixelPlaces pixels;
};

} // namespace schlieren
