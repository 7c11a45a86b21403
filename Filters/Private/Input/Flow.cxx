// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/Flow.h"

#include "Common/Sentences.h"
#include "Gas/GasChoices.h"
#include "Input/BetweenPlanes.h"
#include "Input/ChosenArrays.h"
#include "Input/InputDescription.h"
#include "Input/OneLayer.h"
#include "Input/RefractivityValues.h"
#include "Input/VoxelJumps.h"
#include "NumberText.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkHyperTreeGrid.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Returns what is wrong with data without points or cells, of which `subject` says what they are; mostly empty.
std::string lackOfSpace(vtkDataObject* input, const std::string& subject)
{
  for (vtkDataObject* leaf : leavesOf(input))
  {
    if (vtkHyperTreeGrid::SafeDownCast(leaf))
    {
      return subject +
        " is a hyper-tree grid, whose cells light cannot be sent through as they are. "
        "Make cells of it with the filter Hyper Tree Grid To Unstructured Grid.";
    }
    if (vtkTable::SafeDownCast(leaf))
    {
      return subject +
        " is a table, so it is not known where its values are. Make a grid of it with "
        "the filter Table To Structured Grid, or points with Table To Points and a volume of "
        "these with Point Volume Interpolator.";
    }
    if (!vtkDataSet::SafeDownCast(leaf))
    {
      return subject + " is a " + std::string(leaf->GetClassName()) +
        ", which has no cells for light to cross. Use data that fill a volume, or a plane.";
    }
  }
  return "";
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

/// An array, and which of its values mark what is not gas.
struct Mask
{
  vtkDataArray* values; // one component
  bool ofCells;
  bool hidesAbove; // hides values from the threshold on instead of those below it

  /// Hides NaN, too.
  bool hides(double value) const
  {
    constexpr double threshold = MediumSettings::maskThreshold;
    return this->hidesAbove ? !(value < threshold) : !(value >= threshold);
  }
};

/// Returns a shallow copy of a leaf's data in which masked cells are hidden, or masked points if
/// the leaf's values belong to points. If the mask belongs to points and the values to cells, hides
/// cells with any masked point.
vtkSmartPointer<vtkDataSet> hideMasked(const Leaf& leaf, const Mask& mask)
{
  vtkDataSet* data = leaf.data;
  const bool hidesCells = mask.ofCells || leaf.ofCells;
  const vtkIdType count = hidesCells ? data->GetNumberOfCells() : data->GetNumberOfPoints();
  const int hidden =
    hidesCells ? int{ vtkDataSetAttributes::HIDDENCELL } : int{ vtkDataSetAttributes::HIDDENPOINT };
  vtkUnsignedCharArray* before =
    hidesCells ? data->GetCellGhostArray() : data->GetPointGhostArray();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(count);
  vtkNew<vtkIdList> points;
  for (vtkIdType i = 0; i < count; ++i)
  {
    bool isHidden = false;
    if (hidesCells && !mask.ofCells)
    {
      data->GetCellPoints(i, points);
      isHidden = std::any_of(points->begin(), points->end(),
        [&](vtkIdType point) { return mask.hides(mask.values->GetComponent(point, 0)); });
    }
    else
    {
      isHidden = mask.hides(mask.values->GetComponent(i, 0));
    }
    const unsigned char own = before ? before->GetValue(i) : 0;
    ghosts->SetValue(i, static_cast<unsigned char>(isHidden ? own | hidden : own));
  }
  auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  copy->ShallowCopy(data);
  copy->GetAttributes(hidesCells ? vtkDataObject::CELL : vtkDataObject::POINT)->AddArray(ghosts);
  return copy;
}

/// Applies the mask, if there is one. Datasets without its array are all gas; it is an error if all
/// lack one that the user has chosen (`isChosen`).
void applyMask(const MediumSettings& settings, bool isChosen,
  const std::vector<vtkDataSet*>& dataSets, Flow& flow)
{
  if (!settings.Arrays[MediumSettings::MaskArray].isNamed())
  {
    return;
  }
  const Selection selection = selectionOf(settings, MediumSettings::MaskArray);
  bool isFound = false;
  for (Leaf& leaf : flow.leaves)
  {
    const std::vector<Leaf> found = leavesWith({ selection }, { leaf.data });
    if (found.empty())
    {
      continue;
    }
    isFound = true;
    requireScalars(found[0], { selection }, dataSets);
    const vtkSmartPointer<vtkDataSet> masked =
      hideMasked(leaf, { found[0].arrays[0], found[0].ofCells, !marksGas(selection.name) });
    if (flow.image == leaf.data)
    {
      flow.image = vtkImageData::SafeDownCast(masked);
    }
    leaf.data = masked;
    flow.made.emplace_back(masked);
  }
  if (!isFound && isChosen)
  {
    throwNotFound({ selection }, dataSets);
  }
}

/// Flattens data of one layer of cells.
void flattenLayers(const MediumSettings& settings, Flow& flow, const Flow* like)
{
  flow.depth = settings.Depth;
  flow.isDepthGiven = flow.depth > 0;
  if (settings.mayBeWedge() && (!like || like->axisOfWedge >= 0))
  {
    std::vector<vtkDataSet*> layers;
    for (const Leaf& leaf : flow.leaves)
    {
      if (isLayerLeaf(leaf))
      {
        layers.push_back(leaf.data);
      }
    }
    const std::array<double, 3> origin = settings.symmetryOrigin();
    const std::optional<Wedge> wedge = findWedge(layers, origin);
    if (wedge && flattenWedge(flow, *wedge, origin))
    {
      flow.axisOfWedge = wedge->axis;
      flow.degreesOfWedge = wedge->degrees;
      return;
    }
    if (wedge && settings.isAxisymmetric())
    {
      throw std::runtime_error(
        "Symmetry is Axisymmetric, and the input lies between two planes through the " +
        std::string(1, "xyz"[wedge->axis]) +
        " axis, but it is more than one layer of cells. Use a plane (Slice) of it.");
    }
  }
  flattenLayer(flow, like);
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

Flow chooseFlow(
  const MediumSettings& given, KnownArrays& known, vtkDataObject* input, const Flow* like)
{
  const std::vector<vtkDataSet*> dataSets = dataSetsOf(input);
  if (dataSets.empty())
  {
    const std::string lack = lackOfSpace(input, "The input");
    throw std::runtime_error(!lack.empty()
        ? lack
        : "The input is empty: it has no points. Check that its source was read or "
          "updated and that no filter has removed everything.");
  }
  Flow flow;
  flow.choice = choiceFor(given, known, dataSets);
  const MediumSettings& settings = flow.choice.settings;
  std::vector<Selection> selections = selectionsFrom(settings);
  flow.image = dataSets.size() == 1 ? vtkImageData::SafeDownCast(dataSets[0]) : nullptr;
  if (vtkDataArray* computed = computedBefore(settings, flow.image, selections[0]))
  {
    selections.erase(selections.begin() + 1, selections.end());
    flow.isComputed = true;
    flow.leaves = { { flow.image, { computed }, false, flow.image } };
  }
  else
  {
    flow.model = modelFrom(settings);
    flow.notes = flow.choice.warning;
    flow.leaves = leavesWith(selections, dataSets);
  }

  addText(flow.notes, lackOfSpace(input, "A block of the input, which is left out,"));
  if (flow.leaves.empty())
  {
    throwNotFound(selections, dataSets, flow.choice.note);
  }
  for (const Leaf& leaf : flow.leaves)
  {
    requireScalars(leaf, selections, dataSets);
  }
  flow.label = labelOf(flow.leaves[0].arrays, selections);
  applyMask(settings, given.Arrays[MediumSettings::MaskArray].isChosen(), dataSets, flow);
  flattenLayers(settings, flow, like);
  return flow;
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

Implausible implausibleIn(const Flow& flow)
{
  const MediumSettings& settings = flow.choice.settings;
  if (flow.isComputed || settings.IndexModel == MediumSettings::TRANSFER_FUNCTIONS)
  {
    return {};
  }
  FlowInUse used;
  used.indexModel = static_cast<MediumSettings::IndexModels>(settings.IndexModel);
  used.isScaleGiven = flow.choice.isScaleKnown;
  const bool isIndex = settings.IndexModel == MediumSettings::REFRACTIVE_INDEX ||
    settings.IndexModel == MediumSettings::REFRACTIVITY;
  used.scales = settings.IndexModel == MediumSettings::CIDDOR || settings.usesGasLaw()
    ? std::vector<double>{ kelvinsOf(settings), settings.PressureScale }
    : settings.IndexModel == MediumSettings::WATER ? std::vector<double>{ kelvinsOf(settings) }
    : settings.IndexModel == MediumSettings::ELECTRON_DENSITY
    ? std::vector<double>{ perCubicMetreOf(settings), settings.DensityScale }
    : std::vector<double>{ isIndex ? 1 : settings.DensityScale };
  used.zero = zeroOf(settings);
  used.isGas = settings.IndexModel == MediumSettings::GLADSTONE_DALE_MIXTURE ||
    settings.GladstoneDaleConstant == 0;
  if (settings.IndexModel == MediumSettings::GLADSTONE_DALE)
  {
    used.constant = constantFrom(settings);
  }
  const std::vector<std::size_t> indices = arraysOfModel(settings);
  const bool isUniform = settings.hasUniformPressure();
  used.isConstant = true;
  const std::size_t count = isUniform ? 1 : used.scales.size();
  for (std::size_t i = 0; i < flow.leaves[0].arrays.size(); ++i)
  {
    const ArraySelection& selection = settings.Arrays[indices[std::min(i, count - 1)]];
    FlowArray array{ selection.name, selection.cellsFirst ? FlowArray::Cells : FlowArray::Points, 1,
      { std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest() } };
    bool areSingles = false;
    for (const Leaf& leaf : flow.leaves)
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
      areSingles = areSingles || leaf.arrays[i]->GetDataType() == VTK_FLOAT;
      if (array.name.empty() && leaf.arrays[i]->GetName())
      {
        array.name = leaf.arrays[i]->GetName();
      }
    }
    const double rounding = areSingles ? 1e-6 : 1e-13; // of some operations
    used.isConstant = used.isConstant &&
      array.range[1] - array.range[0] <=
        rounding * std::max(std::abs(array.range[0]), std::abs(array.range[1]));
    if (i < count)
    {
      used.arrays.push_back(std::move(array));
    }
  }
  if (isUniform)
  {
    used.scales[1] = 1;
    used.arrays.push_back({ "UniformPressure", FlowArray::Points, 1,
      { settings.UniformPressure, settings.UniformPressure } });
  }
  Implausible found = implausible(used);
  const std::array<double, 2> range = used.arrays[0].range;
  const double jump = found.text.empty() ? jumpOfVoxels(flow.leaves, flow.model, range) : 0;
  if (jump > 0)
  {
    found = { "voxels",
      "n jumps by " + textOf(jump, 3) +
        " from sample to sample with nothing between, as of glass in voxels: a face that is "
        "oblique to the grid is "
        "stairs, which bend light by as much as the glass does. Give each voxel the share of it "
        "that is glass, spread "
        "the face over three voxels, or use cells that follow it (Documentation/density.md)." };
  }
  return found;
}

} // namespace filters
