// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Says in the list of the presets of Quality what each takes, so that it shows which is faster and which is finer;
/// in the XML this would be a part of the names that scripts use.
class pqQualityHintsDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqQualityHintsDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqQualityHintsDecorator() override;
};
