// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/FlatData.h"

#include "Common/AvailableMemory.h"
#include "Common/CellTypes.h"
#include "Input/SizeOfFlow.h"

#include "vtkBoundingBox.h"
#include "vtkCell.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace filters
{

namespace
{

/// Returns the axis without extent, -1 if there is none. Throws if there are several.
int onlyFlatAxis(const bool isFlat[3], const Flow& flow)
{
  if (std::count(isFlat, isFlat + 3, true) > 1)
  {
    throw std::runtime_error("The input with the " + flow.label +
      " is a line or a point, so there is no volume for light to cross. Use 3-D or 2-D data.");
  }
  return isFlat[0] ? 0 : (isFlat[1] ? 1 : (isFlat[2] ? 2 : -1));
}

/// Returns the shorter of the sides of a plane across an axis.
double shorterSide(const double lengths[3], int flat)
{
  return std::min(lengths[flat == 0 ? 1 : 0], lengths[flat == 2 ? 1 : 2]);
}

/// A plane across an axis, into which points that miss it by rounding are moved.
struct Plane
{
  int flat;
  double height; // along z of directionAcross()
  double depth;

  void add(vtkDataSet* from, vtkIdType point, double offset, vtkPoints* to) const
  {
    double x[3];
    from->GetPoint(point, x);
    const std::array<double, 3> own = turned(x, this->flat);
    to->InsertNextPoint(own[0], own[1], this->height + offset);
  }
};

/// Extrudes cells. All but linear triangles, quadrilaterals and pixels are triangulated first.
void extrudeCells(vtkDataSet* data, const Plane& plane, Remade& to)
{
  const vtkIdType count = data->GetNumberOfPoints();
  // Counts two layers of points and their numbers, and a cell's corners, type and number.
  constexpr double bytesOfPoint = 2 * (3 * sizeof(double) + sizeof(vtkIdType));
  constexpr double bytesOfCell = 11 * sizeof(vtkIdType);
  requireMemory(bytesOfPoint * static_cast<double>(count) +
      bytesOfCell * static_cast<double>(data->GetNumberOfCells()),
    "To extrude the 2-D data", "Use a coarser input.");
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (const double offset : { -0.5, 0.5 })
  {
    for (vtkIdType point = 0; point < count; ++point)
    {
      plane.add(data, point, plane.depth * offset, places);
      to.points->InsertNextId(point);
    }
  }
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(places);
  mesh->Allocate(data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> notUsed;
  const auto add = [&](int type, const vtkIdType* corners, vtkIdType ofFace, vtkIdType cell)
  {
    std::array<vtkIdType, 8> both{};
    for (vtkIdType i = 0; i < ofFace; ++i)
    {
      both[static_cast<std::size_t>(i)] = corners[i];
      both[static_cast<std::size_t>(ofFace + i)] = corners[i] + count;
    }
    mesh->InsertNextCell(type, 2 * ofFace, both.data());
    to.cells->InsertNextId(cell);
  };
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (dimensionOfCell(data, cell) != 2)
    {
      continue;
    }
    const int type = data->GetCellType(cell);
    if (type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_PIXEL)
    {
      data->GetCellPoints(cell, ids);
      add(type == VTK_TRIANGLE ? VTK_WEDGE : (type == VTK_QUAD ? VTK_HEXAHEDRON : VTK_VOXEL),
        ids->GetPointer(0), ids->GetNumberOfIds(), cell);
      continue;
    }
    data->GetCell(cell)->Triangulate(0, ids, notUsed);
    for (vtkIdType corner = 0; corner + 2 < ids->GetNumberOfIds(); corner += 3)
    {
      add(VTK_WEDGE, ids->GetPointer(corner), 3, cell);
    }
  }
  to.data = mesh;
}

} // namespace

std::array<double, 9> directionAcross(int flat)
{
  switch (flat)
  {
    case 0: // axes y, z, x
      return { 0, 0, 1, 1, 0, 0, 0, 1, 0 };
    case 1: // axes x, z, -y
      return { 1, 0, 0, 0, 0, -1, 0, 1, 0 };
    default:
      return { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  }
}

std::array<double, 3> turned(const double x[3], int flat)
{
  const std::array<double, 9> d = directionAcross(flat);
  std::array<double, 3> own{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    own[i] = d[i] * x[0] + d[3 + i] * x[1] + d[6 + i] * x[2];
  }
  return own;
}

Flow extruded(const Flow& flow, int flat, double depth)
{
  Flow result = flow;
  result.image = nullptr;
  result.leaves.clear();
  double middle[3];
  boundsOfPlanes(flow).GetCenter(middle);
  const Plane plane{ flat, turned(middle, flat)[2], depth };
  for (const Leaf& leaf : flow.leaves)
  {
    Remade made;
    extrudeCells(leaf.data, plane, made);
    result.leaves.push_back(made.leafOf(leaf));
    result.made.emplace_back(made.data);
  }
  return result;
}

int dimensionOfCell(vtkDataSet* data, vtkIdType cell)
{
  static std::array<std::atomic<int>, 256> known; // dimension + 1; 0: unknown yet
  const auto type = static_cast<unsigned char>(data->GetCellType(cell));
  if (known[type] == 0)
  {
    known[type] = 1 + vtkCellTypeUtilities::GetDimension(type);
  }
  return known[type] - 1;
}

int dimensionOf(vtkDataSet* data)
{
  int dimension = 0;
  for (vtkIdType i = 0; i < data->GetNumberOfCells() && dimension < 3; ++i)
  {
    dimension = std::max(dimension, dimensionOfCell(data, i));
  }
  return dimension;
}

vtkBoundingBox boundsOfPlanes(const Flow& flow)
{
  vtkBoundingBox box;
  for (const Leaf& leaf : flow.leaves)
  {
    if (dimensionOf(leaf.data) == 2)
    {
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  return box;
}

int flatAxisOf(const Flow& flow)
{
  if (flow.image)
  {
    const int* points = flow.image->GetDimensions();
    const bool isFlat[3] = { points[0] == 1, points[1] == 1, points[2] == 1 };
    return onlyFlatAxis(isFlat, flow);
  }
  int dimension = 0;
  for (const Leaf& leaf : flow.leaves)
  {
    dimension = std::max(dimension, dimensionOf(leaf.data));
    if (dimension == 3)
    {
      return -1;
    }
  }
  const std::string problem = "The input has no 3-D cells with the " + flow.label +
    ", so there is no volume for light to cross";
  if (dimension == 0)
  {
    throw std::runtime_error(problem +
      ": it has nothing but points, such as particles. Make a volume of them with Point Volume "
      "Interpolator, SPH Volume Interpolator or Gaussian Resampling.");
  }
  if (dimension < 2)
  {
    throw std::runtime_error(problem + ". Use 3-D data, or 2-D data in one plane.");
  }
  const vtkBoundingBox box = boundsOfPlanes(flow);
  bool isFlat[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    isFlat[axis] = box.GetLength(axis) <= planeTolerance * box.GetMaxLength();
  }
  const int flat = onlyFlatAxis(isFlat, flow);
  if (flat < 0)
  {
    throw std::runtime_error(problem +
      ", and its surfaces do not lie in one plane across the x, y or z axis. Use volume data, or "
      "turn a plane (Transform) until it does: then it is extruded.");
  }
  return flat;
}

double depthOfImage(vtkImageData* image, int flat, double given)
{
  if (given > 0)
  {
    return given;
  }
  double lengths[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = std::abs(image->GetSpacing()[axis]) * (image->GetDimensions()[axis] - 1);
  }
  return shorterSide(lengths, flat);
}

double depthOf(const Flow& flow, int flat)
{
  if (flow.image)
  {
    return depthOfImage(flow.image, flat, flow.depth);
  }
  if (flow.depth > 0)
  {
    return flow.depth;
  }
  double lengths[3];
  boundsOfPlanes(flow).GetLengths(lengths);
  return shorterSide(lengths, flat);
}

void chooseDepth(Flow& flow, int flat)
{
  const double shorter = depthOf(flow, flat), size = sizeOfFlow(flow, flat);
  flow.depth = shorter;
  while (size > 0 && size <= 0.5 * flow.depth)
  {
    flow.depth *= 0.5;
  }
  flow.sizeInFarField = flow.depth < shorter ? size : 0;
}

std::string warningOfExtrusion(const Flow& flow, int flat)
{
  if (flow.isDepthGiven)
  {
    return ""; // the user knows
  }
  std::ostringstream text;
  text << std::setprecision(4)
       << (flow.isOneCellThick ? "The data are one cell thick along " : "The data are 2-D, across ")
       << "xyz"[flat] << ": they become " << depthOf(flow, flat) << " data units deep, ";
  if (flow.sizeInFarField > 0)
  {
    text << "a part of their shorter side, because the flow in them is " << flow.sizeInFarField
         << " in size (where the refractivity differs by more than " << 100 * leastOfFlow
         << " % of the largest difference)";
  }
  else
  {
    text << (flow.isOneCellThick ? "as their cells are" : "as their shorter side is long");
  }
  text
    << ". Deflection and optical path are in proportion to it; set Depth to the depth of the real "
       "flow.";
  return text.str();
}

void extrudeGrid(vtkImageData* grid, int flat, double depth)
{
  int extent[6];
  grid->GetExtent(extent);
  extent[2 * flat] = 0;
  extent[2 * flat + 1] = 1;
  double corner[3] = { 0, 0, 0 }, offset[3] = { 0, 0, 0 }, origin[3], spacing[3];
  grid->GetSpacing(spacing);
  grid->GetOrigin(origin);
  corner[flat] = spacing[flat] * grid->GetExtent()[2 * flat] - 0.5 * depth;
  grid->GetDirectionMatrix()->MultiplyPoint(corner, offset);
  spacing[flat] = depth;
  grid->SetExtent(extent);
  grid->SetSpacing(spacing);
  grid->SetOrigin(origin[0] + offset[0], origin[1] + offset[1], origin[2] + offset[2]);
}

void extrudeArrays(vtkImageData* image, int flat)
{
  int points[3];
  image->GetDimensions(points);
  const vtkIdType stride =
    flat == 0 ? 1 : static_cast<vtkIdType>(points[0]) * (flat == 1 ? 1 : points[1]);
  vtkNew<vtkIdList> ids; // of the one layer, for each point of two, which are `stride` apart
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    ids->InsertNextId(point / (2 * stride) * stride + point % stride);
  }
  vtkPointData* arrays = image->GetPointData();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    array->ShallowCopy(chosenValues(array, ids));
  }
}

} // namespace filters
