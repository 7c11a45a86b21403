// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/MeshFaces.h"

#include "Cells/CellShape.h"
#include "Common/CellTypes.h"
#include "Input/CoincidentPoints.h"
#include "Input/FlatData.h"
#include "Input/RefractivityValues.h"
#include "Walls/UnsharedFaces.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkExtractCells.h"
#include "vtkGenericCell.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace filters
{

namespace
{

constexpr const char* ownersName = "OwnerOfFace";
constexpr const char* originsName = "PointOfLeaf";

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
  std::array<bool, 256> isVolume{};
  for (const int type : mesh.types())
  {
    isVolume[static_cast<std::size_t>(type)] =
      vtkCellTypeUtilities::GetDimension(static_cast<unsigned char>(type)) == 3;
  }
  forChunks(mesh.cells(), progress.part(0.3, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        if (isVolume[static_cast<std::size_t>(mesh.type(i))])
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
Point middleOf(vtkDataSet* data, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(cell, ids);
  Point middle{ 0, 0, 0 };
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    Point x;
    data->GetPoint(ids->GetId(i), x.data());
    middle = middle + (1. / static_cast<double>(ids->GetNumberOfIds())) * x;
  }
  return middle;
}

vtkSmartPointer<vtkIdTypeArray> numbersOf(vtkIdType count, const char* name)
{
  auto numbers = vtkSmartPointer<vtkIdTypeArray>::New();
  numbers->SetName(name);
  numbers->SetNumberOfValues(count);
  std::iota(numbers->GetPointer(0), numbers->GetPointer(0) + count, vtkIdType{ 0 });
  return numbers;
}

/// Extracts the surface of linear cells, with their cells' and points' numbers in the dataset.
vtkSmartPointer<vtkPolyData> surfaceOf(vtkDataSet* data, const std::vector<vtkIdType>& chosen)
{
  auto cells = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  cells->CopyStructure(data);
  cells->GetPointData()->Initialize();
  cells->GetCellData()->Initialize();
  vtkNew<vtkGeometryFilter> surface;
  surface->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  surface->SetOriginalCellIdsName(ownersName);
  surface->SetOriginalPointIdsName(originsName);
  if (chosen.size() == static_cast<std::size_t>(cells->GetNumberOfCells()))
  {
    surface->PassThroughCellIdsOn();
    surface->PassThroughPointIdsOn();
    surface->SetInputData(cells);
  }
  else
  {
    // Adds numbers of points and cells, because vtkGeometryFilter (9.2) omits faces to hidden
    // cells, and overruns arrays of structured data.
    cells->GetPointData()->AddArray(numbersOf(data->GetNumberOfPoints(), originsName));
    cells->GetCellData()->AddArray(numbersOf(data->GetNumberOfCells(), ownersName));
    vtkNew<vtkExtractCells> extract;
    extract->SetInputData(cells);
    extract->SetCellIds(chosen.data(), static_cast<vtkIdType>(chosen.size()));
    extract->AssumeSortedAndUniqueIdsOn();
    surface->SetInputConnection(extract->GetOutputPort());
  }
  surface->Update();
  return surface->GetOutput();
}

/// Finds the faces that only one of linear cells has, by VTK.
std::vector<OwnedFace> facesByVtk(vtkDataSet* data, const std::vector<vtkIdType>& chosen)
{
  const vtkSmartPointer<vtkPolyData> polygons = surfaceOf(data, chosen);
  auto* owners =
    vtkIdTypeArray::SafeDownCast(polygons->GetCellData()->GetAbstractArray(ownersName));
  auto* origins =
    vtkIdTypeArray::SafeDownCast(polygons->GetPointData()->GetAbstractArray(originsName));
  std::vector<OwnedFace> faces;
  vtkNew<vtkIdList> ids;
  for (vtkIdType face = 0; face < polygons->GetNumberOfCells(); ++face)
  {
    polygons->GetCellPoints(face, ids);
    faces.push_back({ owners->GetValue(face), {} });
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      faces.back().points.push_back(origins->GetValue(ids->GetId(i)));
    }
  }
  return faces;
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

template <class IsLeftOut>
void addPlainCells(const MeshArrays& mesh, std::uint32_t leaf, const std::vector<vtkIdType>& chosen,
  State state, const IsLeftOut& isLeftOut, Faces& faces)
{
  vtkDataSet* data = mesh.data();
  const std::vector<int> types = mesh.types();
  const bool areUsual = !mesh.isStructured() &&
    std::all_of(
      types.begin(), types.end(), [](int type) { return shapeOf(type) != CellShape::Other; });
  const std::vector<OwnedFace> found =
    areUsual ? unsharedFaces(mesh, chosen) : facesByVtk(data, chosen);
  vtkDataArray* doubles = mesh.data()->GetPointData()->GetArray(doublesName);
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(mesh.points()), -1);
  for (const std::size_t n : orderOf(found))
  {
    const OwnedFace& face = found[n];
    if (isLeftOut(face.owner))
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
        faces.contributions.push_back({ leaf, point, 1 });
        number = faces.addPoint(x, doubles && doubles->GetComponent(point, 0) != 0);
      }
      faces.corners.push_back(number);
    }
    faces.finish(middleOf(data, face.owner), state);
  }
}

