// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Fixtures.h"

#include "vtkImageAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

/// A column that is 1, 2 and 3 times as strong at the times 0, 1 and 2.
class Series : public vtkImageAlgorithm
{
public:
  static Series* New();
  vtkTypeMacro(Series, vtkImageAlgorithm);

protected:
  Series() { this->SetNumberOfInputPorts(0); }

  using Pipeline = vtkStreamingDemandDrivenPipeline;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double times[] = { 0, 1, 2 };
    info->Set(Pipeline::TIME_STEPS(), times, 3);
    const double range[] = { 0, 2 };
    info->Set(Pipeline::TIME_RANGE(), range, 2);
    auto image = cube(points);
    info->Set(Pipeline::WHOLE_EXTENT(), image->GetExtent(), 6);
    info->Set(vtkDataObject::ORIGIN(), image->GetOrigin(), 3);
    info->Set(vtkDataObject::SPACING(), image->GetSpacing(), 3);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double time =
      info->Has(Pipeline::UPDATE_TIME_STEP()) ? info->Get(Pipeline::UPDATE_TIME_STEP()) : 0;
    auto image = cube(points);
    addPointArray(image, "N",
      [time, column = GaussianColumn()](const Vec& x) { return (1 + time) * column(x); });
    vtkImageData::GetData(outputs)->ShallowCopy(image);
    return 1;
  }

private:
  static constexpr int points = 24;
};

inline vtkStandardNewMacro(Series);
