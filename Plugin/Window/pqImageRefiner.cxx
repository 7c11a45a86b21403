// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageRefiner.h"

#include "ImagesInViews.h"
#include "pqRepresentationRefiner.h"

#include "pqAnimationScene.h"
#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqProgressManager.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "pqView.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPVDataInformation.h"
#include "vtkPVView.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <QRegularExpression>
#include <QScopedValueRollback>

#include <algorithm>
#include <utility>

namespace
{

// Tracing time of a turn, seconds; the rendering adds to it.
constexpr double timeSlice = 0.030;

// Milliseconds: shorter work is not reported, and neither are changes within that time.
constexpr qint64 unreported = 500;
constexpr qint64 reportPeriod = 250;

// Milliseconds until the next try, where something else must end first.
constexpr int retryPeriod = 10;

pqPipelineSource* sourceOf(vtkSMProxy* filter)
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
    filter);
}

/// Blocks a filter's signals during its update: the progress bar would paint the window at each
/// step, and menus and panels would read the data again, both slower than a turn.
class QuietWindow
{
public:
  explicit QuietWindow(pqPipelineSource* source)
    : Source(source)
  {
    this->Manager->lockProgress(&this->Owner);
    if (this->Source)
    {
      this->Source->blockSignals(true);
    }
  }
  ~QuietWindow()
  {
    if (this->Source)
    {
      this->Source->blockSignals(false);
    }
    this->Manager->unlockProgress(&this->Owner);
  }
  QuietWindow(const QuietWindow&) = delete;
  QuietWindow& operator=(const QuietWindow&) = delete;

private:
  QPointer<pqPipelineSource> Source; // may be deleted meanwhile
  pqProgressManager* Manager = pqApplicationCore::instance()->getProgressManager();
  QObject Owner;
};

void update(vtkSMSourceProxy* filter, pqView* view)
{
  filter->UpdatePipeline(vtkSMPropertyHelper(view->getProxy(), "ViewTime").GetAsDouble());
}

vtkIdType imageCount(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("PictureCount"));
  return vtkSMPropertyHelper(filter, "PictureCount").GetAsIdType();
}

bool isFinished(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("Finished"));
  return vtkSMPropertyHelper(filter, "Finished").GetAsInt() != 0;
}

int percentDone(vtkSMProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("PercentDone"));
  return vtkSMPropertyHelper(filter, "PercentDone").GetAsInt();
}

/// Returns a text such as "Refining: 3 of 64 samples, about 3 min".
QString refinementInWords(vtkSMProxy* filter)
{
  static const QRegularExpression samples(
    "^(\\d+ of \\d+ samples?) per pixel(?:(, about [^,]*) more)?");
  filter->UpdatePropertyInformation(filter->GetProperty("Status"));
  const QRegularExpressionMatch found =
    samples.match(QString::fromUtf8(vtkSMPropertyHelper(filter, "Status").GetAsString()));
  return found.hasMatch() ? "Refining: " + found.captured(1) + found.captured(2)
                          : QString("Refining");
}

void setTimeLimit(vtkSMProxy* filter, double seconds)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(filter, "TimeLimit").Set(seconds);
  filter->UpdateProperty("TimeLimit");
}

/// Requests more of an image: without a limit, the next update finishes it; with one, works on it,
/// and the next update shows the result.
void requestMore(vtkSMProxy* filter)
{
  SCOPED_UNDO_EXCLUDE();
  filter->InvokeCommand("Refine");
}

/// Reads the protected flag of vtkPVView for screenshots.
struct Captured : vtkPVView
{
  static bool is(vtkPVView* view) { return view && (view->*(&Captured::GetInCaptureScreenshot))(); }
};

bool isCaptured(pqView* view)
{
  return Captured::is(vtkPVView::SafeDownCast(view->getProxy()->GetClientSideObject()));
}

} // namespace

