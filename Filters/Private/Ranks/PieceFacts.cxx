// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/PieceFacts.h"

#include "Cells/MeshKey.h"
#include "Cells/Polyhedra.h"
#include "Input/FlatData.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

/// Layers of cells that a point may depend on: its trend depends on the points of the cells around
/// it, and of the next ones if these are few, and its limits on the second derivatives at these
/// points; point values found from means need two more.
constexpr int layersForPoints = 4;
constexpr int layersForMeans = 6;

bool hasCellValues(vtkDataSet* mesh)
{
  return mesh->GetCellData()->GetNumberOfArrays() > (mesh->GetCellGhostArray() ? 1 : 0);
}

/// Hashes the positions of a dataset, and of some of its points and cells.
std::uint64_t placesOf(vtkDataSet* data)
{
  Hash hash;
  const auto addPoint = [&](vtkIdType id)
  {
    double at[3];
    data->GetPoint(id, at);
    hash.add(at, 3);
  };
  constexpr vtkIdType most = 200;
  const auto forSome = [most](vtkIdType count, const auto& add)
  {
    for (vtkIdType n = 0; n < std::min(count, most); ++n)
    {
      add(count <= most ? n : n * (count / most));
    }
  };
  double bounds[6];
  data->GetBounds(bounds);
  hash.add(bounds, 6);
  hash.add(static_cast<std::uint64_t>(data->GetNumberOfPoints()));
  hash.add(static_cast<std::uint64_t>(data->GetNumberOfCells()));
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      hash.add(static_cast<std::uint64_t>(image->GetDimensions()[axis]));
    }
    return hash.value(); // sufficient for images, of which there may be many
  }
  forSome(data->GetNumberOfPoints(), addPoint);
  vtkNew<vtkIdList> points;
  forSome(data->GetNumberOfCells(),
    [&](vtkIdType cell)
    {
      data->GetCellPoints(cell, points);
      std::for_each(points->begin(), points->end(), addPoint);
    });
  return hash.value();
}

/// Lists the names, types and components of all arrays.
std::string arraysIn(vtkDataSet* data)
{
  std::string text;
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(kind);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = attributes->GetAbstractArray(i);
      const char* name = array->GetName() ? array->GetName() : "";
      if (std::string(name) != vtkDataSetAttributes::GhostArrayName())
      {
        text += std::to_string(kind) + name + '/' + std::to_string(array->GetDataType()) + '/' +
          std::to_string(array->GetNumberOfComponents()) + ';';
      }
    }
  }
  return text;
}

} // namespace

PieceFacts factsOf(const DatasetPiece& piece, const std::optional<std::array<double, 3>>& origin)
{
  const int dimension = dimensionOf(piece.data);
  std::optional<Wedge> wedge;
  if (origin && dimension == 3)
  {
    wedge = findWedge({ piece.data }, *origin);
  }
  PieceFacts facts{ piece.slot, arraysIn(piece.data),
    { piece.data->GetDataObjectType(), dimension,
      hasCellValues(piece.data) || hasPolyhedra(piece.data) ? layersForMeans : layersForPoints,
      piece.data->GetNumberOfCells(), placesOf(piece.data), noPoints, layerBoundsOf(piece.data),
      wedge ? std::array<double, 3>{ double(wedge->axis), wedge->angles[0], wedge->angles[1] }
            : std::array<double, 3>{ -1, 0, 0 } } };
  if (isGrid(piece.data))
  {
    facts.numbers.extent = extentOf(piece.data, false);
  }
  return facts;
}

bool areOneWedge(const std::vector<std::array<double, 3>>& pieces)
{
  constexpr double tolerance = 1e-3; // radians
  return !pieces.empty() && pieces[0][0] >= 0 &&
    std::all_of(pieces.begin(), pieces.end(),
      [&](const std::array<double, 3>& piece)
      {
        return piece[0] == pieces[0][0] && std::abs(piece[1] - pieces[0][1]) < tolerance &&
          std::abs(piece[2] - pieces[0][2]) < tolerance;
      });
}

} // namespace filters
