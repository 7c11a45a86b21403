// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPhotographMouse.h"

#include "ImagesInViews.h"
#include "vtkCompareWithPhotograph.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"

#include <QMainWindow>
#include <QStatusBar>
#include <QWidget>

#include <algorithm>
#include <array>

namespace
{

/// Returns the comparison that a view shows; null if there is none.
pqPipelineSource* comparisonIn(pqView* view)
{
  const auto shown = imagesInViews::imagesIn(view);
  const auto found = std::find_if(shown.begin(), shown.end(), imagesInViews::isComparison);
  return found == shown.end() ? nullptr : *found;
}

} // namespace

pqPhotographMouse::pqPhotographMouse(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqPhotographMouse::watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
}

pqPhotographMouse::~pqPhotographMouse() = default;

void pqPhotographMouse::watch(pqView* view)
{
  if (auto* seen = qobject_cast<pqRenderView*>(view))
  {
    for (const auto event : { vtkCommand::MouseMoveEvent, vtkCommand::LeftButtonPressEvent,
           vtkCommand::LeftButtonReleaseEvent })
    {
      constexpr float beforeCamera = 1;
      this->Events->Connect(seen->getRenderViewProxy()->GetInteractor(), event, this,
        SLOT(onMouse(vtkObject*, unsigned long, void*, void*, vtkCommand*)), nullptr, beforeCamera);
    }
  }
}

void pqPhotographMouse::onMouse(
  vtkObject* caller, unsigned long event, void*, void*, vtkCommand* command)
{
  auto* interactor = vtkRenderWindowInteractor::SafeDownCast(caller);
  const auto views =
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqRenderView*>();
  const auto found = std::find_if(views.begin(), views.end(),
    [=](pqRenderView* view) { return view->getRenderViewProxy()->GetInteractor() == interactor; });
  pqPipelineSource* comparison = found == views.end() ? nullptr : comparisonIn(*found);
  if (!comparison)
  {
    return;
  }
  const auto placeAt = [&](double pixelsToTheRight)
  {
    const int* at = interactor->GetEventPosition();
    const int* size = interactor->GetSize();
    return imagesInViews::placeInImage(
      comparison, *found, (at[0] + 0.5 + pixelsToTheRight) / size[0], (at[1] + 0.5) / size[1]);
  };
  vtkSMProxy* proxy = comparison->getProxy();
  vtkSMPropertyHelper swipe(proxy, "SwipePosition");
  constexpr double reach = 6; // pixels
  const bool isAtLine =
    vtkSMPropertyHelper(proxy, "Comparison").GetAsInt() == vtkCompareWithPhotograph::SHOW_SWIPE &&
    placeAt(-reach)[0] < swipe.GetAsDouble() && swipe.GetAsDouble() < placeAt(reach)[0];
  if (event == vtkCommand::LeftButtonPressEvent)
  {
    this->Swiped = isAtLine ? comparison : nullptr;
    command->SetAbortFlag(isAtLine);
  }
  else if (event == vtkCommand::LeftButtonReleaseEvent)
  {
    command->SetAbortFlag(this->Swiped != nullptr);
    this->Swiped = nullptr;
  }
  else if (this->Swiped == comparison)
  {
    command->SetAbortFlag(1);
    SCOPED_UNDO_EXCLUDE();
    swipe.Set(std::clamp(placeAt(0)[0], 0., 1.));
    proxy->UpdateVTKObjects();
    comparison->renderAllViews();
  }
  else
  {
    QWidget* widget = (*found)->widget();
    isAtLine ? widget->setCursor(Qt::SplitHCursor) : widget->unsetCursor();
    const std::array<double, 2> place = placeAt(0);
    const QString text = imagesInViews::placeInWords(proxy, place[0], place[1]);
    if (auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()))
    {
      window->statusBar()->showMessage(text.section('\n', 0, 0));
    }
  }
}