//------------------------------------------------------------------------------
pqImageRefiner::pqImageRefiner(QObject* parentObject)
  : QObject(parentObject)
{
  this->Timer.setSingleShot(true);
  QObject::connect(&this->Timer, &QTimer::timeout, this, [this]() { this->takeTurn(); });

  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::preSourceRemoved, this, &pqImageRefiner::forget);
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqImageRefiner::watch);
  QObject::connect(model, &pqServerManagerModel::preViewRemoved, this,
    [this](pqView* view) { this->onRefinedInView(view, false); });
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
  QObject::connect(model, &pqServerManagerModel::proxyAdded, this, &pqImageRefiner::watchAnimation);
  for (pqAnimationScene* scene : model->findItems<pqAnimationScene*>())
  {
    this->watchAnimation(scene);
  }
}

//------------------------------------------------------------------------------
pqImageRefiner::~pqImageRefiner() = default;

//------------------------------------------------------------------------------
pqImageRefiner* pqImageRefiner::instance()
{
  static QPointer<pqImageRefiner> refiner;
  if (!refiner)
  {
    refiner = new pqImageRefiner(pqApplicationCore::instance());
  }
  return refiner;
}

//------------------------------------------------------------------------------
void pqImageRefiner::watch(pqView* view)
{
  // Connects before ParaView tests whether to update.
  this->Connection->Connect(
    view->getProxy(), vtkCommand::StartEvent, this, SLOT(onStartRender(vtkObject*)), nullptr, 1);
  this->Connection->Connect(
    view->getProxy(), vtkCommand::EndEvent, this, SLOT(onEndRender(vtkObject*)));
}

//------------------------------------------------------------------------------
void pqImageRefiner::watchAnimation(pqProxy* item)
{
  if (auto* scene = qobject_cast<pqAnimationScene*>(item))
  {
    // Uses old syntax, because ParaView 5.11 has deprecated signals of the same names.
    this->connect(
      scene, SIGNAL(beginPlay(vtkObject*, unsigned long, void*, void*)), SLOT(onBeginPlay()));
    this->connect(
      scene, SIGNAL(endPlay(vtkObject*, unsigned long, void*, void*)), SLOT(onEndPlay()));
  }
}

//------------------------------------------------------------------------------
void pqImageRefiner::forget(pqPipelineSource* source)
{
  this->Jobs.erase(std::remove_if(this->Jobs.begin(), this->Jobs.end(),
                     [source](const Job& job) { return job.Filter == source->getProxy(); }),
    this->Jobs.end());
  this->report();
}

//------------------------------------------------------------------------------
void pqImageRefiner::refine(vtkSMProxy* proxy)
{
  auto* filter = vtkSMSourceProxy::SafeDownCast(proxy);
  if (!imagesInViews::isSchlieren(sourceOf(filter)))
  {
    pqRepresentationRefiner::renderViewsOf(proxy);
    return;
  }
  if (!this->hasJob(filter))
  {
    Job job{ filter };
    job.Since.start();
    this->Jobs << job;
  }
  this->wakeUp();
}

//------------------------------------------------------------------------------
bool pqImageRefiner::hasJob(vtkSMSourceProxy* filter) const
{
  return std::any_of(this->Jobs.begin(), this->Jobs.end(),
    [filter](const Job& job) { return job.Filter == filter; });
}

//------------------------------------------------------------------------------
void pqImageRefiner::wakeUp()
{
  if (!this->Timer.isActive() && !this->Jobs.isEmpty())
  {
    this->Timer.start(0);
  }
}

