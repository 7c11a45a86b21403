// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CutMesh.h"
#include "Surfaces.h"

#include "Sources/SharedPoints.h"
#include "Walls/GasBoundary.h"

#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiBlockPLOT3DReader.h"
#include "vtkPoints.h"
#include "vtkStaticCellLocator.h"
#include "vtkStructuredGrid.h"
#include "vtkThreshold.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <iterator>

using filters::GasBoundary;
using filters::Outside;
using schlieren::Lattice;
using schlieren::Place;

using Data = vtkSmartPointer<vtkDataSet>;
using Mapping = std::function<Vec(double, double, double)>;
using CellTest = std::function<bool(const filters::Point& place)>;

/// A curvilinear grid over the unit cube of its parameters, N = 1 everywhere.
inline vtkSmartPointer<vtkStructuredGrid> curvilinear(
  int ni, int nj, int nk, const Mapping& place, int type = VTK_DOUBLE)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(ni, nj, nk);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  for (int k = 0; k < nk; ++k)
  {
    for (int j = 0; j < nj; ++j)
    {
      for (int i = 0; i < ni; ++i)
      {
        const Vec x = place(i / (ni - 1.), j / (nj - 1.), k / (nk - 1.));
        points->InsertNextPoint(x.data());
      }
    }
  }
  grid->SetPoints(points);
  addPointArray(grid, "N", [](const Vec&) { return 1; });
  grid->GetPointData()->SetActiveScalars("N");
  return grid;
}

/// Around a sphere of radius 1: poles on z, a seam at y = 0. `part`: of the longitude.
inline Vec aroundSphere(double r, double latitude, double longitude, double far, double part = 1)
{
  const double radius = std::pow(far, r);
  const double theta = pi * latitude, phi = 2 * pi * part * longitude;
  return { radius * std::sin(theta) * std::cos(phi), radius * std::sin(theta) * std::sin(phi),
    radius * std::cos(theta) };
}

inline vtkSmartPointer<vtkStructuredGrid> sphereMesh(
  int n, double far, int type = VTK_DOUBLE, double part = 1)
{
  return curvilinear(
    n, n + 1, 2 * n + 1,
    [&](double i, double j, double k) { return aroundSphere(i, j, k, far, part); }, type);
}

/// Turned about an axis across all the others.
inline Vec turned(Vec x)
{
  const Vec a = unit({ 0.3, 0.7, 0.5 });
  const double angle = 0.6;
  const Vec b = cross(a, x);
  const double along = dot(a, x) * (1 - std::cos(angle));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    x[axis] = x[axis] * std::cos(angle) + b[axis] * std::sin(angle) + along * a[axis];
  }
  return x;
}

inline void turn(vtkPointSet* data)
{
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    Vec x;
    data->GetPoint(i, x.data());
    data->GetPoints()->SetPoint(i, turned(x).data());
  }
}

/// The cells whose array "gas" is not 0, as an unstructured mesh.
inline Data gasOf(vtkDataSet* data)
{
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(data);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "gas");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  threshold->SetUpperThreshold(0.5);
  threshold->Update();
  Data gas = threshold->GetOutput();
  gas->GetPointData()->SetActiveScalars("N");
  return gas;
}

/// The cells of a box [0, lengths] whose middles are in gas.
inline Data blocks(
  const std::array<int, 3>& cells, const Vec& lengths, const std::function<bool(const Vec&)>& isGas)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(cells[0] + 1, cells[1] + 1, cells[2] + 1);
  image->SetSpacing(lengths[0] / cells[0], lengths[1] / cells[1], lengths[2] / cells[2]);
  addPointArray(image, "N", [](const Vec&) { return 1; });
  addCellArray(image, "gas", [&](const Vec& x) { return isGas(x) ? 1 : 0; });
  return gasOf(image);
}

inline void hide(vtkDataSet* data, const std::function<bool(const Vec&)>& isHidden)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    double b[6];
    data->GetCellBounds(i, b);
    const bool is = isHidden({ (b[0] + b[1]) / 2, (b[2] + b[3]) / 2, (b[4] + b[5]) / 2 });
    ghosts->InsertNextValue(is ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  data->GetCellData()->AddArray(ghosts);
}

