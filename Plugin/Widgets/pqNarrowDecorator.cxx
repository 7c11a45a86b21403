// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqNarrowDecorator.h"

#include "WidgetRows.h"
#include "pqPropertyWidget.h"

//------------------------------------------------------------------------------
pqNarrowDecorator::pqNarrowDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  narrowLists(parentObject);
  if (QLayout* layout = parentObject->layout())
  {
    layout->setContentsMargins(0, 0, 0, 0);
  }
}

//------------------------------------------------------------------------------
pqNarrowDecorator::~pqNarrowDecorator() = default;
