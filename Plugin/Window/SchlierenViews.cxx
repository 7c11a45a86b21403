// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchlierenViews.h"

#include "CameraLink.h"
#include "CameraOfView.h"
#include "FlowOfPort.h"
#include "PictureDisplay.h"
#include "SchlierenFilters.h"
#include "UndoStep.h"
#include "VolumeDisplay.h"
#include "pqPictureCameras.h"
#include "pqPictureRefiner.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqServerResource.h"
#include "pqUndoStack.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyClipboard.h"
#include "vtkSMRenderViewProxy.h"
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

/// Pixels of a picture that fills the view, within what is quick to trace and worth looking at.
std::array<int, 2> pictureSizeFor(pqView* view)
{
  constexpr double most = 1024;
  constexpr int least = 64;
  const std::array<int, 2> size = sizeOf(view);
  const double share = std::min(1.0, most / std::max(size[0], size[1]));
  return { std::max(least, int(std::lround(share * size[0]))),
    std::max(least, int(std::lround(share * size[1]))) };
}

/// Makes a view one for pictures.
void flatten(vtkSMProxy* view)
{
  setInt(view, "InteractionMode", vtkPVRenderView::INTERACTION_MODE_2D);
  setInt(view, "CameraParallelProjection", 1);
  setInt(view, "OrientationAxesVisibility", 0);
  setInt(view, "CenterAxesVisibility", 0);
  setInt(view, "UseFXAA", 0); // it would smear the picture's own edges
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

/// Makes the pictures of one flow and everything around them.
class Builder
{
public:
  explicit Builder(pqOutputPort* flow, pqPipelineSource* pattern)
    : Flow(flow)
    , Pattern(pattern)
    , Server(flow->getServer())
    , Defaults(flowDefaults(arraysOfFlow(flow)))
  {
  }

  SchlierenViews::Result add(Arrangement arrangement)
  {
    this->findScene();
    std::vector<pqRenderView*> views;
    switch (arrangement)
    {
      case Arrangement::OnePicture:
        views = this->addViews(1);
        this->addPicture(views[0], "Schlieren", [](vtkSMProxy*) {});
        break;
      case Arrangement::ThreePictures:
        views = this->addViews(3);
        this->resample();
        this->addPicture(views[0], "KnifeEdge",
          [](vtkSMProxy* filter) { setInt(filter, "Cutoff", Filter::KNIFE_EDGE); });
        this->addPicture(views[1], "Shadowgraph",
          [](vtkSMProxy* filter) { setInt(filter, "Cutoff", Filter::SHADOWGRAPH); });
        this->addPicture(views[2], "Interferogram",
          [](vtkSMProxy* filter) { setInt(filter, "Cutoff", Filter::INTERFEROGRAM); });
        break;
      case Arrangement::Comparison:
        views = this->addViews(2);
        if (!isImage(this->Flow))
        {
          this->resample();
        }
        this->compare(views);
        break;
    }
    pqPipelineSource* picture = this->Pictures[0];
    if (this->Medium && !isImage(this->Flow))
    {
      showAsVolume(this->Medium, this->Scene, this->MediumDefaults, picture->getProxy(), picture);
    }
    else
    {
      pqPipelineSource* model = this->Medium ? this->Medium->getSource() : picture;
      showAsVolume(this->Flow, this->Scene, this->Defaults, model->getProxy(), picture);
    }
    pqActiveObjects::instance().setActiveView(views[0]);
    pqActiveObjects::instance().setActiveSource(this->Pictures[0]);
    if (arrangement == Arrangement::Comparison)
    {
      linkCameras(views[0], views[1]);
    }
    if (this->Pattern)
    {
      return { true, true, "Set as '" + this->Pattern->getSMName() + "' is." };
    }
    return { true, this->Defaults.isSure, QString::fromStdString(this->Defaults.message) };
  }

  /// Shows the image of a filter that is there already.
  void add(pqPipelineSource* source)
  {
    this->findScene();
    pqRenderView* view = this->addViews(1).front();
    this->showPicture(view, source);
    pqActiveObjects::instance().setActiveView(view);
  }

  /// Shows everything, and brings all pictures to the set quality.
  void render()
  {
    this->Scene->render();
    for (pqPipelineSource* picture : this->Pictures)
    {
      pqPictureRefiner::instance()->refine(picture->getProxy(), pqPictureRefiner::Pace::Thorough);
    }
  }

private:
  /// The 3-D view, one that shows the flow where there was none.
  void findScene()
  {
    this->Scene = sceneView(this->Server);
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

  /// Empty 2-D views beside the 3-D view: one to its right; two there, one over the other; or three,
  /// with which it makes a square.
  std::vector<pqRenderView*> addViews(int number)
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
      const int top = layout->SplitVertical(left + 1, 0.5);
      cells = { top, top + 1 };
    }
    if (number > 2)
    {
      const int top = layout->SplitVertical(left, 0.5);
      cells.insert(cells.begin() + 1, top + 1);
    }
    // ParaView's toolbar shows the axes of a view that becomes active after one without: in the middle of making
    // it, which traces would not survive.
    pqActiveObjects::instance().setActiveView(this->Scene);
    std::vector<pqRenderView*> views;
    for (const int cell : cells)
    {
      views.push_back(this->addView(layout, cell));
    }
    for (pqRenderView* view : views)
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", view->getProxy());
      flatten(view->getProxy());
    }
    this->keepInSight(before, sizeOf(this->Scene));
    return views;
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
      const auto stepForward = cameraSetter(proxy);
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
      addUndoStep(stepForward, cameraSetter(proxy));
    }
  }

  /// `label`: what the pipeline browser calls it, with a number.
  pqPipelineSource* addFilter(const char* name, const char* label, pqOutputPort* input,
    const std::function<void(vtkSMProxy*)>& set)
  {
    vtkSMSessionProxyManager* proxies = this->Server->proxyManager();
    vtkSmartPointer<vtkSMProxy> filter;
    filter.TakeReference(proxies->NewProxy("filters", name));
    this->Controller->PreInitializeProxy(filter);
    vtkSMPropertyHelper(filter, "Input")
      .Set(input->getSource()->getProxy(), static_cast<unsigned int>(input->getPortNumber()));
    this->Controller->PostInitializeProxy(filter);
    this->Controller->RegisterPipelineProxy(
      filter, proxies->GetUniqueProxyName("sources", label).c_str());
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
      set(filter);
      filter->UpdateVTKObjects();
    }
    return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
      filter.GetPointer());
  }

  /// Sets what a Schlieren or RefractiveIndex filter needs to know of the flow.
  void setMedium(vtkSMProxy* filter)
  {
    if (!this->Pattern)
    {
      setFlowDefaults(filter, this->Defaults);
      return;
    }
    vtkSMPropertyHelper input(filter, "Input");
    vtkSMProxy* flow = input.GetAsProxy();
    const unsigned int port = input.GetOutputPort();
    vtkSMProxy* pattern = this->Pattern->getProxy();
    // Pasting makes curves of its own, for filters of the same kind only.
    vtkNew<vtkSMProxyClipboard> clipboard;
    clipboard->Copy(pattern);
    if (!clipboard->CanPaste(filter) || !clipboard->Paste(filter))
    {
      filter->Copy(pattern);
    }
    input.Set(flow, port);
  }

  /// Puts one RefractiveIndex between the flow and all pictures.
  void resample()
  {
    if (this->Defaults.indexModel != FlowDefaults::Refractivity || !isImage(this->Flow))
    {
      pqPipelineSource* index = this->addFilter("RefractiveIndex", "RefractiveIndex", this->Flow,
        [this](vtkSMProxy* filter) { this->setMedium(filter); });
      vtkSMSourceProxy::SafeDownCast(index->getProxy())->UpdatePipeline();
      this->Medium = index->getOutputPort(0);
      this->MediumDefaults = flowDefaults(arraysOfFlow(this->Medium));
    }
  }

  /// A filter that looks as the 3-D view does, and its picture in a 2-D view.
  pqPipelineSource* addPicture(
    pqRenderView* view, const char* label, const std::function<void(vtkSMProxy*)>& set)
  {
    const auto setAll = [&](vtkSMProxy* filter)
    {
      this->setMedium(filter);
      if (this->Medium)
      {
        setFlowDefaults(filter, this->MediumDefaults);
      }
      const std::array<int, 2> size = pictureSizeFor(view);
      vtkSMPropertyHelper(filter, "ImageSize").Set(size.data(), 2);
      set(filter);
    };
    pqPipelineSource* source =
      this->addFilter("Schlieren", label, this->Medium ? this->Medium : this->Flow, setAll);
    follow(source->getProxy(), this->Scene);
    this->showPicture(view, source);
    return source;
  }

  /// Fills a 2-D view with the image of a filter.
  void showPicture(pqRenderView* view, pqPipelineSource* source)
  {
    vtkSMRenderViewProxy* window = view->getRenderViewProxy();
    const pqPictureRefiner::ShortUpdates shortly;
    vtkSMProxy* representation =
      this->Controller->Show(vtkSMSourceProxy::SafeDownCast(source->getProxy()), 0, window);
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
      PictureDisplay::apply(representation, source->getProxy());
    }
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", window);
      pqPictureCameras::fit(view, source);
    }
    const auto redo = [id = ProxyById(window), setCamera = cameraSetter(window)]()
    {
      if (vtkSMProxy* again = id.get())
      {
        flatten(again);
        setCamera();
      }
    };
    addUndoStep([]() {}, redo);
    this->Pictures.push_back(source);
  }

  /// The same light straight and bent, at one sensitivity.
  void compare(const std::vector<pqRenderView*>& views)
  {
    pqPipelineSource* straight = this->addPicture(views[0], "StraightRays",
      [](vtkSMProxy* filter) { setInt(filter, "PathModel", Filter::STRAIGHT); });
    pqPipelineSource* bent = this->addPicture(views[1], "RefractedRays",
      [](vtkSMProxy* filter) { setInt(filter, "PathModel", Filter::REFRACTED); });
    vtkSMProxy* filter = bent->getProxy();
    const int cutoff = vtkSMPropertyHelper(filter, "Cutoff").GetAsInt();
    if (Filter::CutoffHasK(cutoff) && vtkSMPropertyHelper(filter, "KFromOptics").GetAsInt() == 0 &&
      vtkSMPropertyHelper(filter, "AutoKScale").GetAsInt() != 0)
    {
      vtkSMSourceProxy::SafeDownCast(filter)->UpdatePipeline();
      const std::array<double, 2> k =
        rangeOfArray(bent->getOutputPort(0), vtkDataObject::FIELD, "KScale");
      for (pqPipelineSource* picture : { straight, bent })
      {
        if (k[0] <= k[1])
        {
          SM_SCOPED_TRACE(PropertiesModified).arg("proxy", picture->getProxy());
          setInt(picture->getProxy(), "AutoKScale", 0);
          vtkSMPropertyHelper(picture->getProxy(), "KScale").Set(k[0]);
          picture->getProxy()->UpdateVTKObjects();
        }
      }
    }
  }

  pqOutputPort* Flow;
  pqPipelineSource* Pattern; ///< a Schlieren filter whose settings are to be used, or null
  pqServer* Server;
  FlowDefaults Defaults;
  pqRenderView* Scene = nullptr;
  std::vector<pqPipelineSource*> Pictures;
  pqOutputPort* Medium = nullptr; ///< the flow's refractivity, where pictures share it
  FlowDefaults MediumDefaults;
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> Controller;
};

} // namespace

