// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractiveIndex.h"

#include "Common/AtTheEnd.h"
#include "Common/Guarded.h"
#include "Common/RequestGuard.h"
#include "Input/InputDescription.h"
#include "Input/RefractivityOfImage.h"
#include "Input/SamplingBox.h"
#include "Ranks/InputsOfRanks.h"
#include "Sources/MediumMaker.h"
#include "Walls/GasBoundary.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

using namespace filters;

vtkStandardNewMacro(vtkRefractiveIndex);

namespace
{

const char* const noMemory = "There is not enough memory for the refractivity grid. Use a coarser "
                             "input or smaller SamplingDimensions.";

static_assert(vtkRefractiveIndex::AUTO == static_cast<int>(MediumSettings::Auto) &&
  vtkRefractiveIndex::GLADSTONE_DALE == static_cast<int>(MediumSettings::GladstoneDale) &&
  vtkRefractiveIndex::REFRACTIVE_INDEX == static_cast<int>(MediumSettings::RefractiveIndex) &&
  vtkRefractiveIndex::REFRACTIVITY == static_cast<int>(MediumSettings::Refractivity) &&
  vtkRefractiveIndex::GLADSTONE_DALE_MIXTURE == static_cast<int>(MediumSettings::Mixture) &&
  vtkRefractiveIndex::CIDDOR == static_cast<int>(MediumSettings::Ciddor) &&
  vtkRefractiveIndex::TRANSFER_FUNCTIONS == static_cast<int>(MediumSettings::Curves));
static_assert(vtkRefractiveIndex::DENSITY == static_cast<int>(MediumSettings::DensityArray) &&
  vtkRefractiveIndex::INDEX_ARRAY == static_cast<int>(MediumSettings::IndexArray) &&
  vtkRefractiveIndex::TEMPERATURE == static_cast<int>(MediumSettings::TemperatureArray) &&
  vtkRefractiveIndex::PRESSURE == static_cast<int>(MediumSettings::PressureArray) &&
  vtkRefractiveIndex::HUMIDITY == static_cast<int>(MediumSettings::HumidityArray) &&
  vtkRefractiveIndex::MASK == static_cast<int>(MediumSettings::MaskArray));
static_assert(vtkRefractiveIndex::OUTSIDE_AUTO == static_cast<int>(Outside::Auto) &&
  vtkRefractiveIndex::OUTSIDE_BLOCKS == static_cast<int>(Outside::Blocks) &&
  vtkRefractiveIndex::OUTSIDE_PASSES == static_cast<int>(Outside::Passes));

void tellGrid(vtkImageData* grid, vtkInformation* outInfo)
{
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid->GetExtent(), 6);
  outInfo->Set(vtkDataObject::ORIGIN(), grid->GetOrigin(), 3);
  outInfo->Set(vtkDataObject::SPACING(), grid->GetSpacing(), 3);
  outInfo->Set(vtkDataObject::DIRECTION(), grid->GetDirectionMatrix()->GetData(), 9);
}

} // namespace

