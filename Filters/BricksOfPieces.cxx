// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BricksOfPieces.h"

#include "BrickWorker.h"
#include "LatticeDistances.h"
#include "PieceWorker.h"

#include <algorithm>
#include <deque>

namespace filters
{

namespace
{

/// What takes about as long as sampling a lattice in one's own cells: to make a brick of it, and of one with walls.
constexpr double costOfBrick = 1, costOfEdges = 4;

/// By which a rank may have more to do than the mean, to make what it has the data of.
constexpr double unevenness = 1.1;

} // namespace

bool BricksOfPieces::mayHave(std::size_t rank, const schlieren::BrickTask& task) const
{
  return meet(boxAround(task.lattice, 0), this->BoundsOfRanks[rank]);
}

void BricksOfPieces::begin(const schlieren::BrickRules& rules) const
{
  std::vector<char> bytes;
  put(rules, bytes);
  if (bytes == this->Begun)
  {
    return;
  }
  std::vector<char> request = pieceRequest(PieceWorker::BeginBricks);
  put(this->Number, request);
  put(this->Mesh, request);
  put(rules, request);
  put(this->Known.facts(), request);
  putAll(this->Known.rangesOfFields(), request);
  this->Known.boundary().put(request);
  for (const std::vector<char>& answer :
    this->Ranks->Request(Messages(this->Ranks->Count(), request)))
  {
    readerOf(answer); // throws what has gone wrong
  }
  this->Begun = bytes;
}

/// Who makes each.
std::vector<std::size_t> BricksOfPieces::deal(const std::vector<schlieren::BrickTask>& tasks) const
{
  const std::size_t ranks = this->Ranks->Count();
  std::vector<double> work(ranks, 0);
  std::vector<double> costs;
  double all = 0;
  for (const schlieren::BrickTask& task : tasks)
  {
    costs.push_back(task.hasEdges ? costOfEdges : costOfBrick);
    all += costs.back();
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      const double toSample = this->Known.box(task.box).shares[rank] > 0 ? 1 : 0;
      work[rank] += toSample;
      all += toSample;
    }
  }
  const double most = unevenness * all / static_cast<double>(ranks);
  std::vector<std::size_t> makers(tasks.size(), ranks);
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    const std::vector<unsigned char>& shares = this->Known.box(tasks[n].box).shares;
    const auto best =
      static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
    if (work[best] + costs[n] <= most)
    {
      makers[n] = best;
      work[best] += costs[n];
    }
  }
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    if (makers[n] == ranks)
    {
      makers[n] =
        static_cast<std::size_t>(std::min_element(work.begin(), work.end()) - work.begin());
      work[makers[n]] += costs[n];
    }
  }
  return makers;
}

/// Of each lattice, in the order of the ranks.
std::vector<BricksOfPieces::Messages> BricksOfPieces::samplesOfOthers(
  const std::vector<schlieren::BrickTask>& tasks, const std::vector<std::size_t>& makers) const
{
  const std::size_t ranks = this->Ranks->Count();
  std::vector<std::vector<schlieren::Lattice>> wanted(ranks);
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      if (rank != makers[n] && this->mayHave(rank, tasks[n]))
      {
        wanted[rank].push_back(tasks[n].lattice);
      }
    }
  }
  Messages requests(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    if (!wanted[rank].empty())
    {
      requests[rank] = pieceRequest(PieceWorker::Sample);
      put(this->Number, requests[rank]);
      putAll(wanted[rank], requests[rank]);
    }
  }
  const Messages answers = this->Ranks->Request(std::move(requests));
  std::deque<Reader> readers;
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    readers.push_back(wanted[rank].empty() ? Reader(answers[rank]) : readerOf(answers[rank]));
  }
  std::vector<Messages> samples(tasks.size());
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      if (rank != makers[n] && this->mayHave(rank, tasks[n]))
      {
        samples[n].push_back(readers[rank].GetAll<std::vector<char>>());
      }
    }
  }
  return samples;
}

std::vector<std::vector<char>> BricksOfPieces::make(
  const schlieren::BrickRules& rules, const std::vector<schlieren::BrickTask>& tasks) const
{
  this->begin(rules);
  const std::size_t ranks = this->Ranks->Count();
  const std::vector<std::size_t> makers = this->deal(tasks);
  const std::vector<Messages> samples = this->samplesOfOthers(tasks, makers);
  Messages requests(ranks);
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    std::vector<char>& request = requests[makers[n]];
    if (request.empty())
    {
      request = pieceRequest(PieceWorker::MakeBricks);
      put(this->Number, request);
    }
    const SamplesOfPieces::KnownBox& box = this->Known.box(tasks[n].box);
    TaskOfPieces task{ tasks[n], box.content, static_cast<std::uint32_t>(samples[n].size()), 0,
      this->mayHave(makers[n], tasks[n]) ? 1u : 0u };
    for (std::size_t rank = 0; rank < makers[n]; ++rank)
    {
      task.othersBefore += this->mayHave(rank, tasks[n]) ? 1 : 0;
    }
    put(task, request);
    putAll(box.fields, request);
    for (const std::vector<char>& ofOther : samples[n])
    {
      putAll(ofOther, request);
    }
  }
  std::vector<bool> isMaker;
  for (const std::vector<char>& request : requests)
  {
    isMaker.push_back(!request.empty());
  }
  const Messages answers = this->Ranks->Request(std::move(requests));
  std::deque<Reader> readers;
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    readers.push_back(isMaker[rank] ? readerOf(answers[rank]) : Reader(answers[rank]));
  }
  Messages bricks;
  for (const std::size_t maker : makers)
  {
    bricks.push_back(readers[maker].GetAll<std::vector<char>>());
  }
  return bricks;
}

} // namespace filters
