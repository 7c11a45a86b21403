// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/PiecesOfRanks.h"

#include "Common/AvailableMemory.h"
#include "Input/CoincidentPoints.h"
#include "Input/FlatData.h"
#include "Input/GatheredData.h"
#include "Sources/ImagePiece.h"

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkStructuredData.h"
#include "vtkUniformGridAMR.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Writes the points of a grid's piece on the sides of the whole, with their numbers in it.
void putSides(vtkDataSet* piece, const std::array<int, 6>& whole, Ranks::Bytes& bytes)
{
  const std::array<int, 6> own = extentOf(piece, false);
  vtkIdType id = 0;
  for (int k = own[4]; k <= own[5]; ++k)
  {
    for (int j = own[2]; j <= own[3]; ++j)
    {
      for (int i = own[0]; i <= own[1]; ++i, ++id)
      {
        if (i == whole[0] || i == whole[1] || j == whole[2] || j == whole[3] || k == whole[4] ||
          k == whole[5])
        {
          int at[3] = { i, j, k };
          Point x;
          piece->GetPoint(id, x.data());
          put(vtkStructuredData::ComputePointIdForExtent(whole.data(), at), bytes);
          put(x, bytes);
        }
      }
    }
  }
}

/// Returns whether the boxes of two datasets have points in common, but for rounding.
bool areInTouch(const std::array<double, 6>& a, const std::array<double, 6>& b)
{
  bool are = true;
  for (std::size_t low = 0; low < 6; low += 2)
  {
    const double rounding =
      1e-6 * std::max(a[low + 1], b[low + 1]) - 1e-6 * std::min(a[low], b[low]);
    are = are && std::max(a[low], b[low]) <= std::min(a[low + 1], b[low + 1]) + rounding;
  }
  return are;
}

} // namespace

PiecesOfRanks::PiecesOfRanks(const Ranks& ranks, vtkDataObject* own,
  const std::vector<std::string>& arrays, const std::optional<std::array<double, 3>>& ofWedge)
  : All(ranks)
{
  std::vector<std::vector<PieceFacts>> all;
  std::set<std::pair<Slot, std::uint64_t>> known;
  std::vector<DatasetPiece> kept;
  ranks.allGather(
    [&]
    {
      this->Own = own ? piecesOf(own, arrays) : std::vector<DatasetPiece>();
      Ranks::Bytes bytes;
      put(vtkUniformGridAMR::SafeDownCast(own) != nullptr, bytes);
      for (const DatasetPiece& piece : this->Own)
      {
        const PieceFacts facts = factsOf(piece, ofWedge);
        putAll(facts.slot, bytes);
        putAll(facts.arrays, bytes);
        put(facts.numbers, bytes);
      }
      return bytes;
    },
    [&](Reader& reader)
    {
      const std::size_t rank = all.size();
      all.emplace_back();
      this->IsAmr = reader.Get<bool>() || this->IsAmr;
      for (std::size_t n = 0; !reader.IsAtEnd(); ++n)
      {
        PieceFacts facts;
        facts.slot = reader.GetAll<Slot>();
        facts.arrays = reader.GetAll<std::string>();
        facts.numbers = reader.Get<PieceFacts::Numbers>();
        if (known.emplace(facts.slot, facts.numbers.places).second)
        {
          all.back().push_back(std::move(facts));
          if (rank == ranks.rank())
          {
            kept.push_back(this->Own[n]);
          }
        }
      }
    });
  this->Own = std::move(kept);
  this->findDatasets(all);
  for (const Dataset& dataset : this->Datasets)
  {
    this->HasSeams = this->HasSeams || this->meetsOthers(dataset) || this->meetsItself(dataset);
  }
}

