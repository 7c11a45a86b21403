// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Lets a property's list be narrower than its longest entry, whose width a panel cannot spare:
/// `<PropertyWidgetDecorator type="SchlierenNarrowList"/>`.
class pqNarrowListDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqNarrowListDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqNarrowListDecorator() override;
};
