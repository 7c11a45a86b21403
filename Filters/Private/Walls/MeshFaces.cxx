// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/MeshFaces.h"

#include "Common/CellTypes.h"
#include "Input/FlatData.h"
#include "Input/RefractivityValues.h"
#include "Walls/CurvedFaces.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkExtractCells.h"
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
#include <limits>
#include <numeric>
#include <utility>

namespace filters
{

namespace
{

constexpr const char* ownersName = "OwnerOfFace";
constexpr const char* originsName = "PointOfLeaf";

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

/// Whose faces are not wanted.
class LeftOut
{
public:
  LeftOut(vtkDataSet* data, Copies copies)
    : Ghosts(copies == Copies::Neighbours ? data->GetCellGhostArray() : nullptr)
  {
  }
  bool operator()(vtkIdType cell) const
  {
    return this->Ghosts &&
      (this->Ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0;
  }

private:
  vtkUnsignedCharArray* Ghosts;
};

void addStructured(vtkDataSet* data, std::uint32_t leaf, const std::array<int, 3>& dimensions,
  Copies copies, const WorkProgress& progress, Faces& faces)
{
  const LeftOut isLeftOut(data, copies);
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
      faces.contributions.push_back({ leaf, id, 1 });
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
            if (!isLeftOut(ownsLow ? cell - cellStep[axis] : cell))
            {
              add(at, i, j, ownsLow, std::max(low, high), std::min(low, high) == State::Hidden);
            }
          }
        }
      }
    }
  }
}

/// An array of the numbers of points or cells.
vtkSmartPointer<vtkIdTypeArray> numbersOf(vtkIdType count, const char* name)
{
  auto numbers = vtkSmartPointer<vtkIdTypeArray>::New();
  numbers->SetName(name);
  numbers->SetNumberOfValues(count);
  std::iota(numbers->GetPointer(0), numbers->GetPointer(0) + count, vtkIdType{ 0 });
  return numbers;
}

/// Faces by their cells and points. VTK finds them with several threads, in another order each time.
std::vector<vtkIdType> orderOf(
  vtkPolyData* polygons, vtkIdTypeArray* owners, vtkIdTypeArray* origins)
{
  using Key = std::array<vtkIdType, 4>; // cell, and the three lowest of the face's points
  std::vector<std::pair<Key, vtkIdType>> keys;
  vtkNew<vtkIdList> ids;
  for (vtkIdType face = 0; face < polygons->GetNumberOfCells(); ++face)
  {
    constexpr vtkIdType none = std::numeric_limits<vtkIdType>::max();
    polygons->GetCellPoints(face, ids);
    std::vector<vtkIdType> points(3, none);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      points.push_back(origins->GetValue(ids->GetId(i)));
    }
    std::partial_sort(points.begin(), points.begin() + 3, points.end());
    keys.push_back({ { owners->GetValue(face), points[0], points[1], points[2] }, face });
  }
  std::sort(keys.begin(), keys.end());
  std::vector<vtkIdType> order;
  for (const auto& key : keys)
  {
    order.push_back(key.second);
  }
  return order;
}

/// The surface of these cells, which are not curved.
void addPlainCells(vtkDataSet* data, std::uint32_t leaf, const std::vector<vtkIdType>& chosen,
  State state, const LeftOut& isLeftOut, Faces& faces)
{
  auto cells = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  cells->CopyStructure(data);
  cells->GetPointData()->AddArray(numbersOf(data->GetNumberOfPoints(), originsName));
  cells->GetCellData()->AddArray(numbersOf(data->GetNumberOfCells(), ownersName));
  vtkNew<vtkGeometryFilter> surface;
  if (cells->IsA("vtkUnstructuredGrid") &&
    chosen.size() == static_cast<std::size_t>(cells->GetNumberOfCells()))
  {
    surface->SetInputData(cells);
  }
  else
  {
    vtkNew<vtkIdList> list;
    list->SetNumberOfIds(static_cast<vtkIdType>(chosen.size()));
    std::copy(chosen.begin(), chosen.end(), list->GetPointer(0));
    vtkNew<vtkExtractCells> extract;
    extract->SetInputData(cells);
    extract->SetCellList(list);
    surface->SetInputConnection(extract->GetOutputPort());
  }
  surface->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  surface->Update();
  vtkPolyData* polygons = surface->GetOutput();
  auto* owners =
    vtkIdTypeArray::SafeDownCast(polygons->GetCellData()->GetAbstractArray(ownersName));
  auto* origins =
    vtkIdTypeArray::SafeDownCast(polygons->GetPointData()->GetAbstractArray(originsName));
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(polygons->GetNumberOfPoints()), -1);
  vtkNew<vtkIdList> ids;
  for (const vtkIdType face : orderOf(polygons, owners, origins))
  {
    if (isLeftOut(owners->GetValue(face)))
    {
      continue;
    }
    polygons->GetCellPoints(face, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      std::int32_t& number = numbers[static_cast<std::size_t>(ids->GetId(i))];
      if (number < 0)
      {
        const vtkIdType point = origins->GetValue(ids->GetId(i));
        Point x;
        data->GetPoint(point, x.data());
        faces.contributions.push_back({ leaf, point, 1 });
        number = faces.addPoint(x);
      }
      faces.corners.push_back(number);
    }
    Point owner{ 0, 0, 0 };
    data->GetCellPoints(owners->GetValue(face), ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      Point x;
      data->GetPoint(ids->GetId(i), x.data());
      owner = owner + (1. / static_cast<double>(ids->GetNumberOfIds())) * x;
    }
    faces.finish(owner, state, false);
  }
}

/// The surface of the cells of one state.
void addUnstructured(vtkDataSet* data, std::uint32_t leaf, const std::vector<State>& states,
  State state, Copies copies, Faces& faces)
{
  std::vector<vtkIdType> plain, curved;
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    if (states[i] == state)
    {
      const auto cell = static_cast<vtkIdType>(i);
      const auto type = static_cast<unsigned char>(data->GetCellType(cell));
      (vtkCellTypeUtilities::IsLinear(type) ? plain : curved).push_back(cell);
    }
  }
  const LeftOut isLeftOut(data, copies);
  if (!plain.empty())
  {
    addPlainCells(data, leaf, plain, state, isLeftOut, faces);
  }
  if (!curved.empty())
  {
    addCurvedCells(
      data, leaf, curved, state, [&](vtkIdType cell) { return !isLeftOut(cell); }, faces);
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
    vtkDataSet* leaf = leaves[number];
    const std::array<int, 3> structure = structureOf(leaf);
    if (std::min({ structure[0], structure[1], structure[2] }) > 1)
    {
      addStructured(leaf, number, structure, copies, ofLeaf, faces);
    }
    else
    {
      const std::vector<State> states = statesOf(leaf, false, ofLeaf.part(0, 0.3));
      addUnstructured(leaf, number, states, State::Visible, copies, faces);
      ofLeaf.reach(0.9);
      addUnstructured(leaf, number, states, State::Hidden, copies, faces);
    }
  }
  return faces;
}

} // namespace filters
