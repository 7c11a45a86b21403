// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFirstPageDecorator.h"

pqFirstPageDecorator::pqFirstPageDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqCompositePropertyWidgetDecorator(element, parentObject)
{
}

pqFirstPageDecorator::~pqFirstPageDecorator() = default;

bool pqFirstPageDecorator::canShowWidget(bool showAdvanced) const
{
  return showAdvanced || pqCompositePropertyWidgetDecorator::canShowWidget(false);
}
