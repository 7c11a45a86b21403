// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What ranks have of the inputs: whether it stays where it is, and how rank 0 gets it.
#include "AvailableMemory.h"
#include "GatheredData.h"
#include "MeshHalo.h"
#include "RanksInternals.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace filters
{

using namespace ranks;

namespace
{

/// `because`: where it is known.
std::string absenceOf(std::size_t rank, std::size_t ranks, const std::string& because = "")
{
  return "Rank " + std::to_string(rank) + " of " + std::to_string(ranks) +
    " does not say what it has of the input" + because +
    ", so it is not known whether rank 0 has all of it. "
    "See what that rank has reported, or use one process.";
}

std::vector<std::string> namesOf(const FilterRanks::Inputs& inputs)
{
  return inputs.arrays ? inputs.arrays() : std::vector<std::string>();
}

/// What this rank sends of an input.
std::vector<char> packed(int input, const FilterRanks::Inputs& own)
{
  return input == 0 ? packedData(own.data, namesOf(own)) : packedData(own.bodies, {});
}

bool hasAll(const std::vector<std::string>& names, const std::vector<std::string>& wanted)
{
  return std::all_of(wanted.begin(), wanted.end(),
    [&](const std::string& name)
    { return std::find(names.begin(), names.end(), name) != names.end(); });
}

} // namespace

//------------------------------------------------------------------------------
bool ranks::canStay(const std::vector<InputsOfRank>& ofRanks, double maxCells)
{
  const std::vector<Holdings> holdings = holdingsOf(0, ofRanks);
  const std::vector<std::size_t> ranks = ranksWithMore(holdings);
  std::int32_t kinds = ofRanks[0].pieceKinds; // that all of them are
  for (const InputsOfRank& ofRank : ofRanks)
  {
    kinds &= ofRank.pieceKinds;
  }
  double cells = 0;
  for (const std::size_t rank : ranks)
  {
    cells += holdings[rank][1];
  }
  cells /= (kinds & (PieceOfImage | PiecesOfBlocks)) != 0 ? cellsOfImageForOne : 1;
  return kinds != NoPieces && ranks.size() > 1 && cells > maxCells;
}

//------------------------------------------------------------------------------
std::vector<char> ranks::dataMessage(int input, const FilterRanks::Inputs& own)
{
  try
  {
    return messageOf(ShortMessage{ Data, 1 }, packed(input, own));
  }
  catch (const std::exception& problem)
  {
    const std::string text = problem.what();
    return messageOf(ShortMessage{ Data, 0 }, { text.begin(), text.end() });
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> ranks::collect(int input, const FilterRanks::Inputs& own,
  const std::vector<InputsOfRank>& ofRanks,
  const std::vector<std::unique_ptr<RankChannel>>& channels)
{
  const std::vector<Holdings> holdings = holdingsOf(static_cast<std::size_t>(input), ofRanks);
  if (hasRank0All(holdings))
  {
    return nullptr;
  }
  const std::vector<std::size_t> ranks = ranksWithMore(holdings);
  for (const std::size_t rank : ranks)
  {
    if (rank > 0)
    {
      channels[rank - 1]->send(messageOf(ShortMessage{ GiveData, input }));
    }
  }
  std::vector<std::vector<char>> parts;
  for (const std::size_t rank : ranks)
  {
    if (rank == 0)
    {
      parts.push_back(packed(input, own));
      continue;
    }
    std::vector<char> message = channels[rank - 1]->ReceiveOne(Data);
    if (message.empty())
    {
      throw std::runtime_error(absenceOf(rank, holdings.size()));
    }
    const bool hasData = read<ShortMessage>(message).number != 0;
    message.erase(message.begin(), message.begin() + sizeof(ShortMessage));
    if (!hasData)
    {
      throw std::runtime_error(std::string(message.begin(), message.end()));
    }
    parts.push_back(std::move(message));
  }
  double bytes = 0;
  for (const std::vector<char>& part : parts)
  {
    bytes += static_cast<double>(part.size());
  }
  // Datasets of the parts, and what they are joined to.
  requireMemory(2 * bytes, "To gather the data that the ranks have of the input on rank 0",
    "Use a coarser input.");
  return gatheredData(parts);
}

//------------------------------------------------------------------------------
vtkDataObject* FilterRanks::GetInput(int input, vtkDataObject* own) const
{
  vtkDataObject* gathered = this->Gathered[static_cast<std::size_t>(input)];
  return gathered && own ? gathered : own;
}

//------------------------------------------------------------------------------
FilterRanks::Inputs FilterRanks::Meeting::Gather(double maxCells)
{
  FilterRanks& of = this->Of;
  Inputs all = *this->Own;
  const std::vector<std::string> arrays = namesOf(*this->Own);
  const bool lacksArrays = of.Gathered[0] && !hasAll(of.Arrays, arrays);
  if (of.Inside && (!(of.Compared == of.Now && of.MostCells == maxCells) || lacksArrays))
  {
    of.Compared = of.Now;
    of.MostCells = maxCells;
    const auto needsOthers = [&of] { return of.InPieces || of.Gathered[0] || of.Gathered[1]; };
    const bool neededOthers = needsOthers();
    of.Gathered[0] = of.Gathered[1] = nullptr;
    of.Problem = this->FindAbsent();
    of.InPieces = of.Problem.empty() && this->CanStayInPieces(maxCells);
    of.Arrays = arrays;
    try
    {
      for (int input = of.InPieces ? 1 : 0; input < 2 && of.Problem.empty(); ++input)
      {
        const auto n = static_cast<std::size_t>(input);
        of.Gathered[n] = collect(input, *this->Own, this->InputsOfAll(), of.Inside->Channels);
      }
    }
    catch (const std::bad_alloc&)
    {
      of.Problem =
        "Rank 0 has not enough memory for the data that the other ranks have of the input, and it "
        "makes the medium alone. Use a coarser input.";
    }
    catch (const std::exception& problem)
    {
      of.Problem = problem.what();
    }
    of.Gatherings += neededOthers || needsOthers() ? 1 : 0;
  }
  if (!of.Problem.empty())
  {
    throw std::runtime_error(of.Problem);
  }
  all.data = of.GetInput(0, all.data);
  all.bodies = of.GetInput(1, all.bodies);
  return all;
}

//------------------------------------------------------------------------------
std::string FilterRanks::Meeting::FindAbsent() const
{
  const auto& channels = this->Of.Inside->Channels;
  for (std::size_t n = 0; n < channels.size(); ++n)
  {
    const std::optional<HelloMessage>& guest = channels[n]->Guest;
    if (!guest || !isOf(this->Of.Now, *guest))
    {
      const bool isKnown = !guest && this->HasFailed(*channels[n]);
      return absenceOf(n + 1, channels.size() + 1,
        isKnown ? std::string(" because its ") + channels[n]->Failure->name + " has failed" : "");
    }
  }
  return "";
}

//------------------------------------------------------------------------------
const std::vector<InputsOfRank>& FilterRanks::Meeting::InputsOfAll() const
{
  if (this->OfAll.empty()) // it takes looking at all points
  {
    this->OfAll.push_back(inputsOfRank(this->Own->data, this->Own->bodies));
    for (const auto& channel : this->Of.Inside->Channels)
    {
      this->OfAll.push_back(channel->Guest ? channel->Guest->inputs : InputsOfRank());
    }
  }
  return this->OfAll;
}

//------------------------------------------------------------------------------
bool FilterRanks::Meeting::CanStayInPieces(double maxCells) const
{
  return canStay(this->InputsOfAll(), maxCells);
}

//------------------------------------------------------------------------------
bool FilterRanks::Meeting::AreTooFew(double maxCells) const
{
  if (!this->Of.Inside || this->Of.RequestedPart != Part::Piece || !this->FindAbsent().empty())
  {
    return false;
  }
  return !hasRank0All(holdingsOf(0, this->InputsOfAll())) && !this->CanStayInPieces(maxCells);
}

} // namespace filters
