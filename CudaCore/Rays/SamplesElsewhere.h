// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Steps that look at the medium at several places (Integrator::samplesBeyond), of which some are in other leaves than the
// ray. Where another process has such a leaf, the step is begun, and undone; the ray goes to that process and comes back
// with the sample, and the step is begun anew.
#pragma once

#include "Medium/Interpolation.h"
#include "Rays/InBoxes.h"
#include "Rays/LeavesOfRays.h"
#include "Rays/RayTask.h"
#include "Rays/SuspendedRays.h"

#include <cstdint>
#include <type_traits>

namespace schlieren
{

/// In place of a scheme: the one that the task names, looked up for each sample. For integrators whose samples are a
/// function of their own anyway, so that their steps are compiled once for all schemes.
struct SchemeOfTask
{
  template <class Scheme>
  using Of = Scheme;
};

/// A function of its own where a step takes several samples: in line, their code would be too much.
template <class Scheme, class Real>
SCHLIEREN_NOINLINE Sample<Real> sampleApart(
  const RayTask<NumberOf<Real>>& task, const std::int64_t* base, const Vec3<Real>& at)
{
  if constexpr (std::is_base_of_v<SchemeOfTask, Scheme>)
  {
    return visitScheme(task.kernel.interpolation,
      [&](auto scheme) {
        return interpolate<typename Scheme::template Of<decltype(scheme)>>(task.medium, base, at);
      });
  }
  else
  {
    return interpolate<Scheme>(task.medium, base, at);
  }
}

/// The medium at places whose leaves are resident.
template <class Scheme, class Real>
SCHLIEREN_HD Sample<Real> sampleAt(
  const RayTask<NumberOf<Real>>& task, const PlacesElsewhere<Real>& places)
{
  Sample<Real> found = sampleApart<Scheme>(
    task, places.base, clampTo(places.at, task.medium.leafLow, task.medium.leafHigh));
  found.value += places.value;
  found.gradient = places.finer * found.gradient;
  return found;
}

/// What goes with a suspended ray whose steps look at several places.
template <class Number>
struct StepElsewhere
{
  static constexpr std::int32_t nowhere = SuspendedRay<Number>::nowhere;

  /// The numbers of a step's samples: Newton's method where the ray leaves the grid takes three times as many as the step
  /// has, and one is at the end.
  static constexpr std::int32_t samplesPerStep = 4;
  static constexpr std::int32_t firstOfStep = 3 * samplesPerStep;
  static constexpr std::int32_t atEnd = firstOfStep + samplesPerStep;
  static constexpr std::int32_t most = atEnd + 1;

  std::int32_t home =
    nowhere;                ///< the step's leaf, while a sample in the ray's next leaf is missing
  std::int32_t missing = 0; ///< its number
  Vec3<Number> place{};     ///< where it is, local coordinates of that leaf
  Number longest{};         ///< Adaptive: of the next step
  Number inGas{};           ///< see March
  std::uint32_t known = 0;  ///< a bit for each sample that other processes have found for the step
  Sample<Number> found[most]{};

