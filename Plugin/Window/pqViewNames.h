// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

#include "vtkNew.h"

class pqRepresentation;
class vtkEventQtSlotConnect;
class vtkObject;

/// Renames a view that has the name of a technique when what it draws as Schlieren gets another one.
class pqViewNames : public QObject
{
  Q_OBJECT

public:
  explicit pqViewNames(QObject* parent);
  ~pqViewNames() override;

private Q_SLOTS:
  void watch(pqRepresentation* representation);
  void onCutoffChanged(vtkObject* cutoff);

private:
  vtkNew<vtkEventQtSlotConnect> Connection;
};
