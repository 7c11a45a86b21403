// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Fixtures.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <functional>
#include <vector>

/// Data that change with time: what `make` makes of one.
class Changing : public vtkAlgorithm
{
public:
  static Changing* New();
  vtkTypeMacro(Changing, vtkAlgorithm);

  std::function<vtkSmartPointer<vtkDataObject>(double time)> make;
  std::vector<double> steps;
  std::vector<double> requested; ///< of all requests for data

protected:
  using Pipeline = vtkStreamingDemandDrivenPipeline;

  Changing()
  {
    this->SetNumberOfInputPorts(0);
    this->SetNumberOfOutputPorts(1);
  }

  int FillOutputPortInformation(int, vtkInformation* info) override
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
    return 1;
  }

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
    {
      const auto example = this->make(1);
      vtkDataObject* output = vtkDataObject::GetData(info);
      if (!output || !output->IsA(example->GetClassName()))
      {
        auto fresh = vtkSmartPointer<vtkDataObject>::Take(example->NewInstance());
        info->Set(vtkDataObject::DATA_OBJECT(), fresh);
      }
    }
    else if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
    {
      info->Set(Pipeline::TIME_STEPS(), this->steps.data(), static_cast<int>(this->steps.size()));
      const double range[2] = { this->steps.front(), this->steps.back() };
      info->Set(Pipeline::TIME_RANGE(), range, 2);
      const auto example = this->make(1);
      if (auto* image = vtkImageData::SafeDownCast(example))
      {
        info->Set(Pipeline::WHOLE_EXTENT(), image->GetExtent(), 6);
      }
    }
    else if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
    {
      double time = info->Get(Pipeline::UPDATE_TIME_STEP());
      this->requested.push_back(time);
      // As readers do.
      const auto after = std::upper_bound(this->steps.begin(), this->steps.end(), time);
      time = after == this->steps.begin() ? this->steps.front() : *(after - 1);
      vtkDataObject* output = vtkDataObject::GetData(info);
      output->ShallowCopy(this->make(time));
      output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    }
    return 1;
  }
};

inline vtkStandardNewMacro(Changing);
