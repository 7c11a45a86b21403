// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/MediumTree.h"

#include "Device/Parallel.h"
#include "Medium/BrickErrors.h"
#include "Medium/Medium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

namespace schlieren
{

namespace
{

/// Root cells along the longest axis. More where the data are that much longer than wide.
constexpr double fewestRoots = 4;
constexpr double mostRoots = 16;

/// 16 root cells of 16 samples, halved so often, count within 32 bits.
constexpr int finestLevelOfAll = 20;

/// Layers between samples that are no further apart than this do not matter.
constexpr double pixelsOfLayer = 4;

/// A column is refined this much wider than it is, so that small turns need nothing new.
constexpr double widening = 1.1;

/// As many levels as most media have; for the progress that is reported.
constexpr int usualLevels = 10;

/// Of the memory, for what turns out to be worse than what was divided before.
constexpr std::size_t partsOfReserve = 16;

/// Bricks that are made before they are put into the tree.
constexpr std::size_t bricksAtOnce = 512;

/// Leaves whose steepest places rays are sent through.
constexpr std::size_t steepestLeaves = 192;

std::array<std::int32_t, 3> rootCellsOf(const Box& box, const std::array<double, 3>& voxelShape)
{
  std::array<double, 3> length{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double edge = box.high[axis] - box.low[axis];
    if (!(edge > 0) || !std::isfinite(edge))
    {
      throw Error("The data have no extent along their " + std::string(1, "xyz"[axis]) +
        " axis, or none that is finite, so there is no depth for light to cross and no gradient to "
        "bend it. Check the points' coordinates (for 2-D data: extrude it).");
    }
    length[axis] =
      voxelShape[axis] > 0 && std::isfinite(voxelShape[axis]) ? edge / voxelShape[axis] : edge;
  }
  const double longest = *std::max_element(length.begin(), length.end());
  const double shortest = *std::min_element(length.begin(), length.end());
  const double most = std::clamp(std::round(longest / shortest), fewestRoots, mostRoots);
  std::array<std::int32_t, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cells[axis] = std::max<std::int32_t>(
      1, static_cast<std::int32_t>(std::lround(most * length[axis] / longest)));
  }
  return cells;
}

Grid gridOf(const Box& box, const std::array<std::int32_t, 3>& rootCells, std::int64_t brickEdge)
{
  Grid grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid.dimensions[axis] = brickEdge * rootCells[axis] + 1;
    grid.spacing[axis] =
      (box.high[axis] - box.low[axis]) / static_cast<double>(brickEdge * rootCells[axis]);
    grid.origin[axis] = box.low[axis];
  }
  validate(grid);
  return grid;
}

MediumSource::Content contentOfAll(const MediumSource& source, double ambient)
{
  validateAmbient(ambient);
  const MediumSource::Content content = source.contentOf(source.bounds());
  if (!content.hasGas)
  {
    validateRange(1, 0);
  }
  validateRange(content.lowest, content.highest);
  return content;
}

double largestNuOf(const MediumSource::Content& content, double ambient)
{
  return std::max(std::abs(content.lowest - ambient), std::abs(content.highest - ambient)) /
    (1 + ambient);
}

NodePlace childOf(const NodePlace& place, std::int32_t child)
{
  return { place.level + 1,
    { 2 * place.at[0] + (child & 1), 2 * place.at[1] + (child >> 1 & 1),
      2 * place.at[2] + (child >> 2) } };
}

bool isSame(const Column& a, const Column& b)
{
  const auto isSameVector = [](const Vec3<double>& p, const Vec3<double>& q)
  { return p.x == q.x && p.y == q.y && p.z == q.z; };
  return isSameVector(a.u, b.u) && isSameVector(a.v, b.v) && a.finest == b.finest &&
    std::equal(a.middle, a.middle + 2, b.middle) &&
    std::equal(a.halfWidth, a.halfWidth + 2, b.halfWidth);
}

} // namespace

/// A column, and what it asks of nodes.
template <class Real>
class MediumTree<Real>::View
{
public:
  explicit View(const MediumTree& tree)
    : tree_(tree)
    , work_(tree.work_)
    , column_(tree.work_.column)
  {
  }

  bool sees(const NodePlace& place) const
  {
    const Box box = tree_.maker_.boxOf(place);
    return sees(column_.u, 0, box) && sees(column_.v, 1, box);
  }

