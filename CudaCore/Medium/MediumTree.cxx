// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/MediumTree.h"

#include "Device/Parallel.h"
#include "Medium/Medium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
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

/// A column is refined this much wider than it is, so that small turns need nothing new.
constexpr double widening = 1.1;

/// As many levels as most media have; for the progress that is reported.
constexpr int usualLevels = 10;

/// Of the memory, for what turns out to be worse than what was divided before.
constexpr std::size_t partsOfReserve = 16;

/// Nodes between two looks at the monitor's answer, at most.
constexpr std::size_t nodesAtOnce = 64;

/// Leaves whose steepest places rays are sent through.
constexpr std::size_t steepestLeaves = 192;

/// Address space that is asked for at once; what is not used of it costs nothing.
constexpr std::size_t mostReserved = std::size_t{ 1 } << 30;

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

/// Puts what is in place order[n] into place n, for pieces of `size` values.
template <class Value>
void permute(std::vector<Value>& values, std::size_t size, const std::vector<std::int32_t>& order)
{
  const auto piece = [&](std::int32_t n)
  { return values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(n) * size); };
  std::vector<Value> first(size);
  std::vector<bool> isDone(order.size(), false);
  for (std::size_t n = 0; n < order.size(); ++n)
  {
    if (isDone[n] || order[n] == static_cast<std::int32_t>(n))
    {
      continue;
    }
    const auto start = static_cast<std::int32_t>(n);
    std::copy_n(piece(start), size, first.begin());
    std::int32_t to = start;
    while (order[static_cast<std::size_t>(to)] != start)
    {
      const std::int32_t from = order[static_cast<std::size_t>(to)];
      std::copy_n(piece(from), size, piece(to));
      isDone[static_cast<std::size_t>(to)] = true;
      to = from;
    }
    std::copy_n(first.begin(), size, piece(to));
    isDone[static_cast<std::size_t>(to)] = true;
  }
}

/// The places that are used, in this order, and then all others below `count`.
std::vector<std::int32_t> completed(std::vector<std::int32_t> used, std::size_t count)
{
  std::vector<bool> isUsed(count, false);
  for (const std::int32_t n : used)
  {
    isUsed[static_cast<std::size_t>(n)] = true;
  }
  for (std::size_t n = 0; n < count; ++n)
  {
    if (!isUsed[n])
    {
      used.push_back(static_cast<std::int32_t>(n));
    }
  }
  return used;
}

} // namespace

/// A column, and what it asks of nodes.
template <class Real>
class MediumTree<Real>::View
{
public:
  View(const MediumTree& tree, const Column& column)
    : tree_(tree)
    , column_(column)
  {
  }

  const Column& column() const { return column_; }

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

