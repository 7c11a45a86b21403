// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImagesInViews.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"

#include "vtkClientServerStream.h"
#include "vtkPVDataInformation.h"
#include "vtkPVRenderView.h"
#include "vtkPVSession.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSchlierenFilter.h"

#include <algorithm>
#include <cstring>

namespace
{

pqServerManagerModel* model() { return pqApplicationCore::instance()->getServerManagerModel(); }

} // namespace

bool imagesInViews::isSchlieren(pqPipelineSource* source)
{
  const char* name = source && source->getProxy() ? source->getProxy()->GetXMLName() : nullptr;
  return name && std::strcmp(name, "Schlieren") == 0 &&
    source->getProxy()->GetProperty("ImageCount");
}

bool imagesInViews::isComparison(pqPipelineSource* source)
{
  const char* name = source && source->getProxy() ? source->getProxy()->GetXMLName() : nullptr;
  return name && std::strcmp(name, "CompareWithPhotograph") == 0;
}

pqPipelineSource* imagesInViews::filterOf(pqPipelineSource* source)
{
  if (!source || isSchlieren(source))
  {
    return source;
  }
  auto* filter = qobject_cast<pqPipelineFilter*>(source);
  for (pqOutputPort* input : filter ? filter->getAllInputs() : QList<pqOutputPort*>())
  {
    if (pqPipelineSource* found = filterOf(input->getSource()))
    {
      return found;
    }
  }
  return nullptr;
}

vtkSMProxy* imagesInViews::benchOf(pqRepresentation* representation)
{
  vtkSMProperty* bench = representation->getProxy()->GetProperty("SchlierenBench");
  return bench ? vtkSMPropertyHelper(bench).GetAsProxy() : nullptr;
}

bool imagesInViews::isDrawn(pqRepresentation* representation)
{
  return representation->isVisible() && benchOf(representation) &&
    std::strcmp(vtkSMPropertyHelper(representation->getProxy(), "Representation").GetAsString(),
      "Schlieren") == 0;
}

bool imagesInViews::lacksKeptK(vtkSMProxy* bench)
{
  const auto valueOf = [bench](const char* name) { return vtkSMPropertyHelper(bench, name); };
  const int cutoff = valueOf("Cutoff").GetAsInt();
  return (vtkSchlierenFilter::CutoffHasK(cutoff) || vtkSchlierenFilter::CutoffHasScreen(cutoff)) &&
    valueOf("KMode").GetAsInt() == vtkSchlierenFilter::K_AUTOMATIC_KEPT &&
    !(valueOf("LockedK").GetAsDouble() > 0);
}

double imagesInViews::shownK(pqRepresentation* representation)
{
  constexpr int coarsest = 16; // of what is drawn
  vtkSMProxy* proxy = representation->getProxy();
  vtkSMProxy* bench = benchOf(representation);
  proxy->UpdatePropertyInformation(proxy->GetProperty("SchlierenReduction"));
  bench->UpdatePropertyInformation(bench->GetProperty("AutomaticUsed"));
  return vtkSMPropertyHelper(proxy, "SchlierenReduction").GetAsInt() > coarsest
    ? 0
    : vtkSMPropertyHelper(bench, "AutomaticUsed").GetAsDouble();
}

QList<vtkSMProxy*> imagesInViews::benchesIn(pqView* view)
{
  QList<vtkSMProxy*> benches;
  for (pqRepresentation* representation : view->getRepresentations())
  {
    if (isDrawn(representation))
    {
      benches << benchOf(representation);
    }
  }
  return benches;
}

pqRenderView* imagesInViews::scene(pqOutputPort* flow)
{
  QList<pqRenderView*> views = model()->findItems<pqRenderView*>(flow->getServer());
  auto* active = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  if (active && views.removeOne(active))
  {
    views.prepend(active);
  }
  std::stable_partition(views.begin(), views.end(),
    [flow](pqRenderView* view)
    {
      pqDataRepresentation* shown = flow->getRepresentation(view);
      return benchesIn(view).empty() || (shown && isDrawn(shown));
    });
  vtkSMViewLayoutProxy* layout = pqActiveObjects::instance().activeLayout();
  const auto isMeant = [active, layout](pqRenderView* view)
  {
    return imagesIn(view).empty() &&
      (view == active || (layout && layout->ContainsView(view->getProxy())));
  };
  const auto found = std::find_if(views.begin(), views.end(), isMeant);
  return found == views.end() ? nullptr : *found;
}

QList<pqPipelineSource*> imagesInViews::imagesIn(pqView* view)
{
  QList<pqPipelineSource*> shown;
  for (pqRepresentation* item : view->getRepresentations())
  {
    auto* representation = qobject_cast<pqDataRepresentation*>(item);
    pqOutputPort* port = representation && representation->isVisible()
      ? representation->getOutputPortFromInput()
      : nullptr;
    if (port && port->getPortNumber() == 0 &&
      (isSchlieren(port->getSource()) || isComparison(port->getSource())) &&
      !shown.contains(port->getSource()))
    {
      shown << port->getSource();
    }
  }
  return shown;
}

std::array<double, 2> imagesInViews::placeInImage(
  pqPipelineSource* filter, pqRenderView* view, double right, double up)
{
  vtkRenderer* renderer = view->getRenderViewProxy()->GetRenderer();
  const int* size = renderer->GetSize();
  std::array<std::array<double, 4>, 2> ends{}; // of the line of sight
  for (int end = 0; end < 2; ++end)
  {
    renderer->SetDisplayPoint(right * size[0], up * size[1], end);
    renderer->DisplayToWorld();
    renderer->GetWorldPoint(ends[end].data());
    for (int axis = 0; axis < 3; ++axis)
    {
      ends[end][axis] /= ends[end][3];
    }
  }
  const double depth = ends[0][2] - ends[1][2];
  if (depth == 0)
  {
    return { -1, -1 };
  }
  const double along = ends[0][2] / depth;
  vtkPVDataInformation* image = filter->getSourceProxy()->GetDataInformation(0);
  std::array<double, 2> fraction{};
  for (int axis = 0; axis < 2; ++axis)
  {
    const double place = ends[0][axis] + along * (ends[1][axis] - ends[0][axis]);
    // Bounds are centres of pixels.
    const double* bounds = image->GetBounds() + 2 * axis;
    const int* extent = image->GetExtent() + 2 * axis;
    const double last = extent[1] - extent[0];
    fraction[axis] = (0.5 + last * (place - bounds[0]) / (bounds[1] - bounds[0])) / (last + 1);
  }
  return fraction;
}

QString imagesInViews::placeInWords(vtkSMProxy* filter, double right, double up)
{
  // Sends the place itself, because a property would make views update.
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(filter) << "SetProbedPlace" << right << up
         << vtkClientServerStream::End;
  filter->GetSession()->ExecuteStream(vtkPVSession::DATA_SERVER, stream);
  filter->UpdatePropertyInformation(filter->GetProperty("ProbedPlace"));
  return QString::fromUtf8(vtkSMPropertyHelper(filter, "ProbedPlace").GetAsString());
}

bool imagesInViews::isFlat(pqView* view)
{
  return vtkSMPropertyHelper(view->getProxy(), "InteractionMode", true).GetAsInt() ==
    vtkPVRenderView::INTERACTION_MODE_2D;
}
