// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/PiecesOfRanks.h"

#include "Cells/MeshKey.h"
#include "Common/AvailableMemory.h"
#include "Input/FlatData.h"
#include "Input/GatheredData.h"
#include "Input/OneLayer.h"
#include "Sources/ImagePiece.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGhostCellsGenerator.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Layers of cells that a point may depend on: its trend depends on the points of the cells around
/// it, and of the next ones if these are few; point values found from cells need twice as many.
constexpr int layersForPoints = 2;
constexpr int layersForCells = 4;

constexpr const char* hiddenName = "SchlierenHidden";

/// Returns whether cells have values.
bool hasCellValues(vtkDataSet* mesh)
{
  return mesh->GetCellData()->GetNumberOfArrays() > (mesh->GetCellGhostArray() ? 1 : 0);
}

/// Hashes the positions of a dataset, and of some of its points and cells.
std::uint64_t placesOf(vtkDataSet* data)
{
  Hash hash;
  const auto addPoint = [&](vtkIdType id)
  {
    double at[3];
    data->GetPoint(id, at);
    hash.add(at, 3);
  };
  constexpr vtkIdType most = 200;
  const auto forSome = [most](vtkIdType count, const auto& add)
  {
    for (vtkIdType n = 0; n < std::min(count, most); ++n)
    {
      add(count <= most ? n : n * (count / most));
    }
  };
  double bounds[6];
  data->GetBounds(bounds);
  hash.add(bounds, 6);
  hash.add(static_cast<std::uint64_t>(data->GetNumberOfPoints()));
  hash.add(static_cast<std::uint64_t>(data->GetNumberOfCells()));
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      hash.add(static_cast<std::uint64_t>(image->GetDimensions()[axis]));
    }
    return hash.value(); // sufficient for images, of which there may be many
  }
  forSome(data->GetNumberOfPoints(), addPoint);
  vtkNew<vtkIdList> points;
  forSome(data->GetNumberOfCells(),
    [&](vtkIdType cell)
    {
      data->GetCellPoints(cell, points);
      std::for_each(points->begin(), points->end(), addPoint);
    });
  return hash.value();
}

/// Lists the names, types and components of all arrays.
std::string arraysIn(vtkDataSet* data)
{
  std::string text;
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(kind);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = attributes->GetAbstractArray(i);
      const char* name = array->GetName() ? array->GetName() : "";
      if (std::string(name) != vtkDataSetAttributes::GhostArrayName())
      {
        text += std::to_string(kind) + name + '/' + std::to_string(array->GetDataType()) + '/' +
          std::to_string(array->GetNumberOfComponents()) + ';';
      }
    }
  }
  return text;
}

vtkSmartPointer<vtkDataSet> emptyOf(int type)
{
  switch (type)
  {
    case VTK_IMAGE_DATA:
      return vtkSmartPointer<vtkImageData>::New();
    case VTK_RECTILINEAR_GRID:
      return vtkSmartPointer<vtkRectilinearGrid>::New();
    case VTK_STRUCTURED_GRID:
      return vtkSmartPointer<vtkStructuredGrid>::New();
    default:
      return vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
}

bool canHaveGhostCells(int type)
{
  return type == VTK_IMAGE_DATA || type == VTK_RECTILINEAR_GRID || type == VTK_STRUCTURED_GRID ||
    type == VTK_UNSTRUCTURED_GRID;
}

/// Makes point numbers that are equal on all ranks, from positions and from the count of earlier
/// points at the same one. VTK 9.2 would compare rounded positions.
vtkSmartPointer<vtkIdTypeArray> globalIdsOf(vtkDataSet* mesh)
{
  const vtkIdType count = mesh->GetNumberOfPoints();
  std::vector<std::pair<std::uint64_t, vtkIdType>> places;
  places.reserve(static_cast<std::size_t>(count));
  for (vtkIdType id = 0; id < count; ++id)
  {
    double at[3];
    mesh->GetPoint(id, at);
    for (double& x : at)
    {
      x += 0.; // makes -0 equal 0
    }
    Hash hash;
    hash.add(at, 3);
    places.emplace_back(hash.value(), id);
  }
  std::sort(places.begin(), places.end());
  auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->SetName("SchlierenPoints");
  ids->SetNumberOfValues(count);
  std::uint64_t before = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    before = n > 0 && places[n].first == places[n - 1].first ? before + 1 : 0;
    Hash hash;
    hash.add(places[n].first);
    hash.add(before);
    ids->SetValue(places[n].second, static_cast<vtkIdType>(hash.value() >> 1));
  }
  return ids;
}

