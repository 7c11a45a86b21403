// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqKeepKDecorator.h"

#include "WidgetRows.h"
#include "pqPVApplicationCore.h"
#include "pqPropertyWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkSchlierenFilter.h"

#include <QMenu>
#include <QToolButton>

namespace
{

int choiceInPanel(vtkSMProperty* property)
{
  return vtkSMUncheckedPropertyHelper(property).GetAsInt();
}

/// Does what ParaView's own buttons of commands do.
void invoke(vtkSMProxy* filter, const char* command)
{
  filter->InvokeCommand(command);
  pqPVApplicationCore::instance()->render();
}

/// Makes a button that finds k again, with a menu for one k of a whole series.
QToolButton* newFitButton(vtkSMProxy* filter, QWidget* parent)
{
  auto* button = new QToolButton(parent);
  button->setObjectName("FitKAgain");
  button->setText(QObject::tr("Fit"));
  button->setToolTip(
    QObject::tr("Finds k again for the image as it is now, whatever has been kept."));
  button->setFocusPolicy(Qt::StrongFocus);
  button->setPopupMode(QToolButton::MenuButtonPopup);
  QObject::connect(button, &QToolButton::clicked, parent, [=]() { invoke(filter, "FitKAgain"); });
  auto* menu = new QMenu(button);
  QAction* series = menu->addAction(QObject::tr("Fit K Over Series"));
  series->setObjectName("FitKOverSeries");
  QObject::connect(
    series, &QAction::triggered, parent, [=]() { invoke(filter, "FitKOverSeries"); });
  button->setMenu(menu);
  return button;
}

} // namespace

pqKeepKDecorator::pqKeepKDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
  , WasValue(choiceInPanel(parentObject->property()) == vtkSchlierenFilter::K_VALUE)
  , Fit(newFitButton(parentObject->proxy(), parentObject))
{
  narrowLists(parentObject);
  appendToRow(parentObject, this->Fit);
  for (const unsigned long event :
    { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Connection->Connect(parentObject->property(), event, this, SLOT(onChoice()));
  }
  this->onChoice();
}

pqKeepKDecorator::~pqKeepKDecorator() = default;

void pqKeepKDecorator::onChoice()
{
  vtkSMProperty* choice = this->parentWidget()->property();
  vtkSMProxy* filter = this->parentWidget()->proxy();
  const bool was = this->WasValue;
  const int mode = choiceInPanel(choice);
  this->Fit->setVisible(
    mode == vtkSchlierenFilter::K_AUTOMATIC || mode == vtkSchlierenFilter::K_AUTOMATIC_KEPT);
  this->WasValue = mode == vtkSchlierenFilter::K_VALUE;
  // Acts if the applied k is another one and the user has chosen Value.
  if (!was && this->WasValue &&
    vtkSMPropertyHelper(choice).GetAsInt() != vtkSchlierenFilter::K_VALUE)
  {
    filter->UpdatePropertyInformation(filter->GetProperty("KScaleUsed"));
    const double k = vtkSMPropertyHelper(filter, "KScaleUsed").GetAsDouble();
    if (k > 0)
    {
      vtkSMUncheckedPropertyHelper(filter, "KScale").Set(k);
    }
  }
}
