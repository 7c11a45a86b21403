// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivitySource.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkRefractiveIndex.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <set>
#include <stdexcept>

namespace refractivity
{

namespace
{

/// What the user chose for one array.
struct Selection
{
  std::string property; // that it was chosen with
  std::string name;     // empty: by attribute, or not chosen
  int attribute = -1;   // vtkDataSetAttributes::AttributeTypes
  bool cellsFirst = false;
};

Selection selectionFrom(vtkRefractiveIndex* self)
{
  const bool fromDensity = self->GetIndexModel() == vtkRefractiveIndex::GLADSTONE_DALE;
  vtkInformation* info = self->GetInputArrayInformation(
    fromDensity ? vtkRefractiveIndex::DENSITY : vtkRefractiveIndex::INDEX_ARRAY);
  Selection selection;
  selection.property = fromDensity ? "Density" : "IndexArray";
  if (const char* name = info->Get(vtkDataObject::FIELD_NAME()))
  {
    selection.name = name;
  }
  else if (info->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    selection.attribute = info->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  selection.cellsFirst =
    info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  return selection;
}

vtkDataSetAttributes* attributesOf(vtkDataSet* data, bool ofCells)
{
  return data->GetAttributes(ofCells ? vtkDataObject::CELL : vtkDataObject::POINT);
}

vtkDataArray* find(vtkDataSetAttributes* attributes, const Selection& selection)
{
  if (!selection.name.empty())
  {
    return attributes->GetArray(selection.name.c_str());
  }
  return selection.attribute >= 0
    ? vtkArrayDownCast<vtkDataArray>(attributes->GetAbstractAttribute(selection.attribute))
    : nullptr;
}

/// The datasets within the input that have points.
std::vector<vtkDataSet*> dataSetsOf(vtkDataObject* input)
{
  std::vector<vtkDataSet*> dataSets;
  const auto add = [&dataSets](vtkDataObject* object)
  {
    vtkDataSet* data = vtkDataSet::SafeDownCast(object);
    if (data && data->GetNumberOfPoints() > 0)
    {
      dataSets.push_back(data);
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
  return dataSets;
}

/// Looks at the association that was asked for first, then at the other one.
std::vector<Leaf> leavesWith(const Selection& selection, const std::vector<vtkDataSet*>& dataSets)
{
  std::vector<Leaf> leaves;
  for (vtkDataSet* data : dataSets)
  {
    for (const bool ofCells : { selection.cellsFirst, !selection.cellsFirst })
    {
      if (vtkDataArray* array = find(attributesOf(data, ofCells), selection))
      {
        leaves.push_back({ data, array, ofCells });
        break;
      }
    }
  }
  return leaves;
}

/// "point arrays p, rho; cell arrays T", or "none".
std::string namesOfArrays(const std::vector<vtkDataSet*>& dataSets)
{
  std::string text;
  for (const bool ofCells : { false, true })
  {
    std::set<std::string> names;
    for (vtkDataSet* data : dataSets)
    {
      vtkDataSetAttributes* attributes = attributesOf(data, ofCells);
      for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      {
        vtkDataArray* array = attributes->GetArray(i);
        if (array && array->GetName() && array->GetNumberOfComponents() == 1)
        {
          names.insert(array->GetName());
        }
      }
    }
    names.erase(vtkDataSetAttributes::GhostArrayName());
    names.erase(maskName);
    std::string separator = text.empty() ? "" : "; ";
    separator += ofCells ? "cell arrays " : "point arrays ";
    for (const std::string& name : names)
    {
      text += separator + name;
      separator = ", ";
    }
  }
  return text.empty() ? "none" : text;
}

[[noreturn]] void throwNotFound(
  const Selection& selection, const std::vector<vtkDataSet*>& dataSets)
{
  const std::string& property = selection.property;
  const std::string names = namesOfArrays(dataSets);
  if (names == "none")
  {
    throw std::runtime_error("The input has no arrays with one component, so there is nothing to "
                             "take " +
      property + " from. Choose an input that has the field.");
  }
  if (selection.name.empty() && selection.attribute < 0)
  {
    throw std::runtime_error(
      "No array is chosen for " + property + ". Choose one of: " + names + ".");
  }
  throw std::runtime_error("The input has no array '" + selection.name + "'. Set " + property +
    " to one of: " + names + ".");
}

void requireScalars(const Leaf& leaf, const std::string& label, const std::string& property,
  const std::vector<vtkDataSet*>& dataSets)
{
  if (leaf.array->GetNumberOfComponents() != 1)
  {
    throw std::runtime_error("The array '" + label + "' has " +
      std::to_string(leaf.array->GetNumberOfComponents()) + " components, but " + property +
      " is a scalar. Choose one of: " + namesOfArrays(dataSets) + ".");
  }
  if (leaf.array->GetNumberOfTuples() !=
    (leaf.ofCells ? leaf.data->GetNumberOfCells() : leaf.data->GetNumberOfPoints()))
  {
    throw std::runtime_error("The array '" + label + "' has " +
      std::to_string(leaf.array->GetNumberOfTuples()) +
      " values, which is not one for each point or cell. Check the program that wrote it.");
  }
}

void requireFinite(const char* name, double value)
{
  if (!std::isfinite(value))
  {
    throw std::runtime_error(std::string(name) + " is not a finite number. Set it to one.");
  }
}

Model modelFrom(vtkRefractiveIndex* self)
{
  switch (self->GetIndexModel())
  {
    case vtkRefractiveIndex::GLADSTONE_DALE:
      requireFinite("GladstoneDaleConstant", self->GetGladstoneDaleConstant());
      requireFinite("DensityScale", self->GetDensityScale());
      return { self->GetGladstoneDaleConstant() * self->GetDensityScale(), 0 };
    case vtkRefractiveIndex::REFRACTIVE_INDEX:
      return { 1, -1 };
    default:
      return {};
  }
}

} // namespace

Source chooseSource(vtkRefractiveIndex* self, vtkDataObject* input)
{
  const std::vector<vtkDataSet*> dataSets = dataSetsOf(input);
  if (dataSets.empty())
  {
    throw std::runtime_error(
      "The input is empty: it has no points. Check that its source was read or "
      "updated and that no filter has removed everything.");
  }
  const Selection selection = selectionFrom(self);

  Source source;
  source.leaves = leavesWith(selection, dataSets);
  source.image = dataSets.size() == 1 ? vtkImageData::SafeDownCast(dataSets[0]) : nullptr;

  // A refractivity that was computed before is used as it stands.
  vtkDataArray* computed =
    source.image && self->GetIndexModel() != vtkRefractiveIndex::REFRACTIVE_INDEX
    ? source.image->GetPointData()->GetArray(arrayName)
    : nullptr;
  const bool asItStands = computed && (source.leaves.empty() || source.leaves[0].array == computed);
  if (asItStands)
  {
    source.leaves = { { source.image, computed, false } };
  }

  if (source.leaves.empty())
  {
    throwNotFound(selection, dataSets);
  }
  for (const Leaf& leaf : source.leaves)
  {
    source.label = leaf.array->GetName() ? leaf.array->GetName() : selection.property;
    requireScalars(leaf, source.label, selection.property, dataSets);
  }
  if (!asItStands)
  {
    source.model = modelFrom(self);
  }
  return source;
}

bool willReadCells(vtkRefractiveIndex* self, vtkDataObject* image)
{
  try
  {
    return chooseSource(self, image).leaves[0].ofCells;
  }
  catch (const std::runtime_error&)
  {
    return selectionFrom(self).cellsFirst;
  }
}

} // namespace refractivity
