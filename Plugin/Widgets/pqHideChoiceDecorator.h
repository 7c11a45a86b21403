// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Hides the list of a proxy's property where it has one entry, and leaves the panel of what is chosen:
/// `<PropertyWidgetDecorator type="SchlierenHideChoice"/>`.
class pqHideChoiceDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqHideChoiceDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqHideChoiceDecorator() override;
};
