// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchlierenViews.h"

#include "FlowOfPort.h"
#include "ImageDisplay.h"
#include "ImagesInViews.h"
#include "UndoStep.h"
#include "VolumeDisplay.h"
#include "pqImageRefiner.h"
#include "pqRepresentationRefiner.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerResource.h"
#include "pqUndoStack.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxyListDomain.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSchlierenFilter.h"
#include "vtkSmartPointer.h"

#include <QApplication>
#include <QScopeGuard>
#include <QWidget>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

namespace
{

using SchlierenViews::Arrangement;
using SchlierenViews::Cell;
using Filter = vtkSchlierenFilter;

void setInt(vtkSMProxy* proxy, const char* name, int value)
{
  vtkSMPropertyHelper(proxy, name).Set(value);
}

/// Pixels of the screen that the view covers.
std::array<int, 2> sizeOf(pqView* view)
{
  // Widgets that have just been put into a layout have their sizes after this.
  QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
  const QWidget* widget = view->widget();
  const double pixels = widget->devicePixelRatioF();
  return { std::max(1, int(std::lround(widget->width() * pixels))),
    std::max(1, int(std::lround(widget->height() * pixels))) };
}

/// Makes a view one for the image of a filter.
void flatten(vtkSMProxy* view)
{
  setInt(view, "InteractionMode", vtkPVRenderView::INTERACTION_MODE_2D);
  setInt(view, "CameraParallelProjection", 1);
  setInt(view, "OrientationAxesVisibility", 0);
  setInt(view, "CenterAxesVisibility", 0);
  setInt(view, "UseFXAA", 0); // it would smear the image's own edges
  setInt(view, "UseColorPaletteForBackground", 0);
  const double darkGrey[3] = { 0.2, 0.2, 0.2 };
  vtkSMPropertyHelper(view, "Background").Set(darkGrey, 3);
  view->UpdateVTKObjects();
}

/// Why the server cannot make images; empty where it can.
QString problemOfServer(pqServer* server)
{
  if (server->proxyManager()->HasDefinition("filters", "Schlieren"))
  {
    return QString();
  }
  const pqServerResource resource = server->getResource();
  return "The server " + resource.host() + ":" + QString::number(resource.port()) +
    " has not loaded the plugin Schlieren, so no image can be made there. Choose Tools > Manage "
    "Plugins, and load Schlieren.so under Remote Plugins.";
}

/// The proxy of the filter inside of a representation.
vtkSMProxy* benchOf(vtkSMProxy* representation)
{
  return vtkSMPropertyHelper(representation, "SchlierenBench").GetAsProxy();
}

/// The representation in a view that draws this flow as Schlieren; null where none does.
vtkSMProxy* drawnAsSchlieren(pqOutputPort* flow, pqView* view)
{
  pqDataRepresentation* shown = view ? flow->getRepresentation(view) : nullptr;
  return shown && pqRepresentationRefiner::isSchlieren(shown) ? shown->getProxy() : nullptr;
}

/// Copies what is set on a Schlieren filter, or on one inside of a representation, but for the flow, the camera and the
/// size.
void copySettings(vtkSMProxy* from, vtkSMProxy* to)
{
  auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(to->NewPropertyIterator());
  for (; !properties->IsAtEnd(); properties->Next())
  {
    const char* name = properties->GetKey();
    vtkSMProperty* property = properties->GetProperty();
    vtkSMProperty* pattern = from->GetProperty(name);
    if (!pattern || property->GetInformationOnly() || property->GetIsInternal() ||
      std::strcmp(name, "Input") == 0)
    {
      continue;
    }
    if (property->FindDomain<vtkSMProxyListDomain>())
    {
      // Each has a curve of its own.
      vtkSMProxy* curve = vtkSMPropertyHelper(property).GetAsProxy();
      curve->Copy(vtkSMPropertyHelper(pattern).GetAsProxy());
      curve->UpdateVTKObjects();
      continue;
    }
    property->Copy(pattern);
  }
}

/// Renders a view once as it is when its image is complete.
void renderCompletely(pqRenderView* view, vtkSMProxy* representation)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper slice(representation, "SchlierenTimeSlice");
  const double before = slice.GetAsDouble();
  slice.Set(0.);
  representation->UpdateVTKObjects();
  view->forceRender();
  slice.Set(before);
  representation->UpdateVTKObjects();
}

