// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/MeshFaces.h"

#include "Cells/CellShape.h"
#include "Walls/UnsharedFaces.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

/// Returns the state of cells with each point.
std::vector<State> statesOfPoints(const MeshArrays& mesh, const WorkProgress& progress)
{
  std::vector<State> states(static_cast<std::size_t>(mesh.points()), State::Visible);
  forChunks(mesh.points(), progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        Point x;
        mesh.coordinates(i, x.data());
        if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        {
          states[static_cast<std::size_t>(i)] = State::None; // its position is not finite
        }
        else if (mesh.values() && !std::isfinite(mesh.values()[i]))
        {
          states[static_cast<std::size_t>(i)] = State::Hidden;
        }
      }
    });
  return states;
}

std::vector<State> statesOf(const MeshArrays& mesh, const WorkProgress& progress)
{
  const std::vector<State> ofPoints = statesOfPoints(mesh, progress.part(0, 0.3));
  std::vector<State> states(static_cast<std::size_t>(mesh.cells()));
  forChunks(mesh.cells(), progress.part(0.3, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        if (shapeOf(mesh.type(i)) != CellShape::Other)
        {
          State state = mesh.isVisible(i) ? State::Visible : State::Hidden;
          mesh.forPoints(i,
            [&](vtkIdType point)
            { state = std::min(state, ofPoints[static_cast<std::size_t>(point)]); });
          states[static_cast<std::size_t>(i)] = state;
        }
      }
    });
  return states;
}

/// Returns the mean of the cell's points.
Point middleOf(const MeshArrays& mesh, vtkIdType cell)
{
  vtkIdType points[8];
  const int count = cornersOf(shapeOf(mesh.type(cell)));
  mesh.points(cell, count, points);
  Point middle{ 0, 0, 0 };
  for (int i = 0; i < count; ++i)
  {
    Point x;
    mesh.coordinates(points[i], x.data());
    middle = middle + (1. / count) * x;
  }
  return middle;
}

/// Orders faces by cells and points, because their order depends on threads.
std::vector<std::size_t> orderOf(const std::vector<OwnedFace>& faces)
{
  using Key = std::array<vtkIdType, 4>; // cell, and the face's three lowest points
  std::vector<std::pair<Key, std::size_t>> keys;
  for (std::size_t face = 0; face < faces.size(); ++face)
  {
    std::vector<vtkIdType> points = faces[face].points;
    points.resize(std::max<std::size_t>(3, points.size()), std::numeric_limits<vtkIdType>::max());
    std::partial_sort(points.begin(), points.begin() + 3, points.end());
    keys.push_back({ { faces[face].owner, points[0], points[1], points[2] }, face });
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& key : keys)
  {
    order.push_back(key.second);
  }
  return order;
}

/// Adds the surface of the cells of one state.
void addCells(const MeshArrays& mesh, std::uint32_t leaf, const std::vector<State>& states,
  State state, Copies copies, Faces& faces)
{
  std::vector<vtkIdType> chosen;
  chosen.reserve(static_cast<std::size_t>(std::count(states.begin(), states.end(), state)));
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    if (states[i] == state)
    {
      chosen.push_back(static_cast<vtkIdType>(i));
    }
  }
  if (chosen.empty())
  {
    return;
  }
  const std::vector<OwnedFace> found = unsharedFaces(mesh, chosen);
  vtkDataArray* doubles = mesh.data()->GetPointData()->GetArray(doublesName);
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(mesh.points()), -1);
  for (const std::size_t n : orderOf(found))
  {
    const OwnedFace& face = found[n];
    if (copies == Copies::Neighbours && mesh.isCopy(face.owner))
    {
      continue;
    }
    for (const vtkIdType point : face.points)
    {
      std::int32_t& number = numbers[static_cast<std::size_t>(point)];
      if (number < 0)
      {
        Point x;
        mesh.coordinates(point, x.data());
        const bool isDouble = doubles && doubles->GetComponent(point, 0) != 0;
        number = faces.addPoint(x, { leaf, point }, isDouble);
      }
      faces.corners.push_back(number);
    }
    faces.finish(middleOf(mesh, face.owner), state);
  }
}

} // namespace

Faces facesOf(const std::vector<vtkDataSet*>& leaves, const WorkProgress& progress, Copies copies)
{
  Faces faces;
  for (std::uint32_t number = 0; number < leaves.size(); ++number)
  {
    const auto count = static_cast<double>(leaves.size());
    const WorkProgress ofLeaf = progress.part(number / count, (number + 1) / count);
    const MeshArrays leaf(leaves[number]);
    const std::vector<State> states = statesOf(leaf, ofLeaf.part(0, 0.3));
    addCells(leaf, number, states, State::Visible, copies, faces);
    ofLeaf.reach(0.9);
    addCells(leaf, number, states, State::Hidden, copies, faces);
  }
  return faces;
}

} // namespace filters
