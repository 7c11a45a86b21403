// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractiveIndex.h"

#include "vtkArrayDispatch.h"
#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkCellTypes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArrayRange.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkResampleToImage.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkRefractiveIndex);

namespace
{

constexpr const char* refractivityName = "Refractivity";
constexpr const char* maskName = "vtkValidPointMask"; // as vtkResampleToImage calls it

constexpr unsigned char hiddenCellBits =
  vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

// Limits of the grids that are chosen from the input (see SamplingDimensions).
constexpr double voxelsPerCell =
  8; // or per point: a tetrahedral mesh has five cells for each point
constexpr double fewestVoxels = 64. * 64 * 64;
constexpr double mostVoxels = 256. * 256 * 256;
constexpr double mostPointsAskedFor = 2048. * 2048 * 2048;

/// N as a linear function of what the array holds.
struct Model
{
  double scale;
  double offset;
};

/// What the user chose for one array.
struct Selection
{
  std::string name;   // empty: by attribute, or not chosen
  int attribute = -1; // vtkDataSetAttributes::AttributeTypes
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
};

/// An array that was found for a Selection.
struct Found
{
  vtkDataArray* array = nullptr;
  bool ofCells = false;
};

Selection selectionFrom(vtkInformation* info)
{
  Selection selection;
  if (info->Has(vtkDataObject::FIELD_NAME()))
  {
    const char* name = info->Get(vtkDataObject::FIELD_NAME());
    selection.name = name ? name : "";
  }
  else if (info->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    selection.attribute = info->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  if (info->Has(vtkDataObject::FIELD_ASSOCIATION()))
  {
    selection.association = info->Get(vtkDataObject::FIELD_ASSOCIATION());
  }
  return selection;
}

bool isChosen(const Selection& selection)
{
  return !selection.name.empty() || selection.attribute >= 0;
}

vtkDataArray* findIn(vtkDataSetAttributes* data, const Selection& selection)
{
  if (!selection.name.empty())
  {
    return data->GetArray(selection.name.c_str());
  }
  return selection.attribute >= 0
    ? vtkArrayDownCast<vtkDataArray>(data->GetAbstractAttribute(selection.attribute))
    : nullptr;
}

/// Looks at the association that was asked for first, then at the other one.
Found find(vtkDataSet* data, const Selection& selection)
{
  const bool cellsFirst = selection.association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  for (const bool ofCells : { cellsFirst, !cellsFirst })
  {
    vtkDataSetAttributes* attributes = data->GetPointData();
    if (ofCells)
    {
      attributes = data->GetCellData();
    }
    if (vtkDataArray* array = findIn(attributes, selection))
    {
      return { array, ofCells };
    }
  }
  return {};
}

/// The datasets within the input that have points.
std::vector<vtkDataSet*> leavesOf(vtkDataObject* input)
{
  std::vector<vtkDataSet*> leaves;
  const auto add = [&leaves](vtkDataObject* object)
  {
    vtkDataSet* leaf = vtkDataSet::SafeDownCast(object);
    if (leaf && leaf->GetNumberOfPoints() > 0)
    {
      leaves.push_back(leaf);
    }
  };
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(iterator->GetCurrentDataObject());
    }
  }
  else
  {
    add(input);
  }
  return leaves;
}

/// "point arrays p, rho; cell arrays T", or "none".
std::string namesOfArrays(const std::vector<vtkDataSet*>& leaves)
{
  std::string text;
  for (const bool ofCells : { false, true })
  {
    std::vector<std::string> names;
    for (vtkDataSet* leaf : leaves)
    {
      vtkFieldData* data = leaf->GetPointData();
      if (ofCells)
      {
        data = leaf->GetCellData();
      }
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        const char* name = data->GetArray(i) ? data->GetArrayName(i) : nullptr;
        if (name && data->GetArray(i)->GetNumberOfComponents() == 1 &&
          name != std::string(vtkDataSetAttributes::GhostArrayName()) &&
          name != std::string(maskName))
        {
          names.emplace_back(name);
        }
      }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const char* kind = ofCells ? "cell arrays " : "point arrays ";
      text += i > 0 ? ", " : (text.empty() ? "" : "; ") + std::string(kind);
      text += names[i];
    }
  }
  return text.empty() ? "none" : text;
}

