// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractiveIndex.h"

#include "Guarded.h"
#include "Input/InputDescription.h"
#include "Input/RefractivityValues.h"
#include "Ranks/ChoiceOverRanks.h"
#include "Ranks/PiecesOfRanks.h"
#include "Sources/MediumMaker.h"
#include "Sources/RevolvedImage.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTypes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace filters;

vtkStandardNewMacro(vtkRefractiveIndex);

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

void tellGrid(vtkImageData* grid, vtkInformation* outInfo)
{
  outInfo->Set(Pipeline::WHOLE_EXTENT(), grid->GetExtent(), 6);
  outInfo->Set(vtkDataObject::ORIGIN(), grid->GetOrigin(), 3);
  outInfo->Set(vtkDataObject::SPACING(), grid->GetSpacing(), 3);
}

/// Copies data and composites of them without their arrays' values. Returns the copy of each dataset.
std::map<vtkDataObject*, vtkDataObject*> copy(vtkDataObject* input, vtkDataObject* output)
{
  auto* from = vtkCompositeDataSet::SafeDownCast(input);
  auto* to = vtkCompositeDataSet::SafeDownCast(output);
  if (!from || !to)
  {
    output->ShallowCopy(input);
    return { { input, output } };
  }
  std::map<vtkDataObject*, vtkDataObject*> copies;
  to->CopyStructure(from);
  to->SetFieldData(from->GetFieldData());
  const auto place = vtkSmartPointer<vtkCompositeDataIterator>::Take(from->NewIterator());
  for (place->InitTraversal(); !place->IsDoneWithTraversal(); place->GoToNextItem())
  {
    vtkDataObject* one = place->GetCurrentDataObject();
    const auto other = vtkSmartPointer<vtkDataObject>::Take(one->NewInstance());
    other->ShallowCopy(one);
    to->SetDataSet(place, other);
    copies[one] = other;
  }
  return copies;
}

} // namespace

vtkRefractiveIndex::vtkRefractiveIndex() = default;

vtkRefractiveIndex::~vtkRefractiveIndex() = default;

void vtkRefractiveIndex::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

int vtkRefractiveIndex::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]); // null after an error upstream
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  const char* type = this->Symmetry == SYMMETRY_AXISYMMETRIC ? "vtkImageData"
    : input                                                  ? input->GetClassName()
                                                             : "vtkUnstructuredGrid";
  if (!output || std::strcmp(output->GetClassName(), type) != 0)
  {
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(),
      vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type)));
  }
  return 1;
}

int vtkRefractiveIndex::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (this->Symmetry == SYMMETRY_AXISYMMETRIC)
  {
    if (this->Grid->GetNumberOfPoints() == 0)
    {
      this->Grid->SetDimensions(2, 2, 2); // until the data are there
    }
    tellGrid(this->Grid, outputVector->GetInformationObject(0));
  }
  return 1;
}

int vtkRefractiveIndex::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  if (this->Symmetry == SYMMETRY_AXISYMMETRIC)
  {
    requestPieces(this, inputVector);
  }
  return 1;
}

int vtkRefractiveIndex::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  output->Initialize();
  this->SetAbortExecute(0); // it stays set after an abort
  const auto work = [&]
  {
    const Ranks ranks;
    shareArrays(ranks, this->GetMaker(), input);
    if (this->Symmetry != SYMMETRY_AXISYMMETRIC)
    {
      this->Append(input, output);
      return;
    }
    this->Revolve(input, vtkImageData::SafeDownCast(output));
    // RequestInformation could not know it. Without the second, VTK would crop the output.
    vtkInformation* outInfo = outputVector->GetInformationObject(0);
    tellGrid(this->Grid, outInfo);
    outInfo->Set(Pipeline::UPDATE_EXTENT(), this->Grid->GetExtent(), 6);
  };
  const std::pair<vtkMTimeType, double> now{ std::max(this->GetMTime(), upstreamTime(this)),
    input && input->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP())
      ? input->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP())
      : 0 };
  bool isPiece =
    this->Symmetry != SYMMETRY_AXISYMMETRIC; // or the whole, and nothing after an error
  const auto fail = [&](const std::string& problem)
  {
    isPiece = false;
    output->Initialize();
    if (isRank0() &&
      std::exchange(this->FailedAt, now) != now) // once, however often it is requested
    {
      vtkErrorMacro(<< problem);
    }
  };
  try
  {
    guarded(work, "There is not enough memory for the refractivity. Use a coarser input.", fail);
  }
  catch (const Stopped&)
  {
    isPiece = false;
    output->Initialize();
  }
  if (!isPiece)
  {
    setComplete(outputVector);
  }
  return 1;
}