constexpr int divisions = 4; // of an edge of a curved cell

/// A face's corners and further points, in any order.
using Key = std::array<vtkIdType, 5>;

struct CurvedFace
{
  vtkIdType cell;
  int number;  // in the cell
  Key corners; // points of the leaf; -1: none
};

/// Evaluates the faces of curved cells.
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
      CurvedFace curved{ cell, number, { -1, -1, -1, -1, -1 } };
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
  /// Returns the weights of the face's points at the last position.
  const std::vector<double>& weights() const { return this->Weights; }

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

/// Removes faces of two cells, those with equal keys.
void removePairs(const std::vector<Key>& keysOfFaces, std::vector<CurvedFace>& faces)
{
  std::vector<std::pair<Key, std::size_t>> keys;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    keys.emplace_back(keysOfFaces[i], i);
    std::sort(keys.back().first.begin(), keys.back().first.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<CurvedFace> left;
  for (auto first = keys.begin(); first != keys.end();)
  {
    const auto end =
      std::find_if(first, keys.end(), [&](const auto& key) { return key.first != first->first; });
    if (end - first != 2)
    {
      std::for_each(first, end, [&](const auto& key) { left.push_back(faces[key.second]); });
    }
    first = end;
  }
  faces = std::move(left);
}

/// Numbers corners and middles of faces by position, equal for duplicate points.
std::vector<Key> placesOf(vtkDataSet* data, CellFaces& cells, const std::vector<CurvedFace>& faces)
{
  std::vector<Point> points;
  std::vector<double> edges; // smallest at each position
  const auto add = [&](const Point& place)
  {
    points.push_back(place);
    edges.push_back(std::numeric_limits<double>::infinity());
    return static_cast<vtkIdType>(points.size() - 1);
  };
  std::unordered_map<vtkIdType, vtkIdType> numbers;
  std::vector<Key> keys;
  for (const CurvedFace& face : faces)
  {
    Key& key = keys.emplace_back(face.corners);
    const std::size_t count = face.corners[3] < 0 ? 3 : 4;
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto [found, isNew] = numbers.emplace(face.corners[i], 0);
      if (isNew)
      {
        Point x;
        data->GetPoint(face.corners[i], x.data());
        found->second = add(x);
      }
      key[i] = found->second;
    }
    const double at = count == 3 ? 1. / 3 : 0.5;
    key[4] = add(cells.place(cells.face(face), at, at));
    const auto placeOf = [](vtkIdType point) { return static_cast<std::size_t>(point); };
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t one = placeOf(key[i]), other = placeOf(key[(i + 1) % count]);
      const double edge = norm(points[one] - points[other]);
      for (const std::size_t end : { one, other, placeOf(key[4]) })
      {
        edges[end] = edge > 0 ? std::min(edges[end], edge) : edges[end];
      }
    }
  }
  const std::vector<std::int32_t> merged = coincidentPoints(points, edges);
  for (Key& key : keys)
  {
    for (vtkIdType& point : key)
    {
      point = point < 0 ? point : merged[static_cast<std::size_t>(point)];
    }
  }
  return keys;
}