  /// The error that the next level would lessen, without edges.
  double errorOf(const Node& node) const
  {
    double error = allows(node.place.level) ? node.facts.hidden : 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      error = allows(node.place.level, axis) ? std::max(error, node.facts.error[axis]) : error;
    }
    return error;
  }

  /// How badly a leaf needs to be divided; 0: not at all.
  double urgencyOf(const Node& node) const
  {
    const double error = errorOf(node);
    const bool hasEdge = node.facts.hasWallEdge || node.facts.besideWindow > negligible();
    double urgency = error > negligible() ? error : 0;
    if (hasEdge && !node.facts.areEdgesFine && allows(node.place.level))
    {
      // A shadow's edge that is wrong by a voxel is as wrong as can be.
      urgency = std::max({ urgency, largest, std::numeric_limits<double>::min() });
    }
    return urgency;
  }

  double negligible() const { return tree_.settings_.tolerance * largest; }

  /// How far refining has come, when so much of this round is done. Each level takes some four times as long as
  /// the one before; there may be less of them than the view allows, and rounds that refine no level.
  double progressAt(double ofRound)
  {
    int levels = 1;
    while (levels < usualLevels && allows(levels))
    {
      ++levels;
    }
    const double left = std::max(0., levels - (rounds - 1) - ofRound);
    progress_ = std::max(progress_, std::pow(4, -left));
    return progress_;
  }

  double largest = 0; ///< deflection
  int rounds = 0;     ///< begun
  double leastUrgent =
    std::numeric_limits<double>::infinity(); ///< of what was divided since memory is short
  bool hasForgotten = false;
  bool hasBegunAnew = false;

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
  const Column& column_;
  double progress_ = 0;
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
  for (std::int32_t k = 0; k < rootCells_[2]; ++k)
  {
    for (std::int32_t j = 0; j < rootCells_[1]; ++j)
    {
      for (std::int32_t i = 0; i < rootCells_[0]; ++i)
      {
        nodes_.push_back({ { 0, { i, j, k } } });
      }
    }
  }
  samples_.assign(
    static_cast<std::size_t>(samplesPerBrick() + PaddedVolume<Real>::readTogether), 0);
  gasDistances_.clear();
  freeBricks_.clear();
  freeMaps_.clear();
  isMeasured_ = false;
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
bool MediumTree<Real>::refine(const Column& column, const Monitor& monitor)
{
  View view(*this, column);
  bool hasChanged = false;
  bool goesOn = true;
  while (goesOn)
  {
    numberLeaves();
    std::vector<std::pair<double, std::int32_t>> steepest;
    for (std::size_t n = 0; n < leaves_.size(); ++n)
    {
      const Node& node = nodes_[static_cast<std::size_t>(leafNodes_[n])];
      if (node.brick != 0 && view.sees(node.place))
      {
        steepest.push_back(
          { -std::ldexp(node.facts.steepest, -node.place.level), static_cast<std::int32_t>(n) });
      }
    }
    const std::size_t count = std::min(steepest.size(), steepestLeaves);
    std::partial_sort(
      steepest.begin(), steepest.begin() + static_cast<std::ptrdiff_t>(count), steepest.end());
    std::vector<Vec3<double>> places;
    for (std::size_t n = 0; n < count; ++n)
    {
      const std::array<double, 3>& at =
        nodes_[static_cast<std::size_t>(leafNodes_[static_cast<std::size_t>(steepest[n].second)])]
          .facts.steepestAt;
      places.push_back({ at[0], at[1], at[2] });
    }
    view.largest = largestDeflection<Real>(
      { grid_, finder(), leaves_.data(), samples_.data(), gasDistances_.data(), samplesPerBrick(),
        apron(), settings_.interpolation },
      column, places, settings_.threads);
    if (!isMeasured_ && view.largest > 0)
    {
      forgetNegligible(view);
      isMeasured_ = true;
    }
    hasChanged = refineOnce(view, monitor, goesOn) || hasChanged;
  }
  if (hasChanged)
  {
    arrange();
  }
  summarize(view);
  return hasChanged;
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
    if (!node.isKnown || node.facts.neglected > view.negligible())
    {
      tasks.push_back({ n, false, std::numeric_limits<double>::infinity() });
    }
    else if (const double urgency = view.urgencyOf(node); urgency > 0)
    {
      tasks.push_back({ n, true, urgency });
    }
  }
  return tasks;
}

