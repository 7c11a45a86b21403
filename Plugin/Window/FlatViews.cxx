// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlatViews.h"

#include "HeldInput.h"
#include "ImageDisplay.h"
#include "ImagesInViews.h"
#include "UndoStep.h"
#include "ViewsBeside.h"
#include "pqPhotographPoints.h"

#include "pqActiveObjects.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqRenderView.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVRenderView.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

#include <cstring>
#include <vector>

namespace
{

using Controller = vtkSMParaViewPipelineControllerWithRendering;

/// Adapts a view to the image of a filter.
void flatten(vtkSMProxy* view)
{
  const auto set = [view](const char* name, int value)
  { vtkSMPropertyHelper(view, name).Set(value); };
  set("InteractionMode", vtkPVRenderView::INTERACTION_MODE_2D);
  set("CameraParallelProjection", 1);
  set("OrientationAxesVisibility", 0);
  set("CenterAxesVisibility", 0);
  set("UseFXAA", 0); // FXAA would blur edges in the image
  set("UseColorPaletteForBackground", 0);
  const double darkGrey[3] = { 0.2, 0.2, 0.2 };
  vtkSMPropertyHelper(view, "Background").Set(darkGrey, 3);
  view->UpdateVTKObjects();
}

/// Returns the render view in which the image of a filter is visible; null if there is none.
pqRenderView* viewWith(pqPipelineSource* filter)
{
  for (pqDataRepresentation* shown : filter->getRepresentations(0, nullptr))
  {
    if (auto* view = qobject_cast<pqRenderView*>(shown->isVisible() ? shown->getView() : nullptr))
    {
      return view;
    }
  }
  return nullptr;
}

void hide(pqPipelineSource* filter, pqRenderView* view)
{
  if (view)
  {
    vtkNew<Controller>()->Hide(filter->getSourceProxy(), 0, view->getViewProxy());
  }
}

/// Shows an image in a view that looks onto it. Returns its representation.
vtkSMProxy* showFlat(pqOutputPort* image, pqRenderView* view)
{
  vtkSMRenderViewProxy* window = view->getRenderViewProxy();
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", window);
    flatten(window);
  }
  vtkSMProxy* representation = vtkNew<Controller>()->Show(
    image->getSource()->getSourceProxy(), image->getPortNumber(), window);
  if (auto* shown = vtkSMPVRepresentationProxy::SafeDownCast(representation))
  {
    shown->SetScalarBarVisibility(window, false);
    // Avoids the outline that ParaView shows without data.
    vtkSMPropertyHelper type(representation, "Representation");
    if (std::strcmp(type.GetAsString(), "Outline") == 0)
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
      type.Set("Slice");
      representation->UpdateVTKObjects();
    }
  }
  {
    SM_SCOPED_TRACE(CallMethod).arg(window).arg("ResetCamera").arg(true);
    window->ResetCamera(true); // fills the view
  }
  const auto redo = [id = ProxyById(window), setCamera = cameraSetter(window, window)]()
  {
    if (vtkSMProxy* again = id.get())
    {
      flatten(again);
      setCamera();
    }
  };
  addUndoStep([]() {}, redo);
  return representation;
}

/// Shows a comparison, its image and its photograph in views of their own.
void showComparison(pqPipelineSource* comparison, pqOutputPort* compared)
{
  hide(comparison, viewWith(comparison));
  pqRenderView* shown = viewWith(compared->getSource());
  pqOutputPort* photograph =
    qobject_cast<pqPipelineFilter*>(comparison)->getInputs("Photograph").front();
  const std::vector<pqRenderView*> views = addViewsBeside(shown ? shown : sceneBeside(compared),
    { comparison->getSMName(), "Points in Image", "Points in Photograph" });
  if (views.empty())
  {
    return;
  }
  pqOutputPort* const ports[] = { comparison->getOutputPort(0), compared, photograph };
  for (int i = 0; i < 3; ++i)
  {
    vtkSMProxy* representation = showFlat(ports[i], views[i]);
    pqPipelineSource* source = ports[i]->getSource();
    vtkPVArrayInformation* values =
      ports[i]->getDataInformation()->GetPointDataInformation()->GetAttributeInformation(
        vtkDataSetAttributes::SCALARS);
    if (representation && ports[i] == compared && imagesInViews::isSchlieren(source))
    {
      ImageDisplay::apply(representation, source->getProxy());
    }
    else if (representation && values)
    {
      ImageDisplay::applyToPhotograph(representation, values);
    }
  }
  pqActiveObjects::instance().setActiveView(views[0]);
  new pqPhotographPoints(comparison, views[1], views[2]);
}

/// Shows the image of a filter in a view of its own, which it fills: that in which ParaView has
/// shown it, where nothing else is visible, or a new one.
void showImage(pqPipelineSource* filter, pqOutputPort* flow)
{
  pqRenderView* view = viewWith(filter);
  if (!view || view->getNumberOfVisibleDataRepresentations() > 1)
  {
    hide(filter, view);
    const std::vector<pqRenderView*> views =
      addViewsBeside(sceneBeside(flow), { "Image of " + filter->getSMName() });
    if (views.empty())
    {
      return;
    }
    view = views[0];
  }
  if (vtkSMProxy* representation = showFlat(filter->getOutputPort(0), view))
  {
    ImageDisplay::apply(representation, filter->getProxy());
  }
  pqActiveObjects::instance().setActiveView(view);
}

} // namespace

void showInFlatViews(pqPipelineSource* filter)
{
  const auto inputs = qobject_cast<pqPipelineFilter*>(filter)->getInputs("Input");
  if (!inputs.empty())
  {
    const HeldInput input;
    (imagesInViews::isComparison(filter) ? showComparison : showImage)(filter, inputs.front());
  }
}
