// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidget.h"

#include "vtkNew.h"

class QLabel;
class vtkEventQtSlotConnect;

/// Shows a filter's text property, to read and copy: ParaView would show a line edit.
class pqNoteWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqNoteWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqNoteWidget() override;

protected:
  void changeEvent(QEvent* event) override;

private Q_SLOTS:
  void refresh();
  void showText();

private:
  QLabel* Label;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