/// One round: what there is to do, as far as memory allows and the monitor does not stop it.
template <class Real>
bool MediumTree<Real>::refineOnce(View& view, const Monitor& monitor, bool& goesOn)
{
  std::vector<Task> tasks = tasksOf(view);
  const auto costOf = [&](const Task& task) -> std::size_t
  {
    const Node& node = nodes_[static_cast<std::size_t>(task.node)];
    const std::size_t ofOne = bytesOfBrick() + (node.map >= 0 || !node.isKnown ? bytesOfMap() : 0);
    return task.divides ? 8 * (ofOne + sizeof(Node) + sizeof(Leaf<Real>)) : ofOne;
  };
  const std::size_t used = bytesUsed();
  const std::size_t available = settings_.memory > used ? settings_.memory - used : 0;
  std::size_t cost = 0, costOfNew = 0;
  for (const Task& task : tasks)
  {
    cost += costOf(task);
    costOfNew += task.divides ? 0 : costOf(task);
  }
  if (cost > available)
  {
    if (!view.hasForgotten)
    {
      view.hasForgotten = true;
      if (forgetUnneeded(view))
      {
        return true;
      }
    }
    if (costOfNew > available && !view.hasBegunAnew)
    {
      view.hasBegunAnew = true;
      makeRoots();
      return true;
    }
    std::stable_sort(tasks.begin(), tasks.end(),
      [&](const Task& a, const Task& b)
      {
        const int levelOfA = nodes_[static_cast<std::size_t>(a.node)].place.level;
        const int levelOfB = nodes_[static_cast<std::size_t>(b.node)].place.level;
        return a.urgency != b.urgency ? a.urgency > b.urgency : levelOfA < levelOfB;
      });
    // Only half of what fits: what comes of the worst leaves may be worse than the others. Where all that is left is
    // the reserve, only what is.
    const std::size_t reserve = settings_.memory / partsOfReserve;
    std::size_t fitting = 0;
    for (cost = 0; fitting < tasks.size(); ++fitting)
    {
      const Task& task = tasks[fitting];
      cost += costOf(task);
      if (!task.divides)
      {
        if (cost > available && nodes_[static_cast<std::size_t>(task.node)].place.level > 0)
        {
          break;
        }
        continue;
      }
      const bool isWorse = task.urgency > 2 * view.leastUrgent;
      const std::size_t left = isWorse ? available : available - std::min(available, reserve);
      if (cost > (fitting == 0 ? left : left / 2))
      {
        break;
      }
      view.leastUrgent = std::min(view.leastUrgent, task.urgency);
    }
    tasks.resize(fitting);
  }
  goesOn = !tasks.empty();
  ++view.rounds;
  bool hasChanged = false;
  for (std::size_t begin = 0; goesOn && begin < tasks.size(); begin += nodesAtOnce)
  {
    const std::size_t count = std::min(nodesAtOnce, tasks.size() - begin);
    std::vector<std::array<Brick<Real>, 8>> made(count);
    std::vector<std::array<bool, 8>> isMade(count);
    const auto childOf = [](const NodePlace& place, std::int32_t child) -> NodePlace
    {
      return { place.level + 1,
        { 2 * place.at[0] + (child & 1), 2 * place.at[1] + (child >> 1 & 1),
          2 * place.at[2] + (child >> 2) } };
    };
    const Monitor ofThese{ [&](double fraction)
      {
        if (monitor.progress)
        {
          const double done = static_cast<double>(begin) + fraction * static_cast<double>(count);
          monitor.progress(view.progressAt(done / static_cast<double>(tasks.size())));
        }
      },
      monitor.aborted, monitor.paused };
    const std::int64_t done = parallelFrom(
      0, static_cast<std::int64_t>(count), 1, settings_.threads,
      [&](std::int64_t first, std::int64_t last)
      {
        for (auto n = static_cast<std::size_t>(first); n < static_cast<std::size_t>(last); ++n)
        {
          const Task& task = tasks[begin + n];
          const NodePlace& place = nodes_[static_cast<std::size_t>(task.node)].place;
          for (std::int32_t child = 0; child < (task.divides ? 8 : 1); ++child)
          {
            const NodePlace ofOne = task.divides ? childOf(place, child) : place;
            const auto c = static_cast<std::size_t>(child);
            isMade[n][c] = !task.divides || view.sees(ofOne);
            if (isMade[n][c])
            {
              made[n][c] = maker_.make(ofOne, view.negligible());
            }
          }
        }
      },
      ofThese);
    for (std::size_t n = 0; n < static_cast<std::size_t>(done); ++n)
    {
      const Task& task = tasks[begin + n];
      const auto at = static_cast<std::size_t>(task.node);
      forget(nodes_[at]);
      if (!task.divides)
      {
        keep(nodes_[at], std::move(made[n][0]));
        continue;
      }
      nodes_[at].children = static_cast<std::int32_t>(nodes_.size());
      const NodePlace place = nodes_[at].place;
      for (std::int32_t child = 0; child < 8; ++child)
      {
        nodes_.push_back({ childOf(place, child) });
        if (isMade[n][static_cast<std::size_t>(child)])
        {
          keep(nodes_.back(), std::move(made[n][static_cast<std::size_t>(child)]));
        }
      }
    }
    hasChanged = hasChanged || done > 0;
    goesOn = done == static_cast<std::int64_t>(count) &&
      !((monitor.aborted && monitor.aborted()) || (monitor.paused && monitor.paused()));
  }
  return hasChanged;
}

