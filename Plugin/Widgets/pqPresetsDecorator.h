// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Puts a button behind a property whose menu sets up a bench of BenchPresets.h, which is in the image at once; before
/// the first image it waits for Apply.
class pqPresetsDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqPresetsDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqPresetsDecorator() override;
};
