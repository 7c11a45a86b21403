// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Tree/MediumTree.h"
#include "Medium/Tree/StraightRays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace schlieren
{

/// A column, and what it needs of nodes.
template <class Real>
class MediumTree<Real>::View
{
  /// Layers between samples that are no further apart than this do not matter.
  static constexpr double pixelsOfLayer = 4;

  /// Of the largest voxels that show walls that are not flat.
  static constexpr double pixelsOfVoxel = 4;

  /// Voxels that waves of a few pixels need, and those that they need where an image is to be as right as it can be.
  static constexpr double pixelsOfWaves = 0.5, pixelsOfExactWaves = 0.25;

  /// Estimates how many levels a medium has, for the progress that is reported.
  static constexpr int usualLevels = 10;

  /// Voxels of faces of glass and of liquids, where cells are as fine: what light meets there turns it all the way behind.
  static constexpr double pixelsOfFaces = 0.125;

public:
  /// 16 root cells of 16 samples, halved so often, count within 32 bits.
  static constexpr int finestLevelOfAll = 20;

  explicit View(const MediumTree& tree)
    : tree_(tree)
    , work_(tree.work_)
    , column_(tree.work_.column)
  {
  }

  bool sees(const NodePlace& place) const
  {
    return isInColumn(place) && (column_.parts.empty() || isInParts(place));
  }

  /// Whether it is to have samples where its siblings have some. Light may leave the parts that are looked at.
  bool isInColumn(const NodePlace& place) const
  {
    for (std::size_t axis = 0; axis < tree_.maker_.axes(); ++axis)
    {
      const double first =
        std::ldexp(brickEdge * static_cast<double>(place.at[axis]), -place.level);
      if (first >= static_cast<double>(tree_.grid_.dimensions[axis] - 1))
      {
        return false;
      }
    }
    constexpr double wider = Column::widening;
    const Column::Part all{ { column_.middle[0], column_.middle[1] },
      { wider * column_.halfWidth[0], wider * column_.halfWidth[1] } };
    return isSeenIn(column_, all, tree_.maker_.boxOf(place));
  }

  /// Whether voxels of the next level are wanted along an axis, which are no smaller than so many pixels.
  bool allows(const NodePlace& place, std::size_t axis, double pixels = 1) const
  {
    return allows(place.level, axis, pixels * pixelAt(place));
  }
  bool allows(const NodePlace& place, double pixels = 1) const
  {
    return allows(place.level, pixels * pixelAt(place));
  }

  /// How long a ray is in a leaf, by the leaf's edge, as far as that is not about 1: in one as deep as the domain.
  double lengthIn(int level) const
  {
    if (tree_.maker_.shape() == BrickShape::Cube)
    {
      return 1;
    }
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(level);
    const double edge = brickEdge * std::max(voxel[0], voxel[1]);
    const double along = std::abs(cross(column_.u, column_.v).z);
    const double aside = std::sqrt(std::max(0., 1 - along * along));
    return aside * voxel[2] > along * edge ? 1 / aside : voxel[2] / (along * edge);
  }

  /// The error of a node that the next level would lessen, without edges: of rays.
  double errorOf(const NodePlace& place, const BrickFacts& facts) const
  {
    return lengthIn(place.level) * errorOverEdge(place, facts);
  }

  /// The same of rays that are in it for as long as its edge.
  double errorOverEdge(const NodePlace& place, const BrickFacts& facts) const
  {
    const double pixel = pixelAt(place);
    const double u[3] = { column_.u.x, column_.u.y, column_.u.z };
    const double v[3] = { column_.v.x, column_.v.y, column_.v.z };
    std::array<double, 3> weights{ 0, 0, 0 };
    for (std::size_t axis = 0; axis < tree_.maker_.axes(); ++axis)
    {
      // Light that crosses a layer is bent no more than by one as thick as a voxel.
      weights[axis] = std::max(std::hypot(u[axis], v[axis]), 1. / brickEdge);
    }
    return std::max({ alongLight(place, facts, isAllowed(place, pixelsOfDetail())).largest,
      alongLight(place, facts, isAllowed(place, 1)).largestAtEdges,
      hiddenIn(place, pixel, facts.hidden, weights) });
  }

  /// What is typical of rays that are in it for as long as its edge, whatever the next level may mend.
  double typicalOverEdge(const NodePlace& place, const BrickFacts& facts) const
  {
    return alongLight(place, facts, { true, true, true }).typical;
  }

  /// How badly a leaf needs to be divided; 0: not at all.
  double urgencyOf(const Node& node) const
  {
    if (node.facts.isTooLarge)
    {
      return std::numeric_limits<double>::infinity();
    }
    const double error = errorOf(node.place, node.facts);
    constexpr double ofGrazing = 8; // light that grazes an edge is wrong over a longer path
    const double ofWindow = (isEdgeOn(node) ? ofGrazing : 1) * node.facts.ofWindow;
    const bool hasWindow = ofWindow > negligible(node.place.level);
    const bool hasWall = node.facts.hasWallEdge && !showsWalls(node, 0.1);
    // Silhouettes are where walls are, however large cells are. Faces have many small bends, of which few are seen.
    const bool isSeen = node.facts.hasWallEdge &&
      !showsWalls(node, node.facts.areEdgesFine ? 0.5 : 0.2) && isEdgeOn(node);
    const bool isFine = (node.facts.areEdgesFine && !isSeen) || !allows(node.place);
    // A sharp edge is rounded off by a quarter of a voxel.
    const bool isSharp = isSeen && allows(node.place, 0.25);
    const bool hasEdge = ((hasWindow || hasWall) && !isFine) || isSharp;
    // Where nothing coarser has been compared with samples, these may have missed anything that is smaller.
    const auto canImprove = [&](double pixels)
    {
      const std::array<bool, 3> isAllowedAlong = isAllowed(node.place, pixels);
      bool can = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        can = can || (node.facts.canImprove[axis] && isAllowedAlong[axis]);
      }
      return can;
    };
    const bool isUnproved = node.place.level == 0 && node.brick > 0 && canImprove(pixelsOfDetail());
    // Errors of straight light say nothing of light that is bent within a leaf.
    const auto& slope = node.facts.slope;
    const bool isFace = *std::max_element(slope.begin(), slope.end()) > largestChangeByVoxel &&
      canImprove(pixelsOfFaces);
    double urgency = node.isWrong || error > allowed() || isFace ? error : 0;
    if (isUnproved || isFace)
    {
      urgency = std::max(urgency, std::numeric_limits<double>::min());
    }
    if (hasEdge)
    {
      // A shadow's edge that is wrong by a voxel is as wrong as can be.
      urgency = std::max({ urgency, work_.strong, std::numeric_limits<double>::min() });
    }
    return urgency;
  }

  /// Whether walls are where they should be, but for such a fraction of a pixel. Voxels must not be much larger than
  /// pixels for that to be known; between planes and distances from them there is only the rounding of these.
  bool showsWalls(const Node& node, double pixels) const
  {
    constexpr double pixelsOfVoxelAtPlanes = 400; // at most
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(node.place.level);
    const double pixel = pixelAt(node.place);
    const bool isFlat = node.facts.areWallsFlat;
    return (isFlat || node.facts.edgeError <= pixels * pixel) &&
      *std::max_element(voxel.begin(), voxel.begin() + tree_.maker_.axes()) <=
      (isFlat ? pixelsOfVoxelAtPlanes : pixelsOfVoxel) * pixel;
  }

  /// Whether a leaf is divided, and its children again, because of any walls that are not flat: see showsWalls().
  bool dividesAtWalls(const NodePlace& place) const
  {
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(place.level);
    return !work_.isMemoryShort && allows(place.level, 2 * pixelAt(place)) &&
      *std::max_element(voxel.begin(), voxel.begin() + tree_.maker_.axes()) >
      2 * pixelsOfVoxel * pixelAt(place);
  }

  /// Whether walls are seen edge-on in a leaf, or would be after a small turn.
  bool isEdgeOn(const Node& node) const
  {
    constexpr double margin = 0.2; // sine of the turn
    const Vec3<double> along = lineOfSight(node.place);
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(node.place.level);
    const double d[3] = { along.x / voxel[0], along.y / voxel[1], along.z / voxel[2] };
    double least = 0, most = 0, square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto [low, high] = node.facts.normals[axis];
      least += d[axis] * (d[axis] > 0 ? low : high);
      most += d[axis] * (d[axis] > 0 ? high : low);
      square += d[axis] * d[axis];
    }
    const double limit = margin * std::sqrt(square);
    return least <= limit && most >= -limit;
  }

  /// Finds what is negligible in a level's leaves, by their facts.
  double negligible(int level) const { return allowed() / lengthIn(level); }

  /// What is negligible to a leaf that is made, or made again, or to the children of one that is divided: nothing where
  /// too much has been neglected along rays; and what a leaf has, it keeps when it lacks something else.
  double negligibleTo(const Node& node, bool divides) const
  {
    const bool isNeeded = node.isCoarse || (!divides && node.brick > 0);
    return isNeeded ? 0 : negligible(node.place.level);
  }

  /// Whether a leaf has no samples because it is divided at walls.
  bool awaitsWalls(const Node& node) const
  {
    return node.facts.isTooLarge && node.place.level >= 0;
  }

  /// Whether a leaf lacks something that is not negligible.
  bool lacks(const Node& node) const
  {
    return node.isCoarse || node.facts.neglected > negligible(node.place.level) ||
      (awaitsWalls(node) && !dividesAtWalls(node.place));
  }

  /// How far refining has come, when so much of this round is done. Each level takes some four times as long as
  /// the one before; there may be less of them than the view allows, and rounds that refine no level.
  double progressAt(double ofRound) const
  {
    int levels = 1;
    while (levels < usualLevels && allows(levels, column_.finest))
    {
      ++levels;
    }
    return std::pow(4, -std::max(0., levels - (work_.rounds - 1) - ofRound));
  }

