// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityByResampling.h"

#include "RefractivityOutside.h"
#include "RefractivityValues.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkCellTypes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkResampleToImage.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace refractivity
{

namespace
{

// Limits of the grids that are chosen from the input (see SamplingDimensions). Between them, as many
// points as the mesh has: its cells are linear inside, and a finer grid would show their edges.
constexpr double fewestVoxels = 64. * 64 * 64;
constexpr double mostPointsAskedFor = 2048. * 2048 * 2048;

bool hasVolume(vtkDataSet* data, vtkIdType cell)
{
  const auto type = static_cast<unsigned char>(data->GetCellType(cell));
  return vtkCellTypes::GetDimension(type) == 3;
}

bool hasVolumeCells(vtkDataSet* data)
{
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    if (hasVolume(data, i))
    {
      return true;
    }
  }
  return false;
}

/// Points along each axis for voxels of edge h, where no number is given.
std::array<int, 3> dimensionsFor(
  double h, const std::array<double, 3>& lengths, const std::array<int, 3>& given)
{
  std::array<int, 3> dimensions = given;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (given[axis] == 0)
    {
      dimensions[axis] = static_cast<int>(std::clamp(std::round(lengths[axis] / h) + 1, 2., 1e6));
    }
  }
  return dimensions;
}

double product(const std::array<int, 3>& dimensions)
{
  return static_cast<double>(dimensions[0]) * dimensions[1] * dimensions[2];
}

std::array<int, 3> chooseDimensions(
  const std::array<double, 3>& lengths, double points, const std::array<int, 3>& given)
{
  double target = std::clamp(points, fewestVoxels, mostVoxels);
  double atLeast = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (given[axis] > 1)
    {
      atLeast = std::min(atLeast, lengths[axis] / (given[axis] - 1));
      target = mostVoxels;
    }
  }
  // The smallest edge that gives no more voxels than the target: their number falls with the edge.
  const double longest = std::max({ lengths[0], lengths[1], lengths[2] });
  double low = longest * 1e-6, high = longest;
  for (int i = 0; i < 60; ++i)
  {
    const double middle = std::sqrt(low * high);
    (product(dimensionsFor(middle, lengths, given)) > target ? low : high) = middle;
  }
  return dimensionsFor(std::isfinite(atLeast) ? std::max(high, atLeast) : high, lengths, given);
}

vtkSmartPointer<vtkDataSet> withoutArrays(vtkDataSet* data)
{
  auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  copy->CopyStructure(data);
  return copy;
}

/// The mean over the valid cells at each point, NaN where there are none: sums of value and of
/// validity, divided. Clears `valid` at cells whose value is not finite.
vtkSmartPointer<vtkDataArray> cellsToPoints(
  const Leaf& leaf, const Model& model, vtkUnsignedCharArray* valid, Tally& tally)
{
  vtkNew<vtkDoubleArray> share;
  auto cells = withoutArrays(leaf.data);
  cells->GetCellData()->AddArray(convert<vtkDoubleArray>(leaf.arrays, model, valid, 0, tally));
  share->DeepCopy(valid);
  cells->GetCellData()->AddArray(share);
  vtkNew<vtkCellDataToPointData> toPoints;
  toPoints->SetInputData(cells);
  toPoints->Update();
  vtkPointData* sums = toPoints->GetOutput()->GetPointData();
  vtkSmartPointer<vtkDataArray> means = sums->GetArray(arrayName);
  vtkDataArray* shares = sums->GetArray(maskName);
  for (vtkIdType i = 0; i < means->GetNumberOfTuples(); ++i)
  {
    means->SetComponent(i, 0, means->GetComponent(i, 0) / shares->GetComponent(i, 0));
  }
  return means;
}

