// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/SamplesOverRanks.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Calls work(i) for i < count in so many threads; 0: one per core. Several threads may call it at
/// once, unlike vtkSMPTools, whose list of threads such calls corrupt.
template <class Work>
void forEach(std::size_t count, int threads, const Work& work)
{
  schlieren::parallelFor(static_cast<std::int64_t>(count), 1, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        work(static_cast<std::size_t>(i));
      }
    });
}

/// Returns whether two boxes have a point in common.
bool meet(const schlieren::Box& a, const schlieren::Box& b)
{
  bool meet = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    meet = meet && a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis];
  }
  return meet;
}

} // namespace

void extend(schlieren::Box& box, const schlieren::Box& by)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::min(box.low[axis], by.low[axis]);
    box.high[axis] = std::max(box.high[axis], by.high[axis]);
  }
}

void extend(CellTree::Content& content, const CellTree::Content& by)
{
  if (by.lowest <= by.highest)
  {
    const bool isFirst = content.lowest > content.highest;
    content.lowest = isFirst ? by.lowest : std::min(content.lowest, by.lowest);
    content.highest = isFirst ? by.highest : std::max(content.highest, by.highest);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    content.cellSize[axis] = std::min(content.cellSize[axis], by.cellSize[axis]);
  }
}

SamplesOverRanks::SamplesOverRanks(const Ranks& ranks, std::uint64_t number,
  std::unique_ptr<const DataPiece> piece, const DataPiece::Facts& facts,
  std::shared_ptr<const GasBoundary> boundary, double ambient,
  std::shared_ptr<LatticeCache> lattices, int threads)
  : PieceSource(std::move(piece), std::move(boundary), ambient, std::move(lattices), facts)
  , AllRanks(ranks)
  , Number(number)
  , Own(this->piece().facts())
  , Threads(threads)
  , Whole(this->contentWith(facts.bounds, { facts.content, { 1, 1, 1, 1, 1, 1, 1, 1, 1 } }))
{
}

SamplesOverRanks::BoxKey SamplesOverRanks::keyOf(const schlieren::Box& box)
{
  return { box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2] };
}

SamplesOverRanks::LatticeKey SamplesOverRanks::keyOf(const schlieren::Lattice& lattice)
{
  const auto& [first, spacing, points] = lattice;
  return { first[0], first[1], first[2], spacing[0], spacing[1], spacing[2],
    static_cast<double>(points[0]), static_cast<double>(points[1]),
    static_cast<double>(points[2]) };
}

schlieren::MediumSource::Content SamplesOverRanks::contentWith(
  const schlieren::Box& box, const OwnContent& found) const
{
  return this->contentFrom(
    box, [&](std::size_t n, const Point&) { return found.holds[n] != 0; },
    [&] { return found.cells; });
}

SamplesOverRanks::OwnContent SamplesOverRanks::ownContentOf(const schlieren::Box& box) const
{
  OwnContent own;
  if (this->Own.cells > 0 && meet(box, this->Own.bounds))
  {
    own.cells = this->piece().contentOf(box);
    const std::array<Point, 9> tested = GasBoundary::testedPlaces(box, this->bounds());
    for (std::size_t n = 0; n < tested.size(); ++n)
    {
      own.holds[n] = this->piece().holds(tested[n]) ? 1 : 0;
    }
  }
  return own;
}

void SamplesOverRanks::OwnContent::add(const OwnContent& other)
{
  extend(this->cells, other.cells);
  for (std::size_t place = 0; place < this->holds.size(); ++place)
  {
    this->holds[place] = this->holds[place] | other.holds[place];
  }
}

std::vector<char> SamplesOverRanks::ownContentsOf(const std::vector<schlieren::Box>& boxes) const
{
  std::vector<OwnContent> own(boxes.size());
  forEach(
    boxes.size(), this->Threads, [&](std::size_t n) { own[n] = this->ownContentOf(boxes[n]); });
  std::vector<char> bytes;
  putAll(own, bytes);
  return bytes;
}

void SamplesOverRanks::prepareContents(const std::vector<schlieren::Box>& boxes) const
{
  std::vector<OwnContent> all(boxes.size());
  this->AllRanks.allGather([&] { return this->ownContentsOf(boxes); },
    [&](Reader& reader)
    {
      const auto own = reader.GetAll<std::vector<OwnContent>>();
      for (std::size_t n = 0; n < all.size(); ++n)
      {
        all[n].add(own.at(n));
      }
    });
  this->Boxes.clear();
  std::vector<Content*> known;
  for (const schlieren::Box& box : boxes)
  {
    known.push_back(&this->Boxes[keyOf(box)]);
  }
  forEach(boxes.size(), this->Threads,
    [&](std::size_t n) { *known[n] = this->contentWith(boxes[n], all[n]); });
}