private:
  /// Errors of rays.
  double allowed() const { return tree_.settings_.tolerance * work_.strong; }

  bool allows(int level, std::size_t axis, double finest) const
  {
    constexpr double rounding = 1 - 1e-9;
    return level < finestLevelOfAll - tree_.coarserLevels_ && axis < tree_.maker_.axes() &&
      (level < 0 || tree_.maker_.voxelOf(level + 1)[axis] >= rounding * finest);
  }
  bool allows(int level, double finest) const
  {
    return allows(level, 0, finest) || allows(level, 1, finest) || allows(level, 2, finest);
  }

  /// The size of a pixel where a node is nearest to the pupil, or beside that a small fraction of it, data units.
  double pixelAt(const NodePlace& place) const
  {
    if (!(column_.pupil > 0))
    {
      return column_.finest;
    }
    constexpr double least = 1e-2;
    const Products depths = productsWith(cross(column_.u, column_.v), tree_.maker_.boxOf(place));
    return column_.finest * std::max(least, column_.widthAt(depths.middle + depths.half));
  }

  /// Along which axes voxels of the next level are wanted, which are no smaller than so many pixels.
  std::array<bool, 3> isAllowed(const NodePlace& place, double pixels) const
  {
    const double pixel = pixels * pixelAt(place);
    return { allows(place.level, 0, pixel), allows(place.level, 1, pixel),
      allows(place.level, 2, pixel) };
  }

  double pixelsOfDetail() const
  {
    constexpr double further = 0.5;   // so that errors of what is too fine for usual voxels show
    constexpr double inLayer = 0.125; // which has hardly more samples than cells
    double pixels = pixelsOfWaves;
    if (tree_.settings_.interpolation == Interpolation::Cubic)
    {
      pixels = pixelsOfExactWaves * (tree_.maker_.shape() == BrickShape::Layer ? inLayer : 1);
    }
    return column_.parts.empty() ? pixels : further * pixels;
  }

  /// Errors of rays to the viewer, because of gradients along axes that count.
  LineErrors::Error alongLight(
    const NodePlace& place, const BrickFacts& facts, const std::array<bool, 3>& counts) const
  {
    const Vec3<double> sight = lineOfSight(place);
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(place.level);
    return facts.errors.along(
      { sight.x / voxel[0], sight.y / voxel[1], sight.z / voxel[2] }, counts);
  }

  /// Between samples there may be a layer, of which few pixels are to be seen.
  double hiddenIn(const NodePlace& place, double pixel, const std::array<double, 3>& hidden,
    const std::array<double, 3>& weights) const
  {
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(place.level);
    double error = 0;
    for (std::size_t axis = 0; axis < tree_.maker_.axes(); ++axis)
    {
      const bool isSeen = voxel[axis] > pixelsOfLayer * pixel;
      error = isSeen ? std::max(error, weights[axis] * hidden[axis]) : error;
    }
    return error;
  }

  /// Points from the middle of a node to the viewer; has any length.
  Vec3<double> lineOfSight(const NodePlace& place) const
  {
    const Vec3<double> w = cross(column_.u, column_.v);
    if (!(column_.pupil > 0))
    {
      return w;
    }
    const Box box = tree_.maker_.boxOf(place);
    const auto toPupil = [&](const Vec3<double>& axis, double ofPupil)
    { return (ofPupil - productsWith(axis, box).middle) * axis; };
    return toPupil(column_.u, column_.middle[0]) + toPupil(column_.v, column_.middle[1]) +
      toPupil(w, column_.plane + column_.pupil);
  }

  bool isInParts(const NodePlace& place) const
  {
    const Box box = tree_.maker_.boxOf(place);
    return std::any_of(column_.parts.begin(), column_.parts.end(),
      [&](const Column::Part& part) { return isSeenIn(column_, part, box); });
  }

  const MediumTree& tree_;
  const Work& work_;
  const Column& column_;
};

} // namespace schlieren
