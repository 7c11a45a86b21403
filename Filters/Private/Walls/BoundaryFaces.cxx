// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/BoundaryFaces.h"

#include "Input/CoincidentPoints.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace filters
{

namespace
{

constexpr double lookingPart = 0.05;   // depth of tests behind a face, in cell heights or edges
constexpr double cellTolerance = 4e-3; // maximum distance of points in a cell, in cell heights

/// Removes the sides of a layer across z, whose corners all have the same z.
Faces withoutSidesAcrossZ(const Faces& all)
{
  Faces faces;
  faces.points = all.points;
  faces.areDoubles = all.areDoubles;
  faces.origins = all.origins;
  for (std::size_t face = 0; face < all.size(); ++face)
  {
    const auto begin = all.corners.begin() + static_cast<std::ptrdiff_t>(all.starts[face]);
    const auto end = all.corners.begin() + static_cast<std::ptrdiff_t>(all.starts[face + 1]);
    const auto zOf = [&](std::int32_t corner)
    { return all.points[static_cast<std::size_t>(corner)][2]; };
    if (std::any_of(begin, end, [&](std::int32_t corner) { return zOf(corner) != zOf(*begin); }))
    {
      faces.corners.insert(faces.corners.end(), begin, end);
      faces.finish(all.owners[face], all.states[face]);
    }
  }
  return faces;
}

} // namespace

OpenFaces::OpenFaces(Faces faces, Extent extent)
  : All(extent == Extent::Layer ? withoutSidesAcrossZ(faces) : std::move(faces))
  , Ends(extent)
  , Rounding(relativeRounding(this->All.points))
{
  const std::vector<std::int32_t> before = this->mergePoints();
  this->removePairs(before);
}

OpenFaces::Sides OpenFaces::sidesOf(std::size_t face) const
{
  const Faces& faces = this->All;
  Sides sides{ { 0, 0, 0 }, { 0, 0, 0 }, 0, std::numeric_limits<double>::infinity() };
  const std::size_t begin = faces.starts[face], count = faces.starts[face + 1] - begin;
  const auto corner = [&](std::size_t i) -> const Point&
  { return faces.points[static_cast<std::size_t>(faces.corners[begin + i % count])]; };
  for (std::size_t i = 0; i < count; ++i)
  {
    sides.middle = sides.middle + (1. / static_cast<double>(count)) * corner(i);
    const double edge = norm(corner(i + 1) - corner(i));
    if (edge > this->Rounding * norm(corner(i)))
    {
      sides.width = std::min(sides.width, edge);
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    sides.outward = sides.outward + cross(corner(i) - sides.middle, corner(i + 1) - sides.middle);
  }
  sides.outward = unit(sides.outward);
  sides.height = 2 * dot(sides.middle - faces.owners[face], sides.outward);
  if (sides.height < 0)
  {
    sides.height = -sides.height;
    sides.outward = -1. * sides.outward;
  }
  return sides;
}

/// Merges points that coincide. Returns the corners' numbers from before.
std::vector<std::int32_t> OpenFaces::mergePoints()
{
  Faces& faces = this->All;
  std::vector<double> sizes(faces.points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t face = 0; face < faces.size(); ++face)
  {
    const Sides sides = this->sidesOf(face);
    double size = sides.width;
    if (sides.height > this->Rounding * norm(sides.middle))
    {
      size = std::min(size, sides.height);
    }
    for (std::size_t i = faces.starts[face]; i < faces.starts[face + 1]; ++i)
    {
      double& smallest = sizes[static_cast<std::size_t>(faces.corners[i])];
      smallest = std::min(smallest, size);
    }
  }
  const std::vector<std::int32_t> numbers = coincidentPoints(faces.points, sizes);
  const std::vector<std::int32_t> before = faces.corners;
  for (std::int32_t& corner : faces.corners)
  {
    corner = numbers[static_cast<std::size_t>(corner)];
  }
  return before;
}

/// Returns a face's corners without those that coincide with neighbours; empty if it has no area.
std::vector<std::int32_t> OpenFaces::distinctCorners(std::size_t face) const
{
  const Faces& faces = this->All;
  std::vector<std::int32_t> corners(
    faces.corners.begin() + static_cast<std::ptrdiff_t>(faces.starts[face]),
    faces.corners.begin() + static_cast<std::ptrdiff_t>(faces.starts[face + 1]));
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back())
  {
    corners.pop_back();
  }
  std::vector<std::int32_t> sorted = corners;
  std::sort(sorted.begin(), sorted.end());
  const bool isFolded = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  return corners.size() < 3 || isFolded ? std::vector<std::int32_t>{} : corners;
}

/// Describes a face, seen from its cell.
OpenFaces::Face OpenFaces::openFaceOf(std::size_t face, bool hidesBehind) const
{
  const Faces& faces = this->All;
  const Sides sides = this->sidesOf(face);
  std::vector<std::int32_t> corners = this->distinctCorners(face);
  Point area{ 0, 0, 0 };
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const auto at = [&](std::size_t corner) -> const Point&
    { return faces.points[static_cast<std::size_t>(corners[corner % corners.size()])]; };
    area = area + cross(at(i) - sides.middle, at(i + 1) - sides.middle);
  }
  if (dot(area, sides.outward) > 0)
  {
    std::reverse(corners.begin(), corners.end());
  }
  return { std::move(corners), sides, hidesBehind };
}

