// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Straight rays through the leaves of a tree: how much light may be bent, before any image is made.
#pragma once

#include "Medium/Samples/Leaves.h"
#include "Types.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

namespace schlieren
{

/// What a view looks at: a column through the data, or with a perspective what is in front of the pupil, where all lines
/// of sight meet. Unbounded where the half widths are infinite.
struct Column
{
  Vec3<double> u, v;   ///< of the image, unit vectors, along the source's axes
  double middle[2];    ///< image coordinates, data units
  double halfWidth[2]; ///< along u and v, data units
  double finest; ///< no voxel needs to be smaller: data units, the pixel's size or a fraction of it
  double pupil =
    0; ///< from the image's plane, along w = u x v, data units; 0: all lines are along w
  double plane =
    0; ///< x.w of the image's plane, where there is a pupil; half widths and pixels are those there

  /// It is refined this much wider than it is, so that small turns need nothing new.
  static constexpr double widening = 1.1;

  /// A rectangle of image coordinates, data units.
  struct Part
  {
    double middle[2], halfWidth[2];
  };
  std::vector<Part> parts{}; ///< where it is refined; none: everywhere
  double fullScale =
    0; ///< a deflection: errors are compared with no more than that; 0: see RayFindings::strong

  auto tie() const
  {
    return std::tie(u.x, u.y, u.z, v.x, v.y, v.z, middle[0], middle[1], halfWidth[0], halfWidth[1],
      finest, pupil, plane, fullScale);
  }

  /// How wide the column is at x.w = `place`, by its width in the image's plane; not positive behind the pupil.
  double widthAt(double place) const { return pupil > 0 ? 1 - (place - plane) / pupil : 1; }
};

/// How bricks are laid out.
struct BrickLayout
{
  std::int64_t samplesPerBrick;
  std::int32_t apron;
  BrickShape shape;
  Interpolation interpolation;

  /// The axes along which there is more than one sample.
  int axes() const { return shape == BrickShape::Layer ? 2 : 3; }
};

/// All that rays see of a tree.
template <class Real>
struct LeavesView
{
  const Grid& grid;
  LeafFinder finder;
  const Leaf<Real>* leaves;
  const float*
    differences; ///< of each leaf: by how much nu differs there, where one value stands for all; else 0
  const float* errors;  ///< of each leaf: of a ray's deflection over its longest edge, the largest
  const float* typical; ///< the same of most rays
  const Real* samples;
  const std::int16_t* gasDistances;
  BrickLayout layout;
};

/// What straight rays find: those on a lattice over the column, and those through some places (index coordinates)
/// as far as they are in it. Of rays that no wall stops; where walls stop all, of these.
struct RayFindings
{
  double deflection = 0; ///< the largest
  /// What is full scale of an image of them: of the lattice's rays, what 99 % do not exceed, but no less than a tenth of
  /// the largest, as automatic k has it; or Column::fullScale, where that is less.
  double strong = 0;
  double opticalPath = 0; ///< the largest; nu times data units
  /// The error that 99 % of all deflections keep: along a ray, what is typical of leaves and what leaves with one value
  /// neglect, each with any sign, add up by their squares to the standard deviation of its error.
  double error = 0;
  /// Leaves with one value for all that need samples: what such leaves neglect adds up along a ray to more than
  /// `tolerance` of a strong deflection or of the largest optical path. Those that contribute most, so that half of it is gone.
  std::vector<std::int32_t> coarse;
  /// Leaves whose samples are too far apart, as errors along a ray add up. Those that contribute most.
  std::vector<std::int32_t> wrong;
};
/// `least`: what is known of the largest ones, e.g. from samples that are no longer there.
template <class Real>
RayFindings lookAlongRays(const LeavesView<Real>& medium, const Column& column,
  const std::vector<Vec3<double>>& places, double tolerance, const RayFindings& least, int threads);

} // namespace schlieren
