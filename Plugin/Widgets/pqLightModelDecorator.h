// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include "vtkEventQtSlotConnect.h"
#include "vtkNew.h"

/// Of the property LightModel: shows it without advanced properties where it matters, that is where light
/// is waves or the cutoff needs them; and sets it to Auto with such a cutoff when this is chosen in the panel, to be
/// applied and undone with it.
class pqLightModelDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqLightModelDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqLightModelDecorator() override;

  bool canShowWidget(bool showAdvanced) const override;

private Q_SLOTS:
  void onChoice();

private:
  bool IsSetForCutoff = false;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