/// Makes the views of one flow and everything around them.
class Builder
{
public:
  /// `pattern`: what has the settings that are to be used; null: they are chosen for the flow.
  explicit Builder(pqOutputPort* flow, vtkSMProxy* pattern)
    : Flow(flow)
    , Pattern(pattern)
    , Server(flow->getServer())
    , Defaults(flowDefaults(arraysOfFlow(flow)))
  {
  }

  SchlierenViews::Result add(Arrangement arrangement, const Cell& cell)
  {
    this->findScene();
    switch (arrangement)
    {
      case Arrangement::OneImage:
        // A 3-D view that there was not before may have taken the cell.
        if (cell.layout && !cell.layout->GetView(cell.number))
        {
          this->Views.push_back(this->addView(cell.layout, cell.number));
        }
        else
        {
          this->addViews(1);
        }
        this->addImage(0, [](vtkSMProxy*) {});
        break;
      case Arrangement::ThreeImages:
        this->addViews(3);
        this->addImage(0, [](vtkSMProxy* bench) { setInt(bench, "Cutoff", Filter::KNIFE_EDGE); });
        this->addImage(1, [](vtkSMProxy* bench) { setInt(bench, "Cutoff", Filter::SHADOWGRAPH); });
        this->addImage(
          2, [](vtkSMProxy* bench) { setInt(bench, "Cutoff", Filter::INTERFEROGRAM); });
        break;
      case Arrangement::Comparison:
        this->addViews(3);
        this->addImage(0, [](vtkSMProxy* bench) { setInt(bench, "PathModel", Filter::STRAIGHT); });
        this->addImage(1, [](vtkSMProxy* bench) { setInt(bench, "PathModel", Filter::REFRACTED); });
        this->addImage(
          2, [](vtkSMProxy* bench) { setInt(bench, "PathModel", Filter::DIFFERENCE); });
        break;
    }
    this->useCameraOfScene();
    if (arrangement == Arrangement::Comparison)
    {
      this->useOneKOf(1);
    }
    else
    {
      this->Views[0]->forceRender(); // which finds the ambient refractivity
    }
    showAsVolume(this->Flow, this->Scene, this->Defaults, benchOf(this->Images[0]));
    pqActiveObjects::instance().setActiveView(this->Views[0]);
    pqActiveObjects::instance().setActivePort(this->Flow);
    for (pqRenderView* view : this->Views)
    {
      linkCameras(this->Scene, view);
    }
    if (this->Pattern)
    {
      return { true, true, "Set as the selected one is." };
    }
    return { true, this->Defaults.isSure, QString::fromStdString(this->Defaults.message) };
  }

  /// Shows the image of a filter in a view of its own, where it fills it.
  void show(pqPipelineSource* filter)
  {
    this->findScene();
    this->addViews(1);
    pqRenderView* view = this->Views[0];
    vtkSMRenderViewProxy* window = view->getRenderViewProxy();
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", window);
      flatten(window);
    }
    const pqImageRefiner::ShortUpdates shortly;
    vtkSMProxy* representation = this->Controller->Show(filter->getSourceProxy(), 0, window);
    if (representation)
    {
      // ParaView shows the outline of data that are not there yet.
      vtkSMPropertyHelper type(representation, "Representation");
      if (std::strcmp(type.GetAsString(), "Outline") == 0)
      {
        SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
        type.Set("Slice");
        representation->UpdateVTKObjects();
      }
      ImageDisplay::apply(representation, filter->getProxy());
    }
    {
      SM_SCOPED_TRACE(CallMethod).arg(window).arg("ResetCamera").arg(true);
      window->ResetCamera(true); // which fills the view
    }
    const auto redo = [id = ProxyById(window), setCamera = cameraSetter(window, window)]()
    {
      if (vtkSMProxy* again = id.get())
      {
        flatten(again);
        setCamera();
      }
    };
    addUndoStep([]() {}, redo);
    pqActiveObjects::instance().setActiveView(view);
  }

  void render()
  {
    this->Scene->render();
    for (pqRenderView* view : this->Views)
    {
      view->render();
    }
  }