//------------------------------------------------------------------------------
vtkRefractiveIndex::vtkRefractiveIndex()
  : Maker(std::make_shared<MediumMaker>(
      [this](double done)
      {
        this->UpdateProgress(done);
        return !this->GetAbortExecute();
      }))
  , Guard(std::make_shared<RequestGuard>())
  , Ranks(std::make_shared<InputsOfRanks>())
{
  this->SetNumberOfInputPorts(2);
  // Of vtkImageAlgorithm: the active scalars, whatever these are.
  this->GetInputArrayInformation(DENSITY)->Remove(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
}

//------------------------------------------------------------------------------
MediumMaker& vtkRefractiveIndex::GetMaker()
{
  this->Maker->settings = this->GetSettings();
  this->Maker->numberOfThreads = this->NumberOfThreads;
  return *this->Maker;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractiveIndex::GetMeshBuilds() { return this->Maker->mesh()->builds; }

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractiveIndex::GetGridPlans() { return this->Maker->gridPlans(); }

//------------------------------------------------------------------------------
const char* vtkRefractiveIndex::GetGrid() const { return this->Maker->grid().c_str(); }

//------------------------------------------------------------------------------
const char* vtkRefractiveIndex::GetArraysUsed()
{
  this->ArraysUsed = this->GetMaker().choice().message;
  return this->ArraysUsed.c_str();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkRefractiveIndex::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkPiecewiseFunction* function : this->Functions)
  {
    time = std::max(time, function ? function->GetMTime() : 0);
  }
  return time;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkRefractiveIndex::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  const auto work = [&] { return this->Superclass::ProcessRequest(request, input, output); };
  return this->Guard->Process(request, work, noMemory,
    [&](const std::string& problem) { this->Fail(problem, this->GetTimeOfGrid(), output); });
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::LackInput() { this->Ranks->lackInput(); }

//------------------------------------------------------------------------------
int vtkRefractiveIndex::FillInputPortInformation(int port, vtkInformation* info)
{
  // Any, so that one message says what is wrong with tables and others: VTK says it several times.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  if (port == BODIES)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);

  vtkNew<vtkImageData> grid;
  MediumMaker& maker = this->GetMaker();
  try
  {
    vtkDataObject* input = vtkDataObject::GetData(inInfo);
    if (this->Symmetry == NO_SYMMETRY && vtkImageData::SafeDownCast(input) &&
      inInfo->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()) &&
      inInfo->Has(vtkDataObject::ORIGIN()) && inInfo->Has(vtkDataObject::SPACING()))
    {
      // Not the input's own grid: it may be older, or be a part of the whole.
      vtkNew<vtkImageData> whole;
      whole->SetExtent(inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
      whole->SetOrigin(inInfo->Get(vtkDataObject::ORIGIN()));
      whole->SetSpacing(inInfo->Get(vtkDataObject::SPACING()));
      if (inInfo->Has(vtkDataObject::DIRECTION()))
      {
        whole->SetDirectionMatrix(inInfo->Get(vtkDataObject::DIRECTION()));
      }
      gridOfImage(whole, maker.willReadCells(input), this->Depth, grid);
      SamplingBox(this->SamplingBounds).crop(grid);
    }
    else
    {
      maker.computeGrid(input, grid);
    }
  }
  catch (const std::exception&)
  {
    // It is not known before the input's points and arrays are there; RequestData will. Every grid that
    // is resampled to holds this one, so that nobody requests more than there will be.
    grid->SetDimensions(2, 2, 2);
    if (*std::min_element(this->SamplingDimensions, this->SamplingDimensions + 3) > 1)
    {
      grid->SetDimensions(this->SamplingDimensions);
    }
  }
  tellGrid(grid, outInfo);
  vtkDataObject::SetActiveAttribute(
    outInfo, vtkDataObject::FIELD_ASSOCIATION_POINTS, arrayName, vtkDataSetAttributes::SCALARS);
  vtkDataObject::SetPointDataActiveScalarInfo(
    outInfo, this->DoublePrecision ? VTK_DOUBLE : VTK_FLOAT, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  requestPieces(this, inputVector);
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const double time = inInfo && inInfo->Has(Pipeline::UPDATE_TIME_STEP())
    ? inInfo->Get(Pipeline::UPDATE_TIME_STEP())
    : 0;
  this->FailedAt = time == this->RequestedTime ? this->FailedAt : 0;
  this->RequestedTime = time;
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);

  output->Initialize();
  const AtTheEnd complete([&] { setComplete(outputVector); }); // also of what has failed

  const vtkMTimeType now = this->GetTimeOfGrid();
  InputsOfRanks& inputsOfRanks = *this->Ranks;
  FilterRanks& ranks = inputsOfRanks.ranks();
  const auto begin = [&]
  {
    // Of what has failed before, one message is enough.
    return inputsOfRanks.begin(this, inputVector, this->FailedAt != now);
  };
  bool isWanted = false;
  if (!guarded([&] { isWanted = begin(); }, noMemory,
        [&](const std::string& problem)
        {
          if (isRank0() && this->FailedAt != now)
          {
            this->Fail(problem, now, outputVector);
          }
        }) ||
    !isWanted)
  {
    return 1;
  }
  MediumMaker& maker = this->GetMaker();
  inputsOfRanks.setOwn(
    maker, vtkDataObject::GetData(inputVector[0]), vtkDataObject::GetData(inputVector[BODIES]));
  const AtTheEnd forgetOwn([&] { inputsOfRanks.forgetOwn(); });
  if (!isRank0())
  {
    ranks.serve(this->NumberOfThreads,
      [&](const std::vector<char>& request) { return inputsOfRanks.answer(request); });
    return 1;
  }
  const AtTheEnd end([&] { ranks.end({ false, false }); });

  const auto makeGrid = [&]
  {
    this->Guard->ThrowEarlier();
    inputsOfRanks.shareArrays();
    const InputsOfRanks::Inputs inputs =
      inputsOfRanks.gather(std::numeric_limits<double>::infinity());
    this->SetAbortExecute(0); // it stays set after an abort
    std::string warning;
    try
    {
      warning = maker.convert(inputs.data, output, inputs.bodies, Numbers::Singles);
    }
    catch (const Stopped&)
    {
      output->Initialize();
      this->FailedAt = this->GetTimeOfGrid(); // further requests need not wait again
      return;
    }
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
    // Where RequestInformation could not know it. Without the second, VTK would crop the output.
    tellGrid(output, outInfo);
    outInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), output->GetExtent(), 6);
  };
  guarded(makeGrid, noMemory,
    [&](const std::string& problem) { this->Fail(problem, now, outputVector); });
  return 1;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkRefractiveIndex::GetTimeOfGrid()
{
  return std::max(this->GetMTime(), upstreamTime(this));
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::Fail(
  const std::string& problem, vtkMTimeType now, vtkInformationVector* outputs)
{
  this->FailedAt = now;
  vtkErrorMacro(<< problem);
  vtkImageData::GetData(outputs)->Initialize();
}
