// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenPipeline.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkSchlierenFilter.h"

vtkStandardNewMacro(vtkSchlierenPipeline);

int vtkSchlierenPipeline::ForwardUpstream(vtkInformation* request)
{
  const int result = this->Superclass::ForwardUpstream(request);
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (result != 0 || !controller || controller->GetNumberOfProcesses() == 1 ||
    request->Has(REQUEST_DATA_OBJECT()))
  {
    return result;
  }
  if (request->Has(REQUEST_DATA()))
  {
    if (auto* filter = vtkSchlierenFilter::SafeDownCast(this->Algorithm))
    {
      filter->LackInput();
    }
  }
  return 1;
}
