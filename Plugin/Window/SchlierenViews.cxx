// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchlierenViews.h"

#include "FlowOfPort.h"
#include "HeldInput.h"
#include "ImageDisplay.h"
#include "ImagesInViews.h"
#include "PatternSettings.h"
#include "PluginFile.h"
#include "UndoStep.h"
#include "ViewsBeside.h"
#include "VolumeDisplay.h"
#include "WholeFlow.h"
#include "pqPhotographPoints.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "vtkCamera.h"
#include "vtkDataSetAttributes.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVRenderView.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSchlierenFilter.h"

#include <QApplication>
#include <QPointer>
#include <QScopeGuard>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
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

/// Adapts a view to the image of a filter.
void flatten(vtkSMProxy* view)
{
  setInt(view, "InteractionMode", vtkPVRenderView::INTERACTION_MODE_2D);
  setInt(view, "CameraParallelProjection", 1);
  setInt(view, "OrientationAxesVisibility", 0);
  setInt(view, "CenterAxesVisibility", 0);
  setInt(view, "UseFXAA", 0); // FXAA would blur edges in the image
  setInt(view, "UseColorPaletteForBackground", 0);
  const double darkGrey[3] = { 0.2, 0.2, 0.2 };
  vtkSMPropertyHelper(view, "Background").Set(darkGrey, 3);
  view->UpdateVTKObjects();
}

/// Returns the proxy of the filter inside of a representation.
vtkSMProxy* benchOf(vtkSMProxy* representation)
{
  return vtkSMPropertyHelper(representation, "SchlierenBench").GetAsProxy();
}

/// Returns the representation in a view that draws this flow as Schlieren; null if none does.
vtkSMProxy* drawnAsSchlieren(pqOutputPort* flow, pqView* view)
{
  pqDataRepresentation* shown = view ? flow->getRepresentation(view) : nullptr;
  return shown && imagesInViews::isDrawn(shown) ? shown->getProxy() : nullptr;
}

/// Renders a view once, with complete images.
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

/// Makes the views of a flow.
class Builder
{
public:
  /// `pattern`: the proxy whose settings are used; null: `defaults` for the flow.
  explicit Builder(pqOutputPort* flow, vtkSMProxy* pattern, FlowDefaults defaults = {})
    : Flow(flow)
    , Pattern(pattern)
    , Server(flow->getServer())
    , Defaults(std::move(defaults))
  {
  }

  SchlierenViews::Result add(Arrangement arrangement, const Cell& cell)
  {
    this->findScene();
    const bool wasWhole = isWhole(this->Scene, aspectOf(this->Scene),
      vtkBoundingBox(this->Flow->getDataInformation()->GetBounds()));
    this->useParallelLight();
    switch (arrangement)
    {
      case Arrangement::OneImage:
        // Keeps the cell, unless a new 3-D view has taken it.
        if (cell.layout && !cell.layout->GetView(cell.number))
        {
          noteLayout(cell.layout, cell.number);
          this->Views = { addViewIn(this->Server, cell.layout, cell.number, "Schlieren View") };
        }
        else
        {
          this->Views = addViewsBeside(this->Scene, { "Schlieren View" });
        }
        if (this->isThere(1))
        {
          this->addImage(0, [](vtkSMProxy*) {});
        }
        break;
      case Arrangement::ThreeImages:
        this->addImages({ "Knife Edge", "Shadowgraph", "Interferogram" }, "Cutoff",
          { Filter::KNIFE_EDGE, Filter::SHADOWGRAPH, Filter::INTERFEROGRAM });
        break;
      case Arrangement::Comparison:
        this->addImages({ "Straight Rays", "Refracted Rays" }, "PathModel",
          { Filter::STRAIGHT, Filter::REFRACTED });
        break;
    }
    if (this->Images.empty())
    {
      return { false, true, "" };
    }
    this->useCameraOfScene();
    this->Views[0]->getViewProxy()->Update(); // finds the bounds
    if (frameFlow(this->Scene, this->Views, wasWhole))
    {
      this->useCameraOfScene();
    }
    if (arrangement == Arrangement::Comparison)
    {
      this->useOneKOf(1);
    }
    else
    {
      this->Views[0]->forceRender(); // finds the ambient refractivity
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
      return { true, true, "The new views have the settings of the selected image." };
    }
    return { true, this->Defaults.isSure, QString::fromStdString(this->Defaults.message) };
  }

