// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/ExposureSteps.h"

#include "Common/NumberText.h"

#include "Ranks/BetweenTimeSteps.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <sstream>
#include <stdexcept>

namespace filters
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// Updates the filters upstream of all inputs. Returns false if one of them has failed.
bool updateInputs(vtkAlgorithm* filter)
{
  bool areThere = true;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    if (filter->GetNumberOfInputConnections(port) > 0)
    {
      auto* upstream = Pipeline::SafeDownCast(filter->GetInputExecutive(port, 0));
      vtkAlgorithmOutput* from = filter->GetInputConnection(port, 0);
      areThere = upstream && upstream->Update(from->GetIndex()) && areThere;
    }
  }
  return areThere;
}

/// Sets the time of the outputs, which the pipeline otherwise copies from the input.
void setTime(vtkInformationVector* outputs, double time)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject::GetData(outputs, port)
      ->GetInformation()
      ->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
}

/// Returns a shallow copy, which keeps the arrays while upstream makes others; null for null.
vtkSmartPointer<vtkDataObject> sharedCopy(vtkDataObject* data)
{
  if (!data)
  {
    return nullptr;
  }
  auto copy = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  copy->ShallowCopy(data);
  return copy;
}

} // namespace

//------------------------------------------------------------------------------
TimeExposure exposureFor(vtkInformation* input, vtkInformation* output, double length, int samples)
{
  std::vector<double> steps;
  double range[2] = { 0, 0 };
  if (input->Has(Pipeline::TIME_STEPS()))
  {
    const double* times = input->Get(Pipeline::TIME_STEPS());
    steps.assign(times, times + input->Length(Pipeline::TIME_STEPS()));
  }
  if (!steps.empty())
  {
    range[0] = steps.front();
    range[1] = steps.back();
  }
  else if (input->Has(Pipeline::TIME_RANGE()))
  {
    input->Get(Pipeline::TIME_RANGE(), range);
  }
  if (!(length > 0) || !(range[0] < range[1]) || !output->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    return {};
  }
  return TimeExposure(
    steps, range[0], range[1], output->Get(Pipeline::UPDATE_TIME_STEP()), length, samples);
}

//------------------------------------------------------------------------------
void requestTime(vtkAlgorithm* filter, vtkInformationVector** inputs, double time)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    if (vtkInformation* inInfo = inputs[port]->GetInformationObject(0))
    {
      inInfo->Set(Pipeline::UPDATE_TIME_STEP(), time);
    }
  }
}

//------------------------------------------------------------------------------
ExposureSteps::ExposureSteps(vtkAlgorithm* filter, MediumMaker& maker, InputsOfRanks& ranks,
  vtkInformationVector** inputs, vtkInformationVector* outputs, const TimeExposure& exposure,
  double maxCells)
  : Filter(filter)
  , Maker(maker)
  , Ranks(ranks)
  , Inputs(inputs)
  , Outputs(outputs)
  , Exposure(exposure)
  , MaxCells(maxCells)
{
  this->SetOwn();
}

//------------------------------------------------------------------------------
ExposureSteps::~ExposureSteps()
{
  while (hasOtherRanks() && this->Resume())
  {
  }
  this->Ranks.forgetOwn();
  if (this->Exposure.IsNone())
  {
    return;
  }
  // Restores the first request, so that the next one does not differ from it.
  requestTime(this->Filter, this->Inputs, this->Exposure.Steps.front());
  requestPieces(this->Filter, this->Inputs);
  setTime(this->Outputs, this->Exposure.Time);
}

//------------------------------------------------------------------------------
void ExposureSteps::SetOwn()
{
  this->Ranks.setOwn(this->Maker, vtkDataObject::GetData(this->Inputs[0]),
    vtkDataObject::GetData(this->Inputs[1]),
    [this](int instant)
    { return this->GetData(0, this->Exposure.Instants.at(static_cast<std::size_t>(instant))); });
}

//------------------------------------------------------------------------------
bool ExposureSteps::Resume()
{
  if (this->Step + 1 >= this->Exposure.Steps.size())
  {
    return false;
  }
  this->Ranks.ranks().end({ false, false }); // ends the work of other ranks, too
  ++this->Step;
  requestTime(this->Filter, this->Inputs, this->Exposure.Steps[this->Step]);
  requestPieces(this->Filter, this->Inputs);
  this->Problem.clear();
  if (!updateInputs(this->Filter))
  {
    this->Problem = "There are no data of the time step " +
      textOf(this->Exposure.Steps[this->Step]) +
      ", which is within ExposureTime: see what is reported before. Repair that step, or set "
      "ExposureTime to 0.";
  }
  try
  {
    this->Ranks.begin(this->Filter, this->Inputs, true, this->Problem);
  }
  catch (const std::exception& problem)
  {
    this->Problem = problem.what();
  }
  this->SetOwn();
  return true;
}

//------------------------------------------------------------------------------
void ExposureSteps::Keep()
{
  if (!this->IsThere())
  {
    throw std::runtime_error(this->Problem);
  }
  const InputsOfRanks::Inputs inputs = this->Ranks.gather(this->MaxCells);
  this->Keep(0, inputs.data);
  this->Keep(1, inputs.bodies);
}

//------------------------------------------------------------------------------
void ExposureSteps::KeepPiece() { this->Keep(0, vtkDataObject::GetData(this->Inputs[0])); }

//------------------------------------------------------------------------------
void ExposureSteps::Keep(int port, vtkDataObject* data)
{
  this->Earlier[port] = this->Later[port];
  this->Later[port] = sharedCopy(data);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> ExposureSteps::GetData(
  int port, const TimeExposure::Instant& instant) const
{
  if (instant.earlier == instant.later)
  {
    return this->Later[port];
  }
  try
  {
    return betweenTimeSteps(this->Earlier[port], this->Later[port], instant.ratio);
  }
  catch (const std::runtime_error& difference)
  {
    const std::vector<double>& steps = this->Exposure.Steps;
    throw std::runtime_error("There are no data between the time steps " +
      textOf(steps[instant.earlier]) + " and " + textOf(steps[instant.later]) +
      ", which ExposureTime needs: " + difference.what() +
      ". Set ExposureTime to 0, or give data with the same cells at all times, as Resample To "
      "Image makes them.");
  }
}

} // namespace filters
