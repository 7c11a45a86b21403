// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkWeakPointer.h"

#include <QMap>
#include <QString>
#include <QVariant>

class vtkSMProxy;

/// Applies changes of properties during a mouse drag at once, as one undo step and trace entry.
/// Keeps other changes that wait for Apply.
class pqLiveEdit
{
public:
  pqLiveEdit(vtkSMProxy* filter, const QString& label);

  /// Returns whether the filter has made an image; before that, properties wait for Apply.
  static bool isPossible(vtkSMProxy* filter);

  /// Applies values for display.
  void show(const QMap<QString, QVariant>& values);

  /// Keeps the last values.
  void finish();

  /// Restores the first values.
  void cancel();

private:
  void push(const QMap<QString, QVariant>& values);

  vtkWeakPointer<vtkSMProxy> Filter;
  QString Label;
  QMap<QString, QVariant> Before, Now;
};
