// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/CurvedFaces.h"

#include "Input/CoincidentPoints.h"

#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <unordered_map>
#include <utility>

namespace filters
{

namespace
{

constexpr int divisions = 4; // of an edge

struct CurvedFace
{
  vtkIdType cell;
  int number;                       // in the cell
  std::array<vtkIdType, 4> corners; // points of the leaf, the last one -1 in triangles
};

using Key = std::array<vtkIdType, 4>;

/// Takes away the faces that two cells have: those of one key of which `areOne` is true.
template <class KeyOf, class AreOne>
void removePairs(std::vector<CurvedFace>& faces, const KeyOf& keyOf, const AreOne& areOne)
{
  std::vector<std::pair<Key, std::size_t>> keys;
  keys.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    keys.emplace_back(keyOf(faces[i]), i);
    std::sort(keys.back().first.begin(), keys.back().first.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<CurvedFace> left;
  for (auto first = keys.begin(); first != keys.end();)
  {
    const auto end =
      std::find_if(first, keys.end(), [&](const auto& key) { return key.first != first->first; });
    if (end - first != 2 || !areOne(faces[first->second], faces[(first + 1)->second]))
    {
      std::for_each(first, end, [&](const auto& key) { left.push_back(faces[key.second]); });
    }
    first = end;
  }
  faces = std::move(left);
}

/// The faces of cells, and places on them.
class CellFaces
{
public:
  explicit CellFaces(vtkDataSet* data)
    : Data(data)
  {
  }

  void addTo(vtkIdType cell, std::vector<CurvedFace>& faces)
  {
    this->select(cell);
    for (int number = 0; number < this->Cell->GetNumberOfFaces(); ++number)
    {
      vtkCell* face = this->Cell->GetFace(number);
      CurvedFace curved{ cell, number, { -1, -1, -1, -1 } };
      for (int i = 0; i < std::min(4, face->GetNumberOfEdges()); ++i)
      {
        curved.corners[static_cast<std::size_t>(i)] = face->GetPointId(i);
      }
      faces.push_back(curved);
    }
  }
  vtkCell* face(const CurvedFace& curved)
  {
    this->select(curved.cell);
    return this->Cell->GetFace(curved.number);
  }
  Point place(vtkCell* face, double r, double s)
  {
    const double parametric[3] = { r, s, 0 };
    this->Weights.resize(static_cast<std::size_t>(face->GetNumberOfPoints()));
    face->InterpolateFunctions(parametric, this->Weights.data());
    Point place{ 0, 0, 0 };
    for (std::size_t i = 0; i < this->Weights.size(); ++i)
    {
      Point x;
      this->Data->GetPoint(face->GetPointId(static_cast<int>(i)), x.data());
      place = place + this->Weights[i] * x;
    }
    return place;
  }
  /// Of the points of the face at the last place.
  const std::vector<double>& weights() const { return this->Weights; }
  Point middle(const CurvedFace& curved)
  {
    const double at = curved.corners[3] < 0 ? 1. / 3 : 0.5;
    return this->place(this->face(curved), at, at);
  }
  Point middleOfCell(vtkIdType cell)
  {
    this->select(cell);
    Point sum{ 0, 0, 0 };
    const vtkIdType count = this->Cell->GetNumberOfPoints();
    for (vtkIdType i = 0; i < count; ++i)
    {
      Point x;
      this->Cell->GetPoints()->GetPoint(i, x.data());
      sum = sum + (1. / static_cast<double>(count)) * x;
    }
    return sum;
  }

private:
  void select(vtkIdType cell)
  {
    if (this->Number != cell)
    {
      this->Data->GetCell(cell, this->Cell);
      this->Number = cell;
    }
  }

  vtkDataSet* Data;
  vtkNew<vtkGenericCell> Cell;
  vtkIdType Number = -1;
  std::vector<double> Weights;
};

/// Takes away the faces that two cells have whose corners are the same places, but not the same points.
void removePairsOfPlaces(vtkDataSet* data, CellFaces& places, std::vector<CurvedFace>& faces)
{
  std::unordered_map<vtkIdType, std::size_t> numbers;
  std::vector<Point> points;
  std::vector<double> edges; // the smallest at each point
  const auto numberOf = [&](vtkIdType point)
  {
    const auto [found, isNew] = numbers.emplace(point, points.size());
    if (isNew)
    {
      data->GetPoint(point, points.emplace_back().data());
      edges.push_back(std::numeric_limits<double>::infinity());
    }
    return found->second;
  };
  for (const CurvedFace& face : faces)
  {
    const std::size_t count = face.corners[3] < 0 ? 3 : 4;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t one = numberOf(face.corners[i]);
      const std::size_t other = numberOf(face.corners[(i + 1) % count]);
      const double edge = norm(points[one] - points[other]);
      if (edge > 0)
      {
        edges[one] = std::min(edges[one], edge);
        edges[other] = std::min(edges[other], edge);
      }
    }
  }
  const std::vector<double> tolerances = mergingTolerances(points, edges, relativeRounding(points));
  const std::vector<std::int32_t> merged = coincidentPoints(points, tolerances);
  removePairs(
    faces,
    [&](const CurvedFace& face)
    {
      Key key{ -1, -1, -1, -1 };
      for (std::size_t i = 0; i < 4 && face.corners[i] >= 0; ++i)
      {
        key[i] = merged[numbers.at(face.corners[i])];
      }
      return key;
    },
    [&](const CurvedFace& one, const CurvedFace& other)
    {
      const Point middle = places.middle(one);
      const Point apart = places.middle(other) - middle;
      const Point toOne = places.middleOfCell(one.cell) - middle;
      const Point toOther = places.middleOfCell(other.cell) - middle;
      return norm(apart) <= tolerances[numbers.at(one.corners[0])] && dot(toOne, toOther) < 0;
    });
}

} // namespace

void addCurvedCells(vtkDataSet* data, std::uint32_t leaf, const std::vector<vtkIdType>& cells,
  State state, const std::function<bool(vtkIdType cell)>& isWanted, Faces& faces)
{
  CellFaces places(data);
  std::vector<CurvedFace> curved;
  for (const vtkIdType cell : cells)
  {
    places.addTo(cell, curved);
  }
  removePairs(
    curved, [](const CurvedFace& face) { return face.corners; },
    [](const CurvedFace&, const CurvedFace&) { return true; });
  removePairsOfPlaces(data, places, curved);

  for (const CurvedFace& one : curved)
  {
    if (!isWanted(one.cell))
    {
      continue;
    }
    const Point owner = places.middleOfCell(one.cell);
    vtkCell* face = places.face(one);
    const bool isTriangle = one.corners[3] < 0;
    // Row by row; those of triangles become shorter.
    std::array<std::array<std::int32_t, divisions + 1>, divisions + 1> numbers;
    for (std::size_t j = 0; j <= divisions; ++j)
    {
      for (std::size_t i = 0; i + (isTriangle ? j : 0) <= divisions; ++i)
      {
        const Point x = places.place(
          face, static_cast<double>(i) / divisions, static_cast<double>(j) / divisions);
        for (std::size_t k = 0; k < places.weights().size(); ++k)
        {
          if (places.weights()[k] != 0)
          {
            faces.contributions.push_back(
              { leaf, face->GetPointId(static_cast<int>(k)), places.weights()[k] });
          }
        }
        numbers[j][i] = faces.addPoint(x);
      }
    }
    const auto add = [&](std::initializer_list<std::int32_t> corners)
    {
      faces.corners.insert(faces.corners.end(), corners);
      faces.finish(owner, state, false, true);
    };
    for (std::size_t j = 0; j < divisions; ++j)
    {
      for (std::size_t i = 0; i + (isTriangle ? j : 0) < divisions; ++i)
      {
        if (!isTriangle)
        {
          add({ numbers[j][i], numbers[j][i + 1], numbers[j + 1][i + 1], numbers[j + 1][i] });
          continue;
        }
        add({ numbers[j][i], numbers[j][i + 1], numbers[j + 1][i] });
        if (i + j + 1 < divisions)
        {
          add({ numbers[j][i + 1], numbers[j + 1][i + 1], numbers[j + 1][i] });
        }
      }
    }
  }
}

} // namespace filters