/// What to read from an input: decided once per input.
struct Source
{
  std::vector<vtkDataSet*> leaves;
  vtkImageData* image = nullptr; // the only leaf, where it keeps its own grid
  Selection selection;
  Model model{ 1, 0 };
  std::string label; // for messages
};

void requireFinite(const char* name, double value)
{
  if (!std::isfinite(value))
  {
    throw std::runtime_error(std::string(name) + " is not a finite number. Set it to one.");
  }
}

Source chooseSource(vtkRefractiveIndex* self, vtkDataObject* input)
{
  Source source;
  source.leaves = leavesOf(input);
  if (source.leaves.empty())
  {
    throw std::runtime_error(
      "The input is empty: it has no points. Check that its source was read or "
      "updated and that no filter has removed everything.");
  }
  if (source.leaves.size() == 1)
  {
    source.image = vtkImageData::SafeDownCast(source.leaves[0]);
  }

  const bool fromDensity = self->GetIndexModel() == vtkRefractiveIndex::GLADSTONE_DALE;
  const char* property = fromDensity ? "Density" : "IndexArray";
  source.selection = selectionFrom(self->GetInputArrayInformation(
    fromDensity ? vtkRefractiveIndex::DENSITY : vtkRefractiveIndex::INDEX_ARRAY));
  const auto isRefractivity = [](const Found& found)
  { return !found.ofCells && found.array->GetName() == std::string(refractivityName); };
  Found first;
  for (std::size_t i = 0; i < source.leaves.size() && !first.array; ++i)
  {
    first = find(source.leaves[i], source.selection);
  }

  // A refractivity that was computed before is used as it stands.
  if (source.image && self->GetIndexModel() != vtkRefractiveIndex::REFRACTIVE_INDEX &&
    source.image->GetPointData()->GetArray(refractivityName) &&
    (!first.array || isRefractivity(first)))
  {
    source.selection = Selection();
    source.selection.name = refractivityName;
    source.label = refractivityName;
    return source;
  }

  if (!first.array)
  {
    const std::string names = namesOfArrays(source.leaves);
    if (names == "none")
    {
      throw std::runtime_error(
        std::string("The input has no arrays with one component, so there is "
                    "nothing to take ") +
        property + " from. Choose an input that has the field.");
    }
    if (!isChosen(source.selection))
    {
      throw std::runtime_error(
        std::string("No array is chosen for ") + property + ". Choose one of: " + names + ".");
    }
    throw std::runtime_error("The input has no array '" + source.selection.name + "'. Set " +
      property + " to one of: " + names + ".");
  }

  for (vtkDataSet* leaf : source.leaves)
  {
    const Found found = find(leaf, source.selection);
    if (!found.array)
    {
      continue;
    }
    source.label = found.array->GetName() ? found.array->GetName() : property;
    if (found.array->GetNumberOfComponents() != 1)
    {
      throw std::runtime_error("The array '" + source.label + "' has " +
        std::to_string(found.array->GetNumberOfComponents()) + " components, but " + property +
        " is a scalar. Choose one of: " + namesOfArrays(source.leaves) + ".");
    }
    if (found.array->GetNumberOfTuples() !=
      (found.ofCells ? leaf->GetNumberOfCells() : leaf->GetNumberOfPoints()))
    {
      throw std::runtime_error("The array '" + source.label + "' has " +
        std::to_string(found.array->GetNumberOfTuples()) +
        " values, which is not one for each point or cell. Check the program that wrote it.");
    }
  }

  switch (self->GetIndexModel())
  {
    case vtkRefractiveIndex::GLADSTONE_DALE:
      requireFinite("GladstoneDaleConstant", self->GetGladstoneDaleConstant());
      requireFinite("DensityScale", self->GetDensityScale());
      source.model.scale = self->GetGladstoneDaleConstant() * self->GetDensityScale();
      break;
    case vtkRefractiveIndex::REFRACTIVE_INDEX:
      source.model.offset = -1;
      break;
    default:
      break;
  }
  return source;
}

