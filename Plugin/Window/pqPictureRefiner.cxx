// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureRefiner.h"

#include "PicturesInViews.h"
#include "pqInteraction.h"
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
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <QElapsedTimer>
#include <QScopedValueRollback>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace
{

// Seconds. Of hurried pictures there are eleven a second, where light has a quarter of hurriedTurn then.
constexpr double hurriedPeriod = 0.090;
constexpr double hurriedTurn = 0.040;
constexpr double thoroughTurn = 0.065;
constexpr double shortestLimit = 0.010;
constexpr double longestLimit = 0.060;

// What a longer slice has brought is shown in a turn of its own.
constexpr double shortSlice = 0.015;

// Milliseconds. What is over before is not reported, and no report comes sooner after another.
constexpr qint64 unreported = 500;
constexpr qint64 reportPeriod = 250;

// A picture of fewer pixels shows nothing.
constexpr int largestReduction = 16;

pqPipelineSource* sourceOf(vtkSMProxy* filter)
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
    filter);
}

/// While there is one, the window shows a filter's picture and does nothing else with its updates. Its progress
/// bar stands still, which paints the window each time it moves; its menus and panels do not hear of them until
/// tellUpdate(): they look at the data again and draw their icons anew. Either would take longer than a slice.
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
  QPointer<pqPipelineSource> Source; // may end meanwhile
  pqProgressManager* Manager = pqApplicationCore::instance()->getProgressManager();
  QObject Owner;
};

void update(vtkSMSourceProxy* filter, pqView* view)
{
  filter->UpdatePipeline(vtkSMPropertyHelper(view->getProxy(), "ViewTime").GetAsDouble());
}

double secondsOf(const QElapsedTimer& timer) { return 1e-9 * double(timer.nsecsElapsed()); }

vtkIdType pictureCount(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("PictureCount"));
  return vtkSMPropertyHelper(filter, "PictureCount").GetAsIdType();
}

bool isFinished(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("Finished"));
  return vtkSMPropertyHelper(filter, "Finished").GetAsInt() != 0;
}

bool isLeft(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("Stopped"));
  return vtkSMPropertyHelper(filter, "Stopped").GetAsInt() != 0;
}

int percentDone(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("PercentDone"));
  return vtkSMPropertyHelper(filter, "PercentDone").GetAsInt();
}

/// When the properties that make the picture were last changed.
vtkMTimeType changeOf(vtkSMProxy* filter)
{
  vtkMTimeType latest = 0;
  auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(filter->NewPropertyIterator());
  for (; !properties->IsAtEnd(); properties->Next())
  {
    const char* key = properties->GetKey();
    if (!properties->GetProperty()->GetInformationOnly() && std::strcmp(key, "TimeLimit") != 0 &&
      std::strcmp(key, "PreviewReduction") != 0 && std::strcmp(key, "Refine") != 0 &&
      std::strcmp(key, "LockedK") != 0 && std::strcmp(key, "LockedAmbient") != 0)
    {
      latest = std::max(latest, properties->GetProperty()->GetMTime());
    }
  }
  return latest;
}

/// Whether a view is rendering because someone has asked it to do so later (pqView::render): nobody waits for
/// the result then.
bool isRenderingLater(pqView* view)
{
  // A slot of the view is running that its timer has called.
  struct Slots : QObject
  {
    static QObject* senderOf(QObject* receiver) { return (receiver->*(&Slots::sender))(); }
  };
  return qobject_cast<QTimer*>(Slots::senderOf(view)) != nullptr;
}

void setTimeLimit(vtkSMProxy* filter, double seconds)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(filter, "TimeLimit").Set(seconds);
  filter->UpdateProperty("TimeLimit");
}

void setReduction(vtkSMProxy* filter, int reduction)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(filter, "PreviewReduction").Set(reduction);
  filter->UpdateProperty("PreviewReduction");
}

/// Lets the next update go on, if there is anything left.
void askForMore(vtkSMProxy* filter)
{
  SCOPED_UNDO_EXCLUDE();
  filter->InvokeCommand("Refine");
}

} // namespace

