// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqNarrowListDecorator.h"

#include "WidgetRows.h"
#include "pqPropertyWidget.h"

//------------------------------------------------------------------------------
pqNarrowListDecorator::pqNarrowListDecorator(
  vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  narrowLists(parentObject);
}

//------------------------------------------------------------------------------
pqNarrowListDecorator::~pqNarrowListDecorator() = default;