/// Writes N to `out` and clears `valid` where it is not finite; N is `invalid` where `valid` is 0.
template <class Real>
struct Conversion
{
  Model model;
  Real* out;
  unsigned char* valid;
  Real invalid;

  template <class Array>
  void operator()(Array* array) const
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    vtkSMPTools::For(0, array->GetNumberOfTuples(),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const double value = static_cast<double>(values[i]);
          const Real n = static_cast<Real>(this->model.scale * value + this->model.offset);
          const bool isValid = this->valid[i] != 0 && std::isfinite(n);
          this->valid[i] = isValid ? 1 : 0;
          this->out[i] = isValid ? n : this->invalid;
        }
      });
  }
};

template <class Real>
// NOLINTNEXTLINE(readability-non-const-parameter): Conversion writes to `valid`
void convert(vtkDataArray* array, const Model& model, Real* out, unsigned char* valid, Real invalid)
{
  const Conversion<Real> conversion{ model, out, valid, invalid };
  if (!vtkArrayDispatch::Dispatch::Execute(array, conversion))
  {
    conversion(array);
  }
}

void hidePoints(vtkDataSet* data, unsigned char* valid)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (vtkUnsignedCharArray* ghosts = data->GetPointGhostArray())
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      valid[i] = ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENPOINT ? 0 : valid[i];
    }
  }
  vtkDataArray* mask = data->GetPointData()->GetArray(maskName);
  if (mask && mask->GetNumberOfComponents() == 1 && mask->GetNumberOfTuples() == count)
  {
    const auto values = vtk::DataArrayValueRange<1>(mask);
    for (vtkIdType i = 0; i < count; ++i)
    {
      valid[i] = values[i] == 0 ? 0 : valid[i];
    }
  }
}

/// Calls visit(cell, first corner, offsets of the eight corners) for every cell of a 3-D image.
template <class Visit>
void forCells(const int pointDimensions[3], const Visit& visit)
{
  const vtkIdType nx = pointDimensions[0];
  const vtkIdType nxy = nx * pointDimensions[1];
  const std::array<vtkIdType, 8> corners{ 0, 1, nx, nx + 1, nxy, nxy + 1, nxy + nx, nxy + nx + 1 };
  vtkIdType cell = 0;
  for (int k = 0; k < pointDimensions[2] - 1; ++k)
  {
    for (int j = 0; j < pointDimensions[1] - 1; ++j)
    {
      for (int i = 0; i < pointDimensions[0] - 1; ++i)
      {
        visit(cell++, k * nxy + j * nx + i, corners);
      }
    }
  }
}

/// Hides the points whose cells are all hidden, so that a body of m cells loses m - 1 points; and all
/// points of a hidden cell that has no hidden point then, so that thin bodies do not vanish.
void hidePointsOfHiddenCells(vtkImageData* image, unsigned char* valid)
{
  vtkUnsignedCharArray* ghosts = image->GetCellGhostArray();
  if (!ghosts || image->GetDataDimension() != 3)
  {
    return;
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  const auto isHidden = [ghosts](vtkIdType cell)
  { return (ghosts->GetValue(cell) & hiddenCellBits) != 0; };

  std::vector<unsigned char> seen(static_cast<std::size_t>(image->GetNumberOfPoints()), 0);
  forCells(dimensions,
    [&](vtkIdType cell, vtkIdType first, const std::array<vtkIdType, 8>& corners)
    {
      for (const vtkIdType corner : corners)
      {
        if (!isHidden(cell))
        {
          seen[static_cast<std::size_t>(first + corner)] = 1;
        }
      }
    });
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    valid[i] = seen[i] ? valid[i] : 0;
  }

  std::vector<vtkIdType> thin;
  forCells(dimensions,
    [&](vtkIdType cell, vtkIdType first, const std::array<vtkIdType, 8>& corners)
    {
      if (isHidden(cell) &&
        std::all_of(
          corners.begin(), corners.end(), [&](vtkIdType c) { return valid[first + c] != 0; }))
      {
        for (const vtkIdType corner : corners)
        {
          thin.push_back(first + corner);
        }
      }
    });
  for (const vtkIdType point : thin)
  {
    valid[point] = 0;
  }
}