void PiecesOfRanks::findDatasets(const std::vector<std::vector<PieceFacts>>& all)
{
  std::map<Slot, Dataset> datasets;
  std::map<Slot, std::string> arrays;
  std::vector<LayerBounds> layers; // of all pieces with 3-D cells
  std::vector<std::array<double, 3>> wedges;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    for (const PieceFacts& facts : all[rank])
    {
      const PieceFacts::Numbers& numbers = facts.numbers;
      const auto [entry, isNew] = datasets.try_emplace(facts.slot);
      Dataset& dataset = entry->second;
      if (isNew)
      {
        dataset.slot = facts.slot;
        dataset.type = numbers.type;
        dataset.whole = numbers.extent;
        arrays[facts.slot] = facts.arrays;
      }
      if (arrays[facts.slot] != facts.arrays)
      {
        throw std::runtime_error(
          "The pieces of the input on several ranks have not the same arrays. Check the reader or "
          "filter that has made them.");
      }
      if (numbers.dimension == 3)
      {
        layers.push_back(numbers.layer);
        wedges.push_back(numbers.wedge);
      }
      for (std::size_t low = 0; low < 6; low += 2)
      {
        const std::array<double, 6>& bounds = numbers.layer.bounds;
        dataset.bounds[low] = isNew ? bounds[low] : std::min(dataset.bounds[low], bounds[low]);
        dataset.bounds[low + 1] =
          isNew ? bounds[low + 1] : std::max(dataset.bounds[low + 1], bounds[low + 1]);
      }
      dataset.type = dataset.type == numbers.type ? dataset.type : -1;
      dataset.dimension = std::max(dataset.dimension, numbers.dimension);
      dataset.layers = std::max(dataset.layers, numbers.layers);
      dataset.cells += static_cast<double>(numbers.cells);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        int& low = dataset.whole[2 * axis];
        int& high = dataset.whole[2 * axis + 1];
        low = std::min(low, numbers.extent[2 * axis]);
        high = std::max(high, numbers.extent[2 * axis + 1]);
        const int edge = numbers.extent[2 * axis + 1] - numbers.extent[2 * axis];
        dataset.thinnest = edge > 0 ? std::min(dataset.thinnest, edge) : dataset.thinnest;
      }
      if (dataset.ranks.empty() || dataset.ranks.back() != rank)
      {
        dataset.ranks.push_back(rank);
        dataset.extents.push_back(numbers.extent);
      }
    }
  }
  for (auto& entry : datasets)
  {
    this->Datasets.push_back(std::move(entry.second));
  }
  this->IsOneLayer = areOneLayer(layers) || areOneWedge(wedges);
}

bool PiecesOfRanks::meetsOthers(const Dataset& dataset) const
{
  return dataset.dimension == 3 &&
    std::any_of(this->Datasets.begin(), this->Datasets.end(),
      [&](const Dataset& other)
      {
        const bool isOnOneRank = dataset.ranks.size() == 1 && other.ranks == dataset.ranks;
        return &other != &dataset && other.dimension == 3 && !isOnOneRank &&
          areInTouch(dataset.bounds, other.bounds);
      });
}

/// Returns whether points on the sides of a grid coincide, as at the seam of an O-grid, the wake cut
/// of a C-grid, and a pole around which the grid is divided: VTK makes no ghost cells there, or wrong
/// ones. All ranks call it.
bool PiecesOfRanks::meetsItself(const Dataset& dataset) const
{
  if (dataset.type != VTK_STRUCTURED_GRID || dataset.dimension < 3 || dataset.ranks.size() < 2)
  {
    return false;
  }
  std::map<vtkIdType, Point> points; // by their numbers in the whole grid, which pieces share
  this->All.allGather(
    [&]
    {
      Ranks::Bytes bytes;
      for (const DatasetPiece& piece : this->Own)
      {
        if (piece.slot == dataset.slot)
        {
          putSides(piece.data, dataset.whole, bytes);
        }
      }
      return bytes;
    },
    [&](Reader& reader)
    {
      while (!reader.IsAtEnd())
      {
        const auto number = reader.Get<vtkIdType>();
        points[number] = reader.Get<Point>();
      }
    });
  std::vector<Point> places;
  std::vector<vtkIdType> numbers;
  for (const auto& [number, place] : points)
  {
    numbers.push_back(number);
    places.push_back(place);
  }
  const std::vector<std::int32_t> firsts = coincidentPoints(
    places, std::vector<double>(places.size(), std::numeric_limits<double>::infinity()));
  std::map<vtkIdType, vtkIdType> firstOf;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    firstOf[numbers[i]] = numbers[static_cast<std::size_t>(firsts[i])];
  }
  // An edge that collapses stays within pieces if they are not divided along it.
  const auto collapses = [&](vtkIdType number, vtkIdType first)
  {
    vtkIdType stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int n = dataset.whole[2 * axis + 1] - dataset.whole[2 * axis] + 1;
      const bool isDivided = std::any_of(dataset.extents.begin(), dataset.extents.end(),
        [&](const PointExtent& extent) { return extent[2 * axis] != dataset.whole[2 * axis]; });
      const auto before = firstOf.find(number - stride);
      if (!isDivided && number / stride % n > 0 && before != firstOf.end() &&
        before->second == first)
      {
        return true;
      }
      stride *= n;
    }
    return false;
  };
  return std::any_of(firstOf.begin(), firstOf.end(),
    [&](const auto& point)
    { return point.first != point.second && !collapses(point.first, point.second); });
}

