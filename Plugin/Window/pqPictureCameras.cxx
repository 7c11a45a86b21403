// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureCameras.h"

#include "SchlierenViews.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <cmath>

namespace
{

/// Where the filter's properties put the picture; false where they do not say.
bool wantedPlace(vtkSMProxy* filter, double center[2], double& halfHeight)
{
  if (vtkSMPropertyHelper(filter, "FocalPoint").GetNumberOfElements() != 3)
  {
    return false;
  }
  double direction[3];
  double up[3];
  double point[3];
  double right[3];
  vtkSMPropertyHelper(filter, "ViewDirection").Get(direction, 3);
  vtkSMPropertyHelper(filter, "ViewUp").Get(up, 3);
  vtkSMPropertyHelper(filter, "FocalPoint").Get(point, 3);
  halfHeight = vtkSMPropertyHelper(filter, "ParallelScale").GetAsDouble();
  vtkMath::Cross(direction, up, right);
  vtkMath::Cross(right, direction, up);
  if (vtkMath::Normalize(right) == 0 || vtkMath::Normalize(up) == 0)
  {
    return false;
  }
  center[0] = vtkMath::Dot(point, right);
  center[1] = vtkMath::Dot(point, up);
  return halfHeight > 0;
}

} // namespace

//------------------------------------------------------------------------------
pqPictureCameras::pqPictureCameras(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqPictureCameras::watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
}

//------------------------------------------------------------------------------
pqPictureCameras::~pqPictureCameras() = default;

//------------------------------------------------------------------------------
void pqPictureCameras::watch(pqView* item)
{
  if (auto* view = qobject_cast<pqRenderView*>(item))
  {
    // Between the update of a view's data and its rendering.
    QObject::connect(view, &pqView::updateDataEvent, this, [this, view]() { this->arrange(view); });
    QObject::connect(
      view, &QObject::destroyed, this, [this](QObject* gone) { this->Places.remove(gone); });
  }
}

//------------------------------------------------------------------------------
void pqPictureCameras::arrange(pqRenderView* view)
{
  const QList<pqPipelineSource*> filters = schlierenViews::picturesIn(view);
  const auto following = std::find_if(filters.begin(), filters.end(),
    [](pqPipelineSource* filter) { return !schlierenViews::followedName(filter).isEmpty(); });
  if (following == filters.end() || !schlierenViews::isFlat(view))
  {
    this->Places.remove(view);
    return;
  }
  Place place{ *following, {}, 0 };
  vtkPVDataInformation* picture = place.Filter->getSourceProxy()->GetDataInformation(0);
  const int* extent = picture->GetExtent();
  const double* bounds = picture->GetBounds();
  const int rows = extent[3] - extent[2] + 1;
  if (picture->GetNumberOfPoints() < 1 || rows < 2 ||
    !wantedPlace(place.Filter->getProxy(), place.Center, place.HalfHeight))
  {
    return;
  }
  // The picture may still be the one of another view.
  const double pixel = (bounds[3] - bounds[2]) / (rows - 1);
  const auto isCenter = [&](int axis)
  {
    return std::abs(0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) - place.Center[axis]) <
      1.5 * pixel;
  };
  if (!isCenter(0) || !isCenter(1) || std::abs(0.5 * rows * pixel - place.HalfHeight) > 1.5 * pixel)
  {
    return;
  }

  vtkSMRenderViewProxy* proxy = view->getRenderViewProxy();
  vtkCamera* camera = proxy->GetActiveCamera();
  double position[3];
  double focus[3];
  camera->GetPosition(position);
  camera->GetFocalPoint(focus);
  double scale = camera->GetParallelScale();
  Place before = this->Places.value(view, place);
  if (before.Filter != place.Filter)
  {
    before = place;
  }
  this->Places[view] = place;

  // Somewhere else altogether, the view has not been arranged for any picture.
  const double width = bounds[1] - bounds[0] + pixel;
  const bool isNear = std::abs(focus[0] - before.Center[0]) < width &&
    std::abs(focus[1] - before.Center[1]) < 2 * before.HalfHeight &&
    scale < 20 * before.HalfHeight && scale > 0.01 * before.HalfHeight;
  double moved[2];
  if (isNear)
  {
    const double zoom = place.HalfHeight / before.HalfHeight;
    for (int axis = 0; axis < 2; ++axis)
    {
      moved[axis] = place.Center[axis] + (focus[axis] - before.Center[axis]) * zoom - focus[axis];
    }
    scale *= zoom;
  }
  else
  {
    const QSize size = view->getSize();
    moved[0] = place.Center[0] - focus[0];
    moved[1] = place.Center[1] - focus[1];
    scale = std::max(place.HalfHeight, 0.5 * width * size.height() / std::max(size.width(), 1));
  }
  if (moved[0] == 0 && moved[1] == 0 && scale == camera->GetParallelScale())
  {
    return;
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    position[axis] += moved[axis];
    focus[axis] += moved[axis];
  }
  SCOPED_UNDO_EXCLUDE();
  proxy->SynchronizeCameraProperties();
  vtkSMPropertyHelper(proxy, "CameraPosition").Set(position, 3);
  vtkSMPropertyHelper(proxy, "CameraFocalPoint").Set(focus, 3);
  vtkSMPropertyHelper(proxy, "CameraParallelScale").Set(scale);
  proxy->UpdateVTKObjects();
}
