// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include "vtkNew.h"

#include <QString>

class QLabel;
class vtkEventQtSlotConnect;

/// Says below the choice of a gas which Gladstone-Dale constant it stands for, before it is applied:
/// `<PropertyWidgetDecorator type="SchlierenGasNote" constant="GladstoneDaleConstant"/>`, where `constant` is
/// the property that counts for a gas of the user's own.
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
