// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqRenderView;
class pqView;

/// Writes at the lower left of views how complete the images are that they show: the Status of filters and of those
/// inside of representations. Not part of what is saved.
class pqImageStatus : public QObject
{
  Q_OBJECT

public:
  explicit pqImageStatus(QObject* parent);

protected:
  /// The widgets of views: their size has changed.
  bool eventFilter(QObject* widget, QEvent* event) override;

private:
  void watch(pqView* view);
  void show(pqRenderView* view);
};