struct pqPictureRefiner::Job
{
  vtkWeakPointer<vtkSMSourceProxy> Filter;
  Pace Haste;
  bool HasBegun = false; ///< the filter is at the picture of all pixels
  bool IsPutOff = false; ///< it has one to be shown
  bool HasShown = false; ///< one of all pixels
  bool IsTold = false;   ///< panels know of that
  QElapsedTimer Since{};
};

/// What has been learnt about a filter.
struct pqPictureRefiner::Speed
{
  // Seconds of an update for a hurried picture: Fixed + PerPixel * share, the share of the pixels it has.
  int Reduction = 4;
  double Fixed = 0;
  double PerPixel = 0;
  double LastShare = 0;
  double LastSeconds = 0;
  QElapsedTimer SinceHurried; // since the last one was begun
  double Others = 0;          // seconds of a period that are for anything but its updates

  double Overhead = 0.02;        // seconds of a turn that its TimeLimit does not count
  vtkMTimeType RoughPicture = 0; // changeOf the last hurried picture
  bool IsRough = false;          // that is the last picture that has been shown
  vtkIdType ShownCount = -1;     // PictureCount of that

  double limit() const
  {
    return std::clamp(thoroughTurn - this->Overhead, shortestLimit, longestLimit);
  }

  /// How long an update may take for there to be as many pictures as wanted; to be asked when one begins.
  double available()
  {
    constexpr double longestPeriod = 0.5; // then the mouse has rested
    const double period = this->SinceHurried.isValid() ? secondsOf(this->SinceHurried) : 1;
    this->SinceHurried.start();
    if (period < longestPeriod)
    {
      const double others = std::max(0., period - this->LastSeconds);
      this->Others += 0.3 * (others - this->Others);
    }
    return std::min(hurriedTurn, hurriedPeriod - this->Others);
  }

  /// Takes a hurried picture's time into account, and chooses the next one's pixels.
  void learn(double updating, double available)
  {
    const double share = 1. / (this->Reduction * this->Reduction);
    if (this->LastShare == 0)
    {
      this->PerPixel = updating / share;
    }
    else if (share != this->LastShare)
    {
      const double slope = (updating - this->LastSeconds) / (share - this->LastShare);
      this->PerPixel = std::clamp(slope, 0., updating / share);
      this->Fixed = updating - this->PerPixel * share;
    }
    else
    {
      const double factor = updating / (this->Fixed + this->PerPixel * share);
      this->Fixed *= factor;
      this->PerPixel *= factor;
    }
    this->LastShare = share;
    this->LastSeconds = updating;

    // However slow all the rest is, light gets a quarter of the time.
    const double forLight = std::max(available - this->Fixed, 0.25 * hurriedTurn);
    const double best = std::sqrt(this->PerPixel / forLight);
    // Not to and fro between two: finer only where that is sure to be quick enough.
    const double wanted =
      best > this->Reduction ? best : std::min<double>(this->Reduction, 1.1 * best);
    this->Reduction = std::clamp(int(std::ceil(wanted)), (this->Reduction + 1) / 2,
      std::min(2 * this->Reduction, largestReduction));
  }
};

//------------------------------------------------------------------------------
pqPictureRefiner::pqPictureRefiner(QObject* parentObject)
  : QObject(parentObject)
{
  this->Timer.setSingleShot(true);
  QObject::connect(&this->Timer, &QTimer::timeout, this, [this]() { this->takeTurn(); });
  QObject::connect(
    pqInteraction::instance(), &pqInteraction::ended, this, &pqPictureRefiner::wakeUp);

  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::preSourceRemoved, this, &pqPictureRefiner::forget);
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqPictureRefiner::watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
  QObject::connect(
    model, &pqServerManagerModel::proxyAdded, this, &pqPictureRefiner::watchAnimation);
  for (pqAnimationScene* scene : model->findItems<pqAnimationScene*>())
  {
    this->watchAnimation(scene);
  }
}

