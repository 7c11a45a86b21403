// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays through a medium of which each process has a part. A process takes a ray as far as its own leaves reach, then
// hands on the ray's state (SuspendedRay), and the process that has the next leaf resumes. The arithmetic is that of a
// ray that is traced alone by one process, to the last bit.
#pragma once

#include "Medium/PartOfTree.h"
#include "Rays/TeamMessages.h"
#include "Rays/Tracer.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// Rays that have come to a process.
template <class Real>
struct TravellingRays
{
  std::vector<SuspendedRay<Real>> rays;

  std::size_t size() const { return rays.size(); }

  /// A ray that has not entered the grid yet.
  void begin(std::int64_t ray, std::int32_t leaf)
  {
    SuspendedRay<Real> state{};
    state.ray = ray;
    state.leaf = SuspendedRay<Real>::nowhere;
    state.next = leaf;
    rays.push_back(state);
  }

  /// The last ones, so many at most.
  TravellingRays takeBack(std::size_t most)
  {
    const auto left = static_cast<std::ptrdiff_t>(rays.size() - std::min(most, rays.size()));
    TravellingRays taken{ { rays.begin() + left, rays.end() } };
    rays.resize(static_cast<std::size_t>(left));
    return taken;
  }

  void write(std::vector<char>& message) const
  {
    const char* first = reinterpret_cast<const char*>(rays.data());
    message.insert(message.end(), first, first + rays.size() * sizeof(SuspendedRay<Real>));
  }

  /// From a message, behind its first bytes. Where they end; 0 where there are too few.
  std::size_t read(const std::vector<char>& message, std::size_t at, std::size_t count)
  {
    const std::size_t bytes = count * sizeof(SuspendedRay<Real>);
    if (at > message.size() || count > message.size() || message.size() - at < bytes)
    {
      return 0;
    }
    rays.resize(count);
    if (bytes > 0)
    {
      std::memcpy(rays.data(), message.data() + at, bytes);
    }
    return at + bytes;
  }
};

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

/// The beginning of a message with rays for a worker; see TilesMessage. The rays follow. The samples and maps are those of
/// the tree that the worker has been given.
template <class Real>
struct AdvanceMessage
{
  struct Head : TilesHead
  {
    std::int64_t rays = 0;
    std::uint64_t tree = 0;
    std::int64_t firstSample = 0; ///< from the first of all to where the task's pointers point
  };
  Head head{};
  Simd simd = Simd::None;
  Pass pass{};
  RayTask<Real> task{}; ///< its pointers mean nothing
  std::array<std::uint64_t, arraysOfTask> versions{};
  std::array<std::int64_t, arraysOfTask> offsets{};
};
static_assert(std::is_trivially_copyable_v<AdvanceMessage<float>>);
static_assert(std::is_trivially_copyable_v<AdvanceMessage<double>>);
static_assert(std::is_trivially_copyable_v<SuspendedRay<float>>);

struct EndedRay
{
  std::int64_t ray;
  RayExit exit;
};

/// The beginning of a worker's answer to SumUp and FetchBricks, behind which comes what is found, and to Advance, behind which come the ended rays and the suspended ones.
struct AdvancedMessage
{
  std::uint32_t kind = RayWorker::Advanced; ///< or Found
  std::uint64_t number = 0;
  std::uint64_t ended = 0, suspended = 0;
  double worstDrift = 0;
};

/// What has become of rays on one process.
template <class Real>
struct AdvancedRays
{
  std::vector<EndedRay> ended;
  TravellingRays<Real> suspended; ///< that have come to other processes' leaves
  double worstDrift = 0;

  std::vector<char> toMessage(std::uint64_t number) const;
  bool fromMessage(const std::vector<char>& message);
};

/// Takes rays as far as the medium is here. `simd` must be one that the processor has.
template <class Real>
AdvancedRays<Real> advanceRays(
  const RayTask<Real>& task, const Pass& pass, TravellingRays<Real> rays, int threads, Simd simd);

} // namespace schlieren
