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

/// Keeps the light on a filter's cutoff plane, wherever the filter runs; fetched while a widget that shows it is
/// visible, and when the image is finished.
class pqCutoffLightFetcher : public QObject
{
  Q_OBJECT

public:
  /// Belongs to the widget.
  pqCutoffLightFetcher(vtkSMProxy* filter, QWidget* widget);
  ~pqCutoffLightFetcher() override;

  /// While it waits, what is there stays.
  void setWaiting(bool waits);

  const pqCutoffLight& light() const { return this->Light; }

Q_SIGNALS:
  /// There is another image; the light follows.
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
  int FetchedImage = 0; ///< PictureCount
  pqCutoffLight Light;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
