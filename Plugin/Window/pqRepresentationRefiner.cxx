// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqRepresentationRefiner.h"

#include "ImagesInViews.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkPVRenderView.h"
#include "vtkRenderWindow.h"
#include "vtkSMCameraLink.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSmartPointer.h"

#include <QPointer>
#include <QRegularExpression>
#include <QTimer>
#include <QVariant>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace
{

/// Tracing time between responses of the window, seconds.
constexpr double timeSlice = 0.03;
constexpr int pauseMilliseconds = 1;

/// Milliseconds: shorter work is not reported.
constexpr qint64 unreported = 500;

bool isUnfinished(vtkSMProxy* bench)
{
  // Reads from the server, because the client's own representation knows nothing.
  for (const char* name : { "Finished", "Status", "Stopped" })
  {
    bench->UpdatePropertyInformation(bench->GetProperty(name));
  }
  return vtkSMPropertyHelper(bench, "Finished").GetAsInt() == 0 ||
    (std::strncmp(vtkSMPropertyHelper(bench, "Status").GetAsString(), "Preview", 7) == 0 &&
      vtkSMPropertyHelper(bench, "Stopped").GetAsInt() == 0);
}

/// Returns a text such as "Refining: 3 of 64 samples, about 3 min".
QString refinementInWords(vtkSMProxy* bench)
{
  static const QRegularExpression samples(
    "^(\\d+ of \\d+ samples?) per pixel(?:(, about [^,]*) more)?");
  const QRegularExpressionMatch found =
    samples.match(QString::fromUtf8(vtkSMPropertyHelper(bench, "Status").GetAsString()));
  return found.hasMatch() ? "Refining: " + found.captured(1) + found.captured(2)
                          : QString("Refining");
}

/// Returns whether the process with the data draws the view, and traces its images.
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

/// Keeps the k of what a view shows first for all views of the same flow and technique that have none yet.
void keepK(pqView* view)
{
  for (pqRepresentation* shown : view->getRepresentations())
  {
    vtkSMProxy* bench = imagesInViews::isDrawn(shown) ? imagesInViews::benchOf(shown) : nullptr;
    auto* data = qobject_cast<pqDataRepresentation*>(shown);
    pqOutputPort* flow = data ? data->getOutputPortFromInput() : nullptr;
    if (!bench || !flow || !imagesInViews::lacksKeptK(bench))
    {
      continue;
    }
    const double k = imagesInViews::shownK(shown);
    const int cutoff = vtkSMPropertyHelper(bench, "Cutoff").GetAsInt();
    for (pqDataRepresentation* other : flow->getRepresentations(nullptr))
    {
      vtkSMProxy* its = imagesInViews::isDrawn(other) ? imagesInViews::benchOf(other) : nullptr;
      if (k > 0 && its && imagesInViews::lacksKeptK(its) &&
        vtkSMPropertyHelper(its, "Cutoff").GetAsInt() == cutoff)
      {
        SCOPED_UNDO_EXCLUDE();
        vtkSMPropertyHelper(its, "LockedK").Set(k);
        its->UpdateVTKObjects();
        other->getView()->render(); // the legend says it
      }
    }
  }
}

/// Disables camera links during its lifetime: a link renders the other view, too, though a refined
/// image is not turned.
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

pqRepresentationRefiner::pqRepresentationRefiner(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqRepresentationRefiner::watch);
  QObject::connect(model, &pqServerManagerModel::preViewRemoved, this,
    [this](pqView* view) { this->note(view, false); });
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

pqRepresentationRefiner* pqRepresentationRefiner::instance()
{
  static QPointer<pqRepresentationRefiner> refiner;
  if (!refiner)
  {
    refiner = new pqRepresentationRefiner(pqApplicationCore::instance());
  }
  return refiner;
}

void pqRepresentationRefiner::limit(pqRepresentation* representation)
{
  vtkSMProxy* proxy = representation->getProxy();
  if (proxy->GetProperty("SchlierenTimeSlice"))
  {
    vtkSMPropertyHelper(proxy, "SchlierenTimeSlice").Set(timeSlice);
    proxy->UpdateVTKObjects();
  }
}

void pqRepresentationRefiner::watch(pqView* view)
{
  if (qobject_cast<pqRenderView*>(view))
  {
    QObject::connect(view, &pqView::endRender, this,
      [this, view]()
      {
        keepK(view);
        this->refineLater(view);
      });
  }
}

void pqRepresentationRefiner::refineLater(pqView* view)
{
  if (isBeingTurned(view))
  {
    this->note(view, false); // each turn restarts the image
    return;
  }
  // Uses one timer for each view, because streaming updates render, too.
  if (view->property("SchlierenIsRefined").toBool() || !isTracedWhereDrawn(view) ||
    imagesInViews::benchesIn(view).isEmpty())
  {
    return;
  }
  view->setProperty("SchlierenIsRefined", true);
  QTimer::singleShot(pauseMilliseconds, view, [this, view]() { this->refine(view); });
}

void pqRepresentationRefiner::refine(pqView* view)
{
  if (!isBeingTurned(view) && !view->getServer()->isProcessingPending())
  {
    auto* proxy = vtkSMRenderViewProxy::SafeDownCast(view->getProxy());
    const UnlinkedCameras unlinked(proxy->GetSessionProxyManager());
    proxy->StreamingUpdate(true);
  }
  view->setProperty("SchlierenIsRefined", false);
  const QList<vtkSMProxy*> benches = imagesInViews::benchesIn(view);
  const bool isMore = std::any_of(benches.begin(), benches.end(), isUnfinished);
  this->note(view, isMore);
  if (isMore)
  {
    this->refineLater(view);
    return;
  }
  for (vtkSMProxy* bench : benches)
  {
    Q_EMIT this->imageChanged(bench);
  }
}

void pqRepresentationRefiner::note(pqView* view, bool isUnfinished)
{
  if (!isUnfinished)
  {
    this->Since.remove(view);
  }
  else if (!this->Since.contains(view))
  {
    this->Since[view].start();
  }
  this->report();
}

void pqRepresentationRefiner::report()
{
  QList<vtkSMProxy*> benches;
  for (auto since = this->Since.begin(); since != this->Since.end(); ++since)
  {
    if (since->elapsed() >= unreported)
    {
      benches << imagesInViews::benchesIn(since.key());
    }
  }
  if (benches.isEmpty())
  {
    if (std::exchange(this->IsReported, false))
    {
      Q_EMIT this->progressed(QString(), 0);
    }
    return;
  }
  this->IsReported = true;
  int percent = 0;
  for (vtkSMProxy* bench : benches)
  {
    bench->UpdatePropertyInformation(bench->GetProperty("PercentDone"));
    percent += vtkSMPropertyHelper(bench, "PercentDone").GetAsInt();
  }
  Q_EMIT this->progressed(benches.size() == 1 ? refinementInWords(benches.front())
                                              : QString("Refining %1 images").arg(benches.size()),
    percent / static_cast<int>(benches.size()));
}

void pqRepresentationRefiner::stop()
{
  for (pqView* view : std::exchange(this->Since, {}).keys())
  {
    for (vtkSMProxy* bench : imagesInViews::benchesIn(view))
    {
      SCOPED_UNDO_EXCLUDE();
      bench->InvokeCommand("Stop");
    }
    view->render(); // the line over the image says it
  }
  this->report();
}