//------------------------------------------------------------------------------
pqPictureRefiner::~pqPictureRefiner() = default;

//------------------------------------------------------------------------------
pqPictureRefiner* pqPictureRefiner::instance()
{
  static QPointer<pqPictureRefiner> refiner;
  if (!refiner)
  {
    refiner = new pqPictureRefiner(pqApplicationCore::instance());
  }
  return refiner;
}

//------------------------------------------------------------------------------
void pqPictureRefiner::watch(pqView* view)
{
  // Before ParaView looks whether there is anything to update.
  this->Connection->Connect(view->getProxy(), vtkCommand::StartEvent, this,
    SLOT(onStartRender(vtkObject*, unsigned long, void*, void*)), nullptr, 1);
  this->Connection->Connect(
    view->getProxy(), vtkCommand::EndEvent, this, SLOT(onEndRender(vtkObject*)));
}

//------------------------------------------------------------------------------
void pqPictureRefiner::watchAnimation(pqProxy* item)
{
  auto* scene = qobject_cast<pqAnimationScene*>(item);
  auto* cue = scene ? vtkObject::SafeDownCast(scene->getProxy()->GetClientSideObject()) : nullptr;
  if (cue)
  {
    // ParaView answers this event by an event loop, since 6.0 before it updates views to the new time.
    this->Connection->Connect(
      cue, vtkCommand::AnimationCueTickEvent, this, SLOT(onAnimationStep()), nullptr, 1);
    this->Connection->Connect(
      cue, vtkCommand::AnimationCueTickEvent, this, SLOT(onAnimationStepOver()), nullptr, -1);
  }
}

//------------------------------------------------------------------------------
void pqPictureRefiner::onAnimationStep() { this->IsAnimationStep = true; }

//------------------------------------------------------------------------------
void pqPictureRefiner::onAnimationStepOver()
{
  this->IsAnimationStep = false;
  // What follows at once is the rendering of a frame, which may be saved, and no answer to the user.
  pqInteraction::instance()->setAllAnswered();
}

//------------------------------------------------------------------------------
void pqPictureRefiner::forget(pqPipelineSource* source)
{
  this->Speeds.remove(source->getProxy());
  this->Stopped.remove(source->getProxy());
  this->Jobs.erase(std::remove_if(this->Jobs.begin(), this->Jobs.end(),
                     [source](const Job& job) { return job.Filter == source->getProxy(); }),
    this->Jobs.end());
  this->report();
}

//------------------------------------------------------------------------------
void pqPictureRefiner::keep(vtkSMProxy* filter, const Speed& speed)
{
  // Showing a picture may have been the end of its filter.
  if (sourceOf(filter))
  {
    this->Speeds[filter] = speed;
  }
}

//------------------------------------------------------------------------------
void pqPictureRefiner::refine(vtkSMProxy* proxy, Pace pace)
{
  auto* filter = vtkSMSourceProxy::SafeDownCast(proxy);
  if (!picturesInViews::isSchlieren(sourceOf(filter)))
  {
    pqRepresentationRefiner::renderViewsOf(proxy);
    return;
  }
  this->setStopped(filter, false);
  const auto job = std::find_if(this->Jobs.begin(), this->Jobs.end(),
    [filter](const Job& other) { return other.Filter == filter; });
  Job begun{ filter, pace };
  begun.Since.start();
  if (job == this->Jobs.end())
  {
    this->Jobs << begun;
  }
  else
  {
    *job = begun;
  }
  if (pace == Pace::Hurried)
  {
    this->takeTurn();
  }
  else
  {
    this->wakeUp();
  }
}

//------------------------------------------------------------------------------
bool pqPictureRefiner::hasJob(vtkSMSourceProxy* filter) const
{
  return std::any_of(this->Jobs.begin(), this->Jobs.end(),
    [filter](const Job& job) { return job.Filter == filter; });
}

//------------------------------------------------------------------------------
QList<pqPictureRefiner::Job>::iterator pqPictureRefiner::nextJob()
{
  // The user's own movements come first.
  const bool isHurriedOnly = pqInteraction::instance()->isOn();
  return std::find_if(this->Jobs.begin(), this->Jobs.end(),
    [isHurriedOnly](const Job& job) { return !isHurriedOnly || job.Haste == Pace::Hurried; });
}

