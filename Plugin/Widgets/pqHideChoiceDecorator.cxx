// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqHideChoiceDecorator.h"

#include "pqPropertyWidget.h"
#include "pqProxySelectionWidget.h"

#include <QComboBox>
#include <QLabel>

pqHideChoiceDecorator::pqHideChoiceDecorator(
  vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  const auto* selection = parentObject->findChild<pqProxySelectionWidget*>();
  auto* list = selection ? selection->findChild<QComboBox*>("comboBox") : nullptr;
  auto* label = selection ? selection->findChild<QLabel*>("label") : nullptr;
  if (list && label && list->count() == 1)
  {
    list->hide();
    label->hide();
  }
}

pqHideChoiceDecorator::~pqHideChoiceDecorator() = default;
