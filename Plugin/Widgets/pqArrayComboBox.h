// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <QComboBox>

class vtkEventQtSlotConnect;
class vtkSMArrayListDomain;
class vtkSMProperty;

/// Chooses one of the arrays that another property of the proxy offers. Keeps and lists a name that
/// the input does not have.
class pqArrayComboBox : public QComboBox
{
  Q_OBJECT

public:
  /// `offering` has a vtkSMArrayListDomain; null offers nothing.
  explicit pqArrayComboBox(vtkSMProperty* offering, QWidget* parent = nullptr);
  ~pqArrayComboBox() override;

  void setArray(const QString& name);

  /// Returns the first offered array that is not in `taken`; empty if there is none.
  static QString firstBut(const QStringList& taken, vtkSMProperty* offering);

private Q_SLOTS:
  void fill();

private:
  vtkWeakPointer<vtkSMArrayListDomain> Domain;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
