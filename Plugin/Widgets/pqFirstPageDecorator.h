// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqCompositePropertyWidgetDecorator.h"

/// Leaves a property to the advanced ones while an expression is false, of decorators as in ParaView's CompositeDecorator:
/// `<PropertyWidgetDecorator type="SchlierenFirstPage"><Expression type="or">...`.
class pqFirstPageDecorator : public pqCompositePropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqFirstPageDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqFirstPageDecorator() override;

  bool canShowWidget(bool showAdvanced) const override;
};
