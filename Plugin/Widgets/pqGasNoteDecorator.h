// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include "vtkNew.h"

#include <QString>

class QLabel;
class vtkEventQtSlotConnect;

/// Shows the Gladstone-Dale constant below the choice of a gas, before Apply:
/// `<PropertyWidgetDecorator type="SchlierenGasNote" constant="GladstoneDaleConstant"/>`, where
/// `constant` is the property for a custom gas.
class pqGasNoteDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqGasNoteDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqGasNoteDecorator() override;

private Q_SLOTS:
  void showNote();

private:
  QByteArray Constant;
  QLabel* Note;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
