// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/RefractivitySource.h"

#include "Gas/GasChoices.h"
#include "Input/InputDescription.h"
#include "Input/Mask.h"
#include "Input/OneLayer.h"
#include "Input/RefractivityValues.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
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

/// Throws for data without points or cells.
void requireSpace(vtkDataObject* input)
{
  for (vtkDataObject* leaf : leavesOf(input))
  {
    if (vtkHyperTreeGrid::SafeDownCast(leaf))
    {
      throw std::runtime_error(
        "The input is a hyper-tree grid, whose cells light cannot be sent through as they are. "
        "Make cells of it with the filter Hyper Tree Grid To Unstructured Grid.");
    }
    if (vtkTable::SafeDownCast(leaf))
    {
      throw std::runtime_error(
        "The input is a table, so it is not known where its values are. Make a grid of it with "
        "the filter Table To Structured Grid, or points with Table To Points and a volume of "
        "these with Point Volume Interpolator.");
    }
    if (!vtkDataSet::SafeDownCast(leaf))
    {
      throw std::runtime_error("The input is a " + std::string(leaf->GetClassName()) +
        ", which has no cells for light to cross. Use data that fill a volume, or a plane.");
    }
  }
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

/// Lists the datasets with all arrays, in the association of the first selection or the other.
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

/// Lists arrays and ranges: "point arrays p (1 to 2), rho (0 to 1); cell arrays T (300 to 310)".
std::string namesOfArrays(const std::vector<vtkDataSet*>& dataSets)
{
  std::vector<FlowArray> arrays = flowArraysOf(dataSets, true);
  std::sort(arrays.begin(), arrays.end(),
    [](const FlowArray& a, const FlowArray& b) { return a.name < b.name; });
  return arraysInWords(arrays);
}

/// Throws a message about the first array that no dataset has, or that no dataset has all of them.
/// `note`: names that were not understood if no array was chosen.
[[noreturn]] void throwNotFound(const std::vector<Selection>& selections,
  const std::vector<vtkDataSet*>& dataSets, const std::string& note = "")
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
    throw ArraysMissing("The input has no arrays with one component, so there is nothing to "
                        "take " +
      property +
      " from. Choose an input that has the field, or switch its arrays on in the reader.");
  }
  if (selection.name.empty() && selection.attribute < 0)
  {
    throw ArraysMissing("No array is chosen for " + property + ", and none is known by its name. " +
      note + "Choose one of: " + names + "." +
      (property == "Density"
          ? " A temperature gives no density without a pressure; with both, compute one or use "
            "IndexModel Ciddor (Documentation/density.md). Where air has the same pressure "
            "everywhere, set UniformPressure (101325 Pa in a room); of air without heat and strong "
            "shocks the pressure is enough with StagnationTemperature (293.15 K in a room)."
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
      throw std::runtime_error("The array '" + name + "' has " +
        std::to_string(array->GetNumberOfComponents()) + " components, but " +
        selections[i].property + " is a scalar. Choose one of: " + namesOfArrays(dataSets) + ".");
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

/// Returns the array Refractivity if the image is used as it is: IndexModel does not choose other
/// arrays by name, and the first array is missing, not chosen or Refractivity itself.
vtkDataArray* computedBefore(
  const MediumSettings& settings, vtkImageData* image, const Selection& selection)
{
  if (!image || settings.IndexModel == MediumSettings::REFRACTIVE_INDEX ||
    (settings.IndexModel == MediumSettings::TRANSFER_FUNCTIONS && !settings.Fields.empty()))
  {
    return nullptr;
  }
  vtkDataArray* computed = image->GetPointData()->GetArray(arrayName);
  const std::vector<Leaf> leaves = leavesWith({ selection }, { image });
  return leaves.empty() || leaves[0].arrays[0] == computed ? computed : nullptr;
}

/// Applies the mask, if there is one. Datasets without its array are all gas; it is an error if all
/// lack one that the user has chosen (`isChosen`).
void applyMask(const MediumSettings& settings, bool isChosen,
  const std::vector<vtkDataSet*>& dataSets, Source& source)
{
  if (!settings.Arrays[MediumSettings::MaskArray].isNamed())
  {
    return;
  }
  const Selection selection = selectionOf(settings, MediumSettings::MaskArray);
  bool isFound = false;
  for (Leaf& leaf : source.leaves)
  {
    const std::vector<Leaf> found = leavesWith({ selection }, { leaf.data });
    if (found.empty())
    {
      continue;
    }
    isFound = true;
    requireScalars(found[0], { selection }, dataSets);
    const vtkSmartPointer<vtkDataSet> masked =
      hideMasked(leaf, { found[0].arrays[0], found[0].ofCells, settings.MaskedSide == 0 });
    if (source.image == leaf.data)
    {
      source.image = vtkImageData::SafeDownCast(masked);
    }
    leaf.data = masked;
    source.made.emplace_back(masked);
  }
  if (!isFound && isChosen)
  {
    throwNotFound({ selection }, dataSets);
  }
}

/// Flattens data of one layer of cells.
void flattenLayers(const MediumSettings& settings, Source& source, const Source* like)
{
  source.depth = settings.Depth;
  source.isDepthGiven = source.depth > 0;
  if (settings.isAxisymmetric())
  {
    const std::array<double, 3> origin = settings.symmetryOrigin();
    if (const std::optional<Wedge> wedge = findWedge(source, origin))
    {
      flattenWedge(source, *wedge, origin);
      source.axisOfWedge = wedge->axis;
      return;
    }
  }
  flattenLayer(source, like);
}

} // namespace

std::vector<vtkDataSet*> dataSetsOf(vtkDataObject* input)
{
  std::vector<vtkDataSet*> dataSets;
  for (vtkDataObject* leaf : leavesOf(input))
  {
    vtkDataSet* data = vtkDataSet::SafeDownCast(leaf);
    if (data && data->GetNumberOfPoints() > 0)
    {
      dataSets.push_back(data);
    }
  }
  return dataSets;
}

MediumChoice choiceFor(
  const MediumSettings& settings, KnownArrays& known, const std::vector<vtkDataSet*>& dataSets)
{
  if (isOpen(settings) && !known.AreOfRanks())
  {
    known.Note(flowArraysOf(dataSets, false));
  }
  return choiceOf(settings, known.Get());
}

Source chooseSource(
  const MediumSettings& given, KnownArrays& known, vtkDataObject* input, const Source* like)
{
  const std::vector<vtkDataSet*> dataSets = dataSetsOf(input);
  if (dataSets.empty())
  {
    requireSpace(input);
    throw std::runtime_error(
      "The input is empty: it has no points. Check that its source was read or "
      "updated and that no filter has removed everything.");
  }
  Source source;
  source.choice = choiceFor(given, known, dataSets);
  const MediumSettings& settings = source.choice.settings;
  std::vector<Selection> selections = selectionsFrom(settings);
  source.image = dataSets.size() == 1 ? vtkImageData::SafeDownCast(dataSets[0]) : nullptr;
  if (vtkDataArray* computed = computedBefore(settings, source.image, selections[0]))
  {
    selections.erase(selections.begin() + 1, selections.end());
    source.isComputed = true;
    source.leaves = { { source.image, { computed }, false, source.image } };
  }
  else
  {
    source.model = modelFrom(settings);
    source.noteOnGases = noteOnGases(settings);
    source.leaves = leavesWith(selections, dataSets);
  }

  if (source.leaves.empty())
  {
    throwNotFound(selections, dataSets, source.choice.note);
  }
  for (const Leaf& leaf : source.leaves)
  {
    requireScalars(leaf, selections, dataSets);
  }
  source.label = labelOf(source.leaves[0].arrays, selections);
  applyMask(settings, given.Arrays[MediumSettings::MaskArray].isChosen(), dataSets, source);
  flattenLayers(settings, source, like);
  return source;
}

std::vector<std::string> arraysOf(const MediumSettings& settings)
{
  std::vector<std::string> names = settings.Fields; // colours may use them with any model
  for (const Selection& selection : selectionsFrom(settings))
  {
    names.push_back(selection.name);
  }
  names.push_back(settings.Arrays[MediumSettings::MaskArray].name);
  return names;
}

Implausible implausibleIn(const Source& source)
{
  const MediumSettings& settings = source.choice.settings;
  if (source.isComputed || settings.IndexModel == MediumSettings::TRANSFER_FUNCTIONS)
  {
    return {};
  }
  FlowInUse flow;
  flow.indexModel = static_cast<MediumSettings::IndexModels>(settings.IndexModel);
  flow.isScaleGiven = source.choice.isScaleKnown;
  const bool isIndex = settings.IndexModel == MediumSettings::REFRACTIVE_INDEX ||
    settings.IndexModel == MediumSettings::REFRACTIVITY;
  flow.scales = settings.IndexModel == MediumSettings::CIDDOR
    ? std::vector<double>{ kelvinsOf(settings), settings.PressureScale }
    : std::vector<double>{ isIndex ? 1 : settings.DensityScale };
  const bool isOfTable = !isCustom(settings.Gas);
  flow.isGas = settings.IndexModel == MediumSettings::GLADSTONE_DALE_MIXTURE || isOfTable ||
    settings.GladstoneDaleConstant == MediumSettings::defaultConstant;
  if (isOfTable && settings.IndexModel == MediumSettings::GLADSTONE_DALE)
  {
    flow.constant = gasFrom("Gas", settings.Gas)->constantAt(wavelengthOfGases(settings));
  }
  const std::vector<std::size_t> indices = arraysOfModel(settings);
  const bool isUniform = settings.hasUniformPressure(), isIsentropic = settings.isIsentropic();
  for (std::size_t i = 0; i < (isUniform || isIsentropic ? 1 : flow.scales.size()); ++i)
  {
    const ArraySelection& selection = settings.Arrays[indices[i]];
    FlowArray array{ selection.name, selection.cellsFirst ? FlowArray::Cells : FlowArray::Points, 1,
      { std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest() } };
    for (const Leaf& leaf : source.leaves)
    {
      double range[2];
      vtkUnsignedCharArray* ghosts =
        leaf.ofCells ? leaf.data->GetCellGhostArray() : leaf.data->GetPointGhostArray();
      ghosts ? leaf.arrays[i]->GetFiniteRange(range, 0, ghosts->GetPointer(0),
                 leaf.ofCells ? hiddenCellBits
                              : static_cast<unsigned char>(vtkDataSetAttributes::HIDDENPOINT))
             : leaf.arrays[i]->GetFiniteRange(range, 0);
      array.range[0] = std::min(array.range[0], range[0]);
      array.range[1] = std::max(array.range[1], range[1]);
      if (array.name.empty() && leaf.arrays[i]->GetName())
      {
        array.name = leaf.arrays[i]->GetName();
      }
    }
    flow.arrays.push_back(std::move(array));
  }
  if (isUniform)
  {
    flow.scales[1] = 1;
    flow.arrays.push_back({ "UniformPressure", FlowArray::Points, 1,
      { settings.UniformPressure, settings.UniformPressure } });
  }
  if (isIsentropic)
  {
    flow.scales[0] = 1;
    flow.arrays.insert(flow.arrays.begin(),
      { "StagnationTemperature", FlowArray::Points, 1,
        { settings.StagnationTemperature, settings.StagnationTemperature } });
  }
  return implausible(flow);
}

} // namespace filters
