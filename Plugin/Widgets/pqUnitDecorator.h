// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include <QString>

/// Writes a property's unit behind its name in the panel: `<PropertyWidgetDecorator type="SchlierenUnit"
/// unit="mm"/>`. Behind the value it would be out of sight, because ParaView's panel is often wider than its
/// dock; in the XML label Python would take it for a part of the property's name.
class pqUnitDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqUnitDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
  ~pqUnitDecorator() override;

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void writeUnit();

  QString Unit;
};