/// Returns whether cells of one dataset have two faces at the same place with different points. A
/// wall ends at points that the dataset has once, but not beyond its trailing edge, where points
/// have been merged.
bool OpenFaces::isSheet(
  const std::vector<std::int32_t>& before, std::size_t one, std::size_t other) const
{
  const Faces& faces = this->All;
  bool areOthers = false;
  for (std::size_t i = faces.starts[one]; i < faces.starts[one + 1]; ++i)
  {
    std::size_t k = faces.starts[other];
    while (k < faces.starts[other + 1] && faces.corners[k] != faces.corners[i])
    {
      ++k;
    }
    const auto leafOf = [&](std::size_t corner)
    { return faces.origins[static_cast<std::size_t>(before[corner])].leaf; };
    const bool isMerged = faces.areDoubles[static_cast<std::size_t>(before[i])] != 0;
    if (k == faces.starts[other + 1] || leafOf(i) != leafOf(k) || isMerged)
    {
      return false;
    }
    areOthers = areOthers || before[i] != before[k];
  }
  return areOthers;
}

/// Finds the faces that are not between two visible cells. `before`: corners before they were merged.
void OpenFaces::removePairs(const std::vector<std::int32_t>& before)
{
  const Faces& faces = this->All;
  struct Key
  {
    std::array<std::int32_t, 5> lowest; // number of corners, and the four lowest ones
    std::size_t face;
  };
  std::vector<Key> keys;
  keys.reserve(faces.size());
  for (std::size_t face = 0; face < faces.size(); ++face)
  {
    std::vector<std::int32_t> corners = this->distinctCorners(face);
    if (!corners.empty())
    {
      Key key{ { static_cast<std::int32_t>(corners.size()), -1, -1, -1, -1 }, face };
      std::sort(corners.begin(), corners.end());
      std::copy_n(
        corners.begin(), std::min<std::size_t>(4, corners.size()), key.lowest.begin() + 1);
      keys.push_back(key);
    }
  }
  std::sort(keys.begin(), keys.end(),
    [](const Key& a, const Key& b)
    { return std::tie(a.lowest, a.face) < std::tie(b.lowest, b.face); });

  for (auto first = keys.begin(); first != keys.end();)
  {
    const auto end =
      std::find_if(first, keys.end(), [&](const Key& key) { return key.lowest != first->lowest; });
    const Point outward = this->sidesOf(first->face).outward;
    bool isVisible[2] = { false, false }, isHidden[2] = { false, false };
    std::size_t owner[2] = { 0, 0 };
    for (; first != end; ++first)
    {
      const Sides sides = this->sidesOf(first->face);
      const int side = dot(sides.outward, outward) < 0 ? 1 : 0;
      if (faces.states[first->face] == State::Visible)
      {
        isVisible[side] = true;
        owner[side] = first->face;
      }
      else
      {
        isHidden[side] = true;
      }
    }
    if (isVisible[0] != isVisible[1])
    {
      const int side = isVisible[0] ? 0 : 1;
      this->Open.push_back(this->openFaceOf(owner[side], isHidden[1 - side]));
    }
    else if (!isVisible[0] && isHidden[0] != isHidden[1])
    {
      this->Hidden.push_back(this->openFaceOf((first - 1)->face, true));
    }
    else if (isVisible[0] && this->isSheet(before, owner[0], owner[1]))
    {
      this->Sheets.push_back(this->openFaceOf(owner[0], false));
      this->Sheets.push_back(this->openFaceOf(owner[1], false));
    }
  }
}

Point OpenFaces::behind(const Face& face)
{
  const double step = std::max(
    lookingPart * std::min(face.sides.height, face.sides.width), cellTolerance * face.sides.height);
  return face.sides.middle + step * face.sides.outward;
}

