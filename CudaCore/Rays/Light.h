// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Vec3.h"
#include "Rays/RayExit.h"
#include "Types.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace schlieren
{

/// How undisturbed light is inclined to w: its slopes along u and v, by pixel.
struct Inclination
{
  double atOrigin[2]; ///< of the ray through the centre of pixel (0, 0)
  double perPixel;    ///< 0: collimated light

  /// Along `axis` (0: u, 1: v) at a column or row, for a pass's tilt along that axis.
  SCHLIEREN_HD double at(int axis, double pixel, double tilt) const
  {
    return atOrigin[axis] + pixel * perPixel + tilt;
  }
  /// Whether there are rays that are not along w.
  SCHLIEREN_HD bool isInclined(const double (&tilt)[2]) const
  {
    return perPixel != 0 || tilt[0] != 0 || tilt[1] != 0;
  }
};

/// Gives, for a point of the image, the straight line in the grid's index coordinates that light follows there
/// before anything bends it. With X the point's place from the axis in the image's plane, which is that
/// through the middle of the data, and zeta the distance along w from there, the line is
///   P(zeta) = X (1 + zeta / R) + t (zeta - z),
/// R being the distance of the source, z the film's plane or what a camera is focused on, and t the tilt of the light of one
/// point of an extended source or of a lens's aperture (Pass). So all light of X meets that plane at X (1 + z / R), wherever
/// it comes from.
/// With a perspective, the image's plane is that of the focal point instead, from which zeta counts then.
/// Where the data are left into something else, the line is that in the data. There, light seems to come from further
/// away or nearer than it does, by the ratio of the indices (apparent depth, for small angles): a pupil is where it
/// seems to be from the data, so that an image lies over them, and R and the film's distance are reckoned so.
/// Lengths are in units of the smallest grid spacing, so that nothing depends on the data's unit of length.
struct Light
{
  Vec3<double> corner;    ///< index coordinates on the entry plane, of the ray through pixel (0, 0)
  Vec3<double> perColumn; ///< index coordinates on the entry plane, per pixel along u
  Vec3<double> perRow;    ///< index coordinates on the entry plane, per pixel along v
  Inclination inclination;
  double first;   ///< entry plane to where light begins, along w: not 0 of a pupil within the data
  double toFocus; ///< entry plane to where the light of a point of the image meets, along w
  double pupilTilt; ///< the largest tilt of light through an aperture; 0: there is none

  Vec3<double> perLength; ///< index coordinates per unit of length along w
  Vec3<double> lengthPer; ///< its inverse, axis by axis; infinite where it is 0

  Vec3<double> u, v,
    w; ///< the image's axes in the grid's axes; w: the direction that rays are traced in
  Vec3<double> indexScale;    ///< index coordinates per unit of length along each grid axis
  Vec3<double> unitsPerIndex; ///< its inverse, axis by axis
  double depth;               ///< entry plane to exit plane
  double unit;                ///< the unit of length, data units
  double steepest[2];         ///< no slope of this light is larger, along u and v
  double magnification;       ///< 1 + z / R: of what is in the middle of the data, on the film
  ExitFaces faces;            ///< where it enters and leaves the data

  /// Where the light of a point of the image is on the entry plane, in index coordinates.
  SCHLIEREN_HD Vec3<double> start(double column, double row) const
  {
    return corner + column * perColumn + row * perRow;
  }
  /// How far a pass's tilt moves that, so that the light meets the film where it did.
  SCHLIEREN_HD Vec3<double> shift(const double (&tilt)[2]) const
  {
    return scaled(indexScale, (-toFocus * tilt[0]) * u + (-toFocus * tilt[1]) * v);
  }
  /// The smallest cosine between its rays and w.
  SCHLIEREN_HD double smallestCosine() const
  {
    return 1 / std::sqrt(1 + steepest[0] * steepest[0] + steepest[1] * steepest[1]);
  }
  /// Index coordinates that a ray crosses at most per unit of length; or others, of which there are `scale` per unit.
  double fastest() const { return fastest(indexScale); }
  double fastest(const Vec3<double>& scale) const;
};

/// The image plane of a view of a grid. Throws Error where the view is degenerate.
Frame frameOf(const Grid& grid, const View& view);

/// The light of the image `frame` of `grid`, all of it along w.
Light collimatedLight(const Grid& grid, const Frame& frame);

/// The aperture of a camera's lens.
struct Aperture
{
  /// With a perspective its radius by its distance from the plane of the focal point; else, of a telecentric lens, the
  /// largest slope of the light that it gathers. In the data. 0: a pinhole.
  double slope = 0;
  double focus =
    0; ///< from the plane where light leaves the data to the one in focus, data units, out there

  auto tie() const { return std::tie(slope, focus); }
};

/// The same from the viewer, against w: the rays of a camera. They start on the frame's exit plane.
Light reversedLight(const Grid& grid, const Frame& frame, const ExitFaces& faces = noFaces,
  const Aperture& aperture = {});

/// Distance from the middle of the data to a source as it seems to be from there. `distance`: to where it is.
double distanceInData(double distance, const Frame& frame, double exitRatio);

/// The light of a source on the line through the middle of the image; with a perspective it is the pupil, and light
/// goes against w, through the aperture. `film`: from the plane where light leaves the data to the film, data units, out
/// there; without an aperture it is in focus.
Light lightFrom(const LightSource& source, double film, const Grid& grid, const View& view,
  const Frame& frame, const ExitFaces& faces = noFaces, const Aperture& aperture = {});

/// Data coordinates of a place in index coordinates.
Vector placeOf(const Grid& grid, const Vec3<double>& index);

/// Pixels around the image that rays may start from, at most.
std::int64_t maxMargin(const View& view);

} // namespace schlieren