private:
  /// The 3-D view, one that shows the flow where there was none.
  void findScene()
  {
    this->Scene = imagesInViews::scene(this->Server);
    if (!this->Scene)
    {
      auto* builder = pqApplicationCore::instance()->getObjectBuilder();
      this->Scene = qobject_cast<pqRenderView*>(builder->createView("RenderView", this->Server));
      vtkSMViewLayoutProxy* layout = pqActiveObjects::instance().activeLayout();
      this->Controller->AssignViewToLayout(this->Scene->getViewProxy(), layout, 0);
      this->Controller->Show(this->Flow->getSourceProxy(), this->Flow->getPortNumber(),
        this->Scene->getRenderViewProxy());
      SM_SCOPED_TRACE(CallMethod)
        .arg(this->Scene->getProxy())
        .arg("ResetCamera")
        .arg("comment", "reset view to fit data");
      this->Scene->getRenderViewProxy()->ResetCamera();
    }
  }

  /// Empty views beside the 3-D view: one to its right, or three, with which it makes a square.
  void addViews(int number)
  {
    // A script may have made a view without a place.
    if (!vtkSMViewLayoutProxy::FindLayout(this->Scene->getViewProxy()))
    {
      this->Controller->AssignViewToLayout(this->Scene->getViewProxy());
    }
    const std::array<int, 2> before = sizeOf(this->Scene);
    vtkSMViewLayoutProxy* layout = vtkSMViewLayoutProxy::FindLayout(this->Scene->getViewProxy());
    const int left =
      layout->SplitHorizontal(layout->GetViewLocation(this->Scene->getViewProxy()), 0.5);
    std::vector<int> cells = { left + 1 };
    if (number > 1)
    {
      const int right = layout->SplitVertical(left + 1, 0.5);
      const int underScene = layout->SplitVertical(left, 0.5) + 1;
      cells = { right, underScene, right + 1 };
    }
    // ParaView's toolbar shows the axes of a view that becomes active after one without: in the middle of making
    // it, which traces would not survive.
    pqActiveObjects::instance().setActiveView(this->Scene);
    for (const int cell : cells)
    {
      this->Views.push_back(this->addView(layout, cell));
    }
    this->keepInSight(before, sizeOf(this->Scene));
  }

  pqRenderView* addView(vtkSMViewLayoutProxy* layout, int cell)
  {
    auto* builder = pqApplicationCore::instance()->getObjectBuilder();
    auto* view = qobject_cast<pqRenderView*>(builder->createView("RenderView", this->Server));
    layout->AssignView(cell, view->getViewProxy());
    return view;
  }

  /// Steps back in a 3-D view that has become narrow, so that what was in its middle is seen.
  void keepInSight(const std::array<int, 2>& before, const std::array<int, 2>& now)
  {
    const double factor =
      std::min(1.0, double(before[0]) / before[1]) / std::min(1.0, double(now[0]) / now[1]);
    if (factor > 1)
    {
      vtkSMRenderViewProxy* proxy = this->Scene->getRenderViewProxy();
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

  /// Draws the flow as Schlieren in a view.
  void addImage(std::size_t view, const std::function<void(vtkSMProxy*)>& set)
  {
    vtkSMProxy* shown = this->Controller->Show(this->Flow->getSourceProxy(),
      this->Flow->getPortNumber(), this->Views[view]->getRenderViewProxy());
    vtkSMProxy* bench = benchOf(shown);
    vtkSMRepresentationProxy::SetRepresentationType(shown, "Schlieren");
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", bench);
    if (this->Pattern)
    {
      copySettings(this->Pattern, bench);
    }
    else
    {
      setFlowDefaults(bench, this->Defaults);
    }
    set(bench);
    bench->UpdateVTKObjects();
    this->Images.push_back(shown);
  }

  /// Lets the new views see what the 3-D view does, with no axes over the image's middle.
  void useCameraOfScene()
  {
    for (pqRenderView* view : this->Views)
    {
      vtkSMProxy* proxy = view->getProxy();
      const auto setView = [id = ProxyById(proxy),
                             setCamera = cameraSetter(this->Scene->getRenderViewProxy(), proxy)]()
      {
        if (vtkSMProxy* again = id.get())
        {
          setInt(again, "CenterAxesVisibility", 0);
          setCamera();
        }
      };
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
      setView();
      addUndoStep([]() {}, setView);
    }
  }

  /// Gives all images the automatic k of one.
  void useOneKOf(std::size_t image)
  {
    vtkSMProxy* bench = benchOf(this->Images[image]);
    const int cutoff = vtkSMPropertyHelper(bench, "Cutoff").GetAsInt();
    if (!Filter::CutoffHasK(cutoff) || vtkSMPropertyHelper(bench, "KFromOptics").GetAsInt() != 0 ||
      vtkSMPropertyHelper(bench, "AutoKScale").GetAsInt() == 0)
    {
      return;
    }
    renderCompletely(this->Views[image], this->Images[image]);
    bench->UpdatePropertyInformation(bench->GetProperty("KScaleUsed"));
    const double k = vtkSMPropertyHelper(bench, "KScaleUsed").GetAsDouble();
    for (vtkSMProxy* shown : this->Images)
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", benchOf(shown));
      setInt(benchOf(shown), "AutoKScale", 0);
      vtkSMPropertyHelper(benchOf(shown), "KScale").Set(k);
      benchOf(shown)->UpdateVTKObjects();
    }
  }

  pqOutputPort* Flow;
  vtkSMProxy* Pattern;
  pqServer* Server;
  FlowDefaults Defaults;
  pqRenderView* Scene = nullptr;
  std::vector<pqRenderView*> Views; ///< new ones
  std::vector<vtkSMProxy*> Images;  ///< representations in them
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> Controller;
};

} // namespace

