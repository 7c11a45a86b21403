// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/ChoiceOverRanks.h"

#include "Sources/MediumMaker.h"

#include "vtkDataSet.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace filters
{

namespace
{

using FieldRanges = std::vector<FieldMean::Range>;

/// Keeps layers, because data may have several layers in pieces of one.
const Flow asTheyAre;

void join(FieldRanges& all, const FieldRanges& more)
{
  all = all.empty() ? more : std::move(all);
  for (std::size_t n = 0; n < more.size(); ++n)
  {
    all.at(n) = { std::min(all[n][0], more[n][0]), std::max(all[n][1], more[n][1]) };
  }
}

vtkSmartPointer<vtkDataObject> dataOf(
  const std::vector<PiecesOfRanks::Piece>& pieces, bool areImages)
{
  if (areImages && !pieces.empty())
  {
    return pieces[0].data;
  }
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const PiecesOfRanks::Piece& piece : pieces)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), piece.data);
  }
  return blocks;
}

/// The part of a choice that is sent to all ranks.
struct Sent
{
  FieldRanges ofModel;
  std::string lacks; // message about what it lacks
};

/// Chooses from a rank's own pieces.
Sent chooseOwn(MediumMaker& maker, ChoiceOverRanks& choice)
{
  Sent own;
  try
  {
    choice.flow = chooseFlow(maker.settings, maker.known(), choice.data, &asTheyAre);
  }
  catch (const ArraysMissing& problem) // other ranks may have them
  {
    choice.data = nullptr;
    own.lacks = problem.what();
    return own;
  }
  if (const auto* mean = std::get_if<FieldMean>(&choice.flow.model))
  {
    own.ofModel = mean->rangesIn(choice.flow.leaves);
  }
  return own;
}

} // namespace

void shareArrays(const Ranks& ranks, MediumMaker& maker, vtkDataObject* own)
{
  if (ranks.count() == 1 || !isOpen(maker.settings))
  {
    return;
  }
  std::vector<FlowArray> all;
  ranks.allGather(
    [&]
    {
      std::vector<char> bytes;
      putArrays(flowArraysOf(dataSetsOf(own), true), bytes);
      return bytes;
    },
    [&](Reader& reader) { addArrays(all, getArrays(reader)); });
  maker.known().SetOfRanks(std::move(all));
}

ChoiceOverRanks chooseOverRanks(const Ranks& ranks, MediumMaker& maker,
  const std::vector<PiecesOfRanks::Piece>& pieces, bool areImages)
{
  ChoiceOverRanks choice;
  FieldRanges ofModel;
  std::string lacking;
  ranks.allGather(
    [&]
    {
      Sent own;
      if (!pieces.empty())
      {
        choice.data = dataOf(pieces, areImages);
        own = chooseOwn(maker, choice);
      }
      Ranks::Bytes bytes;
      putAll(own.ofModel, bytes);
      putAll(own.lacks, bytes);
      putAll(choice.flow.label, bytes);
      return bytes;
    },
    [&](Reader& reader)
    {
      join(ofModel, reader.GetAll<FieldRanges>());
      const auto lacks = reader.GetAll<std::string>();
      lacking = lacking.empty() ? lacks : lacking;
      const auto label = reader.GetAll<std::string>();
      choice.label = choice.label.empty() ? label : choice.label;
    });
  if (!lacking.empty() && choice.label.empty())
  {
    throw ArraysMissing(lacking);
  }
  if (auto* mean = std::get_if<FieldMean>(&choice.flow.model))
  {
    mean->setRanges(ofModel);
  }
  return choice;
}

} // namespace filters
