// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryFaces.h"

#include "FlatData.h"
#include "RefractivityValues.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkExtractCells.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace refractivity
{

namespace
{

constexpr double mergingPart = 1e-3; // of the smallest edge or cell beside a point
constexpr double lookingPart = 0.05; // of a cell's height or a face's edge: how far behind to look
constexpr int subdivisions = 2;      // of the faces of curved cells
constexpr double cellTolerance = 4e-3; // of a cell's height: no cell holds what is further from it
constexpr const char* ownersName = "OwnerOfFace";
constexpr const char* originsName = "PointOfLeaf";

enum class State : unsigned char
{
  None,
  Hidden,
  Visible
};

/// Polygons that bound visible cells, or hidden ones.
struct Faces
{
  std::vector<Point> points;
  std::vector<std::size_t> firstShares{ 0 }; // of each point's value, and the end
  std::vector<Share> shares;
  std::vector<std::int32_t> corners;      // of all faces, one after the other
  std::vector<std::size_t> starts{ 0 };   // and the end
  std::vector<Point> owners;              // the middle of the cell
  std::vector<State> states;              // of the cell
  std::vector<unsigned char> hidesBehind; // known from within the leaf

  std::size_t size() const { return this->owners.size(); }
  /// Its shares have been added.
  std::int32_t addPoint(const Point& x)
  {
    this->points.push_back(x);
    this->firstShares.push_back(this->shares.size());
    return static_cast<std::int32_t>(this->points.size() - 1);
  }
  /// The face whose corners have been added.
  void finish(const Point& owner, State state, bool hides)
  {
    this->starts.push_back(this->corners.size());
    this->owners.push_back(owner);
    this->states.push_back(state);
    this->hidesBehind.push_back(hides ? 1 : 0);
  }
};

/// What a cell with such a point is.
std::vector<State> statesOfPoints(vtkDataSet* data, const WorkProgress& progress)
{
  std::vector<State> states(static_cast<std::size_t>(data->GetNumberOfPoints()), State::Visible);
  vtkDataArray* scalars = data->GetPointData()->GetScalars();
  forParts(data->GetNumberOfPoints(), progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        Point x;
        data->GetPoint(i, x.data());
        if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        {
          states[static_cast<std::size_t>(i)] = State::None; // it is nowhere
        }
        else if (scalars && !std::isfinite(scalars->GetComponent(i, 0)))
        {
          states[static_cast<std::size_t>(i)] = State::Hidden;
        }
      }
    });
  return states;
}

/// `is3d`: whether all cells are 3-D. (VTK says that hidden ones of structured data have no dimension.)
std::vector<State> statesOf(vtkDataSet* data, bool is3d, const WorkProgress& progress)
{
  const std::vector<State> ofPoints = statesOfPoints(data, progress.part(0, 0.3));
  std::vector<State> states(static_cast<std::size_t>(data->GetNumberOfCells()));
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  forParts(data->GetNumberOfCells(), progress.part(0.3, 1),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkIdList> ids;
      for (vtkIdType i = begin; i < end; ++i)
      {
        State& state = states[static_cast<std::size_t>(i)];
        if (!is3d && dimensionOfCell(data, i) != 3)
        {
          continue;
        }
        const bool isHidden = ghosts && (ghosts->GetValue(i) & hiddenCellBits);
        state = isHidden ? State::Hidden : State::Visible;
        data->GetCellPoints(i, ids);
        for (vtkIdType point = 0; point < ids->GetNumberOfIds(); ++point)
        {
          state = std::min(state, ofPoints[static_cast<std::size_t>(ids->GetId(point))]);
        }
      }
    });
  return states;
}

