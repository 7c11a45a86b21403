// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

/// Adds a button behind a property that finds the automatic k again, for the image as it is seen or, in its menu, for all
/// time steps, where Lock K keeps that of an earlier one.
class pqFitKDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqFitKDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqFitKDecorator() override;

private:
  void fit();
  void fitOverSeries();
};
