// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRequests.h"

#include "AmrField.h"
#include "AmrOwners.h"
#include "GatheredData.h"
#include "MeshHalo.h"
#include "PieceWorker.h"
#include "RefractivityModels.h"
#include "RefractivitySource.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

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

/// Exact, also where integers would not hold it.
double cellsIn(const Outline::Extent& extent)
{
  return static_cast<double>(extent[1] - extent[0]) * (extent[3] - extent[2]) *
    (extent[5] - extent[4]);
}

/// What all ranks say of their parts of the data.
struct Outlines
{
  struct Point
  {
    std::uint32_t rank, part, point;
  };
  struct Grid
  {
    std::uint32_t rank, part;
    Outline::Extent extent;
    int layers;
  };
  std::map<Slot, std::unordered_map<PointName, std::vector<Point>, HashOfPlace>> points;
  std::map<Slot, std::vector<Grid>> grids;
  std::vector<FieldMean::Range> ranges;
  std::vector<FieldMean::Range> rangesOfFields; // that tint
  bool isImage = false; // also of a composite, where each rank has one part of it
  Outline::Extent whole{ 0, -1, 0, -1, 0, -1 }; // of the image
  bool areAmrImages = true;                     // all that the ranks have
  bool areOfOne = false;                        // all parts, of one dataset
  std::vector<AmrImage> images;
  std::vector<std::uint64_t> firstImages; // of each rank, and the number of all

  Outlines(PieceRanks& ranks, bool hasFields);

private:
  void add(std::uint32_t rank, Reader& reader);
  void addFields(Reader& reader);
  std::vector<std::string> lacks; // of each field; empty: a rank has it

  struct PartOfImage
  {
    std::uint32_t rank;
    Slot slot;
    std::array<double, 15> place;
    double cells;
  };
  bool arePartsOfOneImage() const;
  std::vector<PartOfImage> partsOfImage;
  std::size_t parts = 0; // of any kind
};

/// Joins the ranges of fields on two ranks.
void join(std::vector<FieldMean::Range>& ranges, const std::vector<FieldMean::Range>& others)
{
  ranges.resize(std::max(ranges.size(), others.size()), { infinity, -infinity });
  for (std::size_t n = 0; n < others.size(); ++n)
  {
    ranges[n] = { std::min(ranges[n][0], others[n][0]), std::max(ranges[n][1], others[n][1]) };
  }
}

Outlines::Outlines(PieceRanks& ranks, bool hasFields)
{
  std::vector<char> request = pieceRequest(PieceWorker::Outline);
  put(hasFields, request);
  const auto answers = ranks.Request(std::vector<std::vector<char>>(ranks.Count(), request));
  for (std::uint32_t rank = 0; rank < answers.size(); ++rank)
  {
    Reader reader = readerOf(answers[rank]);
    this->firstImages.push_back(this->images.size());
    this->add(rank, reader);
  }
  this->firstImages.push_back(this->images.size());
  this->isImage = this->isImage || this->arePartsOfOneImage();
  for (const std::string& missing : this->lacks)
  {
    if (!missing.empty())
    {
      throw ArraysMissing(missing);
    }
  }
}

void Outlines::addFields(Reader& reader)
{
  join(this->rangesOfFields, reader.GetAll<std::vector<FieldMean::Range>>());
  const auto count = reader.Get<std::uint64_t>();
  for (std::size_t field = 0; field < count; ++field)
  {
    const auto lacking = reader.GetAll<std::string>();
    if (field == this->lacks.size())
    {
      this->lacks.push_back(lacking);
    }
    this->lacks[field] = lacking.empty() ? lacking : this->lacks[field];
  }
}

/// Whether they are all there is, and one on each rank, side by side.
bool Outlines::arePartsOfOneImage() const
{
  if (this->partsOfImage.empty() || this->partsOfImage.size() != this->parts)
  {
    return false;
  }
  double cells = 0;
  for (std::size_t part = 0; part < this->parts; ++part)
  {
    const PartOfImage& one = this->partsOfImage[part];
    const PartOfImage& first = this->partsOfImage[0];
    cells += one.cells;
    if (one.slot != first.slot || one.place != first.place ||
      (part > 0 && one.rank == this->partsOfImage[part - 1].rank))
    {
      return false;
    }
  }
  return cells == cellsIn(this->whole);
}

