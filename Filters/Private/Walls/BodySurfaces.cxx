// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/BodySurfaces.h"

#include "Input/CoincidentPoints.h"
#include "Walls/BodyTriangles.h"
#include "Walls/LatticeDistances.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace filters
{

namespace
{

/// Merges equal points of the triangles.
Triangles surfaceOf(vtkDataObject* bodies)
{
  Triangles surface;
  const vtkSmartPointer<vtkPolyData> data = trianglesOfBodies(bodies);
  surface.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < surface.points.size(); ++i)
  {
    data->GetPoint(static_cast<vtkIdType>(i), surface.points[i].data());
  }
  auto iterator = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* ids;
    iterator->GetCurrentCell(count, ids);
    surface.corners.push_back({ static_cast<std::int32_t>(ids[0]),
      static_cast<std::int32_t>(ids[1]), static_cast<std::int32_t>(ids[2]) });
  }

  const double rounding = relativeRounding(surface.points);
  std::vector<double> edges(surface.points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double edge = norm(surface.corner(t, i) - surface.corner(t, (i + 1) % 3));
      for (const std::size_t end : { i, (i + 1) % 3 })
      {
        const auto point = static_cast<std::size_t>(surface.corners[t][end]);
        if (edge > rounding * norm(surface.points[point]))
        {
          edges[point] = std::min(edges[point], edge);
        }
      }
    }
  }
  const std::vector<std::int32_t> merged = coincidentPoints(surface.points, edges);
  std::vector<std::pair<Triangles::Corners, Triangles::Corners>> sorted; // to find duplicates
  for (Triangles::Corners corners : surface.corners)
  {
    for (std::int32_t& corner : corners)
    {
      corner = merged[static_cast<std::size_t>(corner)];
    }
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
    {
      Triangles::Corners key = corners;
      std::sort(key.begin(), key.end());
      sorted.emplace_back(key, corners);
    }
  }
  std::stable_sort(
    sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  surface.corners.clear();
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    if (i == 0 || sorted[i].first != sorted[i - 1].first)
    {
      surface.corners.push_back(sorted[i].second);
    }
  }
  return surface;
}

/// Numbers the closed parts, of triangles connected by points, for each triangle. -1: open parts.
std::vector<std::int32_t> closedParts(const Triangles& surface, std::int32_t& numberOfParts)
{
  Classes ofPoints(surface.points.size());
  const auto rootOf = [&](std::int32_t i) { return ofPoints.rootOf(static_cast<std::size_t>(i)); };
  for (const Triangles::Corners& corners : surface.corners)
  {
    for (const std::int32_t corner : { corners[1], corners[2] })
    {
      ofPoints.join(static_cast<std::size_t>(corners[0]), static_cast<std::size_t>(corner));
    }
  }
  std::vector<unsigned char> isOpen(surface.points.size(), 0); // of roots
  const std::vector<EdgeOfTriangle> edges = edgesOf(surface);
  for (auto edge = edges.begin(); edge != edges.end();)
  {
    const auto next = std::find_if(
      edge, edges.end(), [&](const EdgeOfTriangle& other) { return !other.isSameEdge(*edge); });
    if ((next - edge) % 2 != 0)
    {
      isOpen[rootOf(edge->low)] = 1;
    }
    edge = next;
  }
  std::vector<std::int32_t> numbers(surface.points.size(), -1), parts;
  numberOfParts = 0;
  for (const Triangles::Corners& corners : surface.corners)
  {
    const std::size_t root = rootOf(corners[0]);
    if (!isOpen[root] && numbers[root] < 0)
    {
      numbers[root] = numberOfParts++;
    }
    parts.push_back(numbers[root]);
  }
  return parts;
}

/// Turns the triangles of closed parts whose normals point inward. Parts without a volume become
/// open ones.
void turnOutward(Triangles& surface, std::vector<std::int32_t>& parts, std::int32_t numberOfParts)
{
  constexpr double rounding = 1e-12;
  std::vector<double> volumes(static_cast<std::size_t>(numberOfParts), 0), largest(volumes);
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    if (parts[t] >= 0)
    {
      const auto part = static_cast<std::size_t>(parts[t]);
      const Point normal = surface.normal(t), height = surface.corner(t, 0) - surface.points[0];
      volumes[part] += dot(normal, height);
      largest[part] += norm(normal) * norm(height);
    }
  }
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    const auto part = static_cast<std::size_t>(std::max(parts[t], 0));
    if (parts[t] >= 0 && std::abs(volumes[part]) <= rounding * largest[part])
    {
      parts[t] = -1;
    }
    else if (parts[t] >= 0 && volumes[part] < 0)
    {
      std::swap(surface.corners[t][1], surface.corners[t][2]);
    }
  }
}

