// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractiveIndex.h"

#include "ArrayChoice.h"
#include "AtTheEnd.h"
#include "AvailableMemory.h"
#include "BodyTriangles.h"
#include "FieldFromImage.h"
#include "FlatData.h"
#include "GridOfSource.h"
#include "Guarded.h"
#include "ImageSource.h"
#include "InputDescription.h"
#include "InputsOfRanks.h"
#include "RefractiveIndexInternals.h"
#include "RefractivityOfImage.h"
#include "RequestGuard.h"
#include "Revolution.h"
#include "SamplingBox.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

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

/// Throws where the arrays of a grid do not fit into memory, with what making them takes for each of its points.
void requireMemoryFor(
  vtkImageData* grid, bool isDouble, std::size_t bytesToMake, const std::string& remedy)
{
  int points[3];
  grid->GetDimensions(points);
  const std::size_t bytes = bytesToMake + 1 + (isDouble ? sizeof(double) : sizeof(float));
  requireMemory(static_cast<double>(bytes) * points[0] * points[1] * points[2],
    "The refractivity on a grid of " + std::to_string(points[0]) + " x " +
      std::to_string(points[1]) + " x " + std::to_string(points[2]) + " points",
    remedy);
}

const char* const fewerPoints =
  "Give smaller SamplingDimensions (zeros: chosen from the data), or SamplingBounds of a part of "
  "the data.";

