// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PiecesSource.h"

#include "AmrFaces.h"
#include "LatticeDistances.h"
#include "MeshKey.h"
#include "PieceRequests.h"
#include "RefractivitySource.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
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

constexpr schlieren::MediumSource::FieldRange nowhere{ 1, 0 };
constexpr CellTree::Content nothing{ 1, 0, { infinity, infinity, infinity } };

} // namespace

PiecesSource::BoxKey PiecesSource::keyOf(const schlieren::Box& box)
{
  return { box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2] };
}

PiecesSource::LatticeKey PiecesSource::keyOf(const schlieren::Lattice& lattice)
{
  const auto& [first, spacing, points] = lattice;
  return { first[0], first[1], first[2], spacing[0], spacing[1], spacing[2],
    static_cast<double>(points[0]), static_cast<double>(points[1]),
    static_cast<double>(points[2]) };
}

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
  static std::atomic<std::uint64_t> sources{ 0 };
  this->Number = ++sources;
  PieceRequests requests = requestsForPieces(*this->Ranks, this->Number, bodies, hasFields);
  this->RangesOfFields.resize(requests.fields, nowhere);
  progress.reach(0.2);

  Hash ofBodies;
  ofBodies.add(static_cast<std::uint64_t>(outside));
  addBodies(ofBodies, bodies);
  std::vector<std::uint64_t> keys{ ofBodies.value() };
  this->All = nothing;
  this->Bounds = { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
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
      const auto warning = reader.GetAll<std::string>();
      this->Warning = this->Warning.empty() ? warning : this->Warning;
      keys.push_back(reader.Get<std::uint64_t>());
      this->CellsOfRanks.back() = summary.cells;
      if (summary.cells > 0)
      {
        for (FieldRange& range : this->RangesOfFields)
        {
          extend(range, reader.Get<FieldRange>());
        }
        this->BoundsOfRanks.back() = summary.bounds;
        extend(this->Bounds, summary.bounds);
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
  if (this->Label.empty() && !lacking.empty())
  {
    throw ArraysMissing(lacking);
  }
  if (requests.levels)
  {
    this->Bounds = requests.levels->bounds(); // those of ranks have no end where the domain ends
    this->VoxelShape = requests.levels->levels[0].spacing;
  }
  progress.reach(0.6);
  this->findBoundary(bodies, outside, std::move(kept), std::move(keys), progress.part(0.6, 1));
  if (std::isnan(this->Ambient))
  {
    this->Ambient = 0.5 * (this->All.lowest + this->All.highest);
  }
}

/// `keys`: see PiecesMesh.
void PiecesSource::findBoundary(vtkDataObject* bodies, Outside outside, PiecesMesh kept,
  std::vector<std::uint64_t> keys, const WorkProgress& progress)
{
  const bool isKept = kept.boundary && kept.keys == keys;
  std::vector<char> request = this->request(PieceWorker::Boundary);
  put(isKept, request);
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
          ofMeshes.add(reader, this->CellsOfRanks[rank]);
      }
    }
    const auto ofRank = reader.GetAll<std::vector<double>>();
    values.insert(values.end(), ofRank.begin(), ofRank.end());
  }
  progress.reach(0.3);
  if (isKept)
  {
    this->Mesh = std::move(kept);
    this->Boundary = this->Mesh.boundary;
    this->VoxelShape = this->Mesh.voxelShape;
    if (!this->Mesh.lattices)
    {
      this->Mesh.lattices = std::make_shared<LatticesOfMesh>();
    }
    this->Mesh.lattices->beginStep();
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
    this->makeBoundary(std::move(ofMeshes), bodies, outside, progress.part(0.3, 1));
    this->Mesh.keys = std::move(keys);
  }
  std::vector<double> onSurface;
  for (const Contribution& fraction : this->Mesh.contributions)
  {
    onSurface.push_back(values[static_cast<std::size_t>(fraction.point)]);
  }
  this->Ambient = this->Boundary->ambient(onSurface);
}