//------------------------------------------------------------------------------
SchlierenViews::Result SchlierenViews::add(Arrangement arrangement)
{
  pqOutputPort* flow = pqActiveObjects::instance().activePort();
  const QString missing = flow ? problemOfServer(flow->getServer()) : QString();
  if (!missing.isEmpty())
  {
    return { false, true, missing };
  }
  pqPipelineSource* pattern = schlierenFilterOf(flow ? flow->getSource() : nullptr);
  if (pattern)
  {
    const auto inputs = qobject_cast<pqPipelineFilter*>(pattern)->getInputs("Input");
    flow = inputs.empty() ? nullptr : inputs.front();
  }
  const QString problem =
    pattern && !isApplied(pattern) ? notApplied(pattern) : problemOfFlow(flow);
  if (!problem.isEmpty())
  {
    return { false, true, problem };
  }
  QApplication::setOverrideCursor(Qt::WaitCursor);
  const auto cursor = qScopeGuard([] { QApplication::restoreOverrideCursor(); });
  static const char* const names[] = { "Add Schlieren View", "Add Three Pictures",
    "Compare Light" };
  BEGIN_UNDO_SET(names[static_cast<int>(arrangement)]);
  Builder builder(flow, pattern);
  const Result result = builder.add(arrangement);
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
    Builder(inputs.front(), filter).add(filter);
  }
}
