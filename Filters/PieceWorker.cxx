// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceWorker.h"

#include "AmrPiece.h"
#include "ArrayChoice.h"
#include "BetweenTimeSteps.h"
#include "FieldFromImage.h"
#include "FieldTints.h"
#include "FieldsOfBlocks.h"
#include "FlatData.h"
#include "ForEach.h"
#include "GasBoundary.h"
#include "GatheredData.h"
#include "InputDescription.h"
#include "MeshKey.h"
#include "PreparedLeaves.h"
#include "RefractiveIndexInternals.h"
#include "RefractivityOfImage.h"

#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkRefractiveIndex.h"
#include "vtkSMPTools.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// A piece that is one layer of cells may be of data that are several.
const Source asTheyAre;

bool hasPoints(vtkDataObject* data)
{
  const std::vector<vtkDataObject*> leaves = leavesOf(data);
  return std::any_of(leaves.begin(), leaves.end(),
    [](vtkDataObject* leaf)
    {
      auto* set = vtkDataSet::SafeDownCast(leaf);
      return set && set->GetNumberOfPoints() > 0;
    });
}

} // namespace

PieceWorker::PieceWorker(vtkRefractiveIndex* self)
  : Self(self)
  , Kept(std::make_shared<KeptOfMesh>())
  , Held(std::make_shared<HeldPiece>(this->Kept))
{
}
PieceWorker::~PieceWorker() = default;

int PieceWorker::GetThreads() const { return threadsOf(this->Self); }

std::vector<char> pieceRequest(PieceWorker::Kind kind)
{
  std::vector<char> request;
  put(kind, request);
  return request;
}

void PieceWorker::SetData(vtkDataObject* data, vtkDataObject* earlier)
{
  this->Data = this->Later = data;
  this->Earlier = earlier;
}

void PieceWorker::Release()
{
  this->ReleasePiece();
  this->Kept->release();
}

void PieceWorker::ReleasePiece()
{
  this->Lacks.clear();
  this->Parts.clear();
  this->Outlines.clear();
  this->Fields.reset();
  this->Held = std::make_shared<HeldPiece>(this->Kept);
}

std::vector<char> PieceWorker::Respond(const std::vector<char>& request)
{
  std::vector<char> answer = pieceRequest(Answer);
  const auto fail = [&](State state, const std::string& text)
  {
    answer = pieceRequest(Answer);
    put(state, answer);
    putAll(text, answer);
  };
  try
  {
    put(Done, answer);
    Reader reader(request);
    const auto kind = reader.Get<std::uint32_t>();
    const auto respond = [&] { this->Respond(kind, reader, answer); };
    if (kind < Contents)
    {
      vtkSMPTools::LocalScope(loopsWith(this->GetThreads()), respond);
    }
    else
    {
      respond(); // perhaps while another thread runs filters, with loops of VTK
    }
  }
  catch (const ArraysMissing& problem)
  {
    fail(Lacking, problem.what());
  }
  catch (const std::bad_alloc&)
  {
    this->Release();
    fail(Failed,
      "There is not enough memory for a rank's piece of the input. Use more nodes or a "
      "coarser input.");
  }
  catch (const std::exception& problem)
  {
    fail(Failed, problem.what());
  }
  return answer;
}

