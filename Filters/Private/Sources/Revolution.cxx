// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/Revolution.h"

#include "Input/FlatData.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace filters
{

namespace
{

/// Distance from the axis, relative to the plane's size, of points that count as on it.
constexpr double axisTolerance = 1e-6;

/// Properties of the data with respect to a candidate for the axis.
struct Candidate
{
  int axis, radial;
  double low, high;  // distances from it; negative on its other side
  double slope = 0;  // of the first array at the axis, relative to the mean: 0 for the right one
  double change = 0; // of the array along the radius

  double radius() const { return std::max(std::abs(this->low), std::abs(this->high)); }
  bool touches(double tolerance) const
  {
    return this->low <= tolerance && this->high >= -tolerance;
  }
};

/// Finds the slopes of the first array at the axis, by the nearest layers of cells.
void measure(const Flow& flow, const std::array<double, 3>& origin, Candidate& candidate)
{
  const auto radial = static_cast<std::size_t>(candidate.radial);
  double near = 0, nearLength = 0, all = 0, allLength = 0;
  vtkNew<vtkIdList> ids;
  for (const Leaf& leaf : flow.leaves)
  {
    const vtkIdType cells =
      leaf.ofCells ? 0 : leaf.data->GetNumberOfCells(); // withValuesAtPoints()
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      if (dimensionOfCell(leaf.data, cell) != 2)
      {
        continue;
      }
      double bounds[6], x[3];
      leaf.data->GetCellBounds(cell, bounds);
      leaf.data->GetCellPoints(cell, ids);
      const double low = bounds[2 * radial] - origin[radial],
                   high = bounds[2 * radial + 1] - origin[radial];
      double sums[2] = { 0, 0 };
      int counts[2] = { 0, 0 };
      for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      {
        leaf.data->GetPoint(ids->GetId(i), x);
        const int side = x[radial] - origin[radial] < 0.5 * (low + high) ? 0 : 1;
        sums[side] += leaf.arrays[0]->GetComponent(ids->GetId(i), 0);
        ++counts[side];
      }
      const double difference = std::abs(sums[1] / counts[1] - sums[0] / counts[0]);
      if (!(high > low) || !std::isfinite(difference))
      {
        continue;
      }
      all += difference;
      allLength += high - low;
      if (std::min(std::abs(low), std::abs(high)) < 0.5 * (high - low))
      {
        near += difference;
        nearLength += high - low;
      }
    }
  }
  candidate.slope = nearLength > 0 && all > 0 ? near / nearLength / (all / allLength) : 0;
  candidate.change = all;
}

/// Averages cell values at points, because slopes need neighbours.
Flow withValuesAtPoints(const Flow& flow)
{
  Flow result = flow;
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

Candidate bestOf(std::vector<Candidate> candidates, const Flow& flow,
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
  const Flow atPoints = withValuesAtPoints(flow);
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

Revolution revolutionOf(const Flow& flow)
{
  const MediumSettings& settings = flow.choice.settings;
  const int given = settings.SymmetryAxis - 1; // -1: not given
  const std::array<double, 3> origin = settings.symmetryOrigin();
  if (!std::all_of(origin.begin(), origin.end(), [](double x) { return std::isfinite(x); }))
  {
    throw std::runtime_error(
      "SymmetryOrigin holds a number that is not finite. Give a point of the axis.");
  }
  const int flat = flatAxisOf(flow);
  if (flat < 0)
  {
    throw std::runtime_error("Symmetry is Axisymmetric, but the input is 3-D: neither a plane "
                             "through the axis nor a wedge of "
                             "one cell. Set Symmetry to None, or take a plane (Slice) of it.");
  }
  if (flow.image && !flow.image->GetDirectionMatrix()->IsIdentity())
  {
    throw std::runtime_error("Symmetry is Axisymmetric, but the image has axes of its own. Use an "
                             "image along x, y and z.");
  }
  if (given == flat)
  {
    throw std::runtime_error("SymmetryAxis is " + std::string(1, "XYZ"[flat]) +
      ", which is across the plane of the data. Choose one of the two in it, or Auto.");
  }
  const vtkBoundingBox box = boundsOfPlanes(flow);
  const double tolerance = axisTolerance * box.GetMaxLength();
  const int chosen = given >= 0 ? given : flow.axisOfWedge;
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
        "axis. Set SymmetryAxis to the axis, and SymmetryOrigin to a point of it.");
    }
    found = bestOf(candidates, flow, origin, tolerance);
  }
  const bool isPositive = found->high > tolerance;
  Revolution revolution{ found->axis, found->radial, flat, origin, box.GetBound(2 * found->axis),
    box.GetBound(2 * found->axis + 1), isPositive ? found->high : -found->low, tolerance,
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

} // namespace filters
