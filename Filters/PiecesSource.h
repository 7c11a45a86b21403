// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "BricksOfPieces.h"
#include "GasBoundary.h"
#include "PieceBoundaries.h"
#include "PieceRanks.h"
#include "PieceWorker.h"
#include "RefractivityModels.h"
#include "SamplesOfPieces.h"
#include "SourceOfRanks.h"

#include "Medium/MediumSource.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace filters
{

/// What of a PiecesSource depends on the meshes alone, and not on their values: it is kept from one time step to the next.
struct PiecesMesh
{
  std::vector<std::uint64_t>
    keys; // of bodies and Outside, and of the ranks' pieces; empty: nothing is kept
  std::shared_ptr<const GasBoundary> boundary;
  std::vector<Contribution> contributions; // of all ranks' values to those at the boundary's points
  std::array<double, 3> voxelShape;
  std::uint64_t number; // of this mesh; what other ranks keep of it has it, too
};

/**
 * The refractivity of meshes, of an image or of adaptive blocks that are spread over several ranks, for the tree on rank 0.
 * Each rank keeps its own cells or points and samples them. The boundary of all is found on rank 0, of the faces of each
 * rank's cells those that no other rank's face meets; of an image or of blocks the faces around points or cells without gas.
 * All ranks get it, and make the tree's bricks, see BricksOfPieces. Where it is too large for that, rank 0 makes them of what the
 * others have on their lattices.
 */
class PiecesSource : public schlieren::MediumSource, public SourceOfRanks
{
public:
  /// Makes the pieces of the data that the ranks have. `bodies`: may be null. `outside`: of meshes; images have none.
  /// `hasFields`: those that tint, too. `kept`: of another source, which may be of the same meshes. Throws
  /// std::runtime_error with a message for the user.
  PiecesSource(std::shared_ptr<PieceRanks> ranks, vtkDataObject* bodies, Outside outside,
    bool hasFields, PiecesMesh kept = {}, const WorkProgress& progress = WorkProgress());
  const PiecesMesh& mesh() const { return this->Mesh; }

  bool useRanks(const std::shared_ptr<PieceRanks>& ranks) const override;
  bool usesRanks(const PieceRanks& ranks) const override { return this->Ranks.get() == &ranks; }

  bool hasGas() const { return this->Cells > 0; }
  bool meetsBodies() const { return this->Boundary->hasBodiesIn(this->Facts.bounds); }
  const Tally& tally() const { return this->Valid; }
  const std::string& label() const { return this->Label; } // of the arrays; see Source::label

  schlieren::Box bounds() const override { return this->Facts.bounds; }
  double ambient() const override { return this->Facts.ambient; }
  std::array<double, 3> voxelShape() const override { return this->Facts.voxelShape; }
  std::array<double, 9> direction() const override { return this->Facts.direction; }
  Content contentOf(const schlieren::Box& box) const override
  {
    return this->Known->contentOf(box);
  }
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override
  {
    this->Known->sample(lattice, refractivity, places, distances);
  }

  int fields() const override { return static_cast<int>(this->RangesOfFields.size()); }
  /// Of a box whose contents are not prepared, that of all data.
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override
  {
    return this->Known->rangeOfField(field, box);
  }
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override
  {
    this->Known->sampleWithFields(lattice, refractivity, places, distances, values);
  }

  bool isRemote() const override { return true; }
  const schlieren::BrickMakers* makers() const override { return this->Bricks.get(); }
  void prepareContents(const std::vector<schlieren::Box>& boxes) const override;
  void prepareSamples(const std::vector<schlieren::Lattice>& lattices) const override;

private:
  void findBoundary(vtkDataObject* bodies, Outside outside, PiecesMesh kept,
    std::vector<std::uint64_t> keys, const WorkProgress& progress);
  void makeBoundary(BoundaryOfMeshes of, const std::vector<double>& values, vtkDataObject* bodies,
    Outside outside, const WorkProgress& progress);
  void makeBoundary(
    BoundaryOfAmr of, vtkDataObject* bodies, Outside outside, const WorkProgress& progress);
  void makeBoundary(BoundaryOfImage of, vtkDataObject* bodies, const WorkProgress& progress);
  std::vector<std::vector<char>> request(std::vector<std::vector<char>> requests) const;
  std::vector<char> request(PieceWorker::Kind kind) const;
  std::vector<unsigned char> hold(const std::vector<Point>& places) const;
  Content contentFrom(const schlieren::Box& box, const PieceWorker::Content& found) const;
  template <class Item, class BoxOf, class Take>
  void askAbout(PieceWorker::Kind kind, const std::vector<Item>& items, const BoxOf& boxOf,
    const Take& take) const;

  mutable std::shared_ptr<PieceRanks> Ranks;
  std::uint64_t Number;
  std::vector<schlieren::Box> BoundsOfRanks; // low > high: it has no cells
  std::vector<std::int64_t> CellsOfRanks;    // -1: it has not the arrays
  std::int64_t Cells = 0;
  SamplesOfPieces::Facts Facts;
  CellTree::Content All{};
  std::array<double, 3> Reach{}; // see DataPiece::Summary
  std::shared_ptr<const GasBoundary> Boundary;
  PiecesMesh Mesh{};
  std::vector<FieldRange> RangesOfFields;
  Tally Valid;
  std::string Label;
  std::unique_ptr<SamplesOfPieces> Known;       // what has been prepared
  std::unique_ptr<const BricksOfPieces> Bricks; // null: rank 0 makes them
};

} // namespace filters