//------------------------------------------------------------------------------
SchlierenViews::Result SchlierenViews::add(Arrangement arrangement, const Cell& cell)
{
  pqOutputPort* flow = pqActiveObjects::instance().activePort();
  const QString missing = flow ? problemOfServer(flow->getServer()) : QString();
  if (!missing.isEmpty())
  {
    return { false, true, missing };
  }
  pqPipelineSource* selected = imagesInViews::filterOf(flow ? flow->getSource() : nullptr);
  if (selected)
  {
    const auto inputs = qobject_cast<pqPipelineFilter*>(selected)->getInputs("Input");
    flow = inputs.empty() ? nullptr : inputs.front();
  }
  const QString problem =
    selected && !isApplied(selected) ? notApplied(selected) : problemOfFlow(flow);
  if (!problem.isEmpty())
  {
    return { false, true, problem };
  }
  vtkSMProxy* drawn = drawnAsSchlieren(flow, pqActiveObjects::instance().activeView());
  vtkSMProxy* pattern = selected ? selected->getProxy() : drawn ? benchOf(drawn) : nullptr;
  QApplication::setOverrideCursor(Qt::WaitCursor);
  const auto cursor = qScopeGuard([] { QApplication::restoreOverrideCursor(); });
  static const char* const names[] = { "Add Schlieren View", "Add Three Images", "Compare Light" };
  BEGIN_UNDO_SET(names[static_cast<int>(arrangement)]);
  Builder builder(flow, pattern);
  const Result result = builder.add(arrangement, cell);
  END_UNDO_SET();
  builder.render();
  return result;
}

//------------------------------------------------------------------------------
void SchlierenViews::show(pqPipelineSource* filter)
{
  const auto inputs = qobject_cast<pqPipelineFilter*>(filter)->getInputs("Input");
  if (!inputs.empty())
  {
    Builder(inputs.front(), nullptr).show(filter);
  }
}
