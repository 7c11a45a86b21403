// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/ChosenArrays.h"

#include "Input/Flow.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <stdexcept>

namespace filters
{

namespace
{

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

/// Finds the selected arrays of points or cells; null for missing ones.
Arrays findAll(vtkDataSet* data, bool ofCells, const std::vector<Selection>& selections)
{
  Arrays arrays;
  for (const Selection& selection : selections)
  {
    arrays.push_back(find(attributesOf(data, ofCells), selection));
  }
  return arrays;
}

bool isComplete(const Arrays& arrays)
{
  return std::find(arrays.begin(), arrays.end(), nullptr) == arrays.end();
}

std::string nameOf(vtkDataArray* array, const Selection& selection)
{
  return array->GetName() ? array->GetName() : selection.property;
}

[[noreturn]] void throwMixed(
  const std::vector<Selection>& selections, const Arrays& ofPoints, const Arrays& ofCells)
{
  std::string points, cells;
  for (std::size_t i = 0; i < selections.size(); ++i)
  {
    if (!ofPoints[i] || !ofCells[i])
    {
      std::string& names = ofPoints[i] ? points : cells;
      names += (names.empty() ? "" : ", ") + selections[i].property + " '" +
        nameOf((ofPoints[i] ? ofPoints : ofCells)[i], selections[i]) + "'";
    }
  }
  throw std::runtime_error("Some arrays belong to points (" + points + ") and some to cells (" +
    cells +
    "), but N is formed where all of them have values. Turn one kind into the other, for "
    "instance with Cell Data to Point Data.");
}

/// Lists arrays and ranges: "point arrays p (1 to 2), rho (0 to 1); cell arrays T (300 to 310)".
std::string namesOfArrays(const std::vector<vtkDataSet*>& dataSets)
{
  std::vector<FlowArray> arrays = flowArraysOf(dataSets, true);
  std::sort(arrays.begin(), arrays.end(),
    [](const FlowArray& a, const FlowArray& b) { return a.name < b.name; });
  return arraysInWords(arrays);
}

} // namespace

std::vector<Leaf> leavesWith(
  const std::vector<Selection>& selections, const std::vector<vtkDataSet*>& dataSets)
{
  std::vector<Leaf> leaves;
  for (vtkDataSet* data : dataSets)
  {
    const Arrays found[2] = { findAll(data, false, selections), findAll(data, true, selections) };
    const bool cellsFirst = selections[0].cellsFirst;
    if (isComplete(found[cellsFirst]))
    {
      leaves.push_back({ data, found[cellsFirst], cellsFirst, data });
    }
    else if (isComplete(found[!cellsFirst]))
    {
      leaves.push_back({ data, found[!cellsFirst], !cellsFirst, data });
    }
    else
    {
      Arrays any = found[0];
      std::transform(any.begin(), any.end(), found[1].begin(), any.begin(),
        [](vtkDataArray* a, vtkDataArray* b) { return a ? a : b; });
      if (isComplete(any))
      {
        throwMixed(selections, found[0], found[1]);
      }
    }
  }
  return leaves;
}

void throwNotFound(const std::vector<Selection>& selections,
  const std::vector<vtkDataSet*>& dataSets, const std::string& note)
{
  const auto missing = std::find_if(selections.begin(), selections.end(),
    [&](const Selection& selection) { return leavesWith({ selection }, dataSets).empty(); });
  if (missing == selections.end())
  {
    throw ArraysMissing("No block of the input has all the arrays that IndexModel needs, so "
                        "there is nothing to find N from. Check which block has which.");
  }
  const Selection& selection = *missing;
  const std::string& property = selection.property;
  const std::string names = namesOfArrays(dataSets);
  if (names.empty())
  {
    throw ArraysMissing(note +
      "The input has no arrays with one component, so there is nothing to take " + property +
      " from. Choose an input that has the field, or switch its arrays on in the reader.");
  }
  if (selection.name.empty() && selection.attribute < 0)
  {
    throw ArraysMissing("No array is chosen for " + property + ", and none is known by its name. " +
      note + "Choose one of: " + names + "." +
      (property == "Density"
          ? " A temperature gives no density without a pressure; with both, compute one or use "
            "IndexModel Ciddor (Documentation/density.md). Where air has the same pressure "
            "everywhere, set UniformPressure (101325 Pa in a room)."
          : ""));
  }
  throw ArraysMissing("The input has no array '" + selection.name + "'. Set " + property +
    " to one of: " + names + ".");
}

void requireScalars(const Leaf& leaf, const std::vector<Selection>& selections,
  const std::vector<vtkDataSet*>& dataSets)
{
  for (std::size_t i = 0; i < leaf.arrays.size(); ++i)
  {
    vtkDataArray* array = leaf.arrays[i];
    const std::string name = nameOf(array, selections[i]);
    if (array->GetNumberOfComponents() != 1)
    {
      const std::string scalars = namesOfArrays(dataSets);
      throw std::runtime_error("The array '" + name + "' has " +
        std::to_string(array->GetNumberOfComponents()) + " components, but " +
        selections[i].property + " is a scalar. " +
        (scalars.empty() ? "Make an array of one of them with Calculator."
                         : "Choose one of: " + scalars + "."));
    }
    if (array->GetNumberOfTuples() !=
      (leaf.ofCells ? leaf.data->GetNumberOfCells() : leaf.data->GetNumberOfPoints()))
    {
      throw std::runtime_error("The array '" + name + "' has " +
        std::to_string(array->GetNumberOfTuples()) +
        " values, which is not one for each point or cell. Check the program that wrote it.");
    }
  }
}

std::string labelOf(const Arrays& arrays, const std::vector<Selection>& selections)
{
  std::string label = arrays.size() > 1 ? "arrays" : "array";
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    label += (i > 0 ? ", '" : " '") + nameOf(arrays[i], selections[i]) + "'";
  }
  return label;
}

} // namespace filters
