// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldTints.h"

#include "AvailableMemory.h"
#include "FieldFromImage.h"
#include "GridOfSource.h"
#include "RefractivityModels.h"
#include "RefractivitySource.h"
#include "RefractivityValues.h"

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
#include "vtkRefractiveIndex.h"
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

using filters::arrayName;
using filters::maskName;

void requireFields(vtkRefractiveIndex* medium)
{
  if (medium->GetFields().empty())
  {
    throw std::runtime_error(
      "ColorByField is on, but Fields is empty, so no field gives its colour. "
      "Name arrays in Fields, or switch ColorByField off.");
  }
  filters::fieldMeanFrom(medium); // whether its lists belong together
}

/// Makes of a filter one that finds a single field, between 0 and 1, as if it were a refractivity. `ranges`: see
/// forFieldImages().
void chooseField(vtkRefractiveIndex* reader, vtkRefractiveIndex* medium, std::size_t field,
  const std::vector<FieldMean::Range>& ranges)
{
  reader->SetIndexModel(vtkRefractiveIndex::TRANSFER_FUNCTIONS);
  reader->SetRefractivityScale(1);
  reader->SetDepth(medium->GetDepth());
  reader->SetSymmetry(medium->GetSymmetry());
  reader->SetSymmetryAxis(medium->GetSymmetryAxis());
  reader->SetSymmetryOrigin(medium->GetSymmetryOrigin());
  reader->AddField(medium->GetFields()[field].c_str());
  if (medium->GetIndexModel() == vtkRefractiveIndex::TRANSFER_FUNCTIONS &&
    !medium->GetTransferFunctions().empty())
  {
    reader->AddTransferFunction(medium->GetTransferFunctions()[field]);
  }
  if (!medium->GetFieldRanges().empty())
  {
    reader->AddFieldRange(medium->GetFieldRanges()[2 * field]);
    reader->AddFieldRange(medium->GetFieldRanges()[2 * field + 1]);
  }
  else if (!ranges.empty() && ranges[field][0] < ranges[field][1])
  {
    reader->AddFieldRange(ranges[field][0]);
    reader->AddFieldRange(ranges[field][1]);
  }
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

/// The values and the mask of `image`, interpolated linearly where `grid` has its points.
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

/// Whether `input` is an image whose grid is kept.
bool keepsOwnGrid(vtkRefractiveIndex* medium, vtkDataObject* input)
{
  return medium->GetSymmetry() == vtkRefractiveIndex::NO_SYMMETRY &&
    chooseSource(medium, input).image != nullptr;
}

/// forFieldImages() of other data. Nothing where it is aborted.
void forSampledFields(vtkRefractiveIndex* medium, vtkDataObject* input, vtkImageData* refractivity,
  int threads, const std::function<void(std::size_t, vtkImageData*)>& take)
{
  std::string reportedBefore;
  const auto source =
    medium->MakeSourceOfCells(input, nullptr, reportedBefore, vtkRefractiveIndex::WITH_FIELDS);
  if (!source)
  {
    return;
  }
  std::vector<float> all;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
    [&] { all = fieldsAtGrid(*source, WorkProgress(), refractivity); });
  const vtkIdType points = refractivity->GetNumberOfPoints();
  for (int field = 0; field < source->fields(); ++field)
  {
    vtkNew<vtkFloatArray> values;
    values->SetName(arrayName);
    setTuples(values, points);
    std::copy_n(all.begin() + field * points, points, values->GetPointer(0));
    const auto valid = newMask(points);
    for (vtkIdType point = 0; point < points; ++point)
    {
      if (!std::isfinite(values->GetValue(point)))
      {
        values->SetValue(point, 0);
        valid->SetValue(point, 0);
      }
    }
    vtkNew<vtkImageData> image;
    image->CopyStructure(refractivity);
    image->GetPointData()->AddArray(values);
    image->GetPointData()->AddArray(valid);
    take(static_cast<std::size_t>(field), image);
  }
}

} // namespace

std::vector<RangeOfField> rangesOfFields(vtkRefractiveIndex* medium, vtkDataObject* input)
{
  requireFields(medium);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const RangeOfField none{ { infinity, -infinity }, "" };
  std::vector<RangeOfField> ranges(medium->GetFields().size(), none);
  for (std::size_t number = 0; number < ranges.size(); ++number)
  {
    vtkNew<vtkRefractiveIndex> reader;
    chooseField(reader, medium, number, {});
    try
    {
      const Source source = chooseSource(reader, input);
      ranges[number].range = std::get<FieldMean>(source.model).rangesIn(source.leaves).at(0);
    }
    catch (const ArraysMissing& problem)
    {
      ranges[number].lacks = problem.what();
    }
  }
  return ranges;
}

