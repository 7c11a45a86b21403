// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes of cells of one type, straight or moved so that they are bent.
#pragma once

#include "Fixtures.h"

#include "Schlieren.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

using Mesh = vtkSmartPointer<vtkUnstructuredGrid>;

inline double linear(const Vec& x) { return 1e-4 * (2 + x[0] - 0.5 * x[1] + 0.25 * x[2]); }

/// Moves what is inside the unit cube around, and leaves its faces in their planes.
inline Vec moved(const Vec& x, double by)
{
  Vec y = x;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    y[axis] += by * x[axis] * (1 - x[axis]) *
      std::sin(5 * x[0] + 7 * x[1] * x[1] + 3 * x[2] + static_cast<double>(axis));
  }
  return y;
}

/// n^3 cells in the unit cube (n^2 in its face z = 0). Each has its points at `corners` of a unit cell.
inline Mesh meshOf(
  int type, int n, const std::vector<std::vector<Vec>>& cells, double by, bool isFlat)
{
  auto mesh = Mesh::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<Vec> known; // by place, so that neighbours share points
  for (int k = 0; k < (isFlat ? 1 : n); ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        for (const std::vector<Vec>& corners : cells)
        {
          vtkNew<vtkIdList> ids;
          for (const Vec& corner : corners)
          {
            const Vec at = { (i + corner[0]) / n, (j + corner[1]) / n, (k + corner[2]) / n };
            std::size_t id = 0;
            while (id < known.size() &&
              std::abs(known[id][0] - at[0]) + std::abs(known[id][1] - at[1]) +
                  std::abs(known[id][2] - at[2]) >
                1e-9)
            {
              ++id;
            }
            if (id == known.size())
            {
              known.push_back(at);
              Vec x = moved(at, by);
              x[2] = isFlat ? 0 : x[2];
              points->InsertNextPoint(x.data());
            }
            ids->InsertNextId(static_cast<vtkIdType>(id));
          }
          mesh->InsertNextCell(type, ids);
        }
      }
    }
  }
  mesh->SetPoints(points);
  addPointArray(mesh, "N", linear);
  return mesh;
}

/// VTK's own unit cell of a type, of `count` points where these give its order.
inline std::vector<Vec> unitCell(int type, int count)
{
  vtkNew<vtkUnstructuredGrid> one;
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, 0, 0, 0);
    ids->InsertNextId(i);
  }
  one->SetPoints(points);
  one->InsertNextCell(type, ids);
  vtkNew<vtkGenericCell> cell;
  one->GetCell(0, cell);
  const double* places = cell->GetParametricCoords();
  std::vector<Vec> corners;
  for (int i = 0; i < count; ++i)
  {
    corners.push_back({ places[3 * i], places[3 * i + 1], places[3 * i + 2] });
  }
  return corners;
}

/// A box cut into cells that are images of the unit cell, each by its corners: origin and three edges' ends.
inline std::vector<std::vector<Vec>> cut(
  const std::vector<Vec>& unitCorners, const std::vector<std::array<Vec, 4>>& frames)
{
  std::vector<std::vector<Vec>> cells;
  for (const std::array<Vec, 4>& frame : frames)
  {
    cells.emplace_back();
    for (const Vec& p : unitCorners)
    {
      Vec x = frame[0];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        for (std::size_t edge = 0; edge < 3; ++edge)
        {
          x[axis] += p[edge] * (frame[edge + 1][axis] - frame[0][axis]);
        }
      }
      cells.back().push_back(x);
    }
  }
  return cells;
}

using Frames = std::vector<std::array<Vec, 4>>;
inline const Frames boxes = { { Vec{ 0, 0, 0 }, Vec{ 1, 0, 0 }, Vec{ 0, 1, 0 }, Vec{ 0, 0, 1 } } };
inline const Frames prisms = { boxes[0],
  { Vec{ 1, 1, 0 }, Vec{ 0, 1, 0 }, Vec{ 1, 0, 0 }, Vec{ 1, 1, 1 } } };
inline const Frames kuhn = []
{
  Frames frames;
  std::array<std::size_t, 3> order = { 0, 1, 2 };
  do
  {
    std::array<Vec, 4> frame = { Vec{ 0, 0, 0 }, Vec{}, Vec{}, Vec{ 1, 1, 1 } };
    frame[1][order[0]] = 1;
    frame[2] = frame[1];
    frame[2][order[1]] = 1;
    frames.push_back(frame);
  } while (std::next_permutation(order.begin(), order.end()));
  return frames;
}();