  SCHLIEREN_HD bool knows(std::int32_t number) const { return (known >> number & 1u) != 0; }
};

/// Finds the samples that so many rays, at most a pack's, have come for, from where they go home.
template <class Scheme, class Real>
void findMissing(const RayTask<NumberOf<Real>>& task, SuspendedRay<NumberOf<Real>>* const* rays,
  StepElsewhere<NumberOf<Real>>* const* steps, int count)
{
  using Number = NumberOf<Real>;
  constexpr int lanes = lanesOf<Real>;
  PlacesElsewhere<Real> places;
  Number at[3][lanes], value[lanes], finer[lanes];
  for (int i = 0; i < lanes; ++i)
  {
    const int n = i < count ? i : 0;
    const Leaf<Number>& leaf = task.medium.leaves[rays[n]->next];
    const Leaf<Number>& home = task.medium.leaves[steps[n]->home];
    places.base[i] = leaf.brick * task.medium.brickStride;
    value[i] = leaf.offset;
    finer[i] = static_cast<Number>(leaf.perIndex / home.perIndex);
    at[0][i] = steps[n]->place.x;
    at[1][i] = steps[n]->place.y;
    at[2][i] = steps[n]->place.z;
  }
  places.at = packsOf<Real>(at);
  places.value = fromArray<Real>(value);
  places.finer = fromArray<Real>(finer);
  const Sample<Real> found = sampleAt<Scheme>(task, places);
  Number gradient[3][lanes];
  toArray(found.value, value);
  toArrays(found.gradient, gradient);
  for (int i = 0; i < count; ++i)
  {
    StepElsewhere<Number>& step = *steps[i];
    step.found[step.missing] = { value[i], { gradient[0][i], gradient[1][i], gradient[2][i] } };
    step.known |= 1u << step.missing;
    rays[i]->next = step.home;
    step.home = StepElsewhere<Number>::nowhere;
  }
}

/// The samples of one step after the other of a pack of rays. Nothing here makes one ray depend on those beside it.
template <class Real>
class SamplesOfSteps
{
public:
  using Number = NumberOf<Real>;
  using Step = StepElsewhere<Number>;
  static constexpr int lanes = lanesOf<Real>;

  /// `steps`: what goes with the rays. It must outlive this.
  explicit SamplesOfSteps(Step* steps)
    : steps_(steps)
  {
    for (int i = 0; i < lanes; ++i)
    {
      leafOfMissing_[i] = Step::nowhere;
      someKnown_ = someKnown_ || steps[i].known != 0;
    }
  }

  /// At the beginning of steps: where they begin, of rays that are under way, `cruise` > 0.
  void begin(const Ray<Real>& ray, const LeavesOfRays<Real>& in, const Real& longest,
    const Real& inGas, const Real& cruise)
  {
    ray_ = ray;
    in_ = in;
    longest_ = longest;
    inGas_ = inGas;
    underWay_ = cruise;
    next(0, cruise);
  }

  /// The next sample is that of this number, of rays that are `asking`, > 0. What others find does not matter.
  void next(std::int32_t number, const Real& asking)
  {
    number_ = number;
    asking_ = asking;
  }

  /// The next sample, at places in local coordinates of the rays' leaves, to whose samples `value` is added. Where it is
  /// missing, 0.
  template <class Scheme>
  Sample<Real> find(const RayTask<Number>& task, const LeavesOfRays<Real>& in, const Real& value,
    const Vec3<Real>& at)
  {
    if (!any(insetOf(at, task.medium.leafLow, task.medium.leafHigh) < 0))
    {
      ++number_;
      Sample<Real> found = sampleApart<Scheme>(task, in.base, at);
      found.value += value;
      return found;
    }
    PlacesElsewhere<Real> places;
    std::int32_t absent[lanes];
    const bool someAbsent = findPlaces(task.medium, in, at, places, absent);
    Sample<Real> found = sampleAt<Scheme>(task, places);
    if (someAbsent)
    {
      replace(absent, places.at, found);
    }
    ++number_;
    return found;
  }

  bool someMissing() const { return someMissing_; }

  /// 1 for each ray whose step cannot be taken, else 0. They go from these leaves for the samples: this ends their steps here.
  Real suspendMissing(SuspendedRay<Number>* states, const std::int32_t (&leaf)[lanes])
  {
    Number are[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      are[i] = 0;
      if (leafOfMissing_[i] != Step::nowhere)
      {
        are[i] = 1;
        steps_[i].home = leaf[i];
        states[i].next = leafOfMissing_[i];
        leafOfMissing_[i] = Step::nowhere;
      }
    }
    someMissing_ = false;
    return fromArray<Real>(are);
  }

  /// Where the steps began.
  const Ray<Real>& ray() const { return ray_; }
  const LeavesOfRays<Real>& leaves() const { return in_; }

