// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Gives a decorator to the widgets of the other representations of a display, whose properties have no effect on the
/// one that this property belongs to:
/// `<PropertyWidgetDecorator type="SchlierenHideOthers"><PropertyWidgetDecorator .../></PropertyWidgetDecorator>`, where
/// the inner element is what they get. Properties of the display itself, such as its axes, are left alone.
class pqHideOthersDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqHideOthersDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqHideOthersDecorator() override;
};
