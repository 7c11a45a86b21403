// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Shows a property of a filter where its input may be 2-D, in a plane or one cell thick:
/// `<PropertyWidgetDecorator type="SchlierenFlatData"/>`.
class pqFlatDataDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqFlatDataDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqFlatDataDecorator() override;

  bool canShowWidget(bool showAdvanced) const override;
};
