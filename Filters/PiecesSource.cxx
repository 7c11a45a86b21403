// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PiecesSource.h"

#include "AmrFaces.h"
#include "ForEach.h"
#include "LatticeDistances.h"
#include "MeshKey.h"
#include "PieceRequests.h"
#include "RefractivitySource.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

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

void extend(
  schlieren::MediumSource::FieldRange& range, const schlieren::MediumSource::FieldRange& by)
{
  if (by.lowest <= by.highest)
  {
    const bool isFirst = range.lowest > range.highest;
    range.lowest = isFirst ? by.lowest : std::min(range.lowest, by.lowest);
    range.highest = isFirst ? by.highest : std::max(range.highest, by.highest);
  }
}

/// Of all ranks' values at the boundary of meshes those of some points.
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

constexpr schlieren::MediumSource::FieldRange nowhere{ 1, 0 };
constexpr CellTree::Content nothing{ 1, 0, { infinity, infinity, infinity } };

} // namespace

std::vector<char> PiecesSource::request(PieceWorker::Kind kind) const
{
  std::vector<char> request = pieceRequest(kind);
  put(this->Number, request);
  return request;
}

std::vector<std::vector<char>> PiecesSource::request(std::vector<std::vector<char>> requests) const
{
  return this->Ranks->Request(std::move(requests));
}

PiecesSource::PiecesSource(std::shared_ptr<PieceRanks> ranks, vtkDataObject* bodies,
  Outside outside, bool hasFields, PiecesMesh kept, const WorkProgress& progress)
  : Ranks(std::move(ranks))
{
  this->Number = newNumberOfPieces();
  PieceRequests requests = requestsForPieces(*this->Ranks, this->Number, bodies, hasFields);
  this->RangesOfFields.resize(requests.fields, nowhere);
  progress.reach(0.2);

  Hash ofBodies;
  ofBodies.add(static_cast<std::uint64_t>(outside));
  addBodies(ofBodies, bodies);
  std::vector<std::uint64_t> keys{ ofBodies.value() };
  this->All = nothing;
  this->Facts.bounds = { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  std::string lacking;
  for (const std::vector<char>& answer : this->request(std::move(requests.make)))
  {
    this->BoundsOfRanks.push_back(
      { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } });
    this->CellsOfRanks.push_back(-1);
    try
    {
      Reader reader = readerOf(answer);
      const auto summary = reader.Get<DataPiece::Summary>();
      this->Valid += reader.Get<Tally>();
      const auto label = reader.GetAll<std::string>();
      this->Label = this->Label.empty() ? label : this->Label;
      keys.push_back(reader.Get<std::uint64_t>());
      this->CellsOfRanks.back() = summary.cells;
      if (summary.cells > 0)
      {
        for (FieldRange& range : this->RangesOfFields)
        {
          extend(range, reader.Get<FieldRange>());
        }
        this->BoundsOfRanks.back() = summary.bounds;
        extend(this->Facts.bounds, summary.bounds);
        extend(this->All, summary.content);
        this->Cells += summary.cells;
        this->Reach = summary.reach;
      }
    }
    catch (const ArraysMissing& problem)
    {
      lacking = problem.what();
    }
  }
  if (!lacking.empty())
  {
    if (this->Label.empty())
    {
      throw ArraysMissing(lacking);
    }
    if (requests.areOfOne)
    {
      throw std::runtime_error("The parts of the input on several ranks have not the same arrays. "
                               "Of one of them: " +
        lacking + " Check the reader or filter that has made them.");
    }
  }
  if (requests.levels)
  {
    this->Facts.bounds =
      requests.levels->bounds(); // those of ranks have no end where the domain ends
    this->Facts.voxelShape = requests.levels->levels[0].spacing;
  }
  progress.reach(0.6);
  this->findBoundary(bodies, outside, std::move(kept), std::move(keys), progress.part(0.6, 1));
  if (std::isnan(this->Facts.ambient))
  {
    this->Facts.ambient = 0.5 * (this->All.lowest + this->All.highest);
  }
  PieceWorker::Content all{ this->All, {} };
  all.holds.fill(1);
  this->Facts.content = this->contentFrom(this->Facts.bounds, all);
  this->Known =
    std::make_unique<SamplesOfPieces>(this->Facts, this->RangesOfFields, this->Boundary);
  if (this->Boundary->surface().size() <= mostSharedFaces)
  {
    this->Bricks = std::make_unique<BricksOfPieces>(this->Ranks, this->Number,
      this->Mesh.keys.empty() ? 0 : this->Mesh.number, this->BoundsOfRanks, *this->Known);
  }
}

