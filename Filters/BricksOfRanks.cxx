// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BricksOfRanks.h"

#include "BrickWorker.h"
#include "PieceWorker.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <numeric>

namespace filters
{

std::uint64_t newNumberOfPieces()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

/// To sample its lattice in one's own cells is 1.
double BricksOfRanks::costOf(const schlieren::BrickTask& task) { return task.hasEdges ? 4 : 1; }

std::vector<std::size_t> BricksOfRanks::balanced(std::vector<double> work,
  const std::vector<double>& costs, const std::vector<std::size_t>& preferred)
{
  constexpr double unevenness = 1.1;
  const double all =
    std::accumulate(work.begin(), work.end(), 0.) + std::accumulate(costs.begin(), costs.end(), 0.);
  const double most = unevenness * all / static_cast<double>(work.size());
  std::vector<std::size_t> found(costs.size(), work.size());
  for (std::size_t n = 0; n < costs.size(); ++n)
  {
    double& ofPreferred = work[preferred[n]];
    if (ofPreferred + costs[n] <= most)
    {
      found[n] = preferred[n];
      ofPreferred += costs[n];
    }
  }
  for (std::size_t n = 0; n < costs.size(); ++n)
  {
    if (found[n] == work.size())
    {
      const auto least = std::min_element(work.begin(), work.end());
      found[n] = static_cast<std::size_t>(least - work.begin());
      *least += costs[n];
    }
  }
  return found;
}

void BricksOfRanks::begin(const schlieren::BrickRules& rules) const
{
  std::vector<char> bytes;
  put(rules, bytes);
  if (bytes == this->Begun)
  {
    return;
  }
  std::vector<char> request = pieceRequest(PieceWorker::BeginBricks);
  put(this->Number, request);
  put(this->ArePieces, request);
  put(this->Mesh, request);
  put(rules, request);
  put(this->known().facts(), request);
  putAll(this->known().rangesOfFields(), request);
  this->known().boundary().put(request);
  Messages requests(this->Ranks->Count(), request);
  if (!this->ArePieces)
  {
    requests[0].clear(); // it makes its bricks itself
  }
  readersOf(this->Ranks->Request(std::move(requests))); // throws what has gone wrong
  this->Begun = bytes;
}

std::vector<std::vector<char>> BricksOfRanks::make(
  const schlieren::BrickRules& rules, const Tasks& tasks, const MakeHere& makeHere) const
{
  this->begin(rules);
  const std::vector<std::size_t> makers = this->deal(tasks);
  const std::vector<Contribution> contributions = this->contributions(tasks, makers);
  Messages requests(this->Ranks->Count());
  std::vector<std::size_t> here;
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    if (makers[n] == 0 && !this->ArePieces)
    {
      here.push_back(n);
      continue;
    }
    std::vector<char>& request = requests[makers[n]];
    if (request.empty())
    {
      request = pieceRequest(PieceWorker::MakeBricks);
      put(this->Number, request);
    }
    const Contribution& of = contributions[n];
    put(TaskOfPieces{ tasks[n], static_cast<std::uint32_t>(of.ofOthers.size()),
          static_cast<std::uint32_t>(of.before), of.hasOwn ? 1u : 0u },
      request);
    putAll(of.fields, request);
    for (const std::vector<char>& samples : of.ofOthers)
    {
      putAll(samples, request);
    }
  }
  const Messages answers = this->Ranks->Request(std::move(requests), [&] { makeHere(here); });
  std::deque<Reader> readers = readersOf(answers);
  Messages bricks(tasks.size());
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    if (!answers[makers[n]].empty())
    {
      bricks[n] = readers[makers[n]].GetAll<std::vector<char>>();
    }
  }
  return bricks;
}

} // namespace filters