//------------------------------------------------------------------------------
void pqImageRefiner::takeTurn()
{
  pqPipelineSource* source = this->Jobs.isEmpty() ? nullptr : sourceOf(this->Jobs.first().Filter);
  if (this->IsBusy || this->IsPlaying || pqRepresentationRefiner::isAnyBeingTurned() ||
    (source && source->getServer()->isProcessingPending()))
  {
    // Retries later, for example in an event loop within an update or a rendering.
    this->Timer.start(retryPeriod);
    return;
  }
  if (this->Jobs.isEmpty())
  {
    return;
  }
  Job job = this->Jobs.takeFirst();
  bool isUnfinished = false;
  {
    const QuietWindow quiet(source);
    const QScopedValueRollback<bool> busy(this->IsBusy, true);
    isUnfinished = this->takeTurn(job);
  }
  source = sourceOf(job.Filter); // rendering may have deleted it
  if (source && (!isUnfinished || (!job.IsAnnounced && job.ShownCount >= 0)))
  {
    job.IsAnnounced = true; // panels show nearly the final values from the first samples on
    Q_EMIT source->dataUpdated(source);
  }
  if (source && isUnfinished && !this->hasJob(job.Filter))
  {
    this->Jobs << job;
  }
  this->report();
  this->wakeUp();
}

//------------------------------------------------------------------------------
bool pqImageRefiner::takeTurn(Job& job)
{
  const vtkSmartPointer<vtkSMSourceProxy> filter = job.Filter.GetPointer();
  pqPipelineSource* source = sourceOf(filter);
  if (!source || source->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return false;
  }
  const QList<QPointer<pqView>> views = imagesInViews::showing(source);
  if (views.isEmpty())
  {
    return false;
  }
  setTimeLimit(filter, timeSlice);
  requestMore(filter);
  // Updates only for a new image, because an update takes as long as a turn.
  if (imageCount(filter) != job.ShownCount || isFinished(filter))
  {
    update(filter, views.front());
    const vtkIdType count = imageCount(filter);
    // Shows images that failed, too, which have no points.
    if (count != job.ShownCount || filter->GetDataInformation(0)->GetNumberOfPoints() == 0)
    {
      job.ShownCount = count;
      this->show(filter, views);
    }
  }
  const bool isUnfinished = !isFinished(filter);
  setTimeLimit(filter, 0);
  if (isUnfinished)
  {
    requestMore(filter); // other updates get all of it
  }
  return isUnfinished;
}

//------------------------------------------------------------------------------
void pqImageRefiner::show(vtkSMSourceProxy* filter, const QList<QPointer<pqView>>& views)
{
  for (const QPointer<pqView>& view : views)
  {
    if (view)
    {
      view->forceRender();
    }
  }
  Q_EMIT this->imageChanged(filter);
}

//------------------------------------------------------------------------------
void pqImageRefiner::onRefinedInView(pqView* view, bool isUnfinished)
{
  if (!isUnfinished)
  {
    this->SinceInViews.remove(view);
  }
  else if (!this->SinceInViews.contains(view))
  {
    this->SinceInViews[view].start();
  }
  this->report();
}

//------------------------------------------------------------------------------
QList<vtkSMProxy*> pqImageRefiner::reported() const
{
  QList<vtkSMProxy*> images;
  for (const Job& job : this->Jobs)
  {
    if (sourceOf(job.Filter) && job.Since.elapsed() >= unreported)
    {
      images << job.Filter;
    }
  }
  for (auto since = this->SinceInViews.begin(); since != this->SinceInViews.end(); ++since)
  {
    if (since->elapsed() >= unreported && !this->IsPlaying)
    {
      images << pqRepresentationRefiner::benchesIn(since.key());
    }
  }
  return images;
}

//------------------------------------------------------------------------------
void pqImageRefiner::report()
{
  const QList<vtkSMProxy*> images = this->reported();
  if (images.isEmpty())
  {
    if (this->SinceReport.isValid())
    {
      this->SinceReport.invalidate();
      Q_EMIT this->progressed(QString(), 0);
    }
    return;
  }
  if (this->SinceReport.isValid() && this->SinceReport.elapsed() < reportPeriod)
  {
    return;
  }
  this->SinceReport.start();
  int percent = 0;
  for (vtkSMProxy* image : images)
  {
    percent += percentDone(image);
  }
  Q_EMIT this->progressed(images.size() == 1 ? refinementInWords(images.front())
                                             : QString("Refining %1 images").arg(images.size()),
    percent / static_cast<int>(images.size()));
}

