// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/BoundaryOverRanks.h"

#include "Sources/ImagePiece.h"
#include "Sources/MeshCache.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Selects values at some boundary points from those of all ranks.
std::vector<double> valuesOf(
  const std::vector<LeafPoint>& points, const std::vector<double>& values)
{
  std::vector<double> found;
  for (const LeafPoint& point : points)
  {
    found.push_back(values[static_cast<std::size_t>(point.point)]);
  }
  return found;
}

/// Returns which points any piece holds.
std::vector<unsigned char> hold(
  const Ranks& ranks, const DataPiece& piece, const std::vector<Point>& places)
{
  std::vector<unsigned char> are(places.size(), 0);
  ranks.allGather(
    [&]
    {
      Ranks::Bytes bytes;
      putAll(piece.hold(places), bytes);
      return bytes;
    },
    [&](Reader& reader)
    {
      const auto ofRank = reader.GetAll<std::vector<unsigned char>>();
      for (std::size_t n = 0; n < are.size(); ++n)
      {
        are[n] = are[n] | ofRank.at(n);
      }
    });
  return are;
}

/// What all ranks make of putBoundary().
struct BoundaryOfImage
{
  bool isEmpty = true;
  Point origin{};
  std::array<double, 3> spacing{};
  std::array<double, 9> direction{};
  BoundaryFaces faces;
  std::vector<ImagePiece::OuterValue> outer;

  /// Adds a rank's. Throws std::runtime_error if it has other axes.
  void add(Reader& reader);
};

void BoundaryOfImage::add(Reader& reader)
{
  if (reader.IsAtEnd())
  {
    return;
  }
  const auto from = reader.Get<Point>();
  const auto edges = reader.Get<std::array<double, 3>>();
  const auto axes = reader.Get<std::array<double, 9>>();
  if (!std::exchange(this->isEmpty, false) &&
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
  reader.AddAll(surface.points);
  for (const Triangles::Corners& corners : reader.GetAll<std::vector<Triangles::Corners>>())
  {
    surface.corners.push_back({ first + corners[0], first + corners[1], first + corners[2] });
  }
  reader.AddAll(this->faces.hidesBehind);
  reader.AddAll(this->outer);
}

/// Writes an image's axes, the triangles of its faces, which of them hide something, and N on the
/// faces of the whole image: at each point, or of more than a million at each nth.
void putBoundary(const ImagePiece& piece, Ranks::Bytes& message)
{
  const BoundaryFaces faces = piece.faces();
  const DataPiece::Facts facts = piece.facts();
  const Counts& whole = piece.whole();
  put(piece.origin(), message);
  put(facts.voxelShape, message);
  put(facts.direction, message);
  putAll(faces.surface.points, message);
  putAll(faces.surface.corners, message);
  putAll(faces.hidesBehind, message);
  const double ofFaces = 2. *
    (static_cast<double>(whole[0]) * whole[1] + static_cast<double>(whole[1]) * whole[2] +
      static_cast<double>(whole[2]) * whole[0]);
  const auto every = static_cast<std::int64_t>(std::ceil(ofFaces / schlieren::mostOuterValues));
  std::vector<ImagePiece::OuterValue> values;
  for (const ImagePiece::OuterValue& outer : piece.outer())
  {
    const std::int64_t row = outer.point / whole[0];
    const std::int64_t sum = outer.point % whole[0] + row % whole[1] + row / whole[1];
    if (sum % every == 0)
    {
      values.push_back(outer);
    }
  }
  putAll(values, message);
}

/// `image`: null on ranks that have nothing of it.
BoundaryOverRanks boundaryOfImage(
  const Ranks& ranks, const ImagePiece* image, vtkDataObject* bodies, DataPiece::Facts& facts)
{
  BoundaryOfImage all;
  ranks.allGather(
    [&]
    {
      Ranks::Bytes bytes;
      if (image)
      {
        putBoundary(*image, bytes);
      }
      return bytes;
    },
    [&](Reader& reader) { all.add(reader); });
  facts.voxelShape = all.spacing;
  facts.direction = all.direction;
  sortTriangles(all.faces.surface, all.faces.hidesBehind);
  return { std::make_shared<const GasBoundary>(
             std::move(all.faces), turnedBack(bodies, all.direction), Outside::Passes),
    ImagePiece::ambientOf(std::move(all.outer)) };
}

/// Uses what is kept if the meshes are equal. Returns false if not.
bool reuse(const Ranks& ranks, const MeshPiece& piece, const std::vector<std::uint64_t>& keys,
  MeshCache& cache, std::vector<double>& values)
{
  if (cache.keys != keys)
  {
    return false;
  }
  ranks.allGather(
    [&]
    {
      Ranks::Bytes bytes;
      piece.putBoundaryValues(bytes);
      return bytes;
    },
    [&](Reader& reader) { reader.AddAll(values); });
  cache.beginStep();
  return true;
}

BoundaryOverRanks boundaryOfMeshes(const Ranks& ranks, const MeshPiece& piece,
  const std::vector<std::uint64_t>& keys, Outside outside, vtkDataObject* bodies, MeshCache& cache,
  DataPiece::Facts& facts)
{
  std::vector<double> values; // at the face points of all ranks' meshes
  if (!reuse(ranks, piece, keys, cache, values))
  {
    ++cache.builds;
    values.clear();
    BoundaryOfMeshes all;
    ranks.allGather(
      [&]
      {
        Ranks::Bytes bytes;
        piece.putBoundary(facts.cells, bytes);
        piece.putBoundaryValues(bytes);
        return bytes;
      },
      [&](Reader& reader)
      {
        all.add(reader);
        reader.AddAll(values);
      });
    cache.voxelShape = CellTree::voxelShapeOf(std::move(all.cells));
    OpenFaces open(std::move(all.faces));
    const std::vector<unsigned char> middles = hold(ranks, piece, open.middles());
    open.removeCovered(middles, hold(ranks, piece, open.corners(middles)));
    BoundaryFaces faces = open.boundary(outside);
    cache.origins = faces.origins;
    cache.boundary = std::make_shared<const GasBoundary>(std::move(faces), bodies, outside);
    cache.keys = keys;
    cache.lattices = nullptr;
  }
  facts.voxelShape = cache.voxelShape;
  return { cache.boundary, cache.boundary->ambient(valuesOf(cache.origins, values)) };
}

} // namespace

BoundaryOverRanks findBoundary(const Ranks& ranks, const DataPiece& piece, bool isImage,
  std::vector<std::uint64_t> keys, Outside outside, vtkDataObject* bodies, MeshCache& cache,
  DataPiece::Facts& facts)
{
  if (isImage)
  {
    return boundaryOfImage(ranks, dynamic_cast<const ImagePiece*>(&piece), bodies, facts);
  }
  keys.push_back(keyOfWalls(outside, bodies));
  return boundaryOfMeshes(
    ranks, dynamic_cast<const MeshPiece&>(piece), keys, outside, bodies, cache, facts);
}

} // namespace filters
