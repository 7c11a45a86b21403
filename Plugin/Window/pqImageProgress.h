// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"

#include <QElapsedTimer>
#include <QObject>

class pqProgressWidget;
class pqProxy;
class vtkAlgorithm;
class vtkEventQtSlotConnect;
class vtkObject;

/// Shows ParaView's progress bar and abort button while images are refined, and with the builtin
/// server lets that button abort an update.
class pqImageProgress : public QObject
{
  Q_OBJECT

public:
  explicit pqImageProgress(QObject* parent);
  ~pqImageProgress() override;

protected:
  /// Blocks all but the abort button during updates and renderings.
  bool eventFilter(QObject* receiver, QEvent* event) override;

private Q_SLOTS:
  void letAbort(vtkObject* filter);

private:
  void watch(pqProxy* item);
  void show(const QString& what, int percent);
  void abort();
  void enableAbort(pqProgressWidget* bar, bool isEnabled);

  bool IsRefining = false;
  vtkAlgorithm* Executing = nullptr; ///< whose progress is shown
  QElapsedTimer SinceEvents;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
