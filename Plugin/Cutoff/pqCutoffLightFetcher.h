// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqCutoffLight.h"

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <QTimer>

class QWidget;
class vtkEventQtSlotConnect;
class vtkSMProxy;

/// Fetches the light on a filter's cutoff plane for a visible widget, after the image is finished.
class pqCutoffLightFetcher : public QObject
{
  Q_OBJECT

public:
  /// The widget owns it.
  pqCutoffLightFetcher(vtkSMProxy* filter, QWidget* widget);
  ~pqCutoffLightFetcher() override;

  /// Keeps the current light while waiting.
  void setWaiting(bool waits);

  const pqCutoffLight& light() const { return this->Light; }

Q_SIGNALS:
  /// Schedules a fetch after a change of the image.
  void imageChanged();
  void lightChanged();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private Q_SLOTS:
  void imageUpdated();
  void fetch();

private:
  vtkWeakPointer<vtkSMProxy> Filter;
  QWidget* Widget;
  QTimer Timer;
  bool Waits = false;
  int FetchedImage = 0; ///< its ImageCount
  pqCutoffLight Light;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
