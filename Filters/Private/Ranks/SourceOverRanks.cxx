// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Makes the medium of data that stay on several ranks. All of them run this.
#include "Ranks/SourceOverRanks.h"
#include "Common/Threads.h"

#include "Amr/AmrFaces.h"
#include "Cells/MeshKey.h"
#include "Common/FieldFromImage.h"
#include "Input/FlatData.h"
#include "Input/RefractivityOfImage.h"
#include "Input/RefractivitySource.h"
#include "Ranks/PiecesOfRanks.h"
#include "Sources/FieldTints.h"
#include "Sources/ImagePiece.h"
#include "Sources/MediumMaker.h"
#include "Sources/MeshPiece.h"
#include "Sources/PreparedLeaves.h"

#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

using namespace filters;

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr schlieren::MediumSource::FieldRange nowhere{ 1, 0 };

/// Keeps layers, because data may have several layers in pieces of one.
const Source asTheyAre;

/// Makes a source together with all other ranks.
class Maker
{
public:
  Maker(MediumMaker& maker, const Ranks& ranks, bool hasFields, KeptOverRanks& kept)
    : Of(maker)
    , All(ranks)
    , HasFields(hasFields)
    , Kept(kept)
  {
  }

  MadeOverRanks make(vtkDataObject* data, vtkDataObject* bodies, std::uint64_t number);

private:
  void reach(double done);
  void chooseArrays();
  void makePiece(vtkDataObject* bodies);
  void makePieceOfMeshes();
  void makePieceOfImage(vtkDataObject* bodies);
  void sumUp();
  void findBoundary(vtkDataObject* bodies);
  void makeBoundary(BoundaryOfMeshes of, const std::vector<double>& values, vtkDataObject* bodies);
  void makeBoundary(BoundaryOfImage of, vtkDataObject* bodies);
  std::vector<unsigned char> hold(const std::vector<Point>& places) const;

  MediumMaker& Of;
  const Ranks& All;
  const bool HasFields;
  KeptOverRanks& Kept;

  std::vector<PiecesOfRanks::Piece> Pieces;
  bool IsImage = false;
  vtkSmartPointer<vtkDataObject> Data; // of Pieces; null: no data
  Source Chosen;
  std::vector<FieldMean::Range> OfModel, OfFields; // ranges on all ranks
  std::unique_ptr<DataPiece> Piece;
  SamplesOverRanks::Facts Facts;
  std::int64_t Cells = 0;
  std::vector<std::uint64_t> Keys; // see KeptOverRanks
  std::shared_ptr<const GasBoundary> Boundary;
  MadeOverRanks Made;
};

std::vector<FieldMean::Range> joinedRanges(
  std::vector<FieldMean::Range> a, const std::vector<FieldMean::Range>& b)
{
  if (a.empty())
  {
    return b;
  }
  for (std::size_t n = 0; n < b.size(); ++n)
  {
    a.at(n) = { std::min(a[n][0], b[n][0]), std::max(a[n][1], b[n][1]) };
  }
  return a;
}

/// Selects values at some boundary points from those of all ranks.
std::vector<double> valuesOf(
  const std::vector<Contribution>& points, const std::vector<double>& values)
{
  std::vector<double> found;
  for (const Contribution& point : points)
  {
    found.push_back(values[static_cast<std::size_t>(point.point)]);
  }
  return found;
}

/// Reports progress. Ends all ranks if rank 0 is cancelled.
void Maker::reach(double done)
{
  this->All.agree(
    [&]
    {
      if (this->All.rank() == 0)
      {
        if (this->Of.progress() && !this->Of.progress()(done))
        {
          throw std::runtime_error("It was stopped."); // not reported
        }
      }
    });
}

