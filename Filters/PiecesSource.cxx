// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PiecesSource.h"

#include "GatheredData.h"
#include "LatticeDistances.h"
#include "MeshKey.h"
#include "RefractivitySource.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Begins to read an answer.
Reader readerOf(const std::vector<char>& answer)
{
  Reader reader(answer);
  const auto kind = reader.Get<PieceWorker::Kind>();
  const auto state = reader.Get<PieceWorker::State>();
  if (kind == PieceWorker::Answer && state == PieceWorker::Lacking)
  {
    throw ArraysMissing(reader.GetAll<std::string>());
  }
  if (kind != PieceWorker::Answer || state != PieceWorker::Done)
  {
    throw std::runtime_error(reader.GetAll<std::string>());
  }
  return reader;
}

void extend(schlieren::Box& box, const schlieren::Box& by)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::min(box.low[axis], by.low[axis]);
    box.high[axis] = std::max(box.high[axis], by.high[axis]);
  }
}

void extend(Outline::Extent& extent, const Outline::Extent& by)
{
  const bool isFirst = extent[0] > extent[1];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    int& low = extent[2 * axis];
    int& high = extent[2 * axis + 1];
    low = isFirst ? by[2 * axis] : std::min(low, by[2 * axis]);
    high = isFirst ? by[2 * axis + 1] : std::max(high, by[2 * axis + 1]);
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

constexpr CellTree::Content nothing{ 1, 0, { infinity, infinity, infinity } };

/// Of each rank some cells' sizes, and how many cells it has: of all ranks the same part.
CellTree::Sizes joined(
  const std::vector<CellTree::Sizes>& ofRanks, const std::vector<double>& cells)
{
  double cellsOfSize = 1;
  for (std::size_t rank = 0; rank < ofRanks.size(); ++rank)
  {
    const auto measured = static_cast<double>(ofRanks[rank][0].size());
    cellsOfSize = measured > 0 ? std::max(cellsOfSize, cells[rank] / measured) : cellsOfSize;
  }
  CellTree::Sizes sizes;
  for (std::size_t rank = 0; rank < ofRanks.size(); ++rank)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& all = ofRanks[rank][axis];
      const double kept = std::min(static_cast<double>(all.size()), cells[rank] / cellsOfSize);
      for (double i = 0; i < std::floor(kept); ++i)
      {
        sizes[axis].push_back(
          all[static_cast<std::size_t>(i * static_cast<double>(all.size()) / kept)]);
      }
    }
  }
  return sizes;
}

/// Of triangles that several ranks have, one stays; points with the same place become one.
void removeCopies(BoundaryFaces& faces)
{
  const Triangles all = std::move(faces.surface);
  const std::vector<unsigned char> hides = std::move(faces.hidesBehind);
  faces.surface = {};
  faces.hidesBehind.clear();
  std::unordered_map<Point, std::int32_t, HashOfPlace> numbers;
  std::set<Triangles::Corners> known;
  for (std::size_t triangle = 0; triangle < all.size(); ++triangle)
  {
    Triangles::Corners corners{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Point& place = all.corner(triangle, i);
      const auto number = static_cast<std::int32_t>(faces.surface.points.size());
      const auto [found, isNew] = numbers.emplace(place, number);
      if (isNew)
      {
        faces.surface.points.push_back(place);
      }
      corners[i] = found->second;
    }
    if (known.insert(corners).second)
    {
      faces.surface.corners.push_back(corners);
      faces.hidesBehind.push_back(hides[triangle]);
    }
  }
}

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