void addStructured(vtkDataSet* data, std::uint32_t leaf, const std::array<int, 3>& dimensions,
  const WorkProgress& progress, Faces& faces)
{
  const std::vector<State> states = statesOf(data, true, progress);
  const bool areAllVisible =
    std::all_of(states.begin(), states.end(), [](State state) { return state == State::Visible; });
  const std::array<vtkIdType, 3> points = { dimensions[0], dimensions[1], dimensions[2] };
  const std::array<vtkIdType, 3> cells = { points[0] - 1, points[1] - 1, points[2] - 1 };
  const std::array<vtkIdType, 3> pointStep = { 1, points[0], points[0] * points[1] };
  const std::array<vtkIdType, 3> cellStep = { 1, cells[0], cells[0] * cells[1] };
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(data->GetNumberOfPoints()), -1);
  const auto number = [&](vtkIdType id)
  {
    std::int32_t& known = numbers[static_cast<std::size_t>(id)];
    if (known < 0)
    {
      Point x;
      data->GetPoint(id, x.data());
      faces.shares.push_back({ leaf, id, 1 });
      known = faces.addPoint(x);
    }
    return known;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto add =
      [&](vtkIdType low, vtkIdType i, vtkIdType j, bool ownsLow, State state, bool hides)
    {
      const vtkIdType first = low * pointStep[axis] + i * pointStep[u] + j * pointStep[v];
      for (const vtkIdType id :
        { first, first + pointStep[u], first + pointStep[u] + pointStep[v], first + pointStep[v] })
      {
        faces.corners.push_back(number(id));
      }
      Point owner{ 0, 0, 0 };
      const vtkIdType corner = first - (ownsLow ? pointStep[axis] : 0);
      for (vtkIdType part = 0; part < 8; ++part)
      {
        Point x;
        data->GetPoint(corner + (part & 1) * pointStep[0] + (part >> 1 & 1) * pointStep[1] +
            (part >> 2) * pointStep[2],
          x.data());
        owner = owner + 0.125 * x;
      }
      faces.finish(owner, state, hides);
    };
    const vtkIdType step = areAllVisible ? cells[axis] : 1; // nothing happens in between
    for (vtkIdType at = 0; at <= cells[axis]; at += step)
    {
      for (vtkIdType j = 0; j < cells[v]; ++j)
      {
        for (vtkIdType i = 0; i < cells[u]; ++i)
        {
          const vtkIdType cell = at * cellStep[axis] + i * cellStep[u] + j * cellStep[v];
          const State low =
            at > 0 ? states[static_cast<std::size_t>(cell - cellStep[axis])] : State::None;
          const State high =
            at < cells[axis] ? states[static_cast<std::size_t>(cell)] : State::None;
          if (low != high)
          {
            const bool ownsLow = low > high; // what is visible owns the face, else what is there
            add(at, i, j, ownsLow, std::max(low, high), std::min(low, high) == State::Hidden);
          }
        }
      }
    }
  }
}

/// Adds what the value at a place in a cell is made of.
void addShares(vtkUnstructuredGrid* cells, vtkIdType id, std::uint32_t leaf, Point place,
  vtkIdTypeArray* origins, Faces& faces)
{
  vtkCell* cell = cells->GetCell(id);
  std::vector<double> weights(static_cast<std::size_t>(cell->GetNumberOfPoints()));
  Point nearest, coordinates;
  int part = 0;
  double distance = 0;
  cell->EvaluatePosition(
    place.data(), nearest.data(), part, coordinates.data(), distance, weights.data());
  const bool areFinite =
    std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    const vtkIdType point = origins->GetValue(cell->GetPointId(static_cast<int>(i)));
    const double mean = 1 / static_cast<double>(weights.size());
    faces.shares.push_back({ leaf, point, areFinite ? weights[i] : mean });
  }
}