/// Copies the hidden flags of a ghost array to an array that VTK passes on like any other.
void setAsideHidden(vtkDataSet* mesh, int kind)
{
  vtkUnsignedCharArray* ghosts = mesh->GetGhostArray(kind);
  vtkNew<vtkUnsignedCharArray> hidden;
  hidden->SetName(hiddenName);
  hidden->SetNumberOfValues(mesh->GetNumberOfElements(kind));
  for (vtkIdType i = 0; i < hidden->GetNumberOfValues(); ++i)
  {
    hidden->SetValue(i, ghosts ? static_cast<unsigned char>(ghosts->GetValue(i) & ~1) : 0);
  }
  mesh->GetAttributes(kind)->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  mesh->GetAttributes(kind)->AddArray(hidden);
}

/// Restores the flags of copies and of hidden cells and points.
void restoreHidden(vtkDataSet* mesh, int kind)
{
  vtkDataSetAttributes* attributes = mesh->GetAttributes(kind);
  vtkUnsignedCharArray* ghosts = mesh->GetGhostArray(kind);
  auto* hidden = vtkUnsignedCharArray::SafeDownCast(attributes->GetArray(hiddenName));
  const int kept = kind == vtkDataObject::CELL ? 0xff : 0xfe;
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(mesh->GetNumberOfElements(kind));
  for (vtkIdType i = 0; i < flags->GetNumberOfValues(); ++i)
  {
    const int own = (ghosts ? ghosts->GetValue(i) : 0) | (hidden ? hidden->GetValue(i) : 0);
    flags->SetValue(i, static_cast<unsigned char>(own & kept));
  }
  attributes->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  attributes->RemoveArray(hiddenName);
  attributes->AddArray(flags);
}

/// Returns a rank's extent without that of ranks before it, because readers may give grids with
/// copies of others' cells. Ranks whose extents contain each other number their points separately.
PiecesOfRanks::Extent withoutOverlap(const std::vector<PiecesOfRanks::Extent>& extents,
  const std::vector<std::size_t>& ranks, std::size_t rank)
{
  const auto at =
    static_cast<std::size_t>(std::find(ranks.begin(), ranks.end(), rank) - ranks.begin());
  PiecesOfRanks::Extent own = extents[at];
  for (std::size_t n = 0; n < at; ++n)
  {
    const PiecesOfRanks::Extent& other = extents[n];
    bool overlap = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      overlap = overlap &&
        (own[2 * axis] == own[2 * axis + 1] ||
          std::max(own[2 * axis], other[2 * axis]) <
            std::min(own[2 * axis + 1], other[2 * axis + 1]));
    }
    for (std::size_t axis = 0; overlap && axis < 3; ++axis)
    {
      int& low = own[2 * axis];
      int& high = own[2 * axis + 1];
      if (other[2 * axis] < low && other[2 * axis + 1] < high)
      {
        low = other[2 * axis + 1];
        overlap = false;
      }
      else if (low < other[2 * axis] && high < other[2 * axis + 1])
      {
        high = other[2 * axis];
        overlap = false;
      }
    }
  }
  return own;
}

void crop(vtkDataSet* grid, const PiecesOfRanks::Extent& extent)
{
  if (auto* image = vtkImageData::SafeDownCast(grid))
  {
    image->Crop(extent.data());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    rectilinear->Crop(extent.data());
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    structured->Crop(extent.data());
  }
}

} // namespace

/// The description of a piece that is sent to all ranks.
struct PiecesOfRanks::Facts
{
  Slot slot;
  std::string arrays;
  struct Numbers
  {
    int type, dimension, layers;
    vtkIdType cells;
    std::uint64_t places;
    Extent extent;
    LayerBounds layer;
  } numbers;
};

PiecesOfRanks::Facts PiecesOfRanks::factsOf(const DatasetPiece& piece)
{
  Facts facts{ piece.slot, arraysIn(piece.data),
    { piece.data->GetDataObjectType(), dimensionOf(piece.data),
      hasCellValues(piece.data) ? layersForCells : layersForPoints, piece.data->GetNumberOfCells(),
      placesOf(piece.data), { 0, -1, 0, -1, 0, -1 }, layerBoundsOf(piece.data) } };
  if (isGrid(piece.data))
  {
    facts.numbers.extent = extentOf(piece.data, false);
  }
  return facts;
}

