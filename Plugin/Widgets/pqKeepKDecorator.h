// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include "vtkNew.h"

class QToolButton;
class vtkEventQtSlotConnect;

/// Adds a button behind K Mode that finds an automatic k again, and sets K Scale to the k in use when the user chooses Value as
/// K Mode in the panel, which keeps the image. Scripts, undo and state files set both themselves.
class pqKeepKDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqKeepKDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqKeepKDecorator() override;

private Q_SLOTS:
  void onChoice();

private:
  bool WasValue;
  QToolButton* Fit;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
