// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidget.h"

#include "vtkNew.h"

#include <QVariant>

class QLineEdit;
class QToolButton;
class vtkEventQtSlotConnect;

/// Edits an optional point: three coordinates below each other, and a button to clear it. ParaView
/// would show a table for any number of points, with room for one of three columns.
class pqPointWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QVariantList point READ point WRITE setPoint NOTIFY pointChanged)

public:
  pqPointWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqPointWidget() override;

  /// Returns three numbers, or none.
  QVariantList point() const { return this->Point; }
  void setPoint(const QVariantList& point);

Q_SIGNALS:
  void pointChanged();

private Q_SLOTS:
  void onModified();

private:
  void edited(int axis);
  QString textOf(int axis) const;
  void showPoint();

  QVariantList Point;
  QLineEdit* Edits[3];
  QToolButton* Clear;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