/// Hides hidden cells and cells that have a hidden point.
void hideCells(vtkImageData* image, unsigned char* valid)
{
  if (vtkUnsignedCharArray* ghosts = image->GetCellGhostArray())
  {
    for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
    {
      valid[i] = ghosts->GetValue(i) & hiddenCellBits ? 0 : valid[i];
    }
  }
  vtkUnsignedCharArray* ghosts = image->GetPointGhostArray();
  if (!ghosts || image->GetDataDimension() != 3)
  {
    return;
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  forCells(dimensions,
    [&](vtkIdType cell, vtkIdType first, const std::array<vtkIdType, 8>& corners)
    {
      for (const vtkIdType corner : corners)
      {
        if (ghosts->GetValue(first + corner) & vtkDataSetAttributes::HIDDENPOINT)
        {
          valid[cell] = 0;
        }
      }
    });
}

/// The image's own points, or the centres of its cells.
void gridOfImage(vtkImageData* image, bool ofCells, vtkImageData* structure)
{
  int extent[6];
  image->GetExtent(extent);
  double origin[3];
  image->GetOrigin(origin);
  double spacing[3];
  image->GetSpacing(spacing);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(spacing[axis] > 0) || !std::isfinite(spacing[axis]) || !std::isfinite(origin[axis]))
    {
      throw std::runtime_error(std::string("The input's spacing along its ") + "xyz"[axis] +
        " axis is " + std::to_string(spacing[axis]) + " and its origin " +
        std::to_string(origin[axis]) +
        "; the spacing must be positive and both finite. Correct the input.");
    }
  }
  if (ofCells)
  {
    double shift[3] = { 0, 0, 0 };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (extent[2 * axis + 1] > extent[2 * axis])
      {
        shift[axis] = spacing[axis] / 2;
        --extent[2 * axis + 1];
      }
    }
    double rotated[3];
    image->GetDirectionMatrix()->MultiplyPoint(shift, rotated);
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] += rotated[axis];
    }
  }
  structure->Initialize();
  structure->SetExtent(extent);
  structure->SetOrigin(origin);
  structure->SetSpacing(spacing);
  structure->SetDirectionMatrix(image->GetDirectionMatrix());
}

bool hasVolume(int cellType)
{
  return vtkCellTypes::GetDimension(static_cast<unsigned char>(cellType)) == 3;
}

