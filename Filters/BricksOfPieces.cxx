// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BricksOfPieces.h"

#include "LatticeDistances.h"
#include "PieceWorker.h"

#include <algorithm>
#include <deque>

namespace filters
{

bool BricksOfPieces::mayHave(std::size_t rank, const schlieren::BrickTask& task) const
{
  return meet(boxAround(task.lattice, 0), this->BoundsOfRanks[rank]);
}

std::vector<std::size_t> BricksOfPieces::deal(const Tasks& tasks) const
{
  std::vector<double> work(this->Ranks->Count(), 0), costs;
  std::vector<std::size_t> preferred;
  for (const schlieren::BrickTask& task : tasks)
  {
    costs.push_back(costOf(task));
    const std::vector<unsigned char>& shares = this->Known.box(task.box).shares;
    for (std::size_t rank = 0; rank < work.size(); ++rank)
    {
      work[rank] += shares[rank] > 0 ? 1 : 0; // to sample what it has
    }
    const auto most = std::max_element(shares.begin(), shares.end());
    preferred.push_back(static_cast<std::size_t>(most - shares.begin()));
  }
  return balanced(std::move(work), costs, preferred);
}

std::vector<BricksOfRanks::Contribution> BricksOfPieces::contributions(
  const Tasks& tasks, const std::vector<std::size_t>& makers) const
{
  const std::size_t ranks = this->Ranks->Count();
  std::vector<std::vector<schlieren::Lattice>> wanted(ranks);
  std::vector<std::vector<std::size_t>> others(tasks.size()); // than the maker
  std::vector<Contribution> found;
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    found.push_back({ this->Known.box(tasks[n].box).fields });
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      if (this->mayHave(rank, tasks[n]))
      {
        found[n].hasOwn = found[n].hasOwn || rank == makers[n];
        found[n].before += rank < makers[n] ? 1 : 0;
        if (rank != makers[n])
        {
          others[n].push_back(rank);
          wanted[rank].push_back(tasks[n].lattice);
        }
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
  std::deque<Reader> readers = readersOf(answers);
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    for (const std::size_t rank : others[n])
    {
      found[n].ofOthers.push_back(readers[rank].GetAll<std::vector<char>>());
    }
  }
  return found;
}

} // namespace filters
