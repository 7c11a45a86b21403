// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/SamplingGrid.h"

#include "Common/CellTypes.h"
#include "Input/FlatData.h"
#include "Sources/PreparedLeaves.h"

#include "vtkBoundingBox.h"
#include "vtkCell.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace filters
{

namespace
{

// Grids that are chosen (see SamplingDimensions) are as fine along each axis as the size that a
// fraction of cells is below: the smallest fraction, from this one on, whose grid fits.
constexpr double fractionOfSmallerCells = 0.1;
constexpr double maxVoxelsPerPoint = 32;       // limits grids for a few tiny cells
constexpr double fewestVoxels = 64. * 64 * 64; // flat data: 64 * 64
constexpr vtkIdType maxCellsMeasured = 100000; // of a leaf, evenly spread
constexpr double maxPointsRequested = 2048. * 2048 * 2048;

/// Returns the number of segments of a cell's edges: 1, or more for cells of higher order.
int orderOf(vtkDataSet* data, vtkIdType cell)
{
  if (vtkCellTypeUtilities::IsLinear(static_cast<unsigned char>(data->GetCellType(cell))))
  {
    return 1;
  }
  vtkCell* curved = data->GetCell(cell);
  return curved->GetNumberOfEdges() > 0
    ? std::max(1, static_cast<int>(curved->GetEdge(0)->GetNumberOfPoints()) - 1)
    : 1;
}

/// Returns the sorted sizes of cells in a box along each axis; empty along an axis without sizes.
std::array<std::vector<double>, 3> sizesOfCells(
  const std::vector<vtkDataSet*>& leaves, int dimension, const SamplingBox& box)
{
  std::array<std::vector<double>, 3> sizes;
  for (vtkDataSet* leaf : leaves)
  {
    const vtkIdType cells = leaf->GetNumberOfCells();
    // Measures all cells of a given box, which may contain few of them.
    const vtkIdType each = box.isGiven() ? 1 : 1 + cells / maxCellsMeasured;
    for (vtkIdType i = 0; i < cells; i += each)
    {
      if (dimensionOfCell(leaf, i) == dimension)
      {
        double bounds[6];
        leaf->GetCellBounds(i, bounds);
        if (!box.meets(bounds))
        {
          continue;
        }
        const int order = orderOf(leaf, i);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double size = (bounds[2 * axis + 1] - bounds[2 * axis]) / order;
          if (size > 0 && std::isfinite(size))
          {
            sizes[axis].push_back(size);
          }
        }
      }
    }
  }
  for (std::vector<double>& ofAxis : sizes)
  {
    std::sort(ofAxis.begin(), ofAxis.end());
  }
  return sizes;
}

/// Returns the points along each axis for voxels of h cells, unless given.
std::array<int, 3> dimensionsFor(
  double h, const std::array<double, 3>& cells, const std::array<int, 3>& given)
{
  std::array<int, 3> dimensions = given;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (given[axis] == 0)
    {
      dimensions[axis] = static_cast<int>(std::clamp(std::round(cells[axis] / h) + 1, 2., 1e6));
    }
  }
  return dimensions;
}

double product(const std::array<int, 3>& dimensions)
{
  return static_cast<double>(dimensions[0]) * dimensions[1] * dimensions[2];
}

/// The fineness of a grid: cells along the data, and the edge of a voxel in cells.
struct Fineness
{
  std::array<double, 3> cells{};
  double edge = 1; // clamped to the limits; else a result of these, or of given axes
};

Fineness chooseFineness(const std::array<double, 3>& lengths,
  const std::array<std::vector<double>, 3>& sizes, double points, const std::array<int, 3>& given)
{
  Fineness choice;
  const auto voxels = [&](double edge)
  { return product(dimensionsFor(edge, choice.cells, given)); };
  const bool isFlat = std::find(given.begin(), given.end(), 1) != given.end();
  double least = isFlat ? std::pow(fewestVoxels, 2. / 3) : fewestVoxels;
  double most = std::clamp(maxVoxelsPerPoint * points, least, maxVoxels);
  for (double fraction = fractionOfSmallerCells; fraction < 1; fraction += 0.01)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& ofAxis = sizes[axis];
      if (!ofAxis.empty())
      {
        const auto place = static_cast<std::size_t>(fraction * static_cast<double>(ofAxis.size()));
        choice.cells[axis] = std::max(1., lengths[axis] / ofAxis[place]);
      }
    }
    if (voxels(1) <= most)
    {
      break;
    }
  }

  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (given[axis] > 1)
    {
      const double edge = choice.cells[axis] / (given[axis] - 1);
      choice.edge = least > 0 ? edge : std::min(choice.edge, edge);
      least = 0;
      most = maxVoxels;
    }
  }
  const double target = std::clamp(voxels(choice.edge), least, most);
  if (voxels(choice.edge) != target)
  {
    // Bisects for the smallest edge with at most the target number of voxels.
    double low = 1e-6, high = *std::max_element(choice.cells.begin(), choice.cells.end());
    for (int i = 0; i < 60; ++i)
    {
      const double middle = std::sqrt(low * high);
      (voxels(middle) > target ? low : high) = middle;
    }
    choice.edge = high;
  }
  return choice;
}

