// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CellMeans.h"

#include "Cells/CellShape.h"
#include "Input/RefractivityValues.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace filters
{

namespace
{

/// Sums moments over tetrahedra of a cell, from an origin in it or near it.
struct Sums
{
  double volume = 0;
  Vector first{};
  std::array<double, 6> second{};

  void add(double weight, const Vector& x)
  {
    this->volume += weight;
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->first[i] += weight * x[i];
      this->second[i] += weight * x[i] * x[i];
      this->second[i + 3] += weight * x[i] * x[(i + 1) % 3];
    }
  }

  /// Adds a tetrahedron with a corner in the origin: the mean of x x is a twentieth of the sum of
  /// the corners' and of their sum's.
  void addTetrahedron(const Vector& a, const Vector& b, const Vector& c)
  {
    const double part = std::abs(dot(a, cross(b, c))) / 120;
    this->add(part, a);
    this->add(part, b);
    this->add(part, c);
    const Vector sum = a + b + c;
    this->add(part, sum);
    // Adds the volume and the first moments: a quarter of the volume at each corner.
    this->volume += 16 * part;
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->first[i] += 3 * part * sum[i];
    }
  }

  /// Returns false if there is no volume.
  bool finish(const Vector& origin, CellMoments& result) const
  {
    const double perVolume = 1 / this->volume;
    const Vector middle = perVolume * this->first;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      result.second[i] = std::max(0., this->second[i] * perVolume - middle[i] * middle[i]);
      result.second[i + 3] = this->second[i + 3] * perVolume - middle[i] * middle[(i + 1) % 3];
      sum += result.second[i] + result.second[i + 3];
    }
    result.middle = origin + middle;
    return this->volume > 0 && std::isfinite(sum);
  }
};

/// Points of a cell relative to its parametric middle, and their weights.
struct Place
{
  double weight, u, v, w;
};

constexpr double near =
  0.21132486540518712; // 1/2 - 1 / (2 sqrt(3)): Gauss, exact to the third degree
constexpr double half = 0.5 - near;

constexpr std::array<Place, 8> placesInBoxes = { { { 1, -half, -half, -half },
  { 1, half, -half, -half }, { 1, -half, half, -half }, { 1, half, half, -half },
  { 1, -half, -half, half }, { 1, half, -half, half }, { 1, -half, half, half },
  { 1, half, half, half } } };

constexpr double sixth = 1. / 6;
constexpr std::array<Place, 6> placesInWedges = { { { 1, -sixth, -sixth, -half },
  { 1, 2 * sixth, -sixth, -half }, { 1, -sixth, 2 * sixth, -half }, { 1, -sixth, -sixth, half },
  { 1, 2 * sixth, -sixth, half }, { 1, -sixth, 2 * sixth, half } } };

CellMoments ofBox(const Sums& corners, const Vector& origin)
{
  CellMoments result{};
  corners.finish(origin, result);
  for (double& moment : result.second)
  {
    moment /= 3;
  }
  return result;
}

/// Returns the moments of a box with the corners' spread, for cells without volume or of other
/// types.
CellMoments momentsOfCorners(const MeshArrays& mesh, vtkIdType cell)
{
  Sums sums;
  Vector origin{};
  mesh.forPoints(cell,
    [&](vtkIdType point)
    {
      Vector x;
      mesh.coordinates(point, x.data());
      origin = sums.volume == 0 ? x : origin;
      sums.add(1, x - origin);
    });
  return ofBox(sums, origin);
}