/// Finds the ranges of fields that are those of all ranks, where the parts of one mesh on several ranks meet, and which cells
/// of others each rank needs there.
std::vector<std::vector<char>> PiecesSource::requestsForPieces(vtkDataObject* bodies) const
{
  const std::size_t ranks = this->Ranks->Count();
  struct Known
  {
    std::uint32_t rank, part, point;
  };
  struct Grid
  {
    std::uint32_t rank, part;
    Outline::Extent extent;
    int layers;
  };
  std::map<Slot, std::unordered_map<PointName, std::vector<Known>, HashOfPlace>> points;
  std::map<Slot, std::vector<Grid>> grids;
  std::vector<FieldMean::Range> ranges;
  Outline::Extent whole{ 0, -1, 0, -1, 0, -1 }; // of an image
  const auto outlines =
    this->request(std::vector<std::vector<char>>(ranks, pieceRequest(PieceWorker::Outline)));
  for (std::uint32_t rank = 0; rank < ranks; ++rank)
  {
    Reader reader = readerOf(outlines[rank]);
    const auto ofRank = reader.GetAll<std::vector<FieldMean::Range>>();
    ranges.resize(std::max(ranges.size(), ofRank.size()), { infinity, -infinity });
    for (std::size_t n = 0; n < ofRank.size(); ++n)
    {
      ranges[n] = { std::min(ranges[n][0], ofRank[n][0]), std::max(ranges[n][1], ofRank[n][1]) };
    }
    const auto parts = reader.Get<std::uint64_t>();
    for (std::uint32_t part = 0; part < parts; ++part)
    {
      const auto slot = reader.GetAll<Slot>();
      const auto isGrid = reader.Get<bool>();
      const auto extent = reader.Get<Outline::Extent>();
      const auto layers = reader.Get<int>();
      const auto names = reader.GetAll<std::vector<PointName>>();
      if (isGrid)
      {
        grids[slot].push_back({ rank, part, extent, layers });
        extend(whole, extent);
      }
      for (std::uint32_t point = 0; point < names.size(); ++point)
      {
        points[slot][names[point]].push_back({ rank, part, point });
      }
    }
  }
  // By the rank that has cells, its part of the data, and the rank that needs them.
  struct Wanted
  {
    Outline::Extent extent{};
    std::vector<std::uint32_t> points;
  };
  std::map<std::array<std::uint32_t, 3>, Wanted> wanted;
  const auto forPairs = [](const auto& all, const auto& visit)
  {
    for (const auto& one : all)
    {
      for (const auto& other : all)
      {
        if (one.rank != other.rank)
        {
          visit(one, other);
        }
      }
    }
  };
  for (const auto& slot : points)
  {
    for (const auto& name : slot.second)
    {
      forPairs(name.second,
        [&](const Known& one, const Known& other) {
          wanted[{ one.rank, one.part, other.rank }].points.push_back(one.point);
        });
    }
  }
  for (const auto& slot : grids)
  {
    forPairs(slot.second,
      [&](const Grid& one, const Grid& other)
      {
        const auto extent = neededOf(one.extent, other.extent, other.layers);
        if (extent[0] <= extent[1])
        {
          wanted[{ one.rank, one.part, other.rank }].extent = extent;
        }
      });
  }
  std::vector<std::vector<char>> requests(ranks);
  for (auto& [between, cells] : wanted)
  {
    std::vector<char>& request = requests[between[0]];
    if (request.empty())
    {
      request = pieceRequest(PieceWorker::Copies);
    }
    std::sort(cells.points.begin(), cells.points.end()); // whatever the order of the hashes
    put(std::uint64_t{ between[1] }, request);
    put(cells.extent, request);
    putAll(cells.points, request);
  }
  const auto answers = this->request(std::move(requests));
  std::vector<char> make = this->request(PieceWorker::Make);
  putAll(ranges, make);
  put(whole, make);
  putAll(packedData(bodies, {}), make);
  std::vector<std::vector<char>> ofOthers(ranks, make);
  for (std::uint32_t rank = 0; rank < ranks; ++rank)
  {
    if (answers[rank].empty())
    {
      continue;
    }
    Reader reader = readerOf(answers[rank]);
    for (const auto& [between, cells] : wanted)
    {
      if (between[0] == rank)
      {
        putAll(reader.GetAll<std::vector<char>>(), ofOthers[between[2]]);
      }
    }
  }
  return ofOthers;
}

