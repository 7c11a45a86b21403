// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCameraFollower.h"

#include "CameraOfView.h"
#include "PicturesInViews.h"
#include "pqApplyHooks.h"
#include "pqImageProgress.h"
#include "pqInteraction.h"
#include "pqPictureCameras.h"
#include "pqPictureRefiner.h"
#include "pqPictureStatus.h"
#include "pqRepresentationRefiner.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

namespace
{

const char* const viewProperties[] = { "ViewDirection", "ViewUp", "FocalPoint", "ParallelScale" };

} // namespace

//------------------------------------------------------------------------------
pqCameraFollower::pqCameraFollower() = default;

//------------------------------------------------------------------------------
pqCameraFollower::~pqCameraFollower() = default;

//------------------------------------------------------------------------------
void pqCameraFollower::startup()
{
  // A plugin that is loaded again starts another one.
  static QPointer<pqCameraFollower> first;
  if (first || !pqApplicationCore::instance())
  {
    return;
  }
  first = this;

  this->Timer.setSingleShot(true);
  QObject::connect(&this->Timer, &QTimer::timeout, this, &pqCameraFollower::catchUp);
  QObject::connect(
    pqInteraction::instance(), &pqInteraction::ended, this, &pqCameraFollower::onReleased);

  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::sourceAdded, this, &pqCameraFollower::watchSource);
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqCameraFollower::watchView);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watchView(view);
  }
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watchSource(source);
  }
  new pqPictureCameras(this);
  new pqPictureStatus(this);
  new pqRepresentationRefiner(this);
  new pqImageProgress(this);
  // ParaView's window may come after its plugins.
  auto* hooks = new pqApplyHooks(this);
  QObject::connect(model, &pqServerManagerModel::sourceAdded, hooks,
    [hooks](pqPipelineSource*) { hooks->setUp(); });
}

//------------------------------------------------------------------------------
void pqCameraFollower::shutdown() { this->Timer.stop(); }

//------------------------------------------------------------------------------
void pqCameraFollower::watchView(pqView* view)
{
  auto* proxy = vtkSMRenderViewProxy::SafeDownCast(view->getProxy());
  vtkCamera* camera = proxy ? proxy->GetActiveCamera() : nullptr;
  if (camera)
  {
    QObject::connect(view, &pqProxy::nameChanged, this, &pqCameraFollower::onName);
    this->Connection->Connect(camera, vtkCommand::ModifiedEvent, this,
      SLOT(onCamera(vtkObject*, unsigned long, void*)), proxy);
    this->onCamera(camera, vtkCommand::ModifiedEvent, proxy);
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::watchSource(pqPipelineSource* source)
{
  if (picturesInViews::isSchlieren(source))
  {
    this->Connection->Connect(
      source->getProxy(), vtkCommand::UpdateEvent, this, SLOT(onFilter(vtkObject*)));
    this->onFilter(source->getProxy());
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::onCamera(vtkObject*, unsigned long, void* view)
{
  for (pqPipelineSource* filter : picturesInViews::filters())
  {
    pqRenderView* followed = picturesInViews::followed(filter);
    const bool isMoving = pqInteraction::instance()->isOn();
    if (followed && followed->getProxy() == view && (isMoving || this->push(filter, followed)))
    {
      if (!isMoving)
      {
        pqPictureRefiner::instance()->refine(filter->getProxy(), pqPictureRefiner::Pace::Thorough);
      }
      if (!this->Changed.contains(filter))
      {
        this->Changed << filter;
      }
      if (isMoving)
      {
        this->catchUpSoon();
      }
      else if (!this->Timer.isActive())
      {
        this->Timer.start(0);
      }
    }
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::onFilter(vtkObject* proxy)
{
  // Following may have begun, or something else may have changed the filter's view.
  auto* filter =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
      vtkSMProxy::SafeDownCast(proxy));
  pqRenderView* view = filter && !this->IsPushing ? picturesInViews::followed(filter) : nullptr;
  if (view)
  {
    this->onCamera(nullptr, vtkCommand::ModifiedEvent, view->getProxy());
  }
  if (filter && !this->IsPushing)
  {
    this->Followed[filter] = view;
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::onName(pqServerManagerModelItem* item)
{
  auto* view = qobject_cast<pqRenderView*>(item);
  for (pqPipelineSource* filter : picturesInViews::filters())
  {
    if (view && this->Followed.value(filter) == view &&
      picturesInViews::followedName(filter) != view->getSMName())
    {
      SCOPED_UNDO_EXCLUDE();
      vtkSMPropertyHelper(filter->getProxy(), "FollowedView")
        .Set(view->getSMName().toUtf8().data());
      filter->getProxy()->UpdateVTKObjects();
    }
  }
}

//------------------------------------------------------------------------------
bool pqCameraFollower::push(pqPipelineSource* filter, pqRenderView* view)
{
  if (this->IsPushing)
  {
    return false;
  }
  vtkSMProxy* proxy = filter->getProxy();
  this->IsPushing = true;
  SCOPED_UNDO_EXCLUDE();
  const bool isChanged = takeCameraOfView(proxy, view->getRenderViewProxy());
  if (isChanged)
  {
    proxy->UpdateVTKObjects();
  }
  this->IsPushing = false;
  return isChanged;
}

//------------------------------------------------------------------------------
void pqCameraFollower::onReleased()
{
  for (const QPointer<pqPipelineSource>& filter : this->Changed)
  {
    pqRenderView* view = filter ? picturesInViews::followed(filter) : nullptr;
    if (view)
    {
      this->push(filter, view);
      pqPictureRefiner::instance()->refine(filter->getProxy(), pqPictureRefiner::Pace::Thorough);
    }
  }
  if (!this->Changed.isEmpty())
  {
    this->Timer.start(0);
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::catchUpSoon()
{
  // Between the frame of the view that moves and the painting of the window, which then has both to show.
  if (!this->IsCatchingUp)
  {
    this->IsCatchingUp = true;
    QMetaObject::invokeMethod(this, &pqCameraFollower::catchUp, Qt::QueuedConnection);
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::catchUp()
{
  this->IsCatchingUp = false;
  const bool isMoving = pqInteraction::instance()->isOn();
  const QList<QPointer<pqPipelineSource>> filters = this->Changed;
  if (!isMoving)
  {
    this->Changed.clear();
  }
  for (const QPointer<pqPipelineSource>& filter : filters)
  {
    pqRenderView* view = filter ? picturesInViews::followed(filter) : nullptr;
    if (!view)
    {
      continue;
    }
    vtkSMProxy* proxy = filter->getProxy();
    if (isMoving)
    {
      if (this->push(filter, view))
      {
        pqPictureRefiner::instance()->refine(proxy, pqPictureRefiner::Pace::Hurried);
      }
      continue;
    }
    if (vtkSMTrace::GetActiveTracer())
    {
      // What is traced is what has been modified since here.
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
      for (const char* name : viewProperties)
      {
        proxy->GetProperty(name)->Modified();
      }
    }
  }
}
