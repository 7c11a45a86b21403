// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidget.h"

#include <QString>

class QComboBox;

/// Chooses one of the 3-D render views, or none, for a property that holds a view's name. A name that no view
/// has stays as it is, and is said not to be there.
class pqViewChoiceWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QString view READ view WRITE setView NOTIFY viewChanged)

public:
  pqViewChoiceWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqViewChoiceWidget() override;

  /// The name; empty: none.
  QString view() const;
  void setView(const QString& name);

Q_SIGNALS:
  void viewChanged();

private Q_SLOTS:
  void fill();

private:
  QComboBox* Choice;
};