  /// Whether voxels of the next level are wanted along an axis.
  bool allows(int level, std::size_t axis) const
  {
    constexpr double rounding = 1 - 1e-9;
    return level < finestLevelOfAll &&
      tree_.maker_.voxelOf(level + 1)[axis] >= rounding * column_.finest;
  }
  bool allows(int level) const { return allows(level, 0) || allows(level, 1) || allows(level, 2); }

  /// The error of a node, or of its fields, that the next level would lessen, without edges.
  template <class Facts>
  double errorOf(int level, const Facts& facts) const
  {
    const double u[3] = { column_.u.x, column_.u.y, column_.u.z };
    const double v[3] = { column_.v.x, column_.v.y, column_.v.z };
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(level);
    double error = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // Between samples there may be a layer, of which few pixels are to be seen. Light that crosses it is bent no more
      // than by a layer as thick as a voxel.
      const bool isBent = std::is_same_v<Facts, BrickFacts>;
      const double across = isBent ? std::max(std::hypot(u[axis], v[axis]), 1. / brickEdge) : 1;
      const bool isSeen = voxel[axis] > pixelsOfLayer * column_.finest;
      error = isSeen ? std::max(error, across * facts.hidden[axis]) : error;
      error = allows(level, axis) ? std::max(error, facts.error[axis]) : error;
    }
    return error;
  }

  /// How badly a leaf needs to be divided; 0: not at all.
  double urgencyOf(const Node& node, const FieldFacts& ofFields) const
  {
    const double error = errorOf(node.place.level, node.facts);
    const bool hasWindow = node.facts.besideWindow > negligible().deflection;
    const bool hasEdge = hasWindow || (node.facts.hasWallEdge && !showsWalls(node));
    double urgency = error > negligible().deflection ? error : 0;
    if (const double gathered = errorOf(node.place.level, ofFields);
        gathered > negligible().gathered)
    {
      const double deflection = work_.largest;
      const bool canCompare = deflection > 0 && work_.gathered > 0;
      urgency = std::max(urgency, canCompare ? gathered * (deflection / work_.gathered) : gathered);
    }
    if (hasEdge && !node.facts.areEdgesFine && allows(node.place.level))
    {
      // A shadow's edge that is wrong by a voxel is as wrong as can be.
      urgency = std::max({ urgency, work_.largest, std::numeric_limits<double>::min() });
    }
    return urgency;
  }

  /// Whether walls are where they should be, as far as pixels show. Voxels must not be much larger than pixels for
  /// that to be known.
  bool showsWalls(const Node& node) const
  {
    constexpr double pixels = 0.1, pixelsOfVoxel = 4; // at most
    const std::array<double, 3> voxel = tree_.maker_.voxelOf(node.place.level);
    return node.facts.edgeError <= pixels * column_.finest &&
      *std::max_element(voxel.begin(), voxel.end()) <= pixelsOfVoxel * column_.finest;
  }

  Negligible negligible() const
  {
    const double tolerance = tree_.settings_.tolerance;
    return { tolerance * work_.largest, tolerance * work_.gathered };
  }

  /// What is negligible to a leaf; nothing is where too much has been neglected along rays.
  Negligible negligibleTo(const Node& node, const NodeFields& fields) const
  {
    const Negligible usual = negligible();
    return { node.isCoarse ? 0 : usual.deflection, fields.isCoarse ? 0 : usual.gathered };
  }

  /// Whether a leaf lacks something that is not negligible.
  bool lacks(const Node& node, const NodeFields& fields) const
  {
    return node.isCoarse || fields.isCoarse || node.facts.neglected > negligible().deflection ||
      fields.facts.neglected > negligible().gathered;
  }

  /// How far refining has come, when so much of this round is done. Each level takes some four times as long as
  /// the one before; there may be less of them than the view allows, and rounds that refine no level.
  double progressAt(double ofRound) const
  {
    int levels = 1;
    while (levels < usualLevels && allows(levels))
    {
      ++levels;
    }
    return std::pow(4, -std::max(0., levels - (work_.rounds - 1) - ofRound));
  }

