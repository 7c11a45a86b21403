// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenRepresentation.h"

#include "vtkSchlierenActor.h"
#include "vtkSchlierenFilter.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkSchlierenRepresentation);

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// vtkPVView knows whether it is rendered for a screenshot, but tells only those derived from it.
struct Captured : vtkPVView
{
  static bool Is(vtkPVView* view) { return (view->*(&Captured::GetInCaptureScreenshot))(); }
};

vtkRenderer* rendererOf(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  return renderView ? renderView->GetRenderer() : nullptr;
}

/// This process and how many there are.
std::pair<int, int> ranks()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller
    ? std::make_pair(controller->GetLocalProcessId(), controller->GetNumberOfProcesses())
    : std::make_pair(0, 1);
}

} // namespace

//------------------------------------------------------------------------------
vtkSchlierenRepresentation::vtkSchlierenRepresentation()
{
  vtkMath::UninitializeBounds(this->Bounds);
  this->Actor->SetHasOtherRanks(ranks().second > 1);
}

//------------------------------------------------------------------------------
vtkSchlierenRepresentation::~vtkSchlierenRepresentation() = default;

//------------------------------------------------------------------------------
void vtkSchlierenRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Actor->PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
void vtkSchlierenRepresentation::SetBench(vtkObject* bench)
{
  this->Actor->SetBench(vtkSchlierenFilter::SafeDownCast(bench));
  this->MarkModified();
}

//------------------------------------------------------------------------------
void vtkSchlierenRepresentation::SetTimeSlice(double seconds)
{
  this->Actor->SetTimeSlice(std::max(0., seconds));
}

//------------------------------------------------------------------------------
bool vtkSchlierenRepresentation::GetFinished()
{
  return !this->GetVisibility() || this->Actor->GetFinished();
}

//------------------------------------------------------------------------------
int vtkSchlierenRepresentation::GetReduction() { return this->Actor->GetReduction(); }

//------------------------------------------------------------------------------
void vtkSchlierenRepresentation::SetVisibility(bool isVisible)
{
  this->Superclass::SetVisibility(isVisible);
  this->Actor->SetVisibility(isVisible);
}

//------------------------------------------------------------------------------
int vtkSchlierenRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
// The same as the bench requests, so that nothing upstream runs twice.
int vtkSchlierenRepresentation::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  this->Superclass::RequestUpdateExtent(request, input, output);
  vtkSchlierenFilter* bench = this->Actor->GetBench();
  for (int i = 0; bench && i < input[0]->GetNumberOfInformationObjects(); ++i)
  {
    bench->RequestSame(input[0]->GetInformationObject(i));
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkSchlierenRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkMath::UninitializeBounds(this->Bounds);
  vtkSchlierenFilter* bench = this->Actor->GetBench();
  vtkRenderer* renderer = rendererOf(this->GetView());
  if (bench && renderer && input[0]->GetNumberOfInformationObjects() == 1)
  {
    vtkDataObject* data = vtkDataObject::GetData(input[0], 0);
    if (auto* one = vtkDataSet::SafeDownCast(data))
    {
      one->GetBounds(this->Bounds);
    }
    else if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
    {
      blocks->GetBounds(this->Bounds);
    }
    bench->SetInputConnection(0, this->GetInputConnection(0, 0));
    this->PassTimeToBench();
    this->Actor->UpdateImage(renderer);
  }
  return this->Superclass::RequestData(request, input, output);
}

//------------------------------------------------------------------------------
void vtkSchlierenRepresentation::PassTimeToBench()
{
  if (this->UpdateTimeValid)
  {
    this->Actor->GetBench()->GetOutputInformation(0)->Set(
      Pipeline::UPDATE_TIME_STEP(), this->UpdateTime);
  }
}

//------------------------------------------------------------------------------
bool vtkSchlierenRepresentation::AddToView(vtkView* view)
{
  vtkRenderer* renderer = rendererOf(view);
  if (renderer)
  {
    this->Actor->AddTo(renderer);
  }
  return renderer && this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkSchlierenRepresentation::RemoveFromView(vtkView* view)
{
  vtkRenderer* renderer = rendererOf(view);
  if (renderer)
  {
    this->Actor->RemoveFrom(renderer);
  }
  return renderer && this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
int vtkSchlierenRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  // For ParaView, what is not an input cannot change what is drawn of the data.
  if (request == vtkPVView::REQUEST_UPDATE() && this->Actor->IsChanged())
  {
    this->MarkModified();
  }
  if (!this->Superclass::ProcessViewRequest(request, input, output))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->Actor->ClearBounds();
    vtkPVRenderView::SetPiece(input, this, this->Nothing);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(input, this, false, false);
    vtkPVRenderView::SetGeometryBounds(input, this, this->Bounds);
    vtkPVRenderView::SetRequiresDistributedRendering(input, this, true);
    vtkPVRenderView::SetStreamable(input, this, true);
  }
  else if (request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    vtkPVRenderView::SetRequiresDistributedRenderingLOD(input, this, true);
  }
  else if (request == vtkPVRenderView::REQUEST_STREAMING_UPDATE())
  {
    if (this->Actor->Refine())
    {
      vtkPVRenderView::SetNextStreamedPiece(input, this, this->Nothing);
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER() && this->Actor->GetBench())
  {
    this->PassTimeToBench();
    if (ranks().second > 1)
    {
      this->Actor->SetFillsView(rendererOf(this->GetView()));
    }
    this->Actor->SetIsForScreenshot(Captured::Is(vtkPVView::SafeDownCast(this->GetView())));
  }
  return 1;
}
