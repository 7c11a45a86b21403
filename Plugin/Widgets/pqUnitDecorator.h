// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Writes a property's unit behind what is entered: `<PropertyWidgetDecorator type="SchlierenUnit" unit="mm"/>`.
/// Not in its label, from which Python takes the property's name.
class pqUnitDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqUnitDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqUnitDecorator() override;
};