vtkIdType countVolumeCells(vtkDataSet* data)
{
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    count += hasVolume(data->GetCellType(i)) ? 1 : 0;
  }
  return count;
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
  const std::array<double, 3>& lengths, double cells, const std::array<int, 3>& given)
{
  double target = std::clamp(voxelsPerCell * cells, fewestVoxels, mostVoxels);
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

/// A leaf that holds nothing but N at its points (NaN where invalid), its cells without volume hidden.
vtkSmartPointer<vtkDataSet> prepareLeaf(vtkDataSet* leaf, const Found& found, const Model& model)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const vtkIdType points = leaf->GetNumberOfPoints();
  const vtkIdType cells = leaf->GetNumberOfCells();

  vtkNew<vtkUnsignedCharArray> cellGhosts;
  cellGhosts->SetName(vtkDataSetAttributes::GhostArrayName());
  cellGhosts->SetNumberOfValues(cells);
  vtkUnsignedCharArray* inputGhosts = leaf->GetCellGhostArray();
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const bool hidden = (inputGhosts && (inputGhosts->GetValue(i) & hiddenCellBits)) ||
      !hasVolume(leaf->GetCellType(i));
    cellGhosts->SetValue(i, hidden ? vtkDataSetAttributes::HIDDENCELL : 0);
  }

  vtkNew<vtkDoubleArray> refractivity;
  refractivity->SetName(refractivityName);
  std::vector<unsigned char> valid;
  if (!found.ofCells)
  {
    refractivity->SetNumberOfValues(points);
    valid.assign(static_cast<std::size_t>(points), 1);
    hidePoints(leaf, valid.data());
    convert(found.array, model, refractivity->GetPointer(0), valid.data(), nan);
  }
  else
  {
    // The mean over the valid cells at each point: sums of value and of validity, divided.
    vtkNew<vtkDoubleArray> sum;
    sum->SetName("sum");
    sum->SetNumberOfValues(cells);
    valid.resize(static_cast<std::size_t>(cells));
    for (vtkIdType i = 0; i < cells; ++i)
    {
      valid[static_cast<std::size_t>(i)] = cellGhosts->GetValue(i) ? 0 : 1;
    }
    convert(found.array, model, sum->GetPointer(0), valid.data(), 0.);
    vtkNew<vtkDoubleArray> share;
    share->SetName("share");
    share->SetNumberOfValues(cells);
    for (vtkIdType i = 0; i < cells; ++i)
    {
      const bool isValid = valid[static_cast<std::size_t>(i)] != 0;
      share->SetValue(i, isValid ? 1 : 0);
      cellGhosts->SetValue(i, isValid ? 0 : vtkDataSetAttributes::HIDDENCELL);
    }
    auto bare = vtkSmartPointer<vtkDataSet>::Take(leaf->NewInstance());
    bare->CopyStructure(leaf);
    bare->GetCellData()->AddArray(sum);
    bare->GetCellData()->AddArray(share);
    vtkNew<vtkCellDataToPointData> toPoints;
    toPoints->SetInputData(bare);
    toPoints->Update();
    vtkPointData* result =
      vtkDataSet::SafeDownCast(toPoints->GetOutputDataObject(0))->GetPointData();
    vtkDataArray* sums = result->GetArray("sum");
    vtkDataArray* shares = result->GetArray("share");
    refractivity->SetNumberOfValues(points);
    for (vtkIdType i = 0; i < points; ++i)
    {
      const double covered = shares->GetComponent(i, 0);
      refractivity->SetValue(i, covered > 0 ? sums->GetComponent(i, 0) / covered : nan);
    }
  }

  auto prepared = vtkSmartPointer<vtkDataSet>::Take(leaf->NewInstance());
  prepared->CopyStructure(leaf);
  prepared->GetPointData()->SetScalars(refractivity);
  prepared->GetCellData()->AddArray(cellGhosts);
  return prepared;
}

/// The part of an input that is resampled, and the grid it is resampled to.
struct Resampling
{
  std::vector<vtkDataSet*> leaves;
  std::array<int, 3> dimensions{};
  double bounds[6];
};