//------------------------------------------------------------------------------
void pqPictureRefiner::wakeUp()
{
  const bool hasToTell = !this->Untold.isEmpty() && !pqInteraction::instance()->isOn();
  if (!this->Timer.isActive() && (hasToTell || this->nextJob() != this->Jobs.end()))
  {
    this->Timer.start(0);
  }
}

//------------------------------------------------------------------------------
void pqPictureRefiner::tellUpdate(pqPipelineSource* source)
{
  if (!this->Untold.isEmpty())
  {
    this->Untold.removeFirst();
  }
  if (source)
  {
    Q_EMIT source->dataUpdated(source);
  }
  this->wakeUp();
}

//------------------------------------------------------------------------------
void pqPictureRefiner::takeTurn()
{
  const auto next = this->nextJob();
  const bool isJob = next != this->Jobs.end();
  pqPipelineSource* source = sourceOf(isJob ? next->Filter : this->Untold.value(0));
  if (this->IsBusy || this->IsAnimationStep ||
    (source && source->getServer()->isProcessingPending()))
  {
    // This is an event loop within someone's update or rendering.
    this->Timer.start(10);
    return;
  }
  if (!isJob)
  {
    this->tellUpdate(source);
    return;
  }
  Job job = *next;
  this->Jobs.erase(next);
  bool isUnfinished = false;
  {
    const QuietWindow quiet(source);
    const QScopedValueRollback<bool> busy(this->IsBusy, true);
    isUnfinished = this->takeTurn(job);
  }
  if (isUnfinished && job.HasShown && !job.IsTold && sourceOf(job.Filter))
  {
    job.IsTold = true; // what panels say of the image is nearly right from the first samples on
    Q_EMIT source->dataUpdated(source);
  }
  if (!isUnfinished && job.Haste != Pace::Hurried && !this->Untold.contains(job.Filter))
  {
    this->Untold << job.Filter;
  }
  // Another job for this filter, or its end, may have come in meanwhile.
  if (isUnfinished && sourceOf(job.Filter) && !this->hasJob(job.Filter))
  {
    this->Jobs << job;
  }
  this->report();
  this->wakeUp();
}

//------------------------------------------------------------------------------
void pqPictureRefiner::report()
{
  QString what;
  int jobs = 0;
  int percent = 0;
  const bool isTime = !this->SinceReport.isValid() || this->SinceReport.elapsed() >= reportPeriod;
  for (const Job& job : this->Jobs)
  {
    pqPipelineSource* source = sourceOf(job.Filter);
    if (source && job.Haste != Pace::Hurried && job.Since.elapsed() >= unreported)
    {
      what = ++jobs == 1 ? source->getSMName() : QString("%1 images").arg(jobs);
      percent += isTime ? percentDone(job.Filter) : 0;
    }
  }
  if (jobs > 0 && isTime)
  {
    this->SinceReport.start();
    Q_EMIT this->progressed(what, percent / jobs);
  }
  else if (jobs == 0 && this->SinceReport.isValid())
  {
    this->SinceReport.invalidate();
    Q_EMIT this->progressed(QString(), 0);
  }
}

//------------------------------------------------------------------------------
bool pqPictureRefiner::isStopped(vtkSMProxy* filter) const
{
  return this->Stopped.contains(filter);
}

//------------------------------------------------------------------------------
void pqPictureRefiner::setStopped(vtkSMProxy* filter, bool isStopped)
{
  if (this->Stopped.contains(filter) != isStopped)
  {
    isStopped ? void(this->Stopped.insert(filter)) : void(this->Stopped.remove(filter));
    Q_EMIT this->stoppedChanged(filter);
  }
}

