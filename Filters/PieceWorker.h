// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FieldTints.h"
#include "HeldPiece.h"
#include "ImagePiece.h"
#include "KeptOfMesh.h"
#include "MeshHalo.h"
#include "MeshPiece.h"
#include "RefractivityModels.h"
#include "RefractivitySource.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;
class vtkRefractiveIndex;

namespace filters
{

struct FieldsOfBlocks;

/// Answers what a PiecesSource, on rank 0, requests of a rank about its piece of the data.
class PieceWorker
{
public:
  /// The first bytes of each message. Other messages on the same channel have other numbers.
  enum Kind : std::uint32_t
  {
    Instant = 200, // between two time steps
    GiveArrays,    // that the rank has
    TakeArrays,    // of all ranks
    Outline,       // the surfaces of its meshes, the extents of its grids, the places of its blocks
    Levels,        // of the blocks of all ranks
    GiveBlocks,    // its blocks of some images, which it has no more
    TakeBlocks,    // from other ranks
    Renumber,      // all images
    CellsAround,   // those of another rank
    AddCells,      // of other ranks, around its own
    Copies,        // cells around points that others have, too
    Make,          // the piece, with others' copies
    Boundary,      // of the piece, or its values alone
    Contents,      // of boxes
    Hold,          // whether its cells do, of places
    Sample,        // lattices
    BeginBricks,   // rules and facts, see BrickWorker
    MakeBricks,    // of its own samples and of others'
    Adopt,         // a piece that another worker of the rank holds
    Forget,        // the piece
    Answer
  };
  /// What data that stay are.
  enum DataKind : std::uint32_t
  {
    Meshes,
    Image,
    Blocks
  };
  enum State : std::int32_t
  {
    Done,
    Failed, // a message for the user follows
    Lacking // the same, where the rank has not the arrays
  };

  /// With the properties of `self`, which must outlive this.
  explicit PieceWorker(vtkRefractiveIndex* self);
  ~PieceWorker();

  /// How many threads it may have.
  int GetThreads() const;

  /// What the rank has of the input until the piece is made, and of the time step before; may be null.
  void SetData(vtkDataObject* data, vtkDataObject* earlier = nullptr);
  void ReleasePiece();
  void Release(); // the piece, and what is kept for the next one

  static bool IsFor(std::uint32_t kind) { return kind >= Instant && kind < Answer; }

  /// The answer to a request. Throws nothing: errors are answers.
  std::vector<char> Respond(const std::vector<char>& request);

  /// What is sent with Contents.
  struct Content
  {
    CellTree::Content cells;
    std::array<unsigned char, 9> holds; // see GasBoundary::testedPlaces
  };

private:
  /// Of all ranks.
  struct Ranges
  {
    std::vector<FieldMean::Range> ofModel;
    std::vector<FieldMean::Range> ofFields; // that tint
  };

  void Respond(std::uint32_t kind, Reader& request, std::vector<char>& answer);
  void GiveOutline(Reader& request, std::vector<char>& answer);
  void GiveCopies(Reader& request, std::vector<char>& answer) const;
  void MakeFields(Reader& request);
  void MakePiece(Reader& request, std::vector<char>& answer);
  std::unique_ptr<const DataPiece> PieceOfParts(
    DataKind kind, Reader& request, Tally& tally, std::string& label);
  std::unique_ptr<const DataPiece> PieceOfMeshes(
    const std::vector<vtkSmartPointer<vtkDataSet>>& parts,
    const std::vector<std::uint32_t>& datasets, const Ranges& ranges,
    const std::shared_ptr<PieceMesh>& before, Tally& tally, std::string& label);
  std::unique_ptr<const DataPiece> PieceOfImage(vtkImageData* image, ImagePiece::Extents extents,
    vtkDataObject* bodies, const Ranges& ranges, Tally& tally, std::string& label) const;
  Source SourceOf(vtkDataObject* data, const std::vector<FieldMean::Range>& ranges) const;
  std::vector<FieldValues> FieldsOf(
    vtkDataObject* data, const Source& source, const std::vector<FieldMean::Range>& ranges) const;
  const DataPiece& PieceOf(Reader& request) const;
  void RequirePiece(std::uint64_t number) const;

  vtkRefractiveIndex* Self;
  vtkSmartPointer<vtkDataObject> Data; // Later, or what is between the two
  vtkDataObject* Later = nullptr;
  vtkDataObject* Earlier = nullptr;
  std::vector<Part> Parts;
  std::vector<filters::Outline> Outlines; // of them
  std::string Lacks;                      // what to say where the data have not the arrays
  FieldsOfBlocks& OwnFields();
  std::unique_ptr<FieldsOfBlocks> Fields; // until others' cells have come
  std::shared_ptr<KeptOfMesh> Kept;
  std::shared_ptr<HeldPiece> Held; // never null
};

/// A message that requests something, as yet without what.
std::vector<char> pieceRequest(PieceWorker::Kind kind);

} // namespace filters
