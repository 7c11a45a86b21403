// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace schlieren
{

/// What optics sees of a ray that reaches the film.
struct RayAtFilm
{
  double deflection[2]; ///< direction cosines along u and v
  double path;          ///< optical path difference on the film, metres
  double position
    [2]; ///< where it meets the film, or a camera's ray what it sees: pixels from the centre
         ///< of pixel (0, 0)
  double place[2] = { 0,
    0 }; ///< of its light in the image, likewise; position but for a camera's ray
};

} // namespace schlieren