void PieceWorker::Respond(std::uint32_t kind, Reader& request, std::vector<char>& answer)
{
  switch (kind)
  {
    case Instant:
    {
      const auto ratio = request.Get<double>();
      this->Data = this->Later;
      if (ratio < 1)
      {
        this->Data = betweenTimeSteps(this->Earlier, this->Later, ratio);
      }
      break;
    }
    case GiveArrays:
      putArrays(flowArraysOf(dataSetsOf(this->Data), true), answer);
      break;
    case TakeArrays:
      this->Self->GetKnownArrays()->SetOfRanks(getArrays(request));
      break;
    case Outline:
      this->GiveOutline(request, answer);
      break;
    case Levels:
      this->MakeFields(request);
      break;
    case GiveBlocks:
      this->OwnFields().giveBlocks(request, answer);
      break;
    case TakeBlocks:
      this->OwnFields().takeBlocks(request);
      break;
    case Renumber:
      this->OwnFields().renumber(request);
      break;
    case CellsAround:
      this->OwnFields().giveCellsAround(request, answer);
      break;
    case AddCells:
      this->OwnFields().addCells(request);
      break;
    case Copies:
      this->GiveCopies(request, answer);
      break;
    case Make:
      this->MakePiece(request, answer);
      break;
    case Boundary:
    {
      const DataPiece& piece = this->PieceOf(request);
      const auto isKept = request.Get<bool>();
      const auto cellsOfAll = request.Get<std::int64_t>();
      isKept ? piece.putBoundaryValues(answer) : piece.putBoundary(cellsOfAll, answer);
      break;
    }
    case Contents:
    {
      const DataPiece& piece = this->PieceOf(request);
      const auto boxes = request.GetAll<std::vector<schlieren::Box>>();
      std::vector<Content> contents(boxes.size());
      forEach(boxes.size(), this->GetThreads(),
        [&](std::size_t i)
        {
          contents[i].cells = piece.contentOf(boxes[i]);
          const std::array<Point, 9> tested = GasBoundary::testedPlaces(boxes[i]);
          std::transform(tested.begin(), tested.end(), contents[i].holds.begin(),
            [&](const Point& place) { return piece.holds(place) ? 1 : 0; });
        });
      putAll(contents, answer);
      for (int field = 0; field < piece.fields(); ++field)
      {
        for (const schlieren::Box& box : boxes)
        {
          put(piece.rangeOfField(field, box), answer);
        }
      }
      break;
    }
    case Hold:
    {
      const DataPiece& piece = this->PieceOf(request);
      const auto places = request.GetAll<std::vector<Point>>();
      std::vector<unsigned char> are(places.size());
      forEach(places.size(), this->GetThreads(),
        [&](std::size_t i) { are[i] = piece.holds(places[i]) ? 1 : 0; });
      putAll(are, answer);
      break;
    }
    case Sample:
    {
      const DataPiece& piece = this->PieceOf(request);
      const auto lattices = request.GetAll<std::vector<schlieren::Lattice>>();
      std::vector<DataPiece::Samples> samples(lattices.size());
      forEach(lattices.size(), this->GetThreads(),
        [&](std::size_t i) { samples[i] = piece.sample(lattices[i]); });
      for (const DataPiece::Samples& ofLattice : samples)
      {
        std::vector<char> bytes;
        ofLattice.Put(bytes);
        putAll(bytes, answer);
      }
      break;
    }
    case BeginBricks:
    {
      const auto number = request.Get<std::uint64_t>();
      const auto arePieces = request.Get<bool>();
      if (arePieces)
      {
        this->RequirePiece(number);
      }
      else
      {
        this->ReleasePiece();
      }
      this->Held->bricks.begin(number, request);
      break;
    }
    case MakeBricks:
    {
      const auto number = request.Get<std::uint64_t>();
      const bool hasPiece = number == this->Held->name.number;
      this->Held->bricks.make(
        number, request, hasPiece ? this->Held->piece.get() : nullptr, this->GetThreads(), answer);
      break;
    }
    case Adopt:
    {
      const std::shared_ptr<HeldPiece> found = findPiece(request.Get<PieceName>());
      this->ReleasePiece();
      this->Held = found ? found : this->Held;
      this->RequirePiece(found ? found->name.number : 0);
      break;
    }
    case Forget:
      this->Release();
      break;
    default:
      throw std::runtime_error("Rank 0 requests what this version of the plugin does not know. "
                               "Use the same version on all ranks.");
  }
}

