// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays that wait for the leaf that they come to, of which this process, or its device, has not the samples.
#pragma once

#include "Rays/LeavesOfRays.h"
#include "Rays/RayTask.h"

#include <cstdint>

namespace schlieren
{

/// A ray whose march has come to a leaf that is not resident: what of it is not the pass's and the task's, to the last
/// bit, in the coordinates of the leaf that it leaves.
template <class Number>
struct SuspendedRay
{
  static constexpr std::int32_t nowhere = -1;
  std::int64_t ray;       ///< of the pass
  double start[3];        ///< see LeavesOfRays
  double travelled;       ///< likewise
  Vec3<Number> offset, q; ///< see Ray, as the next three
  Number length, path, pathError;
  std::int32_t leaf; ///< that it is in; nowhere: it has not entered the grid yet
  std::int32_t
    next; ///< the one that it comes to; nowhere: its march has not come to a leaf that is not resident
  std::int32_t steps; ///< so far
};

/// The rays of a pack that are suspended when they come to a leaf that is not resident. Nothing here makes one depend on
/// those beside it.
template <class Real>
struct SuspendedRays
{
  using Number = NumberOf<Real>;
  using State = SuspendedRay<Number>;
  static constexpr int lanes = lanesOf<Real>;

  State* states;               ///< of the rays; of those that march, where the march began
  std::int32_t stepsOfAll = 0; ///< RayTask::stepLimit
  std::int32_t stepLimit = 0;  ///< of the pack: then some ray has taken too many

  /// Whether a ray is to be suspended because this leaf is next.
  SCHLIEREN_HD static bool suspends(
    const MediumView<Number>& medium, State& state, std::int32_t next)
  {
    const bool isAbsent = !medium.leaves[next].isResident();
    state.next = isAbsent ? next : State::nowhere;
    return isAbsent;
  }

  /// 1 for each ray that is suspended, else 0.
  SCHLIEREN_HD Real areSuspended() const
  {
    Number are[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      are[i] = states[i].next != State::nowhere ? Number(1) : Number(0);
    }
    return fromArray<Real>(are);
  }

  /// 1 for each ray that has taken too many steps, after so many of the pack.
  SCHLIEREN_HD Real areTrapped(std::int32_t steps) const
  {
    Number are[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      are[i] = states[i].steps + steps >= stepsOfAll ? Number(1) : Number(0);
    }
    return fromArray<Real>(are);
  }

  /// `cruise`: > 0 for rays that are under way.
  SCHLIEREN_HD void limitSteps(const Real& cruise)
  {
    Number isUnderWay[lanes];
    toArray(cruise, isUnderWay);
    stepLimit = stepsOfAll;
    for (int i = 0; i < lanes; ++i)
    {
      stepLimit = isUnderWay[i] > 0 ? minimum(stepLimit, stepsOfAll - states[i].steps) : stepLimit;
    }
  }

  /// Keeps the rays that are suspended now, after so many steps of the pack.
  SCHLIEREN_HD void keep(
    const Ray<Real>& ray, const LeavesOfRays<Real>& in, const Real& cruise, std::int32_t steps)
  {
    Number offset[3][lanes], q[3][lanes], length[lanes], path[lanes], pathError[lanes],
      isUnderWay[lanes];
    toArrays(ray.offset, offset);
    toArrays(ray.q, q);
    toArray(ray.length, length);
    toArray(ray.path, path);
    toArray(ray.pathError, pathError);
    toArray(cruise, isUnderWay);
    for (int i = 0; i < lanes; ++i)
    {
      if (isUnderWay[i] > 0 && states[i].next != State::nowhere)
      {
        states[i] = { states[i].ray, { in.start[0][i], in.start[1][i], in.start[2][i] },
          in.travelled[i], { offset[0][i], offset[1][i], offset[2][i] },
          { q[0][i], q[1][i], q[2][i] }, length[i], path[i], pathError[i], in.leaf[i],
          states[i].next, states[i].steps + steps };
      }
    }
  }

  /// The rays where they were suspended, in the leaves where they were then, of which nothing but the place needs to be
  /// here, or where they enter the grid. `enters`: 1 for these, else 0.
  SCHLIEREN_HD Ray<Real> restore(const MediumView<Number>& medium, const double (&entry)[3][lanes],
    LeavesOfRays<Real>& in, Real& enters)
  {
    Number start[3][lanes], offset[3][lanes], q[3][lanes], length[lanes], path[lanes],
      pathError[lanes], areNew[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      State& from = states[i];
      const bool isNew = from.leaf == State::nowhere;
      areNew[i] = isNew ? Number(1) : Number(0);
      if (isNew)
      {
        in.enter(medium, i, entry);
      }
      else
      {
        const Leaf<Number>& leaf = medium.leaves[from.leaf];
        in.leaf[i] = from.leaf;
        in.base[i] = leaf.isResident() ? leaf.brick * medium.brickStride : 0;
        in.travelled[i] = from.travelled;
      }
      const Number ofOffset[3] = { from.offset.x, from.offset.y, from.offset.z };
      const Number ofQ[3] = { from.q.x, from.q.y, from.q.z };
      for (int axis = 0; axis < 3; ++axis)
      {
        in.start[axis][i] = isNew ? in.start[axis][i] : from.start[axis];
        start[axis][i] = static_cast<Number>(in.start[axis][i]);
        offset[axis][i] = ofOffset[axis];
        q[axis][i] = ofQ[axis];
      }
      length[i] = from.length;
      path[i] = from.path;
      pathError[i] = from.pathError;
      from.next = State::nowhere;
    }
    enters = fromArray<Real>(areNew);
    return { packsOf<Real>(start), packsOf<Real>(offset), packsOf<Real>(q), fromArray<Real>(length),
      fromArray<Real>(path), fromArray<Real>(pathError) };
  }
};

/// Of those that march where all leaves are.
struct NoSuspendedRays
{
  void* states;
};

} // namespace schlieren
