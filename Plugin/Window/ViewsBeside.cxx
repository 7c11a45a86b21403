// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewsBeside.h"

#include "ImagesInViews.h"
#include "UndoStep.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "vtkNew.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSmartPointer.h"

#include <QCoreApplication>
#include <QPointer>
#include <QWidget>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace
{

/// Returns the size of the view in pixels of the screen.
std::array<int, 2> sizeOf(pqView* view)
{
  // Lays out widgets that are new in a layout.
  QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
  const QWidget* widget = view->widget();
  const double pixels = widget->devicePixelRatioF();
  return { std::max(1, int(std::lround(widget->width() * pixels))),
    std::max(1, int(std::lround(widget->height() * pixels))) };
}

/// Adds a tab.
vtkSMViewLayoutProxy* newLayout(pqServer* server)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  vtkSMSessionProxyManager* proxies = server->proxyManager();
  auto layout = vtkSmartPointer<vtkSMProxy>::Take(proxies->NewProxy("misc", "ViewLayout"));
  controller->InitializeProxy(layout);
  controller->RegisterLayoutProxy(
    layout, proxies->GetUniqueProxyName("layouts", "Schlieren Images", false).c_str());
  return vtkSMViewLayoutProxy::SafeDownCast(layout);
}

/// Moves the camera of a narrowed 3-D view back, so that its content stays visible.
void keepInSight(
  pqRenderView* scene, const std::array<int, 2>& before, const std::array<int, 2>& now)
{
  const double factor =
    std::min(1.0, double(before[0]) / before[1]) / std::min(1.0, double(now[0]) / now[1]);
  if (factor > 1)
  {
    vtkSMRenderViewProxy* proxy = scene->getRenderViewProxy();
    const auto stepForward = cameraSetter(proxy, proxy);
    const auto focus = vtkSMPropertyHelper(proxy, "CameraFocalPoint").GetDoubleArray();
    auto position = vtkSMPropertyHelper(proxy, "CameraPosition").GetDoubleArray();
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = focus[axis] + factor * (position[axis] - focus[axis]);
    }
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
      vtkSMPropertyHelper(proxy, "CameraPosition").Set(position.data(), 3);
      vtkSMPropertyHelper scale(proxy, "CameraParallelScale");
      scale.Set(factor * scale.GetAsDouble());
      proxy->UpdateVTKObjects();
    }
    addUndoStep(stepForward, cameraSetter(proxy, proxy));
  }
}

} // namespace

pqRenderView* sceneBeside(pqOutputPort* flow)
{
  if (pqRenderView* there = imagesInViews::scene(flow))
  {
    return there;
  }
  auto* builder = pqApplicationCore::instance()->getObjectBuilder();
  auto* made = qobject_cast<pqRenderView*>(builder->createView("RenderView", flow->getServer()));
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->AssignViewToLayout(
    made->getViewProxy(), pqActiveObjects::instance().activeLayout(), 0);
  controller->Show(flow->getSourceProxy(), flow->getPortNumber(), made->getRenderViewProxy());
  SM_SCOPED_TRACE(CallMethod)
    .arg(made->getProxy())
    .arg("ResetCamera")
    .arg("comment", "reset view to fit data");
  made->getRenderViewProxy()->ResetCamera();
  return made;
}

pqRenderView* addViewIn(
  pqServer* server, vtkSMViewLayoutProxy* layout, int cell, const QString& name)
{
  // ParaView handles events while it shows the view.
  const vtkSmartPointer<vtkSMViewLayoutProxy> kept = layout;
  auto* builder = pqApplicationCore::instance()->getObjectBuilder();
  const QPointer<pqRenderView> view =
    qobject_cast<pqRenderView*>(builder->createView("RenderView", server));
  layout->AssignView(cell, view->getViewProxy());
  if (!view)
  {
    return nullptr;
  }
  const std::string unique =
    server->proxyManager()->GetUniqueProxyName("views", qUtf8Printable(name), false);
  view->rename(QString::fromStdString(unique));
  return view;
}

std::vector<pqRenderView*> addViewsBeside(pqRenderView* scene, const std::vector<QString>& names)
{
  // Puts the view of a script into a layout.
  if (!vtkSMViewLayoutProxy::FindLayout(scene->getViewProxy()))
  {
    vtkNew<vtkSMParaViewPipelineControllerWithRendering>()->AssignViewToLayout(
      scene->getViewProxy());
  }
  // ParaView handles events with each change of a layout.
  const QPointer<pqRenderView> isThere = scene;
  vtkSmartPointer<vtkSMViewLayoutProxy> layout =
    vtkSMViewLayoutProxy::FindLayout(scene->getViewProxy());
  const int cellOfScene = layout->GetViewLocation(scene->getViewProxy());
  const bool isCrowded = names.size() > 1 && layout->GetViews().size() > 1;
  const std::array<int, 2> before = sizeOf(scene);
  noteLayout(layout, cellOfScene);
  if (!isThere)
  {
    return {};
  }
  if (isCrowded)
  {
    layout = newLayout(scene->getServer());
  }
  const int left =
    isCrowded ? layout->SplitVertical(0, 0.5) : layout->SplitHorizontal(cellOfScene, 0.5);
  std::vector<int> cells = { left + 1 };
  if (isCrowded) // the first one as wide as the tab
  {
    const int below = layout->SplitHorizontal(left + 1, 0.5);
    cells = { left, below, below + 1 };
  }
  else if (names.size() > 1)
  {
    const int right = layout->SplitVertical(left + 1, 0.5);
    cells = { right, layout->SplitVertical(left, 0.5) + 1,
      right + 1 }; // the second one below the scene
  }
  // Activates the 3-D view, because ParaView's toolbar shows the axes of the first active view,
  // which traces would not survive while that is made.
  if (!isThere)
  {
    return {};
  }
  pqActiveObjects::instance().setActiveView(scene);
  std::vector<pqRenderView*> views;
  for (std::size_t i = 0; i < cells.size() && isThere; ++i)
  {
    views.push_back(addViewIn(scene->getServer(), layout, cells[i], names[i]));
  }
  if (!isThere || std::find(views.begin(), views.end(), nullptr) != views.end())
  {
    return {};
  }
  keepInSight(scene, before, sizeOf(scene));
  return views;
}
