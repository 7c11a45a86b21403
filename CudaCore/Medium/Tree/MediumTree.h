// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/Leaves.h"
#include "Medium/Samples/MediumSource.h"
#include "Medium/Samples/SteepestPlace.h"
#include "Medium/Tree/Brick.h"
#include "Medium/Tree/BrickRays.h"
#include "Medium/Tree/BrickStore.h"
#include "Types.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace schlieren
{

/// How fine leaves are made.
struct TreeSettings
{
  /// Error of the deflection of a ray that is allowed, of a strong one: see RayFindings::strong. 0: as fine as the data are.
  double tolerance = 0.01;
  std::size_t memory = std::size_t{ 1 } << 30; ///< bytes that leaves may take
  Interpolation interpolation = Interpolation::Quadratic;
  int threads = 0;
};

/// What becomes of the leaves of other views, where memory is short.
enum class Unneeded
{
  Goes,
  Stays ///< for the views of others
};

/// The medium of a source: nu = (N - N_ref) / (1 + N_ref), as fine as data and views need. It does not depend
/// on the number of threads.
///
/// A leaf is refined where what finer voxels would change, as a deflection over the leaf, is more than the
/// tolerance of a strong deflection. That is found from the tree as it is, after each level, of straight rays on a lattice
/// over the view, and of those through the steepest places of the steepest leaves, that no wall stops: see
/// RayFindings::strong. At first it is smaller than it should be, if anything, because coarse voxels are smooth.
template <class Real>
class MediumTree
{
public:
  static constexpr int brickEdge = 16; ///< samples

  /// Throws Error where no gas is found or values are impossible, as buildMedium does.
  MediumTree(
    std::shared_ptr<const MediumSource> source, double ambient, const TreeSettings& settings);

  /// Makes the leaves that a view needs and that are not there; keeps the others while memory allows. Returns
  /// whether anything has changed. Where `monitor` says stop, what has been made stays, and the same call continues: to
  /// the last bit as if there had been no stop.
  bool refine(
    const Column& column, const Monitor& monitor = {}, Unneeded unneeded = Unneeded::Goes);
  /// Leaves are finer from the next call of refine() on.
  void lowerTolerance(double tolerance) { settings_.tolerance = tolerance; }
  /// Looks at parts of the image of the last view again, with a lower tolerance from now on.
  void refineFurther(double tolerance, std::vector<Column::Part> parts, const Monitor& monitor);
  /// Whether the last call has left leaves that the view needs because of Unneeded::Stays.
  bool lacksRoom() const { return lacksRoom_; }
  bool isUnfinished() const { return !work_.isFinished; } ///< the monitor has stopped the last call

  // What rays see. Grid::dimensions of the whole domain are those of its coarsest level.
  const Grid& grid() const { return grid_; }
  const std::vector<Leaf<Real>>& leaves() const { return leaves_; }
  const std::vector<std::int32_t>& roots() const { return roots_; }
  const std::vector<std::int32_t>& children() const { return children_; }
  LeafFinder finder() const;
  int apron() const { return maker_.apron(); } ///< samples around each brick
  BrickShape shape() const { return maker_.shape(); }
  /// All bricks, one after the other; brick 0 is 0 everywhere. It is that of leaves that are uniform, even of
  /// Leaf::Mixed ones. Where no view has looked, leaves are Leaf::Constant with 0.
  const std::vector<Real>& samples() const { return samples_.values(); }
  std::int64_t samplesPerBrick() const { return maker_.samplesPerBrick(); }
  /// One for each sample of the maps of Leaf::Mixed, laid out like the samples: the distance to where gas ends, in
  /// 1/8192 of a voxel, positive in gas; the lowest bit is what is outside: 0 a wall, 1 a window.
  const std::vector<std::int16_t>& gasDistances() const { return maps_.values(); }

  // What is known of it.
  double largestNu() const { return largestNu_; }
  double rangeOfNu() const { return rangeOfNu_; }
  double largestN() const { return largestN_; }
  /// Largest |d nu / d index| of all leaves, axis by axis.
  Vec3<double> slope() const { return slope_; }
  const SteepestPlace& steepest() const { return steepest_; } ///< brick by brick
  using Statistics = MediumStatistics;
  Statistics statistics() const { return statistics_; }

private:
  struct Node
  {
    NodePlace place;
    std::int32_t children = -1; ///< the first of childCount() nodes, x fastest; -1: a leaf
    bool isKnown = false;       ///< otherwise a leaf that no view has needed
    bool isCoarse = false;      ///< a leaf with one value for all that needs samples
    bool isWrong = false;       ///< its error is too large beside those of others along a ray
    typename Leaf<Real>::Kind kind = Leaf<Real>::Constant;
    Real offset = 0;
    std::int32_t brick = 0; ///< its number, as that of the map
    std::int32_t map = -1;
    BrickFacts facts{};
  };
  /// A node to be made or to be divided.
  struct Task
  {
    std::int32_t node;
    bool divides;
    double urgency;
  };
  /// What there is to do for a view, and how far that has come.
  struct Work
  {
    Column column{};
    bool isFinished = true;
    double largest = 0;  ///< deflection
    double strong = 0;   ///< deflection, see RayFindings
    double error = 0;    ///< along rays, see RayFindings
    int rounds = 0;      ///< begun
    double progress = 0; ///< reported
    double leastUrgent =
      std::numeric_limits<double>::infinity(); ///< of what was divided since memory is short
    bool isMemoryShort = false;
    std::vector<Task> tasks; ///< of this round
    std::size_t tasksDone = 0;
    std::size_t tasksBegun = 0;
    std::vector<BrickRequest> requests; ///< of the tasks that are begun
    std::vector<std::int32_t> boxes;    ///< likewise; the nodes that are divided, or -1
    std::vector<std::size_t> groups;    ///< where the requests of each task begin, and the end
    std::vector<Brick<Real>> bricks;    ///< likewise
    bool areMade = false;               ///< by others
    std::int64_t groupsDone = 0;
  };
  class View;

  /// Counts the children of a node that is divided.
  std::int32_t childCount() const { return shape() == BrickShape::Layer ? 4 : 8; }
  void makeBricks(std::size_t group);
  void makeRoots();
  void assumeDeflection(const View& view);
  RayFindings measure(const View& view, const RayFindings& least);
  bool plan(const View& view);
  std::vector<Task> tasksOf(const View& view) const;
  std::size_t costOf(const Task& task) const;
  void chooseWhatFits(std::size_t available);
  void findBricks(const View& view);
  void keepBricks(const View& view);
  bool doTasks(const View& view, const Monitor& monitor);
  void addNode(const NodePlace& place);
  void keep(std::int32_t node, const Brick<Real>& brick);
  BrickLayout layout() const;
  void removeSamples(std::int32_t node);
  void removeMap(std::int32_t node);
  void forget(std::int32_t node);
  void forgetNegligible(const View& view);
  std::size_t bytesUsed() const;

  void numberLeaves();
  void number(std::int32_t node, std::int32_t& code);
  Leaf<Real> leafOf(std::int32_t node) const;
  void arrange();
  void summarize();

  std::shared_ptr<const MediumSource> source_;
  TreeSettings settings_;
  Grid grid_;
  int coarserLevels_; ///< than 0, the first one with samples
  std::array<std::int32_t, 3> rootCells_;
  double rangeOfNu_ = 0;
  double largestN_ = 0;
  BrickMaker<Real> maker_;

  std::vector<Node> nodes_; ///< the roots first
  std::vector<Leaf<Real>> leaves_;
  std::vector<std::int32_t> leafNodes_; ///< of each leaf
  std::vector<std::int32_t> roots_;
  std::vector<std::int32_t> children_;
  BrickStore<Real> samples_;
  BrickStore<std::int16_t> maps_;
  Work work_;
  Unneeded unneeded_ = Unneeded::Goes; ///< as of the last call
  bool lacksRoom_ = false;
  bool hasRefined_ = false;  ///< for any view
  bool holdsOthers_ = false; ///< leaves that were made for other views
  bool isArranged_ = false;
  bool isMeasured_ = false; ///< false: leaves have been made without knowing what is negligible

  double largestNu_ = 0;
  Vec3<double> slope_{ 0, 0, 0 };
  SteepestPlace steepest_;
  Statistics statistics_{};
};

} // namespace schlieren