//------------------------------------------------------------------------------
void pqPictureRefiner::stop()
{
  if (this->IsBusy || this->isShort())
  {
    QTimer::singleShot(0, this, &pqPictureRefiner::stop);
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
    const QuietWindow quiet(source);
    QList<QPointer<pqView>> views;
    for (pqView* view : picturesInViews::showing(source))
    {
      views << view;
    }
    // What is there is made the filter's output, so that rendering does not ask for more.
    Speed speed = this->Speeds.value(filter);
    setTimeLimit(filter, shortestLimit);
    if (!views.isEmpty())
    {
      update(filter, views.front());
    }
    {
      SCOPED_UNDO_EXCLUDE();
      filter->InvokeCommand("Stop");
    }
    setTimeLimit(filter, 0);
    speed.IsRough = false;
    this->show(filter, speed.ShownCount, views);
    this->keep(filter, speed);
    if (sourceOf(filter) && isLeft(filter))
    {
      this->setStopped(filter, true);
    }
    this->Untold << filter.GetPointer();
  }
  this->report();
  this->wakeUp();
}

//------------------------------------------------------------------------------
void pqPictureRefiner::resume(vtkSMProxy* proxy)
{
  auto* filter = vtkSMSourceProxy::SafeDownCast(proxy);
  pqPipelineSource* source = sourceOf(filter);
  if (!source || !this->isStopped(filter))
  {
    return;
  }
  this->setStopped(filter, false);
  const ShortUpdates shortly;
  askForMore(filter);
  for (pqView* view : picturesInViews::showing(source))
  {
    view->forceRender();
  }
}

//------------------------------------------------------------------------------
bool pqPictureRefiner::takeTurn(Job& job)
{
  pqPipelineSource* source = sourceOf(job.Filter);
  if (!source || source->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return false;
  }
  QList<QPointer<pqView>> views;
  for (pqView* view : picturesInViews::showing(source))
  {
    views << view;
  }
  if (views.isEmpty())
  {
    return false;
  }
  // Until the first samples are there, the view would show the picture from before.
  const Speed speed = this->Speeds.value(job.Filter);
  const bool wantsRoughPicture = job.Haste == Pace::Thorough && !job.HasBegun &&
    speed.Reduction > 1 && speed.RoughPicture != changeOf(job.Filter);
  return job.Haste == Pace::Hurried || wantsRoughPicture ? this->hurry(job, views)
                                                         : this->goOn(job, views);
}

//------------------------------------------------------------------------------
bool pqPictureRefiner::hurry(Job& job, const QList<QPointer<pqView>>& views)
{
  const vtkSmartPointer<vtkSMSourceProxy> filter = job.Filter.GetPointer();
  Speed speed = this->Speeds.value(filter);
  const double available = speed.available();
  speed.RoughPicture = changeOf(filter);
  speed.IsRough = true;
  job.HasBegun = false;

  // A picture of all pixels has all their samples, too.
  const bool isOneSample = vtkSMPropertyHelper(filter, "SamplesPerPixel").GetAsInt() == 1;
  speed.Reduction = std::max(speed.Reduction, isOneSample ? 1 : 2);

  QElapsedTimer timer;
  timer.start();
  setReduction(filter, speed.Reduction);
  update(filter, views.front());
  speed.learn(secondsOf(timer), available);
  this->show(filter, speed.ShownCount, views);
  setReduction(filter, 1);
  this->keep(filter, speed);
  return job.Haste == Pace::Thorough;
}

//------------------------------------------------------------------------------
bool pqPictureRefiner::goOn(Job& job, const QList<QPointer<pqView>>& views)
{
  const vtkSmartPointer<vtkSMSourceProxy> filter = job.Filter.GetPointer();
  Speed speed = this->Speeds.value(filter);

  QElapsedTimer timer;
  timer.start();
  setTimeLimit(filter, speed.limit());
  // An update takes as long as a slice, whether there is anything to show or not.
  askForMore(filter);
  const bool hasNews = pictureCount(filter) != speed.ShownCount || isFinished(filter);
  const bool isPutOff = hasNews && !job.IsPutOff && secondsOf(timer) > shortSlice;
  job.IsPutOff = isPutOff;
  if (hasNews && !isPutOff)
  {
    update(filter, views.front());
    this->show(filter, speed.ShownCount, views);
    speed.IsRough = false;
    job.HasShown = true;
  }
  job.HasBegun = true;
  const bool isUnfinished = isPutOff || !isFinished(filter);
  setTimeLimit(filter, 0);
  if (isUnfinished)
  {
    askForMore(filter); // whoever else updates gets all of it
    speed.Overhead = std::max(secondsOf(timer) - speed.limit(), 0.97 * speed.Overhead);
  }
  this->keep(filter, speed);
  return isUnfinished;
}