/// The surface of the cells of one state.
void addUnstructured(
  vtkDataSet* data, std::uint32_t leaf, const std::vector<State>& states, State state, Faces& faces)
{
  const auto count = std::count(states.begin(), states.end(), state);
  if (count == 0)
  {
    return;
  }
  vtkNew<vtkIdTypeArray> all;
  all->SetName(originsName);
  all->SetNumberOfValues(data->GetNumberOfPoints());
  std::iota(all->GetPointer(0), all->GetPointer(0) + all->GetNumberOfValues(), vtkIdType{ 0 });
  vtkNew<vtkUnstructuredGrid> cells;
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);
  if (mesh && count == mesh->GetNumberOfCells())
  {
    cells->CopyStructure(mesh);
    cells->GetPointData()->AddArray(all);
  }
  else
  {
    vtkNew<vtkIdList> chosen;
    chosen->Allocate(static_cast<vtkIdType>(count));
    for (std::size_t i = 0; i < states.size(); ++i)
    {
      if (states[i] == state)
      {
        chosen->InsertNextId(static_cast<vtkIdType>(i));
      }
    }
    auto numbered = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
    numbered->CopyStructure(data);
    numbered->GetPointData()->AddArray(all);
    vtkNew<vtkExtractCells> extract;
    extract->SetInputData(numbered);
    extract->SetCellList(chosen);
    extract->Update();
    cells->CopyStructure(extract->GetOutput());
    cells->GetPointData()->AddArray(
      extract->GetOutput()->GetPointData()->GetAbstractArray(originsName));
  }
  // Not by PassThroughCellIds: VTK 9.2 gives wrong numbers to the faces of curved cells.
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName(ownersName);
  numbers->SetNumberOfValues(cells->GetNumberOfCells());
  for (vtkIdType i = 0; i < numbers->GetNumberOfValues(); ++i)
  {
    numbers->SetValue(i, i);
  }
  cells->GetCellData()->AddArray(numbers);
  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputData(cells);
  surface->SetNonlinearSubdivisionLevel(subdivisions);
  surface->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  surface->Update();
  vtkPolyData* polygons = surface->GetOutput();
  auto* owners =
    vtkIdTypeArray::SafeDownCast(polygons->GetCellData()->GetAbstractArray(ownersName));

  const auto firstPoint = static_cast<vtkIdType>(faces.points.size());
  vtkNew<vtkIdList> ids;
  std::vector<vtkIdType> cellsOfPoints(static_cast<std::size_t>(polygons->GetNumberOfPoints()), 0);
  for (vtkIdType face = 0; face < polygons->GetNumberOfCells(); ++face)
  {
    polygons->GetCellPoints(face, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      cellsOfPoints[static_cast<std::size_t>(ids->GetId(i))] = owners->GetValue(face);
    }
  }
  auto* origins =
    vtkIdTypeArray::SafeDownCast(cells->GetPointData()->GetAbstractArray(originsName));
  vtkDataArray* kept = polygons->GetPointData()->GetArray(originsName);
  for (vtkIdType i = 0; i < polygons->GetNumberOfPoints(); ++i)
  {
    Point x, ofLeaf;
    polygons->GetPoint(i, x.data());
    // Of points between others, VTK has a mean of their numbers, if any.
    const double number = kept ? kept->GetComponent(i, 0) : 0;
    const auto point = static_cast<vtkIdType>(
      std::clamp(number, 0., static_cast<double>(data->GetNumberOfPoints() - 1)));
    data->GetPoint(point, ofLeaf.data());
    if (ofLeaf[0] == x[0] && ofLeaf[1] == x[1] && ofLeaf[2] == x[2])
    {
      faces.shares.push_back({ leaf, point, 1 });
    }
    else
    {
      addShares(cells, cellsOfPoints[static_cast<std::size_t>(i)], leaf, x, origins, faces);
    }
    faces.addPoint(x);
  }
  for (vtkIdType face = 0; face < polygons->GetNumberOfCells(); ++face)
  {
    polygons->GetCellPoints(face, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      faces.corners.push_back(static_cast<std::int32_t>(firstPoint + ids->GetId(i)));
    }
    Point owner{ 0, 0, 0 };
    cells->GetCellPoints(owners->GetValue(face), ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      Point x;
      cells->GetPoint(ids->GetId(i), x.data());
      owner = owner + (1. / static_cast<double>(ids->GetNumberOfIds())) * x;
    }
    faces.finish(owner, state, false);
  }
}

Faces facesOf(const std::vector<vtkDataSet*>& leaves, const WorkProgress& progress)
{
  Faces faces;
  for (std::uint32_t number = 0; number < leaves.size(); ++number)
  {
    const auto count = static_cast<double>(leaves.size());
    const WorkProgress ofLeaf = progress.part(number / count, (number + 1) / count);
    vtkDataSet* leaf = leaves[number];
    const std::array<int, 3> structure = structureOf(leaf);
    if (std::min({ structure[0], structure[1], structure[2] }) > 1)
    {
      addStructured(leaf, number, structure, ofLeaf, faces);
    }
    else
    {
      const std::vector<State> states = statesOf(leaf, false, ofLeaf.part(0, 0.3));
      addUnstructured(leaf, number, states, State::Visible, faces);
      ofLeaf.reach(0.9);
      addUnstructured(leaf, number, states, State::Hidden, faces);
    }
  }
  return faces;
}

