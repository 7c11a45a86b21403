// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqGasNoteDecorator.h"

#include "WidgetRows.h"
#include "pqPropertyWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkGasTable.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QLabel>

namespace
{

constexpr double airConstant = 2.26e-4; // default for gases that are not in the table
constexpr int digits = 4;

} // namespace

//------------------------------------------------------------------------------
pqGasNoteDecorator::pqGasNoteDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
  , Constant(element->GetAttributeOrEmpty("constant"))
  , Note(new QLabel(parentObject))
{
  this->Note->setObjectName("Note");
  this->Note->setTextFormat(Qt::PlainText);
  this->Note->setWordWrap(true);
  appendBelow(parentObject, this->Note);
  vtkSMProxy* proxy = parentObject->proxy();
  for (vtkSMProperty* property : { parentObject->property(),
         proxy->GetProperty(this->Constant.constData()), proxy->GetProperty("Wavelength") })
  {
    for (const unsigned long event :
      { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
    {
      this->Connection->Connect(property, event, this, SLOT(showNote()));
    }
  }
  this->showNote();
}

//------------------------------------------------------------------------------
pqGasNoteDecorator::~pqGasNoteDecorator() = default;

//------------------------------------------------------------------------------
void pqGasNoteDecorator::showNote()
{
  vtkSMProxy* proxy = this->parentWidget()->proxy();
  const QString gas =
    QString::fromUtf8(vtkSMUncheckedPropertyHelper(this->parentWidget()->property()).GetAsString());
  const auto number = [](double value) { return QString::number(value, 'g', digits); };
  if (vtkGasTable::Has(gas.toStdString()))
  {
    const double wavelength = vtkSMUncheckedPropertyHelper(proxy, "Wavelength").GetAsDouble();
    const double constant = vtkGasTable::GetConstant(gas.toStdString(), wavelength);
    this->Note->setText(tr("%1: %2 m³/kg at %3 nm").arg(gas, number(constant), number(wavelength)));
    return;
  }
  const double constant =
    vtkSMUncheckedPropertyHelper(proxy, this->Constant.constData()).GetAsDouble();
  const QString air = constant == airConstant ? tr(" (air, visible light)") : QString();
  this->Note->setText(tr("Custom: %1 m³/kg").arg(number(constant)) + air);
}