  /// Shows a comparison, its image and its photograph in views of their own.
  void compare(pqPipelineSource* comparison)
  {
    if (pqRenderView* view = viewWith(comparison))
    {
      this->Controller->Hide(comparison->getSourceProxy(), 0, view->getViewProxy());
    }
    this->Scene = viewWith(this->Flow->getSource());
    if (!this->Scene)
    {
      this->findScene();
    }
    pqOutputPort* photograph =
      qobject_cast<pqPipelineFilter*>(comparison)->getInputs("Photograph").front();
    this->Views = addViewsBeside(
      this->Scene, { comparison->getSMName(), "Points in Image", "Points in Photograph" });
    if (!this->isThere(3))
    {
      return;
    }
    pqOutputPort* const ports[] = { comparison->getOutputPort(0), this->Flow, photograph };
    for (int i = 0; i < 3; ++i)
    {
      vtkSMProxy* representation = this->showFlat(ports[i], this->Views[i]);
      pqPipelineSource* source = ports[i]->getSource();
      vtkPVArrayInformation* values =
        ports[i]->getDataInformation()->GetPointDataInformation()->GetAttributeInformation(
          vtkDataSetAttributes::SCALARS);
      if (representation && ports[i] == this->Flow && imagesInViews::isSchlieren(source))
      {
        ImageDisplay::apply(representation, source->getProxy());
      }
      else if (representation && values)
      {
        ImageDisplay::applyToPhotograph(representation, values);
      }
    }
    pqActiveObjects::instance().setActiveView(this->Views[0]);
    new pqPhotographPoints(comparison, this->Views[1], this->Views[2]);
  }

  /// Shows the image of a filter in a view of its own, which it fills: that in which ParaView has
  /// shown it, where nothing else is visible, or a new one.
  void show(pqPipelineSource* filter)
  {
    pqRenderView* view = this->viewWith(filter);
    if (!view || view->getNumberOfVisibleDataRepresentations() > 1)
    {
      if (view)
      {
        this->Controller->Hide(filter->getSourceProxy(), 0, view->getViewProxy());
      }
      this->findScene();
      this->Views = addViewsBeside(this->Scene, { "Image of " + filter->getSMName() });
      if (!this->isThere(1))
      {
        return;
      }
      view = this->Views[0];
    }
    if (vtkSMProxy* representation = this->showFlat(filter->getOutputPort(0), view))
    {
      ImageDisplay::apply(representation, filter->getProxy());
    }
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
  /// Shows an image in a view that looks onto it. Returns its representation.
  vtkSMProxy* showFlat(pqOutputPort* image, pqRenderView* view)
  {
    vtkSMRenderViewProxy* window = view->getRenderViewProxy();
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", window);
      flatten(window);
    }
    vtkSMProxy* representation =
      this->Controller->Show(image->getSource()->getSourceProxy(), image->getPortNumber(), window);
    if (representation)
    {
      vtkSMPVRepresentationProxy::SetScalarBarVisibility(representation, window, false);
      // Avoids the outline that ParaView shows without data.
      vtkSMPropertyHelper type(representation, "Representation");
      if (std::strcmp(type.GetAsString(), "Outline") == 0)
      {
        SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
        type.Set("Slice");
        representation->UpdateVTKObjects();
      }
    }
    {
      SM_SCOPED_TRACE(CallMethod).arg(window).arg("ResetCamera").arg(true);
      window->ResetCamera(true); // fills the view
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
    return representation;
  }

  /// Returns the render view in which the image of a filter is visible; null if there is none.
  static pqRenderView* viewWith(pqPipelineSource* filter)
  {
    for (pqDataRepresentation* shown : filter->getRepresentations(0, nullptr))
    {
      if (auto* view = qobject_cast<pqRenderView*>(shown->isVisible() ? shown->getView() : nullptr))
      {
        return view;
      }
    }
    return nullptr;
  }

  /// Finds the 3-D view, or makes one that shows the flow.
  void findScene()
  {
    this->Scene = imagesInViews::scene(this->Flow);
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

  /// Lets the 3-D view, whose camera the images have, look through the flow as a wind tunnel's parallel light does, unless
  /// there are images of it already, whose projection the user may have chosen, or a filter with a perspective is the pattern.
  void useParallelLight()
  {
    vtkSMRenderViewProxy* proxy = this->Scene->getRenderViewProxy();
    const auto shown = this->Flow->getRepresentations(nullptr);
    if ((this->Pattern && vtkSMPropertyHelper(this->Pattern, "ViewAngle").GetAsDouble() > 0) ||
      vtkSMPropertyHelper(proxy, "CameraParallelProjection").GetAsInt() != 0 ||
      std::any_of(shown.begin(), shown.end(), imagesInViews::isDrawn))
    {
      return;
    }
    vtkCamera* camera = proxy->GetActiveCamera();
    const auto setBack = cameraSetter(proxy, proxy);
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
      setInt(proxy, "CameraParallelProjection", 1);
      vtkSMPropertyHelper(proxy, "CameraParallelScale")
        .Set(camera->GetDistance() *
          std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle())));
      proxy->UpdateVTKObjects();
    }
    addUndoStep(setBack, cameraSetter(proxy, proxy));
  }

  /// Returns whether the session and so many new views are there.
  bool isThere(std::size_t views) const
  {
    return this->Server && this->Views.size() == views &&
      std::find(this->Views.begin(), this->Views.end(), nullptr) == this->Views.end();
  }

  /// Draws the flow as Schlieren in a view for each value of a property.
  void addImages(
    const std::vector<QString>& names, const char* property, const std::vector<int>& values)
  {
    this->Views = addViewsBeside(this->Scene, names);
    for (std::size_t i = 0; this->isThere(values.size()) && i < values.size(); ++i)
    {
      this->addImage(i, [&](vtkSMProxy* bench) { setInt(bench, property, values[i]); });
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
      set(bench);
      useKOf(this->Pattern, bench);
    }
    else
    {
      setFlowDefaults(bench, this->Defaults);
      setInt(bench, "Quality", Filter::AUTOMATIC);
      setInt(bench, "KMode", Filter::K_AUTOMATIC_KEPT);
      set(bench);
      this->useKOfOthers(bench);
    }
    bench->UpdateVTKObjects();
    this->Images.push_back(shown);
  }

  /// Links the new views to the 3-D view's camera, without axes in the middle of images.
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

  /// Sets the k of another image of the flow, by the same technique, which has been kept.
  void useKOfOthers(vtkSMProxy* bench)
  {
    for (pqDataRepresentation* shown : this->Flow->getRepresentations(nullptr))
    {
      vtkSMProxy* other = imagesInViews::isDrawn(shown) ? benchOf(shown->getProxy()) : nullptr;
      if (other && other != bench &&
        vtkSMPropertyHelper(other, "KMode").GetAsInt() == Filter::K_AUTOMATIC_KEPT &&
        vtkSMPropertyHelper(other, "LockedK").GetAsDouble() > 0)
      {
        useKOf(other, bench);
      }
    }
  }

  /// Sets the automatic k of one image in all.
  void useOneKOf(std::size_t image)
  {
    vtkSMProxy* bench = benchOf(this->Images[image]);
    const int cutoff = vtkSMPropertyHelper(bench, "Cutoff").GetAsInt();
    if (!Filter::CutoffHasK(cutoff) ||
      vtkSMPropertyHelper(bench, "KMode").GetAsInt() > Filter::K_AUTOMATIC_KEPT)
    {
      return;
    }
    renderCompletely(this->Views[image], this->Images[image]);
    bench->UpdatePropertyInformation(bench->GetProperty("KScaleUsed"));
    const double k = vtkSMPropertyHelper(bench, "KScaleUsed").GetAsDouble();
    for (vtkSMProxy* shown : this->Images)
    {
      {
        SCOPED_UNDO_EXCLUDE();
        vtkSMPropertyHelper(benchOf(shown), "LockedK").Set(0.); // a given k is none that is kept
        benchOf(shown)->UpdateVTKObjects();
      }
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", benchOf(shown));
      setInt(benchOf(shown), "KMode", Filter::K_VALUE);
      vtkSMPropertyHelper(benchOf(shown), "KScale").Set(k);
      benchOf(shown)->UpdateVTKObjects();
    }
  }

  pqOutputPort* Flow;
  vtkSMProxy* Pattern;
  QPointer<pqServer> Server;
  FlowDefaults Defaults;
  pqRenderView* Scene = nullptr;
  std::vector<pqRenderView*> Views; ///< new views
  std::vector<vtkSMProxy*> Images;  ///< representations in them
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> Controller;
};

} // namespace

