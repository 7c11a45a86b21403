// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include "vtkNew.h"

class vtkEventQtSlotConnect;

/// Lets K Scale begin with the k in use where the user switches Auto K Scale off in the panel: so the image stays as it
/// is. Scripts, undo and state files set both themselves.
class pqKeepKDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqKeepKDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqKeepKDecorator() override;

private Q_SLOTS:
  void onChoice();

private:
  bool WasAutomatic;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
