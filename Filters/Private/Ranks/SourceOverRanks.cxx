// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Makes the medium of data that stay on several ranks. All of them run this.
#include "Ranks/SourceOverRanks.h"

#include "Common/FieldFromImage.h"
#include "Common/Threads.h"
#include "Input/FlatData.h"
#include "Input/RefractivityOfImage.h"
#include "Ranks/BoundaryOverRanks.h"
#include "Ranks/ChoiceOverRanks.h"
#include "Sources/MediumMaker.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

using Pieces = std::vector<PiecesOfRanks::Piece>;

/// Reports progress. Ends all ranks if rank 0 is cancelled.
void reach(const Ranks& ranks, const MediumMaker& maker, double done)
{
  ranks.agree(
    [&]
    {
      if (ranks.rank() == 0 && maker.progress() && !maker.progress()(done))
      {
        throw std::runtime_error("It was stopped."); // not reported
      }
    });
}

std::unique_ptr<MeshPiece> makePieceOfMeshes(
  ChoiceOverRanks& choice, MeshCache& cache, Tally& tally)
{
  std::vector<Leaf>& leaves = choice.flow.leaves;
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(),
                 [](const Leaf& leaf) { return dimensionOf(leaf.data) < 3; }),
    leaves.end());
  MeshLeaves prepared;
  if (choice.data && !leaves.empty())
  {
    prepared = preparedLeaves(choice.flow, tally);
  }
  cache.piece = PieceMesh::of(prepared, cache.piece);
  return std::make_unique<MeshPiece>(prepared, cache.piece, Copies::Neighbours);
}

std::unique_ptr<ImagePiece> makePieceOfImage(MediumMaker& maker, const ChoiceOverRanks& choice,
  const PiecesOfRanks::Piece& of, vtkDataObject* bodies, Tally& tally)
{
  vtkNew<vtkImageData> refractivity;
  tally = convertImage(choice.flow,
    maker.settings.DoublePrecision ? Numbers::Doubles : Numbers::Differences, refractivity);
  mergeMasks(refractivity);
  ImagePiece::Extents extents{ of.whole, of.own };
  for (const std::size_t high : { 1, 3, 5 })
  {
    if (choice.flow.leaves[0].ofCells)
    {
      --extents.whole[high];
      --extents.own[high];
    }
  }
  return std::make_unique<ImagePiece>(
    refractivity, extents, turnedBack(bodies, gridFrom(refractivity).direction), maker.threads());
}

/// The properties of all pieces.
struct Sum
{
  DataPiece::Facts facts{};
  Tally tally{};
  std::vector<std::uint64_t> keys; // of the ranks' meshes
};

Sum sumUp(const Ranks& ranks, const DataPiece& piece, const Tally& tally)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Sum sum;
  sum.facts.bounds = { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  sum.facts.content = { 1, 0, { infinity, infinity, infinity } };
  sum.facts.direction = schlieren::Grid{}.direction;
  ranks.allGather(
    [&]
    {
      const DataPiece::Facts facts = piece.facts();
      Ranks::Bytes bytes;
      put(facts.cells, bytes);
      put(facts.bounds, bytes);
      put(facts.content, bytes);
      put(tally, bytes);
      put(piece.meshKey(), bytes);
      return bytes;
    },
    [&](Reader& reader)
    {
      const auto cells = reader.Get<std::int64_t>();
      const auto bounds = reader.Get<schlieren::Box>();
      const auto content = reader.Get<CellTree::Content>();
      sum.tally += reader.Get<Tally>();
      sum.keys.push_back(reader.Get<std::uint64_t>());
      if (cells > 0)
      {
        sum.facts.cells += cells;
        extend(sum.facts.bounds, bounds);
        extend(sum.facts.content, content);
      }
    });
  return sum;
}

MadeOverRanks make(MediumMaker& maker, const Ranks& ranks, vtkDataObject* data,
  vtkDataObject* bodies, std::uint64_t number, MeshCache& cache)
{
  bool isImage = false;
  Pieces pieces;
  {
    PiecesOfRanks found(ranks, data, arraysOf(maker.choice().settings));
    isImage = found.kind() == PiecesOfRanks::Kind::Image;
    pieces = found.withGhostCells();
  }
  reach(ranks, maker, 0.2);
  ChoiceOverRanks choice = chooseOverRanks(ranks, maker, pieces, isImage);
  std::unique_ptr<DataPiece> piece;
  Tally tally;
  ranks.agree(
    [&]
    {
      if (isImage && choice.data)
      {
        piece = makePieceOfImage(maker, choice, pieces[0], bodies, tally);
      }
      else
      {
        piece = makePieceOfMeshes(choice, cache, tally);
      }
    });
  Sum sum = sumUp(ranks, *piece, tally);
  reach(ranks, maker, 0.6);
  MadeOverRanks made{ nullptr, sum.tally, choice.label };
  if (sum.facts.cells > 0)
  {
    BoundaryOverRanks of = findBoundary(ranks, *piece, isImage, std::move(sum.keys),
      static_cast<Outside>(maker.settings.Outside), bodies, cache, sum.facts);
    made.source = std::make_shared<SamplesOverRanks>(ranks, number, std::move(piece), sum.facts,
      std::move(of.boundary), of.ambient, isImage ? nullptr : cache.lattices, maker.threads());
  }
  return made;
}

} // namespace

MadeOverRanks makeOverRanks(MediumMaker& maker, const Ranks& ranks, vtkDataObject* data,
  vtkDataObject* bodies, std::uint64_t number, MeshCache& cache)
{
  MadeOverRanks made;
  vtkSMPTools::LocalScope(
    loopsWith(maker.threads()), [&] { made = make(maker, ranks, data, bodies, number, cache); });
  return made;
}

} // namespace filters
