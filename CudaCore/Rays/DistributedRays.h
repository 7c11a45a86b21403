// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays through a medium of which each process has a part. A process takes a ray as far as its own leaves reach, then
// hands on the ray's state (SuspendedRay), and the process that has the next leaf resumes. The arithmetic is that of a
// ray that is traced alone by one process, to the last bit.
#pragma once

#include "Medium/PartOfTree.h"
#include "Rays/SamplesElsewhere.h"
#include "Rays/TeamMessages.h"
#include "Rays/Tracer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace schlieren
{

/// What goes with a ray beside its state.
struct Carried
{
  std::size_t fields = 0; ///< what it has gathered of each of so many
  bool hasSteps = false;  ///< a StepElsewhere

  template <class Real>
  static Carried by(const RayTask<Real>& task)
  {
    return { static_cast<std::size_t>(task.gradients.count), samplesBeyond(task.kernel) };
  }
};

/// Rays that have come to a process.
template <class Real>
struct TravellingRays
{
  Carried carried;
  std::vector<SuspendedRay<Real>> rays;
  std::vector<float> gathered;            ///< ray by ray
  std::vector<StepElsewhere<Real>> steps; ///< likewise

  TravellingRays() = default;
  explicit TravellingRays(const Carried& with)
    : carried(with)
  {
  }

  std::size_t size() const { return rays.size(); }
  float* ofRay(std::size_t number) { return gathered.data() + carried.fields * number; }
  const float* ofRay(std::size_t number) const { return gathered.data() + carried.fields * number; }

  /// A ray that has not entered the grid yet.
  void begin(std::int64_t ray, std::int32_t leaf)
  {
    SuspendedRay<Real> state{};
    state.ray = ray;
    state.leaf = SuspendedRay<Real>::nowhere;
    state.next = leaf;
    rays.push_back(state);
    fill();
  }
  void add(const SuspendedRay<Real>& ray, const float* sums, const StepElsewhere<Real>* step)
  {
    rays.push_back(ray);
    gathered.insert(gathered.end(), sums, sums + carried.fields);
    if (carried.hasSteps)
    {
      steps.push_back(*step);
    }
  }
  void add(const TravellingRays& from, std::size_t number)
  {
    add(from.rays[number], from.ofRay(number), from.steps.data() + number);
  }
  void add(const TravellingRays& more)
  {
    rays.insert(rays.end(), more.rays.begin(), more.rays.end());
    gathered.insert(gathered.end(), more.gathered.begin(), more.gathered.end());
    steps.insert(steps.end(), more.steps.begin(), more.steps.end());
  }

  /// The last ones, so many at most.
  TravellingRays takeBack(std::size_t most)
  {
    const std::size_t left = rays.size() - std::min(most, rays.size());
    const auto takeFrom = [left](auto& values, std::size_t perRay)
    {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(perRay * left);
      std::decay_t<decltype(values)> taken(first, values.end());
      values.erase(first, values.end());
      return taken;
    };
    TravellingRays taken(carried);
    taken.rays = takeFrom(rays, 1);
    taken.gathered = takeFrom(gathered, carried.fields);
    taken.steps = takeFrom(steps, carried.hasSteps ? 1 : 0);
    return taken;
  }

  /// Of those that have not entered the grid only the numbers of the rays and of their first leaves.
  void write(std::vector<char>& message) const;

  /// More rays, from a message, from some byte on. Where they end; 0 where there are fewer than it says.
  std::size_t read(const std::vector<char>& message, std::size_t at);

private:
  /// As much for each ray as there is to be, and no more.
  void fill()
  {
    gathered.resize(carried.fields * rays.size(), 0.f);
    steps.resize(carried.hasSteps ? rays.size() : 0);
  }
};

/// A channel sends messages of up to 64 kB without waiting for the other process, which may be sending, too. So many rays
/// fit into one, with what has become of them.
template <class Real>
constexpr std::size_t raysAtOnce(const Carried& carried)
{
  const std::size_t bytes = sizeof(SuspendedRay<Real>) + carried.fields * sizeof(float) +
    (carried.hasSteps ? sizeof(StepElsewhere<Real>) : 0);
  return std::max<std::size_t>(1, (60000 - 512) / bytes);
}

/// The beginning of a message with bricks of a tree for a worker, as DeliveredBricks has them, with segments to be
/// summed up in these, or with numbers of bricks.
struct BricksMessage
{
  std::uint32_t kind = RayWorker::PutBricks; ///< or SumUp, or FetchBricks
  std::uint32_t bytesOfReal = 0;
  std::uint64_t number =
    0; ///< of the message: with bricks of this tree, 0 the first; of what is requested
  std::uint64_t tree = 0;
  BrickLayout layout{};
};

/// A number that no other call returns.
std::uint64_t newNumber();

/// What a worker needs to take rays through its part of the medium, once for each trace; see TilesMessage. The samples and
/// maps are those of the tree that it has been given. Behind it come the addresses of all owners, for Peers.
template <class Real>
struct BeginMessage
{
  RequestHead head{ RayWorker::BeginRays, sizeof(Real), 0 };
  std::uint64_t tree = 0;
  std::int64_t firstSample = 0;   ///< from the first of all to where the task's pointers point
  std::int64_t firstGradient = 0; ///< likewise, of fields
  Simd simd = Simd::None;
  Pass pass{};
  RayTask<Real> task{}; ///< its pointers mean nothing
  std::array<std::uint64_t, arraysOfTask> versions{};
  std::array<std::int64_t, arraysOfTask> offsets{};
};

/// The beginning of a message with rays for a worker, from the first process or from another worker. The rays follow.
using AdvanceMessage = RequestHead;

static_assert(std::is_trivially_copyable_v<BeginMessage<float>>);
static_assert(std::is_trivially_copyable_v<BeginMessage<double>>);
static_assert(std::is_trivially_copyable_v<SuspendedRay<float>>);

struct EndedRay
{
  std::int64_t ray;
  RayExit exit;
};

/// Messages with rays.
struct RayTraffic
{
  std::int64_t messages = 0, bytes = 0;
  std::int64_t states = 0; ///< of rays, to workers

  void add(const RayTraffic& more)
  {
    messages += more.messages;
    bytes += more.bytes;
    states += more.states;
  }
};

/// The beginning of a worker's answer to SumUp and FetchBricks, behind which comes what is found, or of what becomes of
/// rays, behind which come the ended rays and those that have come to the first process's part.
struct AdvancedMessage
{
  std::uint32_t kind = RayWorker::Advanced; ///< or Found
  std::int32_t taken = 0; ///< messages with rays from the first process since the last answer
  std::uint64_t number = 0;
  std::uint64_t ended = 0;
  double worstDrift = 0;
  RayTraffic handedOn{}; ///< to other workers
};

/// What has become of rays on one process.
template <class Real>
struct AdvancedRays
{
  explicit AdvancedRays(const Carried& carried)
    : suspended(carried)
  {
  }

  std::vector<EndedRay> ended;
  std::vector<float> gathered;    ///< of these, ray by ray
  TravellingRays<Real> suspended; ///< that have come to other processes' leaves
  double worstDrift = 0;

  void end(const EndedRay& ray, const float* sums)
  {
    ended.push_back(ray);
    gathered.insert(gathered.end(), sums, sums + suspended.carried.fields);
  }
  void add(const AdvancedRays& more)
  {
    ended.insert(ended.end(), more.ended.begin(), more.ended.end());
    gathered.insert(gathered.end(), more.gathered.begin(), more.gathered.end());
    suspended.add(more.suspended);
    worstDrift = std::max(worstDrift, more.worstDrift);
  }

  std::vector<char> toMessage(AdvancedMessage head) const;
  bool fromMessage(const std::vector<char>& message);
};
static_assert(sizeof(EndedRay) <= sizeof(SuspendedRay<float>)); // see raysAtOnce

/// Takes rays as far as the medium is here. `simd` must be one that the processor has.
template <class Real>
AdvancedRays<Real> advanceRays(
  const RayTask<Real>& task, const Pass& pass, TravellingRays<Real> rays, int threads, Simd simd);

} // namespace schlieren
