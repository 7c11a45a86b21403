// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCameraFollower.h"

#include "SchlierenViews.h"
#include "pqInteraction.h"
#include "pqPictureCameras.h"
#include "pqPictureRefiner.h"
#include "pqPictureStatus.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkMath.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{

const char* const viewProperties[] = { "ViewDirection", "ViewUp", "FocalPoint", "ParallelScale" };

struct View
{
  std::array<double, 3> Direction;
  std::array<double, 3> Up;
  std::array<double, 3> FocalPoint;
  double ParallelScale;

  explicit View(vtkCamera* camera)
  {
    camera->GetDirectionOfProjection(this->Direction.data());
    camera->GetViewUp(this->Up.data());
    camera->GetFocalPoint(this->FocalPoint.data());
    this->ParallelScale = camera->GetParallelProjection()
      ? camera->GetParallelScale()
      : camera->GetDistance() * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  }

  /// Not so in the middle of a change of several properties of a camera.
  bool isUsable() const
  {
    std::array<double, 3> right{};
    vtkMath::Cross(this->Direction.data(), this->Up.data(), right.data());
    const double size = vtkMath::Norm(right.data());
    return size > 1e-6 * vtkMath::Norm(this->Up.data()) && std::isfinite(size) &&
      this->ParallelScale > 0 && std::isfinite(this->ParallelScale) &&
      std::all_of(this->FocalPoint.begin(), this->FocalPoint.end(),
        [](double value) { return std::isfinite(value); });
  }
};

/// Sets a property; returns whether it was different.
bool set(vtkSMProxy* filter, const char* name, const double* values, unsigned int count)
{
  vtkSMPropertyHelper property(filter, name);
  const std::vector<double> before = property.GetDoubleArray();
  if (std::equal(before.begin(), before.end(), values, values + count))
  {
    return false;
  }
  property.Set(values, count);
  return true;
}

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
  QObject::connect(model, &pqServerManagerModel::nameChanged, this, &pqCameraFollower::onName);
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
    this->Connection->Connect(camera, vtkCommand::ModifiedEvent, this,
      SLOT(onCamera(vtkObject*, unsigned long, void*)), proxy);
    this->onCamera(camera, vtkCommand::ModifiedEvent, proxy);
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::watchSource(pqPipelineSource* source)
{
  if (schlierenViews::isSchlieren(source))
  {
    this->Connection->Connect(
      source->getProxy(), vtkCommand::UpdateEvent, this, SLOT(onFilter(vtkObject*)));
    this->onFilter(source->getProxy());
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::onCamera(vtkObject*, unsigned long, void* view)
{
  for (pqPipelineSource* filter : schlierenViews::filters())
  {
    pqRenderView* followed = schlierenViews::followed(filter);
    if (followed && followed->getProxy() == view &&
      (pqInteraction::instance()->isOn() || this->push(filter, followed)))
    {
      if (!this->Changed.contains(filter))
      {
        this->Changed << filter;
      }
      if (!this->Timer.isActive())
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
  pqRenderView* view = filter && !this->IsPushing ? schlierenViews::followed(filter) : nullptr;
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
  for (pqPipelineSource* filter : schlierenViews::filters())
  {
    if (view && this->Followed.value(filter) == view &&
      schlierenViews::followedName(filter) != view->getSMName())
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
  vtkSMProxy* proxy = filter->getProxy();
  const View seen(view->getRenderViewProxy()->GetActiveCamera());
  if (!seen.isUsable() || this->IsPushing)
  {
    return false;
  }
  this->IsPushing = true;
  SCOPED_UNDO_EXCLUDE();
  bool isChanged = set(proxy, "ViewDirection", seen.Direction.data(), 3);
  isChanged = set(proxy, "ViewUp", seen.Up.data(), 3) || isChanged;
  isChanged = set(proxy, "FocalPoint", seen.FocalPoint.data(), 3) || isChanged;
  isChanged = set(proxy, "ParallelScale", &seen.ParallelScale, 1) || isChanged;
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
    pqRenderView* view = filter ? schlierenViews::followed(filter) : nullptr;
    if (view)
    {
      this->push(filter, view);
    }
  }
  if (!this->Changed.isEmpty())
  {
    this->Timer.start(0);
  }
}

//------------------------------------------------------------------------------
void pqCameraFollower::catchUp()
{
  const bool isMoving = pqInteraction::instance()->isOn();
  const QList<QPointer<pqPipelineSource>> filters = this->Changed;
  if (!isMoving)
  {
    this->Changed.clear();
  }
  for (const QPointer<pqPipelineSource>& filter : filters)
  {
    pqRenderView* view = filter ? schlierenViews::followed(filter) : nullptr;
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
    pqPictureRefiner::instance()->refine(proxy, pqPictureRefiner::Pace::Thorough);
  }
}
