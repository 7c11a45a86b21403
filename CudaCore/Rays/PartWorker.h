// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/PartOfTree.h"
#include "Rays/DistributedRays.h"
#include "Rays/TaskArrays.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <tuple>
#include <vector>

namespace schlieren
{

/// What a RayWorker does with its part of a tree that several processes have parts of: it keeps it, answers questions about
/// it, and takes rays through it, which it hands on to the workers that have what comes next.
class PartWorker
{
public:
  /// The arrays must outlive it.
  explicit PartWorker(TaskArrays& arrays)
    : arrays_(arrays)
  {
  }

  /// Forgets the part.
  void clear();

  /// Does what a message of BrickChannels or of a DistributedTracer requests. False where it has not what that needs.
  bool answer(const std::vector<char>& message, Channel& channel, int threads);

  /// See RayWorker::advance(). Throws where there is no memory for what becomes of the rays, or something is wrong with them.
  bool advance(Channel& channel, Peers& peers, int threads);

  /// Of the trace that has begun last.
  std::uint64_t trace() const { return trace_; }
  /// Ends it here: its rays are forgotten.
  void endTrace();

private:
  /// Of one precision.
  template <class Real>
  struct Part
  {
    std::optional<PartOfTree<Real>> tree;
    BeginMessage<Real> request{}; ///< of the trace that is under way
    TravellingRays<Real> waiting; ///< likewise
  };
  template <class Real>
  Part<Real>& part()
  {
    return std::get<Part<Real>>(parts_);
  }
  template <class Real>
  void put(const BricksMessage& head, const std::vector<char>& message);
  template <class Real>
  bool find(
    const BricksMessage& head, const std::vector<char>& message, Channel& channel, int threads);
  template <class Real>
  bool begin(const std::vector<char>& message);
  bool take(const std::vector<char>& message);
  template <class Real>
  bool advancePart(Channel& channel, Peers& peers, int threads);

  TaskArrays& arrays_;
  std::tuple<Part<float>, Part<double>> parts_;
  std::uint64_t tree_ = 0; ///< 0: nothing, or not all of it
  std::uint64_t puts_ = 0; ///< messages with bricks of it

  std::uint64_t trace_ = 0;             ///< 0: none has begun
  std::uint32_t bytesOfReal_ = 0;       ///< of it; 0: it has ended
  std::vector<std::int32_t> addresses_; ///< of the owners
  std::int32_t taken_ = 0;              ///< messages of the first process since the last answer
  std::deque<std::vector<char>> early_; ///< from other workers, of a trace that has not begun here
};

} // namespace schlieren