private:
  bool sees(const Vec3<double>& direction, int side, const Box& box) const
  {
    const double a[3] = { direction.x, direction.y, direction.z };
    double middle = 0, half = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle += a[axis] * 0.5 * (box.low[axis] + box.high[axis]);
      half += std::abs(a[axis]) * 0.5 * (box.high[axis] - box.low[axis]);
    }
    return !(std::abs(middle - column_.middle[side]) > widening * column_.halfWidth[side] + half);
  }

  const MediumTree& tree_;
  const Work& work_;
  const Column& column_;
};

template <class Real>
MediumTree<Real>::MediumTree(
  std::shared_ptr<const MediumSource> source, double ambient, const TreeSettings& settings)
  : source_(std::move(source))
  , settings_(settings)
  , grid_(
      gridOf(source_->bounds(), rootCellsOf(source_->bounds(), source_->voxelShape()), brickEdge))
  , rootCells_(rootCellsOf(source_->bounds(), source_->voxelShape()))
  , maker_(*source_, grid_, ambient, largestNuOf(contentOfAll(*source_, ambient), ambient),
      settings.interpolation)
  , samples_({ static_cast<std::size_t>(maker_.samplesPerBrick()), 1,
      PaddedVolume<Real>::readTogether, settings.memory })
  , maps_({ static_cast<std::size_t>(maker_.samplesPerBrick()) })
  , gradients_(
      { static_cast<std::size_t>(maker_.samplesPerBrick() * std::max(1, source_->fields())),
        source_->fields() > 0 ? std::size_t{ 1 } : 0 })
{
  static_assert(brickEdge == BrickMaker<Real>::edge);
  const MediumSource::Content content = contentOfAll(*source_, ambient);
  largestN_ = std::max(std::abs(content.lowest), std::abs(content.highest));
  rangeOfNu_ = (content.highest - content.lowest) / (1 + ambient);
  makeRoots();
  arrange();
}

template <class Real>
void MediumTree<Real>::makeRoots()
{
  nodes_.clear();
  nodeFields_.clear();
  for (std::int32_t k = 0; k < rootCells_[2]; ++k)
  {
    for (std::int32_t j = 0; j < rootCells_[1]; ++j)
    {
      for (std::int32_t i = 0; i < rootCells_[0]; ++i)
      {
        addNode({ 0, { i, j, k } });
      }
    }
  }
  samples_.clear();
  maps_.clear();
  gradients_.clear();
  isMeasured_ = false;
}

template <class Real>
void MediumTree<Real>::addNode(const NodePlace& place)
{
  nodes_.push_back({ place });
  nodeFields_.resize(source_->fields() > 0 ? nodes_.size() : 0);
}

template <class Real>
typename MediumTree<Real>::NodeFields MediumTree<Real>::fieldsOf(std::int32_t node) const
{
  return nodeFields_.empty() ? NodeFields{} : nodeFields_[static_cast<std::size_t>(node)];
}

Grid coarsestGrid(const MediumSource& source)
{
  const Box bounds = source.bounds();
  return gridOf(bounds, rootCellsOf(bounds, source.voxelShape()), MediumTree<float>::brickEdge);
}

template <class Real>
LeafFinder MediumTree<Real>::finder() const
{
  constexpr double perIndex = 1. / brickEdge;
  return { roots_.data(), children_.data(), { rootCells_[0], rootCells_[1], rootCells_[2] },
    { perIndex, perIndex, perIndex } };
}

template <class Real>
FieldGradientsView MediumTree<Real>::gradients() const
{
  const std::int64_t row = brickEdge + 2 * apron();
  const std::int64_t plane = row * row;
  const int fields = source_->fields();
  const std::int64_t first = fields * apron() * (plane + row + 1);
  return { fields > 0 ? gradients_.values().data() + first : nullptr, fields, row, plane,
    { brickEdge - 1, brickEdge - 1, brickEdge - 1 }, gradientBricks_.data(), samplesPerBrick() };
}

