// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqInteraction.h"

#include "pqApplicationCore.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMRenderViewProxy.h"

#include <QPointer>

//------------------------------------------------------------------------------
pqInteraction::pqInteraction(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqInteraction::watch);
  QObject::connect(model, &pqServerManagerModel::preViewRemoved, this, &pqInteraction::forget);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
}

//------------------------------------------------------------------------------
pqInteraction::~pqInteraction() = default;

//------------------------------------------------------------------------------
pqInteraction* pqInteraction::instance()
{
  static QPointer<pqInteraction> interaction;
  if (!interaction)
  {
    interaction = new pqInteraction(pqApplicationCore::instance());
  }
  return interaction;
}

//------------------------------------------------------------------------------
void pqInteraction::watch(pqView* view)
{
  auto* proxy = vtkSMRenderViewProxy::SafeDownCast(view->getProxy());
  vtkRenderWindowInteractor* interactor = proxy ? proxy->GetInteractor() : nullptr;
  if (interactor)
  {
    for (const auto event : { vtkCommand::StartInteractionEvent, vtkCommand::EndInteractionEvent,
           vtkCommand::ConfigureEvent })
    {
      // Before ParaView renders.
      this->Connection->Connect(
        interactor, event, this, SLOT(onEvent(vtkObject*, unsigned long, void*)), proxy, 1);
    }
    // ParaView's timer renders some time after the last of these, and after another rendering.
    this->Connection->Connect(interactor, vtkCommand::TimerEvent, this,
      SLOT(onEvent(vtkObject*, unsigned long, void*)), proxy, 1);
    this->Connection->Connect(interactor, vtkCommand::TimerEvent, this,
      SLOT(onTimerOver(vtkObject*, unsigned long, void*)), proxy, -1);
  }
}

//------------------------------------------------------------------------------
void pqInteraction::forget(pqView* view)
{
  this->Moved.remove(view->getProxy());
  if (this->Moving.remove(view->getProxy()) && !this->isOn())
  {
    Q_EMIT this->ended();
  }
}

//------------------------------------------------------------------------------
void pqInteraction::onEvent(vtkObject*, unsigned long event, void* view)
{
  if (event == vtkCommand::StartInteractionEvent)
  {
    this->Moving.insert(view);
    return;
  }
  this->Moved.insert(view);
  if (event == vtkCommand::EndInteractionEvent && this->Moving.remove(view) && !this->isOn())
  {
    Q_EMIT this->ended();
  }
}

//------------------------------------------------------------------------------
void pqInteraction::onTimerOver(vtkObject*, unsigned long, void* view) { this->Moved.remove(view); }
