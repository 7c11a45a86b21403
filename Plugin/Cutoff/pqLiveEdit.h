// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkWeakPointer.h"

#include <QMap>
#include <QString>
#include <QVariant>

class vtkSMProxy;

/// Changes properties of a filter while the mouse is down, in the image too, as one step that can be undone
/// and one entry of a trace. Nothing else that waits for Apply is touched.
class pqLiveEdit
{
public:
  pqLiveEdit(vtkSMProxy* filter, const QString& label);

  /// Whether the filter is known to have made an image (PictureCount): until then properties wait for Apply.
  static bool isPossible(vtkSMProxy* filter);

  /// Values of these properties, which are shown.
  void show(const QMap<QString, QVariant>& values);

  /// Keeps the last values.
  void finish();

  /// Goes back to the first values.
  void cancel();

private:
  void push(const QMap<QString, QVariant>& values);

  vtkWeakPointer<vtkSMProxy> Filter;
  QString Label;
  QMap<QString, QVariant> Before, Now;
};
