// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "GasBoundary.h"
#include "LatticesOfMesh.h"
#include "PieceBoundaries.h"
#include "PieceRanks.h"
#include "PieceWorker.h"
#include "RefractivityModels.h"

#include "Medium/MediumSource.h"

#include <array>
#include <cstdint>
#include <map>
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
  std::shared_ptr<LatticesOfMesh> lattices; // null: as yet there has been one step only
};

/**
 * The refractivity of meshes, of an image or of adaptive blocks that are spread over several ranks, for the tree on rank 0.
 * Each rank keeps its own cells or points and samples them; what rank 0 has is the boundary of all: of the faces of each
 * rank's cells those that no other rank's face meets; of an image or of blocks the faces around points or cells without gas.
 */
class PiecesSource : public schlieren::MediumSource
{
public:
  /// Makes the pieces of the data that the ranks have. `bodies`: may be null. `outside`: of meshes; images have none.
  /// `hasFields`: those that tint, too. `kept`: of another source, which may be of the same meshes. Throws
  /// std::runtime_error with a message for the user.
  PiecesSource(std::shared_ptr<PieceRanks> ranks, vtkDataObject* bodies, Outside outside,
    bool hasFields, PiecesMesh kept = {}, const WorkProgress& progress = WorkProgress());
  const PiecesMesh& mesh() const { return this->Mesh; }

  bool hasGas() const { return this->Cells > 0; }
  bool meetsBodies() const { return this->Boundary->hasBodiesIn(this->Bounds); }
  const Tally& tally() const { return this->Valid; }
  const std::string& warning() const { return this->Warning; }
  const std::string& label() const { return this->Label; } // of the arrays; see Source::label

  schlieren::Box bounds() const override { return this->Bounds; }
  double ambient() const override { return this->Ambient; }
  std::array<double, 3> voxelShape() const override { return this->VoxelShape; }
  std::array<double, 9> direction() const override { return this->Direction; }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

  int fields() const override { return static_cast<int>(this->RangesOfFields.size()); }
  /// Of a box whose contents are not prepared, that of all data.
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override;
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

  bool isRemote() const override { return true; }
  void prepareContents(const std::vector<schlieren::Box>& boxes) const override;
  void prepareSamples(const std::vector<schlieren::Lattice>& lattices) const override;

private:
  using BoxKey = std::array<double, 6>;
  using LatticeKey = std::array<double, 9>;
  static BoxKey keyOf(const schlieren::Box& box);
  static LatticeKey keyOf(const schlieren::Lattice& lattice);

  void findBoundary(vtkDataObject* bodies, Outside outside, PiecesMesh kept,
    std::vector<std::uint64_t> keys, const WorkProgress& progress);
  void makeBoundary(
    BoundaryOfMeshes of, vtkDataObject* bodies, Outside outside, const WorkProgress& progress);
  void makeBoundary(
    BoundaryOfAmr of, vtkDataObject* bodies, Outside outside, const WorkProgress& progress);
  void makeBoundary(BoundaryOfImage of, vtkDataObject* bodies, const WorkProgress& progress);
  std::vector<std::vector<char>> request(std::vector<std::vector<char>> requests) const;
  std::vector<char> request(PieceWorker::Kind kind) const;
  std::vector<unsigned char> hold(const std::vector<Point>& places) const;
  template <class Item, class BoxOf, class Take>
  void askAbout(PieceWorker::Kind kind, const std::vector<Item>& items, const BoxOf& boxOf,
    const Take& take) const;

  std::shared_ptr<PieceRanks> Ranks;
  std::uint64_t Number;
  std::vector<schlieren::Box> BoundsOfRanks; // low > high: it has no cells
  std::vector<std::int64_t> CellsOfRanks;    // -1: it has not the arrays
  std::int64_t Cells = 0;
  schlieren::Box Bounds{};
  std::array<double, 3> VoxelShape{ 1, 1, 1 };
  std::array<double, 9> Direction{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  CellTree::Content All{};
  std::array<double, 3> Reach{}; // see DataPiece::Summary
  std::shared_ptr<const GasBoundary> Boundary;
  PiecesMesh Mesh{};
  std::vector<FieldRange> RangesOfFields;
  double Ambient = 0;
  Tally Valid;
  std::string Warning, Label;

  // What has been prepared.
  struct Known
  {
    PieceWorker::Content content;
    std::vector<FieldRange> fields;
  };
  mutable std::map<BoxKey, Known> Contents;
  mutable std::map<LatticeKey, DataPiece::Samples> Samples;
};

} // namespace filters
