// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "NextStep.h"

#include "ExposureSteps.h"
#include "InputDescription.h"
#include "SharedRefractivity.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <system_error>

namespace filters
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

bool isOf(const std::optional<TimeStep>& step, double time) { return step && step->time == time; }

/// Which part of the inputs is requested.
std::vector<int> requestedPieces(vtkAlgorithm* filter, vtkInformationVector** inputs)
{
  std::vector<int> pieces;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    if (vtkInformation* inInfo = inputs[port]->GetInformationObject(0))
    {
      pieces.push_back(inInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()));
      pieces.push_back(inInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
    }
  }
  return pieces;
}

} // namespace

//------------------------------------------------------------------------------
bool NextStep::IsValid(vtkAlgorithm* filter) const
{
  return this->UpstreamTime == upstreamTime(filter);
}

//------------------------------------------------------------------------------
void NextStep::Request(vtkAlgorithm* filter, vtkInformationVector** inputs, double time)
{
  this->HasRequested = this->IsValid(filter) && this->Pieces == requestedPieces(filter, inputs) &&
    (isOf(this->This, time) || isOf(this->Next, time));
  if (!this->HasRequested)
  {
    return;
  }
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* inInfo = inputs[port]->GetInformationObject(0);
    vtkDataObject* data = inInfo ? vtkDataObject::GetData(inInfo) : nullptr;
    if (data && data->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP()))
    {
      inInfo->Set(
        Pipeline::UPDATE_TIME_STEP(), data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()));
    }
  }
}

//------------------------------------------------------------------------------
TimeStep& NextStep::Arrive(vtkAlgorithm* filter, double time, vtkInformationVector** inputs)
{
  if (this->HasRequested && isOf(this->This, time))
  {
    return *this->This;
  }
  if (this->This && this->This->time != time)
  {
    this->Before = this->This->time;
  }
  if (this->HasRequested && isOf(this->Next, time))
  {
    this->This = std::move(this->Next);
  }
  else
  {
    this->This = TimeStep{ time, sharedCopy(vtkDataObject::GetData(inputs[0])),
      sharedCopy(vtkDataObject::GetData(inputs[1])), nullptr, nullptr };
  }
  this->Next.reset();
  this->UpstreamTime = upstreamTime(filter);
  this->Pieces = requestedPieces(filter, inputs);
  return *this->This;
}

//------------------------------------------------------------------------------
const TimeStep* NextStep::Current(vtkAlgorithm* filter) const
{
  return this->This && this->IsValid(filter) ? &*this->This : nullptr;
}

//------------------------------------------------------------------------------
std::optional<double> NextStep::Predict(vtkInformation* input) const
{
  if (!this->This || !this->IsKeepable || !input->Has(Pipeline::TIME_STEPS()))
  {
    return {};
  }
  const double* begin = input->Get(Pipeline::TIME_STEPS());
  const double* end = begin + input->Length(Pipeline::TIME_STEPS());
  const double* now = std::find(begin, end, this->This->time);
  if (now == end)
  {
    return {};
  }
  const double* before = this->Before ? std::find(begin, end, *this->Before) : end;
  const std::ptrdiff_t next = now - begin + (before == end ? 1 : now - before);
  if (next < 0 || next >= end - begin || isOf(this->Next, begin[next]))
  {
    return {};
  }
  return begin[next];
}

//------------------------------------------------------------------------------
const TimeStep* NextStep::Read(vtkAlgorithm* filter, vtkInformationVector** inputs, double time)
{
  this->Next.reset();
  requestTime(filter, inputs, time);
  const bool isThere = updateInputs(filter);
  this->IsKeepable = this->IsValid(filter);
  if (isThere && this->IsKeepable)
  {
    this->Next = TimeStep{ time, sharedCopy(vtkDataObject::GetData(inputs[0])),
      sharedCopy(vtkDataObject::GetData(inputs[1])), nullptr, nullptr };
  }
  requestTime(filter, inputs, this->This->time);
  return this->GetNext();
}

//------------------------------------------------------------------------------
void NextStep::Release() { *this = NextStep(); }

//------------------------------------------------------------------------------
schlieren::Image traceWhile(const std::function<void()>& read,
  const std::function<schlieren::Image(const schlieren::Monitor&)>& trace,
  const schlieren::Monitor& monitor)
{
  std::atomic<bool> isAborted{ false };
  std::atomic<double> done{ 0 };
  schlieren::Monitor ofThread;
  ofThread.aborted = [&] { return isAborted.load(); };
  ofThread.progress = [&](double fraction) { done = fraction; };
  std::future<schlieren::Image> image; // its destructor waits
  try
  {
    image = std::async(std::launch::async, trace, ofThread);
  }
  catch (const std::system_error&) // the system gives no more threads
  {
    read();
    return trace(monitor);
  }
  read();
  do
  {
    monitor.progress(done);
    isAborted = monitor.aborted();
  } while (image.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready);
  return image.get();
}

} // namespace filters
