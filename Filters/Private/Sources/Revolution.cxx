// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/Revolution.h"

#include "Input/FlatData.h"

#include "vtkBoundingBox.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

/// Distance from the axis, relative to the plane's size, of points that count as on it.
constexpr double axisTolerance = 1e-6;

vtkBoundingBox boundsOf(const Source& source)
{
  vtkBoundingBox box;
  for (const Leaf& leaf : source.leaves)
  {
    if (dimensionOf(leaf.data) == 2)
    {
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  return box;
}

/// Properties of the data with respect to a candidate for the axis.
struct Candidate
{
  int axis, radial;
  double low, high; // distances from it; negative on its other side
  double slope =
    0; // of the first array across the axis, relative to that anywhere: 0 for the right axis
  double change = 0; // of the array along the radius

  double radius() const { return std::max(std::abs(this->low), std::abs(this->high)); }
  bool touches(double tolerance) const
  {
    return this->low <= tolerance && this->high >= -tolerance;
  }
};

/// Finds the slopes of the first array at the axis, by the nearest layers of cells.
void measure(const Source& source, const std::array<double, 3>& origin, Candidate& candidate)
{
  const auto radial = static_cast<std::size_t>(candidate.radial);
  double near = 0, nearWeight = 0, all = 0, allWeight = 0, change = 0;
  for (const Leaf& leaf : source.leaves)
  {
    if (leaf.ofCells)
    {
      continue; // see withValuesAtPoints()
    }
    vtkDataArray* values = leaf.arrays[0];
    for (vtkIdType cell = 0; cell < leaf.data->GetNumberOfCells(); ++cell)
    {
      if (dimensionOfCell(leaf.data, cell) != 2)
      {
        continue;
      }
      vtkNew<vtkIdList> ids;
      leaf.data->GetCellPoints(cell, ids);
      double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, ofLowest = 0,
             ofHighest = 0;
      int countLow = 0, countHigh = 0;
      for (int pass = 0; pass < 2; ++pass)
      {
        for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
        {
          double x[3];
          leaf.data->GetPoint(ids->GetId(i), x);
          const double r = x[radial] - origin[radial];
          if (pass == 0)
          {
            lowest = std::min(lowest, r);
            highest = std::max(highest, r);
            continue;
          }
          const double middle = 0.5 * (lowest + highest);
          double& sum = r < middle ? ofLowest : ofHighest;
          sum += values->GetComponent(ids->GetId(i), 0);
          ++(r < middle ? countLow : countHigh);
        }
      }
      if (countLow == 0 || countHigh == 0 || !(highest > lowest))
      {
        continue;
      }
      const double length = highest - lowest;
      const double difference = std::abs(ofHighest / countHigh - ofLowest / countLow);
      if (!std::isfinite(difference))
      {
        continue;
      }
      all += difference;
      allWeight += length;
      change += difference;
      if (std::min(std::abs(lowest), std::abs(highest)) < 0.5 * length)
      {
        near += difference;
        nearWeight += length;
      }
    }
  }
  const double mean = allWeight > 0 ? all / allWeight : 0;
  candidate.slope = nearWeight > 0 && mean > 0 ? near / nearWeight / mean : 0;
  candidate.change = change;
}

/// Averages cell values at points, because slopes need neighbours.
Source withValuesAtPoints(const Source& source)
{
  Source result = source;
  for (Leaf& leaf : result.leaves)
  {
    if (!leaf.ofCells)
    {
      continue;
    }
    auto cells = vtkSmartPointer<vtkDataSet>::Take(leaf.data->NewInstance());
    cells->CopyStructure(leaf.data);
    cells->GetCellData()->SetScalars(leaf.arrays[0]);
    vtkNew<vtkCellDataToPointData> mean;
    mean->SetInputData(cells);
    mean->Update();
    leaf.data = mean->GetOutput();
    leaf.ofCells = false;
    leaf.arrays = { leaf.data->GetPointData()->GetScalars() };
    result.made.emplace_back(leaf.data);
  }
  return result;
}

/// Lists the axes that the data are on one side of, or are centred about.
std::vector<Candidate> candidatesFor(
  const vtkBoundingBox& box, int flat, const std::array<double, 3>& origin, double tolerance)
{
  constexpr double centred = 1e-3;
  std::vector<Candidate> candidates;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int radial = 3 - axis - flat;
    if (axis == flat)
    {
      continue;
    }
    const double from = origin[static_cast<std::size_t>(radial)];
    const Candidate candidate{ axis, radial, box.GetBound(2 * radial) - from,
      box.GetBound(2 * radial + 1) - from };
    const bool isOnOneSide = candidate.low >= -tolerance || candidate.high <= tolerance;
    if (isOnOneSide ||
      std::abs(candidate.low + candidate.high) <= centred * (candidate.high - candidate.low))
    {
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

Candidate bestOf(std::vector<Candidate> candidates, const Source& source,
  const std::array<double, 3>& origin, double tolerance)
{
  const auto touching = [&](const Candidate& one) { return one.touches(tolerance); };
  if (std::any_of(candidates.begin(), candidates.end(), touching))
  {
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), std::not_fn(touching)),
      candidates.end());
  }
  if (candidates.size() < 2)
  {
    return candidates.at(0);
  }
  const Source atPoints = withValuesAtPoints(source);
  for (Candidate& candidate : candidates)
  {
    measure(atPoints, origin, candidate);
  }
  // Rejects axes along whose radius the flow does not change.
  constexpr double little = 0.05;
  for (const std::size_t one : { 0, 1 })
  {
    if (candidates[one].change < little * candidates[1 - one].change)
    {
      return candidates[1 - one];
    }
  }
  constexpr double smooth = 0.5; // slopes at the axis that count as none
  return candidates[0].slope < smooth || candidates[0].slope <= candidates[1].slope ? candidates[0]
                                                                                    : candidates[1];
}

/// Mirrors an image at the axis.
vtkSmartPointer<vtkImageData> turnedOver(
  vtkImageData* image, const Revolution& revolution, Remade& made)
{
  const int radial = revolution.radial;
  int points[3], cells[3];
  image->GetDimensions(points);
  for (int axis = 0; axis < 3; ++axis)
  {
    cells[axis] = std::max(1, points[axis] - 1);
  }
  double origin[3], spacing[3], bounds[6];
  image->GetOrigin(origin);
  image->GetSpacing(spacing);
  image->GetBounds(bounds);
  auto other = vtkSmartPointer<vtkImageData>::New();
  double corner[3] = { bounds[0], bounds[2], bounds[4] };
  corner[radial] = 2 * revolution.origin[static_cast<std::size_t>(radial)] - bounds[2 * radial + 1];
  other->SetDimensions(points);
  other->SetOrigin(corner);
  other->SetSpacing(spacing);
  const auto collect = [&](const int count[3], vtkIdList* ids)
  {
    for (int k = 0; k < count[2]; ++k)
    {
      for (int j = 0; j < count[1]; ++j)
      {
        for (int i = 0; i < count[0]; ++i)
        {
          int at[3] = { i, j, k };
          at[radial] = count[radial] - 1 - at[radial];
          ids->InsertNextId((vtkIdType{ at[2] } * count[1] + at[1]) * count[0] + at[0]);
        }
      }
    }
  };
  collect(points, made.points);
  collect(cells, made.cells);
  return other;
}

/// Finds rows of points about half a cell from the axis: structured data without points on it.
/// Returns each point and its neighbour in the row's cells, in order; empty: there are none.
std::vector<std::array<vtkIdType, 2>> rowAtAxis(
  vtkDataSet* data, const Revolution& revolution, double tolerance)
{
  constexpr double widest = 0.75; // cells
  const std::array<int, 3> points = structureOf(data);
  const auto radial = static_cast<std::size_t>(revolution.radial);
  const double from = revolution.origin[radial];
  std::vector<std::array<vtkIdType, 2>> row;
  std::array<vtkIdType, 3> strides{ 1, points[0], vtkIdType{ points[0] } * points[1] };
  for (std::size_t away = 0; away < 3; ++away)
  {
    for (std::size_t along = 0; along < 3; ++along)
    {
      if (away == along || points[away] < 2 || points[along] < 2)
      {
        continue;
      }
      for (const bool isLast : { false, true })
      {
        const vtkIdType first = isLast ? (points[away] - 1) * strides[away] : 0;
        const vtkIdType inward = isLast ? -strides[away] : strides[away];
        bool isRow = true;
        for (int i = 0; i < points[along] && isRow; ++i)
        {
          double x[3], next[3];
          data->GetPoint(first + i * strides[along], x);
          data->GetPoint(first + i * strides[along] + inward, next);
          const double r = std::abs(x[radial] - from);
          isRow = r > tolerance && r <= widest * std::abs(next[radial] - x[radial]);
        }
        for (int i = 0; i + 1 < points[along] && isRow; ++i)
        {
          row.push_back({ first + i * strides[along], first + (i + 1) * strides[along] });
        }
        if (isRow)
        {
          return row;
        }
      }
    }
  }
  return row;
}

/// Returns twice the area of a polygon in the plane; negative for the other orientation.
double areaOf(
  vtkPoints* places, const std::vector<vtkIdType>& corners, const Revolution& revolution)
{
  const auto along = static_cast<std::size_t>(revolution.axis),
             away = static_cast<std::size_t>(revolution.radial);
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    std::array<double, 3> a, b;
    places->GetPoint(corners[i], a.data());
    places->GetPoint(corners[(i + 1) % corners.size()], b.data());
    area += a[along] * b[away] - a[away] * b[along];
  }
  return area;
}