void vtkRefractiveIndex::Append(vtkDataObject* input, vtkDataObject* output)
{
  const Ranks ranks;
  MediumMaker& maker = this->GetMaker();
  std::vector<PiecesOfRanks::Piece> pieces;
  for (vtkDataSet* data : dataSetsOf(input))
  {
    PiecesOfRanks::Piece piece{};
    piece.data = data;
    pieces.push_back(std::move(piece));
  }
  const ChoiceOverRanks choice = chooseOverRanks(ranks, maker, pieces, false);
  if (choice.label.empty())
  {
    maker.choose(input); // says why there are no data
  }
  const auto copies =
    input ? copy(input, output) : std::map<vtkDataObject*, vtkDataObject*>(); // null after an error
  Tally tally;
  bool hasGas = false;
  for (const Leaf& leaf : choice.flow.leaves)
  {
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    const auto visible = visibleOf(leaf);
    vtkSmartPointer<vtkDataArray> values;
    if (leaf.arrays[0]->GetDataType() == VTK_DOUBLE)
    {
      values = convert<vtkDoubleArray>(leaf.arrays, choice.flow.model, visible, nowhere, tally);
    }
    else
    {
      values = convert<vtkFloatArray>(leaf.arrays, choice.flow.model, visible, nowhere, tally);
    }
    const unsigned char* gas = visible->GetPointer(0);
    hasGas = hasGas ||
      std::any_of(gas, gas + visible->GetNumberOfTuples(), [](unsigned char v) { return v != 0; });
    vtkDataSetAttributes* attributes =
      copies.at(leaf.input)
        ->GetAttributes(leaf.ofCells ? vtkDataObject::CELL : vtkDataObject::POINT);
    attributes->SetScalars(values);
  }
  bool isAnywhere = false;
  ranks.allGather([&] { return Ranks::Bytes(1, hasGas ? 1 : 0); },
    [&](Reader& reader) { isAnywhere = reader.Get<char>() != 0 || isAnywhere; });
  if (!isAnywhere)
  {
    throw std::runtime_error(noGas(choice.label));
  }
  const std::string warning = maker.warningOf(choice.flow, tally, false);
  if (!warning.empty() && isRank0())
  {
    vtkWarningMacro(<< shortened(warning));
  }
}

void vtkRefractiveIndex::Revolve(vtkDataObject* input, vtkImageData* output)
{
  const Ranks ranks;
  MediumMaker& maker = this->GetMaker();
  vtkSmartPointer<vtkDataObject> all = input;
  if (hasOtherRanks())
  {
    PiecesOfRanks pieces(ranks, input, arraysOf(maker.choice().settings));
    const auto gathered = pieces.gather();
    all = gathered ? gathered.Get() : input;
  }
  if (!isRank0())
  {
    return;
  }
  const Choice choice = maker.choose(all);
  const auto made = maker.make(choice, nullptr);
  sampleRevolved(*made->Source, choice, WorkProgress(maker.progress()).part(0.5, 1), output);
  this->Grid->CopyStructure(output);
  if (!made->Warning.empty())
  {
    vtkWarningMacro(<< shortened(made->Warning));
  }
}
