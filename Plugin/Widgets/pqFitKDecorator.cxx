// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFitKDecorator.h"

#include "UndoStep.h"
#include "WidgetRows.h"
#include "pqImageRefiner.h"
#include "pqPropertyWidget.h"
#include "pqUndoStack.h"
#include "vtkSchlierenFilter.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSession.h"
#include "vtkSMTrace.h"

#include <QAction>
#include <QMenu>
#include <QToolButton>

#include <functional>

namespace
{

/// Returns a number that a filter has, where it is.
double number(vtkSMProxy* filter, const char* name)
{
  filter->UpdatePropertyInformation(filter->GetProperty(name));
  return vtkSMPropertyHelper(filter, name).GetAsDouble();
}

/// Sets the k that Lock K keeps; 0: it is found for the image as it is seen.
void lockK(vtkSMProxy* filter, double k)
{
  // Sets the present value before, because the property follows updates of the data only.
  vtkSMPropertyHelper(filter, "LockedK").Set(number(filter, "LockedKInformation"));
  vtkSMPropertyHelper(filter, "LockedK").Set(k);
  filter->UpdateVTKObjects();
  pqImageRefiner::instance()->refine(filter);
}

/// Returns a step of undo that sets k.
std::function<void()> locker(vtkSMProxy* filter, double k)
{
  return [k, id = ProxyById(filter)]()
  {
    if (vtkSMProxy* found = id.get())
    {
      lockK(found, k);
    }
  };
}

} // namespace

//------------------------------------------------------------------------------
pqFitKDecorator::pqFitKDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  auto* button = new QToolButton(parentObject);
  button->setObjectName("FitK");
  button->setText(tr("Fit Again"));
  button->setToolTip(tr("Finds the sensitivity k again, for the image as it is now."));
  button->setPopupMode(QToolButton::MenuButtonPopup);
  QObject::connect(button, &QToolButton::clicked, this, &pqFitKDecorator::fit);
  auto* menu = new QMenu(button);
  menu->setObjectName("FitKMenu");
  menu->setToolTipsVisible(true);
  QAction* series = menu->addAction(tr("Fit Over Series"));
  series->setObjectName("Series");
  series->setToolTip(
    tr("Finds one k for all time steps, that of the largest deflections, and keeps it. Of "
       "more than %1 steps it takes %1 that are spread evenly.")
      .arg(vtkSchlierenFilter::MOST_STEPS));
  QObject::connect(series, &QAction::triggered, this, &pqFitKDecorator::fitOverSeries);
  button->setMenu(menu);
  narrowLists(parentObject);
  appendBelow(parentObject, button);
}

//------------------------------------------------------------------------------
pqFitKDecorator::~pqFitKDecorator() = default;

//------------------------------------------------------------------------------
void pqFitKDecorator::fit()
{
  vtkSMProxy* filter = this->parentWidget()->proxy();
  SCOPED_UNDO_SET("Fit k Again");
  addUndoStep(locker(filter, number(filter, "KScaleUsed")), locker(filter, 0));
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
  lockK(filter, 0);
}

//------------------------------------------------------------------------------
void pqFitKDecorator::fitOverSeries()
{
  vtkSMProxy* filter = this->parentWidget()->proxy();
  const double before = number(filter, "KScaleUsed");
  SCOPED_UNDO_SET("Fit k Over Series");
  if (vtkSMPropertyHelper(filter, "LockK").GetAsInt() == vtkSchlierenFilter::LOCK_OFF)
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
    vtkSMPropertyHelper(filter, "LockK").Set(vtkSchlierenFilter::LOCK_ALWAYS);
  }
  filter->UpdateVTKObjects();
  {
    const pqImageRefiner::ShortUpdates abortable;
    SM_SCOPED_TRACE(CallMethod).arg(filter).arg("InvokeCommand").arg("FitKOverSeries");
    filter->GetSession()->PrepareProgress();
    filter->InvokeCommand("FitKOverSeries");
    filter->GetSession()->CleanupPendingProgress();
  }
  const double found = number(filter, "LockedKInformation");
  if (found > 0)
  {
    addUndoStep(locker(filter, before), locker(filter, found));
  }
  lockK(filter, found);
}