/// Adds the points and their images across the axis. Returns those of each point: itself on the axis.
std::vector<vtkIdType> addPointsOfBothSides(
  vtkDataSet* data, const Revolution& revolution, double tolerance, vtkPoints* places, Remade& made)
{
  const auto radial = static_cast<std::size_t>(revolution.radial);
  const double from = revolution.origin[radial];
  const vtkIdType count = data->GetNumberOfPoints();
  std::vector<vtkIdType> others(static_cast<std::size_t>(count));
  std::vector<std::array<double, 3>> across;
  for (vtkIdType point = 0; point < count; ++point)
  {
    std::array<double, 3> x;
    data->GetPoint(point, x.data());
    const bool isOnAxis = std::abs(x[radial] - from) <= tolerance;
    x[radial] = isOnAxis ? from : x[radial];
    places->InsertNextPoint(x.data());
    made.points->InsertNextId(point);
    others[static_cast<std::size_t>(point)] =
      isOnAxis ? point : count + static_cast<vtkIdType>(across.size());
    if (!isOnAxis)
    {
      x[radial] = 2 * from - x[radial];
      across.push_back(x);
    }
  }
  for (vtkIdType point = 0; point < count; ++point)
  {
    const vtkIdType other = others[static_cast<std::size_t>(point)];
    if (other >= count)
    {
      places->InsertNextPoint(across[static_cast<std::size_t>(other - count)].data());
      made.points->InsertNextId(point);
    }
  }
  return others;
}

