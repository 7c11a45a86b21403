// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// One node of the medium's tree: what is in it, and its samples.
#pragma once

#include "Medium/Samples/Interpolation.h"
#include "Medium/Samples/Leaves.h"
#include "Medium/Samples/MediumSource.h"
#include "Medium/Tree/LineErrors.h"
#include "Types.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace schlieren
{

/// Numbers a node of the tree, see Leaves.h.
struct NodePlace
{
  int level;                      ///< below 0: larger than the domain is wide
  std::array<std::int32_t, 3> at; ///< in nodes of that level
};

/// One of its eight children, counted x fastest.
inline NodePlace childOf(const NodePlace& place, std::int32_t child)
{
  return { place.level + 1,
    { 2 * place.at[0] + (child & 1), 2 * place.at[1] + (child >> 1 & 1),
      2 * place.at[2] + (child >> 2) } };
}

/// Which of its parent's children it is.
inline std::int32_t partOf(const NodePlace& place, BrickShape shape)
{
  const std::int32_t ofLayer = (place.at[0] & 1) | (place.at[1] & 1) << 1;
  return shape == BrickShape::Layer ? ofLayer : ofLayer | (place.at[2] & 1) << 2;
}

/// Says by how much a node is too coarse. All of nu or of a deflection, which have the same size.
struct BrickFacts
{
  /// Errors of rays through the node because samples are as far apart as they are; 0 along an axis on which the cells are
  /// no finer than the samples.
  LineErrors errors;
  /// Whether the cells are finer than the samples along an axis, so that the error can be less.
  std::array<bool, 3> canImprove{ false, false, false };
  std::array<bool, 3> canImproveAtEdges{ false, false, false }; ///< the same, where gas ends
  /// The same, because of what lies between samples that are further apart than cells along this axis.
  std::array<double, 3> hidden{ 0, 0, 0 };
  double range = 0;        ///< of its samples, as the deflection that it may make
  double difference = 0;   ///< largest one of nu in it
  double besideWindow = 0; ///< the same, where a window's edge is not known
  double ofWindow = 0;  ///< error of a deflection because a window's edge is not where it should be
  double neglected = 0; ///< the larger of both, where nothing was made of them
  bool hasWallEdge = false;  ///< gas, or a window, ends at a wall in it
  bool isTooLarge = false;   ///< for samples, of which it needs some
  double edgeError = 0;      ///< how far an edge is from where it should be; data units
  bool areWallsFlat = false; ///< see MediumSource::Content
  bool areEdgesFine = true;  ///< with voxels much finer than cells, edges show nothing new
  /// Lowest and highest components of the edges' normals, by voxel.
  std::array<std::array<float, 2>, 3> normals{};
  double largestNu = 0; ///< |nu| of its coefficients
  std::array<double, 3> slope{ 0, 0,
    0 };               ///< largest difference of neighbouring coefficients, a voxel
  double steepest = 0; ///< largest gradient, about; nu by data unit
  std::array<double, 3> steepestAt{ 0, 0, 0 }; ///< index coordinates
};

template <class Real>
struct Brick
{
  typename Leaf<Real>::Kind kind = Leaf<Real>::Constant;
  Real offset = 0;
  std::vector<Real> samples;              ///< empty: all are 0
  std::vector<std::int16_t> gasDistances; ///< of Leaf::Mixed, laid out like samples
  BrickFacts facts;

  /// Writes it for another rank of the same program on the same kind of processor.
  std::vector<char> toBytes() const;
  /// Throws Error where they are not those of a brick with so many samples.
  static Brick fromBytes(const std::vector<char>& bytes, std::size_t samplesPerBrick);
};

struct BrickSamples;

/// A brick that is to be made.
struct BrickRequest
{
  NodePlace place;
  double negligible; ///< what needs no samples, as a deflection
  /// Whether it is to be divided, and its children again, where it has walls that are not flat and finer than its
  /// voxels. Then it needs no samples.
  bool dividesAtWalls = false;
  bool isChild =
    false; ///< one of those of a node that is divided, which are requested one after the other
};

/// What bricks depend on besides their source.
struct BrickRules
{
  Grid grid; ///< the tree's
  double ambient;
  double largestNu; ///< what is far below it is set to 0
  Interpolation interpolation;
  std::uint32_t bytesOfReal = 0; ///< where ranks divide the work
};

/// Makes bricks of a source, each without knowledge of any other.
template <class Real>
class BrickMaker
{
public:
  static constexpr int edge = 16; ///< samples

  BrickMaker(const MediumSource& source, const BrickRules& rules);

  std::vector<Brick<Real>> make(const std::vector<BrickRequest>& requests) const;

  /// Where the source has makers, the bricks that they make; otherwise none.
  std::vector<Brick<Real>> makeTogether(const std::vector<BrickRequest>& requests) const;
  /// Makes the bricks of rank `process`, of `processes` that have the source's data together and do it at the same time,
  /// each as Brick::toBytes(). Those that another rank makes are empty.
  std::vector<std::vector<char>> makeShare(const std::vector<BrickRequest>& requests,
    std::size_t process, std::size_t processes, int threads) const;

  int apron() const { return apron_; }
  BrickShape shape() const { return shape_; }
  /// The axes along which there is more than one sample.
  std::size_t axes() const { return shape_ == BrickShape::Layer ? 2 : 3; }
  std::int64_t samplesPerBrick() const;
  Box boxOf(const NodePlace& place) const;        ///< without apron; data units
  std::array<double, 3> voxelOf(int level) const; ///< of one layer: as deep as the domain

private:
  struct Outline;
  struct Sampled;
  struct Values;

  Box boxWithApron(const NodePlace& place) const;
  Outline outlineOf(const BrickRequest& request) const;
  bool areEdgesFine(int level, const MediumSource::Content& content) const;
  int marginOf(bool hasEdges) const;
  int sampledMarginOf(bool hasEdges) const;
  Lattice latticeOf(
    const NodePlace& first, const std::array<std::int32_t, 3>& nodes, bool hasEdges) const;
  Lattice latticeOf(const Sampled& sampled) const;
  std::vector<Sampled> sampledOf(
    const std::vector<BrickRequest>& requests, const std::vector<Outline>& outlines) const;
  Values valuesAt(const Sampled& sampled) const;
  BrickSamples samplesOf(const Values& values, const Sampled& sampled, const NodePlace& place,
    const Outline& outline, int margin) const;
  void makeSampled(const Sampled& sampled, const std::vector<BrickRequest>& requests,
    std::vector<Outline>& outlines) const;
  void makeOf(const BrickRequest& request, Outline& outline,
    const std::function<BrickSamples(int margin)>& samplesWith) const;
  bool findEdges(const NodePlace& place, const MediumSource::Content& content,
    BrickSamples& samples, Brick<Real>& brick) const;
  void storeGasDistances(const BrickSamples& samples, Brick<Real>& brick) const;
  void findErrors(const NodePlace& place, const MediumSource::Content& content,
    const BrickSamples& samples, bool hasEdge, BrickFacts& facts) const;
  void storeCoefficients(const BrickSamples& samples, Brick<Real>& brick) const;
  void findBounds(const NodePlace& place, Brick<Real>& brick) const;
  double nuOf(double refractivity) const
  {
    return (refractivity - rules_.ambient) / (1 + rules_.ambient);
  }
  /// Counts the points along z, where there are so many along the other axes.
  int layersOf(int points) const { return shape_ == BrickShape::Layer ? 1 : points; }

  const MediumSource& source_;
  BrickRules rules_;
  Box bounds_;
  double smallest_;  ///< |nu| of a coefficient that is not 0
  double overshoot_; ///< of a coefficient beyond the samples beside it, that is none: nu
  BrickShape shape_;
  int apron_;
};

/// Value and gradient, by local coordinates, of a brick whose first stored sample is at `samples`. The place is
/// taken to the nearest one in the leaf.
template <class Scheme, class Real>
Sample<Real> interpolateBrick(
  const Real* samples, int apron, BrickShape shape, const Vec3<Real>& place)
{
  const MediumView<Real> view = viewOfBricks(samples, BrickMaker<Real>::edge, apron, shape);
  return interpolate<Scheme>(view, clampTo(place, view.leafLow, view.leafHigh));
}

} // namespace schlieren
