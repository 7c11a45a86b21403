// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Puts a button behind a property whose menu sets up a bench of BenchPresets.h; Apply then makes its picture.
class pqPresetsDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqPresetsDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqPresetsDecorator() override;
};