//------------------------------------------------------------------------------
void pqImageRefiner::stop()
{
  if (this->IsBusy || this->isShort())
  {
    QTimer::singleShot(0, this, &pqImageRefiner::stop);
    return;
  }
  const QScopedValueRollback<bool> busy(this->IsBusy, true);
  for (const Job& job : std::exchange(this->Jobs, {}))
  {
    const vtkSmartPointer<vtkSMSourceProxy> filter = job.Filter.GetPointer();
    pqPipelineSource* source = sourceOf(filter);
    if (!source)
    {
      continue;
    }
    {
      const QuietWindow quiet(source);
      const QList<QPointer<pqView>> views = imagesInViews::showing(source);
      // Outputs the present image, so that the rendering does not request more.
      setTimeLimit(filter, 0.01);
      if (!views.isEmpty())
      {
        update(filter, views.front());
      }
      {
        SCOPED_UNDO_EXCLUDE();
        filter->InvokeCommand("Stop");
      }
      setTimeLimit(filter, 0);
      this->show(filter, views);
    }
    if (pqPipelineSource* still = sourceOf(filter))
    {
      Q_EMIT still->dataUpdated(still);
    }
  }
  for (pqView* view : this->SinceInViews.keys())
  {
    for (vtkSMProxy* bench : pqRepresentationRefiner::benchesIn(view))
    {
      SCOPED_UNDO_EXCLUDE();
      bench->InvokeCommand("Stop");
    }
    view->render(); // the line over the image says it
  }
  this->SinceInViews.clear();
  this->report();
  this->wakeUp();
}

//------------------------------------------------------------------------------
void pqImageRefiner::onStartRender(vtkObject* proxy)
{
  auto* view = pqApplicationCore::instance()->getServerManagerModel()->findItem<pqView*>(
    vtkSMProxy::SafeDownCast(proxy));
  if (this->IsBusy || this->IsPlaying || this->isShort() || !view || isCaptured(view))
  {
    return;
  }
  for (pqPipelineSource* source : imagesInViews::filters())
  {
    vtkSMSourceProxy* filter = source->getSourceProxy();
    if ((this->hasJob(filter) || view->getViewProxy()->GetNeedsUpdate()) &&
      imagesInViews::showing(source).contains(view))
    {
      this->limit(filter);
    }
  }
}

//------------------------------------------------------------------------------
void pqImageRefiner::onEndRender(vtkObject*)
{
  if (!this->isShort())
  {
    this->unlimit();
  }
}

//------------------------------------------------------------------------------
void pqImageRefiner::limit(vtkSMSourceProxy* filter)
{
  setTimeLimit(filter, timeSlice);
  this->Limited << filter;
}

//------------------------------------------------------------------------------
void pqImageRefiner::unlimit()
{
  for (const vtkWeakPointer<vtkSMSourceProxy>& filter : this->Limited)
  {
    if (!filter)
    {
      continue;
    }
    setTimeLimit(filter, 0); // before the request, which may do nothing with a limit
    if (!isFinished(filter))
    {
      requestMore(filter);
      this->refine(filter);
    }
  }
  this->Limited.clear();
}

//------------------------------------------------------------------------------
pqImageRefiner::ShortUpdates::ShortUpdates()
{
  pqImageRefiner* refiner = pqImageRefiner::instance();
  if (refiner->NumberOfShortUpdates++ == 0)
  {
    refiner->unlimit();
    for (pqPipelineSource* source : imagesInViews::filters())
    {
      refiner->limit(source->getSourceProxy());
    }
  }
}

//------------------------------------------------------------------------------
pqImageRefiner::ShortUpdates::~ShortUpdates()
{
  pqImageRefiner* refiner = pqImageRefiner::instance();
  if (--refiner->NumberOfShortUpdates == 0)
  {
    refiner->unlimit();
  }
}
