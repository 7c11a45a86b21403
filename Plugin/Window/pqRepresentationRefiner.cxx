// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqRepresentationRefiner.h"

#include "pqApplicationCore.h"
#include "pqImageRefiner.h"
#include "pqProgressManager.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"

#include "vtkPVRenderView.h"
#include "vtkRenderWindow.h"
#include "vtkSMCameraLink.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSmartPointer.h"

#include <QTimer>
#include <QVariant>

#include <algorithm>
#include <cstring>
#include <vector>

namespace
{

/// Tracing time between responses of the window, seconds.
constexpr double timeSlice = 0.03;
constexpr int pauseMilliseconds = 1;

constexpr auto isSchlieren = &pqRepresentationRefiner::isSchlieren;

vtkSMProxy* benchOf(pqRepresentation* representation)
{
  vtkSMProperty* bench = representation->getProxy()->GetProperty("SchlierenBench");
  return bench ? vtkSMPropertyHelper(bench).GetAsProxy() : nullptr;
}

bool isUnfinished(pqRepresentation* representation)
{
  vtkSMProxy* bench = isSchlieren(representation) ? benchOf(representation) : nullptr;
  if (!bench)
  {
    return false;
  }
  // Reads from the server, because the client's own representation knows nothing.
  for (const char* name : { "Finished", "Status", "Stopped" })
  {
    bench->UpdatePropertyInformation(bench->GetProperty(name));
  }
  return vtkSMPropertyHelper(bench, "Finished").GetAsInt() == 0 ||
    (std::strncmp(vtkSMPropertyHelper(bench, "Status").GetAsString(), "Preview", 7) == 0 &&
      vtkSMPropertyHelper(bench, "Stopped").GetAsInt() == 0);
}

/// Returns whether streaming updates refine images, in the process that draws; else renderings do.
bool isTracedWhereDrawn(pqView* view)
{
  auto* client = vtkPVRenderView::SafeDownCast(view->getProxy()->GetClientSideObject());
  return !view->getServer()->isRemote() || (client && client->GetRemoteRenderingAvailable());
}

bool isBeingTurned(pqView* view)
{
  auto* proxy = vtkSMRenderViewProxy::SafeDownCast(view->getProxy());
  return proxy->GetRenderWindow()->GetDesiredUpdateRate() > 1;
}

/// Disables camera links during its lifetime: a link renders the other view, too, though a refined image is not turned.
class UnlinkedCameras
{
public:
  explicit UnlinkedCameras(vtkSMSessionProxyManager* manager)
  {
    for (int i = 0; i < manager->GetNumberOfLinks(); ++i)
    {
      auto* link =
        vtkSMCameraLink::SafeDownCast(manager->GetRegisteredLink(manager->GetLinkName(i)));
      if (link && link->GetEnabled())
      {
        link->SetEnabled(false);
        this->Links.emplace_back(link);
      }
    }
  }
  ~UnlinkedCameras()
  {
    for (vtkSMCameraLink* link : this->Links)
    {
      link->SetEnabled(true);
    }
  }
  UnlinkedCameras(const UnlinkedCameras&) = delete;
  UnlinkedCameras& operator=(const UnlinkedCameras&) = delete;

private:
  std::vector<vtkSmartPointer<vtkSMCameraLink>> Links;
};

} // namespace

//------------------------------------------------------------------------------
pqRepresentationRefiner::pqRepresentationRefiner(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqRepresentationRefiner::watch);
  QObject::connect(
    model, &pqServerManagerModel::representationAdded, this, &pqRepresentationRefiner::limit);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
  for (pqRepresentation* representation : model->findItems<pqRepresentation*>())
  {
    this->limit(representation);
  }
}

