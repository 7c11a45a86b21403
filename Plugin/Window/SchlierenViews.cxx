// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchlierenViews.h"

#include "FlowOfPort.h"
#include "HeldInput.h"
#include "ImagesInViews.h"
#include "PatternSettings.h"
#include "PluginFile.h"
#include "UndoStep.h"
#include "ViewsBeside.h"
#include "VolumeDisplay.h"
#include "WholeFlow.h"

#include "pqActiveObjects.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSchlierenFilter.h"

#include <QApplication>
#include <QScopeGuard>

#include <algorithm>
#include <cmath>
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

/// Makes the views of a flow.
class Builder
{
public:
  /// `pattern`: the proxy whose settings are used; null: `defaults` for the flow.
  Builder(pqOutputPort* flow, vtkSMProxy* pattern, FlowDefaults defaults)
    : Flow(flow)
    , Pattern(pattern)
    , Defaults(std::move(defaults))
  {
  }

  SchlierenViews::Result add(Arrangement arrangement, const Cell& cell)
  {
    this->Scene = sceneBeside(this->Flow);
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
          if (pqRenderView* view =
                addViewIn(this->Flow->getServer(), cell.layout, cell.number, "Schlieren View"))
          {
            this->Views = { view };
          }
        }
        else
        {
          this->Views = addViewsBeside(this->Scene, { "Schlieren View" });
        }
        if (!this->Views.empty())
        {
          this->addImage(0, [](vtkSMProxy*) {});
        }
        break;
      case Arrangement::ThreeImages:
        this->Views = addViewsBeside(this->Scene, { "Knife Edge", "Shadowgraph", "Interferogram" });
        for (std::size_t i = 0; i < this->Views.size(); ++i)
        {
          constexpr int cutoffs[] = { Filter::KNIFE_EDGE, Filter::SHADOWGRAPH,
            Filter::INTERFEROGRAM };
          this->addImage(i, [&](vtkSMProxy* bench) { setInt(bench, "Cutoff", cutoffs[i]); });
        }
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
    this->Views[0]->forceRender(); // finds the ambient refractivity
    showAsVolume(this->Flow, this->Scene, this->Defaults, benchOf(this->Images[0]));
    pqActiveObjects::instance().setActiveView(this->Views[0]);
    selectFlow(this->Flow);
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

  void render()
  {
    this->Scene->render();
    for (pqRenderView* view : this->Views)
    {
      view->render();
    }
  }

private:
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
      if (vtkSMPropertyHelper(bench, "Cutoff").GetAsInt() !=
        vtkSMPropertyHelper(this->Pattern, "Cutoff").GetAsInt())
      {
        vtkSMPropertyHelper(bench, "LockedK").Set(0.); // that of the pattern's cutoff
      }
      useKOf(this->Pattern, bench);
    }
    else
    {
      setFlowDefaults(bench, this->Defaults);
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

  pqOutputPort* Flow;
  vtkSMProxy* Pattern;
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
  static const char* const names[] = { "Add Schlieren View", "Three Images" };
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
