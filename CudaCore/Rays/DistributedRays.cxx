// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/DistributedRays.h"

#include "Device/Parallel.h"
#include "Rays/Kernels.h"
#include "Rays/SimdMarch.h"

#include <algorithm>
#include <atomic>
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
  std::vector<float> gathered; ///< ray by ray

  explicit TwoPacks(std::size_t ofFields)
    : fields(ofFields)
    , gathered(2 * Lanes * ofFields, 0.f)
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

/// Puts a ray where it enters the grid, or where it is, and says whether that is in a leaf that is here: then it is one
/// more of the packs. `ended`: in a wall.
template <class Number, int Lanes>
bool begin(const RayTask<Number>& task, const Pass& pass, SuspendedRay<Number>& ray,
  const float* gathered, TwoPacks<Number, Lanes>& packs, bool& ended, RayExit& exit)
{
  const int n = packs.count / Lanes, i = packs.count % Lanes;
  RayBatch<Number, Lanes>& batch = packs.batches[n];
  const Entry entry = meetGrid(task, pass, ray.ray, batch, i);
  ended = false;
  if (ray.leaf == SuspendedRay<Number>::nowhere)
  {
    const Vec3<double> start = startOf(batch, i);
    ray.next = task.medium.finder.at(start);
    if (!task.medium.leaves[ray.next].isResident())
    {
      batch.fate[i] = RayFate::Missed;
      return false;
    }
    if (isWallAt(task.medium, start))
    {
      batch.fate[i] = RayFate::Blocked;
      exit = leaveGrid(task, batch, i, entry);
      batch.fate[i] = RayFate::Missed;
      ended = true;
      return false;
    }
  }
  packs.entries[n][i] = entry;
  packs.states[n][i] = ray;
  std::copy_n(gathered, packs.fields, packs.ofRay(packs.count));
  ++packs.count;
  return true;
}

template <class Number, int Lanes>
void advanceWith(const RayTask<Number>& task, AdvanceFunction<Number, Lanes> advance,
  const Pass& pass, TravellingRays<Number>& rays, std::int64_t first, std::int64_t end,
  AdvancedRays<Number>& to)
{
  for (std::int64_t next = first; next < end;)
  {
    TwoPacks<Number, Lanes> packs(rays.fields);
    for (; next < end && packs.count < 2 * Lanes; ++next)
    {
      bool ended = false;
      RayExit exit{};
      SuspendedRay<Number>& ray = rays.rays[static_cast<std::size_t>(next)];
      const float* const gathered =
        rays.gathered.data() + rays.fields * static_cast<std::size_t>(next);
      if (begin(task, pass, ray, gathered, packs, ended, exit))
      {
        continue;
      }
      if (ended)
      {
        to.end({ ray.ray, exit }, gathered);
      }
      else
      {
        to.suspended.add(ray, gathered);
      }
    }
    advance(task, packs.batches, packs.states);
    for (int number = 0; number < packs.count; ++number)
    {
      const int n = number / Lanes, i = number % Lanes;
      const SuspendedRay<Number>& ray = packs.states[n][i];
      if (ray.next != SuspendedRay<Number>::nowhere)
      {
        to.suspended.add(ray, packs.ofRay(number));
        continue;
      }
      const RayBatch<Number, Lanes>& batch = packs.batches[n];
      to.end({ ray.ray, leaveGrid(task, batch, i, packs.entries[n][i]) }, packs.ofRay(number));
      to.worstDrift = std::max(to.worstDrift, static_cast<double>(batch.drift[i]));
    }
  }
}

template <class Number>
AdvanceFunction<Number, 1> advanceOneByOne(const KernelChoice& choice)
{
  return visitScheme(choice.interpolation,
    [&choice](auto scheme)
    {
      return visitPath<decltype(scheme)>(choice.path,
        [](auto kernel) -> AdvanceFunction<Number, 1>
        {
          return [](const RayTask<Number>& task, RayBatch<Number, 1>(&batches)[2],
                   SuspendedRay<Number>(&states)[2][1])
          {
            for (int n = 0; n < 2; ++n)
            {
              MarchInResidentLeaves<decltype(kernel), Number> march(task, batches[n], states[n]);
              march.takeAllSteps();
              march.findDrift();
            }
          };
        });
    });
}

/// Calls visit with the function for some instructions.
template <class Number, class Visit>
void visitAdvance(const KernelChoice& kernel, Simd simd, const Visit& visit)
{
  constexpr bool isSingle = std::is_same_v<Number, float>;
#ifdef SCHLIEREN_HAS_AVX
  if (simd >= Simd::Avx512)
  {
    constexpr int lanes = isSingle ? 16 : 8;
    visit(simd == Simd::Avx512 ? simdAdvance<Number, lanes>(kernel)
                               : simdAdvanceByRows<Number, lanes>(kernel));
    return;
  }
  if (simd == Simd::Avx2)
  {
    constexpr int lanes = isSingle ? 8 : 4;
    visit(simdAdvance<Number, lanes>(kernel));
    return;
  }
#endif
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
  TravellingRays others{ fields, {}, {} };
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
  const std::size_t bytesOfGathered = counts.others * fields * sizeof(float);
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
  takeValues(message, counts.others * fields, at, gathered);
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
  const std::size_t fields = suspended.fields;
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
  AdvancedRays<Real> all(rays.fields);
  std::mutex lock; // of these
  constexpr std::int64_t grain = 64;
  const auto advanceAll = [&](auto advance)
  {
    parallelFor(static_cast<std::int64_t>(rays.size()), grain, threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        AdvancedRays<Real> here(rays.fields);
        advanceWith(task, advance, pass, rays, begin, end, here);
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