std::vector<FieldValues> fieldValues(vtkRefractiveIndex* medium, vtkDataObject* input,
  const filters::Source& ofMedium, const std::vector<FieldMean::Range>& ranges)
{
  requireFields(medium);
  std::vector<FieldValues> fields(medium->GetFields().size());
  for (std::size_t number = 0; number < fields.size(); ++number)
  {
    vtkNew<vtkRefractiveIndex> reader;
    chooseField(reader, medium, number, ranges);
    FieldValues& field = fields[number];
    try
    {
      field.source = filters::chooseSource(reader, input, &ofMedium);
      if (ranges.empty())
      {
        std::get<filters::FieldMean>(field.source.model).findRanges(field.source.leaves);
      }
    }
    catch (const ArraysMissing&)
    {
      if (ranges.empty())
      {
        throw;
      }
      field.source.model = modelFrom(reader); // another part has it
    }
    if (!ranges.empty())
    {
      std::get<FieldMean>(field.source.model).setRanges({ ranges[number] });
    }
    const std::vector<filters::Leaf> found = std::move(field.source.leaves);
    field.source.leaves.clear();
    for (const filters::Leaf& leaf : ofMedium.leaves)
    {
      const auto same = std::find_if(found.begin(), found.end(),
        [&](const filters::Leaf& other) { return other.input == leaf.input; });
      if (same != found.end())
      {
        field.source.leaves.push_back({ leaf.data, same->arrays, same->ofCells, leaf.input });
        continue;
      }
      auto nowhere = vtkSmartPointer<vtkDoubleArray>::New();
      setTuples(
        nowhere, leaf.ofCells ? leaf.data->GetNumberOfCells() : leaf.data->GetNumberOfPoints());
      nowhere->FillValue(std::numeric_limits<double>::quiet_NaN());
      field.source.leaves.push_back({ leaf.data, { nowhere }, leaf.ofCells, leaf.input });
      field.made.push_back(nowhere);
    }
  }
  return fields;
}

void bringToCells(FieldValues& field)
{
  for (filters::Leaf& leaf : field.source.leaves)
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

void forFieldImages(vtkRefractiveIndex* medium, vtkDataObject* input, vtkImageData* refractivity,
  int threads, const std::function<void(std::size_t, vtkImageData*)>& take,
  const std::vector<FieldMean::Range>& ranges)
{
  requireFields(medium);
  const schlieren::Grid grid = gridFrom(refractivity);
  const std::size_t count = medium->GetFields().size();
  if (!keepsOwnGrid(medium, input))
  {
    forSampledFields(medium, input, refractivity, threads, take);
    return;
  }
  for (std::size_t field = 0; field < count; ++field)
  {
    vtkNew<vtkRefractiveIndex> reader;
    chooseField(reader, medium, field, ranges);
    reader->SetSamplingBounds(medium->GetSamplingBounds());
    reader->SetNumberOfThreads(threads);
    vtkNew<vtkImageData> values;
    reader->Convert(input, values);
    if (!isSameGrid(grid, gridFrom(values)))
    {
      probe(values, refractivity);
    }
    take(field, values);
  }
}

std::vector<float> fieldGradients(
  vtkRefractiveIndex* medium, vtkDataObject* input, vtkImageData* refractivity, int threads)
{
  const schlieren::Grid grid = gridFrom(refractivity);
  const std::size_t count = medium->GetFields().size();
  const auto points = static_cast<std::size_t>(refractivity->GetNumberOfPoints());
  // And of one field at a time: numbers of an array, the field's own, and a mask; or of all of them.
  constexpr std::size_t bytesOfField = sizeof(double) + sizeof(float) + 1;
  requireMemory(static_cast<double>(points * (2 * count * sizeof(float) + bytesOfField)),
    "The fields that color the image, on a grid of " + std::to_string(points) + " points,",
    "Give fewer Fields or smaller SamplingDimensions.");
  std::vector<float> gradients(count * points, 0);
  forFieldImages(medium, input, refractivity, threads,
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
