// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How a tree is refined for a view.
#include "Medium/Tree/NodesInView.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// Reserves one of so many parts of the memory for what turns out to be worse than what was divided before.
constexpr std::size_t partsOfReserve = 16;

/// Leaves whose steepest places rays are sent through.
constexpr std::size_t steepestLeaves = 192;

} // namespace

template <class Real>
bool MediumTree<Real>::refine(const Column& column, const Monitor& monitor, Unneeded unneeded)
{
  unneeded_ = unneeded;
  lacksRoom_ = false;
  const bool isAnother = work_.column.tie() != column.tie();
  if (work_.isFinished || isAnother)
  {
    holdsOthers_ = holdsOthers_ || (hasRefined_ && isAnother);
    hasRefined_ = true;
    work_ = {};
    work_.column = column;
    work_.isFinished = false;
  }
  const View view(*this);
  bool hasChanged = false;
  bool continues = true;
  while (continues)
  {
    if (work_.tasksDone == work_.tasks.size())
    {
      numberLeaves();
      const RayFindings found = measure(view, {});
      if (!isMeasured_ && work_.largest > 0)
      {
        forgetNegligible(view);
        isMeasured_ = true;
        numberLeaves();
        measure(view, found); // what is negligible leaf by leaf may not be so along a ray
      }
      assumeDeflection(view);
      hasChanged = plan(view) || hasChanged;
      work_.isFinished = work_.tasks.empty();
    }
    const std::size_t before = work_.tasksDone;
    continues = !work_.isFinished && doTasks(view, monitor);
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
  summarize();
  return hasChanged;
}

template <class Real>
void MediumTree<Real>::refineFurther(
  double tolerance, std::vector<Column::Part> parts, const Monitor& monitor)
{
  settings_.tolerance = tolerance;
  constexpr std::size_t leastMemory = std::size_t{ 1 } << 26;
  const bool isFirst = work_.column.parts.empty();
  settings_.memory += isFirst ? std::max(settings_.memory, leastMemory) : 0;
  Column column = work_.column;
  column.parts = std::move(parts);
  refine(column, monitor, Unneeded::Stays);
}

/// Finds the largest deflection in the tree as it is, and leaves that are too coarse for it.
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
  std::vector<float> errors(leafNodes_.size(), 0.f), typical(errors);
  for (std::size_t leaf = 0; leaf < differences.size(); ++leaf)
  {
    Node& node = nodes_[static_cast<std::size_t>(leafNodes_[leaf])];
    node.isWrong = false;
    differences[leaf] = node.brick == 0 ? static_cast<float>(node.facts.difference) : 0.f;
    if (node.brick != 0)
    {
      errors[leaf] = static_cast<float>(view.errorOverEdge(node.place, node.facts));
      typical[leaf] = static_cast<float>(view.typicalOverEdge(node.place, node.facts));
    }
  }
  const RayFindings findings =
    lookAlongRays<Real>({ grid_, finder(), leaves_.data(), differences.data(), errors.data(),
                          typical.data(), samples().data(), gasDistances().data(), layout() },
      work_.column, places, settings_.tolerance, least, settings_.threads);
  work_.largest = findings.deflection;
  work_.strong = findings.strong;
  work_.error = findings.error;
  const auto nodeOf = [this](std::int32_t leaf)
  { return static_cast<std::size_t>(leafNodes_[static_cast<std::size_t>(leaf)]); };
  for (const std::int32_t leaf : findings.coarse)
  {
    nodes_[nodeOf(leaf)].isCoarse = true;
  }
  for (const std::int32_t leaf : findings.wrong)
  {
    nodes_[nodeOf(leaf)].isWrong = true;
  }
  return findings;
}

/// Where the view has leaves without samples because of their walls, rays have not met all of the medium. What is too
/// coarse because of an assumption is found when they have.
template <class Real>
void MediumTree<Real>::assumeDeflection(const View& view)
{
  constexpr double leastByRange =
    0.1; // of the largest deflection: a gradient over a tenth of its length
  const bool areMissed = std::any_of(leafNodes_.begin(), leafNodes_.end(),
    [&](std::int32_t at)
    {
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      return view.awaitsWalls(node) && view.sees(node.place);
    });
  if (areMissed)
  {
    work_.largest = std::max(work_.largest, leastByRange * rangeOfNu_);
    work_.strong = std::max(work_.strong, leastByRange * rangeOfNu_);
  }
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
    if (!node.isKnown || view.lacks(node))
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

/// Bytes that a task takes at most.
template <class Real>
std::size_t MediumTree<Real>::costOf(const Task& task) const
{
  const Node& node = nodes_[static_cast<std::size_t>(task.node)];
  const std::size_t ofOne =
    samples_.bytesOfBrick() + (node.map >= 0 || !node.isKnown ? maps_.bytesOfBrick() : 0);
  if (node.place.level < -1)
  {
    return childCount() * (sizeof(Node) + sizeof(Leaf<Real>));
  }
  return task.divides ? childCount() * (ofOne + sizeof(Node) + sizeof(Leaf<Real>)) : ofOne;
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
    std::size_t cost = 0;
    for (const Task& task : work_.tasks)
    {
      cost += costOf(task);
    }
    if (cost <= available)
    {
      return hasThrownAway;
    }
    if (holdsOthers_ && unneeded_ == Unneeded::Stays)
    {
      lacksRoom_ = true;
      work_.tasks.clear();
      return hasThrownAway;
    }
    if (holdsOthers_)
    {
      holdsOthers_ = false;
      hasThrownAway = true;
      makeRoots();
    }
    else if (!work_.isMemoryShort)
    {
      work_.isMemoryShort = true; // leaves that may not be divided lack samples
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
      fits = cost <= available || levelOf(task) <= 0; // there must be something
      continue;
    }
    const bool isWorse = task.urgency > 2 * work_.leastUrgent;
    const std::size_t left = isWorse ? available : available - std::min(available, reserve);
    fits = cost <= (fitting == 0 ? left : left / 2);
    work_.leastUrgent = fits ? std::min(work_.leastUrgent, task.urgency) : work_.leastUrgent;
  }
  tasks.resize(fitting);
}

template bool MediumTree<float>::refine(const Column&, const Monitor&, Unneeded);
template void MediumTree<float>::refineFurther(double, std::vector<Column::Part>, const Monitor&);
template void MediumTree<double>::refineFurther(double, std::vector<Column::Part>, const Monitor&);
template bool MediumTree<double>::refine(const Column&, const Monitor&, Unneeded);

} // namespace schlieren
