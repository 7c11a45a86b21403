// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Describes the presets of Quality in its list. In the XML the texts would change the names that
/// scripts use.
class pqQualityHintsDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqQualityHintsDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqQualityHintsDecorator() override;
};