/// Which visible cells hold a place.
class Cells
{
public:
  explicit Cells(const std::vector<Data>& leaves)
  {
    for (const Data& leaf : leaves)
    {
      vtkNew<vtkStaticCellLocator> locator;
      locator->SetDataSet(leaf);
      locator->BuildLocator();
      locators_.emplace_back(locator);
      ghosts_.push_back(leaf->GetCellGhostArray());
    }
  }
  bool hold(const Vec& x) const
  {
    vtkNew<vtkGenericCell> cell;
    for (std::size_t i = 0; i < locators_.size(); ++i)
    {
      Vec place = x;
      double coordinates[3], weights[64];
      int sub;
      const vtkIdType found =
        locators_[i]->FindCell(place.data(), 1e-20, cell, sub, coordinates, weights);
      if (found >= 0 && (!ghosts_[i] || ghosts_[i]->GetValue(found) == 0))
      {
        return true;
      }
    }
    return false;
  }
  CellTest test() const
  {
    return [this](const filters::Point& x) { return this->hold(x); };
  }

private:
  std::vector<vtkSmartPointer<vtkStaticCellLocator>> locators_;
  std::vector<vtkUnsignedCharArray*> ghosts_;
};

inline std::vector<vtkDataSet*> pointers(const std::vector<Data>& leaves)
{
  return { leaves.begin(), leaves.end() };
}

/// Areas of walls and windows.
struct Areas
{
  double wall = 0, window = 0;
};

inline Areas areasOf(const GasBoundary& boundary)
{
  Areas areas;
  for (std::size_t t = 0; t < boundary.surface().size(); ++t)
  {
    const double area = 0.5 * filters::norm(boundary.surface().normal(t));
    (boundary.isWall(t) ? areas.wall : areas.window) += area;
  }
  return areas;
}

inline std::vector<Data> withSharedPoints(const std::vector<Data>& leaves)
{
  return filters::withSharedPoints(leaves);
}

/// As for an image: points that coincide are one before.
inline GasBoundary boundaryOfLeaves(const std::vector<vtkDataSet*>& leaves, vtkDataObject* bodies,
  Outside outside, const CellTest& isInCell, filters::Extent extent = filters::Extent::Volume)
{
  const std::vector<Data> joined = withSharedPoints({ leaves.begin(), leaves.end() });
  filters::OpenFaces open(filters::facesOf(pointers(joined), filters::WorkProgress()), extent);
  if (isInCell)
  {
    const auto areIn = [&](const std::vector<filters::Point>& places)
    {
      filters::OpenFaces::Flags are;
      std::transform(places.begin(), places.end(), std::back_inserter(are),
        [&](const filters::Point& place) { return isInCell(place) ? 1 : 0; });
      return are;
    };
    const auto middles = areIn(open.middles());
    open.removeCovered(middles, areIn(open.corners(middles)));
  }
  return { open.boundary(outside), bodies, outside };
}

inline Areas areasOf(const std::vector<Data>& leaves, Outside outside = Outside::Auto)
{
  return areasOf(boundaryOfLeaves(pointers(leaves), nullptr, outside, {}));
}

inline void expectAreas(const Areas& areas, double wall, double window, double tolerance = 1e-6)
{
  EXPECT_NEAR(areas.wall, wall, tolerance * (wall + window));
  EXPECT_NEAR(areas.window, window, tolerance * (wall + window));
}

/// The same, also where the mesh is turned, and its points are of single precision.
inline void expectAreasWherever(
  vtkPointSet* mesh, double wall, double window, double tolerance = 1e-6)
{
  expectAreas(areasOf({ mesh }), wall, window, tolerance);
  turn(mesh);
  expectAreas(areasOf({ mesh }), wall, window, tolerance);
  vtkNew<vtkPoints> single;
  single->SetDataTypeToFloat();
  single->DeepCopy(mesh->GetPoints());
  mesh->SetPoints(single);
  expectAreas(areasOf({ mesh }), wall, window, std::max(tolerance, 1e-4));
}

inline vtkPointSet* asPoints(const Data& data) { return vtkPointSet::SafeDownCast(data); }

inline std::string shared(const std::string& name)
{
  return std::string(SCHLIEREN_TEST_DATA) + "/" + name;
}

inline Data withScalars(vtkDataSet* data)
{
  data->GetCellData()->Initialize();
  addPointArray(data, "N", [](const Vec&) { return 1; });
  data->GetPointData()->SetActiveScalars("N");
  return data;
}

inline Data bluntFin()
{
  vtkNew<vtkMultiBlockPLOT3DReader> reader;
  reader->SetXYZFileName(shared("bluntfin_plot3d/bluntfinxyz.bin").c_str());
  reader->SetQFileName(shared("bluntfin_plot3d/bluntfinq.bin").c_str());
  reader->Update();
  return withScalars(vtkDataSet::SafeDownCast(reader->GetOutput()->GetBlock(0)));
}