/// The request: whether the fields that tint are needed. The answer: the ranges of fields that FieldMean needs, and those of the
/// ones that tint; whether the data are an image; whether all are images for AmrField, and these; of each mesh its slot and where
/// others may continue.
void PieceWorker::GiveOutline(Reader& request, std::vector<char>& answer)
{
  this->ReleasePiece();
  std::vector<FieldMean::Range> ranges, rangesOfFields;
  std::vector<std::string> lacks; // of the fields
  std::vector<AmrImage> images;
  bool isImage = false, areAmrImages = true;
  if (hasPoints(this->Data))
  {
    try
    {
      // Says what is wrong with the data while all arrays are there.
      const Source source = chooseSource(this->Self, this->Data, &asTheyAre);
      if (const auto* mean = std::get_if<FieldMean>(&source.model))
      {
        ranges = mean->rangesIn(source.leaves);
      }
      const bool hasFields = request.Get<bool>();
      for (const RangeOfField& field :
        hasFields ? filters::rangesOfFields(this->Self, this->Data) : std::vector<RangeOfField>())
      {
        rangesOfFields.push_back(field.range);
        lacks.push_back(field.lacks);
      }
      isImage = vtkImageData::SafeDownCast(this->Data) != nullptr;
      for (const Leaf& leaf : source.leaves)
      {
        const std::optional<AmrImage> image = isImage ? std::nullopt : amrImageOf(leaf);
        areAmrImages = areAmrImages && image;
        images.push_back(image.value_or(AmrImage{}));
      }
      this->Parts = partsOf(this->Data, arraysOf(this->Self));
    }
    catch (const ArraysMissing& problem)
    {
      this->Lacks = problem.what();
    }
  }
  putAll(ranges, answer);
  putAll(rangesOfFields, answer);
  put(static_cast<std::uint64_t>(lacks.size()), answer);
  for (const std::string& missing : lacks)
  {
    putAll(missing, answer);
  }
  put(isImage, answer);
  put(areAmrImages, answer);
  putAll(areAmrImages ? images : std::vector<AmrImage>(), answer);
  for (const Part& part : this->Parts)
  {
    const filters::Outline& outline = this->Outlines.emplace_back(outlineOf(part.data));
    putAll(part.slot, answer);
    put(outline.isGrid, answer);
    put(outline.extent, answer);
    put(outline.place, answer);
    put(outline.layers, answer);
    putAll(outline.names, answer);
  }
}

/// For each entry of a request, a mesh and its outer points, by their numbers, or an extent: the cells there.
void PieceWorker::GiveCopies(Reader& request, std::vector<char>& answer) const
{
  while (!request.IsAtEnd())
  {
    const auto number = request.Get<std::uint64_t>();
    const auto extent = request.Get<filters::Outline::Extent>();
    const Part& part = this->Parts.at(number);
    const filters::Outline& outline = this->Outlines.at(number);
    std::vector<vtkIdType> points;
    for (const std::uint32_t point : request.GetAll<std::vector<std::uint32_t>>())
    {
      points.push_back(outline.ids.at(point));
    }
    std::vector<char> packed;
    pack({ part.slot,
           outline.isGrid ? cellsWithin(part.data, extent)
                          : cellsAround(vtkUnstructuredGrid::SafeDownCast(part.data), points) },
      packed);
    putAll(packed, answer);
  }
}

/// The request: ranges of fields, and of those that tint, the first image of each rank and the number of all, the levels of all
/// blocks, and this rank's number.
void PieceWorker::MakeFields(Reader& request)
{
  const auto ranges = request.GetAll<std::vector<FieldMean::Range>>();
  const auto rangesOfFields = request.GetAll<std::vector<FieldMean::Range>>();
  const auto firstImages = request.GetAll<std::vector<std::uint64_t>>();
  AmrLevels levels{};
  levels.flat = request.Get<int>();
  levels.origin = request.Get<std::array<double, 3>>();
  levels.levels.resize(request.Get<std::uint64_t>());
  for (AmrLevel& level : levels.levels)
  {
    level.spacing = request.Get<std::array<double, 3>>();
    level.cells = request.Get<Counts>();
    level.blocks = request.GetAll<std::vector<AmrBlock>>();
  }
  const auto rank = request.Get<std::uint64_t>();
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const Part& part : this->Parts)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), part.data);
  }
  this->Parts.clear();
  this->Outlines.clear();
  auto made = std::make_unique<FieldsOfBlocks>();
  made->firstImages = firstImages;
  const std::uint64_t first = firstImages.at(rank);
  Source source;
  std::vector<FieldValues> fields(rangesOfFields.size());
  if (blocks->GetNumberOfBlocks() > 0)
  {
    source = this->SourceOf(blocks, ranges);
    fields = this->FieldsOf(blocks, source, rangesOfFields);
  }
  if (source.leaves.size() != firstImages.at(rank + 1) - first)
  {
    throw std::runtime_error(
      "A rank's blocks are not those that rank 0 knows of. Update the filter "
      "again.");
  }
  made->label = source.label;
  made->fields.emplace_back(levels, source, made->tally, WorkProgress(), first);
  for (FieldValues& field : fields)
  {
    Tally notReported;
    bringToCells(field);
    made->fields.emplace_back(levels, field.source, notReported, WorkProgress(), first);
  }
  this->Fields = std::move(made);
}

