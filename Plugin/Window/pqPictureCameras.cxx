// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureCameras.h"

#include "CameraOfView.h"
#include "PicturesInViews.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCamera.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"

#include <QVariant>

#include <algorithm>
#include <cmath>

namespace
{

/// A property of a view whose image is still to come.
constexpr const char* isToBeFitted = "SchlierenIsToBeFitted";

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
void pqPictureCameras::fit(pqRenderView* view, pqPipelineSource* filter)
{
  const bool isFitted = fitViewToPicture(view->getRenderViewProxy(), filter->getProxy());
  view->setProperty(isToBeFitted, !isFitted);
}

//------------------------------------------------------------------------------
void pqPictureCameras::arrange(pqRenderView* view)
{
  const QList<pqPipelineSource*> filters = picturesInViews::picturesIn(view);
  if (view->property(isToBeFitted).toBool() && !filters.isEmpty())
  {
    SCOPED_UNDO_EXCLUDE();
    fit(view, filters.front());
  }
  const auto following = std::find_if(filters.begin(), filters.end(),
    [](pqPipelineSource* filter) { return !picturesInViews::followedName(filter).isEmpty(); });
  if (following == filters.end() || !picturesInViews::isFlat(view))
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
    !placeOfPicture(place.Filter->getProxy(), place.Center, place.HalfHeight))
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
  SCOPED_UNDO_EXCLUDE();
  if (!isNear)
  {
    fitViewToPicture(proxy, place.Filter->getProxy());
    return;
  }
  const double zoom = place.HalfHeight / before.HalfHeight;
  double moved[2];
  for (int axis = 0; axis < 2; ++axis)
  {
    moved[axis] = place.Center[axis] + (focus[axis] - before.Center[axis]) * zoom - focus[axis];
  }
  scale *= zoom;
  if (moved[0] == 0 && moved[1] == 0 && scale == camera->GetParallelScale())
  {
    return;
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    position[axis] += moved[axis];
    focus[axis] += moved[axis];
  }
  proxy->SynchronizeCameraProperties();
  vtkSMPropertyHelper(proxy, "CameraPosition").Set(position, 3);
  vtkSMPropertyHelper(proxy, "CameraFocalPoint").Set(focus, 3);
  vtkSMPropertyHelper(proxy, "CameraParallelScale").Set(scale);
  proxy->UpdateVTKObjects();
}
