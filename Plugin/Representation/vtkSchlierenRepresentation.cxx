// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenRepresentation.h"

#include "Guarded.h"
#include "vtkSchlierenActor.h"
#include "vtkSchlierenFilter.h"
#include "vtkSchlierenLegend.h"

#include "vtkBoundingBox.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPVSession.h"
#include "vtkPolyData.h"
#include "vtkProcessModule.h"
#include "vtkRenderer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkSchlierenRepresentation);

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// Reads the protected flag of vtkPVView for screenshots.
struct Captured : vtkPVView
{
  static bool Is(vtkPVView* view) { return (view->*(&Captured::GetInCaptureScreenshot))(); }
};

/// Returns whether processes with data can draw, too.
bool canServerDraw(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  return renderView && renderView->GetRemoteRenderingAvailable();
}

vtkRenderer* rendererOf(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  return renderView ? renderView->GetRenderer() : nullptr;
}

/// Returns this rank and the number of ranks.
std::pair<int, int> ranks()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller
    ? std::make_pair(controller->GetLocalProcessId(), controller->GetNumberOfProcesses())
    : std::make_pair(0, 1);
}

} // namespace

vtkSchlierenRepresentation::vtkSchlierenRepresentation()
{
  vtkMath::UninitializeBounds(this->Bounds);
  this->Actor->SetHasOtherRanks(ranks().second > 1);
}

vtkSchlierenRepresentation::~vtkSchlierenRepresentation() = default;

void vtkSchlierenRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Actor->PrintSelf(os, indent);
}

void vtkSchlierenRepresentation::SetBench(vtkObject* bench)
{
  this->Actor->SetBench(vtkSchlierenFilter::SafeDownCast(bench));
  this->MarkModified();
}

void vtkSchlierenRepresentation::SetTimeSlice(double seconds)
{
  this->Actor->SetTimeSlice(std::max(0., seconds));
}

bool vtkSchlierenRepresentation::GetFinished()
{
  return !this->GetVisibility() || this->Actor->GetFinished();
}

int vtkSchlierenRepresentation::GetReduction() { return this->Actor->GetReduction(); }

void vtkSchlierenRepresentation::SetVisibility(bool isVisible)
{
  this->Superclass::SetVisibility(isVisible);
  this->Actor->SetVisibility(isVisible);
  this->ShowOrHideLegend();
}

void vtkSchlierenRepresentation::ShowOrHideLegend()
{
  this->Actor->GetLegend()->SetVisibility(this->HasLegend && this->GetVisibility());
}

void vtkSchlierenRepresentation::SetLegend(bool isShown)
{
  this->HasLegend = isShown;
  this->ShowOrHideLegend();
}

void vtkSchlierenRepresentation::SetLegendCorner(int corner)
{
  this->Actor->GetLegend()->SetCorner(corner);
}

int vtkSchlierenRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

// Requests the same as the bench, so that upstream filters run once.
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
    this->IncludeMedium();
  }
  return this->Superclass::RequestData(request, input, output);
}

void vtkSchlierenRepresentation::IncludeMedium()
{
  constexpr double rounding = 0.05; // by voxels
  double bounds[6];
  this->Actor->GetBench()->GetMediumBounds(bounds);
  const vtkBoundingBox medium(bounds), data(this->Bounds);
  if (medium.IsValid() && data.IsValid() &&
    medium.GetDiagonalLength() > (1 + rounding) * data.GetDiagonalLength())
  {
    medium.GetBounds(this->Bounds);
  }
}

void vtkSchlierenRepresentation::PassTimeToBench()
{
  if (this->UpdateTimeValid)
  {
    this->Actor->GetBench()->GetOutputInformation(0)->Set(
      Pipeline::UPDATE_TIME_STEP(), this->UpdateTime);
  }
}