Resampling planResampling(vtkRefractiveIndex* self, const Source& source)
{
  Resampling plan;
  vtkBoundingBox box;
  double cells = 0;
  for (vtkDataSet* leaf : source.leaves)
  {
    const vtkIdType volumeCells = find(leaf, source.selection).array ? countVolumeCells(leaf) : 0;
    if (volumeCells > 0)
    {
      plan.leaves.push_back(leaf);
      cells += static_cast<double>(std::min(volumeCells, leaf->GetNumberOfPoints()));
      box.AddBounds(leaf->GetBounds());
    }
  }
  if (plan.leaves.empty())
  {
    throw std::runtime_error("The input has no 3-D cells with the array '" + source.label +
      "', so there is no volume for light to cross. Use volume data (for 2-D data: extrude it).");
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
  std::array<int, 3> given;
  std::copy_n(self->GetSamplingDimensions(), 3, given.begin());
  for (const int count : given)
  {
    if (count < 0 || count == 1)
    {
      throw std::runtime_error("SamplingDimensions holds " + std::to_string(count) +
        ". Give each axis at least 2 points, or 0 to have their number chosen.");
    }
  }
  plan.dimensions = chooseDimensions(lengths, cells, given);
  if (product(plan.dimensions) > mostPointsAskedFor)
  {
    throw std::runtime_error("SamplingDimensions asks for " + std::to_string(plan.dimensions[0]) +
      " x " + std::to_string(plan.dimensions[1]) + " x " + std::to_string(plan.dimensions[2]) +
      " points, more than can be held. Give fewer.");
  }
  return plan;
}

/// Fills the arrays of `output`, which has its structure, from an array on that grid.
void fill(vtkImageData* output, vtkDataArray* values, const Model& model, bool doublePrecision,
  vtkUnsignedCharArray* valid)
{
  vtkSmartPointer<vtkDataArray> refractivity;
  if (doublePrecision)
  {
    auto doubles = vtkSmartPointer<vtkDoubleArray>::New();
    doubles->SetNumberOfValues(output->GetNumberOfPoints());
    convert(values, model, doubles->GetPointer(0), valid->GetPointer(0), 0.);
    refractivity = doubles;
  }
  else
  {
    auto floats = vtkSmartPointer<vtkFloatArray>::New();
    floats->SetNumberOfValues(output->GetNumberOfPoints());
    convert(values, model, floats->GetPointer(0), valid->GetPointer(0), 0.f);
    refractivity = floats;
  }
  refractivity->SetName(refractivityName);
  output->GetPointData()->SetScalars(refractivity);
  output->GetPointData()->AddArray(valid);
}

vtkSmartPointer<vtkUnsignedCharArray> newMask(vtkIdType count)
{
  auto mask = vtkSmartPointer<vtkUnsignedCharArray>::New();
  mask->SetName(maskName);
  mask->SetNumberOfValues(count);
  mask->FillValue(1);
  return mask;
}

void resample(
  const Resampling& plan, const Source& source, bool doublePrecision, vtkImageData* output)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (std::size_t i = 0; i < plan.leaves.size(); ++i)
  {
    blocks->SetBlock(static_cast<unsigned int>(i),
      prepareLeaf(plan.leaves[i], find(plan.leaves[i], source.selection), source.model));
  }
  vtkNew<vtkResampleToImage> resampler;
  if (plan.leaves.size() == 1)
  {
    resampler->SetInputDataObject(blocks->GetBlock(0));
  }
  else
  {
    resampler->SetInputDataObject(blocks);
  }
  resampler->SetSamplingDimensions(plan.dimensions[0], plan.dimensions[1], plan.dimensions[2]);
  resampler->Update();

  vtkImageData* sampled = resampler->GetOutput();
  vtkDataArray* values = sampled->GetPointData()->GetArray(refractivityName);
  vtkDataArray* mask = sampled->GetPointData()->GetArray(resampler->GetMaskArrayName());
  if (!values || !mask)
  {
    throw std::runtime_error(
      "Resampling '" + source.label + "' to a grid found no data. Check the input's cells.");
  }
  output->CopyStructure(sampled);
  auto valid = newMask(output->GetNumberOfPoints());
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    valid->SetValue(i, mask->GetComponent(i, 0) != 0 ? 1 : 0);
  }
  fill(output, values, { 1, 0 }, doublePrecision, valid);
}

void convertImage(const Source& source, bool doublePrecision, vtkImageData* output)
{
  const Found found = find(source.image, source.selection);
  gridOfImage(source.image, found.ofCells, output);
  auto valid = newMask(output->GetNumberOfPoints());
  if (found.ofCells)
  {
    hideCells(source.image, valid->GetPointer(0));
  }
  else
  {
    hidePoints(source.image, valid->GetPointer(0));
    hidePointsOfHiddenCells(source.image, valid->GetPointer(0));
  }
  fill(output, found.array, source.model, doublePrecision, valid);
}

} // namespace

//------------------------------------------------------------------------------
vtkRefractiveIndex::vtkRefractiveIndex() = default;

