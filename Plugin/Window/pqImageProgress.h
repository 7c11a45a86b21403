// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"

#include <QElapsedTimer>
#include <QObject>

class pqPipelineSource;
class pqProgressWidget;
class pqRepresentation;
class vtkAlgorithm;
class vtkEventQtSlotConnect;
class vtkObject;

/// ParaView's progress bar and its abort button, while images are refined and, with the builtin server, while
/// Apply waits for a refractive index.
class pqImageProgress : public QObject
{
  Q_OBJECT

public:
  explicit pqImageProgress(QObject* parent);
  ~pqImageProgress() override;

protected:
  /// While Apply or a view waits: nothing but the abort button answers.
  bool eventFilter(QObject* receiver, QEvent* event) override;

private Q_SLOTS:
  void onProgress(vtkObject* filter);
  void onProgressOfView(vtkObject* bench);

private:
  void letAbort(vtkObject* filter);
  void watch(pqPipelineSource* source);
  void watchBenchOf(pqRepresentation* representation);
  void show(const QString& what, int percent);
  void abort();
  void enableAbort(pqProgressWidget* bar, bool isEnabled);

  bool IsRefining = false;
  vtkAlgorithm* Executing = nullptr; ///< while its progress is shown
  QElapsedTimer SinceEvents;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