void vtkSchlierenRepresentation::TellIfHidden()
{
  const bool wasHidden = this->IsHidden;
  vtkRenderer* renderer = rendererOf(this->GetView());
  this->IsHidden = renderer && this->GetVisibility() && this->Actor->IsHidden(renderer);
  if (this->IsHidden && !wasHidden && this->Actor->GetBench() && ranks().first == 0)
  {
    vtkErrorMacro(<< "Two flows are to be shown as Schlieren in one view, which shows that of the "
                     "one that was there "
                     "first: light would have to pass through both. Hide one, or make them one by "
                     "Append Datasets or "
                     "Group Datasets.");
  }
}

void vtkSchlierenRepresentation::TellIfServerCannotDraw()
{
  auto* session = vtkPVSession::SafeDownCast(vtkProcessModule::GetProcessModule()->GetSession());
  const bool isClient = session && !(session->GetProcessRoles() & vtkPVSession::DATA_SERVER);
  const bool isToTell = isClient && this->GetVisibility() && !canServerDraw(this->GetView());
  if (isToTell && !this->HasToldOfServer)
  {
    vtkErrorMacro(
      << "The server cannot draw, so it does not show the flow as Schlieren, whose image is made "
         "where views are drawn. Start it with a display, such as "
         "'xvfb-run -a -s -noreset pvserver', or take a pvserver that was built with EGL or "
         "OSMesa. Or use the filter Schlieren, which works without.");
  }
  this->HasToldOfServer = isToTell;
}

bool vtkSchlierenRepresentation::AddToView(vtkView* view)
{
  vtkRenderer* renderer = rendererOf(view);
  if (renderer)
  {
    this->Actor->AddTo(renderer);
  }
  return renderer && this->Superclass::AddToView(view);
}

bool vtkSchlierenRepresentation::RemoveFromView(vtkView* view)
{
  vtkRenderer* renderer = rendererOf(view);
  if (renderer)
  {
    this->Actor->RemoveFrom(renderer);
  }
  return renderer && this->Superclass::RemoveFromView(view);
}

int vtkSchlierenRepresentation::Guarded(const std::function<int()>& work)
{
  int result = 1;
  filters::guarded([&] { result = work(); },
    "There is not enough memory to show the flow as Schlieren.",
    [this](const std::string& problem) { vtkErrorMacro(<< problem); });
  return result;
}

vtkTypeBool vtkSchlierenRepresentation::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  return this->Guarded([&] { return this->Superclass::ProcessRequest(request, input, output); });
}

int vtkSchlierenRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  return this->Guarded([&] { return this->RespondToView(request, input, output); });
}

int vtkSchlierenRepresentation::RespondToView(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  // Reports changes of properties, of which ParaView does not expect another drawing.
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
    this->TellIfHidden();
    this->Actor->ClearBounds();
    vtkPVRenderView::SetPiece(input, this, this->Nothing);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(input, this, false, false);
    vtkPVRenderView::SetGeometryBounds(input, this, this->Bounds);
    vtkPVRenderView::SetRequiresDistributedRendering(input, this, canServerDraw(this->GetView()));
    this->TellIfServerCannotDraw();
    vtkPVRenderView::SetStreamable(input, this, true);
  }
  else if (request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    vtkPVRenderView::SetRequiresDistributedRenderingLOD(
      input, this, canServerDraw(this->GetView()));
  }
  else if (request == vtkPVRenderView::REQUEST_STREAMING_UPDATE())
  {
    if (this->Actor->Refine())
    {
      vtkPVRenderView::SetNextStreamedPiece(input, this, this->Nothing);
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    if (this->Actor->GetBench())
    {
      this->PassTimeToBench();
    }
    if (this->Actor->GetBench() && ranks().second > 1)
    {
      this->Actor->SetFillsView(rendererOf(this->GetView()));
    }
    this->Actor->SetIsForScreenshot(Captured::Is(vtkPVView::SafeDownCast(this->GetView())));
  }
  return 1;
}
