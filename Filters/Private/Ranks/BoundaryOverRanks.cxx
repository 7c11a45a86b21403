// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/BoundaryOverRanks.h"

#include "Amr/AmrFaces.h"
#include "Sources/ImagePiece.h"
#include "Sources/KeptMesh.h"

#include "vtkSMPTools.h"

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
      std::vector<unsigned char> own(places.size(), 0);
      vtkSMPTools::For(0, static_cast<vtkIdType>(places.size()),
        [&](vtkIdType begin, vtkIdType end)
        {
          for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n)
          {
            own[n] = piece.holds(places[n]) ? 1 : 0;
          }
        });
      Ranks::Bytes bytes;
      putAll(own, bytes);
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
        image->putBoundary(bytes);
      }
      return bytes;
    },
    [&](Reader& reader) { all.add(reader); });
  facts.voxelShape = all.spacing;
  facts.direction = all.direction;
  sortTriangles(all.faces);
  return { std::make_shared<const GasBoundary>(
             std::move(all.faces), turnedBack(bodies, all.direction), Outside::Passes),
    ImagePiece::ambientOf(std::move(all.outer)) };
}

/// Uses what is kept if the meshes are equal. Returns false if not.
bool reuse(const Ranks& ranks, const MeshPiece& piece, const std::vector<std::uint64_t>& keys,
  KeptMesh& kept, std::vector<double>& values)
{
  if (kept.keys != keys)
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
  kept.beginStep();
  return true;
}

BoundaryOverRanks boundaryOfMeshes(const Ranks& ranks, const MeshPiece& piece,
  const std::vector<std::uint64_t>& keys, Outside outside, vtkDataObject* bodies, KeptMesh& kept,
  DataPiece::Facts& facts)
{
  std::vector<double> values; // at the face points of all ranks' meshes
  if (!reuse(ranks, piece, keys, kept, values))
  {
    ++kept.builds;
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
    kept.voxelShape = CellTree::voxelShapeOf(std::move(all.cells));
    BoundaryFaces faces = boundaryOf(
      std::move(all.faces),
      [&](const std::vector<Point>& places) { return hold(ranks, piece, places); },
      outside == Outside::Passes ? Sheets::Ignored : Sheets::Walls);
    kept.origins = faces.origins;
    kept.boundary = std::make_shared<const GasBoundary>(std::move(faces), bodies, outside);
    kept.keys = keys;
    kept.lattices = nullptr;
  }
  facts.voxelShape = kept.voxelShape;
  return { kept.boundary, kept.boundary->ambient(valuesOf(kept.origins, values)) };
}

} // namespace

BoundaryOverRanks findBoundary(const Ranks& ranks, const DataPiece& piece, bool isImage,
  std::vector<std::uint64_t> keys, Outside outside, vtkDataObject* bodies, KeptMesh& kept,
  DataPiece::Facts& facts)
{
  if (isImage)
  {
    return boundaryOfImage(ranks, dynamic_cast<const ImagePiece*>(&piece), bodies, facts);
  }
  keys.push_back(keyOfWalls(outside, bodies));
  return boundaryOfMeshes(
    ranks, dynamic_cast<const MeshPiece&>(piece), keys, outside, bodies, kept, facts);
}

} // namespace filters
