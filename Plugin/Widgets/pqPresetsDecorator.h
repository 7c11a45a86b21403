// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Adds a menu behind a property that sets up a bench of BenchPresets.h: at once in the image or,
/// before the first image, with Apply.
class pqPresetsDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqPresetsDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqPresetsDecorator() override;
};