  /// Before rays are suspended there.
  void keep()
  {
    Number longest[lanes], inGas[lanes], areUnderWay[lanes];
    toArray(longest_, longest);
    toArray(inGas_, inGas);
    toArray(underWay_, areUnderWay);
    for (int i = 0; i < lanes; ++i)
    {
      if (areUnderWay[i] > 0)
      {
        steps_[i].longest = longest[i];
        steps_[i].inGas = inGas[i];
      }
    }
  }
  /// What keep() has kept.
  void restore(Real& longest, Real& inGas) const
  {
    Number ofLongest[lanes], ofGas[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      ofLongest[i] = steps_[i].longest;
      ofGas[i] = steps_[i].inGas;
    }
    longest = fromArray<Real>(ofLongest);
    inGas = fromArray<Real>(ofGas);
  }

  /// The steps are taken.
  void end()
  {
    for (int i = 0; someKnown_ && i < lanes; ++i)
    {
      if (steps_[i].home == Step::nowhere)
      {
        steps_[i].known = 0;
      }
    }
    someKnown_ = false;
  }

private:
  /// Where places are. A ray's own leaf is looked at as if no other ray were elsewhere. `absent`: leaves that are not
  /// resident, else nowhere; whether there is any.
  SCHLIEREN_NOINLINE static bool findPlaces(const MediumView<Number>& medium,
    const LeavesOfRays<Real>& in, const Vec3<Real>& at, PlacesElsewhere<Real>& to,
    std::int32_t (&absent)[lanes])
  {
    Number x[3][lanes], isOut[lanes], value[lanes], finer[lanes];
    toArrays(at, x);
    toArray(insetOf(at, medium.leafLow, medium.leafHigh) < 0 ? Real{} + 1 : Real{}, isOut);
    bool someAbsent = false;
    for (int i = 0; i < lanes; ++i)
    {
      finer[i] = 1;
      const Leaf<Number>& leaf =
        isOut[i] > 0 ? in.leafAt(medium, i, x, finer[i]) : medium.leaves[in.leaf[i]];
      const bool isAbsent = !leaf.isResident();
      absent[i] = isAbsent ? static_cast<std::int32_t>(&leaf - medium.leaves) : Step::nowhere;
      to.base[i] = isAbsent ? 0 : leaf.brick * medium.brickStride;
      value[i] = leaf.offset;
      someAbsent = someAbsent || isAbsent;
    }
    to.at = packsOf<Real>(x);
    to.value = fromArray<Real>(value);
    to.finer = fromArray<Real>(finer);
    return someAbsent;
  }

  /// Puts what is known in the place of what has been found in leaves that are not resident.
  SCHLIEREN_NOINLINE void replace(
    const std::int32_t (&absent)[lanes], const Vec3<Real>& at, Sample<Real>& found)
  {
    Number place[3][lanes], value[lanes], gradient[3][lanes], asking[lanes];
    toArrays(at, place);
    toArray(found.value, value);
    toArrays(found.gradient, gradient);
    toArray(asking_, asking);
    for (int i = 0; i < lanes; ++i)
    {
      if (absent[i] == Step::nowhere)
      {
        continue;
      }
      Step& step = steps_[i];
      const bool isKnown = step.knows(number_);
      const Sample<Number> sample = isKnown ? step.found[number_] : Sample<Number>{};
      value[i] = sample.value;
      gradient[0][i] = sample.gradient.x;
      gradient[1][i] = sample.gradient.y;
      gradient[2][i] = sample.gradient.z;
      if (!isKnown && asking[i] > 0 && leafOfMissing_[i] == Step::nowhere)
      {
        leafOfMissing_[i] = absent[i];
        step.missing = number_;
        step.place = { place[0][i], place[1][i], place[2][i] };
        someMissing_ = true;
      }
    }
    found.value = fromArray<Real>(value);
    found.gradient = packsOf<Real>(gradient);
  }

  Step* steps_;
  Ray<Real> ray_{};
  LeavesOfRays<Real> in_{};
  Real longest_{}, inGas_{}, underWay_{}, asking_{};
  std::int32_t number_ = 0;
  std::int32_t leafOfMissing_[lanes];
  bool someMissing_ = false;
  bool someKnown_ = false;
};

} // namespace schlieren