SchlierenViews::Result SchlierenViews::add(
  Arrangement arrangement, const Cell& cell, const Completion& completion)
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
  const std::vector<FlowArray> arrays = arraysOfFlow(flow);
  FlowDefaults defaults = completed(arrays, completion);
  if (!pattern && defaults.arrays.empty())
  {
    return { false, true,
      "'" + flow->getSource()->getSMName() + "': " + QString::fromStdString(defaults.message),
      offerFor(arrays) };
  }
  QApplication::setOverrideCursor(Qt::WaitCursor);
  const auto cursor = qScopeGuard([] { QApplication::restoreOverrideCursor(); });
  static const char* const names[] = { "Add Schlieren View", "Three Images",
    "Compare Straight and Refracted Rays" };
  const HeldInput input;
  traceLoading(flow->getServer());
  BEGIN_UNDO_SET(names[static_cast<int>(arrangement)]);
  keepActiveView();
  Builder builder(flow, pattern, std::move(defaults));
  const Result result = builder.add(arrangement, cell);
  END_UNDO_SET();
  if (result.isMade)
  {
    builder.render();
  }
  return result;
}

void SchlierenViews::show(pqPipelineSource* filter)
{
  const auto inputs = qobject_cast<pqPipelineFilter*>(filter)->getInputs("Input");
  if (!inputs.empty())
  {
    const HeldInput input;
    Builder builder(inputs.front(), nullptr);
    imagesInViews::isComparison(filter) ? builder.compare(filter) : builder.show(filter);
  }
}