bool PiecesSource::useRanks(const std::shared_ptr<PieceRanks>& ranks) const
{
  std::vector<std::vector<char>> requests;
  for (std::uint64_t rank = 0; rank < ranks->Count(); ++rank)
  {
    put(PieceName{ this->Number, rank }, requests.emplace_back(pieceRequest(PieceWorker::Adopt)));
  }
  try
  {
    readersOf(ranks->Request(std::move(requests)));
  }
  catch (const std::runtime_error&) // a rank has not come, or has left it
  {
    return false;
  }
  this->Ranks = ranks;
  if (this->Bricks)
  {
    this->Bricks->useRanks(ranks);
  }
  return true;
}

/// `keys`: see PiecesMesh.
void PiecesSource::findBoundary(vtkDataObject* bodies, Outside outside, PiecesMesh kept,
  std::vector<std::uint64_t> keys, const WorkProgress& progress)
{
  const bool isKept = kept.boundary && kept.keys == keys;
  std::vector<char> request = this->request(PieceWorker::Boundary);
  put(isKept, request);
  put(this->Cells, request);
  std::vector<std::vector<char>> requests;
  for (const std::int64_t cells : this->CellsOfRanks)
  {
    requests.push_back(cells < 0 ? std::vector<char>() : request);
  }
  const auto answers = this->request(std::move(requests));
  BoundaryOfMeshes ofMeshes;
  BoundaryOfImage ofImage;
  BoundaryOfAmr ofAmr;
  std::vector<double> values; // of meshes, at the points of all ranks' faces
  for (std::size_t rank = 0; rank < answers.size(); ++rank)
  {
    if (answers[rank].empty())
    {
      continue;
    }
    Reader reader = readerOf(answers[rank]);
    if (!isKept)
    {
      switch (reader.Get<DataPiece::BoundaryKind>())
      {
        case DataPiece::BoundaryKind::OfImage:
          ofImage.add(reader);
          continue;
        case DataPiece::BoundaryKind::OfAmr:
          ofAmr.add(reader);
          continue;
        case DataPiece::BoundaryKind::OfMesh:
          ofMeshes.add(reader);
      }
    }
    const auto ofRank = reader.GetAll<std::vector<double>>();
    values.insert(values.end(), ofRank.begin(), ofRank.end());
  }
  progress.reach(0.3);
  if (isKept &&
    !kept.boundary->hasSheetsOf(
      [&](const CutFaces& cuts) { return valuesOf(cuts.contributions, values); }))
  {
    this->findBoundary(bodies, outside, {}, std::move(keys), progress);
    return;
  }
  if (isKept)
  {
    this->Mesh = std::move(kept);
    this->Boundary = this->Mesh.boundary;
    this->Facts.voxelShape = this->Mesh.voxelShape;
  }
  else if (ofAmr.parts > 0)
  {
    this->makeBoundary(std::move(ofAmr), bodies, outside, progress.part(0.3, 1));
    return;
  }
  else if (ofImage.parts > 0)
  {
    this->makeBoundary(std::move(ofImage), bodies, progress.part(0.3, 1));
    return;
  }
  else
  {
    this->makeBoundary(std::move(ofMeshes), values, bodies, outside, progress.part(0.3, 1));
    this->Mesh.keys = std::move(keys);
    this->Mesh.number = this->Number;
  }
  this->Facts.ambient = this->Boundary->ambient(valuesOf(this->Mesh.contributions, values));
}