/// What PieceWorker::GiveOutline() has written.
void Outlines::add(std::uint32_t rank, Reader& reader)
{
  join(this->ranges, reader.GetAll<std::vector<FieldMean::Range>>());
  this->addFields(reader);
  const bool isPartOfImage = reader.Get<bool>();
  this->isImage = this->isImage || isPartOfImage;
  const bool areOfRank = reader.Get<bool>();
  this->areAmrImages = this->areAmrImages && areOfRank;
  const auto imagesOfRank = reader.GetAll<std::vector<AmrImage>>();
  this->images.insert(this->images.end(), imagesOfRank.begin(), imagesOfRank.end());
  for (std::uint32_t part = 0; !reader.IsAtEnd(); ++part)
  {
    const auto slot = reader.GetAll<Slot>();
    const auto isGrid = reader.Get<bool>();
    const auto extent = reader.Get<Outline::Extent>();
    const auto place = reader.Get<std::array<double, 15>>();
    const auto layers = reader.Get<int>();
    const auto names = reader.GetAll<std::vector<PointName>>();
    ++this->parts;
    this->areOfOne = this->areOfOne || slot.empty();
    if (place[3] > 0) // the spacing of an image
    {
      this->partsOfImage.push_back({ rank, slot, place, cellsIn(extent) });
    }
    if (isGrid)
    {
      this->grids[slot].push_back({ rank, part, extent, layers });
      extend(this->whole, extent);
    }
    for (std::uint32_t point = 0; point < names.size(); ++point)
    {
      this->points[slot][names[point]].push_back({ rank, part, point });
    }
  }
}

/// Calls visit(one, other) for those of two ranks.
template <class All, class Visit>
void forPairs(const All& all, const Visit& visit)
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
}

/// Adds to the requests of ranks that have parts of the same meshes or grids the cells of others that they need.
void addCopiesOfMeshes(
  PieceRanks& ranks, const Outlines& outlines, std::vector<std::vector<char>>& make)
{
  struct Wanted
  {
    Outline::Extent extent{};
    std::vector<std::uint32_t> points;
  };
  // By the rank that has cells, its part of the data, and the rank that needs them.
  std::map<std::array<std::uint32_t, 3>, Wanted> wanted;
  for (const auto& slot : outlines.points)
  {
    for (const auto& name : slot.second)
    {
      forPairs(name.second,
        [&](const Outlines::Point& one, const Outlines::Point& other) {
          wanted[{ one.rank, one.part, other.rank }].points.push_back(one.point);
        });
    }
  }
  for (const auto& slot : outlines.grids)
  {
    forPairs(slot.second,
      [&](const Outlines::Grid& one, const Outlines::Grid& other)
      {
        const auto extent = neededOf(one.extent, other.extent, other.layers);
        if (extent[0] <= extent[1])
        {
          wanted[{ one.rank, one.part, other.rank }].extent = extent;
        }
      });
  }
  std::vector<std::vector<char>> requests(make.size());
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
  const auto answers = ranks.Request(std::move(requests));
  for (std::uint32_t rank = 0; rank < answers.size(); ++rank)
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
        putAll(reader.GetAll<std::vector<char>>(), make[between[2]]);
      }
    }
  }
}

/// Of all ranks. Throws what has gone wrong.
void requestAll(PieceRanks& ranks, std::vector<std::vector<char>> requests)
{
  for (const std::vector<char>& answer : ranks.Request(std::move(requests)))
  {
    readerOf(answer);
  }
}

/// What some ranks answer is requested of one: it gets their answers behind the request's kind.
void passOn(PieceRanks& ranks, std::vector<std::vector<char>> requests, std::size_t to,
  PieceWorker::Kind kind)
{
  auto answers = ranks.Request(std::move(requests));
  requests.assign(ranks.Count(), {});
  requests[to] = pieceRequest(kind);
  for (std::vector<char>& answer : answers)
  {
    if (!answer.empty())
    {
      readerOf(answer).GetRest(requests[to]);
      std::vector<char>().swap(answer); // before the next is added
    }
  }
  readerOf(ranks.Request(std::move(requests))[to]);
}

/// Moves blocks of some images of each rank to one rank.
void moveBlocks(
  PieceRanks& ranks, const std::vector<std::vector<std::uint64_t>>& images, std::size_t to)
{
  std::vector<std::vector<char>> requests(ranks.Count());
  for (std::size_t from = 0; from < images.size(); ++from)
  {
    if (!images[from].empty())
    {
      requests[from] = pieceRequest(PieceWorker::GiveBlocks);
      putAll(images[from], requests[from]);
    }
  }
  passOn(ranks, std::move(requests), to, PieceWorker::TakeBlocks);
}

