// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a ProcessTracer and the RayWorkers of other ranks send each other.
#pragma once

#include "Rays/Cpu/CpuTracer.h"
#include "Rays/Cuda/CudaTracer.h"
#include "Rays/Ranks/RayWorker.h"
#include "Rays/Tiles.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace schlieren
{

/// The numbers of the arrays that a task points to.
enum ArrayNumber : std::size_t
{
  samplesOfTask,
  solidOfTask,
  leavesOfTask,
  rootsOfTask,
  childrenOfTask,
  gasDistancesOfTask,
  arraysOfTask ///< how many
};

/// Calls visit(number of the array, pointer to where the task needs it).
template <class Real, class Visit>
void forArrays(RayTask<Real>& task, const Visit& visit)
{
  visit(samplesOfTask, task.medium.samples);
  visit(solidOfTask, task.medium.solid);
  visit(leavesOfTask, task.medium.leaves);
  visit(rootsOfTask, task.medium.finder.roots);
  visit(childrenOfTask, task.medium.finder.children);
  visit(gasDistancesOfTask, task.medium.gasDistances);
}

/// The beginning of a message with a piece of an array, which follows. Pieces come in their order; so neither side has a
/// large array twice.
struct ArrayMessage
{
  std::uint32_t kind = RayWorker::Array;
  std::uint32_t array = 0;
  std::uint64_t version = 0;
  std::uint64_t first = 0; ///< byte of the array
  std::uint64_t bytes = 0; ///< of the array
};
constexpr std::size_t bytesOfArrayPiece = std::size_t{ 16 } << 20;

/// Calls send(message) for the pieces of an array, at least one. `head`: its number and version.
template <class Send>
void sendPieces(ArrayMessage head, const void* array, std::size_t bytes, const Send& send)
{
  head.bytes = bytes;
  do
  {
    const std::size_t count =
      std::min(bytes - static_cast<std::size_t>(head.first), bytesOfArrayPiece);
    std::vector<char> message(sizeof(head) + count);
    std::memcpy(message.data(), &head, sizeof(head));
    if (count > 0)
    {
      std::memcpy(
        message.data() + sizeof(head), static_cast<const char*>(array) + head.first, count);
    }
    send(std::move(message));
    head.first += count;
  } while (head.first < bytes);
}

/// What the first bytes of a request to trace say.
struct TraceHead
{
  std::uint32_t kind = RayWorker::Trace;
  std::uint32_t bytesOfReal = 0;
};

/// What a worker needs to trace tiles, besides the arrays. The passes follow.
template <class Real>
struct TraceMessage
{
  TraceHead head{ RayWorker::Trace, sizeof(Real) };
  std::int64_t first = 0, end = 0; ///< tiles of all ranks
  Simd simd = Simd::None;          ///< of the CPU
  std::uint64_t passes = 0;        ///< how many
  RayTask<Real> task{};            ///< its pointers mean nothing
  /// Versions of the arrays, and from their beginnings to where the task's pointers point, in values.
  std::array<std::uint64_t, arraysOfTask> versions{};
  std::array<std::int64_t, arraysOfTask> offsets{};
};
constexpr std::int64_t nowhere =
  std::numeric_limits<std::int64_t>::min(); // the offset of a null pointer

/// The beginning of an answer with rays: of those of each tile, row by row.
struct RaysHead
{
  std::int64_t crossed = 0;
  double worstDrift = 0;
};

static_assert(std::is_trivially_copyable_v<TraceMessage<float>>);
static_assert(std::is_trivially_copyable_v<TraceMessage<double>>);
static_assert(std::is_trivially_copyable_v<RayExit>);

static_assert(std::is_trivially_copyable_v<Pass>);

template <class Head>
std::vector<char> messageOf(const Head& head, std::size_t bytesBehind = 0)
{
  std::vector<char> message(sizeof(Head) + bytesBehind);
  std::memcpy(message.data(), &head, sizeof(Head));
  return message;
}

/// False where the message is too short for it.
template <class Head>
bool read(const std::vector<char>& message, Head& head)
{
  if (message.size() < sizeof(Head))
  {
    return false;
  }
  std::memcpy(&head, message.data(), sizeof(Head));
  return true;
}

template <class Real>
std::vector<char> messageOf(
  const TraceMessage<Real>& request, const std::vector<PlacedPass>& passes)
{
  std::vector<char> message = messageOf(request, passes.size() * sizeof(Pass));
  char* to = message.data() + sizeof(request);
  for (const PlacedPass& placed : passes)
  {
    std::memcpy(to, &placed.pass, sizeof(Pass));
    to += sizeof(Pass);
  }
  return message;
}

/// The passes of a request that has been read. False where the message is too short for them.
template <class Real>
bool readPasses(
  const std::vector<char>& message, const TraceMessage<Real>& request, std::vector<Pass>& passes)
{
  const std::size_t bytes = message.size() - sizeof(request);
  if (request.passes == 0 || bytes / sizeof(Pass) != request.passes)
  {
    return false;
  }
  passes.resize(static_cast<std::size_t>(request.passes));
  std::memcpy(passes.data(), message.data() + sizeof(request), bytes);
  return true;
}

/// Calls visit(first ray of all, how many) for the rows of tiles.
template <class Visit>
void forRowsOf(const Passes& passes, const Tiles& tiles, const Visit& visit)
{
  for (std::int64_t number = tiles.first; number < tiles.end; number += tiles.step)
  {
    const TileOfPass tile = passes.tile(number);
    for (std::int64_t row = tile.low; row < tile.low + tile.rows; ++row)
    {
      visit(static_cast<std::size_t>(tile.of.firstRay + row * tile.of.pass.columns + tile.left),
        static_cast<std::size_t>(tile.columns));
    }
  }
}

} // namespace schlieren