/// Chooses arrays, and finds the ranges on all ranks of fields that are relative to them.
void Maker::chooseArrays()
{
  const auto ofRanks = this->All.allGather(
    [&]
    {
      Ranks::Bytes bytes;
      std::vector<FieldMean::Range> ofModel, ofFields;
      std::string lacks;
      if (!this->Pieces.empty())
      {
        if (this->IsImage)
        {
          this->Data = this->Pieces[0].data;
        }
        else
        {
          vtkNew<vtkMultiBlockDataSet> blocks;
          for (const PiecesOfRanks::Piece& piece : this->Pieces)
          {
            blocks->SetBlock(blocks->GetNumberOfBlocks(), piece.data);
          }
          this->Data = blocks;
        }
        try
        {
          this->Chosen = chooseSource(this->Of.settings, this->Of.known(), this->Data, &asTheyAre);
        }
        catch (const ArraysMissing& problem) // other ranks may have them
        {
          lacks = problem.what();
          this->Data = nullptr;
        }
        if (const auto* mean = std::get_if<FieldMean>(&this->Chosen.model); mean && this->Data)
        {
          ofModel = mean->rangesIn(this->Chosen.leaves);
        }
        if (this->Data && this->HasFields)
        {
          for (const RangeOfField& field : rangesOfFields(this->Of.settings, this->Data))
          {
            lacks = lacks.empty() ? field.lacks : lacks;
            ofFields.push_back(field.range);
          }
        }
      }
      putAll(ofModel, bytes);
      putAll(ofFields, bytes);
      putAll(this->Chosen.label, bytes);
      putAll(lacks, bytes);
      return bytes;
    });
  std::string lacking;
  for (const Ranks::Bytes& bytes : ofRanks)
  {
    Reader reader(bytes);
    this->OfModel = joinedRanges(this->OfModel, reader.GetAll<std::vector<FieldMean::Range>>());
    this->OfFields = joinedRanges(this->OfFields, reader.GetAll<std::vector<FieldMean::Range>>());
    const auto label = reader.GetAll<std::string>();
    this->Made.label = this->Made.label.empty() ? label : this->Made.label;
    const auto lacks = reader.GetAll<std::string>();
    lacking = lacking.empty() ? lacks : lacking;
  }
  const bool hasAllFields = std::all_of(this->OfFields.begin(), this->OfFields.end(),
    [](const FieldMean::Range& range) { return range[0] <= range[1]; });
  if (!lacking.empty() && (this->Made.label.empty() || !hasAllFields))
  {
    throw ArraysMissing(lacking);
  }
}

void Maker::makePieceOfMeshes()
{
  std::vector<vtkSmartPointer<vtkDataSet>> leaves;
  std::vector<std::uint32_t> datasets;
  std::vector<std::vector<vtkSmartPointer<vtkDataSet>>> leavesOfFields(this->OfFields.size());
  const bool isSmooth = this->Of.settings.isSmooth();
  if (this->Data)
  {
    Source& source = this->Chosen;
    source.leaves.erase(std::remove_if(source.leaves.begin(), source.leaves.end(),
                          [](const Leaf& leaf) { return dimensionOf(leaf.data) < 3; }),
      source.leaves.end());
    const CellValues cellValues = isSmooth ? CellValues::Known : CellValues::Averaged;
    const std::vector<FieldValues> fields = this->OfFields.empty() || source.leaves.empty()
      ? std::vector<FieldValues>()
      : fieldValues(this->Of.settings, this->Data, source, this->OfFields);
    if (!source.leaves.empty())
    {
      std::shared_ptr<const SharedPoints> shared;
      std::vector<const Source*> others;
      std::transform(fields.begin(), fields.end(), std::back_inserter(others),
        [](const FieldValues& field) { return &field.source; });
      leaves = preparedLeaves(source, cellValues, this->Made.tally, shared, others);
      for (std::size_t number = 0; number < fields.size(); ++number)
      {
        Tally notReported;
        leavesOfFields[number] =
          preparedLeaves(fields[number].source, cellValues, notReported, shared);
      }
    }
    // Keeps joined datasets together, whose number may differ between ranks.
    const bool areApart = leaves.size() == source.leaves.size();
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
    {
      const auto piece = std::find_if(this->Pieces.begin(), this->Pieces.end(),
        [&](const PiecesOfRanks::Piece& of) { return of.data == source.leaves[leaf].input; });
      datasets.push_back(areApart && piece != this->Pieces.end() ? piece->dataset : 0);
    }
  }
  auto piece = std::make_unique<MeshPiece>(leaves,
    isSmooth ? CellTree::Reconstruction::Smooth : CellTree::Reconstruction::Linear,
    std::exchange(this->Kept.piece, nullptr), std::move(datasets));
  this->Kept.piece = piece->mesh();
  for (const auto& ofField : leavesOfFields)
  {
    piece->addField(ofField);
  }
  this->Piece = std::move(piece);
}

