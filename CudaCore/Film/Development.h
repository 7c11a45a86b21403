// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Exposure.h"
#include "Optics/Cutoffs.h"
#include "Optics/Tint.h"
#include "PixelArray.h"
#include "Schlieren.h"

#include <cstdint>
#include <optional>

namespace schlieren
{

/// The films that a scene needs, one of samples among them where its noise filter counts these.
Films filmsOf(
  const Scene& scene, const Cutoffs& cutoff, std::optional<Tint> tint, std::int64_t mostRays);

/// Makes of the films, which it uses up, the picture: its light, intensity and colour, without noise.
void develop(Films& films, const Scene& scene, Image& image);

/// What a camera sees without the flow: passes of rays that nothing bends, on films like those of the
/// picture, so that where the flow bends nothing either no bit differs. Empty if aborted.
PixelArray<float> undisturbedPicture(const Scene& scene, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, std::int64_t mostRays, const Monitor& monitor);

/// How far from where they start the mean rays of pixels meet the background: 2 per pixel, data units.
PixelArray<float> backgroundDisplacement(const Image& image, double distance);

} // namespace schlieren