void PiecesSource::makeBoundary(BoundaryOfMeshes of, const std::vector<double>& values,
  vtkDataObject* bodies, Outside outside, const WorkProgress& progress)
{
  this->Facts.voxelShape = CellTree::voxelShapeOf(std::move(of.cells));
  BoundaryFaces boundary = boundaryOf(
    std::move(of.faces), [this](const std::vector<Point>& places) { return this->hold(places); },
    [&](const CutFaces& cuts) { return valuesOf(cuts.contributions, values); });
  this->Mesh.contributions = boundary.contributions;
  this->Boundary = std::make_shared<GasBoundary>(std::move(boundary), bodies, outside, progress);
  this->Mesh.boundary = this->Boundary;
  this->Mesh.voxelShape = this->Facts.voxelShape;
}

void PiecesSource::makeBoundary(
  BoundaryOfAmr of, vtkDataObject* bodies, Outside outside, const WorkProgress& progress)
{
  sortTriangles(of.faces);
  this->Boundary = std::make_shared<GasBoundary>(std::move(of.faces), bodies, outside, progress);
  this->Facts.ambient = weightedMedian(std::move(of.outer));
}

void PiecesSource::makeBoundary(
  BoundaryOfImage of, vtkDataObject* bodies, const WorkProgress& progress)
{
  this->Facts.direction = of.direction;
  this->Facts.voxelShape = of.spacing;
  sortTriangles(of.faces);
  this->Boundary = std::make_shared<GasBoundary>(
    std::move(of.faces), turnedBack(bodies, of.direction), Outside::Passes, progress);
  this->Facts.ambient = ImagePiece::ambientOf(std::move(of.outer));
  // What is beyond the image, in the cubes around its outer points, belongs to these.
  for (schlieren::Box& ofRank : this->BoundsOfRanks)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double& low = ofRank.low[axis];
      double& high = ofRank.high[axis];
      low = low == this->Facts.bounds.low[axis] ? -infinity : low;
      high = high == this->Facts.bounds.high[axis] ? infinity : high;
    }
  }
}

std::vector<unsigned char> PiecesSource::hold(const std::vector<Point>& places) const
{
  std::vector<unsigned char> are(places.size(), 0);
  if (places.empty())
  {
    return are;
  }
  std::vector<char> request = this->request(PieceWorker::Hold);
  putAll(places, request);
  for (const std::vector<char>& answer :
    this->request(std::vector<std::vector<char>>(this->Ranks->Count(), request)))
  {
    const auto ofRank = readerOf(answer).GetAll<std::vector<unsigned char>>();
    for (std::size_t i = 0; i < are.size(); ++i)
    {
      are[i] = are[i] | ofRank.at(i);
    }
  }
  return are;
}

/// Queries each rank about those items whose boxes meet its cells, and calls take(rank, answer, numbers of these items).
template <class Item, class BoxOf, class Take>
void PiecesSource::askAbout(PieceWorker::Kind kind, const std::vector<Item>& items,
  const BoxOf& boxOf, const Take& take) const
{
  const std::size_t ranks = this->Ranks->Count();
  std::vector<std::vector<std::size_t>> ofRanks(ranks);
  std::vector<std::vector<char>> requests(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    std::vector<Item> requested;
    for (std::size_t n = 0; n < items.size(); ++n)
    {
      if (meet(boxOf(items[n]), this->BoundsOfRanks[rank]))
      {
        ofRanks[rank].push_back(n);
        requested.push_back(items[n]);
      }
    }
    if (!requested.empty())
    {
      requests[rank] = this->request(kind);
      putAll(requested, requests[rank]);
    }
  }
  const auto answers = this->request(std::move(requests));
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    if (!ofRanks[rank].empty())
    {
      Reader reader = readerOf(answers[rank]);
      take(rank, reader, ofRanks[rank]);
    }
  }
}

