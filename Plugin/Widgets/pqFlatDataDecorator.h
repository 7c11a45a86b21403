// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Leaves a property to the advanced ones unless the filter's input may be 2-D, in a plane or one cell thick:
/// `<PropertyWidgetDecorator type="SchlierenFlatData"/>`. Expressions take no decorators but ParaView's since 6.1.
class pqFlatDataDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqFlatDataDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqFlatDataDecorator() override;

  bool canShowWidget(bool showAdvanced) const override;
};