//------------------------------------------------------------------------------
void vtkRefractiveIndex::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IndexModel: " << this->IndexModel << "\n";
  os << indent << "GladstoneDaleConstant: " << this->GladstoneDaleConstant << "\n";
  os << indent << "DensityScale: " << this->DensityScale << "\n";
  os << indent << "SamplingDimensions: " << this->SamplingDimensions[0] << " "
     << this->SamplingDimensions[1] << " " << this->SamplingDimensions[2] << "\n";
  os << indent << "DoublePrecision: " << this->DoublePrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ComputeGrid(vtkDataObject* input, vtkImageData* structure)
{
  const Source source = chooseSource(this, input);
  if (source.image)
  {
    gridOfImage(source.image, find(source.image, source.selection).ofCells, structure);
    return;
  }
  const Resampling plan = planResampling(this, source);
  structure->Initialize();
  structure->SetDimensions(plan.dimensions.data());
  structure->SetOrigin(plan.bounds[0], plan.bounds[2], plan.bounds[4]);
  structure->SetSpacing((plan.bounds[1] - plan.bounds[0]) / (plan.dimensions[0] - 1),
    (plan.bounds[3] - plan.bounds[2]) / (plan.dimensions[1] - 1),
    (plan.bounds[5] - plan.bounds[4]) / (plan.dimensions[2] - 1));
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::Convert(vtkDataObject* input, vtkImageData* output)
{
  output->Initialize();
  const Source source = chooseSource(this, input);
  this->UpdateProgress(0.05);
  if (this->GetAbortExecute())
  {
    return;
  }

  // Most builds of ParaView run VTK's threaded loops on one core unless told otherwise.
  const vtkSMPTools::Config threads(this->NumberOfThreads, "STDThread", false);
  vtkSMPTools::LocalScope(threads,
    [&]()
    {
      if (source.image)
      {
        convertImage(source, this->DoublePrecision, output);
      }
      else
      {
        resample(planResampling(this, source), source, this->DoublePrecision, output);
      }
    });

  const unsigned char* valid =
    vtkUnsignedCharArray::SafeDownCast(output->GetPointData()->GetArray(maskName))->GetPointer(0);
  if (std::none_of(
        valid, valid + output->GetNumberOfPoints(), [](unsigned char v) { return v != 0; }))
  {
    throw std::runtime_error("The array '" + source.label +
      "' has no valid value (all are NaN, infinite, hidden or masked), so there is no gas for "
      "light "
      "to cross. Choose another array or check the data.");
  }

  int dimensions[3];
  output->GetDimensions(dimensions);
  vtkDebugMacro(<< "Refractivity from '" << source.label << "' on " << dimensions[0] << " x "
                << dimensions[1] << " x " << dimensions[2] << " points.");
  vtkNew<vtkIntArray> used;
  used->SetName("SamplingDimensions");
  used->SetNumberOfComponents(3);
  used->InsertNextTypedTuple(dimensions);
  output->GetFieldData()->AddArray(used);
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);

  // The grid depends on the input's points and arrays. Where they have not been produced yet, this is
  // a guess, and the data tell better.
  vtkNew<vtkImageData> grid;
  const int given = *std::min_element(this->SamplingDimensions, this->SamplingDimensions + 3);
  grid->SetDimensions(64, 64, 64);
  if (given > 0)
  {
    grid->SetDimensions(this->SamplingDimensions);
  }
  if (inInfo->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    grid->SetExtent(inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
  }
  if (inInfo->Has(vtkDataObject::ORIGIN()) && inInfo->Has(vtkDataObject::SPACING()))
  {
    grid->SetOrigin(inInfo->Get(vtkDataObject::ORIGIN()));
    grid->SetSpacing(inInfo->Get(vtkDataObject::SPACING()));
  }
  try
  {
    this->ComputeGrid(vtkDataObject::GetData(inInfo), grid);
  }
  catch (const std::exception&) // RequestData will say it
  {
  }
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid->GetExtent(), 6);
  outInfo->Set(vtkDataObject::ORIGIN(), grid->GetOrigin(), 3);
  outInfo->Set(vtkDataObject::SPACING(), grid->GetSpacing(), 3);
  outInfo->Set(vtkDataObject::DIRECTION(), grid->GetDirectionMatrix()->GetData(), 9);
  vtkDataObject::SetActiveAttribute(outInfo, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    refractivityName, vtkDataSetAttributes::SCALARS);
  vtkDataObject::SetPointDataActiveScalarInfo(
    outInfo, this->DoublePrecision ? VTK_DOUBLE : VTK_FLOAT, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  if (inInfo->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    inInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
      inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  try
  {
    this->SetAbortExecute(0); // it stays set after an abort
    this->Convert(vtkDataObject::GetData(inputVector[0]), output);
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro(<< "There is not enough memory for the refractivity grid. Use a coarser input or "
                     "smaller SamplingDimensions.");
    output->Initialize();
  }
  catch (const std::exception& problem)
  {
    vtkErrorMacro(<< problem.what());
    output->Initialize();
  }
  return 1;
}
