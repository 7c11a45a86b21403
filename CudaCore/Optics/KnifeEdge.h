// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Math/Trigonometry.h"
#include "Math/Units.h"
#include "Optics/Color.h"
#include "Optics/RayAtFilm.h"
#include "Optics/Table.h"
#include "Types.h"

#include <cmath>

namespace schlieren
{

/// Where light meets the cutoff plane along one direction of it.
struct CutoffAxis
{
  double k;         ///< focal length by width of the source, f/a
  double normal[2]; ///< (cos angle, sin angle)
  double offset;    ///< how far the edge is in, as a fraction of the source's image

  /// `degrees`: 0 measures the deflection along u, 90 along v. Exact at right angles, so that an edge
  /// along one axis sees nothing of the other.
  static CutoffAxis at(double degrees, double k, double offset)
  {
    const double turn = std::remainder(degrees, 360.0);
    const double cosine = std::abs(turn) == 90 ? 0 : std::cos(turn * radiansPerDegree);
    const double sine = std::abs(turn) == 180 ? 0 : std::sin(turn * radiansPerDegree);
    return { k, { cosine, sine }, offset };
  }

  /// 1/2 - offset + k e: the fraction of an evenly bright image of the source, as wide everywhere, that is
  /// past the edge. Beyond 0 ... 1 all of it is on one side.
  SCHLIEREN_HD double placeOf(const double (&eps)[2]) const
  {
    return 0.5 - offset + k * (eps[0] * normal[0] + eps[1] * normal[1]);
  }
};

/// Knife edge (Settles 2001, ch. 3: dI/I = f eps / a, k = f/a): the fraction of the source's image that the
/// edge lets pass. Of a point or a slit along the edge it is I = 1/2 - offset + k e, clamped to 0 ... 1;
/// of a disc, whose diameter is a, the area of a segment of a circle.
struct KnifeEdge
{
  static constexpr int channels = 1;

  CutoffAxis axis;
  bool isOfDisc; ///< the source's image is a disc

  static KnifeEdge at(
    double degrees, double k, double offset = 0, SourceShape source = SourceShape::Slit)
  {
    return { CutoffAxis::at(degrees, k, offset), source == SourceShape::Disc };
  }

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    double fraction = limited(axis.placeOf(ray.deflection));
    if (isOfDisc)
    {
      const double sine = 2 * fraction - 1; // of the angle under which the edge meets the circle
      const double cosine = sqrt(1 - sine * sine);
      fraction = limited(0.5 + (sine * cosine + angleOf(cosine, sine)) / pi);
    }
    light[0] = fraction;
  }

  /// Whether bending this ray a little more would change nothing.
  SCHLIEREN_HD bool saturates(const double (&eps)[2]) const
  {
    const double place = axis.placeOf(eps);
    return place < 0 || place > 1;
  }
};

/// A filter of any transmission, evenly spaced over the source's image.
struct GradedFilter
{
  static constexpr int channels = 1;

  CutoffAxis axis;
  Table table; ///< from place 0 to 1

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    light[0] = interpolate(table, axis.placeOf(ray.deflection));
  }

  SCHLIEREN_HD bool saturates(const double (&eps)[2]) const
  {
    const double place = axis.placeOf(eps);
    return place < 0 || place > 1;
  }
};

} // namespace schlieren
