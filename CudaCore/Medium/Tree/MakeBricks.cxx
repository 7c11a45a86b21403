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
  work_.bricksDone = 0;
  work_.tasksBegun = work_.tasksDone;
  std::vector<BrickRequest> requests;
  work_.boxes.clear();
  const BrickMakers* const makers = source_->makers();
  const std::size_t atOnce = makers
    ? std::min(bricksAtOnce, bricksOfMaker * static_cast<std::size_t>(makers->count()))
    : bricksAtOnce;
  while (work_.tasksBegun < work_.tasks.size() && requests.size() < atOnce)
  {
    const Task& task = work_.tasks[work_.tasksBegun++];
    const Node& node = nodes_[static_cast<std::size_t>(task.node)];
    const NodePlace& place = node.place;
    const Negligible negligible = view.negligibleTo(node, fieldsOf(task.node), task.divides);
    for (std::int32_t child = 0; child < (task.divides ? childCount() : 1); ++child)
    {
      const NodePlace ofOne = task.divides ? childOf(place, child) : place;
      if (!task.divides || view.sees(ofOne))
      {
        requests.push_back({ ofOne, negligible, view.dividesAtWalls(ofOne) });
        work_.boxes.push_back(task.divides ? task.node : -1);
      }
    }
  }
  work_.bricks = maker_.makeTogether(requests);
  work_.areMade = !work_.bricks.empty();
  work_.bricks.resize(requests.size());
  work_.requests = std::move(requests);
}

/// A brick with what is wrong with it, also what comparison with its parent shows.
template <class Real>
void MediumTree<Real>::makeBrick(std::size_t request)
{
  const NodePlace& place = work_.requests[request].place;
  Brick<Real>& brick = work_.bricks[request];
  if (!work_.areMade)
  {
    brick = maker_.make(work_.requests[request]);
  }
  if (apron() != 1)
  {
    return;
  }
  if (work_.boxes[request] >= 0)
  {
    const Node& box = nodes_[static_cast<std::size_t>(work_.boxes[request])];
    const Real* samples = samples_.values().data() + std::int64_t{ box.brick } * samplesPerBrick();
    addErrorsByChange(
      brick, partOf(place, shape()), samples, box.offset, shape(), maker_.voxelOf(place.level));
  }
  else if (place.level == 0)
  {
    brick.facts.errors.scale(errorByCells);
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
      if (view.sees(nodes_.back().place))
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
    const auto count = static_cast<std::int64_t>(work_.requests.size());
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
          makeBrick(static_cast<std::size_t>(n));
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

template bool MediumTree<float>::doTasks(const View&, const Monitor&);
template bool MediumTree<double>::doTasks(const View&, const Monitor&);

} // namespace schlieren