/// Returns whether a line along x at (y, z) crosses the edge ab; exactly the same for both
/// triangles of an edge, so that no line slips through between them.
bool isPassed(Point a, Point b, double y, double z)
{
  if ((a[2] > z) == (b[2] > z))
  {
    return false;
  }
  if (b[2] < a[2])
  {
    std::swap(a, b);
  }
  return y < a[1] + (z - a[2]) / (b[2] - a[2]) * (b[1] - a[1]);
}

} // namespace

BodySurfaces::BodySurfaces(vtkDataObject* bodies)
  : Surface(surfaceOf(bodies))
  , Parts(closedParts(this->Surface, this->NumberOfParts))
  , Tree((turnOutward(this->Surface, this->Parts, this->NumberOfParts), this->Surface))
{
}

void BodySurfaces::findInside(
  const schlieren::Lattice& lattice, std::vector<unsigned char>& isInside) const
{
  isInside.assign(static_cast<std::size_t>(lattice.size()), 0);
  schlieren::Box column = boxAround(lattice, 0);
  column.low[0] = -std::numeric_limits<double>::infinity();
  std::vector<std::pair<std::int32_t, std::int32_t>> found; // part, triangle
  this->Tree.forTrianglesAt(column,
    [&](std::int32_t triangle)
    {
      const std::int32_t part = this->Parts[static_cast<std::size_t>(triangle)];
      if (part >= 0)
      {
        found.emplace_back(part, triangle);
      }
    });
  std::sort(found.begin(), found.end());

  const LatticeMetric metric(lattice);
  const auto rowAt = [&](int j, int k)
  {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(lattice.points[1]) +
             static_cast<std::size_t>(j)) *
      static_cast<std::size_t>(lattice.points[0]);
  };
  std::vector<unsigned char> flips(isInside.size(), 0);
  for (auto next = found.begin(); next != found.end();)
  {
    const std::int32_t part = next->first;
    for (; next != found.end() && next->first == part; ++next)
    {
      const auto t = static_cast<std::size_t>(next->second);
      const Point a = metric.at(this->Surface.corner(t, 0)),
                  b = metric.at(this->Surface.corner(t, 1)),
                  c = metric.at(this->Surface.corner(t, 2));
      const Point normal = cross(b - a, c - a);
      const auto firstOf = [&](std::size_t axis)
      {
        return static_cast<int>(std::clamp(std::ceil(std::min({ a[axis], b[axis], c[axis] })), 0.,
          static_cast<double>(lattice.points[axis])));
      };
      const auto lastOf = [&](std::size_t axis)
      {
        return static_cast<int>(std::clamp(std::floor(std::max({ a[axis], b[axis], c[axis] })), -1.,
          static_cast<double>(lattice.points[axis] - 1)));
      };
      for (int k = firstOf(2); k <= lastOf(2); ++k)
      {
        for (int j = firstOf(1); j <= lastOf(1); ++j)
        {
          if (isPassed(a, b, j, k) ^ isPassed(b, c, j, k) ^ isPassed(c, a, j, k))
          {
            const double x = a[0] - (normal[1] * (j - a[1]) + normal[2] * (k - a[2])) / normal[0];
            const double safe = std::isfinite(x) ? x : a[0]; // parallel to x
            const double within =
              std::clamp(safe, std::min({ a[0], b[0], c[0] }), std::max({ a[0], b[0], c[0] }));
            const double i = std::ceil(std::max(within, 0.));
            if (i < lattice.points[0])
            {
              flips[rowAt(j, k) + static_cast<std::size_t>(i)] ^= 1;
            }
          }
        }
      }
    }
    for (int k = 0; k < lattice.points[2]; ++k)
    {
      for (int j = 0; j < lattice.points[1]; ++j)
      {
        unsigned char inside = 0;
        for (std::size_t at = rowAt(j, k);
             at < rowAt(j, k) + static_cast<std::size_t>(lattice.points[0]); ++at)
        {
          inside ^= flips[at];
          flips[at] = 0;
          isInside[at] |= inside;
        }
      }
    }
  }
}

bool BodySurfaces::isInside(const Point& place) const
{
  std::vector<unsigned char> isInside;
  this->findInside({ place, { 1, 1, 1 }, { 1, 1, 1 } }, isInside);
  return isInside[0] != 0;
}

} // namespace filters