template <class Real>
bool MediumTree<Real>::refine(const Column& column, const Monitor& monitor)
{
  if (work_.isFinished || !isSame(work_.column, column))
  {
    work_ = {};
    work_.column = column;
    work_.isFinished = false;
  }
  const View view(*this);
  bool hasChanged = false;
  bool goesOn = true;
  while (goesOn)
  {
    if (work_.tasksDone == work_.tasks.size())
    {
      numberLeaves();
      const RayFindings found = measure(view, {});
      if (!isMeasured_ && (work_.largest > 0 || work_.gathered > 0))
      {
        forgetNegligible(view);
        isMeasured_ = true;
        numberLeaves();
        measure(view, found); // what is negligible leaf by leaf may not be so along a ray
      }
      hasChanged = plan(view) || hasChanged;
      work_.isFinished = work_.tasks.empty();
    }
    const std::size_t before = work_.tasksDone;
    goesOn = !work_.isFinished && doTasks(view, monitor);
    hasChanged = hasChanged || work_.tasksDone != before;
  }
  isArranged_ = isArranged_ && !hasChanged;
  if (!work_.isFinished)
  {
    numberLeaves();
  }
  else if (!isArranged_)
  {
    arrange();
    hasChanged = true;
  }
  summarize(view);
  return hasChanged;
}

/// Finds the largest deflection in the tree as it is and what rays gather, and leaves that are too coarse for it.
template <class Real>
RayFindings MediumTree<Real>::measure(const View& view, const RayFindings& least)
{
  std::vector<std::pair<double, std::int32_t>>
    steepest; // sorts by the deflection over a leaf, about
  for (const std::int32_t n : leafNodes_)
  {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    if (node.brick != 0 && view.sees(node.place))
    {
      steepest.push_back({ -std::ldexp(node.facts.steepest, -node.place.level), n });
    }
  }
  const std::size_t count = std::min(steepest.size(), steepestLeaves);
  std::partial_sort(
    steepest.begin(), steepest.begin() + static_cast<std::ptrdiff_t>(count), steepest.end());
  std::vector<Vec3<double>> places;
  for (std::size_t n = 0; n < count; ++n)
  {
    const auto& at = nodes_[static_cast<std::size_t>(steepest[n].second)].facts.steepestAt;
    places.push_back({ at[0], at[1], at[2] });
  }
  std::vector<float> differences(leafNodes_.size(), 0.f);
  std::vector<float> ofFields(nodeFields_.empty() ? 0 : leafNodes_.size(), 0.f);
  for (std::size_t leaf = 0; leaf < differences.size(); ++leaf)
  {
    const Node& node = nodes_[static_cast<std::size_t>(leafNodes_[leaf])];
    differences[leaf] = node.brick == 0 ? static_cast<float>(node.facts.difference) : 0.f;
    if (const NodeFields fields = fieldsOf(leafNodes_[leaf]);
        fields.brick == 0 && !ofFields.empty())
    {
      ofFields[leaf] = static_cast<float>(fields.facts.neglected / deflectionByRange);
    }
  }
  const RayFindings findings = lookAlongRays<Real>(
    { grid_, finder(), leaves_.data(), differences.data(), samples().data(), gasDistances().data(),
      gradients(), ofFields.empty() ? nullptr : ofFields.data(), samplesPerBrick(), apron(),
      settings_.interpolation },
    work_.column, places, settings_.tolerance, least, settings_.threads);
  work_.largest = findings.deflection;
  work_.gathered = findings.gathered;
  const auto nodeOf = [this](std::int32_t leaf)
  { return static_cast<std::size_t>(leafNodes_[static_cast<std::size_t>(leaf)]); };
  for (const std::int32_t leaf : findings.coarse)
  {
    nodes_[nodeOf(leaf)].isCoarse = true;
  }
  for (const std::int32_t leaf : findings.coarseInFields)
  {
    nodeFields_[nodeOf(leaf)].isCoarse = true;
  }
  return findings;
}

/// What there is to do: leaves to be made, and leaves to be divided.
template <class Real>
std::vector<typename MediumTree<Real>::Task> MediumTree<Real>::tasksOf(const View& view) const
{
  std::vector<Task> tasks;
  for (const std::int32_t n : leafNodes_)
  {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    if (!view.sees(node.place))
    {
      continue;
    }
    const NodeFields fields = fieldsOf(n);
    if (!node.isKnown || view.lacks(node, fields))
    {
      tasks.push_back({ n, false, std::numeric_limits<double>::infinity() });
    }
    else if (const double urgency = view.urgencyOf(node, fields.facts); urgency > 0)
    {
      tasks.push_back({ n, true, urgency });
    }
  }
  return tasks;
}