/// Leaves out the sides of a layer across z, of which all corners have one z.
Faces withoutSidesAcrossZ(const Faces& all)
{
  Faces faces;
  faces.points = all.points;
  faces.firstShares = all.firstShares;
  faces.shares = all.shares;
  for (std::size_t face = 0; face < all.size(); ++face)
  {
    const auto begin = all.corners.begin() + static_cast<std::ptrdiff_t>(all.starts[face]);
    const auto end = all.corners.begin() + static_cast<std::ptrdiff_t>(all.starts[face + 1]);
    const auto zOf = [&](std::int32_t corner)
    { return all.points[static_cast<std::size_t>(corner)][2]; };
    if (std::any_of(begin, end, [&](std::int32_t corner) { return zOf(corner) != zOf(*begin); }))
    {
      faces.corners.insert(faces.corners.end(), begin, end);
      faces.finish(all.owners[face], all.states[face], all.hidesBehind[face] != 0);
    }
  }
  return faces;
}

/// A face seen from its cell.
struct Sides
{
  Point middle;
  Point outward; // unit length, or 0
  double height; // of the cell above the face, about
  double width;  // the smallest edge that there is
};

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

/// Gives points that are one the same number.
void mergePoints(Faces& faces, double rounding)
{
  std::vector<double> tolerances(faces.points.size(), std::numeric_limits<double>::infinity());
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
      double& tolerance = tolerances[static_cast<std::size_t>(faces.corners[i])];
      tolerance = std::min(tolerance, mergingPart * size);
    }
  }
  for (std::size_t i = 0; i < tolerances.size(); ++i)
  {
    const double rounded = rounding * norm(faces.points[i]);
    tolerances[i] = std::isfinite(tolerances[i]) ? std::max(tolerances[i], rounded) : rounded;
  }
  const std::vector<std::int32_t> numbers = coincidentPoints(faces.points, tolerances);
  for (std::int32_t& corner : faces.corners)
  {
    corner = numbers[static_cast<std::size_t>(corner)];
  }
}

/// The corners of a face without those that have fallen on their neighbours; empty if it has no area.
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

/// A face that visible cells have on one side only.
struct Kept
{
  std::vector<std::int32_t> corners; // seen from the gas, counter-clockwise
  Sides sides;
  bool hidesBehind;
};

/// Takes away what belongs to two visible cells.
std::vector<Kept> withoutPairs(const Faces& faces, double rounding)
{
  struct Key
  {
    std::array<std::int32_t, 5> lowest; // its number of corners, and the four lowest of them
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

  std::vector<Kept> kept;
  for (auto first = keys.begin(); first != keys.end();)
  {
    const auto end =
      std::find_if(first, keys.end(), [&](const Key& key) { return key.lowest != first->lowest; });
    const Point outward = sidesOf(faces, first->face, rounding).outward;
    bool isVisible[2] = { false, false }, isHidden[2] = { false, false };
    std::size_t owner[2] = { 0, 0 };
    bool hides = false;
    for (; first != end; ++first)
    {
      const Sides sides = sidesOf(faces, first->face, rounding);
      const int side = dot(sides.outward, outward) < 0 ? 1 : 0;
      if (faces.states[first->face] == State::Visible)
      {
        isVisible[side] = true;
        owner[side] = first->face;
        hides = hides || faces.hidesBehind[first->face];
      }
      else
      {
        isHidden[side] = true;
      }
    }
    if (isVisible[0] != isVisible[1])
    {
      const int side = isVisible[0] ? 0 : 1;
      const Sides sides = sidesOf(faces, owner[side], rounding);
      std::vector<std::int32_t> corners = distinctCorners(faces, owner[side]);
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
      kept.push_back({ std::move(corners), sides, hides || isHidden[1 - side] });
    }
  }
  return kept;
}

/// Takes away what has cells on both sides.
void removeCovered(const Faces& faces, const CellTest& isInCell, std::vector<Kept>& kept,
  const WorkProgress& progress)
{
  std::vector<unsigned char> isCovered(kept.size(), 0);
  forParts(static_cast<vtkIdType>(kept.size()), progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const Kept& face = kept[static_cast<std::size_t>(i)];
        const double step = std::max(lookingPart * std::min(face.sides.height, face.sides.width),
          cellTolerance * face.sides.height);
        const Point middle = face.sides.middle + step * face.sides.outward;
        bool areAll = std::isfinite(step) && isInCell(middle);
        for (const std::int32_t corner : face.corners)
        {
          areAll = areAll &&
            isInCell(
              middle + 0.8 * (faces.points[static_cast<std::size_t>(corner)] - face.sides.middle));
        }
        isCovered[static_cast<std::size_t>(i)] = areAll ? 1 : 0;
      }
    });
  std::size_t left = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    if (!isCovered[i])
    {
      std::swap(kept[left++], kept[i]);
    }
  }
  kept.resize(left);
}

