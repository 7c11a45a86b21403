// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqUnitDecorator.h"

#include "WidgetRows.h"
#include "pqPropertyWidget.h"

#include "vtkPVXMLElement.h"

#include <QLabel>

//------------------------------------------------------------------------------
pqUnitDecorator::pqUnitDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  const QString unit = QString::fromUtf8(element->GetAttributeOrEmpty("unit"));
  auto* label = new QLabel(unit, parentObject);
  label->setObjectName("Unit");
  label->setTextFormat(Qt::PlainText);
  appendToRow(parentObject, label);
}

//------------------------------------------------------------------------------
pqUnitDecorator::~pqUnitDecorator() = default;
