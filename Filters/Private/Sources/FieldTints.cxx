// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/FieldTints.h"

#include "Common/AvailableMemory.h"
#include "Common/FieldFromImage.h"
#include "Gas/RefractivityModels.h"
#include "Input/FlatData.h"
#include "Input/Flow.h"
#include "Input/RefractivityOfImage.h"
#include "Input/RefractivityValues.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPointDataToCellData.h"
#include "vtkProbeFilter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace filters
{

namespace
{

void requireFields(const MediumSettings& medium)
{
  if (medium.Fields.empty())
  {
    throw std::runtime_error(
      "ColorByField is on, but Fields is empty, so no field gives its colour. "
      "Name arrays in Fields, or switch ColorByField off.");
  }
  fieldMeanFrom(medium); // throws for lists of different lengths
}

/// Returns settings of a field, 0 to 1, as a refractivity. `ranges`: see forFieldImages().
MediumSettings settingsOfField(
  const MediumSettings& medium, std::size_t field, const std::vector<FieldMean::Range>& ranges)
{
  MediumSettings settings;
  settings.IndexModel = MediumSettings::TRANSFER_FUNCTIONS;
  settings.RefractivityScale = 1;
  settings.Depth = medium.Depth;
  settings.Symmetry = medium.Symmetry;
  settings.SymmetryAxis = medium.SymmetryAxis;
  std::copy_n(medium.SymmetryOrigin, 3, settings.SymmetryOrigin);
  settings.Fields = { medium.Fields[field] };
  if (medium.IndexModel == MediumSettings::TRANSFER_FUNCTIONS && !medium.TransferFunctions.empty())
  {
    settings.TransferFunctions = { medium.TransferFunctions[field] };
  }
  if (!medium.FieldRanges.empty())
  {
    settings.FieldRanges = { medium.FieldRanges[2 * field], medium.FieldRanges[2 * field + 1] };
  }
  else if (!ranges.empty() && ranges[field][0] < ranges[field][1])
  {
    settings.FieldRanges = { ranges[field][0], ranges[field][1] };
  }
  return settings;
}

/// Returns the flow of a single field.
Flow flowOfField(const MediumSettings& settings, vtkDataObject* input, const Flow* like = nullptr)
{
  KnownArrays nothingIsOpen;
  return chooseFlow(settings, nothingIsOpen, input, like);
}

bool isSameGrid(const schlieren::Grid& a, const schlieren::Grid& b)
{
  bool isSame = a.dimensions == b.dimensions && a.direction == b.direction;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double tolerance = 1e-3 * a.spacing[axis];
    isSame = isSame && std::abs(a.origin[axis] - b.origin[axis]) < tolerance &&
      std::abs(a.spacing[axis] - b.spacing[axis]) * static_cast<double>(a.dimensions[axis]) <
        tolerance;
  }
  return isSame;
}

/// Interpolates values and mask of `image` linearly at the points of `grid`.
void probe(vtkImageData* image, vtkImageData* grid)
{
  vtkNew<vtkImageData> points;
  points->CopyStructure(grid);
  vtkNew<vtkProbeFilter> prober;
  prober->SetInputData(points);
  prober->SetSourceData(image);
  prober->SetValidPointMaskArrayName("probed");
  prober->Update();
  vtkPointData* found = prober->GetOutput()->GetPointData();
  vtkDataArray* inside = found->GetArray("probed");
  auto* valid = vtkUnsignedCharArray::SafeDownCast(found->GetArray(maskName));
  if (!inside || !valid)
  {
    throw std::runtime_error("A field could not be brought to the grid of the refractivity. Check "
                             "that the arrays of Fields and of the index model overlap.");
  }
  for (vtkIdType i = 0; i < inside->GetNumberOfTuples(); ++i)
  {
    valid->SetValue(i, inside->GetComponent(i, 0) != 0 ? valid->GetValue(i) : 0);
  }
  image->ShallowCopy(prober->GetOutput());
}

} // namespace

std::vector<RangeOfField> rangesOfFields(const MediumSettings& medium, vtkDataObject* input)
{
  requireFields(medium);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const RangeOfField none{ { infinity, -infinity }, "" };
  std::vector<RangeOfField> ranges(medium.Fields.size(), none);
  for (std::size_t number = 0; number < ranges.size(); ++number)
  {
    try
    {
      const Flow flow = flowOfField(settingsOfField(medium, number, {}), input);
      ranges[number].range = std::get<FieldMean>(flow.model).rangesIn(flow.leaves).at(0);
    }
    catch (const ArraysMissing& problem)
    {
      ranges[number].lacks = problem.what();
    }
  }
  return ranges;
}

