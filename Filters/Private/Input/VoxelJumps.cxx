// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/VoxelJumps.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

/// Returns the grid's points along its axes; 0 of other data.
std::array<int, 3> pointsOf(vtkDataSet* data)
{
  std::array<int, 3> points{ 0, 0, 0 };
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    image->GetDimensions(points.data());
  }
  else if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    grid->GetDimensions(points.data());
  }
  return points;
}

/// Returns whether values change by more than `jump` along several axes: not those of a pane.
bool haveStairs(const Leaf& leaf, double jump)
{
  int axes = 0;
  vtkIdType stride = 1;
  for (const int points : pointsOf(leaf.data))
  {
    const int samples = std::max(leaf.ofCells ? points - 1 : points, 1);
    bool jumps = false;
    for (vtkIdType i = 0; i + stride < leaf.arrays[0]->GetNumberOfTuples() && !jumps; ++i)
    {
      const double step =
        leaf.arrays[0]->GetComponent(i + stride, 0) - leaf.arrays[0]->GetComponent(i, 0);
      jumps = i / stride % samples + 1 < samples && std::abs(step) > jump;
    }
    axes += jumps ? 1 : 0;
    stride *= samples;
  }
  return axes > 1;
}

} // namespace

double jumpOfVoxels(
  const std::vector<Leaf>& leaves, const Model& model, const std::array<double, 2>& range)
{
  const Linear* linear = std::get_if<Linear>(&model);
  const double size = range[1] - range[0], margin = 0.1 * size;
  constexpr double least = 0.05;
  if (!linear || !(std::abs(linear->scale) * size > least))
  {
    return 0;
  }
  for (const Leaf& leaf : leaves)
  {
    if (pointsOf(leaf.data)[0] == 0)
    {
      return 0;
    }
    for (vtkIdType i = 0; i < leaf.arrays[0]->GetNumberOfTuples(); ++i)
    {
      const double value = leaf.arrays[0]->GetComponent(i, 0);
      if (value > range[0] + margin && value < range[1] - margin)
      {
        return 0;
      }
    }
  }
  const bool areSome = std::any_of(
    leaves.begin(), leaves.end(), [size](const Leaf& leaf) { return haveStairs(leaf, size / 2); });
  return areSome ? std::abs(linear->scale) * size : 0;
}

} // namespace filters