/// A leaf that holds nothing but N at its points (NaN where invalid), its cells without volume hidden.
vtkSmartPointer<vtkDataSet> prepare(const Leaf& leaf, const Model& model, Tally& tally)
{
  vtkDataSet* data = leaf.data;
  const vtkIdType cells = data->GetNumberOfCells();
  auto valid = newMask(cells);
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  for (vtkIdType i = 0; i < cells; ++i)
  {
    if ((ghosts && (ghosts->GetValue(i) & hiddenCellBits)) || !hasVolume(data, i))
    {
      valid->SetValue(i, 0);
    }
  }

  auto prepared = withoutArrays(data);
  if (leaf.ofCells)
  {
    prepared->GetPointData()->SetScalars(cellsToPoints(leaf, model, valid, tally));
  }
  else
  {
    auto validPoints = newMask(data->GetNumberOfPoints());
    hidePoints(data, validPoints);
    prepared->GetPointData()->SetScalars(convert<vtkDoubleArray>(
      leaf.arrays, model, validPoints, std::numeric_limits<double>::quiet_NaN(), tally));
  }

  vtkNew<vtkUnsignedCharArray> hidden;
  hidden->SetName(vtkDataSetAttributes::GhostArrayName());
  hidden->SetNumberOfValues(cells);
  for (vtkIdType i = 0; i < cells; ++i)
  {
    hidden->SetValue(i, valid->GetValue(i) ? 0 : vtkDataSetAttributes::HIDDENCELL);
  }
  prepared->GetCellData()->AddArray(hidden);
  return prepared;
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
  if (product(dimensions) > mostPointsAskedFor)
  {
    throw std::runtime_error("SamplingDimensions asks for " + std::to_string(dimensions[0]) +
      " x " + std::to_string(dimensions[1]) + " x " + std::to_string(dimensions[2]) +
      " points, more than can be held. Give fewer.");
  }
}

Resampling planResampling(const Source& source, const int samplingDimensions[3])
{
  Resampling plan;
  vtkBoundingBox box;
  double points = 0;
  for (const Leaf& leaf : source.leaves)
  {
    if (hasVolumeCells(leaf.data))
    {
      plan.leaves.push_back(leaf);
      points += static_cast<double>(leaf.data->GetNumberOfPoints());
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  if (plan.leaves.empty())
  {
    throw std::runtime_error("The input has no 3-D cells with the " + source.label +
      ", so there is no volume for light to cross. Use volume data (for 2-D data: extrude it).");
  }
  box.GetBounds(plan.bounds);
  std::array<double, 3> lengths;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = plan.bounds[2 * axis + 1] - plan.bounds[2 * axis];
    if (!(lengths[axis] > 0) || !std::isfinite(lengths[axis]))
    {
      throw std::runtime_error(std::string("The input has no finite, positive length along ") +
        "xyz"[axis] + ", so there is no volume for light to cross. Check its points.");
    }
  }
  const std::array<int, 3> given = requireDimensions(samplingDimensions);
  plan.dimensions = chooseDimensions(lengths, points, given);
  requireFits(plan.dimensions);
  return plan;
}

void gridOf(const Resampling& plan, vtkImageData* structure)
{
  const double* bounds = plan.bounds;
  structure->Initialize();
  structure->SetDimensions(plan.dimensions.data());
  structure->SetOrigin(bounds[0], bounds[2], bounds[4]);
  structure->SetSpacing((bounds[1] - bounds[0]) / (plan.dimensions[0] - 1),
    (bounds[3] - bounds[2]) / (plan.dimensions[1] - 1),
    (bounds[5] - bounds[4]) / (plan.dimensions[2] - 1));
}

Tally resample(const Resampling& plan, const Source& source, bool doublePrecision,
  bool outsideBlocksLight, vtkImageData* output)
{
  Tally tally;
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (std::size_t i = 0; i < plan.leaves.size(); ++i)
  {
    blocks->SetBlock(static_cast<unsigned int>(i), prepare(plan.leaves[i], source.model, tally));
  }
  vtkNew<vtkResampleToImage> resampler;
  resampler->SetInputDataObject(blocks);
  resampler->SetSamplingDimensions(plan.dimensions[0], plan.dimensions[1], plan.dimensions[2]);
  resampler->Update();

  vtkImageData* sampled = resampler->GetOutput();
  vtkDataArray* values = sampled->GetPointData()->GetArray(arrayName);
  if (!values)
  {
    throw std::runtime_error(
      "Resampling the " + source.label + " to a grid found no data. Check the input's cells.");
  }
  output->CopyStructure(sampled);
  auto valid = newMask(output->GetNumberOfPoints());
  hidePoints(sampled, valid);
  const auto outside = outsideBlocksLight ? nullptr : outsideOf(blocks, output, valid);
  setArrays(output, { values }, Linear(), valid, doublePrecision);
  if (outside)
  {
    setOutside(outside, output);
  }
  return tally;
}

} // namespace refractivity