template <CellShape shape, std::size_t count>
CellMoments momentsOf(
  const MeshArrays& mesh, vtkIdType cell, const std::array<Place, count>& places)
{
  constexpr int corners = cornersOf(shape);
  vtkIdType points[8];
  mesh.points(cell, corners, points);
  Vector origin;
  mesh.coordinates(points[0], origin.data());
  double x[3][8];
  for (int i = 0; i < corners; ++i)
  {
    Vector at;
    mesh.coordinates(points[i], at.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      x[axis][i] = at[axis] - origin[axis];
    }
  }
  const Polynomial along[3] = { polynomialOf<shape>(x[0]), polynomialOf<shape>(x[1]),
    polynomialOf<shape>(x[2]) };
  Sums sums;
  for (const Place& p : places)
  {
    const double u = p.u, v = p.v, w = p.w;
    Vector at, byU, byV, byW;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Polynomial& n = along[i];
      at[i] = n[0] + n[1] * u + n[2] * v + n[3] * w + n[4] * u * v + n[5] * v * w + n[6] * u * w +
        n[7] * u * v * w;
      byU[i] = n[1] + n[4] * v + n[6] * w + n[7] * v * w;
      byV[i] = n[2] + n[4] * u + n[5] * w + n[7] * u * w;
      byW[i] = n[3] + n[5] * v + n[6] * u + n[7] * u * v;
    }
    const double size = p.weight * std::abs(dot(byU, cross(byV, byW)));
    sums.add(size, at);
  }
  CellMoments result{};
  return sums.finish(origin, result) ? result : momentsOfCorners(mesh, cell);
}

CellMoments momentsOfTetrahedra(
  const MeshArrays& mesh, vtkIdType cell, const std::vector<std::array<int, 4>>& pieces)
{
  vtkIdType points[8];
  int count = 0;
  for (const std::array<int, 4>& piece : pieces)
  {
    count = std::max(count, 1 + *std::max_element(piece.begin(), piece.end()));
  }
  mesh.points(cell, count, points);
  Vector origin;
  mesh.coordinates(points[0], origin.data());
  Sums sums;
  for (const std::array<int, 4>& piece : pieces) // each begins with corner 0
  {
    Vector x[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      mesh.coordinates(points[piece[i + 1]], x[i].data());
      x[i] = x[i] - origin;
    }
    sums.addTetrahedron(x[0], x[1], x[2]);
  }
  CellMoments result{};
  return sums.finish(origin, result) ? result : momentsOfCorners(mesh, cell);
}

} // namespace

CellMoments momentsOfPolyhedron(vtkUnstructuredGrid* mesh, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  mesh->GetCellPoints(cell, ids);
  vtkPoints* points = mesh->GetPoints();
  const auto count = static_cast<double>(ids->GetNumberOfIds());
  Vector origin{};
  Sums ofCorners;
  const auto at = [points](vtkIdType id)
  {
    Vector x;
    points->GetPoint(id, x.data());
    return x;
  };
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    origin = origin + (1 / count) * at(ids->GetId(i));
  }
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    ofCorners.add(1, at(ids->GetId(i)) - origin);
  }
  // Adds tetrahedra from the origin to the middle of each face and each of its edges.
  Sums sums;
  mesh->GetFaceStream(cell, ids); // for each face the number of points, and the points
  vtkIdType next = 1;
  for (vtkIdType face = 0; face < ids->GetId(0); ++face)
  {
    const vtkIdType corners = ids->GetId(next++);
    Vector middle{};
    for (vtkIdType i = 0; i < corners; ++i)
    {
      middle = middle + (1. / static_cast<double>(corners)) * (at(ids->GetId(next + i)) - origin);
    }
    for (vtkIdType i = 0; i < corners; ++i)
    {
      sums.addTetrahedron(middle, at(ids->GetId(next + i)) - origin,
        at(ids->GetId(next + (i + 1) % corners)) - origin);
    }
    next += corners;
  }
  CellMoments result{};
  return sums.finish(origin, result) ? result : ofBox(ofCorners, origin);
}

CellMoments momentsOf(const MeshArrays& mesh, vtkIdType cell)
{
  static const std::vector<std::array<int, 4>> tetrahedron = { { 0, 1, 2, 3 } };
  static const std::vector<std::array<int, 4>> pyramid = { { 0, 1, 2, 4 }, { 0, 2, 3, 4 } };
  const int type = mesh.type(cell);
  if (type == VTK_POLYHEDRON)
  {
    return momentsOfPolyhedron(vtkUnstructuredGrid::SafeDownCast(mesh.data()), cell);
  }
  switch (shapeOf(type))
  {
    case CellShape::Tetrahedron:
      return momentsOfTetrahedra(mesh, cell, tetrahedron);
    case CellShape::Pyramid:
      return momentsOfTetrahedra(mesh, cell, pyramid);
    case CellShape::Wedge:
      return momentsOf<CellShape::Wedge>(mesh, cell, placesInWedges);
    case CellShape::Hexahedron:
      return momentsOf<CellShape::Hexahedron>(mesh, cell, placesInBoxes);
    case CellShape::Voxel:
      return momentsOf<CellShape::Voxel>(mesh, cell, placesInBoxes);
    case CellShape::Other:
      break;
  }
  return momentsOfCorners(mesh, cell);
}