/// Bytes that a task takes at most.
template <class Real>
std::size_t MediumTree<Real>::costOf(const Task& task) const
{
  const Node& node = nodes_[static_cast<std::size_t>(task.node)];
  const std::size_t ofOne = samples_.bytesOfBrick() +
    (node.map >= 0 || !node.isKnown ? maps_.bytesOfBrick() : 0) +
    (nodeFields_.empty() ? 0 : gradients_.bytesOfBrick() + sizeof(NodeFields));
  return task.divides ? 8 * (ofOne + sizeof(Node) + sizeof(Leaf<Real>)) : ofOne;
}

/// Finds the tasks of the next round: those that memory suffices for. Returns whether it has thrown something away
/// for them.
template <class Real>
bool MediumTree<Real>::plan(const View& view)
{
  bool hasThrownAway = false;
  for (;;)
  {
    work_.tasks = tasksOf(view);
    work_.tasksDone = 0;
    ++work_.rounds;
    const std::size_t used = bytesUsed();
    const std::size_t available = settings_.memory > used ? settings_.memory - used : 0;
    std::size_t cost = 0, costOfNew = 0;
    for (const Task& task : work_.tasks)
    {
      cost += costOf(task);
      costOfNew += task.divides ? 0 : costOf(task);
    }
    if (cost <= available)
    {
      return hasThrownAway;
    }
    if (!work_.hasForgotten)
    {
      work_.hasForgotten = true;
      hasThrownAway = forgetUnneeded(view) || hasThrownAway;
    }
    else if (costOfNew > available && !work_.hasBegunAnew)
    {
      work_.hasBegunAnew = true;
      hasThrownAway = true;
      makeRoots();
    }
    else
    {
      chooseWhatFits(available);
      return hasThrownAway;
    }
    numberLeaves();
  }
}

/// Where memory is short: the worst leaves first, and only half of what fits, as what comes of them may be worse
/// than the others. Of the reserve, which is left in the end, only what is.
template <class Real>
void MediumTree<Real>::chooseWhatFits(std::size_t available)
{
  std::vector<Task>& tasks = work_.tasks;
  const auto levelOf = [&](const Task& task)
  { return nodes_[static_cast<std::size_t>(task.node)].place.level; };
  std::stable_sort(tasks.begin(), tasks.end(),
    [&](const Task& a, const Task& b)
    { return a.urgency != b.urgency ? a.urgency > b.urgency : levelOf(a) < levelOf(b); });
  const std::size_t reserve = settings_.memory / partsOfReserve;
  std::size_t fitting = 0, cost = 0;
  for (bool fits = true; fits && fitting < tasks.size(); fitting += fits ? 1 : 0)
  {
    const Task& task = tasks[fitting];
    cost += costOf(task);
    if (!task.divides)
    {
      fits = cost <= available || levelOf(task) == 0; // there must be something
      continue;
    }
    const bool isWorse = task.urgency > 2 * work_.leastUrgent;
    const std::size_t left = isWorse ? available : available - std::min(available, reserve);
    fits = cost <= (fitting == 0 ? left : left / 2);
    work_.leastUrgent = fits ? std::min(work_.leastUrgent, task.urgency) : work_.leastUrgent;
  }
  tasks.resize(fitting);
}

/// The bricks that the next tasks are about.
template <class Real>
void MediumTree<Real>::findBricks(const View& view)
{
  work_.bricks.clear();
  work_.bricksDone = 0;
  work_.tasksBegun = work_.tasksDone;
  while (work_.tasksBegun < work_.tasks.size() && work_.bricks.size() < bricksAtOnce)
  {
    const Task& task = work_.tasks[work_.tasksBegun++];
    const Node& node = nodes_[static_cast<std::size_t>(task.node)];
    const NodePlace& place = node.place;
    const Negligible negligible = view.negligibleTo(node, fieldsOf(task.node));
    for (std::int32_t child = 0; child < (task.divides ? 8 : 1); ++child)
    {
      const NodePlace ofOne = task.divides ? childOf(place, child) : place;
      if (!task.divides || view.sees(ofOne))
      {
        work_.bricks.push_back({ ofOne, negligible, {} });
      }
    }
  }
}