//------------------------------------------------------------------------------
bool pqRepresentationRefiner::isSchlieren(pqRepresentation* representation)
{
  vtkSMProxy* proxy = representation->getProxy();
  return representation->isVisible() && proxy->GetProperty("SchlierenFinished") &&
    std::strcmp(vtkSMPropertyHelper(proxy, "Representation").GetAsString(), "Schlieren") == 0;
}

//------------------------------------------------------------------------------
QList<vtkSMProxy*> pqRepresentationRefiner::benchesIn(pqView* view)
{
  QList<vtkSMProxy*> benches;
  for (pqRepresentation* representation : view->getRepresentations())
  {
    if (isSchlieren(representation))
    {
      benches << benchOf(representation);
    }
  }
  return benches;
}

//------------------------------------------------------------------------------
bool pqRepresentationRefiner::isAnyBeingTurned()
{
  const QList<pqRenderView*> views =
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqRenderView*>();
  return std::any_of(views.begin(), views.end(), isBeingTurned);
}

//------------------------------------------------------------------------------
void pqRepresentationRefiner::renderViewsOf(vtkSMProxy* bench)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqRepresentation* representation : model->findItems<pqRepresentation*>())
  {
    if (isSchlieren(representation) && benchOf(representation) == bench)
    {
      representation->renderViewEventually();
    }
  }
}

//------------------------------------------------------------------------------
void pqRepresentationRefiner::limit(pqRepresentation* representation)
{
  vtkSMProxy* proxy = representation->getProxy();
  if (proxy->GetProperty("SchlierenTimeSlice"))
  {
    vtkSMPropertyHelper(proxy, "SchlierenTimeSlice").Set(timeSlice);
    proxy->UpdateVTKObjects();
  }
}

//------------------------------------------------------------------------------
void pqRepresentationRefiner::watch(pqView* view)
{
  if (qobject_cast<pqRenderView*>(view))
  {
    QObject::connect(view, &pqView::endRender, this, [this, view]() { this->refineLater(view); });
  }
}

//------------------------------------------------------------------------------
void pqRepresentationRefiner::refineLater(pqView* view)
{
  const QList<pqRepresentation*> shown = view->getRepresentations();
  if (isBeingTurned(view))
  {
    pqImageRefiner::instance()->onRefinedInView(view, false); // each turn restarts the image
    return;
  }
  // Uses one timer for each view, because streaming updates render, too.
  if (view->property("SchlierenIsRefined").toBool() ||
    std::none_of(shown.begin(), shown.end(), isSchlieren))
  {
    return;
  }
  view->setProperty("SchlierenIsRefined", true);
  QTimer::singleShot(pauseMilliseconds, view, [this, view]() { this->refine(view); });
}

//------------------------------------------------------------------------------
void pqRepresentationRefiner::refine(pqView* view)
{
  const QList<pqRepresentation*> shown = view->getRepresentations();
  pqProgressManager* progress = pqApplicationCore::instance()->getProgressManager();
  progress->lockProgress(view); // else the bar would show the rendering
  if (!isBeingTurned(view) && !view->getServer()->isProcessingPending())
  {
    auto* proxy = vtkSMRenderViewProxy::SafeDownCast(view->getProxy());
    const UnlinkedCameras unlinked(proxy->GetSessionProxyManager());
    if (isTracedWhereDrawn(view))
    {
      proxy->StreamingUpdate(true);
    }
    else if (std::any_of(shown.begin(), shown.end(), isUnfinished))
    {
      proxy->StillRender();
    }
  }
  progress->unlockProgress(view);
  view->setProperty("SchlierenIsRefined", false);
  const bool isMore = std::any_of(shown.begin(), shown.end(), isUnfinished);
  pqImageRefiner::instance()->onRefinedInView(view, isMore);
  if (isMore)
  {
    this->refineLater(view);
    return;
  }
  for (pqRepresentation* representation : shown)
  {
    if (isSchlieren(representation))
    {
      Q_EMIT pqImageRefiner::instance()->imageChanged(benchOf(representation));
    }
  }
}
