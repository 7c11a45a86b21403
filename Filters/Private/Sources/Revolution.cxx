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
  double low, high;     // distances from it; negative on its other side
  double length;        // along it
  double slope = 0;     // of the first array at the axis, relative to that in the next cells
  double change = 0;    // of the array along the radius
  double variation = 0; // of the array in the cells at the axis, relative to that in all

  double radius() const { return std::max(std::abs(this->low), std::abs(this->high)); }
  bool touches(double tolerance) const
  {
    return this->low <= tolerance && this->high >= -tolerance;
  }
};

/// Finds the slopes of the first array at the axis, by the nearest cells and those within three
/// times their height: of a field that is even about the axis they are as 1 to 4, else about equal.
void measure(const Flow& flow, const std::array<double, 3>& origin, Candidate& candidate)
{
  const auto radial = static_cast<std::size_t>(candidate.radial);
  double near = 0, nearLength = 0, next = 0, nextLength = 0, all = 0;
  vtkBoundingBox nearRange, range; // of values
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
      vtkBoundingBox own;
      for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      {
        leaf.data->GetPoint(ids->GetId(i), x);
        const int side = x[radial] - origin[radial] < 0.5 * (low + high) ? 0 : 1;
        const double value = leaf.arrays[0]->GetComponent(ids->GetId(i), 0);
        sums[side] += value;
        ++counts[side];
        own.AddPoint(value, 0, 0);
      }
      const double difference = std::abs(sums[1] / counts[1] - sums[0] / counts[0]);
      if (!(high > low) || !std::isfinite(difference))
      {
        continue;
      }
      all += difference;
      range.AddBox(own);
      const double from = std::min(std::abs(low), std::abs(high));
      if (from >= 0.5 * (high - low) && from < 3 * (high - low))
      {
        next += difference;
        nextLength += high - low;
      }
      if (from < 0.5 * (high - low))
      {
        near += difference;
        nearLength += high - low;
        nearRange.AddBox(own);
      }
    }
  }
  candidate.slope = next > 0 && nearLength > 0 ? near / nearLength / (next / nextLength) : 1;
  candidate.change = all;
  candidate.variation =
    all > 0 && nearRange.IsValid() ? nearRange.GetLength(0) / range.GetLength(0) : 0;
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
      box.GetBound(2 * radial + 1) - from, box.GetLength(axis) };
    const bool isOnOneSide = candidate.low >= -tolerance || candidate.high <= tolerance;
    if (isOnOneSide ||
      std::abs(candidate.low + candidate.high) <= centred * (candidate.high - candidate.low))
    {
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

/// The best axis, and another one that may be meant; -1: none.
struct Best
{
  Candidate candidate;
  int other;
};

Best bestOf(std::vector<Candidate> candidates, const Flow& flow,
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
    return { candidates.at(0), -1 };
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
      return { candidates[1 - one], -1 };
    }
  }
  // Of uniform gas at an axis, a slope of 0 says nothing.
  constexpr double smooth = 0.5; // slopes at the axis that count as none
  const auto isKnown = [=](const Candidate& one)
  { return one.variation >= little && one.slope < smooth; };
  if (isKnown(candidates[0]) != isKnown(candidates[1]))
  {
    return { candidates[isKnown(candidates[0]) ? 0 : 1], -1 };
  }
  const std::size_t longer = candidates[0].length >= candidates[1].length ? 0 : 1;
  return { candidates[longer], candidates[1 - longer].axis };
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
  const int given = settings.isAxisymmetric() ? settings.SymmetryAxis - 1 : -1; // -1: not given
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
  int other = -1;
  if (chosen >= 0)
  {
    const int radial = 3 - chosen - flat;
    const double from = origin[static_cast<std::size_t>(radial)];
    found = Candidate{ chosen, radial, box.GetBound(2 * radial) - from,
      box.GetBound(2 * radial + 1) - from, box.GetLength(chosen) };
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
    const Best best = bestOf(candidates, flow, origin, tolerance);
    found = best.candidate;
    other = best.other;
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
  if (other >= 0)
  {
    text << " It is not clear from the field whether they should be revolved around the "
         << "xyz"[other] << " axis instead: their side along the "
         << "xyz"[found->axis] << " axis is the longer one. Set SymmetryAxis.";
  }
  else if (chosen < 0)
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