/// Puts bricks that are made into the tree.
template <class Real>
void MediumTree<Real>::keepBricks(const View& view)
{
  auto next = work_.bricks.begin();
  for (; work_.tasksDone < work_.tasksBegun; ++work_.tasksDone)
  {
    const Task& task = work_.tasks[work_.tasksDone];
    forget(task.node);
    if (!task.divides)
    {
      keep(task.node, (next++)->brick);
      continue;
    }
    const auto firstChild = static_cast<std::int32_t>(nodes_.size());
    const auto at = static_cast<std::size_t>(task.node);
    nodes_[at].children = firstChild;
    const NodePlace place = nodes_[at].place;
    for (std::int32_t child = 0; child < 8; ++child)
    {
      addNode(childOf(place, child));
      if (view.sees(nodes_.back().place))
      {
        keep(firstChild + child, (next++)->brick);
      }
    }
  }
  work_.bricks.clear();
}

/// Works off the tasks of this round. Returns false where the monitor says stop.
template <class Real>
bool MediumTree<Real>::doTasks(const View& view, const Monitor& monitor)
{
  while (work_.tasksDone < work_.tasks.size())
  {
    if (work_.bricks.empty())
    {
      findBricks(view);
    }
    const auto count = static_cast<std::int64_t>(work_.bricks.size());
    Monitor ofThese{ {}, monitor.aborted, monitor.paused };
    if (monitor.progress)
    {
      ofThese.progress = [&](double fraction)
      {
        const double done = static_cast<double>(work_.tasksDone) +
          fraction * static_cast<double>(work_.tasksBegun - work_.tasksDone);
        work_.progress =
          std::max(work_.progress, view.progressAt(done / static_cast<double>(work_.tasks.size())));
        monitor.progress(work_.progress);
      };
    }
    work_.bricksDone = parallelFrom(
      work_.bricksDone, count, 1, settings_.threads,
      [&](std::int64_t first, std::int64_t last)
      {
        for (std::int64_t n = first; n < last; ++n)
        {
          auto& next = work_.bricks[static_cast<std::size_t>(n)];
          next.brick = maker_.make(next.place, next.negligible);
        }
      },
      ofThese);
    if (work_.bricksDone < count)
    {
      return false;
    }
    keepBricks(view);
    if ((monitor.aborted && monitor.aborted()) || (monitor.paused && monitor.paused()))
    {
      return false;
    }
  }
  return true;
}

template <class Real>
void MediumTree<Real>::keep(std::int32_t at, const Brick<Real>& brick)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  node.isKnown = true;
  node.kind = brick.kind;
  node.offset = brick.offset;
  node.facts = brick.facts;
  node.brick = brick.samples.empty() ? 0 : samples_.add(brick.samples);
  node.map = brick.gasDistances.empty() ? -1 : maps_.add(brick.gasDistances);
  if (!nodeFields_.empty())
  {
    const std::vector<float>& gradients = brick.fields.gradients;
    nodeFields_[static_cast<std::size_t>(at)] = { gradients.empty() ? 0 : gradients_.add(gradients),
      false, brick.fields.facts };
  }
}

/// Takes a node's samples from it.
template <class Real>
void MediumTree<Real>::forget(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  if (node.brick > 0)
  {
    samples_.remove(node.brick);
  }
  if (node.map >= 0)
  {
    maps_.remove(node.map);
  }
  if (const std::int32_t brick = fieldsOf(at).brick; brick > 0)
  {
    gradients_.remove(brick);
  }
  if (!nodeFields_.empty())
  {
    nodeFields_[static_cast<std::size_t>(at)] = {};
  }
  const NodePlace place = node.place;
  const std::int32_t children = node.children;
  node = { place, children };
}

/// Nothing is negligible to those nodes that are made first: what is, now that more is known, goes.
template <class Real>
void MediumTree<Real>::forgetNegligible(const View& view)
{
  for (const std::int32_t at : leafNodes_)
  {
    Node& node = nodes_[static_cast<std::size_t>(at)];
    BrickFacts& facts = node.facts;
    const Negligible negligible = view.negligible();
    if (NodeFields fields = fieldsOf(at);
        fields.brick > 0 && fields.facts.range <= negligible.gathered)
    {
      fields.facts.neglected = std::max(fields.facts.neglected, fields.facts.range);
      gradients_.remove(fields.brick);
      fields.brick = 0;
      nodeFields_[static_cast<std::size_t>(at)] = fields;
    }
    if (node.map >= 0 && !facts.hasWallEdge && facts.besideWindow <= negligible.deflection &&
      fieldsOf(at).brick == 0)
    {
      facts.neglected = std::max(facts.neglected, facts.besideWindow);
      maps_.remove(node.map);
      node.map = -1;
      node.kind = Leaf<Real>::Samples;
    }
    if (node.brick > 0 && node.kind == Leaf<Real>::Samples && facts.range <= negligible.deflection)
    {
      facts.neglected = std::max(facts.neglected, facts.range);
      samples_.remove(node.brick);
      node.brick = 0;
      node.kind = Leaf<Real>::Constant;
    }
  }
}