/// Returns a warning that too many cells are smaller than voxels, for the worst axis.
std::string fractionOfFinerCells(const std::array<int, 3>& dimensions,
  const std::array<double, 3>& lengths, const std::array<std::vector<double>, 3>& sizes)
{
  double worst = fractionOfSmallerCells + 0.05;
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& ofAxis = sizes[axis];
    const double spacing = lengths[axis] / std::max(1, dimensions[axis] - 1);
    const auto resolved = std::lower_bound(ofAxis.begin(), ofAxis.end(), 0.9 * spacing);
    const double fraction = static_cast<double>(resolved - ofAxis.begin()) /
      static_cast<double>(std::max<std::size_t>(1, ofAxis.size()));
    if (fraction > worst)
    {
      worst = fraction;
      text = "; to bound memory, " + std::to_string(std::lround(100 * fraction)) +
        " % of them are smaller along " + "xyz"[axis] + " (Sampling Dimensions can be set)";
    }
  }
  return text;
}

/// Makes `structure` the grid of the plan before it is extruded.
void setPoints(const Resampling& plan, vtkImageData* structure)
{
  const double* bounds = plan.bounds;
  double spacing[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    spacing[axis] =
      (bounds[2 * axis + 1] - bounds[2 * axis]) / std::max(1, plan.dimensions[axis] - 1);
  }
  structure->Initialize();
  structure->SetDimensions(plan.dimensions.data());
  structure->SetOrigin(bounds[0], bounds[2], bounds[4]);
  structure->SetSpacing(spacing);
}

} // namespace

std::array<int, 3> requireDimensions(const int samplingDimensions[3])
{
  std::array<int, 3> given;
  std::copy_n(samplingDimensions, 3, given.begin());
  for (const int count : given)
  {
    if (count < 0 || count == 1)
    {
      throw std::runtime_error("SamplingDimensions holds " + std::to_string(count) +
        ". Give each axis at least 2 points, or 0 to have their number chosen.");
    }
  }
  return given;
}

void requireFits(const std::array<int, 3>& dimensions)
{
  if (product(dimensions) > maxPointsRequested)
  {
    throw std::runtime_error("SamplingDimensions requests " + std::to_string(dimensions[0]) +
      " x " + std::to_string(dimensions[1]) + " x " + std::to_string(dimensions[2]) +
      " points, which is too many. Give fewer.");
  }
}

Resampling boxOf(const Source& source)
{
  Resampling plan;
  plan.flatAxis = flatAxisOf(source);
  plan.depth = plan.flatAxis < 0 ? 0 : depthOf(source, plan.flatAxis);
  plan.dimensions = { 2, 2, 2 };
  vtkBoundingBox box;
  for (const Leaf& leaf : source.leaves)
  {
    if (hasCells(leaf.data, plan.flatAxis < 0 ? 3 : 2))
    {
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  box.GetBounds(plan.bounds);
  return plan;
}

Resampling planResampling(
  const Source& source, const int samplingDimensions[3], const SamplingBox& box)
{
  Resampling plan = boxOf(source);
  const std::array<double, 6> bounds = box.within(plan.bounds);
  for (std::size_t n = 0; n < 6; ++n)
  {
    plan.bounds[n] = static_cast<int>(n / 2) == plan.flatAxis ? plan.bounds[n] : bounds[n];
  }
  const int dimension = plan.flatAxis < 0 ? 3 : 2;
  double points = 0;
  std::vector<vtkDataSet*> leaves;
  for (const Leaf& leaf : source.leaves)
  {
    if (hasCells(leaf.data, dimension))
    {
      leaves.push_back(leaf.data);
      points += static_cast<double>(leaf.data->GetNumberOfPoints());
    }
  }
  std::array<int, 3> given = requireDimensions(samplingDimensions);
  const std::array<std::vector<double>, 3> sizes = sizesOfCells(leaves, dimension, box);
  std::array<double, 3> lengths{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = plan.bounds[2 * axis + 1] - plan.bounds[2 * axis];
    if (static_cast<int>(axis) == plan.flatAxis)
    {
      given[axis] = 1;
    }
    else if (!(lengths[axis] > 0) || sizes[axis].empty() || !std::isfinite(lengths[axis]))
    {
      throw std::runtime_error(std::string("The input has no finite, positive length along ") +
        "xyz"[axis] + ", so there is no volume for light to cross. Check its points.");
    }
  }
  const Fineness fineness = chooseFineness(lengths, sizes, points, given);
  plan.dimensions = dimensionsFor(fineness.edge, fineness.cells, given);
  requireFits(plan.dimensions);
  if (std::find(given.begin(), given.end(), 0) == given.end())
  {
    plan.note = "as given";
  }
  else
  {
    plan.note =
      "chosen from the sizes of the cells" + fractionOfFinerCells(plan.dimensions, lengths, sizes);
  }
  return plan;
}

void gridOf(const Resampling& plan, vtkImageData* structure)
{
  setPoints(plan, structure);
  if (plan.flatAxis >= 0)
  {
    extrudeGrid(structure, plan.flatAxis, plan.depth);
  }
}

} // namespace filters
