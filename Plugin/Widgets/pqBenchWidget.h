// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidget.h"

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <QPointer>

class pqProxyWidget;
class vtkEventQtSlotConnect;

/// Shows the panel of the filter that a display has as the value of a property, of which the panel's search finds the
/// properties, too: ParaView would show a list with one entry, and search among the display's own properties.
class pqBenchWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqBenchWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqBenchWidget() override;

  void apply() override;
  void reset() override;
  void setView(pqView* view) override;
  void updateWidget(bool showAdvanced) override;
  void setVisible(bool visible) override;

private Q_SLOTS:
  void showBench();

private:
  /// Returns whether the search allows any property to be seen.
  bool search(bool showAdvanced);

  vtkWeakPointer<vtkSMProxy> Bench;
  QPointer<pqProxyWidget> Panel;
  QString Changed; ///< the label of the property that was changed last
  vtkNew<vtkEventQtSlotConnect> Connection;
};
