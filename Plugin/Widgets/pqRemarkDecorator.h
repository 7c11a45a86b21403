// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include "vtkNew.h"

class QLabel;
class vtkEventQtSlotConnect;

/// Says what a value in the panel means, behind or below it: what edge an angle is, how large data are with a length scale,
/// what a quality costs. `<PropertyWidgetDecorator type="SchlierenRemark"/>`.
class pqRemarkDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqRemarkDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqRemarkDecorator() override;

private Q_SLOTS:
  void showText();

private:
  QLabel* Label;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
