// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSchlierenSliceRepresentation.h"

#include "vtkSchlierenLegend.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPVImageSliceMapper.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"

#include <string>

namespace
{

/// Returns how a mapper draws an image.
vtkSchlierenLegend::Painting paintingOf(vtkPVImageSliceMapper* mapper)
{
  const std::string array =
    mapper->GetScalarVisibility() && mapper->GetArrayName() ? mapper->GetArrayName() : "";
  const bool isMapped = mapper->GetColorMode() == VTK_COLOR_MODE_MAP_SCALARS;
  vtkSchlierenLegend::Painting painting;
  painting.IsLight = array == "Intensity" || (array == "Color" && !isMapped);
  painting.Map = array == "Intensity" ? mapper->GetLookupTable() : nullptr;
  return painting;
}

} // namespace

vtkStandardNewMacro(vtkSchlierenSliceRepresentation);

vtkSchlierenSliceRepresentation::vtkSchlierenSliceRepresentation() = default;

vtkSchlierenSliceRepresentation::~vtkSchlierenSliceRepresentation() = default;

void vtkSchlierenSliceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Legend->PrintSelf(os, indent);
}

void vtkSchlierenSliceRepresentation::SetLegend(bool isShown)
{
  this->HasLegend = isShown;
  this->ShowOrHideLegend();
}

void vtkSchlierenSliceRepresentation::SetLegendCorner(int corner)
{
  this->Legend->SetCorner(corner);
}

void vtkSchlierenSliceRepresentation::SetVisibility(bool isVisible)
{
  this->Superclass::SetVisibility(isVisible);
  this->ShowOrHideLegend();
}

void vtkSchlierenSliceRepresentation::ShowOrHideLegend()
{
  this->Legend->SetVisibility(this->HasLegend && this->GetVisibility());
}

bool vtkSchlierenSliceRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (renderView)
  {
    renderView->GetRenderer()->AddViewProp(this->Legend);
  }
  return this->Superclass::AddToView(view);
}

bool vtkSchlierenSliceRepresentation::RemoveFromView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (renderView)
  {
    renderView->GetRenderer()->RemoveViewProp(this->Legend);
  }
  return this->Superclass::RemoveFromView(view);
}

int vtkSchlierenSliceRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  if (!this->Superclass::ProcessViewRequest(request, input, output))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_RENDER())
  {
    vtkAlgorithmOutput* delivered = vtkPVRenderView::GetPieceProducer(input, this);
    this->Legend->SetImage(delivered
        ? vtkImageData::SafeDownCast(
            delivered->GetProducer()->GetOutputDataObject(delivered->GetIndex()))
        : nullptr,
      paintingOf(this->SliceMapper));
  }
  return 1;
}