template <class Real>
void MediumTree<Real>::forgetBelow(std::int32_t at)
{
  std::int32_t& children = nodes_[static_cast<std::size_t>(at)].children;
  for (std::int32_t child = 0; children >= 0 && child < 8; ++child)
  {
    forgetBelow(children + child);
  }
  forget(at);
  children = -1;
}

/// Makes unknown what is outside of the view or finer than it asks for.
template <class Real>
bool MediumTree<Real>::forgetUnneeded(const View& view)
{
  bool hasChanged = false;
  for (std::int32_t root = 0; root < rootCells_[0] * rootCells_[1] * rootCells_[2]; ++root)
  {
    hasChanged = forgetUnneeded(root, view) || hasChanged;
  }
  return hasChanged;
}

template <class Real>
bool MediumTree<Real>::forgetUnneeded(std::int32_t at, const View& view)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  const bool isInner = node.children >= 0;
  if (!view.sees(node.place) || (isInner && !view.allows(node.place.level)))
  {
    const bool hasAny = isInner || node.isKnown;
    forgetBelow(at);
    return hasAny;
  }
  bool hasChanged = false;
  for (std::int32_t child = 0; isInner && child < 8; ++child)
  {
    hasChanged = forgetUnneeded(node.children + child, view) || hasChanged;
  }
  return hasChanged;
}

template <class Real>
std::size_t MediumTree<Real>::bytesUsed() const
{
  return samples_.bytesUsed() + maps_.bytesUsed() + gradients_.bytesUsed() +
    nodes_.size() * sizeof(Node) + nodeFields_.size() * sizeof(NodeFields) +
    leaves_.size() * (sizeof(Leaf<Real>) + 2 * sizeof(std::int32_t));
}

/// Leaves, roots and children as rays see them, depth first: neighbours in space are near each other.
template <class Real>
void MediumTree<Real>::numberLeaves()
{
  leaves_.clear();
  leafNodes_.clear();
  gradientBricks_.clear();
  children_.clear();
  roots_.resize(static_cast<std::size_t>(rootCells_[0]) *
    static_cast<std::size_t>(rootCells_[1] * rootCells_[2]));
  for (std::size_t root = 0; root < roots_.size(); ++root)
  {
    number(static_cast<std::int32_t>(root), roots_[root]);
  }
}

template <class Real>
void MediumTree<Real>::number(std::int32_t at, std::int32_t& code)
{
  const Node& node = nodes_[static_cast<std::size_t>(at)];
  if (node.children < 0)
  {
    code = ~static_cast<std::int32_t>(leaves_.size());
    Leaf<Real> leaf{ {}, std::ldexp(1., node.place.level), node.offset, node.brick, node.map,
      node.kind };
    if (!nodeFields_.empty())
    {
      const std::int32_t gradients = fieldsOf(at).brick;
      gradientBricks_.push_back(gradients);
      // In one step nothing would be gathered.
      leaf.kind =
        leaf.kind == Leaf<Real>::Constant && gradients > 0 ? Leaf<Real>::Samples : leaf.kind;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      leaf.first[axis] =
        std::ldexp(brickEdge * static_cast<double>(node.place.at[axis]) + 0.5, -node.place.level);
    }
    leaves_.push_back(leaf);
    leafNodes_.push_back(at);
    return;
  }
  const std::size_t first = children_.size();
  code = static_cast<std::int32_t>(first / 8);
  children_.resize(first + 8);
  for (std::int32_t child = 0; child < 8; ++child)
  {
    std::int32_t ofChild = 0;
    number(node.children + child, ofChild);
    children_[first + static_cast<std::size_t>(child)] = ofChild;
  }
}

