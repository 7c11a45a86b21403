// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What a ray's neighbours in its pass say of the light between them.
#pragma once

#include "Film/Shading.h"
#include "Math/HostDevice.h"
#include "Optics/Color.h"

#include <cmath>

namespace schlieren
{

/// Whether there is light between two rays. Where one crosses the medium and the other does not, what there is
/// of either ends at the medium's side.
template <int planes>
SCHLIEREN_HD bool areTogether(const FilmRay<planes>& a, const FilmRay<planes>& b)
{
  return a.arrives && b.arrives && a.crossed == b.crossed;
}

/// Second difference of light from ray to ray.
template <int planes>
SCHLIEREN_HD double secondDifference(const FilmRay<planes>& before, const FilmRay<planes>& here,
  const FilmRay<planes>& after, int plane)
{
  return (before.light[plane] - here.light[plane]) + (after.light[plane] - here.light[plane]);
}

/// A ray among its neighbours of the same pass. Its light is such that linear interpolation between rays, which
/// would flatten what is curved, has the right mean: less a twelfth of the second difference each way.
template <int planes>
struct SheetRay : FilmRay<planes>
{
  double bend = 0; ///< pixels: the largest second difference of where rays land
};

/// Neighbours that do not arrive, are none, or on the other side of the medium's edge count for nothing. `isOfPhase`: see Sheet.
template <bool isOfPhase = false, int planes>
SCHLIEREN_HD SheetRay<planes> sheetRay(const FilmRay<planes>& here, const FilmRay<planes>& left,
  const FilmRay<planes>& right, const FilmRay<planes>& below, const FilmRay<planes>& above)
{
  SheetRay<planes> ray;
  static_cast<FilmRay<planes>&>(ray) = here;
  const auto look = [&here, &ray](const FilmRay<planes>& before, const FilmRay<planes>& after)
  {
    if (!areTogether(here, before) || !areTogether(here, after))
    {
      return;
    }
    const double x = fabs((before.x - here.x) + (after.x - here.x));
    const double y = fabs((before.y - here.y) + (after.y - here.y));
    ray.bend = ray.bend > x ? ray.bend : x;
    ray.bend = ray.bend > y ? ray.bend : y;
    for (int plane = 0; plane < planes; ++plane)
    {
      ray.light[plane] -= secondDifference(before, here, after, plane) * (1. / 12);
    }
  };
  if (here.arrives)
  {
    look(left, right);
    look(below, above);
    for (double& light : ray.light)
    {
      light = isOfPhase ? light : limited(light);
    }
  }
  return ray;
}

} // namespace schlieren