void PiecesSource::prepareContents(const std::vector<schlieren::Box>& boxes) const
{
  std::vector<PieceWorker::Content> found(boxes.size(), { nothing, {} });
  std::vector<SamplesOfPieces::KnownBox*> known;
  this->Known->forgetBoxes();
  for (const schlieren::Box& box : boxes)
  {
    known.push_back(&this->Known->box(box));
    known.back()->fields.assign(this->RangesOfFields.size(), nowhere);
    known.back()->shares.assign(this->Ranks->Count(), 0);
  }
  const auto withReach = [this](schlieren::Box box)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.low[axis] -= this->Reach[axis];
      box.high[axis] += this->Reach[axis];
    }
    return box;
  };
  this->askAbout(PieceWorker::Contents, boxes, withReach,
    [&](std::size_t rank, Reader& answer, const std::vector<std::size_t>& numbers)
    {
      const auto contents = answer.GetAll<std::vector<PieceWorker::Content>>();
      for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        const PieceWorker::Content& ofRank = contents.at(i);
        PieceWorker::Content& all = found[numbers[i]];
        extend(all.cells, ofRank.cells);
        unsigned char& share = known[numbers[i]]->shares[rank];
        share = ofRank.cells.lowest <= ofRank.cells.highest ? 1 : 0;
        for (std::size_t n = 0; n < all.holds.size(); ++n)
        {
          all.holds[n] = all.holds[n] | ofRank.holds[n];
          share = static_cast<unsigned char>(share + ofRank.holds[n]);
        }
      }
      for (std::size_t field = 0; field < this->RangesOfFields.size(); ++field)
      {
        for (const std::size_t number : numbers)
        {
          extend(known[number]->fields[field], answer.Get<FieldRange>());
        }
      }
    });
  forEach(boxes.size(), this->Ranks->GetThreads(),
    [&](std::size_t n) { known[n]->content = this->contentFrom(boxes[n], found[n]); });
}

void PiecesSource::prepareSamples(const std::vector<schlieren::Lattice>& lattices) const
{
  this->Known->forgetLattices();
  for (const schlieren::Lattice& lattice : lattices)
  {
    this->Known->samples(lattice); // of which no rank may have anything
  }
  this->askAbout(
    PieceWorker::Sample, lattices,
    [](const schlieren::Lattice& lattice) { return boxAround(lattice, 0); },
    [&](std::size_t, Reader& answer, const std::vector<std::size_t>& numbers)
    {
      for (const std::size_t number : numbers)
      {
        const schlieren::Lattice& lattice = lattices[number];
        const auto bytes = answer.GetAll<std::vector<char>>();
        Reader samples(bytes);
        this->Known->samples(lattice).Add(DataPiece::Samples::Get(
          samples, static_cast<std::size_t>(lattice.size()), this->RangesOfFields.size()));
      }
    });
}

/// Which places there are, by the boundary; and the cells where there is gas.
schlieren::MediumSource::Content PiecesSource::contentFrom(
  const schlieren::Box& box, const PieceWorker::Content& found) const
{
  Content content{ 1, 0, nothing.cellSize, false, false, false };
  const std::array<Point, 9> tested = GasBoundary::testedPlaces(box);
  this->Boundary->findPlaces(
    box,
    [&](const Point& place)
    {
      const auto at = std::find(tested.begin(), tested.end(), place);
      return at != tested.end() && found.holds[static_cast<std::size_t>(at - tested.begin())] != 0;
    },
    content);
  if (content.hasGas)
  {
    content.lowest = found.cells.lowest;
    content.highest = found.cells.highest;
    content.cellSize = found.cells.cellSize;
  }
  return content;
}

} // namespace filters