FieldsOfBlocks& PieceWorker::OwnFields()
{
  if (!this->Fields)
  {
    throw std::runtime_error(
      "A rank does not have its blocks of the input any more. Update the filter again.");
  }
  return *this->Fields;
}

/// The request: the piece's name, what the data are, and what that needs, see PieceOfParts(). The answer: what the
/// constructor of PiecesSource reads.
void PieceWorker::MakePiece(Reader& request, std::vector<char>& answer)
{
  this->Held = std::make_shared<HeldPiece>(this->Kept, request.Get<PieceName>());
  addPiece(this->Held);
  const auto kind = request.Get<DataKind>();
  if (!this->Lacks.empty())
  {
    this->Held->piece = std::make_unique<MeshPiece>(
      std::vector<vtkSmartPointer<vtkDataSet>>(), CellTree::Reconstruction::Linear);
    throw ArraysMissing(this->Lacks);
  }
  Tally tally;
  std::string label;
  if (kind == Blocks)
  {
    FieldsOfBlocks& made = this->OwnFields();
    tally = made.tally;
    label = made.label;
    this->Held->piece = std::make_unique<AmrPiece>(std::move(made.fields));
    this->Fields.reset();
  }
  else
  {
    this->Held->piece = this->PieceOfParts(kind, request, tally, label);
  }
  put(this->Held->piece->summary(), answer);
  put(tally, answer);
  putAll(label, answer);
  put(this->Held->piece->meshKey(), answer);
  for (int field = 0; field < this->Held->piece->fields(); ++field)
  {
    put(this->Held->piece->rangeOfField(field, this->Held->piece->summary().bounds), answer);
  }
}

/// Of meshes or an image. The rest of the request: ranges of fields for FieldMean, and of those that tint, the extent of all
/// parts of an image, bodies for it, and packed cells of others.
std::unique_ptr<const DataPiece> PieceWorker::PieceOfParts(
  DataKind kind, Reader& request, Tally& tally, std::string& label)
{
  Ranges ranges;
  ranges.ofModel = request.GetAll<std::vector<FieldMean::Range>>();
  ranges.ofFields = request.GetAll<std::vector<FieldMean::Range>>();
  const auto whole = request.Get<Outline::Extent>();
  const vtkSmartPointer<vtkDataObject> bodies =
    gatheredData({ request.GetAll<std::vector<char>>() });
  std::map<Slot, std::vector<vtkSmartPointer<vtkDataSet>>> copies;
  while (!request.IsAtEnd())
  {
    const auto packed = request.GetAll<std::vector<char>>();
    Reader reader(packed);
    Part part = unpack(reader);
    copies[std::move(part.slot)].push_back(std::move(part.data));
  }
  const Outline::Extent own = this->Outlines.empty() ? whole : this->Outlines[0].extent;
  std::vector<vtkSmartPointer<vtkDataSet>> parts;
  std::vector<std::uint32_t> datasets;
  for (const Part& part : this->Parts)
  {
    parts.push_back(withCopies(part.data, copies[part.slot]));
    Hash ofSlot;
    std::for_each(part.slot.begin(), part.slot.end(),
      [&](int child) { ofSlot.add(static_cast<std::uint64_t>(child)); });
    datasets.push_back(
      static_cast<std::uint32_t>(ofSlot.value() >> 33)); // never Contribution::ofSeveral
  }
  this->Parts.clear();
  this->Outlines.clear();
  copies.clear();
  const std::shared_ptr<PieceMesh> before = this->Kept->takePiece();
  return kind == Image && !parts.empty()
    ? this->PieceOfImage(
        vtkImageData::SafeDownCast(parts[0]), { whole, own }, bodies, ranges, tally, label)
    : this->PieceOfMeshes(parts, datasets, ranges, before, tally, label);
}

