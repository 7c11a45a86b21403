// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/DistributedRays.h"

#include "Device/Parallel.h"
#include "Rays/Kernels.h"
#include "Rays/MarchOfPacks.h"
#include "Rays/SimdMarch.h"
#include "Rays/SimdUnits.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <mutex>

namespace schlieren
{

namespace
{

/// Two packs of rays that a kernel takes side by side.
template <class Number, int Lanes>
struct TwoPacks
{
  RayBatch<Number, Lanes> batches[2]{};
  SuspendedRay<Number> states[2][Lanes]{};
  Entry entries[2][Lanes];
  int count = 0;
  std::size_t fields;
  std::vector<float> gathered;              ///< ray by ray
  std::vector<StepElsewhere<Number>> steps; ///< likewise

  explicit TwoPacks(const Carried& carried)
    : fields(carried.fields)
    , gathered(2 * Lanes * carried.fields, 0.f)
    , steps(carried.hasSteps ? 2 * Lanes : 0)
  {
    for (int n = 0; n < 2; ++n)
    {
      std::fill(batches[n].fate, batches[n].fate + Lanes, RayFate::Missed);
      for (int i = 0; i < Lanes; ++i)
      {
        batches[n].gathered[i] = ofRay(n * Lanes + i);
      }
    }
  }
  float* ofRay(int number) { return gathered.data() + fields * static_cast<std::size_t>(number); }
};

enum class Begun
{
  Here,  ///< it is in a leaf that is here
  There, ///< in one that is not
  Ended  ///< in a wall
};

/// Puts a ray where it enters the grid, or where it is.
template <class Number, int Lanes>
Begun begin(const RayTask<Number>& task, const Pass& pass, SuspendedRay<Number>& ray,
  RayBatch<Number, Lanes>& batch, int i, Entry& entry, RayExit& exit)
{
  if (ray.leaf != SuspendedRay<Number>::nowhere && !task.medium.leaves[ray.next].isResident())
  {
    return Begun::There;
  }
  entry = meetGrid(task, pass, ray.ray, batch, i);
  if (ray.leaf == SuspendedRay<Number>::nowhere)
  {
    const Vec3<double> start = startOf(batch, i);
    ray.next = task.medium.finder.at(start);
    if (!task.medium.leaves[ray.next].isResident())
    {
      batch.fate[i] = RayFate::Missed;
      return Begun::There;
    }
    if (isWallAt(task.medium, start))
    {
      batch.fate[i] = RayFate::Blocked;
      exit = leaveGrid(task, batch, i, entry);
      batch.fate[i] = RayFate::Missed;
      return Begun::Ended;
    }
  }
  return Begun::Here;
}

/// Finds the samples that rays have come for.
template <class Number, int Lanes>
void findSamples(const RayTask<Number>& task, const AdvanceFunctions<Number, Lanes>& with,
  TravellingRays<Number>& rays, std::size_t first, std::size_t end)
{
  SuspendedRay<Number>* states[Lanes];
  StepElsewhere<Number>* steps[Lanes];
  int count = 0;
  for (std::size_t number = first; number < end; ++number)
  {
    if (rays.steps[number].home != StepElsewhere<Number>::nowhere)
    {
      states[count] = &rays.rays[number];
      steps[count] = &rays.steps[number];
      ++count;
    }
    if (count == Lanes || (count > 0 && number + 1 == end))
    {
      with.find(task, states, steps, count);
      count = 0;
    }
  }
}

template <class Number, int Lanes>
void advanceWith(const RayTask<Number>& task, const AdvanceFunctions<Number, Lanes>& with,
  const Pass& pass, TravellingRays<Number>& rays, std::int64_t first, std::int64_t end,
  AdvancedRays<Number>& to)
{
  const bool hasSteps = rays.carried.hasSteps;
  if (hasSteps)
  {
    findSamples(task, with, rays, static_cast<std::size_t>(first), static_cast<std::size_t>(end));
  }
  for (std::int64_t next = first; next < end;)
  {
    TwoPacks<Number, Lanes> packs(rays.carried);
    for (; next < end && packs.count < 2 * Lanes; ++next)
    {
      const auto number = static_cast<std::size_t>(next);
      const int n = packs.count / Lanes, i = packs.count % Lanes;
      SuspendedRay<Number>& ray = rays.rays[number];
      RayExit exit{};
      switch (begin(task, pass, ray, packs.batches[n], i, packs.entries[n][i], exit))
      {
        case Begun::Here:
          packs.states[n][i] = ray;
          std::copy_n(rays.ofRay(number), packs.fields, packs.ofRay(packs.count));
          if (hasSteps)
          {
            packs.steps[static_cast<std::size_t>(packs.count)] = rays.steps[number];
          }
          ++packs.count;
          break;
        case Begun::There:
          to.suspended.add(rays, number);
          break;
        case Begun::Ended:
          to.end({ ray.ray, exit }, rays.ofRay(number));
          break;
      }
    }
    with.advance(task, packs.batches, packs.states, packs.steps.data());
    for (int number = 0; number < packs.count; ++number)
    {
      const int n = number / Lanes, i = number % Lanes;
      const SuspendedRay<Number>& ray = packs.states[n][i];
      if (ray.next != SuspendedRay<Number>::nowhere)
      {
        to.suspended.add(ray, packs.ofRay(number),
          hasSteps ? &packs.steps[static_cast<std::size_t>(number)] : nullptr);
        continue;
      }
      const RayBatch<Number, Lanes>& batch = packs.batches[n];
      to.end({ ray.ray, leaveGrid(task, batch, i, packs.entries[n][i]) }, packs.ofRay(number));
      to.worstDrift = std::max(to.worstDrift, static_cast<double>(batch.drift[i]));
    }
  }
}

template <class Number>
AdvanceFunctions<Number, 1> advanceOneByOne(const KernelChoice& choice)
{
  return visitKernel(
    choice, [](auto kernel) { return advanceFunctions<decltype(kernel), SchemeOfTask, Number>(); });
}

/// Calls visit with the functions for some instructions.
template <class Number, class Visit>
void visitAdvance(const KernelChoice& kernel, Simd simd, const Visit& visit)
{
  constexpr bool isSingle = std::is_same_v<Number, float>;
  constexpr int ofAvx512 = isSingle ? 16 : 8, ofAvx2 = isSingle ? 8 : 4;
  simd = packsFor(kernel, simd);
  if constexpr (isCompiledFor(Simd::Avx512))
  {
    if (simd == Simd::Avx512)
    {
      visit(simdAdvance<Number, ofAvx512>(kernel));
      return;
    }
  }
  if constexpr (isCompiledFor(Simd::Avx512Rows))
  {
    if (simd == Simd::Avx512Rows)
    {
      visit(simdAdvanceByRows<Number, ofAvx512>(kernel));
      return;
    }
  }
  if constexpr (isCompiledFor(Simd::Avx2))
  {
    if (simd == Simd::Avx2)
    {
      visit(simdAdvance<Number, ofAvx2>(kernel));
      return;
    }
  }
  if constexpr (isSingle) // see traceTiles()
  {
    if (simd != Simd::None)
    {
      visit(simdAdvance<Number, 4>(kernel));
      return;
    }
  }
  visit(advanceOneByOne<Number>(kernel));
}

/// A ray that has not entered the grid, in a message.
struct BegunRay
{
  std::int64_t ray = 0;
  std::int32_t leaf = 0;
};

/// Adds so many values from a message, from some byte on, which becomes that behind them. They must be there.
template <class Value>
void takeValues(
  const std::vector<char>& message, std::size_t count, std::size_t& at, std::vector<Value>& values)
{
  if (count > 0)
  {
    values.resize(values.size() + count);
    std::memcpy(
      values.data() + (values.size() - count), message.data() + at, count * sizeof(Value));
    at += count * sizeof(Value);
  }
}

/// Of the samples only those that are known.
template <class Number>
void writeStep(const StepElsewhere<Number>& step, std::vector<char>& message)
{
  const char* const bytes = reinterpret_cast<const char*>(&step);
  message.insert(message.end(), bytes, bytes + offsetof(StepElsewhere<Number>, found));
  for (std::int32_t number = 0; number < StepElsewhere<Number>::most; ++number)
  {
    if (step.knows(number))
    {
      append(std::vector<Sample<Number>>{ step.found[number] }, message);
    }
  }
}

/// From some byte on, which becomes that behind it. False where there is no more of it.
template <class Number>
bool readStep(const std::vector<char>& message, std::size_t& at, StepElsewhere<Number>& step)
{
  const auto take = [&](void* to, std::size_t bytes)
  {
    const bool isThere = message.size() - at >= bytes;
    if (isThere)
    {
      std::memcpy(to, message.data() + at, bytes);
      at += bytes;
    }
    return isThere;
  };
  bool isThere = take(&step, offsetof(StepElsewhere<Number>, found));
  for (std::int32_t number = 0; number < StepElsewhere<Number>::most; ++number)
  {
    if (step.knows(number))
    {
      isThere = isThere && take(&step.found[number], sizeof(Sample<Number>));
    }
  }
  return isThere;
}

/// Before rays in a message.
struct RayCounts
{
  std::uint64_t begun = 0, others = 0;
};

} // namespace

std::uint64_t newNumber()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

template <class Real>
void TravellingRays<Real>::write(std::vector<char>& message) const
{
  std::vector<BegunRay> begun;
  TravellingRays others(carried);
  for (std::size_t number = 0; number < rays.size(); ++number)
  {
    const SuspendedRay<Real>& ray = rays[number];
    if (ray.leaf == SuspendedRay<Real>::nowhere)
    {
      begun.push_back({ ray.ray, ray.next });
    }
    else
    {
      others.add(*this, number);
    }
  }
  append(std::vector<RayCounts>{ { begun.size(), others.size() } }, message);
  append(begun, message);
  append(others.rays, message);
  append(others.gathered, message);
  for (const StepElsewhere<Real>& step : others.steps)
  {
    writeStep(step, message);
  }
}

template <class Real>
std::size_t TravellingRays<Real>::read(const std::vector<char>& message, std::size_t at)
{
  RayCounts counts;
  if (at > message.size() || message.size() - at < sizeof(counts))
  {
    return 0;
  }
  std::memcpy(&counts, message.data() + at, sizeof(counts));
  at += sizeof(counts);
  const std::size_t bytesOfBegun = counts.begun * sizeof(BegunRay);
  const std::size_t bytesOfOthers = counts.others * sizeof(SuspendedRay<Real>);
  const std::size_t bytesOfGathered = counts.others * carried.fields * sizeof(float);
  if (counts.begun > message.size() || counts.others > message.size() ||
    message.size() - at < bytesOfBegun + bytesOfOthers + bytesOfGathered)
  {
    return 0;
  }
  std::vector<BegunRay> begun;
  takeValues(message, counts.begun, at, begun);
  for (const BegunRay& ray : begun)
  {
    begin(ray.ray, ray.leaf);
  }
  takeValues(message, counts.others, at, rays);
  takeValues(message, counts.others * carried.fields, at, gathered);
  fill();
  for (std::size_t number = rays.size() - counts.others; carried.hasSteps && number < rays.size();
       ++number)
  {
    if (!readStep(message, at, steps[number]))
    {
      return 0;
    }
  }
  return at;
}

template <class Real>
std::vector<char> AdvancedRays<Real>::toMessage(AdvancedMessage head) const
{
  head.ended = ended.size();
  head.worstDrift = worstDrift;
  std::vector<char> message = messageOf(head);
  append(ended, message);
  append(gathered, message);
  suspended.write(message);
  return message;
}

template <class Real>
bool AdvancedRays<Real>::fromMessage(const std::vector<char>& message)
{
  AdvancedMessage head;
  const std::size_t fields = suspended.carried.fields;
  if (!read(message, head) || head.kind != RayWorker::Advanced || head.ended > message.size() ||
    message.size() - sizeof(head) < head.ended * (sizeof(EndedRay) + fields * sizeof(float)))
  {
    return false;
  }
  std::size_t at = sizeof(head);
  takeValues(message, head.ended, at, ended);
  takeValues(message, head.ended * fields, at, gathered);
  worstDrift = head.worstDrift;
  return suspended.read(message, at) == message.size();
}

template <class Real>
AdvancedRays<Real> advanceRays(
  const RayTask<Real>& task, const Pass& pass, TravellingRays<Real> rays, int threads, Simd simd)
{
  AdvancedRays<Real> all(rays.carried);
  std::mutex lock; // of these
  constexpr std::int64_t grain = 64;
  const auto advanceAll = [&](const auto& with)
  {
    parallelFor(static_cast<std::int64_t>(rays.size()), grain, threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        AdvancedRays<Real> here(rays.carried);
        advanceWith(task, with, pass, rays, begin, end, here);
        const std::lock_guard<std::mutex> guard(lock);
        all.add(here);
      });
  };
  visitAdvance<Real>(task.kernel, simd, advanceAll);
  return all;
}

template struct TravellingRays<float>;
template struct TravellingRays<double>;
template struct AdvancedRays<float>;
template struct AdvancedRays<double>;
template AdvancedRays<float> advanceRays(
  const RayTask<float>&, const Pass&, TravellingRays<float>, int, Simd);
template AdvancedRays<double> advanceRays(
  const RayTask<double>&, const Pass&, TravellingRays<double>, int, Simd);

} // namespace schlieren
