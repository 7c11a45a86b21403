// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/DistributedRays.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace schlieren
{

namespace
{

/// Takes a ray through resident leaves. Whether it has ended there; otherwise `ray` is as it goes on elsewhere.
template <class Kernel, class Number>
bool advanceRay(const RayTask<Number>& task, const Pass& pass, SuspendedRay<Number>& ray,
  float* gathered, RayExit& exit, double& drift)
{
  RayBatch<Number, 1> batch{};
  const Entry entry = meetGrid(task, pass, ray.ray, batch, 0);
  batch.gathered[0] = gathered;
  const bool isNew = ray.leaf < 0;
  if (isNew && batch.fate[0] == RayFate::Left)
  {
    const Vec3<double> start = startOf(batch, 0);
    ray.next = task.medium.finder.at(start);
    if (!task.medium.leaves[ray.next].isResident())
    {
      return false;
    }
    batch.fate[0] = isWallAt(task.medium, start) ? RayFate::Blocked : RayFate::Left;
  }
  if (batch.fate[0] == RayFate::Left)
  {
    using May = MayMeet<false, true, true, true>;
    March<Kernel, Number, May> march(task, batch, isNew ? nullptr : &ray);
    if (march.takeStepsInResidentLeaves(ray))
    {
      return false;
    }
    march.findDrift();
  }
  drift = static_cast<double>(batch.drift[0]);
  exit = leaveGrid(task, batch, 0, entry);
  return true;
}

template <class Number>
using AdvanceFunction = bool (*)(const RayTask<Number>& task, const Pass& pass,
  SuspendedRay<Number>& ray, float* gathered, RayExit& exit, double& drift);

template <class Number>
AdvanceFunction<Number> advanceFunction(const KernelChoice& choice)
{
  return visitScheme(choice.interpolation,
    [&](auto scheme) -> AdvanceFunction<Number>
    {
      using Scheme = decltype(scheme);
      return choice.path == PathModel::Straight
        ? &advanceRay<Kernel<StraightPath, Leapfrog, Scheme>, Number>
        : &advanceRay<Kernel<RefractedPath, Leapfrog, Scheme>, Number>;
    });
}

template <class Value>
void append(const std::vector<Value>& values, std::vector<char>& message)
{
  const char* first = reinterpret_cast<const char*>(values.data());
  message.insert(message.end(), first, first + values.size() * sizeof(Value));
}

} // namespace

std::uint64_t newNumber()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

bool canSuspend(const KernelChoice& kernel)
{
  return kernel.path == PathModel::Straight || kernel.integrator == Integrator::Leapfrog;
}

template <class Real>
std::vector<char> AdvancedRays<Real>::toMessage(std::uint64_t number) const
{
  AdvancedMessage head;
  const std::size_t all = ended.size() + suspended.size();
  head.fields =
    all == 0 ? 0 : static_cast<std::uint32_t>((gathered.size() + suspended.gathered.size()) / all);
  head.number = number;
  head.ended = ended.size();
  head.suspended = suspended.size();
  head.worstDrift = worstDrift;
  std::vector<char> message = messageOf(head);
  append(ended, message);
  append(gathered, message);
  suspended.write(message);
  return message;
}

template <class Real>
bool AdvancedRays<Real>::fromMessage(const std::vector<char>& message, std::size_t fields)
{
  AdvancedMessage head;
  if (!read(message, head) || head.kind != RayWorker::Advanced || head.ended > message.size() ||
    (head.fields != fields && head.ended + head.suspended > 0))
  {
    return false;
  }
  const std::size_t ofEnded = head.ended * sizeof(EndedRay);
  const std::size_t ofGathered = head.ended * fields * sizeof(float);
  if (message.size() - sizeof(head) < ofEnded + ofGathered)
  {
    return false;
  }
  ended.resize(head.ended);
  gathered.resize(head.ended * fields);
  const char* first = message.data() + sizeof(head);
  if (ofEnded > 0)
  {
    std::memcpy(ended.data(), first, ofEnded);
  }
  if (ofGathered > 0)
  {
    std::memcpy(gathered.data(), first + ofEnded, ofGathered);
  }
  worstDrift = head.worstDrift;
  return suspended.read(message, sizeof(head) + ofEnded + ofGathered, head.suspended, fields) ==
    message.size();
}

template <class Real>
AdvancedRays<Real> advanceRays(
  const RayTask<Real>& task, const Pass& pass, TravellingRays<Real> rays, int threads)
{
  const auto fields = static_cast<std::size_t>(task.gradients.count);
  const AdvanceFunction<Real> advance = advanceFunction<Real>(task.kernel);
  AdvancedRays<Real> all;
  std::mutex lock; // of these
  constexpr std::int64_t grain = 64;
  parallelFor(static_cast<std::int64_t>(rays.size()), grain, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      AdvancedRays<Real> here;
      for (std::int64_t n = begin; n < end; ++n)
      {
        SuspendedRay<Real>& ray = rays.rays[static_cast<std::size_t>(n)];
        float* const gathered = rays.gathered.data() + static_cast<std::size_t>(n) * fields;
        RayExit exit{};
        double drift = 0;
        if (advance(task, pass, ray, gathered, exit, drift))
        {
          here.ended.push_back({ ray.ray, exit });
          here.gathered.insert(here.gathered.end(), gathered, gathered + fields);
          here.worstDrift = std::max(here.worstDrift, drift);
        }
        else
        {
          here.suspended.add(ray, gathered, fields);
        }
      }
      const std::lock_guard<std::mutex> guard(lock);
      const auto join = [](auto& to, const auto& from)
      { to.insert(to.end(), from.begin(), from.end()); };
      join(all.ended, here.ended);
      join(all.gathered, here.gathered);
      join(all.suspended.rays, here.suspended.rays);
      join(all.suspended.gathered, here.suspended.gathered);
      all.worstDrift = std::max(all.worstDrift, here.worstDrift);
    });
  return all;
}

template struct AdvancedRays<float>;
template struct AdvancedRays<double>;
template AdvancedRays<float> advanceRays(
  const RayTask<float>&, const Pass&, TravellingRays<float>, int);
template AdvancedRays<double> advanceRays(
  const RayTask<double>&, const Pass&, TravellingRays<double>, int);

} // namespace schlieren
