// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPhotographPoints.h"

#include "PhotographSettings.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPVRenderView.h"
#include "vtkPointHandleRepresentation2D.h"
#include "vtkProperty2D.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMTrace.h"
#include "vtkSeedRepresentation.h"
#include "vtkSeedWidget.h"
#include "vtkWidgetEventTranslator.h"

#include <QMainWindow>
#include <QStatusBar>
#include <QTimer>

namespace
{

// Properties of the points in each view.
constexpr const char* properties[2][2] = { { "FlowPoint1", "FlowPoint2" },
  { "PhotographPoint1", "PhotographPoint2" } };

void say(const QString& text)
{
  if (auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()))
  {
    window->statusBar()->showMessage(text);
  }
}

} // namespace

pqPhotographPoints::pqPhotographPoints(
  pqPipelineSource* comparison, pqRenderView* image, pqRenderView* photograph)
  : QObject(comparison)
  , Comparison(comparison)
  , Views{ image, photograph }
{
  for (std::size_t i = 0; i < this->Views.size(); ++i)
  {
    auto* view =
      vtkPVRenderView::SafeDownCast(this->Views[i]->getRenderViewProxy()->GetClientSideView());
    vtkNew<vtkPointHandleRepresentation2D> cross;
    cross->GetProperty()->SetColor(1, 0.8, 0);
    cross->GetProperty()->SetLineWidth(2);
    vtkNew<vtkSeedRepresentation> points;
    points->SetHandleRepresentation(cross);
    vtkSeedWidget* seeds = this->Seeds[i];
    seeds->SetRepresentation(points);
    seeds->SetInteractor(view->GetInteractor());
    seeds->SetDefaultRenderer(view->GetNonCompositedRenderer());
    seeds->SetCurrentRenderer(view->GetNonCompositedRenderer());
    // They would complete the points and delete them.
    seeds->GetEventTranslator()->RemoveTranslation(vtkCommand::RightButtonPressEvent);
    seeds->GetEventTranslator()->RemoveTranslation(vtkCommand::KeyPressEvent);
    seeds->On();
    for (const auto event : { vtkCommand::PlacePointEvent, vtkCommand::EndInteractionEvent })
    {
      this->Events->Connect(seeds, event, this, SLOT(place()), nullptr, 0, Qt::QueuedConnection);
    }
    QObject::connect(this->Views[i], &QObject::destroyed, this, &QObject::deleteLater);
  }
  this->Events->Connect(comparison->getProxy(), vtkCommand::UpdateEvent, this, SLOT(follow()));
  // Before the view's interactor is gone.
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::preViewRemoved, this,
    [this](pqView* view)
    {
      if (view == this->Views[0] || view == this->Views[1])
      {
        delete this;
      }
    });
  // Waits, because the button's remaining work would clear it.
  QTimer::singleShot(1000, this,
    []()
    {
      say(
        "Click two points in the image, and the same two in the photograph: what the flow does not "
        "move, as far apart as can be.");
    });
}

pqPhotographPoints::~pqPhotographPoints()
{
  for (std::size_t i = 0; i < this->Views.size(); ++i)
  {
    this->Seeds[i]->SetInteractor(nullptr); // takes the points out of the view
  }
}

std::vector<double> pqPhotographPoints::pointOf(vtkSeedWidget* seeds, int index)
{
  double point[3];
  seeds->GetSeedRepresentation()->GetSeedWorldPosition(static_cast<unsigned int>(index), point);
  return { point[0], point[1] };
}

void pqPhotographPoints::place()
{
  bool areAll = true;
  for (vtkSeedWidget* seeds : this->Seeds)
  {
    const int count = seeds->GetSeedRepresentation()->GetNumberOfSeeds();
    if (count == 2)
    {
      seeds->CompleteInteraction(); // from now on they can be dragged alone
    }
    areAll = areAll && count == 2;
  }
  if (!areAll)
  {
    return;
  }
  vtkSMProxy* proxy = this->Comparison->getProxy();
  BEGIN_UNDO_SET("Points of a Photograph");
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
  vtkSMPropertyHelper(proxy, "Placement").Set(PhotographSettings::PLACE_TWO_POINTS);
  for (std::size_t i = 0; i < this->Seeds.size(); ++i)
  {
    for (int point = 0; point < 2; ++point)
    {
      vtkSMPropertyHelper(proxy, properties[i][point])
        .Set(pointOf(this->Seeds[i], point).data(), 2);
    }
  }
  proxy->UpdateVTKObjects();
  END_UNDO_SET();
  this->Comparison->renderAllViews();
  say("Drag the points to correct them.");
}

void pqPhotographPoints::follow()
{
  vtkSMProxy* proxy = this->Comparison->getProxy();
  for (std::size_t i = 0; i < this->Seeds.size(); ++i)
  {
    vtkSeedRepresentation* points = this->Seeds[i]->GetSeedRepresentation();
    for (int point = 0; point < points->GetNumberOfSeeds(); ++point)
    {
      const std::vector<double> now =
        vtkSMPropertyHelper(proxy, properties[i][point]).GetDoubleArray();
      if (vtkSMPropertyHelper(proxy, "Placement").GetAsInt() ==
          PhotographSettings::PLACE_TWO_POINTS &&
        now != pointOf(this->Seeds[i], point))
      {
        double place[] = { now[0], now[1], 0 };
        points->GetHandleRepresentation(static_cast<unsigned int>(point))->SetWorldPosition(place);
      }
    }
  }
}
