// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/BoundaryFaces.h"

#include "Input/CoincidentPoints.h"
#include "Walls/NarrowGaps.h"

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
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace filters
{

namespace
{

constexpr double lookingPart = 0.05;   // depth of tests behind a face, in cell heights or edges
constexpr double gapPart = 0.3;        // the same beside narrow gaps, in cell heights
constexpr double cellTolerance = 4e-3; // maximum distance of points in a cell, in cell heights

/// Removes the sides of a layer across z, whose corners all have the same z.
Faces withoutSidesAcrossZ(const Faces& all)
{
  Faces faces;
  faces.points = all.points;
  faces.firstContributions = all.firstContributions;
  faces.contributions = all.contributions;
  for (std::size_t face = 0; face < all.size(); ++face)
  {
    const auto begin = all.corners.begin() + static_cast<std::ptrdiff_t>(all.starts[face]);
    const auto end = all.corners.begin() + static_cast<std::ptrdiff_t>(all.starts[face + 1]);
    const auto zOf = [&](std::int32_t corner)
    { return all.points[static_cast<std::size_t>(corner)][2]; };
    if (std::any_of(begin, end, [&](std::int32_t corner) { return zOf(corner) != zOf(*begin); }))
    {
      faces.corners.insert(faces.corners.end(), begin, end);
      faces.finish(all.owners[face], all.states[face], all.areParts[face] != 0);
    }
  }
  return faces;
}

Sides sidesOf(const Faces& faces, std::size_t face, double rounding)
{
  Sides sides{ { 0, 0, 0 }, { 0, 0, 0 }, 0, std::numeric_limits<double>::infinity() };
  const std::size_t begin = faces.starts[face], count = faces.starts[face + 1] - begin;
  const auto corner = [&](std::size_t i) -> const Point&
  { return faces.points[static_cast<std::size_t>(faces.corners[begin + i % count])]; };
  for (std::size_t i = 0; i < count; ++i)
  {
    sides.middle = sides.middle + (1. / static_cast<double>(count)) * corner(i);
    const double edge = norm(corner(i + 1) - corner(i));
    if (edge > rounding * norm(corner(i)))
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
std::vector<std::int32_t> mergePoints(Faces& faces, double rounding)
{
  std::vector<double> sizes(faces.points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t face = 0; face < faces.size(); ++face)
  {
    const Sides sides = sidesOf(faces, face, rounding);
    double size = sides.width;
    if (sides.height > rounding * norm(sides.middle))
    {
      size = std::min(size, sides.height);
    }
    for (std::size_t i = faces.starts[face]; i < faces.starts[face + 1]; ++i)
    {
      double& smallest = sizes[static_cast<std::size_t>(faces.corners[i])];
      smallest = std::min(smallest, size);
    }
  }
  const std::vector<std::int32_t> numbers =
    coincidentPoints(faces.points, mergingTolerances(faces.points, sizes, rounding));
  const std::vector<std::int32_t> before = faces.corners;
  for (std::int32_t& corner : faces.corners)
  {
    corner = numbers[static_cast<std::size_t>(corner)];
  }
  return before;
}

/// Returns a face's corners without those that coincide with neighbours; empty if it has no area.
std::vector<std::int32_t> distinctCorners(const Faces& faces, std::size_t face)
{
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
OpenFace openFaceOf(const Faces& faces, std::size_t face, double rounding, bool hidesBehind)
{
  const Sides sides = sidesOf(faces, face, rounding);
  std::vector<std::int32_t> corners = distinctCorners(faces, face);
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
  return { std::move(corners), sides, hidesBehind, faces.areParts[face] != 0 };
}

/// A face of two visible cells, one on each side.
using Pair = std::array<std::size_t, 2>;

/// Removes faces between two visible cells.
std::vector<OpenFace> withoutPairs(const Faces& faces, double rounding, std::vector<Pair>& pairs)
{
  struct Key
  {
    std::array<std::int32_t, 5> lowest; // number of corners, and the four lowest ones
    std::size_t face;
  };
  std::vector<Key> keys;
  keys.reserve(faces.size());
  for (std::size_t face = 0; face < faces.size(); ++face)
  {
    std::vector<std::int32_t> corners = distinctCorners(faces, face);
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

  std::vector<OpenFace> kept;
  for (auto first = keys.begin(); first != keys.end();)
  {
    const auto end =
      std::find_if(first, keys.end(), [&](const Key& key) { return key.lowest != first->lowest; });
    const Point outward = sidesOf(faces, first->face, rounding).outward;
    bool isVisible[2] = { false, false }, isHidden[2] = { false, false };
    std::size_t owner[2] = { 0, 0 };
    for (; first != end; ++first)
    {
      const Sides sides = sidesOf(faces, first->face, rounding);
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
      kept.push_back(openFaceOf(faces, owner[side], rounding, isHidden[1 - side]));
    }
    else if (isVisible[0])
    {
      pairs.push_back({ owner[0], owner[1] });
    }
  }
  return kept;
}

enum class Cuts
{
  WithinDatasets,
  BetweenThemToo
};

/// Selects pairs of faces at the same position whose points differ.
CutFaces cutsOf(
  const Faces& faces, const std::vector<std::int32_t>& before, std::vector<Pair>& pairs, Cuts which)
{
  CutFaces cuts;
  const auto isCut = [&](const Pair& pair)
  {
    CutFaces cut;
    bool areOthers = false;
    for (std::size_t i = faces.starts[pair[0]]; i < faces.starts[pair[0] + 1]; ++i)
    {
      const auto begin = faces.corners.begin();
      const auto first = begin + static_cast<std::ptrdiff_t>(faces.starts[pair[1]]);
      const auto end = begin + static_cast<std::ptrdiff_t>(faces.starts[pair[1] + 1]);
      const auto found = std::find(first, end, faces.corners[i]);
      if (found == end)
      {
        return false;
      }
      const std::int32_t points[2] = { before[i], before[static_cast<std::size_t>(found - begin)] };
      areOthers = areOthers || points[0] != points[1];
      const Contribution* of[2];
      for (int side = 0; side < 2; ++side)
      {
        const auto point = static_cast<std::size_t>(points[side]);
        of[side] = &faces.contributions[faces.firstContributions[point]];
        if (faces.firstContributions[point + 1] != faces.firstContributions[point] + 1 ||
          of[side]->leaf == Contribution::ofSeveral)
        {
          return false; // on a curved cell
        }
        cut.contributions.push_back(*of[side]);
      }
      if (which == Cuts::WithinDatasets && of[0]->leaf != of[1]->leaf)
      {
        return false;
      }
      cut.places.push_back(faces.corners[i]);
    }
    if (areOthers)
    {
      cuts.contributions.insert(
        cuts.contributions.end(), cut.contributions.begin(), cut.contributions.end());
      cuts.places.insert(cuts.places.end(), cut.places.begin(), cut.places.end());
      cuts.starts.push_back(cuts.places.size());
    }
    return areOthers;
  };
  pairs.erase(
    std::remove_if(pairs.begin(), pairs.end(), [&](const Pair& pair) { return !isCut(pair); }),
    pairs.end());
  cuts.firstContributions.resize(cuts.contributions.size() + 1);
  std::iota(cuts.firstContributions.begin(), cuts.firstContributions.end(), std::size_t{ 0 });
  for (const Pair& pair : pairs)
  {
    Point area{ 0, 0, 0 };
    const std::size_t begin = faces.starts[pair[0]], count = faces.starts[pair[0] + 1] - begin;
    const auto at = [&](std::size_t i) -> const Point&
    { return faces.points[static_cast<std::size_t>(faces.corners[begin + i % count])]; };
    for (std::size_t i = 1; i + 1 < count; ++i)
    {
      area = area + 0.5 * cross(at(i) - at(0), at(i + 1) - at(0));
    }
    cuts.areas.push_back(norm(area));
  }
  return cuts;
}

/// Removes faces beside narrow gaps between cells.
void removeAtGaps(const Faces& faces, const CellsTest& areInCells, std::vector<OpenFace>& kept)
{
  const std::vector<unsigned char> areBeside = areBesideNarrowGaps(faces.points, kept);
  std::vector<Point> places;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    if (areBeside[i])
    {
      const Sides& sides = kept[i].sides;
      places.push_back(sides.middle + (gapPart * sides.height) * sides.outward);
    }
  }
  const std::vector<unsigned char> areCovered = areInCells(places);
  auto next = areCovered.begin();
  std::size_t left = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    if (!areBeside[i] || *next++ == 0)
    {
      std::swap(kept[left++], kept[i]);
    }
  }
  kept.resize(left);
}

/// Removes faces with cells on both sides.
void removeCovered(const Faces& faces, const CellsTest& areInCells, std::vector<OpenFace>& kept)
{
  std::vector<Point> middles;
  middles.reserve(kept.size());
  for (const OpenFace& face : kept)
  {
    const double step = std::max(lookingPart * std::min(face.sides.height, face.sides.width),
      cellTolerance * face.sides.height);
    middles.push_back(face.sides.middle + step * face.sides.outward);
  }
  const std::vector<unsigned char> haveMiddle = areInCells(middles);
  std::vector<Point> corners;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    for (std::size_t n = 0; haveMiddle[i] && !kept[i].isPart && n < kept[i].corners.size(); ++n)
    {
      const Point& corner = faces.points[static_cast<std::size_t>(kept[i].corners[n])];
      corners.push_back(middles[i] + 0.8 * (corner - kept[i].sides.middle));
    }
  }
  const std::vector<unsigned char> haveCorner = areInCells(corners);
  std::size_t left = 0;
  auto next = haveCorner.begin();
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    bool isCovered = haveMiddle[i] != 0;
    if (isCovered && !kept[i].isPart)
    {
      const auto end = next + static_cast<std::ptrdiff_t>(kept[i].corners.size());
      isCovered = std::all_of(next, end, [](unsigned char is) { return is != 0; });
      next = end;
    }
    if (!isCovered)
    {
      std::swap(kept[left++], kept[i]);
    }
  }
  kept.resize(left);
}

/// Treats positions that are not finite as outside of cells.
CellsTest testInParallel(const CellTest& isInCell, const WorkProgress& progress)
{
  return [isInCell, progress](const std::vector<Point>& places)
  {
    std::vector<unsigned char> areInCells(places.size(), 0);
    forChunks(static_cast<vtkIdType>(places.size()), progress,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
        {
          const double sum = places[i][0] + places[i][1] + places[i][2];
          areInCells[i] = std::isfinite(sum) && isInCell(places[i]) ? 1 : 0;
        }
      });
    return areInCells;
  };
}

BoundaryFaces triangulate(const Faces& faces, const std::vector<OpenFace>& kept)
{
  BoundaryFaces result;
  std::vector<std::int32_t> numbers(faces.points.size(), -1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkUnsignedCharArray> hides;
  hides->SetName("hides");
  for (const OpenFace& face : kept)
  {
    polygons->InsertNextCell(static_cast<int>(face.corners.size()));
    for (const std::int32_t corner : face.corners)
    {
      const auto from = static_cast<std::size_t>(corner);
      if (numbers[from] < 0)
      {
        numbers[from] = static_cast<std::int32_t>(result.surface.points.size());
        result.contributions.insert(result.contributions.end(),
          faces.contributions.begin() + static_cast<std::ptrdiff_t>(faces.firstContributions[from]),
          faces.contributions.begin() +
            static_cast<std::ptrdiff_t>(faces.firstContributions[from + 1]));
        result.starts.push_back(result.contributions.size());
        result.surface.points.push_back(faces.points[from]);
        points->InsertNextPoint(faces.points[from].data());
      }
      polygons->InsertCellPoint(numbers[from]);
    }
    hides->InsertNextValue(face.hidesBehind ? 1 : 0);
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

} // namespace

BoundaryFaces boundaryOf(Faces faces, const CellsTest& areInCells, const ValuesOfCuts& valuesOf,
  const WorkProgress& progress, Extent extent)
{
  if (extent == Extent::Layer)
  {
    faces = withoutSidesAcrossZ(faces);
  }
  progress.reach(0.1);
  const double rounding = relativeRounding(faces.points);
  const std::vector<std::int32_t> before = mergePoints(faces, rounding);
  std::vector<Pair> pairs;
  std::vector<OpenFace> kept = withoutPairs(faces, rounding, pairs);
  progress.reach(0.3);
  if (areInCells)
  {
    removeAtGaps(faces, areInCells, kept);
    removeCovered(faces, areInCells, kept);
  }
  progress.reach(0.7);
  CutFaces cuts;
  std::vector<unsigned char> areSheets;
  if (valuesOf)
  {
    cuts = cutsOf(faces, before, pairs, Cuts::WithinDatasets);
    areSheets = findSheets(cuts, valuesOf(cuts));
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      for (std::size_t side = 0; side < 2 && areSheets[i]; ++side)
      {
        kept.push_back(openFaceOf(faces, pairs[i][side], rounding, false));
      }
    }
  }
  BoundaryFaces result = triangulate(faces, kept);
  result.extent = extent;
  result.cuts = std::move(cuts);
  result.areSheets = std::move(areSheets);
  return result;
}

CutFaces cutFacesOf(const std::vector<vtkDataSet*>& leaves, const WorkProgress& progress)
{
  Faces faces = facesOf(leaves, progress);
  const double rounding = relativeRounding(faces.points);
  const std::vector<std::int32_t> before = mergePoints(faces, rounding);
  std::vector<Pair> pairs;
  withoutPairs(faces, rounding, pairs);
  return cutsOf(faces, before, pairs, Cuts::BetweenThemToo);
}

BoundaryFaces boundaryOf(Faces faces, const std::vector<vtkDataSet*>& leaves,
  const CellTest& isInCell, const WorkProgress& progress, Extent extent, Sheets sheets)
{
  ValuesOfCuts valuesOf;
  if (sheets == Sheets::Found)
  {
    valuesOf = [&](const CutFaces& cuts)
    { return valuesAt(cuts.firstContributions, cuts.contributions, leaves); };
  }
  return boundaryOf(std::move(faces),
    isInCell ? testInParallel(isInCell, progress.part(0.3, 0.7)) : nullptr, valuesOf, progress,
    extent);
}

std::vector<double> valuesAt(const BoundaryFaces& faces, const std::vector<vtkDataSet*>& leaves)
{
  return valuesAt(faces.starts, faces.contributions, leaves);
}

std::vector<double> valuesAt(const std::vector<std::size_t>& starts,
  const std::vector<Contribution>& contributions, const std::vector<vtkDataSet*>& leaves)
{
  std::vector<vtkDataArray*> scalars;
  for (vtkDataSet* leaf : leaves)
  {
    scalars.push_back(leaf->GetPointData()->GetScalars());
  }
  std::vector<double> values(starts.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
    {
      const Contribution& fraction = contributions[k];
      values[i] += scalars[fraction.leaf]
        ? fraction.weight * scalars[fraction.leaf]->GetComponent(fraction.point, 0)
        : 0;
    }
  }
  return values;
}

} // namespace filters