/// Gives each rank neighbouring blocks, where that saves copies. The first image of each rank, and the number of all.
std::vector<std::uint64_t> gatherNeighbours(
  PieceRanks& ranks, std::vector<std::uint64_t> firstImages, const AmrLevels& levels)
{
  const auto owners = betterOwners(levels, firstImages, AmrField::cellsOfSpline);
  if (!owners)
  {
    return firstImages;
  }
  std::vector<std::size_t> cells(owners->size()); // of each image
  for (const AmrLevel& level : levels.levels)
  {
    for (const AmrBlock& block : level.blocks)
    {
      cells[block.leaf] = volume(block.cells);
    }
  }
  constexpr std::size_t cellsAtOnce = std::size_t{ 1 } << 20; // so that rank 0 never has many
  std::vector<std::uint64_t> numbers(owners->size()), newFirst;
  std::uint64_t count = 0;
  for (std::uint64_t to = 0; to < ranks.Count(); ++to)
  {
    newFirst.push_back(count);
    const std::vector<std::vector<std::uint64_t>> none(ranks.Count());
    std::vector<std::vector<std::uint64_t>> moving = none;
    std::size_t sum = 0; // of their cells
    for (std::uint64_t from = 0; from < ranks.Count(); ++from)
    {
      for (std::uint64_t image = firstImages[from]; image < firstImages[from + 1]; ++image)
      {
        if ((*owners)[image] != to)
        {
          continue;
        }
        numbers[image] = count++;
        if (from != to)
        {
          moving[from].push_back(image);
          sum += cells[image];
        }
        if (sum > cellsAtOnce)
        {
          moveBlocks(ranks, std::exchange(moving, none), to);
          sum = 0;
        }
      }
    }
    if (sum > 0)
    {
      moveBlocks(ranks, moving, to);
    }
  }
  newFirst.push_back(count);
  std::vector<char> request = pieceRequest(PieceWorker::Renumber);
  putAll(numbers, request);
  putAll(newFirst, request);
  requestAll(ranks, std::vector<std::vector<char>>(ranks.Count(), request));
  return newFirst;
}

/// Tells all ranks the levels, and gives each the cells of others that it needs: one by one, so that rank 0 never has those of
/// many.
void exchangeBlocks(PieceRanks& ranks, const Outlines& outlines, const AmrLevels& levels)
{
  std::vector<char> request = pieceRequest(PieceWorker::Levels);
  putAll(outlines.ranges, request);
  putAll(outlines.rangesOfFields, request);
  putAll(outlines.firstImages, request);
  put(levels.flat, request);
  put(levels.origin, request);
  put(static_cast<std::uint64_t>(levels.levels.size()), request);
  for (const AmrLevel& level : levels.levels)
  {
    put(level.spacing, request);
    put(level.cells, request);
    putAll(level.blocks, request);
  }
  std::vector<std::vector<char>> requests(ranks.Count(), request);
  for (std::uint64_t rank = 0; rank < requests.size(); ++rank)
  {
    put(rank, requests[rank]);
  }
  requestAll(ranks, std::move(requests));
  const std::vector<std::uint64_t> firstImages =
    gatherNeighbours(ranks, outlines.firstImages, levels);
  for (std::uint64_t to = 0; to < ranks.Count(); ++to)
  {
    if (firstImages[to] == firstImages[to + 1])
    {
      continue;
    }
    request = pieceRequest(PieceWorker::CellsAround);
    put(to, request);
    requests.assign(ranks.Count(), request);
    requests[to].clear();
    passOn(ranks, std::move(requests), to, PieceWorker::AddCells);
  }
}

} // namespace

PieceRequests requestsForPieces(
  PieceRanks& ranks, std::uint64_t number, vtkDataObject* bodies, bool hasFields)
{
  const Outlines outlines(ranks, hasFields);
  PieceRequests requests{ {}, outlines.rangesOfFields.size(), outlines.areOfOne, {} };
  if (!outlines.isImage && outlines.areAmrImages && !outlines.images.empty())
  {
    requests.levels = findLevels(outlines.images);
  }
  for (std::uint32_t rank = 0; rank < ranks.Count(); ++rank)
  {
    std::vector<char>& make = requests.make.emplace_back(pieceRequest(PieceWorker::Make));
    put(PieceName{ number, rank }, make);
    put(requests.levels    ? PieceWorker::Blocks
        : outlines.isImage ? PieceWorker::Image
                           : PieceWorker::Meshes,
      make);
  }
  if (requests.levels)
  {
    exchangeBlocks(ranks, outlines, *requests.levels);
    return requests;
  }
  std::vector<char> ofAll;
  putAll(outlines.ranges, ofAll);
  putAll(outlines.rangesOfFields, ofAll);
  put(outlines.whole, ofAll);
  putAll(packedData(bodies, {}), ofAll);
  for (std::vector<char>& make : requests.make)
  {
    make.insert(make.end(), ofAll.begin(), ofAll.end());
  }
  addCopiesOfMeshes(ranks, outlines, requests.make);
  return requests;
}

} // namespace filters
