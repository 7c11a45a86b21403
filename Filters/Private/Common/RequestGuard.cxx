// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/RequestGuard.h"

#include "Common/Guarded.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <utility>

namespace filters
{

//------------------------------------------------------------------------------
int RequestGuard::Process(
  vtkInformation* request, const std::function<int()>& work, const char* noMemory, const Fail& fail)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  int result = 1;
  if (request->Has(Pipeline::REQUEST_DATA()))
  {
    guarded([&] { result = work(); }, noMemory, fail);
    return result;
  }
  if (request->Has(Pipeline::REQUEST_DATA_OBJECT()))
  {
    this->Earlier = nullptr;
  }
  try
  {
    result = work();
  }
  catch (const std::exception&)
  {
    this->Earlier = std::current_exception();
  }
  return result;
}

//------------------------------------------------------------------------------
void RequestGuard::ThrowEarlier()
{
  if (const std::exception_ptr earlier = std::exchange(this->Earlier, nullptr))
  {
    std::rethrow_exception(earlier);
  }
}

} // namespace filters
