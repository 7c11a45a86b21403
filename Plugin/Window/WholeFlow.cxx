// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFlow.h"

#include "UndoStep.h"

#include "pqRenderView.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMTrace.h"

#include <QWidget>

#include <algorithm>
#include <cmath>

namespace
{

/// Part of a view's width or height, the larger one, below which a flow is small.
constexpr double small = 0.4;

/// How a camera sees a box.
struct Framing
{
  double part = 0; // of the view's width or height, the larger one; 1: the camera is within
  bool isWhole = true;
};

Framing framingOf(vtkCamera* camera, double aspect, const vtkBoundingBox& box)
{
  vtkMatrix4x4* toView = camera->GetCompositeProjectionTransformMatrix(aspect, -1, 1);
  Framing framing;
  double low[2] = { 1, 1 }, high[2] = { -1, -1 };
  for (int corner = 0; corner < 8; ++corner)
  {
    double point[4] = { 0, 0, 0, 1 };
    box.GetCorner(corner, point);
    toView->MultiplyPoint(point, point);
    if (!(point[3] > 0)) // behind the camera
    {
      return { 1, false };
    }
    for (int axis = 0; axis < 2; ++axis)
    {
      const double place = point[axis] / point[3];
      framing.isWhole = framing.isWhole && std::abs(place) <= 1;
      low[axis] = std::min(low[axis], std::max(place, -1.));
      high[axis] = std::max(high[axis], std::min(place, 1.));
    }
  }
  framing.part = 0.5 * std::min(std::max(high[0] - low[0], high[1] - low[1]), 2.);
  if (!(high[0] > low[0] && high[1] > low[1])) // outside
  {
    framing.part = 0;
  }
  return framing;
}

/// Moves a camera as vtkRenderer::ResetCamera() does.
void showAll(vtkCamera* camera, double aspect, const vtkBoundingBox& box)
{
  const double radius = 0.5 * box.GetDiagonalLength();
  const double narrow = std::min(1., aspect);
  const double half =
    std::atan(narrow * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle())));
  const double* direction = camera->GetDirectionOfProjection();
  double center[3], position[3];
  box.GetCenter(center);
  for (int axis = 0; axis < 3; ++axis)
  {
    position[axis] = center[axis] - radius / std::sin(half) * direction[axis];
  }
  camera->SetFocalPoint(center);
  camera->SetPosition(position);
  camera->SetParallelScale(radius / narrow);
}

/// Reads the protected bounds of what a view shows.
struct Bounded : vtkPVRenderView
{
  static const vtkBoundingBox& Of(vtkPVRenderView* view)
  {
    return view->*(&Bounded::GeometryBounds);
  }
};

} // namespace

double aspectOf(pqView* view)
{
  return static_cast<double>(std::max(1, view->widget()->width())) /
    std::max(1, view->widget()->height());
}

bool isWhole(pqRenderView* view, double aspect, const vtkBoundingBox& box)
{
  return framingOf(view->getRenderViewProxy()->GetActiveCamera(), aspect, box).isWhole;
}

bool frameFlow(pqRenderView* scene, const std::vector<pqRenderView*>& views, bool wasWhole)
{
  auto* shown = vtkPVRenderView::SafeDownCast(views.front()->getProxy()->GetClientSideObject());
  const vtkBoundingBox box = Bounded::Of(shown);
  vtkSMRenderViewProxy* proxy = scene->getRenderViewProxy();
  vtkCamera* camera = proxy->GetActiveCamera();
  std::vector<double> aspects;
  std::transform(views.begin(), views.end(), std::back_inserter(aspects), aspectOf);
  vtkNew<vtkCamera> framed;
  framed->DeepCopy(camera);
  showAll(framed, *std::min_element(aspects.begin(), aspects.end()), box);
  const bool isToMove = std::any_of(aspects.begin(), aspects.end(),
    [&](double aspect)
    {
      const Framing now = framingOf(camera, aspect, box), then = framingOf(framed, aspect, box);
      return (wasWhole && !now.isWhole && then.isWhole) ||
        (now.part < small && now.part < then.part);
    });
  if (!isToMove)
  {
    return false;
  }
  const auto moveBack = cameraSetter(proxy, proxy);
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
    vtkSMPropertyHelper(proxy, "CameraFocalPoint").Set(framed->GetFocalPoint(), 3);
    vtkSMPropertyHelper(proxy, "CenterOfRotation").Set(framed->GetFocalPoint(), 3);
    vtkSMPropertyHelper(proxy, "CameraPosition").Set(framed->GetPosition(), 3);
    vtkSMPropertyHelper(proxy, "CameraParallelScale").Set(framed->GetParallelScale());
    proxy->UpdateVTKObjects();
  }
  addUndoStep(moveBack, cameraSetter(proxy, proxy));
  return true;
}
