// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of one mesh on several ranks: each gets copies of the others' cells around the points that they have in common.
#pragma once

#include "DataParts.h"
#include "Vectors.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

class vtkDataSet;
class vtkUnstructuredGrid;

namespace filters
{

/// What data are that can stay on their ranks, in three dimensions: bits, both where there are none.
enum PieceKinds : std::int32_t
{
  NoPieces = 0,
  PiecesOfMeshes = 1, // all datasets are meshes, grids or images
  PieceOfImage = 2,   // one image
  PiecesOfBlocks = 4  // all datasets are images, which may be blocks of adaptive meshes
};
std::int32_t pieceKindsOf(vtkDataObject* data);

/// Points on several ranks are one if both are the same: their places, and how many points of the mesh before them are at
/// that place.
struct PointName
{
  Point place;
  double number;
};
inline bool operator==(const PointName& a, const PointName& b)
{
  return a.place == b.place && a.number == b.number;
}

/// Where another part may continue: of a mesh the points that are on its surface; of a grid its extent.
struct Outline
{
  using Extent = std::array<int, 6>;

  bool isGrid = false;
  Extent extent{};
  std::array<double, 15> place{}; // of an image: origin, spacing and direction
  int layers = 0;                 // of cells that a grid needs of others, around its own
  std::vector<vtkIdType> ids;
  std::vector<PointName> names;
};
/// Adds an array to meshes that says the points' numbers.
Outline outlineOf(vtkDataSet* mesh);

/// The part of a grid that another one, of that extent, needs copies of; low > high: none.
Outline::Extent neededOf(const Outline::Extent& grid, const Outline::Extent& other, int layers);

struct HashOfPlace
{
  std::size_t operator()(const Point& place) const
  {
    std::size_t sum = 0;
    for (const double x : place)
    {
      sum = 1000003 * sum + std::hash<double>()(x);
    }
    return sum;
  }
  std::size_t operator()(const PointName& name) const { return (*this)(name.place); }
};

/// The cells at some points, those at the points of these, and as many more layers as other points' values depend on.
vtkSmartPointer<vtkDataSet> cellsAround(
  vtkUnstructuredGrid* mesh, const std::vector<vtkIdType>& points);
/// The cells of a grid within an extent.
vtkSmartPointer<vtkDataSet> cellsWithin(vtkDataSet* grid, const Outline::Extent& extent);

/// A mesh or grid and cells of others beside it, which become copies (DUPLICATECELL). Points with the same name become
/// one. Grids that are no box together stay without. Throws std::runtime_error where the arrays are not the same.
vtkSmartPointer<vtkDataSet> withCopies(
  vtkDataSet* mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& others);

} // namespace filters
