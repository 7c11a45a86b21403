// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BricksOfOneRank.h"

#include "ForEach.h"

#include <stdexcept>

namespace filters
{

namespace
{

SamplesOfPieces::Facts factsOf(const schlieren::MediumSource& source)
{
  SamplesOfPieces::Facts facts;
  facts.bounds = source.bounds();
  facts.ambient = source.ambient();
  facts.voxelShape = source.voxelShape();
  facts.direction = source.direction();
  facts.content = source.contentOf(facts.bounds);
  facts.dependsOnLattice = source.dependsOnLattice();
  return facts;
}

std::vector<schlieren::MediumSource::FieldRange> rangesOfFields(
  const schlieren::MediumSource& source, const schlieren::Box& box)
{
  std::vector<schlieren::MediumSource::FieldRange> ranges;
  for (int field = 0; field < source.fields(); ++field)
  {
    ranges.push_back(source.rangeOfField(field, box));
  }
  return ranges;
}

} // namespace

BricksOfOneRank::BricksOfOneRank(std::shared_ptr<PieceRanks> ranks, std::uint64_t mesh,
  const schlieren::MediumSource& source, std::shared_ptr<const GasBoundary> boundary,
  Sampler sampler)
  : BricksOfRanks(std::move(ranks), newNumberOfPieces(), mesh, false)
  , Source(source)
  , Known(factsOf(source), rangesOfFields(source, source.bounds()), std::move(boundary))
  , SamplesOn(std::move(sampler))
{
}

std::vector<std::vector<char>> BricksOfOneRank::make(
  const schlieren::BrickRules& rules, const Tasks& tasks, const MakeHere& makeHere) const
{
  try
  {
    return BricksOfRanks::make(rules, tasks, makeHere);
  }
  catch (const std::runtime_error&) // of a rank; what is wrong here will be so again, alone
  {
    this->HasFailed = true;
    return Messages(tasks.size());
  }
}

/// Those without walls are made here, as long as that is not too much: their samples are larger than what comes of them.
std::vector<std::size_t> BricksOfOneRank::deal(const Tasks& tasks) const
{
  std::vector<double> work(this->Ranks->Count(), 0), costs;
  std::vector<std::size_t> preferred;
  std::size_t next = 0;
  for (const schlieren::BrickTask& task : tasks)
  {
    work[0] += 1; // to sample it
    costs.push_back(costOf(task));
    preferred.push_back(task.hasEdges ? 1 + next++ % (work.size() - 1) : 0);
  }
  return balanced(std::move(work), costs, preferred);
}

std::vector<BricksOfRanks::Contribution> BricksOfOneRank::contributions(
  const Tasks& tasks, const std::vector<std::size_t>& makers) const
{
  std::vector<Contribution> found(tasks.size());
  forEach(tasks.size(), this->Ranks->GetThreads(),
    [&](std::size_t n)
    {
      if (makers[n] > 0)
      {
        found[n] = { rangesOfFields(this->Source, tasks[n].box), { {} }, 1 };
        this->SamplesOn(tasks[n].lattice).Put(found[n].ofOthers[0]);
      }
    });
  return found;
}

} // namespace filters