std::vector<Flow> fieldFlows(const MediumSettings& medium, vtkDataObject* input,
  const Flow& ofMedium, const std::vector<FieldMean::Range>& ranges)
{
  requireFields(medium);
  std::vector<Flow> fields(medium.Fields.size());
  for (std::size_t number = 0; number < fields.size(); ++number)
  {
    const MediumSettings settings = settingsOfField(medium, number, ranges);
    Flow& field = fields[number];
    try
    {
      field = flowOfField(settings, input, &ofMedium);
      if (ranges.empty())
      {
        std::get<FieldMean>(field.model).findRanges(field.leaves);
      }
    }
    catch (const ArraysMissing&)
    {
      if (ranges.empty())
      {
        throw;
      }
      field.model = modelFrom(settings); // a block of another rank has it
    }
    if (!ranges.empty())
    {
      std::get<FieldMean>(field.model).setRanges({ ranges[number] });
    }
    const std::vector<Leaf> found = std::move(field.leaves);
    field.leaves.clear();
    for (const Leaf& leaf : ofMedium.leaves)
    {
      const auto same = std::find_if(
        found.begin(), found.end(), [&](const Leaf& other) { return other.input == leaf.input; });
      if (same != found.end())
      {
        field.leaves.push_back({ leaf.data, same->arrays, same->ofCells, leaf.input });
        continue;
      }
      auto nowhere = vtkSmartPointer<vtkDoubleArray>::New();
      setTuples(
        nowhere, leaf.ofCells ? leaf.data->GetNumberOfCells() : leaf.data->GetNumberOfPoints());
      nowhere->FillValue(std::numeric_limits<double>::quiet_NaN());
      field.leaves.push_back({ leaf.data, { nowhere }, leaf.ofCells, leaf.input });
      field.made.push_back(nowhere);
    }
  }
  return fields;
}

void bringToCells(Flow& field)
{
  for (Leaf& leaf : field.leaves)
  {
    if (leaf.ofCells)
    {
      continue;
    }
    auto copy = vtkSmartPointer<vtkDataSet>::Take(leaf.data->NewInstance());
    copy->CopyStructure(leaf.data);
    copy->GetPointData()->SetScalars(leaf.arrays[0]);
    vtkNew<vtkPointDataToCellData> toCells;
    toCells->SetInputData(copy);
    toCells->Update();
    vtkSmartPointer<vtkDataArray> means = toCells->GetOutput()->GetCellData()->GetScalars();
    leaf.arrays = { means };
    leaf.ofCells = true;
    field.made.push_back(means);
  }
}

void forFieldImages(const MediumSettings& medium, vtkDataObject* input, vtkImageData* refractivity,
  const std::function<void(std::size_t, vtkImageData*)>& take,
  const std::vector<FieldMean::Range>& ranges)
{
  requireFields(medium);
  const schlieren::Grid grid = gridFrom(refractivity);
  for (std::size_t number = 0; number < medium.Fields.size(); ++number)
  {
    Flow field = flowOfField(settingsOfField(medium, number, ranges), input);
    std::get<FieldMean>(field.model).findRanges(field.leaves);
    if (const int flat = flatAxisOf(field); flat >= 0)
    {
      field.depth = refractivity->GetSpacing()[flat]; // between its two layers
    }
    vtkNew<vtkImageData> values;
    convertImage(field, Numbers::Singles, values);
    if (!isSameGrid(grid, gridFrom(values)))
    {
      probe(values, refractivity);
    }
    take(number, values);
  }
}

std::vector<float> fieldGradients(
  const MediumSettings& medium, vtkDataObject* input, vtkImageData* refractivity, int threads)
{
  const schlieren::Grid grid = gridFrom(refractivity);
  const std::size_t count = medium.Fields.size();
  const auto points = static_cast<std::size_t>(refractivity->GetNumberOfPoints());
  // Counts, for a field at a time, an array's values, the field's and a mask; or all results.
  constexpr std::size_t bytesOfField = sizeof(double) + sizeof(float) + 1;
  requireMemory(static_cast<double>(points * (2 * count * sizeof(float) + bytesOfField)),
    "The fields that color the image, on a grid of " + std::to_string(points) + " points,",
    "Give fewer Fields or a coarser input.");
  std::vector<float> gradients(count * points, 0);
  forFieldImages(medium, input, refractivity,
    [&](std::size_t field, vtkImageData* values)
    {
      schlieren::gradientMagnitudes(grid,
        vtkFloatArray::SafeDownCast(values->GetPointData()->GetArray(arrayName))->GetPointer(0),
        vtkUnsignedCharArray::SafeDownCast(values->GetPointData()->GetArray(maskName))
          ->GetPointer(0),
        threads, static_cast<int>(count), static_cast<int>(field), gradients.data());
    });
  return gradients;
}

std::vector<std::array<float, 3>> fieldColors(const std::vector<double>& values, std::size_t fields)
{
  if (!values.empty() && values.size() != 3 * fields)
  {
    throw std::runtime_error("FieldColors holds " + std::to_string(values.size()) + " values for " +
      std::to_string(fields) +
      " fields. Give red, green and blue of each, or none for colours that are chosen.");
  }
  std::vector<std::array<float, 3>> colors(fields);
  for (std::size_t field = 0; field < fields; ++field)
  {
    constexpr double goldenSection = 0.61803398874989485;
    const double turns = static_cast<double>(field) * goldenSection;
    double color[3];
    vtkMath::HSVToRGB(turns - std::floor(turns), 1, 1, color, color + 1, color + 2);
    const double* chosen = values.empty() ? color : values.data() + 3 * field;
    std::transform(chosen, chosen + 3, colors[field].begin(),
      [](double value) { return static_cast<float>(value); });
  }
  return colors;
}

} // namespace filters