std::vector<Point> OpenFaces::middles() const
{
  std::vector<Point> places(this->Open.size());
  std::transform(this->Open.begin(), this->Open.end(), places.begin(), behind);
  return places;
}

std::vector<Point> OpenFaces::corners(const Flags& areMiddlesInCells) const
{
  std::vector<Point> places;
  for (std::size_t i = 0; i < this->Open.size(); ++i)
  {
    const Face& face = this->Open[i];
    for (std::size_t n = 0; areMiddlesInCells[i] && n < face.corners.size(); ++n)
    {
      const Point& corner = this->All.points[static_cast<std::size_t>(face.corners[n])];
      places.push_back(behind(face) + 0.8 * (corner - face.sides.middle));
    }
  }
  return places;
}

void OpenFaces::removeCovered(const Flags& areMiddlesInCells, const Flags& areCornersInCells)
{
  std::size_t left = 0;
  auto next = areCornersInCells.begin();
  for (std::size_t i = 0; i < this->Open.size(); ++i)
  {
    bool isCovered = areMiddlesInCells[i] != 0;
    if (isCovered)
    {
      const auto end = next + static_cast<std::ptrdiff_t>(this->Open[i].corners.size());
      isCovered = std::all_of(next, end, [](unsigned char is) { return is != 0; });
      next = end;
    }
    if (!isCovered)
    {
      std::swap(this->Open[left++], this->Open[i]);
    }
  }
  this->Open.resize(left);
}

BoundaryFaces OpenFaces::boundary(Outside outside) const
{
  BoundaryFaces result;
  result.extent = this->Ends;
  std::vector<const Face*> kept;
  const auto pointerTo = [](const Face& face) { return &face; };
  std::transform(this->Open.begin(), this->Open.end(), std::back_inserter(kept), pointerTo);
  if (outside != Outside::Passes)
  {
    std::transform(this->Sheets.begin(), this->Sheets.end(), std::back_inserter(kept), pointerTo);
  }
  const Faces& faces = this->All;
  std::vector<std::int32_t> numbers(faces.points.size(), -1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkUnsignedCharArray> hides;
  hides->SetName("hides");
  const auto numberOf = [&](std::int32_t corner)
  {
    const auto from = static_cast<std::size_t>(corner);
    if (numbers[from] < 0)
    {
      numbers[from] = static_cast<std::int32_t>(result.surface.points.size());
      result.origins.push_back(faces.origins[from]);
      result.surface.points.push_back(faces.points[from]);
      points->InsertNextPoint(faces.points[from].data());
    }
    return numbers[from];
  };
  for (const Face* face : kept)
  {
    polygons->InsertNextCell(static_cast<int>(face->corners.size()));
    for (const std::int32_t corner : face->corners)
    {
      polygons->InsertCellPoint(numberOf(corner));
    }
    hides->InsertNextValue(face->hidesBehind ? 1 : 0);
  }
  for (const Face& face : this->Hidden)
  {
    for (std::size_t i = 2; i < face.corners.size(); ++i)
    {
      result.ends.push_back(
        { numberOf(face.corners[0]), numberOf(face.corners[i - 1]), numberOf(face.corners[i]) });
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetCellData()->AddArray(hides);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(data);
  triangles->Update();
  auto* hidesOf =
    vtkUnsignedCharArray::SafeDownCast(triangles->GetOutput()->GetCellData()->GetArray("hides"));
  auto iterator = vtk::TakeSmartPointer(triangles->GetOutput()->GetPolys()->NewIterator());
  vtkIdType cell = 0;
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* ids;
    iterator->GetCurrentCell(count, ids);
    result.surface.corners.push_back({ static_cast<std::int32_t>(ids[0]),
      static_cast<std::int32_t>(ids[1]), static_cast<std::int32_t>(ids[2]) });
    result.hidesBehind.push_back(hidesOf->GetValue(cell++));
  }
  return result;
}

std::vector<double> valuesAt(
  const std::vector<LeafPoint>& points, const std::vector<vtkDataSet*>& leaves)
{
  std::vector<vtkDataArray*> scalars;
  for (vtkDataSet* leaf : leaves)
  {
    scalars.push_back(leaf->GetPointData()->GetScalars());
  }
  std::vector<double> values;
  for (const auto& [leaf, point] : points)
  {
    values.push_back(scalars[leaf] ? scalars[leaf]->GetComponent(point, 0) : 0);
  }
  return values;
}

} // namespace filters