void PiecesSource::makeBoundary(
  BoundaryOfMeshes of, vtkDataObject* bodies, Outside outside, const WorkProgress& progress)
{
  this->VoxelShape = CellTree::voxelShapeOf(of.joinedSizes());
  BoundaryFaces boundary = boundaryOf(
    std::move(of.faces), [this](const std::vector<Point>& places) { return this->hold(places); });
  this->Mesh.contributions = boundary.contributions;
  this->Boundary = std::make_shared<GasBoundary>(std::move(boundary), bodies, outside, progress);
  this->Mesh.boundary = this->Boundary;
  this->Mesh.voxelShape = this->VoxelShape;
}

void PiecesSource::makeBoundary(
  BoundaryOfAmr of, vtkDataObject* bodies, Outside outside, const WorkProgress& progress)
{
  sortTriangles(of.faces);
  this->Boundary = std::make_shared<GasBoundary>(std::move(of.faces), bodies, outside, progress);
  this->Ambient = weightedMedian(std::move(of.outer));
}

void PiecesSource::makeBoundary(
  BoundaryOfImage of, vtkDataObject* bodies, const WorkProgress& progress)
{
  this->Direction = of.direction;
  this->VoxelShape = of.spacing;
  sortTriangles(of.faces);
  this->Boundary = std::make_shared<GasBoundary>(
    std::move(of.faces), turnedBack(bodies, of.direction), Outside::Passes, progress);
  this->Ambient = ImagePiece::ambientOf(std::move(of.outer));
  // What is beyond the image, in the cubes around its outer points, belongs to these.
  for (schlieren::Box& ofRank : this->BoundsOfRanks)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double& low = ofRank.low[axis];
      double& high = ofRank.high[axis];
      low = low == this->Bounds.low[axis] ? -infinity : low;
      high = high == this->Bounds.high[axis] ? infinity : high;
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

/// Queries each rank about those items whose boxes meet its cells, and calls take(answer, these items).
template <class Item, class BoxOf, class Take>
void PiecesSource::askAbout(PieceWorker::Kind kind, const std::vector<Item>& items,
  const BoxOf& boxOf, const Take& take) const
{
  const std::size_t ranks = this->Ranks->Count();
  std::vector<std::vector<Item>> ofRanks(ranks);
  std::vector<std::vector<char>> requests(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    std::copy_if(items.begin(), items.end(), std::back_inserter(ofRanks[rank]),
      [&](const Item& item) { return meet(boxOf(item), this->BoundsOfRanks[rank]); });
    if (!ofRanks[rank].empty())
    {
      requests[rank] = this->request(kind);
      putAll(ofRanks[rank], requests[rank]);
    }
  }
  const auto answers = this->request(std::move(requests));
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    if (!ofRanks[rank].empty())
    {
      Reader reader = readerOf(answers[rank]);
      take(reader, ofRanks[rank]);
    }
  }
}

void PiecesSource::prepareContents(const std::vector<schlieren::Box>& boxes) const
{
  this->Contents.clear();
  for (const schlieren::Box& box : boxes)
  {
    this->Contents[keyOf(box)] = { { nothing, {} },
      std::vector<FieldRange>(this->RangesOfFields.size(), nowhere) };
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
    [this](Reader& answer, const std::vector<schlieren::Box>& ofRank)
    {
      const auto found = answer.GetAll<std::vector<PieceWorker::Content>>();
      for (std::size_t i = 0; i < ofRank.size(); ++i)
      {
        PieceWorker::Content& content = this->Contents[keyOf(ofRank[i])].content;
        extend(content.cells, found.at(i).cells);
        for (std::size_t n = 0; n < content.holds.size(); ++n)
        {
          content.holds[n] = content.holds[n] | found[i].holds[n];
        }
      }
      for (std::size_t field = 0; field < this->RangesOfFields.size(); ++field)
      {
        for (const schlieren::Box& box : ofRank)
        {
          extend(this->Contents[keyOf(box)].fields[field], answer.Get<FieldRange>());
        }
      }
    });
}