void Maker::makePieceOfImage(vtkDataObject* bodies)
{
  auto* image = vtkImageData::SafeDownCast(this->Data);
  vtkNew<vtkImageData> refractivity;
  this->Made.tally = convertImage(this->Chosen,
    this->Of.settings.DoublePrecision ? Numbers::Doubles : Numbers::Differences, refractivity);
  mergeMasks(refractivity);
  ImagePiece::Extents extents{ this->Pieces[0].whole, this->Pieces[0].own };
  for (const std::size_t high : { 1, 3, 5 })
  {
    if (this->Chosen.leaves[0].ofCells)
    {
      --extents.whole[high];
      --extents.own[high];
    }
  }
  const int threads = this->Of.threads();
  auto piece = std::make_unique<ImagePiece>(
    refractivity, extents, turnedBack(bodies, gridFrom(refractivity).direction), threads);
  if (!this->OfFields.empty())
  {
    forFieldImages(
      this->Of, image, refractivity, threads,
      [&](std::size_t, vtkImageData* field) { piece->addField(field, threads); }, this->OfFields);
  }
  this->Piece = std::move(piece);
}

void Maker::makePiece(vtkDataObject* bodies)
{
  if (auto* mean = std::get_if<FieldMean>(&this->Chosen.model))
  {
    mean->setRanges(this->OfModel);
  }
  if (this->IsImage && this->Data)
  {
    this->makePieceOfImage(bodies);
  }
  else
  {
    this->makePieceOfMeshes();
  }
}

/// Reduces the properties of all pieces.
void Maker::sumUp()
{
  const auto ofRanks = this->All.allGather(
    [&]
    {
      const DataPiece::Summary summary = this->Piece->summary();
      Ranks::Bytes bytes;
      put(summary, bytes);
      put(this->Made.tally, bytes);
      put(this->Piece->meshKey(), bytes);
      for (int field = 0; summary.cells > 0 && field < this->Piece->fields(); ++field)
      {
        put(this->Piece->rangeOfField(field, summary.bounds), bytes);
      }
      return bytes;
    });
  this->Made.tally = {};
  this->Facts.content = { 1, 0, { infinity, infinity, infinity } };
  this->Facts.bounds = { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  this->Facts.fields.assign(this->OfFields.size(), nowhere);
  for (const Ranks::Bytes& bytes : ofRanks)
  {
    Reader reader(bytes);
    const auto summary = reader.Get<DataPiece::Summary>();
    this->Made.tally += reader.Get<Tally>();
    this->Keys.push_back(reader.Get<std::uint64_t>());
    if (summary.cells > 0)
    {
      for (schlieren::MediumSource::FieldRange& range : this->Facts.fields)
      {
        extend(range, reader.Get<schlieren::MediumSource::FieldRange>());
      }
      extend(this->Facts.bounds, summary.bounds);
      extend(this->Facts.content, summary.content);
      this->Cells += summary.cells;
    }
  }
  this->Made.hasGas = this->Cells > 0;
}

std::vector<unsigned char> Maker::hold(const std::vector<Point>& places) const
{
  std::vector<unsigned char> are(places.size(), 0);
  for (const Ranks::Bytes& bytes : this->All.allGather(
         [&]
         {
           std::vector<unsigned char> own(places.size(), 0);
           vtkSMPTools::For(0, static_cast<vtkIdType>(places.size()),
             [&](vtkIdType begin, vtkIdType end)
             {
               for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end);
                    ++n)
               {
                 own[n] = this->Piece->holds(places[n]) ? 1 : 0;
               }
             });
           Ranks::Bytes ofRank;
           putAll(own, ofRank);
           return ofRank;
         }))
  {
    const auto ofRank = Reader(bytes).GetAll<std::vector<unsigned char>>();
    for (std::size_t n = 0; n < are.size(); ++n)
    {
      are[n] = are[n] | ofRank.at(n);
    }
  }
  return are;
}

void Maker::makeBoundary(
  BoundaryOfMeshes of, const std::vector<double>& values, vtkDataObject* bodies)
{
  this->Kept.voxelShape = CellTree::voxelShapeOf(std::move(of.cells));
  BoundaryFaces boundary = boundaryOf(
    std::move(of.faces), [this](const std::vector<Point>& places) { return this->hold(places); },
    [&](const CutFaces& cuts) { return valuesOf(cuts.contributions, values); });
  this->Kept.contributions = boundary.contributions;
  this->Boundary = std::make_shared<GasBoundary>(
    std::move(boundary), bodies, static_cast<filters::Outside>(this->Of.settings.Outside));
  this->Kept.boundary = this->Boundary;
  this->Kept.keys = this->Keys;
  this->Kept.lattices = nullptr;
}