std::unique_ptr<const DataPiece> PieceWorker::PieceOfMeshes(
  const std::vector<vtkSmartPointer<vtkDataSet>>& parts, const std::vector<std::uint32_t>& datasets,
  const Ranges& ranges, const std::shared_ptr<PieceMesh>& before, Tally& tally, std::string& label)
{
  std::vector<vtkSmartPointer<vtkDataSet>> leaves;
  std::vector<std::uint32_t> datasetsOfLeaves;
  std::vector<std::vector<vtkSmartPointer<vtkDataSet>>> leavesOfFields(ranges.ofFields.size());
  const bool isSmooth = this->Self->GetReconstruction() != vtkRefractiveIndex::LINEAR_IN_CELLS;
  if (!parts.empty())
  {
    vtkNew<vtkMultiBlockDataSet> data;
    for (vtkDataSet* part : parts)
    {
      data->SetBlock(data->GetNumberOfBlocks(), part);
    }
    Source source = this->SourceOf(data, ranges.ofModel);
    label = source.label;
    source.leaves.erase(std::remove_if(source.leaves.begin(), source.leaves.end(),
                          [](const Leaf& leaf) { return dimensionOf(leaf.data) < 3; }),
      source.leaves.end());
    if (!source.leaves.empty())
    {
      const CellValues cellValues = isSmooth ? CellValues::Known : CellValues::Averaged;
      const std::vector<FieldValues> fields = this->FieldsOf(data, source, ranges.ofFields);
      // One by one: parts of a dataset have the same number on all ranks.
      for (std::size_t leaf = 0; leaf < source.leaves.size(); ++leaf)
      {
        std::shared_ptr<const SharedPoints> shared;
        const auto prepare = [&](const Source& from, Tally& to)
        {
          Source one = from;
          one.leaves = { from.leaves[leaf] };
          return preparedLeaves(one, cellValues, to, shared);
        };
        const auto part = std::find(parts.begin(), parts.end(), source.leaves[leaf].input);
        for (const auto& prepared : prepare(source, tally))
        {
          leaves.push_back(prepared);
          datasetsOfLeaves.push_back(datasets.at(static_cast<std::size_t>(part - parts.begin())));
        }
        for (std::size_t number = 0; number < fields.size(); ++number)
        {
          Tally notReported;
          for (const auto& prepared : prepare(fields[number].source, notReported))
          {
            leavesOfFields[number].push_back(prepared);
          }
        }
      }
    }
  }
  auto piece = std::make_unique<MeshPiece>(leaves,
    isSmooth ? CellTree::Reconstruction::Smooth : CellTree::Reconstruction::Linear, before,
    std::move(datasetsOfLeaves));
  this->Kept->keep(piece->mesh());
  for (const auto& ofField : leavesOfFields)
  {
    piece->addField(ofField);
  }
  return piece;
}

std::unique_ptr<const DataPiece> PieceWorker::PieceOfImage(vtkImageData* image,
  ImagePiece::Extents extents, vtkDataObject* bodies, const Ranges& ranges, Tally& tally,
  std::string& label) const
{
  const Source source = this->SourceOf(image, ranges.ofModel);
  label = source.label;
  vtkNew<vtkImageData> refractivity;
  tally = convertImage(source,
    this->Self->GetDoublePrecision() ? Numbers::Doubles : Numbers::Differences, refractivity);
  mergeMasks(refractivity);
  for (const std::size_t high : { 1, 3, 5 })
  {
    if (source.leaves[0].ofCells)
    {
      --extents.whole[high];
      --extents.own[high];
    }
  }
  auto piece = std::make_unique<ImagePiece>(refractivity, extents,
    turnedBack(bodies, gridFrom(refractivity).direction), this->GetThreads());
  if (!ranges.ofFields.empty())
  {
    forFieldImages(
      this->Self, image, refractivity, this->GetThreads(),
      [&](std::size_t, vtkImageData* field) { piece->addField(field, this->GetThreads()); },
      ranges.ofFields);
  }
  return piece;
}

/// Those that tint.
std::vector<FieldValues> PieceWorker::FieldsOf(
  vtkDataObject* data, const Source& source, const std::vector<FieldMean::Range>& ranges) const
{
  return ranges.empty() ? std::vector<FieldValues>()
                        : fieldValues(this->Self, data, source, ranges);
}

/// With the ranges of all ranks.
Source PieceWorker::SourceOf(vtkDataObject* data, const std::vector<FieldMean::Range>& ranges) const
{
  Source source = chooseSource(this->Self, data, &asTheyAre);
  if (auto* mean = std::get_if<FieldMean>(&source.model))
  {
    mean->setRanges(ranges);
  }
  return source;
}

const DataPiece& PieceWorker::PieceOf(Reader& request) const
{
  this->RequirePiece(request.Get<std::uint64_t>());
  return *this->Held->piece;
}

void PieceWorker::RequirePiece(std::uint64_t number) const
{
  if (number != this->Held->name.number || !this->Held->piece)
  {
    throw std::runtime_error(
      "A rank does not have its piece of the input any more. Update the filter again.");
  }
}

} // namespace filters