/// The coordinate axis across the plane of the data; -1: there is none.
int planeOf(const Source& source)
{
  return source.image && !source.image->GetDirectionMatrix()->IsIdentity() ? -1
                                                                           : flatAxisOf(source);
}

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
  : Plan(std::make_shared<GridPlan>())
  , Mesh(std::make_shared<KeptMesh>())
  , Guard(std::make_shared<RequestGuard>())
  , Known(std::make_shared<KnownArrays>())
  , Ranks(std::make_shared<InputsOfRanks>(this))
{
  this->SetNumberOfInputPorts(2);
  // Of vtkImageAlgorithm: the active scalars, whatever these are.
  this->GetInputArrayInformation(DENSITY)->Remove(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractiveIndex::GetMeshBuilds() { return this->Mesh->builds; }

//------------------------------------------------------------------------------
void vtkRefractiveIndex::SetMesh(std::shared_ptr<KeptMesh> mesh) { this->Mesh = std::move(mesh); }

//------------------------------------------------------------------------------
void vtkRefractiveIndex::LeaveMesh()
{
  if (this->Mesh.use_count() > 1)
  {
    const vtkTypeInt64 builds = this->Mesh->builds;
    this->Mesh = std::make_shared<KeptMesh>();
    this->Mesh->builds = builds;
  }
  this->Mesh->release();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractiveIndex::GetGridPlans() { return this->Plan->count; }

//------------------------------------------------------------------------------
vtkMTimeType vtkRefractiveIndex::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkPiecewiseFunction* function : this->TransferFunctions)
  {
    time = std::max(time, function ? function->GetMTime() : 0);
  }
  return time;
}

//------------------------------------------------------------------------------
bool vtkRefractiveIndex::HasArray(int index)
{
  const char* name = this->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME());
  return name && *name && std::string(name) != "None";
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
void vtkRefractiveIndex::ComputeGrid(vtkDataObject* input, vtkImageData* structure)
{
  const Source source = chooseSource(this, input);
  this->FlatAxis = planeOf(source);
  if (this->Symmetry == AXISYMMETRIC)
  {
    gridOf(revolutionOf(this, source), source, this->SamplingDimensions,
      SamplingBox(this->SamplingBounds), structure);
  }
  else if (source.image)
  {
    gridOfImage(source.image, source.leaves[0].ofCells, source.depth, structure);
    SamplingBox(this->SamplingBounds).crop(structure);
  }
  else
  {
    const GridPlan& plan = this->PlanGrid(source, input);
    plan.amr ? gridOf(*plan.amr, structure) : gridOf(plan.resampling, structure);
  }
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::ComputeBox(vtkDataObject* input, vtkImageData* structure)
{
  const Source source = chooseSource(this, input);
  this->FlatAxis = planeOf(source);
  if (this->Symmetry == AXISYMMETRIC)
  {
    boxOf(revolutionOf(this, source), structure);
    return;
  }
  gridOf(boxOf(source), structure);
}

//------------------------------------------------------------------------------
const GridPlan& vtkRefractiveIndex::PlanGrid(const Source& source, vtkDataObject* input)
{
  GridPlan& plan = *this->Plan;
  std::vector<double> key = describeInput(input, this->GetMTime());
  if (plan.key != key)
  {
    plan.key.clear();
    ++plan.count;
    const SamplingBox box(this->SamplingBounds);
    plan.amr = planAmr(source, this->SamplingDimensions, box);
    if (!plan.amr)
    {
      plan.resampling = planResampling(source, this->SamplingDimensions, box);
    }
    plan.key = std::move(key);
  }
  return plan;
}

//------------------------------------------------------------------------------
std::string vtkRefractiveIndex::NewNoteOnGases(const Source& source)
{
  if (source.noteOnGases == this->ToldOfGases)
  {
    return "";
  }
  this->ToldOfGases = source.noteOnGases;
  return source.noteOnGases;
}

//------------------------------------------------------------------------------
std::string vtkRefractiveIndex::NewNoteOnValues(const Source& source)
{
  const Implausible found = implausibleIn(this, source);
  const bool isNew = !found.kind.empty() && found.kind != this->ToldOfValues;
  this->ToldOfValues = found.kind;
  return isNew ? found.text : "";
}

//------------------------------------------------------------------------------
const char* vtkRefractiveIndex::GetArraysUsed()
{
  this->ArraysUsed = choiceOf(this).message;
  return this->ArraysUsed.c_str();
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::FillFromImage(const Source& given, Numbers numbers, vtkDataObject* bodies,
  vtkImageData* output, std::string& warning)
{
  Source source = given;
  this->LeaveMesh();
  if (auto* fields = std::get_if<FieldMean>(&source.model))
  {
    fields->findRanges(source.leaves);
  }
  gridOfImage(source.image, source.leaves[0].ofCells, source.depth, output);
  requireMemoryFor(output, this->DoublePrecision, 0, "Use a coarser input.");
  const Tally tally = convertImage(source, numbers, output);
  SamplingBox(this->SamplingBounds).crop(output);
  warning = warningFrom(source.model, tally);
  if (bodies)
  {
    vtkNew<vtkImageData> refractivity;
    refractivity->ShallowCopy(output);
    mergeMasks(refractivity);
    const ImageSource withBodies(refractivity, bodies, vtkSMPTools::GetEstimatedNumberOfThreads(),
      progressOf(this).part(0.5, 0.7));
    if (!withBodies.meetsBodies() || !maskWalls(withBodies, progressOf(this).part(0.7, 1), output))
    {
      addText(warning, bodiesAreOutside);
    }
  }
  addText(warning, this->NewNoteOnValues(source));
  addText(warning, this->NewNoteOnGases(source));
  const int flat = flatAxisOf(source);
  addText(warning, flat < 0 ? noteOnWedge(this, source) : warningOfExtrusion(source, flat));
}

//------------------------------------------------------------------------------
void vtkRefractiveIndex::FillFromSource(const Source& source, vtkDataObject* input, Numbers numbers,
  vtkDataObject* bodies, vtkImageData* output, std::string& warning, std::string& note)
{
  if (this->Symmetry == AXISYMMETRIC)
  {
    note = "of the body of revolution";
    gridOf(revolutionOf(this, source), source, this->SamplingDimensions,
      SamplingBox(this->SamplingBounds), output);
  }
  else
  {
    const GridPlan& plan = this->PlanGrid(source, input);
    note = plan.amr ? plan.amr->note : plan.resampling.note;
    plan.amr ? gridOf(*plan.amr, output) : gridOf(plan.resampling, output);
  }
  constexpr std::size_t bytesToFill = sizeof(double) + 3;
  requireMemoryFor(output, this->DoublePrecision, bytesToFill, fewerPoints);
  const auto made = this->MakeSourceOfCells(input, bodies, warning);
  if (!made)
  {
    throw Stopped();
  }
  fillGrid(*made, numbers, bodies != nullptr, progressOf(this).part(0.5, 1), output);
}

//------------------------------------------------------------------------------
std::string vtkRefractiveIndex::Convert(
  vtkDataObject* input, vtkImageData* output, vtkDataObject* bodies, ConvertedValues values)
{
  output->Initialize();
  this->Grid.clear();
  const Source source = chooseSource(this, input);
  this->UpdateProgress(0.05);
  if (this->GetAbortExecute())
  {
    return "";
  }

  const Numbers numbers = this->DoublePrecision ? Numbers::Doubles
    : values == DIFFERENCES                     ? Numbers::Differences
                                                : Numbers::Singles;
  this->FlatAxis = planeOf(source);
  std::string warning, note = "the data's own";
  try
  {
    vtkSMPTools::LocalScope(loopsWith(threadsOf(this)),
      [&]
      {
        source.image&& this->Symmetry == NO_SYMMETRY
          ? this->FillFromImage(source, numbers, bodies, output, warning)
          : this->FillFromSource(source, input, numbers, bodies, output, warning, note);
      });
  }
  catch (const Stopped&)
  {
    output->Initialize();
    return "";
  }
  const unsigned char* valid =
    vtkUnsignedCharArray::SafeDownCast(output->GetPointData()->GetArray(maskName))->GetPointer(0);
  if (std::none_of(
        valid, valid + output->GetNumberOfPoints(), [](unsigned char v) { return v != 0; }))
  {
    throw std::runtime_error(bodies ? bodiesCoverAll : noGas(source));
  }

  int dimensions[3];
  output->GetDimensions(dimensions);
  this->Grid = std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) + " x " +
    std::to_string(dimensions[2]) + " points: " + note;
  vtkDebugMacro(<< "Refractivity from the " << source.label << " on " << this->Grid);
  vtkNew<vtkIntArray> used;
  used->SetName("SamplingDimensions");
  used->SetNumberOfComponents(3);
  used->InsertNextTypedTuple(dimensions);
  output->GetFieldData()->AddArray(used);
  return warning;
}

//------------------------------------------------------------------------------
int vtkRefractiveIndex::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);

  vtkNew<vtkImageData> grid;
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
      gridOfImage(whole, willReadCells(this, input), this->Depth, grid);
      SamplingBox(this->SamplingBounds).crop(grid);
    }
    else
    {
      this->ComputeGrid(input, grid);
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
  inputsOfRanks.setOwn(
    vtkDataObject::GetData(inputVector[0]), vtkDataObject::GetData(inputVector[BODIES]));
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
    const std::string warning = this->Convert(inputs.data, output, inputs.bodies);
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
    if (this->GetAbortExecute())
    {
      this->FailedAt = this->GetTimeOfGrid(); // further requests need not wait again
      return;
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
