// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include "vtkNew.h"

class QLabel;
class vtkEventQtSlotConnect;

/// Shows below the length scale, before Apply, how large the data are with it:
/// `<PropertyWidgetDecorator type="SchlierenSizeNote"/>`.
class pqSizeNoteDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqSizeNoteDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqSizeNoteDecorator() override;

private Q_SLOTS:
  void showNote();

private:
  QLabel* Note;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