/// Adds the curved faces of one cell only, divided into smaller ones.
template <class IsLeftOut>
void addCurvedCells(vtkDataSet* data, std::uint32_t leaf, const std::vector<vtkIdType>& chosen,
  State state, const IsLeftOut& isLeftOut, Faces& faces)
{
  CellFaces cells(data);
  std::vector<CurvedFace> curved;
  for (const vtkIdType cell : chosen)
  {
    cells.addTo(cell, curved);
  }
  std::vector<Key> keys;
  std::transform(curved.begin(), curved.end(), std::back_inserter(keys),
    [](const CurvedFace& face) { return face.corners; });
  removePairs(keys, curved);
  removePairs(placesOf(data, cells, curved), curved);

  for (const CurvedFace& one : curved)
  {
    if (isLeftOut(one.cell))
    {
      continue;
    }
    const Point owner = middleOf(data, one.cell);
    vtkCell* face = cells.face(one);
    const bool isTriangle = one.corners[3] < 0;
    // Divides row by row; rows of triangles become shorter.
    std::array<std::array<std::int32_t, divisions + 1>, divisions + 1> numbers;
    for (std::size_t j = 0; j <= divisions; ++j)
    {
      for (std::size_t i = 0; i + (isTriangle ? j : 0) <= divisions; ++i)
      {
        const Point x =
          cells.place(face, static_cast<double>(i) / divisions, static_cast<double>(j) / divisions);
        for (std::size_t k = 0; k < cells.weights().size(); ++k)
        {
          if (cells.weights()[k] != 0)
          {
            faces.contributions.push_back(
              { leaf, face->GetPointId(static_cast<int>(k)), cells.weights()[k] });
          }
        }
        numbers[j][i] = faces.addPoint(x);
      }
    }
    const auto add = [&](std::initializer_list<std::int32_t> corners)
    {
      faces.corners.insert(faces.corners.end(), corners);
      faces.finish(owner, state, true);
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

/// Adds the surface of the cells of one state.
void addCells(const MeshArrays& mesh, std::uint32_t leaf, const std::vector<State>& states,
  State state, Copies copies, Faces& faces)
{
  vtkDataSet* data = mesh.data();
  std::array<bool, 256> isLinear{};
  for (const int type : mesh.types())
  {
    isLinear[static_cast<std::size_t>(type)] =
      vtkCellTypeUtilities::IsLinear(static_cast<unsigned char>(type));
  }
  std::vector<vtkIdType> plain, curved;
  const auto count = std::count(states.begin(), states.end(), state);
  plain.reserve(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < states.size() && count > 0; ++i)
  {
    if (states[i] == state)
    {
      const auto cell = static_cast<vtkIdType>(i);
      (isLinear[static_cast<std::size_t>(mesh.type(cell))] ? plain : curved).push_back(cell);
    }
  }
  vtkUnsignedCharArray* ghosts = copies == Copies::Neighbours ? data->GetCellGhostArray() : nullptr;
  const auto isLeftOut = [ghosts](vtkIdType cell)
  { return ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0; };
  if (!plain.empty())
  {
    addPlainCells(mesh, leaf, plain, state, isLeftOut, faces);
  }
  if (!curved.empty())
  {
    addCurvedCells(data, leaf, curved, state, isLeftOut, faces);
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