BoundaryFaces triangulate(const Faces& faces, const std::vector<Kept>& kept)
{
  BoundaryFaces result;
  std::vector<std::int32_t> numbers(faces.points.size(), -1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkUnsignedCharArray> hides;
  hides->SetName("hides");
  for (const Kept& face : kept)
  {
    polygons->InsertNextCell(static_cast<int>(face.corners.size()));
    for (const std::int32_t corner : face.corners)
    {
      const auto from = static_cast<std::size_t>(corner);
      if (numbers[from] < 0)
      {
        numbers[from] = static_cast<std::int32_t>(result.surface.points.size());
        result.shares.insert(result.shares.end(),
          faces.shares.begin() + static_cast<std::ptrdiff_t>(faces.firstShares[from]),
          faces.shares.begin() + static_cast<std::ptrdiff_t>(faces.firstShares[from + 1]));
        result.starts.push_back(result.shares.size());
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

double relativeRounding(const std::vector<Point>& points)
{
  for (const Point& point : points)
  {
    for (const double x : point)
    {
      if (static_cast<double>(static_cast<float>(x)) != x)
      {
        return 1e-12;
      }
    }
  }
  return 5e-7;
}

std::vector<std::int32_t> coincidentPoints(
  const std::vector<Point>& points, const std::vector<double>& tolerances)
{
  // Sorted along a direction across which the points of no plausible mesh lie in planes, so that few others are
  // in between.
  const Point along = unit({ 1, 0.6180339887, 0.2360679775 });
  std::vector<std::pair<double, std::int32_t>> sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    sorted.emplace_back(dot(along, points[i]), static_cast<std::int32_t>(i));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const auto rootOf = [&](std::int32_t i)
  {
    while (numbers[static_cast<std::size_t>(i)] != i)
    {
      i = numbers[static_cast<std::size_t>(i)];
    }
    return i;
  };
  for (auto one = sorted.begin(); one != sorted.end(); ++one)
  {
    const auto i = static_cast<std::size_t>(one->second);
    for (auto other = one + 1; other != sorted.end() && other->first - one->first <= tolerances[i];
         ++other)
    {
      const auto j = static_cast<std::size_t>(other->second);
      if (norm(points[i] - points[j]) <= std::min(tolerances[i], tolerances[j]))
      {
        const auto [low, high] = std::minmax({ rootOf(one->second), rootOf(other->second) });
        numbers[static_cast<std::size_t>(high)] = low;
      }
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = rootOf(static_cast<std::int32_t>(i));
  }
  return numbers;
}

BoundaryFaces boundaryOf(const std::vector<vtkDataSet*>& leaves, const CellTest& isInCell,
  const WorkProgress& progress, Extent extent)
{
  Faces faces = facesOf(leaves, progress.part(0, 0.7));
  if (extent == Extent::Layer)
  {
    faces = withoutSidesAcrossZ(faces);
  }
  progress.reach(0.7);
  const double rounding = relativeRounding(faces.points);
  mergePoints(faces, rounding);
  std::vector<Kept> kept = withoutPairs(faces, rounding);
  progress.reach(0.8);
  if (isInCell)
  {
    removeCovered(faces, isInCell, kept, progress.part(0.8, 0.9));
  }
  progress.reach(0.9);
  BoundaryFaces result = triangulate(faces, kept);
  result.extent = extent;
  return result;
}

std::vector<double> valuesAt(const BoundaryFaces& faces, const std::vector<vtkDataSet*>& leaves)
{
  std::vector<vtkDataArray*> scalars;
  for (vtkDataSet* leaf : leaves)
  {
    scalars.push_back(leaf->GetPointData()->GetScalars());
  }
  std::vector<double> values(faces.surface.points.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    for (std::size_t k = faces.starts[i]; k < faces.starts[i + 1]; ++k)
    {
      const Share& share = faces.shares[k];
      values[i] +=
        scalars[share.leaf] ? share.weight * scalars[share.leaf]->GetComponent(share.point, 0) : 0;
    }
  }
  return values;
}

} // namespace refractivity
