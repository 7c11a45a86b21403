// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Optics/RayAtFilm.h"
#include "Rays/Light.h"
#include "Rays/RayExit.h"

#include <cmath>

namespace schlieren
{

/// Projects from where rays leave the grid to the film. The film's coordinates are those of the image in the middle
/// of the data, so that undisturbed light is where it was there, however much larger it has become.
struct Projection
{
  double distance;    ///< of what the film shows past the exit plane, data units; < 0: before it
  double perDataUnit; ///< pixels, for a data unit on the film
  double
    pathPerDataUnit; ///< optical path of undisturbed light, metres; 0: straight rays, no longer for their bend
  Inclination inclination{ { 0, 0 }, 0 }; ///< of the light, in the data
  double exitRatio = 1;                   ///< see Light; of lengths, these are outside of the data
  double perSourceDistance = 0; ///< 1 / from the source to the film, by data unit; 0: collimated
  bool isOfCamera = false; ///< rays come from the image: their light belongs to where they start
  double pupilTilt = 0;    ///< of a camera: see Light; 0: a pinhole
  double pastFocus =
    0; ///< of a camera with an aperture: how far what the film shows is past what is in focus, in the data
};

/// Whether what the film shows of a ray has come through the medium. All that a camera sees counts as such: its
/// rays stay in their pixels, whatever they meet.
SCHLIEREN_HD bool crossedOnTheWay(const RayExit& exit, const Projection& projection)
{
  return projection.isOfCamera || exit.fate != RayFate::Missed;
}

/// What the film gets of a ray, and all that depositing knows of it.
template <int planes>
struct FilmRay
{
  double x,
    y; ///< pixels from the film's lower left corner: pixel (i, j) is [i, i + 1] x [j, j + 1]
  double light[planes]; ///< 0 ... 1; of FringePhase: turns
  bool arrives;
  bool crossed = true; ///< the medium
};

/// How far a ray is off the undisturbed one on the film.
struct FilmShift
{
  double moved[2];   ///< along u and v, data units
  double longer = 0; ///< than the undisturbed light's path to this place, data units
};

/// Shifts a ray that starts at (column, row) of the image, with the exit's deflection and displacement.
SCHLIEREN_HD FilmShift shiftOnFilm(const double (&eps)[2], const float (&displacement)[2],
  double column, double row, const double (&tilt)[2], const Projection& projection)
{
  FilmShift shift{ { static_cast<double>(displacement[0]), static_cast<double>(displacement[1]) } };
  double(&moved)[2] = shift.moved;
  double& longer = shift.longer;
  if (!projection.inclination.isInclined(tilt))
  {
    const double sideways = eps[0] * eps[0] + eps[1] * eps[1];
    const double forward = sqrt(sideways < 1 ? 1 - sideways : 1e-30); // cosine along w
    const double pathLength = projection.distance / forward;
    moved[0] += pathLength * eps[0];
    moved[1] += pathLength * eps[1];
    // 1 / forward - 1, without losing small angles.
    longer = projection.distance * (sideways / (forward * (1 + forward)));
  }
  else
  {
    // Of the undisturbed ray: slopes, and cosines d along u, v and w. Of the bent one: p = d + eps.
    double slope[2] = { projection.inclination.at(0, column, tilt[0]),
      projection.inclination.at(1, row, tilt[1]) };
    double cosine = 1 / sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
    double d[2] = { slope[0] * cosine, slope[1] * cosine };
    if (projection.exitRatio != 1) // it is refracted where it leaves the data
    {
      d[0] *= projection.exitRatio;
      d[1] *= projection.exitRatio;
      const double square = d[0] * d[0] + d[1] * d[1];
      cosine = sqrt(square < 1 ? 1 - square : 1e-30);
      slope[0] = d[0] / cosine;
      slope[1] = d[1] / cosine;
    }
    const double p[2] = { d[0] + eps[0], d[1] + eps[1] };
    const double sideways = p[0] * p[0] + p[1] * p[1];
    const double forward = sqrt(sideways < 1 ? 1 - sideways : 1e-30);
    const double along = -((d[0] + p[0]) * eps[0] + (d[1] + p[1]) * eps[1]) / (forward + cosine);
    const double pathLength = projection.distance / forward;
    // tan p - tan d = (eps - tan d eps_w) / p_w.
    moved[0] += pathLength * (eps[0] - slope[0] * along);
    moved[1] += pathLength * (eps[1] - slope[1] * along);
    // 1 - d.p = |p - d|^2 / 2; and the undisturbed light is a sphere around its source.
    const double perRadius = projection.perSourceDistance * cosine;
    const double ahead = d[0] * moved[0] + d[1] * moved[1];
    const double beside = moved[0] * moved[0] + moved[1] * moved[1] - ahead * ahead;
    const double further = 1 + ahead * perRadius;
    longer = 0.5 * pathLength * (eps[0] * eps[0] + eps[1] * eps[1] + along * along) -
      beside * perRadius / (further + sqrt(further * further + beside * perRadius * perRadius));
  }
  return shift;
}

/// A ray that starts at (column, row) of the image and reaches the film, there. The camera's lens makes all
/// paths from a point in focus to its image equal, so that the path on the film is that to this point.
SCHLIEREN_HD RayAtFilm rayAtFilm(const RayExit& exit, double column, double row,
  const double (&tilt)[2], const Projection& projection)
{
  const FilmShift shift =
    shiftOnFilm(exit.deflection, exit.displacement, column, row, tilt, projection);
  const double start[2] = { column, row };
  RayAtFilm ray{ { exit.deflection[0], exit.deflection[1] },
    exit.opticalPathDifference + shift.longer * projection.pathPerDataUnit, { 0, 0 }, { 0, 0 } };
  for (int axis = 0; axis < 2; ++axis)
  {
    const double spread = tilt[axis] * projection.pastFocus;
    ray.position[axis] = start[axis] + (shift.moved[axis] + spread) * projection.perDataUnit;
    ray.place[axis] = projection.isOfCamera ? start[axis] : ray.position[axis];
  }
  return ray;
}

/// Shades a ray that starts at (column, row) of the image. A place on the film where it does not arrive is 0.
template <class CutoffKind>
SCHLIEREN_HD FilmRay<CutoffKind::channels> shade(const RayExit& exit, double column, double row,
  const double (&tilt)[2], const Projection& projection, const CutoffKind& cutoff)
{
  FilmRay<CutoffKind::channels> ray{};
  ray.arrives = exit.reachesFilm();
  ray.crossed = crossedOnTheWay(exit, projection);
  if (ray.arrives)
  {
    const RayAtFilm atFilm = rayAtFilm(exit, column, row, tilt, projection);
    ray.x = atFilm.place[0] + 0.5;
    ray.y = atFilm.place[1] + 0.5;
    cutoff.shade(atFilm, ray.light);
  }
  return ray;
}

} // namespace schlieren
