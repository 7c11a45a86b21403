// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How a tree's tasks are worked off: the bricks of leaves that are made or divided.
#include "Medium/Tree/NodesInView.h"

#include "Device/Parallel.h"
#include "Medium/Tree/BrickChanges.h"
#include "Medium/Tree/BrickErrors.h"
#include "Medium/Tree/BrickMakers.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// Bricks that are made before they are put into the tree; of those that ranks make together, by each one.
constexpr std::size_t bricksAtOnce = 512;
constexpr std::size_t bricksOfMaker = 64;

} // namespace

/// The bricks that the next tasks are about.
template <class Real>
void MediumTree<Real>::findBricks(const View& view)
{
  work_.groupsDone = 0;
  work_.tasksBegun = work_.tasksDone;
  std::vector<BrickRequest> requests;
  work_.boxes.clear();
  work_.groups.clear();
  const BrickMakers* const makers = source_->makers();
  const std::size_t atOnce = makers
    ? std::min(bricksAtOnce, bricksOfMaker * static_cast<std::size_t>(makers->count()))
    : bricksAtOnce;
  while (work_.tasksBegun < work_.tasks.size() && requests.size() < atOnce)
  {
    const Task& task = work_.tasks[work_.tasksBegun++];
    const Node& node = nodes_[static_cast<std::size_t>(task.node)];
    const NodePlace& place = node.place;
    const double negligible = view.negligibleTo(node, task.divides);
    work_.groups.push_back(requests.size());
    for (std::int32_t child = 0; child < (task.divides ? childCount() : 1); ++child)
    {
      const NodePlace ofOne = task.divides ? childOf(place, child) : place;
      if (!task.divides || view.isInColumn(ofOne))
      {
        const bool dividesAtWalls = view.sees(ofOne) && view.dividesAtWalls(ofOne);
        requests.push_back({ ofOne, negligible, dividesAtWalls, task.divides });
        work_.boxes.push_back(task.divides ? task.node : -1);
      }
    }
  }
  work_.groups.push_back(requests.size());
  work_.bricks = maker_.makeTogether(requests);
  work_.areMade = !work_.bricks.empty();
  work_.bricks.resize(requests.size());
  work_.requests = std::move(requests);
}

/// The bricks of a task with what is wrong with them, also what comparison with their parent shows.
template <class Real>
void MediumTree<Real>::makeBricks(std::size_t group)
{
  const std::size_t first = work_.groups[group], end = work_.groups[group + 1];
  const auto at = [](auto& all, std::size_t n)
  { return all.begin() + static_cast<std::ptrdiff_t>(n); };
  if (!work_.areMade)
  {
    std::vector<Brick<Real>> made =
      maker_.make({ at(work_.requests, first), at(work_.requests, end) });
    std::move(made.begin(), made.end(), at(work_.bricks, first));
  }
  for (std::size_t n = first; n < end && apron() == 1; ++n)
  {
    const NodePlace& place = work_.requests[n].place;
    Brick<Real>& brick = work_.bricks[n];
    if (work_.boxes[n] >= 0)
    {
      const Node& box = nodes_[static_cast<std::size_t>(work_.boxes[n])];
      const Real* samples =
        samples_.values().data() + std::int64_t{ box.brick } * samplesPerBrick();
      addErrorsByChange(
        brick, partOf(place, shape()), samples, box.offset, shape(), maker_.voxelOf(place.level));
    }
    else if (place.level == 0)
    {
      brick.facts.errors.scale(errorByCells);
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
      keep(task.node, *next++);
      continue;
    }
    const auto firstChild = static_cast<std::int32_t>(nodes_.size());
    const auto at = static_cast<std::size_t>(task.node);
    nodes_[at].children = firstChild;
    const NodePlace place = nodes_[at].place;
    for (std::int32_t child = 0; child < childCount(); ++child)
    {
      addNode(childOf(place, child));
      if (view.isInColumn(nodes_.back().place))
      {
        keep(firstChild + child, *next++);
      }
    }
  }
  work_.requests.clear();
  work_.bricks.clear();
}

/// Works off the tasks of this round. Returns false where the monitor says stop.
template <class Real>
bool MediumTree<Real>::doTasks(const View& view, const Monitor& monitor)
{
  while (work_.tasksDone < work_.tasks.size())
  {
    if (work_.requests.empty())
    {
      findBricks(view);
    }
    const auto count = static_cast<std::int64_t>(work_.groups.size()) - 1;
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
    work_.groupsDone = parallelFrom(
      work_.groupsDone, count, 1, settings_.threads,
      [&](std::int64_t first, std::int64_t last)
      {
        for (std::int64_t n = first; n < last; ++n)
        {
          makeBricks(static_cast<std::size_t>(n));
        }
      },
      ofThese);
    if (work_.groupsDone < count)
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

template bool MediumTree<float>::doTasks(const View&, const Monitor&);
template bool MediumTree<double>::doTasks(const View&, const Monitor&);

} // namespace schlieren