double PiecesOfRanks::cells() const
{
  double cells = 0;
  for (const Dataset& dataset : this->Datasets)
  {
    cells += dataset.cells;
  }
  return cells;
}

bool PiecesOfRanks::areOnRank0() const
{
  return std::all_of(this->Datasets.begin(), this->Datasets.end(),
    [](const Dataset& dataset) { return dataset.ranks == std::vector<std::size_t>{ 0 }; });
}

PiecesOfRanks::Kind PiecesOfRanks::kind() const
{
  bool areImages = true, areDivisible = !this->IsAmr;
  int dimension = 0;
  for (const Dataset& dataset : this->Datasets)
  {
    areImages = areImages && dataset.type == VTK_IMAGE_DATA;
    areDivisible = areDivisible && canHaveGhostCells(dataset.type);
    dimension = std::max(dimension, dataset.dimension);
  }
  const bool isOneImage = areImages && this->Datasets.size() == 1 && this->Datasets[0].slot.empty();
  return !areDivisible || dimension < 3 || this->IsOneLayer || this->HasSeams ||
      (areImages && !isOneImage)
    ? Kind::Gathered
    : isOneImage ? Kind::Image
                 : Kind::Meshes;
}

vtkSmartPointer<vtkDataObject> PiecesOfRanks::gather()
{
  if (this->areOnRank0())
  {
    return nullptr;
  }
  Ranks::Bytes own;
  this->All.agree(
    [&]
    {
      for (const DatasetPiece& piece : this->Own)
      {
        pack(piece, own);
      }
    });
  double bytes = 0;
  this->All.allGather(
    [&]
    {
      Ranks::Bytes size;
      put(static_cast<double>(own.size()), size);
      return size;
    },
    [&](Reader& reader) { bytes += reader.Get<double>(); });
  this->All.agree(
    [&]
    {
      if (this->All.rank() == 0) // the pieces, and what they are joined to
      {
        requireMemory(2 * bytes, "To gather the data that the ranks have of the input on rank 0",
          "Use a coarser input.");
      }
    });
  const std::vector<Ranks::Bytes> all = this->All.gather(own, 0);
  return this->All.rank() == 0 ? gatheredData(all) : nullptr;
}

/// Returns this rank's piece of a dataset; null if it has none. All ranks call it.
vtkSmartPointer<vtkDataSet> PiecesOfRanks::ownOf(const Dataset& dataset) const
{
  vtkSmartPointer<vtkDataSet> own;
  this->All.agree(
    [&]
    {
      std::vector<vtkSmartPointer<vtkDataSet>> pieces;
      for (const DatasetPiece& piece : this->Own)
      {
        if (piece.slot == dataset.slot)
        {
          pieces.push_back(piece.data);
        }
      }
      pieces = pieces.size() > 1 ? joined(pieces) : pieces;
      if (pieces.size() > 1)
      {
        throw std::runtime_error("A rank has several pieces of one dataset of the input, which "
                                 "are no dataset together. Make them blocks of their own.");
      }
      own = pieces.empty() ? nullptr : pieces[0];
    });
  return own;
}

std::vector<PiecesOfRanks::Piece> PiecesOfRanks::withGhostCells()
{
  const bool isImage = this->kind() == Kind::Image;
  std::vector<Piece> result;
  for (const Dataset& dataset : this->Datasets)
  {
    vtkSmartPointer<vtkDataSet> own = this->ownOf(dataset);
    PointExtent extent = own && isGrid(own) ? extentOf(own, false) : noPoints;
    if (dataset.ranks.size() > 1)
    {
      if (own && isGrid(own))
      {
        const auto before = std::find(dataset.ranks.begin(), dataset.ranks.end(), this->All.rank());
        extent =
          withoutOverlap(dataset.extents, static_cast<std::size_t>(before - dataset.ranks.begin()));
      }
      // Limits the layers, because VTK 9.2 reads beyond thinner grids.
      own = filters::withGhostCells(own, dataset.type, extent,
        std::min(isImage ? ImagePiece::layers : dataset.layers, dataset.thinnest));
    }
    if (own)
    {
      result.push_back({ own, extent, dataset.whole });
    }
  }
  return result;
}

} // namespace filters
