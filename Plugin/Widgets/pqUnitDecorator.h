// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidgetDecorator.h"

#include <QString>

/// Adds a property's unit to its name in the panel: `<PropertyWidgetDecorator type="SchlierenUnit"
/// unit="mm"/>`. Behind the value it could be out of sight in narrow panels; in the XML label it
/// would change the property's Python name.
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
