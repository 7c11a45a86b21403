// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/PieceBoundaries.h"

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

void BoundaryOfMeshes::add(Reader& reader)
{
  const auto measured = reader.GetAll<std::vector<CellTree::MeasuredCell>>();
  this->cells.insert(this->cells.end(), measured.begin(), measured.end());
  Faces more;
  more.points = reader.GetAll<std::vector<Point>>();
  const auto datasets = reader.GetAll<std::vector<std::uint32_t>>();
  more.corners = reader.GetAll<std::vector<std::int32_t>>();
  more.starts = reader.GetAll<std::vector<std::size_t>>();
  more.owners = reader.GetAll<std::vector<Point>>();
  more.states = reader.GetAll<std::vector<State>>();
  more.areParts = reader.GetAll<std::vector<unsigned char>>();
  const auto firstPoint = static_cast<std::int32_t>(faces.points.size());
  const std::size_t firstCorner = faces.corners.size();
  for (std::size_t n = 0; n < more.points.size(); ++n)
  {
    faces.contributions.push_back(
      { datasets.at(n), static_cast<vtkIdType>(faces.points.size()), 1 });
    faces.addPoint(more.points[n]);
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
  faces.areParts.insert(faces.areParts.end(), more.areParts.begin(), more.areParts.end());
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

} // namespace filters
