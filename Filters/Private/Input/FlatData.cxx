// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/FlatData.h"

#include "Common/AvailableMemory.h"
#include "Common/CellTypes.h"
#include "Input/InputDescription.h"

#include "vtkBoundingBox.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkLinearExtrusionFilter.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace filters
{

namespace
{

/// Relative thickness of a plane that rounding in single precision explains.
constexpr double planeTolerance = 1e-6;

/// Returns the axis without extent, -1 if there is none. Throws if there are several.
int onlyFlatAxis(const bool isFlat[3], const Source& source)
{
  if (std::count(isFlat, isFlat + 3, true) > 1)
  {
    throw std::runtime_error("The input with the " + source.label +
      " is a line or a point, so there is no volume for light to cross. Use 3-D or 2-D data.");
  }
  return isFlat[0] ? 0 : (isFlat[1] ? 1 : (isFlat[2] ? 2 : -1));
}

/// Transforms a point to the axes of directionAcross().
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

/// Keeps structured data structured, whose faces are found without a search.
void extrudeStructured(vtkDataSet* data, std::array<int, 3> points, const Plane& plane, Remade& to)
{
  const auto across =
    static_cast<std::size_t>(std::find(points.begin(), points.end(), 1) - points.begin());
  const std::array<int, 3> before = points;
  points[across] = 2;
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (int k = 0; k < points[2]; ++k)
  {
    for (int j = 0; j < points[1]; ++j)
    {
      for (int i = 0; i < points[0]; ++i)
      {
        std::array<int, 3> at{ i, j, k };
        const double offset = plane.depth * (at[across] - 0.5);
        at[across] = 0;
        const vtkIdType point = (vtkIdType{ at[2] } * before[1] + at[1]) * before[0] + at[0];
        plane.add(data, point, offset, places);
        to.points->InsertNextId(point);
      }
    }
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(points.data());
  grid->SetPoints(places);
  to.cells->SetNumberOfIds(data->GetNumberOfCells());
  std::iota(to.cells->begin(), to.cells->end(), vtkIdType{ 0 });
  to.data = grid;
}

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

/// Copies the values of the points or cells that others were made of.
vtkSmartPointer<vtkDataArray> chosenValues(vtkDataArray* from, vtkIdList* ids)
{
  auto to = vtkSmartPointer<vtkDataArray>::Take(from->NewInstance());
  to->SetName(from->GetName());
  to->SetNumberOfComponents(from->GetNumberOfComponents());
  setTuples(to, ids->GetNumberOfIds());
  from->GetTuples(ids, to);
  return to;
}

/// Turns a surface to the axes of directionAcross(), and extrudes one that lies in the plane.
vtkSmartPointer<vtkPolyData> turnedSurface(vtkPolyData* surface, int flat, double depth)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(surface);
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  double bounds[6];
  surface->GetBounds(bounds);
  vtkBoundingBox box(bounds);
  const bool isPlane =
    box.GetLength(flat) <= planeTolerance * box.GetMaxLength() && surface->GetNumberOfPolys() > 0;
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    double x[3];
    surface->GetPoint(point, x);
    const std::array<double, 3> own = turned(x, flat);
    places->InsertNextPoint(own[0], own[1], own[2] - (isPlane ? depth : 0));
  }
  result->SetPoints(places);
  if (!isPlane)
  {
    return result;
  }
  vtkNew<vtkLinearExtrusionFilter> prism;
  prism->SetInputData(result);
  prism->SetExtrusionTypeToVectorExtrusion();
  prism->SetVector(0, 0, 2 * depth);
  prism->CappingOn();
  prism->Update();
  return prism->GetOutput();
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

Leaf Remade::leafOf(const Leaf& from) const
{
  Leaf one{ this->data, {}, from.ofCells, from.input };
  for (vtkDataArray* array : from.arrays)
  {
    const auto values = chosenValues(array, from.ofCells ? this->cells : this->points);
    one.data->GetAttributes(from.ofCells ? vtkDataObject::CELL : vtkDataObject::POINT)
      ->AddArray(values);
    one.arrays.push_back(values);
  }
  if (vtkUnsignedCharArray* ghosts = from.data->GetCellGhostArray())
  {
    one.data->GetCellData()->AddArray(chosenValues(ghosts, this->cells));
  }
  for (const char* name : { vtkDataSetAttributes::GhostArrayName(), maskName, transparentName })
  {
    vtkDataArray* flags = from.data->GetPointData()->GetArray(name);
    if (flags && !one.data->GetPointData()->HasArray(name))
    {
      one.data->GetPointData()->AddArray(chosenValues(flags, this->points));
    }
  }
  return one;
}

Source extruded(const Source& source, int flat, double depth)
{
  Source result = source;
  result.image = nullptr;
  result.leaves.clear();
  vtkBoundingBox box;
  for (const Leaf& leaf : source.leaves)
  {
    if (dimensionOf(leaf.data) == 2)
    {
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  double middle[3];
  box.GetCenter(middle);
  const Plane plane{ flat, turned(middle, flat)[2], depth };
  for (const Leaf& leaf : source.leaves)
  {
    Remade made;
    const std::array<int, 3> points = structureOf(leaf.data);
    if (std::count(points.begin(), points.end(), 1) == 1)
    {
      extrudeStructured(leaf.data, points, plane, made);
    }
    else
    {
      extrudeCells(leaf.data, plane, made);
    }
    result.leaves.push_back(made.leafOf(leaf));
    result.made.emplace_back(made.data);
  }
  return result;
}

vtkSmartPointer<vtkDataObject> changedBodies(
  vtkDataObject* bodies, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& change)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (vtkDataObject* leaf : leavesOf(bodies))
  {
    auto* surface = vtkPolyData::SafeDownCast(leaf);
    if (!surface)
    {
      return bodies; // their reader reports the error
    }
    blocks->SetBlock(blocks->GetNumberOfBlocks(), change(surface));
  }
  return blocks;
}

vtkSmartPointer<vtkDataObject> turnedBodies(vtkDataObject* bodies, int flat, double depth)
{
  return bodies && flat >= 0
    ? changedBodies(
        bodies, [flat, depth](vtkPolyData* surface) { return turnedSurface(surface, flat, depth); })
    : vtkSmartPointer<vtkDataObject>(bodies);
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

int flatAxisOf(const Source& source)
{
  if (source.image)
  {
    const int* points = source.image->GetDimensions();
    const bool isFlat[3] = { points[0] == 1, points[1] == 1, points[2] == 1 };
    return onlyFlatAxis(isFlat, source);
  }
  int dimension = 0;
  vtkBoundingBox box;
  for (const Leaf& leaf : source.leaves)
  {
    const int ofLeaf = dimensionOf(leaf.data);
    if (ofLeaf == 3)
    {
      return -1;
    }
    if (ofLeaf == 2)
    {
      box.AddBounds(leaf.data->GetBounds());
    }
    dimension = std::max(dimension, ofLeaf);
  }
  const std::string problem = "The input has no 3-D cells with the " + source.label +
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
  double lengths[3];
  box.GetLengths(lengths);
  bool isFlat[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    isFlat[axis] = lengths[axis] <= planeTolerance * box.GetMaxLength();
  }
  const int flat = onlyFlatAxis(isFlat, source);
  if (flat < 0)
  {
    throw std::runtime_error(problem +
      ", and its surfaces do not lie in one plane across the x, y or z axis. Use volume data, or "
      "turn "
      "a plane (Transform) until it does: then it is extruded.");
  }
  return flat;
}

double depthOfImage(vtkImageData* image, int flat, double given)
{
  if (given > 0)
  {
    return given;
  }
  int extent[6];
  image->GetExtent(extent);
  double spacing[3];
  image->GetSpacing(spacing);
  double shorter = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (axis != flat)
    {
      shorter =
        std::min(shorter, std::abs(spacing[axis]) * (extent[2 * axis + 1] - extent[2 * axis]));
    }
  }
  return shorter;
}

double depthOf(const Source& source, int flat)
{
  if (source.image)
  {
    return depthOfImage(source.image, flat, source.depth);
  }
  if (source.depth > 0)
  {
    return source.depth;
  }
  vtkBoundingBox box;
  for (const Leaf& leaf : source.leaves)
  {
    if (dimensionOf(leaf.data) == 2)
    {
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  double shorter = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    shorter = axis == flat ? shorter : std::min(shorter, box.GetLength(axis));
  }
  return shorter;
}

std::string warningOfExtrusion(const Source& source, int flat)
{
  if (source.isDepthGiven)
  {
    return ""; // the user knows
  }
  std::ostringstream text;
  text
    << std::setprecision(4)
    << (source.isOneCellThick ? "The data are one cell thick along " : "The data are 2-D, across ")
    << "xyz"[flat] << ": they become " << depthOf(source, flat) << " data units deep, "
    << (source.isOneCellThick ? "as their cells are" : "as their shorter side is long")
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
  const vtkIdType layers = image->GetNumberOfPoints() / stride / 2; // rows of one layer
  vtkPointData* arrays = image->GetPointData();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    auto single = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
    single->DeepCopy(array);
    setTuples(array, image->GetNumberOfPoints());
    for (vtkIdType run = 0; run < layers; ++run)
    {
      array->InsertTuples(2 * run * stride, stride, run * stride, single);
      array->InsertTuples((2 * run + 1) * stride, stride, run * stride, single);
    }
  }
}

} // namespace filters
