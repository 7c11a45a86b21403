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

/// Takes a ray through resident leaves. Whether it has ended there; otherwise `ray` is as it continues elsewhere.
template <class Kernel, class Number>
bool advanceRay(const RayTask<Number>& task, const Pass& pass, SuspendedRay<Number>& ray,
  RayExit& exit, double& drift)
{
  RayBatch<Number, 1> batch{};
  const Entry entry = meetGrid(task, pass, ray.ray, batch, 0);
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
    using May = MayMeet<false, true, false, true>;
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
  SuspendedRay<Number>& ray, RayExit& exit, double& drift);

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
  head.number = number;
  head.ended = ended.size();
  head.suspended = suspended.size();
  head.worstDrift = worstDrift;
  std::vector<char> message = messageOf(head);
  const char* first = reinterpret_cast<const char*>(ended.data());
  message.insert(message.end(), first, first + ended.size() * sizeof(EndedRay));
  suspended.write(message);
  return message;
}

template <class Real>
bool AdvancedRays<Real>::fromMessage(const std::vector<char>& message)
{
  AdvancedMessage head;
  if (!read(message, head) || head.kind != RayWorker::Advanced || head.ended > message.size() ||
    message.size() - sizeof(head) < head.ended * sizeof(EndedRay))
  {
    return false;
  }
  const std::size_t bytes = head.ended * sizeof(EndedRay);
  ended.resize(head.ended);
  if (bytes > 0)
  {
    std::memcpy(ended.data(), message.data() + sizeof(head), bytes);
  }
  worstDrift = head.worstDrift;
  return suspended.read(message, sizeof(head) + bytes, head.suspended) == message.size();
}

template <class Real>
AdvancedRays<Real> advanceRays(
  const RayTask<Real>& task, const Pass& pass, TravellingRays<Real> rays, int threads)
{
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
        RayExit exit{};
        double drift = 0;
        if (advance(task, pass, ray, exit, drift))
        {
          here.ended.push_back({ ray.ray, exit });
          here.worstDrift = std::max(here.worstDrift, drift);
        }
        else
        {
          here.suspended.rays.push_back(ray);
        }
      }
      const std::lock_guard<std::mutex> guard(lock);
      all.ended.insert(all.ended.end(), here.ended.begin(), here.ended.end());
      all.suspended.rays.insert(
        all.suspended.rays.end(), here.suspended.rays.begin(), here.suspended.rays.end());
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