/// Finds the corners of a plane cell, or of the triangles that it is divided into. Returns the type of these.
int cornersOfPlane(vtkDataSet* data, vtkIdType cell, vtkIdList* ids)
{
  const int type = data->GetCellType(cell);
  data->GetCellPoints(cell, ids);
  if (type == VTK_PIXEL)
  {
    const vtkIdType last = ids->GetId(3);
    ids->SetId(3, ids->GetId(2));
    ids->SetId(2, last);
    return VTK_QUAD;
  }
  if (type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON)
  {
    return type;
  }
  vtkNew<vtkPoints> notUsed;
  data->GetCell(cell)->Triangulate(0, ids, notUsed);
  return VTK_TRIANGLE;
}

/// Makes a mesh of both sides of the axis, with points on it once.
void addBothSides(const Leaf& leaf, const Revolution& revolution, double tolerance, Remade& made)
{
  vtkDataSet* data = leaf.data;
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  const std::vector<vtkIdType> others =
    addPointsOfBothSides(data, revolution, tolerance, places, made);
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(places);
  mesh->Allocate(2 * data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  double area = 0; // of the first cell
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (dimensionOfCell(data, cell) != 2)
    {
      continue;
    }
    const int type = cornersOfPlane(data, cell, ids);
    const vtkIdType size = type == VTK_TRIANGLE ? 3 : ids->GetNumberOfIds();
    for (vtkIdType begin = 0; begin + size <= ids->GetNumberOfIds(); begin += size)
    {
      const std::vector<vtkIdType> corners(ids->GetPointer(begin), ids->GetPointer(begin) + size);
      area = area != 0 ? area : areaOf(places, corners, revolution);
      mesh->InsertNextCell(type, size, corners.data());
      made.cells->InsertNextId(cell);
      std::vector<vtkIdType> turned(corners.rbegin(), corners.rend());
      for (vtkIdType& corner : turned)
      {
        corner = others[static_cast<std::size_t>(corner)];
      }
      mesh->InsertNextCell(type, size, turned.data());
      made.cells->InsertNextId(cell);
    }
  }
  if (!leaf.ofCells) // cells have no values nearer to the axis
  {
    for (const std::array<vtkIdType, 2>& side : rowAtAxis(data, revolution, tolerance))
    {
      std::vector<vtkIdType> corners{ side[0], side[1], others[static_cast<std::size_t>(side[1])],
        others[static_cast<std::size_t>(side[0])] };
      if (areaOf(places, corners, revolution) * area < 0)
      {
        std::reverse(corners.begin(), corners.end());
      }
      mesh->InsertNextCell(VTK_QUAD, 4, corners.data());
      made.cells->InsertNextId(0);
    }
  }
  made.data = mesh;
}

} // namespace

