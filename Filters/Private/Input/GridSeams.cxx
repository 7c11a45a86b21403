// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/GridSeams.h"

#include "Input/CoincidentPoints.h"
#include "Input/DatasetPieces.h"

#include "vtkDataSet.h"
#include "vtkStructuredData.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

namespace filters
{

namespace
{

using Extent = std::array<int, 6>;

vtkIdType numberOf(const Extent& whole, std::array<int, 3> at)
{
  return vtkStructuredData::ComputePointIdForExtent(whole.data(), at.data());
}

/// Calls visit(corners) for the face of each cell on one side of a grid, until it returns true.
template <class Visit>
bool anyFace(const Extent& whole, std::size_t axis, int side, const Visit& visit)
{
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<int, 3> at{};
  at[axis] = side;
  for (int j = whole[2 * v]; j < whole[2 * v + 1]; ++j)
  {
    for (int i = whole[2 * u]; i < whole[2 * u + 1]; ++i)
    {
      std::array<vtkIdType, 4> corners{};
      for (int corner = 0; corner < 4; ++corner)
      {
        at[u] = i + corner % 2;
        at[v] = j + corner / 2;
        corners[static_cast<std::size_t>(corner)] = numberOf(whole, at);
      }
      if (visit(corners))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

void addOuterPoints(vtkDataSet* piece, const Extent& whole, OuterPoints& points)
{
  const Extent own = extentOf(piece, false);
  const auto isOnSide = [&](std::size_t axis, int i)
  { return i == whole[2 * axis] || i == whole[2 * axis + 1]; };
  vtkIdType id = 0;
  for (int k = own[4]; k <= own[5]; ++k)
  {
    for (int j = own[2]; j <= own[3]; ++j)
    {
      for (int i = own[0]; i <= own[1]; ++i, ++id)
      {
        if (isOnSide(0, i) || isOnSide(1, j) || isOnSide(2, k))
        {
          piece->GetPoint(id, points[numberOf(whole, { i, j, k })].data());
        }
      }
    }
  }
}

bool hasSeam(const OuterPoints& points, const Extent& whole, const std::array<bool, 3>& across)
{
  std::vector<Point> places;
  std::map<vtkIdType, std::size_t> order;
  for (const auto& [number, place] : points)
  {
    order[number] = places.size();
    places.push_back(place);
  }
  const std::vector<double> noEdges(places.size(), std::numeric_limits<double>::infinity());
  const std::vector<std::int32_t> firsts =
    coincidentPoints(places, mergingTolerances(places, noEdges, relativeRounding(places)));
  bool doCoincide = false;
  for (std::size_t i = 0; i < firsts.size() && !doCoincide; ++i)
  {
    doCoincide = static_cast<std::size_t>(firsts[i]) != i;
  }
  if (!doCoincide)
  {
    return false;
  }
  std::set<std::set<std::int32_t>> known;
  const auto placeOf = [&](vtkIdType number)
  {
    const auto at = order.find(number);
    return at != order.end() ? firsts[at->second] : -1;
  };
  const auto isSeam = [&](std::size_t axis, const std::array<vtkIdType, 4>& corners)
  {
    std::array<std::int32_t, 4> ends{};
    std::transform(corners.begin(), corners.end(), ends.begin(), placeOf);
    const std::set<std::int32_t> face(ends.begin(), ends.end());
    if (face.count(-1) != 0)
    {
      return false; // no rank has it
    }
    const bool collapses = (across[(axis + 1) % 3] && (ends[0] == ends[1] || ends[2] == ends[3])) ||
      (across[(axis + 2) % 3] && (ends[0] == ends[2] || ends[1] == ends[3]));
    return collapses || (face.size() == corners.size() && !known.insert(face).second);
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const std::size_t end : { 2 * axis, 2 * axis + 1 })
    {
      if (anyFace(whole, axis, whole[end],
            [&](const std::array<vtkIdType, 4>& corners) { return isSeam(axis, corners); }))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace filters