/// Nodes and bricks in the order of leaves, without gaps.
template <class Real>
void MediumTree<Real>::arrange()
{
  const auto roots = std::ptrdiff_t{ rootCells_[0] } * rootCells_[1] * rootCells_[2];
  const bool hasFields = !nodeFields_.empty();
  std::vector<Node> arranged(nodes_.begin(), nodes_.begin() + roots);
  std::vector<NodeFields> fields(
    nodeFields_.begin(), nodeFields_.begin() + (hasFields ? roots : 0));
  for (std::size_t n = 0; n < arranged.size(); ++n)
  {
    if (const std::int32_t children = arranged[n].children; children >= 0)
    {
      arranged[n].children = static_cast<std::int32_t>(arranged.size());
      for (std::int32_t child = 0; child < 8; ++child)
      {
        arranged.push_back(nodes_[static_cast<std::size_t>(children + child)]);
        if (hasFields)
        {
          fields.push_back(nodeFields_[static_cast<std::size_t>(children + child)]);
        }
      }
    }
  }
  nodes_ = std::move(arranged);
  nodeFields_ = std::move(fields);
  numberLeaves();

  std::vector<std::int32_t> bricks{ 0 };
  std::vector<std::int32_t> maps;
  std::vector<std::int32_t> gradients(hasFields ? 1 : 0, 0);
  for (const std::int32_t at : leafNodes_)
  {
    Node& node = nodes_[static_cast<std::size_t>(at)];
    if (node.brick > 0)
    {
      bricks.push_back(node.brick);
      node.brick = static_cast<std::int32_t>(bricks.size()) - 1;
    }
    if (node.map >= 0)
    {
      maps.push_back(node.map);
      node.map = static_cast<std::int32_t>(maps.size()) - 1;
    }
    if (const std::int32_t brick = fieldsOf(at).brick; brick > 0)
    {
      gradients.push_back(brick);
      nodeFields_[static_cast<std::size_t>(at)].brick =
        static_cast<std::int32_t>(gradients.size()) - 1;
    }
  }
  samples_.arrange(bricks);
  maps_.arrange(maps);
  gradients_.arrange(gradients);
  isArranged_ = true;
  numberLeaves();
}

template <class Real>
void MediumTree<Real>::summarize(const View& view)
{
  statistics_ = {};
  statistics_.coarsestLevel = finestLevelOfAll;
  largestNu_ = 0;
  slope_ = { 0, 0, 0 };
  statistics_.smallestVoxel = std::numeric_limits<double>::infinity();
  double error = 0, errorOfFields = 0;
  for (const std::int32_t at : leafNodes_)
  {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    const NodeFields fields = fieldsOf(at);
    const int level = node.place.level;
    const BrickFacts& facts = node.facts;
    largestNu_ = std::max(largestNu_, facts.largestNu);
    slope_.x = std::max(slope_.x, std::ldexp(facts.slope[0], level));
    slope_.y = std::max(slope_.y, std::ldexp(facts.slope[1], level));
    slope_.z = std::max(slope_.z, std::ldexp(facts.slope[2], level));
    if (node.brick > 0 || fields.brick > 0)
    {
      ++statistics_.bricks;
      statistics_.coarsestLevel = std::min(statistics_.coarsestLevel, level);
      statistics_.finestLevel = std::max(statistics_.finestLevel, level);
    }
    statistics_.constantLeaves += node.kind == Leaf<Real>::Constant && fields.brick == 0 ? 1 : 0;
    if (view.sees(node.place))
    {
      error = std::max(error, view.errorOf(level, node.facts));
      errorOfFields = std::max(errorOfFields, view.errorOf(level, fields.facts));
    }
  }
  statistics_.coarsestLevel = std::min(statistics_.coarsestLevel, statistics_.finestLevel);
  const std::array<double, 3> voxel = maker_.voxelOf(statistics_.finestLevel);
  statistics_.smallestVoxel = *std::min_element(voxel.begin(), voxel.end());
  statistics_.voxels = statistics_.bricks * brickEdge * brickEdge * brickEdge;
  statistics_.bytes = static_cast<std::int64_t>(bytesUsed());
  const double deflection = work_.largest, gathered = work_.gathered;
  statistics_.largestDeflection = deflection;
  statistics_.estimatedError =
    std::max(deflection > 0 ? error / deflection : 0, gathered > 0 ? errorOfFields / gathered : 0);
}

template class MediumTree<float>;
template class MediumTree<double>;

} // namespace schlieren