PiecesSource::PiecesSource(std::shared_ptr<PieceRanks> ranks, vtkDataObject* bodies,
  Outside outside, PiecesMesh kept, const WorkProgress& progress)
  : Ranks(std::move(ranks))
{
  static std::atomic<std::uint64_t> sources{ 0 };
  this->Number = ++sources;
  std::vector<std::vector<char>> requests = this->requestsForPieces(bodies);
  progress.reach(0.2);

  Hash ofBodies;
  ofBodies.add(static_cast<std::uint64_t>(outside));
  addBodies(ofBodies, bodies);
  std::vector<std::uint64_t> keys{ ofBodies.value() };
  this->All = nothing;
  this->Bounds = { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  std::string lacking;
  for (const std::vector<char>& answer : this->request(std::move(requests)))
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
        this->BoundsOfRanks.back() = summary.bounds;
        extend(this->Bounds, summary.bounds);
        extend(this->All, summary.content);
        this->Cells += summary.cells;
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
  std::vector<double> values; // of meshes, at the points of all ranks' faces
  for (std::size_t rank = 0; rank < answers.size(); ++rank)
  {
    if (answers[rank].empty())
    {
      continue;
    }
    Reader reader = readerOf(answers[rank]);
    if (!isKept && reader.Get<DataPiece::BoundaryKind>() == DataPiece::BoundaryKind::OfImage)
    {
      ofImage.add(reader);
      continue;
    }
    if (!isKept)
    {
      ofMeshes.add(reader, this->CellsOfRanks[rank]);
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

/// Another rank's, which has so many cells.
void PiecesSource::BoundaryOfMeshes::add(Reader& reader, std::int64_t ofRank)
{
  this->cells.push_back(static_cast<double>(ofRank));
  for (std::vector<double>& along : this->sizes.emplace_back())
  {
    along = reader.GetAll<std::vector<double>>();
  }
  Faces more;
  more.points = reader.GetAll<std::vector<Point>>();
  more.corners = reader.GetAll<std::vector<std::int32_t>>();
  more.starts = reader.GetAll<std::vector<std::size_t>>();
  more.owners = reader.GetAll<std::vector<Point>>();
  more.states = reader.GetAll<std::vector<State>>();
  more.hidesBehind = reader.GetAll<std::vector<unsigned char>>();
  more.areParts = reader.GetAll<std::vector<unsigned char>>();
  const auto firstPoint = static_cast<std::int32_t>(faces.points.size());
  const std::size_t firstCorner = faces.corners.size();
  for (const Point& point : more.points)
  {
    // The value of each point is sent with it.
    faces.contributions.push_back({ 0, static_cast<vtkIdType>(faces.points.size()), 1 });
    faces.addPoint(point);
  }
  for (const std::int32_t corner : more.corners)
  {
    faces.corners.push_back(firstPoint + corner);
  }
  for (std::size_t face = 0; face < more.size(); ++face)
  {
    faces.starts.push_back(firstCorner + more.starts[face + 1]);
  }
  faces.owners.insert(faces.owners.end(), more.owners.begin(), more.owners.end());
  faces.states.insert(faces.states.end(), more.states.begin(), more.states.end());
  faces.hidesBehind.insert(
    faces.hidesBehind.end(), more.hidesBehind.begin(), more.hidesBehind.end());
  faces.areParts.insert(faces.areParts.end(), more.areParts.begin(), more.areParts.end());
}

/// Another rank's. Throws std::runtime_error where it has other axes.
void PiecesSource::BoundaryOfImage::add(Reader& reader)
{
  const auto from = reader.Get<Point>();
  const auto edges = reader.Get<std::array<double, 3>>();
  const auto axes = reader.Get<std::array<double, 9>>();
  if (this->parts++ > 0 &&
    (from != this->origin || edges != this->spacing || axes != this->direction))
  {
    throw std::runtime_error(
      "The parts of the image that the ranks have are not of one image: their origins, spacings or "
      "directions differ. Give all parts the same, or make blocks of them.");
  }
  this->origin = from;
  this->spacing = edges;
  this->direction = axes;
  Triangles& surface = this->faces.surface;
  const auto first = static_cast<std::int32_t>(surface.points.size());
  for (const Point& point : reader.GetAll<std::vector<Point>>())
  {
    surface.points.push_back(point);
  }
  for (const Triangles::Corners& corners : reader.GetAll<std::vector<Triangles::Corners>>())
  {
    surface.corners.push_back({ first + corners[0], first + corners[1], first + corners[2] });
  }
  const auto hides = reader.GetAll<std::vector<unsigned char>>();
  this->faces.hidesBehind.insert(this->faces.hidesBehind.end(), hides.begin(), hides.end());
  const auto values = reader.GetAll<std::vector<ImagePiece::OuterValue>>();
  this->outer.insert(this->outer.end(), values.begin(), values.end());
}

void PiecesSource::makeBoundary(
  BoundaryOfMeshes of, vtkDataObject* bodies, Outside outside, const WorkProgress& progress)
{
  this->VoxelShape = CellTree::voxelShapeOf(joined(of.sizes, of.cells));
  BoundaryFaces boundary = boundaryOf(
    std::move(of.faces), [this](const std::vector<Point>& places) { return this->hold(places); });
  this->Mesh.contributions = boundary.contributions;
  this->Boundary = std::make_shared<GasBoundary>(std::move(boundary), bodies, outside, progress);
  this->Mesh.boundary = this->Boundary;
  this->Mesh.voxelShape = this->VoxelShape;
}

void PiecesSource::makeBoundary(
  BoundaryOfImage of, vtkDataObject* bodies, const WorkProgress& progress)
{
  this->Direction = of.direction;
  this->VoxelShape = of.spacing;
  removeCopies(of.faces);
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
    this->Contents[keyOf(box)] = { nothing, {} };
  }
  this->askAbout(
    PieceWorker::Contents, boxes, [](const schlieren::Box& box) { return box; },
    [this](Reader& answer, const std::vector<schlieren::Box>& ofRank)
    {
      const auto found = answer.GetAll<std::vector<PieceWorker::Content>>();
      for (std::size_t i = 0; i < ofRank.size(); ++i)
      {
        PieceWorker::Content& content = this->Contents[keyOf(ofRank[i])];
        extend(content.cells, found.at(i).cells);
        for (std::size_t n = 0; n < content.holds.size(); ++n)
        {
          content.holds[n] = content.holds[n] | found[i].holds[n];
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
        DataPiece::Samples more;
        more.found = answer.GetAll<std::vector<unsigned char>>();
        more.values = answer.GetAll<std::vector<double>>();
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
            samples.values[i] = more.values.at(i);
          }
        }
      }
    });
}

schlieren::MediumSource::Content PiecesSource::contentOf(const schlieren::Box& box) const
{
  const bool isAll = box.low == this->Bounds.low && box.high == this->Bounds.high;
  const PieceWorker::Content found =
    isAll ? PieceWorker::Content{ this->All, {} } : this->Contents.at(keyOf(box));
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

} // namespace filters