template <class Real>
void MediumTree<Real>::keep(Node& node, Brick<Real>&& brick)
{
  node.isKnown = true;
  node.kind = brick.kind;
  node.offset = brick.offset;
  node.facts = brick.facts;
  node.brick = 0;
  node.map = -1;
  const auto ofBrick = static_cast<std::size_t>(samplesPerBrick());
  constexpr auto behind = static_cast<std::size_t>(PaddedVolume<Real>::readTogether);
  if (!brick.samples.empty())
  {
    if (freeBricks_.empty())
    {
      const std::size_t needed = samples_.size() + ofBrick;
      if (samples_.capacity() < needed)
      {
        const std::size_t wanted =
          std::max(std::min(settings_.memory, mostReserved) / sizeof(Real), 2 * samples_.size());
        try
        {
          samples_.reserve(std::max(needed, wanted));
          askForHugePages(samples_.data(), samples_.capacity() * sizeof(Real));
        }
        catch (const std::bad_alloc&)
        {
          // As resize() finds it.
        }
      }
      node.brick = static_cast<std::int32_t>((samples_.size() - behind) / ofBrick);
      samples_.resize(needed);
    }
    else
    {
      node.brick = freeBricks_.back();
      freeBricks_.pop_back();
    }
    std::copy(brick.samples.begin(), brick.samples.end(),
      samples_.begin() +
        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node.brick) * ofBrick));
  }
  if (!brick.gasDistances.empty())
  {
    if (freeMaps_.empty())
    {
      node.map = static_cast<std::int32_t>(gasDistances_.size() / ofBrick);
      gasDistances_.resize(gasDistances_.size() + ofBrick);
    }
    else
    {
      node.map = freeMaps_.back();
      freeMaps_.pop_back();
    }
    std::copy(brick.gasDistances.begin(), brick.gasDistances.end(),
      gasDistances_.begin() +
        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node.map) * ofBrick));
  }
}

/// Takes a node's samples from it.
template <class Real>
void MediumTree<Real>::forget(Node& node)
{
  if (node.brick > 0)
  {
    freeBricks_.push_back(node.brick);
  }
  if (node.map >= 0)
  {
    freeMaps_.push_back(node.map);
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
    if (node.map >= 0 && !facts.hasWallEdge && facts.besideWindow <= view.negligible())
    {
      facts.neglected = std::max(facts.neglected, facts.besideWindow);
      freeMaps_.push_back(node.map);
      node.map = -1;
      node.kind = Leaf<Real>::Samples;
    }
    if (node.brick > 0 && node.kind == Leaf<Real>::Samples && facts.range <= view.negligible())
    {
      facts.neglected = std::max(facts.neglected, facts.range);
      freeBricks_.push_back(node.brick);
      node.brick = 0;
      node.kind = Leaf<Real>::Constant;
    }
  }
}

