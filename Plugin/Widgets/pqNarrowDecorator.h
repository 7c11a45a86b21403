// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Lets a property take no more width than a panel can spare: lists are narrower than their longest entry, and there are
/// no margins: `<PropertyWidgetDecorator type="SchlierenNarrow"/>`.
class pqNarrowDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqNarrowDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqNarrowDecorator() override;
};