void Maker::makeBoundary(BoundaryOfImage of, vtkDataObject* bodies)
{
  this->Facts.direction = of.direction;
  this->Facts.voxelShape = of.spacing;
  sortTriangles(of.faces);
  this->Boundary = std::make_shared<GasBoundary>(
    std::move(of.faces), turnedBack(bodies, of.direction), filters::Outside::Passes);
  this->Facts.ambient = ImagePiece::ambientOf(std::move(of.outer));
}

/// Gathers all boundary faces on all ranks, which make the same boundary of them.
void Maker::findBoundary(vtkDataObject* bodies)
{
  Hash ofBodies;
  ofBodies.add(static_cast<std::uint64_t>(this->Of.settings.Outside));
  addBodies(ofBodies, bodies);
  this->Keys.push_back(ofBodies.value());
  const bool isKept = this->Kept.boundary && this->Kept.keys == this->Keys && !this->IsImage;
  const auto ofRanks = this->All.allGather(
    [&]
    {
      Ranks::Bytes bytes;
      if (isKept)
      {
        this->Piece->putBoundaryValues(bytes);
      }
      else
      {
        this->Piece->putBoundary(this->Cells, bytes);
      }
      return bytes;
    });
  BoundaryOfMeshes ofMeshes;
  BoundaryOfImage ofImage;
  std::vector<double> values; // at the face points of all ranks' meshes
  for (const Ranks::Bytes& bytes : ofRanks)
  {
    Reader reader(bytes);
    if (!isKept)
    {
      if (reader.Get<DataPiece::BoundaryKind>() == DataPiece::BoundaryKind::OfImage)
      {
        ofImage.add(reader);
        continue;
      }
      ofMeshes.add(reader);
    }
    const auto ofRank = reader.GetAll<std::vector<double>>();
    values.insert(values.end(), ofRank.begin(), ofRank.end());
  }
  if (isKept &&
    !this->Kept.boundary->hasSheetsOf(
      [&](const CutFaces& cuts) { return valuesOf(cuts.contributions, values); }))
  {
    this->Kept.boundary = nullptr;
    this->Keys.pop_back();
    this->findBoundary(bodies);
    return;
  }
  if (this->IsImage)
  {
    this->makeBoundary(std::move(ofImage), bodies);
    return;
  }
  if (isKept)
  {
    this->Boundary = this->Kept.boundary;
    this->Kept.lattices =
      this->Kept.lattices ? this->Kept.lattices : std::make_shared<LatticesOfMesh>();
    this->Kept.lattices->beginStep();
  }
  else
  {
    ++this->Kept.builds;
    this->makeBoundary(std::move(ofMeshes), values, bodies);
  }
  this->Facts.voxelShape = this->Kept.voxelShape;
  this->Facts.ambient = this->Boundary->ambient(valuesOf(this->Kept.contributions, values));
}

MadeOverRanks Maker::make(vtkDataObject* data, vtkDataObject* bodies, std::uint64_t number)
{
  {
    PiecesOfRanks pieces(this->All, data, arraysOf(this->Of.choice().settings));
    this->IsImage = pieces.kind() == PiecesOfRanks::Kind::Image;
    this->Pieces = pieces.withGhostCells();
  }
  this->reach(0.2);
  this->chooseArrays();
  this->All.agree([&] { this->makePiece(bodies); });
  this->sumUp();
  this->reach(0.6);
  if (!this->Made.hasGas)
  {
    return std::move(this->Made);
  }
  this->findBoundary(bodies);
  if (std::isnan(this->Facts.ambient))
  {
    this->Facts.ambient = 0.5 * (this->Facts.content.lowest + this->Facts.content.highest);
  }
  this->Made.meetsBodies = this->Boundary->hasBodiesIn(this->Facts.bounds);
  this->Made.source = std::make_shared<SamplesOverRanks>(this->All, number, std::move(this->Facts),
    std::move(this->Piece), this->Boundary, this->IsImage ? nullptr : this->Kept.lattices,
    this->Of.threads());
  return std::move(this->Made);
}

} // namespace

MadeOverRanks filters::makeOverRanks(MediumMaker& maker, const Ranks& ranks, vtkDataObject* data,
  vtkDataObject* bodies, bool hasFields, std::uint64_t number, KeptOverRanks& kept)
{
  MadeOverRanks made;
  vtkSMPTools::LocalScope(loopsWith(maker.threads()),
    [&] { made = Maker(maker, ranks, hasFields, kept).make(data, bodies, number); });
  return made;
}