void setMeansAroundPoints(const MeshArrays& mesh, vtkDoubleArray* ofCells,
  vtkUnsignedCharArray* valid, vtkDoubleArray* ofPoints, std::vector<CellsAround>* around)
{
  const auto points = static_cast<std::size_t>(mesh.points());
  std::vector<std::uint32_t> counts(points, 0);
  double* values = ofPoints->GetPointer(0);
  std::fill_n(values, points, 0.);
  const CellsAround none{ {}, {}, std::numeric_limits<float>::infinity(),
    -std::numeric_limits<float>::infinity() };
  if (around)
  {
    around->assign(points, none);
  }
  for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
  {
    if (valid->GetValue(cell) == 0)
    {
      continue;
    }
    const double value = ofCells->GetValue(cell);
    mesh.forPoints(cell,
      [&](vtkIdType point)
      {
        values[point] += value;
        ++counts[static_cast<std::size_t>(point)];
      });
  }
  for (std::size_t i = 0; i < points; ++i)
  {
    values[i] /= counts[i]; // NaN for none
  }
  if (!around)
  {
    return;
  }
  for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
  {
    if (valid->GetValue(cell) == 0)
    {
      continue;
    }
    const CellMoments moments = momentsOf(mesh, cell);
    const double value = ofCells->GetValue(cell);
    mesh.forPoints(cell,
      [&](vtkIdType point)
      {
        const auto at = static_cast<std::size_t>(point);
        CellsAround& sums = (*around)[at];
        Vector x;
        mesh.coordinates(point, x.data());
        x = moments.middle - x;
        const double fraction = 1. / counts[at];
        for (std::size_t i = 0; i < 3; ++i)
        {
          const std::size_t next = (i + 1) % 3;
          sums.first[i] += static_cast<float>(fraction * x[i]);
          sums.second[i] += static_cast<float>(fraction * (moments.second[i] + x[i] * x[i]));
          sums.second[i + 3] +=
            static_cast<float>(fraction * (moments.second[i + 3] + x[i] * x[next]));
        }
        const auto away = static_cast<float>(value - values[point]);
        sums.lowest = std::min(sums.lowest, away);
        sums.highest = std::max(sums.highest, away);
      });
  }
}

void bringToPoints(vtkDataSet* data, bool areKept)
{
  const vtkSmartPointer<vtkDoubleArray> ofCells =
    vtkDoubleArray::SafeDownCast(data->GetCellData()->GetScalars());
  const MeshArrays mesh(data);
  auto visible = newMask(data->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < mesh.cells(); ++cell)
  {
    visible->SetValue(cell, mesh.isVisible(cell) ? 1 : 0);
  }
  std::vector<CellsAround> around;
  setMeansAroundPoints(mesh, ofCells, visible,
    vtkDoubleArray::SafeDownCast(data->GetPointData()->GetScalars()), areKept ? &around : nullptr);
  if (areKept)
  {
    data->GetPointData()->AddArray(arrayOf(around));
  }
  else
  {
    data->GetCellData()->RemoveArray(ofCells->GetName());
  }
}

vtkSmartPointer<vtkDataArray> arrayOf(const std::vector<CellsAround>& around)
{
  constexpr int numbers = sizeof(CellsAround) / sizeof(float);
  static_assert(sizeof(CellsAround) == 11 * sizeof(float));
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(cellsAroundName);
  array->SetNumberOfComponents(numbers);
  array->SetNumberOfTuples(static_cast<vtkIdType>(around.size()));
  if (!around.empty())
  {
    std::copy_n(
      &around[0].first[0], static_cast<std::size_t>(numbers) * around.size(), array->GetPointer(0));
  }
  return array;
}

} // namespace filters
