// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceBoundaries.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace filters
{

namespace
{

void addTriangles(Reader& reader, BoundaryFaces& faces)
{
  Triangles& surface = faces.surface;
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
  faces.hidesBehind.insert(faces.hidesBehind.end(), hides.begin(), hides.end());
}

} // namespace

void BoundaryOfMeshes::add(Reader& reader, std::int64_t ofRank)
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

CellTree::Sizes BoundaryOfMeshes::joinedSizes() const
{
  double cellsOfSize = 1;
  for (std::size_t rank = 0; rank < this->sizes.size(); ++rank)
  {
    const auto measured = static_cast<double>(this->sizes[rank][0].size());
    cellsOfSize = measured > 0 ? std::max(cellsOfSize, this->cells[rank] / measured) : cellsOfSize;
  }
  CellTree::Sizes joined;
  for (std::size_t rank = 0; rank < this->sizes.size(); ++rank)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& all = this->sizes[rank][axis];
      const double kept =
        std::min(static_cast<double>(all.size()), this->cells[rank] / cellsOfSize);
      for (double i = 0; i < std::floor(kept); ++i)
      {
        joined[axis].push_back(
          all[static_cast<std::size_t>(i * static_cast<double>(all.size()) / kept)]);
      }
    }
  }
  return joined;
}

void BoundaryOfImage::add(Reader& reader)
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
  addTriangles(reader, this->faces);
  const auto values = reader.GetAll<std::vector<ImagePiece::OuterValue>>();
  this->outer.insert(this->outer.end(), values.begin(), values.end());
}

void BoundaryOfAmr::add(Reader& reader)
{
  ++this->parts;
  addTriangles(reader, this->faces);
  const auto values = reader.GetAll<std::vector<WeightedValue>>();
  this->outer.insert(this->outer.end(), values.begin(), values.end());
}

} // namespace filters