/// Writes, for each rank, the samples of its lattices.
std::vector<std::vector<char>> SamplesOverRanks::ownSamplesOn(
  const std::vector<schlieren::Lattice>& lattices) const
{
  std::vector<std::vector<char>> ofLattices(lattices.size()), forRanks(this->AllRanks.count());
  forEach(lattices.size(), this->Threads,
    [&](std::size_t n)
    {
      if (this->Own.cells > 0)
      {
        PieceSamples::Of(this->piece(), lattices[n]).Put(ofLattices[n]);
      }
    });
  for (std::size_t n = 0; n < lattices.size(); ++n)
  {
    putAll(ofLattices[n], forRanks[n % forRanks.size()]);
  }
  return forRanks;
}

void SamplesOverRanks::prepareSamples(const std::vector<schlieren::Lattice>& lattices) const
{
  const std::size_t ranks = this->AllRanks.count();
  std::vector<Ranks::Bytes> forRanks;
  this->AllRanks.agree([&] { forRanks = this->ownSamplesOn(lattices); });
  // Defers errors until the last collective, at which others would wait.
  std::vector<Ranks::Bytes> ofRanks;
  for (std::size_t root = 0; root < ranks; ++root)
  {
    std::vector<Ranks::Bytes> gathered = this->AllRanks.gather(forRanks[root], root);
    Ranks::Bytes().swap(forRanks[root]);
    if (root == this->AllRanks.rank())
    {
      ofRanks = std::move(gathered);
    }
  }
  this->Samples.clear();
  for (const Ranks::Bytes& bytes : ofRanks)
  {
    Reader reader(bytes);
    for (std::size_t n = this->AllRanks.rank(); n < lattices.size(); n += ranks)
    {
      const auto ofLattice = reader.GetAll<Ranks::Bytes>();
      PieceSamples& samples = this->Samples[keyOf(lattices[n])];
      if (!ofLattice.empty())
      {
        Reader own(ofLattice);
        samples.Add(PieceSamples::Get(own, static_cast<std::size_t>(lattices[n].size())));
      }
    }
  }
}

schlieren::MediumSource::Content SamplesOverRanks::contentOf(const schlieren::Box& box) const
{
  const bool isAll = box.low == this->bounds().low && box.high == this->bounds().high;
  return isAll ? this->Whole : this->Boxes.at(keyOf(box));
}

/// Copies what has been prepared. `found`: may be null.
void SamplesOverRanks::sampleGas(const schlieren::Lattice& lattice, double* refractivity,
  unsigned char* found, CellsOfLattice*) const
{
  const PieceSamples& samples = this->Samples.at(keyOf(lattice));
  std::fill_n(refractivity, static_cast<std::size_t>(lattice.size()), 0.);
  std::copy(samples.values.begin(), samples.values.end(), refractivity);
  if (found)
  {
    std::copy(samples.found.begin(), samples.found.end(), found);
  }
}

bool SamplesOverRanks::sampleGasIn(
  const CellsOfLattice&, const schlieren::Lattice& lattice, double* refractivity) const
{
  this->sampleGas(lattice, refractivity, nullptr, nullptr);
  return true;
}

std::vector<std::vector<char>> SamplesOverRanks::makeShare(
  const schlieren::BrickRules& rules, const std::vector<schlieren::BrickRequest>& requests) const
{
  const auto makeOf = [&](const auto& maker) {
    return maker.makeShare(requests, this->AllRanks.rank(), this->AllRanks.count(), this->Threads);
  };
  std::vector<std::vector<char>> made = rules.bytesOfReal == sizeof(float)
    ? makeOf(schlieren::BrickMaker<float>(*this, rules))
    : makeOf(schlieren::BrickMaker<double>(*this, rules));
  this->Samples.clear();
  return made;
}

std::vector<char> SamplesOverRanks::answerBricks(Reader& request) const
{
  const auto rules = request.Get<schlieren::BrickRules>();
  const auto requests = request.GetAll<std::vector<schlieren::BrickRequest>>();
  std::vector<char> answer;
  for (const std::vector<char>& brick : this->makeShare(rules, requests))
  {
    putAll(brick, answer);
  }
  return answer;
}

std::vector<std::vector<char>> SamplesOverRanks::make(
  const schlieren::BrickRules& rules, const std::vector<schlieren::BrickRequest>& requests) const
{
  if (!this->Used)
  {
    throw std::runtime_error(
      "The ranks that have the data do not work for this image. Update the filter again.");
  }
  std::vector<char> message;
  put(requestOfBricks, message);
  put(this->Number, message);
  put(rules, message);
  putAll(requests, message);
  std::vector<std::vector<char>> made;
  for (const std::vector<char>& answer :
    this->Used->request(message, [&] { made = this->makeShare(rules, requests); }))
  {
    Reader reader(answer);
    for (std::vector<char>& brick : made)
    {
      auto other = reader.GetAll<std::vector<char>>();
      if (brick.empty())
      {
        brick = std::move(other);
      }
    }
  }
  return made;
}

} // namespace filters