template <class Real>
void MediumTree<Real>::forgetBelow(Node& node)
{
  if (node.children >= 0)
  {
    for (std::int32_t child = 0; child < 8; ++child)
    {
      forgetBelow(nodes_[static_cast<std::size_t>(node.children + child)]);
    }
  }
  forget(node);
  node.children = -1;
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
    forgetBelow(node);
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
  const std::size_t samples =
    samples_.size() - freeBricks_.size() * static_cast<std::size_t>(samplesPerBrick());
  const std::size_t distances =
    gasDistances_.size() - freeMaps_.size() * static_cast<std::size_t>(samplesPerBrick());
  return samples * sizeof(Real) + distances * sizeof(std::int16_t) + nodes_.size() * sizeof(Node) +
    leaves_.size() * (sizeof(Leaf<Real>) + 2 * sizeof(std::int32_t));
}

/// Leaves, roots and children as rays see them, depth first: neighbours in space are near each other.
template <class Real>
void MediumTree<Real>::numberLeaves()
{
  leaves_.clear();
  leafNodes_.clear();
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
  std::vector<Node> arranged(nodes_.begin(),
    nodes_.begin() + std::ptrdiff_t{ rootCells_[0] } * rootCells_[1] * rootCells_[2]);
  for (std::size_t n = 0; n < arranged.size(); ++n)
  {
    if (const std::int32_t children = arranged[n].children; children >= 0)
    {
      arranged[n].children = static_cast<std::int32_t>(arranged.size());
      for (std::int32_t child = 0; child < 8; ++child)
      {
        arranged.push_back(nodes_[static_cast<std::size_t>(children + child)]);
      }
    }
  }
  nodes_ = std::move(arranged);
  numberLeaves();

  std::vector<std::int32_t> bricks{ 0 };
  std::vector<std::int32_t> maps;
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
  }
  const auto ofBrick = static_cast<std::size_t>(samplesPerBrick());
  constexpr auto behind = static_cast<std::size_t>(PaddedVolume<Real>::readTogether);
  permute(samples_, ofBrick, completed(bricks, (samples_.size() - behind) / ofBrick));
  permute(gasDistances_, ofBrick, completed(maps, gasDistances_.size() / ofBrick));
  samples_.resize(bricks.size() * ofBrick);
  samples_.resize(bricks.size() * ofBrick + behind, Real(0));
  gasDistances_.resize(maps.size() * ofBrick);
  freeBricks_.clear();
  freeMaps_.clear();
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
  double error = 0;
  for (const std::int32_t at : leafNodes_)
  {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    const int level = node.place.level;
    const BrickFacts& facts = node.facts;
    largestNu_ = std::max(largestNu_, facts.largestNu);
    slope_.x = std::max(slope_.x, std::ldexp(facts.slope[0], level));
    slope_.y = std::max(slope_.y, std::ldexp(facts.slope[1], level));
    slope_.z = std::max(slope_.z, std::ldexp(facts.slope[2], level));
    if (node.brick > 0)
    {
      ++statistics_.bricks;
      statistics_.coarsestLevel = std::min(statistics_.coarsestLevel, level);
      statistics_.finestLevel = std::max(statistics_.finestLevel, level);
    }
    statistics_.constantLeaves += node.kind == Leaf<Real>::Constant ? 1 : 0;
    if (view.sees(node.place))
    {
      error = std::max(error, view.errorOf(node));
    }
  }
  statistics_.coarsestLevel = std::min(statistics_.coarsestLevel, statistics_.finestLevel);
  const std::array<double, 3> voxel = maker_.voxelOf(statistics_.finestLevel);
  statistics_.smallestVoxel = *std::min_element(voxel.begin(), voxel.end());
  statistics_.voxels = statistics_.bricks * brickEdge * brickEdge * brickEdge;
  statistics_.bytes = static_cast<std::int64_t>(bytesUsed());
  statistics_.largestDeflection = view.largest;
  statistics_.estimatedError = view.largest > 0 ? error / view.largest : 0;
}

template class MediumTree<float>;
template class MediumTree<double>;

} // namespace schlieren
