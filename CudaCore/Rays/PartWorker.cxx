// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/PartWorker.h"

#include "Rays/Tracer.h"
#include "Schlieren.h"

#include <utility>

namespace schlieren
{

void PartWorker::clear()
{
  tree_ = 0;
  parts_ = {};
  endTrace();
}

void PartWorker::endTrace()
{
  bytesOfReal_ = 0;
  part<float>().waiting = {};
  part<double>().waiting = {};
}

bool PartWorker::answer(const std::vector<char>& message, Channel& channel, int threads)
{
  const std::uint32_t kind = RayWorker::kindOf(message);
  if (kind == RayWorker::Advance)
  {
    ++taken_;
    AdvanceMessage head;
    return read(message, head) && head.number == trace_ && take(message);
  }
  if (kind == RayWorker::BeginRays)
  {
    RequestHead head;
    read(message, head);
    return head.bytesOfReal == sizeof(float) ? begin<float>(message) : begin<double>(message);
  }
  BricksMessage head;
  if (!read(message, head))
  {
    return false;
  }
  const bool isSingle = head.bytesOfReal == sizeof(float);
  if (kind == RayWorker::PutBricks)
  {
    isSingle ? put<float>(head, message) : put<double>(head, message);
    return true;
  }
  return isSingle ? find<float>(head, message, channel, threads)
                  : find<double>(head, message, channel, threads);
}

template <class Real>
void PartWorker::put(const BricksMessage& head, const std::vector<char>& message)
{
  std::optional<PartOfTree<Real>>& tree = part<Real>().tree;
  const bool isFirst = head.number == 0;
  endTrace();
  if (isFirst)
  {
    arrays_.clear();
    clear();
    tree.emplace(head.layout);
  }
  const bool isNext = isFirst || (tree_ == head.tree && puts_ == head.number);
  tree_ = 0; // where there is no memory
  if (isNext && tree && tree->put(message.data() + sizeof(head), message.size() - sizeof(head)))
  {
    tree_ = head.tree;
    puts_ = head.number + 1;
  }
}

template <class Real>
bool PartWorker::find(
  const BricksMessage& head, const std::vector<char>& message, Channel& channel, int threads)
{
  if (tree_ != head.tree || !part<Real>().tree)
  {
    return false;
  }
  const PartOfTree<Real>& own = *part<Real>().tree;
  AdvancedMessage found;
  found.kind = RayWorker::Found;
  found.number = head.number;
  std::vector<char> answer = messageOf(found);
  if (head.kind == RayWorker::SumUp)
  {
    std::vector<LeafSums> sums;
    if (!own.sumUp(valuesFrom<LeafSegment>(sizeof(head), message), sums, threads))
    {
      return false;
    }
    append(sums, answer);
  }
  else
  {
    std::vector<char> samples;
    if (!own.fetch(valuesFrom<std::int32_t>(sizeof(head), message), samples))
    {
      return false;
    }
    append(samples, answer);
  }
  channel.send(std::move(answer));
  return true;
}

/// The rays that have come before, from other workers, wait from now on.
template <class Real>
bool PartWorker::begin(const std::vector<char>& message)
{
  endTrace();
  BeginMessage<Real> request;
  if (!read(message, request))
  {
    return false;
  }
  trace_ = request.head.number;
  if (!hasSimd(request.simd) || !arrays_.bind(request) || request.tree != tree_ ||
    !part<Real>().tree)
  {
    return false;
  }
  request.task.medium.samples = part<Real>().tree->samples().data() + request.firstSample;
  request.task.medium.gasDistances = part<Real>().tree->gasDistances().data() + request.firstSample;
  if (request.task.gradients.count > 0)
  {
    request.task.gradients.values =
      part<Real>().tree->gradientValues().data() + request.firstGradient;
  }
  part<Real>().request = request;
  part<Real>().waiting = TravellingRays<Real>(Carried::by(request.task));
  bytesOfReal_ = sizeof(Real);
  addresses_ = valuesFrom<std::int32_t>(sizeof(request), message);
  taken_ = 0;
  bool areTaken = true;
  for (const std::vector<char>& rays : std::exchange(early_, {}))
  {
    areTaken = take(rays) && areTaken;
  }
  return areTaken;
}

/// Rays of the trace that has begun last wait for advance(), those of a later one for its begin(), those of others are
/// forgotten.
bool PartWorker::take(const std::vector<char>& message)
{
  AdvanceMessage head;
  if (!read(message, head))
  {
    return false;
  }
  if (head.number > trace_)
  {
    early_.push_back(message);
  }
  if (head.number != trace_)
  {
    return true;
  }
  switch (bytesOfReal_)
  {
    case sizeof(float):
      return part<float>().waiting.read(message, sizeof(head)) == message.size();
    case sizeof(double):
      return part<double>().waiting.read(message, sizeof(head)) == message.size();
    default: // it has failed here
      return true;
  }
}

bool PartWorker::advance(Channel& channel, Peers& peers, int threads)
{
  bool hasReceived = false;
  for (std::vector<char> rays = peers.receive(); !rays.empty(); rays = peers.receive())
  {
    hasReceived = true;
    if (!take(rays))
    {
      throw Error("Another rank has sent rays that are not as many as it says.");
    }
  }
  const bool hasAdvanced =
    advancePart<float>(channel, peers, threads) || advancePart<double>(channel, peers, threads);
  return hasReceived || hasAdvanced;
}

/// False where no rays of this precision wait.
template <class Real>
bool PartWorker::advancePart(Channel& channel, Peers& peers, int threads)
{
  Part<Real>& here = part<Real>();
  if (here.waiting.size() == 0)
  {
    return false;
  }
  const BeginMessage<Real>& request = here.request;
  const Carried carried = here.waiting.carried;
  AdvancedRays<Real> advanced = advanceRays(request.task, request.pass,
    here.waiting.takeBack(raysAtOnce<Real>(carried)), threads, request.simd);

  std::vector<TravellingRays<Real>> toOwners(addresses_.size(), TravellingRays<Real>(carried));
  for (std::size_t number = 0; number < advanced.suspended.size(); ++number)
  {
    const Leaf<Real>& next = request.task.medium.leaves[advanced.suspended.rays[number].next];
    const auto owner = static_cast<std::size_t>(~next.brick);
    if (next.isResident() || owner >= toOwners.size())
    {
      throw Error("A ray has come to a leaf that nobody has.");
    }
    toOwners[owner].add(advanced.suspended, number);
  }
  AdvancedMessage head;
  head.number = trace_;
  head.taken = std::exchange(taken_, 0);
  const AdvanceMessage handOn{ RayWorker::Advance, sizeof(Real), trace_ };
  for (std::size_t owner = 1; owner < toOwners.size(); ++owner)
  {
    if (toOwners[owner].size() > 0)
    {
      std::vector<char> message = messageOf(handOn);
      toOwners[owner].write(message);
      head.handedOn.add({ 1, static_cast<std::int64_t>(message.size()),
        static_cast<std::int64_t>(toOwners[owner].size()) });
      peers.send(addresses_[owner], std::move(message));
    }
  }
  advanced.suspended = std::move(toOwners[0]); // the first process gets these with the ended ones
  channel.send(advanced.toMessage(head));
  return true;
}

} // namespace schlieren