void PiecesSource::prepareSamples(const std::vector<schlieren::Lattice>& lattices) const
{
  this->Samples.clear();
  for (const schlieren::Lattice& lattice : lattices)
  {
    this->Samples[keyOf(lattice)] = {};
  }
  this->askAbout(
    PieceWorker::Sample, lattices,
    [](const schlieren::Lattice& lattice) { return boxAround(lattice, 0); },
    [this](Reader& answer, const std::vector<schlieren::Lattice>& ofRank)
    {
      for (const schlieren::Lattice& lattice : ofRank)
      {
        DataPiece::Samples more = DataPiece::Samples::Get(
          answer, static_cast<std::size_t>(lattice.size()), this->RangesOfFields.size());
        DataPiece::Samples& samples = this->Samples[keyOf(lattice)];
        if (samples.found.empty())
        {
          samples = std::move(more);
          continue;
        }
        for (std::size_t i = 0; i < more.found.size(); ++i)
        {
          if (more.found[i] && !samples.found[i]) // of several ranks the first counts
          {
            samples.found[i] = 1;
            samples.values[i] = more.values[i];
            for (std::size_t at = i; at < more.fields.size(); at += more.found.size())
            {
              samples.fields[at] = more.fields[at];
            }
          }
        }
      }
    });
}

schlieren::MediumSource::Content PiecesSource::contentOf(const schlieren::Box& box) const
{
  const bool isAll = box.low == this->Bounds.low && box.high == this->Bounds.high;
  const PieceWorker::Content found =
    isAll ? PieceWorker::Content{ this->All, {} } : this->Contents.at(keyOf(box)).content;
  Content content{ 1, 0, nothing.cellSize, false, false, false };
  const std::array<Point, 9> tested = GasBoundary::testedPlaces(box);
  this->Boundary->findPlaces(
    box,
    [&](const Point& place)
    {
      const auto at = std::find(tested.begin(), tested.end(), place);
      return at != tested.end() &&
        (isAll || found.holds[static_cast<std::size_t>(at - tested.begin())] != 0);
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

void PiecesSource::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  const DataPiece::Samples& samples = this->Samples.at(keyOf(lattice));
  const auto size = static_cast<std::size_t>(lattice.size());
  std::fill_n(refractivity, size, 0.);
  std::copy(samples.values.begin(), samples.values.end(), refractivity);
  LatticesOfMesh* const lattices = this->Mesh.lattices.get();
  if (const auto known = lattices ? lattices->find(lattice, distances) : nullptr)
  {
    known->copyTo(places, distances, size);
    return;
  }
  const std::vector<unsigned char> none(samples.found.empty() ? size : 0, 0);
  this->Boundary->sample(
    lattice, none.empty() ? samples.found.data() : none.data(), places, distances);
  if (lattices && lattices->hasRoomFor(lattice))
  {
    lattices->keep(lattice, knownLattice({}, places, distances, size));
  }
}

schlieren::MediumSource::FieldRange PiecesSource::rangeOfField(
  int field, const schlieren::Box& box) const
{
  const auto number = static_cast<std::size_t>(field);
  const auto found = this->Contents.find(keyOf(box));
  return found == this->Contents.end() ? this->RangesOfFields[number]
                                       : found->second.fields[number];
}

void PiecesSource::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  this->sample(lattice, refractivity, places, distances);
  const std::vector<double>& fields = this->Samples.at(keyOf(lattice)).fields;
  std::fill_n(values, static_cast<std::size_t>(lattice.size()) * this->RangesOfFields.size(),
    std::numeric_limits<double>::quiet_NaN());
  std::copy(fields.begin(), fields.end(), values);
}

} // namespace filters
