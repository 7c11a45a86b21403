// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqRenderView;
class pqView;

/// Shows the status of images at the upper left of their views. Not saved.
class pqImageStatus : public QObject
{
  Q_OBJECT

public:
  explicit pqImageStatus(QObject* parent);

  /// Whether views show it, a setting of the user that is kept.
  static bool isShown();
  static void setShown(bool isShown);

protected:
  /// Watches the size of views.
  bool eventFilter(QObject* widget, QEvent* event) override;

private:
  void watch(pqView* view);
  void show(pqRenderView* view);
};
