// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageProgress.h"

#include "HeldInput.h"
#include "ImagesInViews.h"
#include "pqRepresentationRefiner.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqProgressManager.h"
#include "pqProgressWidget.h"
#include "pqRepresentation.h"
#include "pqServerManagerModel.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProxy.h"
#include "vtkSchlierenFilter.h"

#include <QCoreApplication>
#include <QEvent>
#include <QMainWindow>
#include <QScopedValueRollback>
#include <QStatusBar>
#include <QWidget>

namespace
{

constexpr qint64 eventPeriod = 50; // milliseconds

pqProgressManager* manager() { return pqApplicationCore::instance()->getProgressManager(); }

pqProgressWidget* progressBar()
{
  QWidget* window = pqCoreUtilities::mainWidget();
  return window ? window->findChild<pqProgressWidget*>() : nullptr;
}

/// Returns whether an event may cause an update or a rendering, which must not nest.
bool isForLater(QObject* receiver, QEvent* event)
{
  return HeldInput::isInput(receiver, event) ||
    (event->type() == QEvent::Paint && receiver->inherits("QOpenGLWidget"));
}

} // namespace

pqImageProgress::pqImageProgress(QObject* parentObject)
  : QObject(parentObject)
{
  QObject::connect(pqRepresentationRefiner::instance(), &pqRepresentationRefiner::progressed, this,
    &pqImageProgress::show);
  QObject::connect(manager(), &pqProgressManager::progressEndEvent, this,
    [this]()
    {
      pqProgressWidget* bar = this->SinceEvents.isValid() ? progressBar() : nullptr;
      if (bar)
      {
        this->SinceEvents.invalidate();
        this->enableAbort(bar, this->IsRefining);
      }
    });
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::proxyAdded, this, &pqImageProgress::watch);
  for (pqProxy* item : model->findItems<pqProxy*>())
  {
    this->watch(item);
  }
}

pqImageProgress::~pqImageProgress() = default;

void pqImageProgress::watch(pqProxy* item)
{
  auto* representation = qobject_cast<pqRepresentation*>(item);
  vtkSMProxy* proxy = representation ? imagesInViews::benchOf(representation) : item->getProxy();
  vtkObjectBase* filter = proxy ? proxy->GetClientSideObject() : nullptr;
  if (filter && (filter->IsA("vtkSchlierenFilter") || filter->IsA("vtkRefractiveIndex")))
  {
    this->Connection->Connect(vtkAlgorithm::SafeDownCast(filter), vtkCommand::ProgressEvent, this,
      SLOT(letAbort(vtkObject*)));
  }
}

void pqImageProgress::show(const QString& what, int percent)
{
  this->IsRefining = !what.isEmpty();
  if (pqProgressWidget* bar = progressBar())
  {
    bar->enableProgress(this->IsRefining);
    bar->setProgress(what, percent);
    this->enableAbort(bar, this->IsRefining);
  }
}

void pqImageProgress::enableAbort(pqProgressWidget* bar, bool isEnabled)
{
  // Observes the button, whose signal ParaView 6.1 sends to nobody else.
  QObject::connect(
    bar, &pqProgressWidget::abortPressed, this, &pqImageProgress::abort, Qt::UniqueConnection);
  bar->enableAbort(isEnabled);
}

void pqImageProgress::abort()
{
  if (this->Executing)
  {
    if (auto* filter = vtkSchlierenFilter::SafeDownCast(this->Executing))
    {
      filter->Stop(); // ParaView updates it again
    }
    this->Executing->SetAbortExecute(1);
    if (auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()))
    {
      window->statusBar()->showMessage("Stopped.");
    }
  }
  else
  {
    pqRepresentationRefiner::instance()->stop();
  }
}

void pqImageProgress::letAbort(vtkObject* filter)
{
  pqProgressWidget* bar = progressBar();
  auto* algorithm = vtkAlgorithm::SafeDownCast(filter);
  // An update that only begins, or has ended, would not notice that it is aborted: events wait.
  const double done = algorithm->GetProgress() - algorithm->GetProgressShift();
  const bool isWithin = done > 0 && done < algorithm->GetProgressScale();
  if (this->Executing || !bar || !isWithin ||
    (this->SinceEvents.isValid() && this->SinceEvents.elapsed() < eventPeriod))
  {
    return;
  }
  this->enableAbort(bar, true);
  const QScopedValueRollback<vtkAlgorithm*> executing(this->Executing, algorithm);
  // Unblocks events, because ParaView blocks them during updates, also in the button's window.
  const bool wasUnblocked = manager()->unblockEvents(true);
  QCoreApplication::instance()->installEventFilter(this);
  QCoreApplication::processEvents(
    QEventLoop::ExcludeSocketNotifiers | QEventLoop::X11ExcludeTimers);
  QCoreApplication::instance()->removeEventFilter(this);
  manager()->unblockEvents(wasUnblocked);
  this->SinceEvents.start();
}

bool pqImageProgress::eventFilter(QObject* receiver, QEvent* event)
{
  if (!isForLater(receiver, event))
  {
    return QObject::eventFilter(receiver, event);
  }
  if (!HeldInput::note(event))
  {
    event->ignore();
  }
  return true;
}