//------------------------------------------------------------------------------
void pqPictureRefiner::show(
  vtkSMSourceProxy* filter, vtkIdType& shownCount, const QList<QPointer<pqView>>& views)
{
  const vtkIdType count = pictureCount(filter);
  // Nothing is what is left of a picture that failed.
  if (count == shownCount && filter->GetDataInformation(0)->GetNumberOfPoints() > 0)
  {
    return;
  }
  shownCount = count;
  for (const QPointer<pqView>& view : views)
  {
    if (view)
    {
      view->forceRender();
    }
  }
  Q_EMIT this->pictureChanged(filter);
}

//------------------------------------------------------------------------------
void pqPictureRefiner::onStartRender(vtkObject* proxy, unsigned long, void*, void* isInteractive)
{
  pqInteraction* interaction = pqInteraction::instance();
  auto* view = pqApplicationCore::instance()->getServerManagerModel()->findItem<pqView*>(
    vtkSMProxy::SafeDownCast(proxy));
  const bool isForUser = *static_cast<int*>(isInteractive) != 0 ||
    interaction->isAnsweredBy(proxy) || (view && isRenderingLater(view));
  interaction->setAnswered(proxy);
  if (this->IsBusy || this->IsAnimationStep || this->NumberOfShortUpdates > 0 || !view ||
    !isForUser)
  {
    return;
  }
  for (pqPipelineSource* source : picturesInViews::filters())
  {
    vtkSMSourceProxy* filter = source->getSourceProxy();
    const bool isUnfinished = this->Speeds.value(filter).IsRough || this->hasJob(filter);
    if ((isUnfinished || view->getViewProxy()->GetNeedsUpdate()) &&
      picturesInViews::showing(source).contains(view))
    {
      this->limit(filter);
    }
  }
}

//------------------------------------------------------------------------------
void pqPictureRefiner::onEndRender(vtkObject*)
{
  if (this->NumberOfShortUpdates == 0)
  {
    this->unlimit();
  }
}

//------------------------------------------------------------------------------
void pqPictureRefiner::limit(vtkSMSourceProxy* filter)
{
  setTimeLimit(filter, this->Speeds.value(filter).limit());
  this->Limited << filter;
}

//------------------------------------------------------------------------------
void pqPictureRefiner::unlimit()
{
  for (const vtkWeakPointer<vtkSMSourceProxy>& filter : this->Limited)
  {
    if (!filter)
    {
      continue;
    }
    if (!isFinished(filter))
    {
      askForMore(filter);
      if (!this->hasJob(filter))
      {
        this->refine(filter, Pace::Thorough);
      }
    }
    setTimeLimit(filter, 0);
    this->setStopped(filter, isLeft(filter));
  }
  this->Limited.clear();
}

//------------------------------------------------------------------------------
pqPictureRefiner::ShortUpdates::ShortUpdates()
{
  pqPictureRefiner* refiner = pqPictureRefiner::instance();
  if (refiner->NumberOfShortUpdates++ == 0)
  {
    refiner->unlimit();
    for (pqPipelineSource* source : picturesInViews::filters())
    {
      refiner->limit(source->getSourceProxy());
    }
  }
}

//------------------------------------------------------------------------------
pqPictureRefiner::ShortUpdates::~ShortUpdates()
{
  pqPictureRefiner* refiner = pqPictureRefiner::instance();
  if (--refiner->NumberOfShortUpdates == 0)
  {
    refiner->unlimit();
  }
}
