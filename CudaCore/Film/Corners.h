// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The four corners of what light covers on the film; of a triangle, the last two are one.
#pragma once

#include "Math/Pack.h"

#include <cmath>

namespace schlieren
{

/// A place on the film, pixels.
struct FilmPoint
{
  double x, y;
};

/// An upright rectangle of the film.
struct FilmBox
{
  double left, right, low, high;

  SCHLIEREN_HD static FilmBox around(const FilmPoint (&at)[4])
  {
    FilmBox box = { at[0].x, at[0].x, at[0].y, at[0].y };
    for (int i = 1; i < 4; ++i)
    {
      box = { minimum(box.left, at[i].x), maximum(box.right, at[i].x), minimum(box.low, at[i].y),
        maximum(box.high, at[i].y) };
    }
    return box;
  }
};

/// Makes the second of four corners, or of what they have, the first one.
template <class Each>
SCHLIEREN_HD void turnCorners(Each (&corners)[4])
{
  const Each first = corners[0];
  corners[0] = corners[1];
  corners[1] = corners[2];
  corners[2] = corners[3];
  corners[3] = first;
}

/// Calls use(a corner, the next one, that after it). No corner is chosen by a number, so that they may be in
/// registers.
template <class Use>
SCHLIEREN_HD void forEachCorner(const FilmPoint (&at)[4], const Use& use)
{
  FilmPoint corners[4] = { at[0], at[1], at[2], at[3] };
  for (int i = 0; i < 4; ++i)
  {
    use(corners[0], corners[1], corners[2]);
    turnCorners(corners);
  }
}

/// Twice the area of a triangle, negative where its corners go round clockwise.
SCHLIEREN_HD double cross(const FilmPoint& a, const FilmPoint& b, const FilmPoint& c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether parts of an area stand out from rounding.
SCHLIEREN_HD bool isWide(double area, const FilmPoint (&at)[4])
{
  constexpr double least = 1e-9; // of the square of the extent
  const FilmBox box = FilmBox::around(at);
  const double extent = maximum(box.right - box.left, box.high - box.low);
  return fabs(area) > least * extent * extent;
}

} // namespace schlieren