schlieren::Box Revolution::box() const
{
  schlieren::Box result{ this->origin, this->origin };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const bool isAlong = static_cast<int>(i) == this->axis;
    result.low[i] = isAlong ? this->low : this->origin[i] - this->radius;
    result.high[i] = isAlong ? this->high : this->origin[i] + this->radius;
  }
  return result;
}

Revolution revolutionOf(const Source& source)
{
  const MediumSettings& settings = source.choice.settings;
  const int given = settings.SymmetryAxis - 1; // -1: not given
  const std::array<double, 3> origin = settings.symmetryOrigin();
  if (!std::all_of(origin.begin(), origin.end(), [](double x) { return std::isfinite(x); }))
  {
    throw std::runtime_error(
      "SymmetryOrigin holds a number that is not finite. Give a point of the axis.");
  }
  const int flat = flatAxisOf(source);
  if (flat < 0)
  {
    throw std::runtime_error("Symmetry is Axisymmetric, but the input is 3-D: neither a plane "
                             "through the axis nor a wedge of "
                             "one cell. Set Symmetry to None, or take a plane (Slice) of it.");
  }
  if (source.image && !source.image->GetDirectionMatrix()->IsIdentity())
  {
    throw std::runtime_error(
      "Symmetry is Axisymmetric, but the image has axes of its own. Use an image "
      "along x, y and z.");
  }
  if (given == flat)
  {
    throw std::runtime_error("SymmetryAxis is " + std::string(1, "XYZ"[flat]) +
      ", which is across the plane of the data. Choose one of the two in it, or Auto.");
  }
  const vtkBoundingBox box = boundsOf(source);
  const double tolerance = axisTolerance * box.GetMaxLength();
  const int chosen = given >= 0 ? given : source.axisOfWedge;
  std::optional<Candidate> found;
  if (chosen >= 0)
  {
    const int radial = 3 - chosen - flat;
    const double from = origin[static_cast<std::size_t>(radial)];
    found = Candidate{ chosen, radial, box.GetBound(2 * radial) - from,
      box.GetBound(2 * radial + 1) - from };
  }
  else
  {
    const std::vector<Candidate> candidates = candidatesFor(box, flat, origin, tolerance);
    if (candidates.empty())
    {
      throw std::runtime_error(
        "Symmetry is Axisymmetric, but the plane of the data lies on both sides of each coordinate "
        "axis. "
        "Set SymmetryAxis to the axis, and SymmetryOrigin to a point of it.");
    }
    found = bestOf(candidates, source, origin, tolerance);
  }
  const bool isPositive = found->high > tolerance;
  Revolution revolution{ found->axis, found->radial, flat, origin, box.GetBound(2 * found->axis),
    box.GetBound(2 * found->axis + 1), isPositive ? found->high : -found->low,
    !isPositive || found->low >= -tolerance, "" };
  std::ostringstream text;
  text << std::setprecision(4) << "The data are revolved around the "
       << "xyz"[found->axis] << " axis (Symmetry)";
  if (origin[static_cast<std::size_t>(found->radial)] != 0)
  {
    text << " at "
         << "xyz"[found->radial] << " = " << origin[static_cast<std::size_t>(found->radial)];
  }
  text << ", up to a radius of " << revolution.radius << " data units.";
  if (chosen < 0)
  {
    text << " SymmetryAxis can set another one.";
  }
  if (!revolution.isMirrored)
  {
    text << " They lie on both sides of it; those on the positive side are used.";
  }
  revolution.note = text.str();
  return revolution;
}

Source mirrored(const Source& source, const Revolution& revolution)
{
  Source result = source;
  result.image = nullptr; // an ordinary leaf
  if (!revolution.isMirrored)
  {
    return result;
  }
  const double tolerance = axisTolerance * boundsOf(source).GetMaxLength();
  result.leaves.clear();
  for (const Leaf& leaf : source.leaves)
  {
    Remade made;
    auto* image = vtkImageData::SafeDownCast(leaf.data);
    if (image && leaf.ofCells)
    {
      result.leaves.push_back(leaf);
      made.data = turnedOver(image, revolution, made);
    }
    else
    {
      addBothSides(leaf, revolution, tolerance, made);
    }
    result.leaves.push_back(made.leafOf(leaf));
    result.made.emplace_back(made.data);
  }
  return result;
}

} // namespace filters