struct CellKind
{
  std::string name;
  int type;
  std::vector<std::vector<Vec>> cells; // that a box is cut into
};

/// Of those cells in which fields are linear along each edge.
inline std::vector<CellKind> linearKinds()
{
  const auto c = unitCell(VTK_HEXAHEDRON, 8);
  const Vec middle = { 0.5, 0.5, 0.5 };
  return { { "Tetrahedra", VTK_TETRA, cut(unitCell(VTK_TETRA, 4), kuhn) },
    { "Hexahedra", VTK_HEXAHEDRON, { c } },
    { "Wedges", VTK_WEDGE, cut(unitCell(VTK_WEDGE, 6), prisms) },
    { "Pyramids", VTK_PYRAMID,
      { { c[0], c[1], c[2], c[3], middle }, { c[4], c[7], c[6], c[5], middle },
        { c[0], c[4], c[5], c[1], middle }, { c[3], c[2], c[6], c[7], middle },
        { c[0], c[3], c[7], c[4], middle }, { c[1], c[5], c[6], c[2], middle } } } };
}

/// The same mesh with all cells as polyhedra whose number is `from` plus a multiple of `each`.
inline Mesh asPolyhedra(vtkUnstructuredGrid* mesh, vtkIdType from = 0, vtkIdType each = 1)
{
  auto made = Mesh::New();
  made->SetPoints(mesh->GetPoints());
  made->GetPointData()->ShallowCopy(mesh->GetPointData());
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkCell* cell = mesh->GetCell(i);
    if (i % each != from)
    {
      made->InsertNextCell(cell->GetCellType(), cell->GetPointIds());
      continue;
    }
    vtkNew<vtkIdList> faces;
    faces->InsertNextId(cell->GetNumberOfFaces());
    for (int face = 0; face < cell->GetNumberOfFaces(); ++face)
    {
      vtkIdList* ids = cell->GetFace(face)->GetPointIds();
      faces->InsertNextId(ids->GetNumberOfIds());
      for (vtkIdType n = 0; n < ids->GetNumberOfIds(); ++n)
      {
        faces->InsertNextId(ids->GetId(n));
      }
    }
    made->InsertNextCell(VTK_POLYHEDRON, faces);
  }
  return made;
}

inline Vec pointOf(const schlieren::Lattice& lattice, std::size_t i)
{
  const auto row = static_cast<std::size_t>(lattice.points[0]),
             layer = row * static_cast<std::size_t>(lattice.points[1]);
  const std::size_t index[3] = { i % row, i % layer / row, i / layer };
  Vec x;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    x[axis] = lattice.first[axis] + static_cast<double>(index[axis]) * lattice.spacing[axis];
  }
  return x;
}

/// The same mesh of hexahedra, with these points of every `each`-th one in each other's place.
inline Mesh withSwapped(
  vtkUnstructuredGrid* mesh, const std::vector<std::array<vtkIdType, 2>>& pairs, vtkIdType each = 1)
{
  auto result = Mesh::New();
  result->DeepCopy(mesh);
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> ids;
    mesh->GetCellPoints(i, ids);
    for (const auto& [one, other] : pairs)
    {
      if (i % each == 0)
      {
        std::swap(*ids->GetPointer(one), *ids->GetPointer(other));
      }
    }
    cells->InsertNextCell(ids);
  }
  result->SetCells(VTK_HEXAHEDRON, cells);
  return result;
}

/// Pairs of points of a hexahedron whose lower face is above.
inline const std::vector<std::array<vtkIdType, 2>> upsideDown{ { 0, 4 }, { 1, 5 }, { 2, 6 },
  { 3, 7 } };

/// A ball of hexahedra around its poles, where edges, faces or all but a wedge of them are collapsed.
inline vtkSmartPointer<vtkStructuredGrid> ballWithPoles()
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(6, 9, 17);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < 17; ++k)
  {
    for (int j = 0; j < 9; ++j)
    {
      for (int i = 0; i < 6; ++i)
      {
        const double r = i / 5., a = pi * j / 8, b = 2 * pi * k / 16;
        points->InsertNextPoint(
          r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a));
      }
    }
  }
  grid->SetPoints(points);
  return grid;
}