PiecesOfRanks::PiecesOfRanks(
  const Ranks& ranks, vtkDataObject* own, const std::vector<std::string>& arrays)
  : All(ranks)
{
  const std::vector<Ranks::Bytes> ofRanks = ranks.allGather(
    [&]
    {
      this->Own = own ? piecesOf(own, arrays) : std::vector<DatasetPiece>();
      Ranks::Bytes bytes;
      put(vtkUniformGridAMR::SafeDownCast(own) != nullptr, bytes);
      for (const DatasetPiece& piece : this->Own)
      {
        const Facts facts = factsOf(piece);
        putAll(facts.slot, bytes);
        putAll(facts.arrays, bytes);
        put(facts.numbers, bytes);
      }
      return bytes;
    });
  std::vector<std::vector<Facts>> all;
  std::set<std::pair<Slot, std::uint64_t>> known;
  std::vector<DatasetPiece> kept;
  for (const Ranks::Bytes& bytes : ofRanks)
  {
    const std::size_t rank = all.size();
    all.emplace_back();
    Reader reader(bytes);
    this->IsAmr = reader.Get<bool>() || this->IsAmr;
    for (std::size_t n = 0; !reader.IsAtEnd(); ++n)
    {
      Facts facts;
      facts.slot = reader.GetAll<Slot>();
      facts.arrays = reader.GetAll<std::string>();
      facts.numbers = reader.Get<Facts::Numbers>();
      if (known.emplace(facts.slot, facts.numbers.places).second)
      {
        all.back().push_back(std::move(facts));
        if (rank == ranks.rank())
        {
          kept.push_back(this->Own[n]);
        }
      }
    }
  }
  this->Own = std::move(kept);
  this->findDatasets(all);
}

void PiecesOfRanks::findDatasets(const std::vector<std::vector<Facts>>& all)
{
  std::map<Slot, Dataset> datasets;
  std::map<Slot, std::string> arrays;
  std::vector<LayerBounds> layers; // of all pieces with 3-D cells
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    for (const Facts& facts : all[rank])
    {
      const Facts::Numbers& numbers = facts.numbers;
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
  this->IsOneLayer = areOneLayer(layers);
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
  return !areDivisible || dimension < 3 || this->IsOneLayer || (areImages && !isOneImage)
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
  const auto sizes = this->All.allGather(
    [&]
    {
      Ranks::Bytes size;
      put(static_cast<double>(own.size()), size);
      return size;
    });
  double bytes = 0;
  for (const Ranks::Bytes& size : sizes)
  {
    bytes += Reader(size).Get<double>();
  }
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

std::vector<PiecesOfRanks::Piece> PiecesOfRanks::withGhostCells()
{
  const bool isImage = this->kind() == Kind::Image;
  std::vector<Piece> result;
  for (std::size_t n = 0; n < this->Datasets.size(); ++n)
  {
    const Dataset& dataset = this->Datasets[n];
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
    Extent extent{ 0, -1, 0, -1, 0, -1 };
    if (own && isGrid(own))
    {
      extent = extentOf(own, false);
    }
    const bool hasGhosts = dataset.ranks.size() > 1;
    if (hasGhosts)
    {
      const vtkSmartPointer<vtkDataSet> given = emptyOf(dataset.type);
      if (own)
      {
        given->ShallowCopy(own);
      }
      if (own)
      {
        setAsideHidden(given, vtkDataObject::POINT);
        setAsideHidden(given, vtkDataObject::CELL);
      }
      if (own && isGrid(own))
      {
        extent = withoutOverlap(dataset.extents, dataset.ranks, this->All.rank());
        crop(given, extent);
      }
      else if (own)
      {
        given->GetPointData()->SetGlobalIds(globalIdsOf(given));
      }
      vtkNew<vtkGhostCellsGenerator> generator;
      generator->SetInputData(given);
      generator->BuildIfRequiredOff();
      // Limits the layers, because VTK 9.2 reads beyond thinner grids.
      generator->SetNumberOfGhostLayers(
        std::min(isImage ? ImagePiece::layers : dataset.layers, dataset.thinnest));
      generator->Update();
      auto* made = vtkDataSet::SafeDownCast(generator->GetOutputDataObject(0));
      if (own)
      {
        own = vtkSmartPointer<vtkDataSet>::Take(made->NewInstance());
        own->ShallowCopy(made);
        own->GetPointData()->SetGlobalIds(nullptr);
        own->GetPointData()->RemoveArray("SchlierenPoints");
        restoreHidden(own, vtkDataObject::POINT);
        restoreHidden(own, vtkDataObject::CELL);
      }
    }
    if (own)
    {
      result.push_back({ own, static_cast<std::uint32_t>(n), extent, dataset.whole });
    }
  }
  return result;
}

} // namespace filters
