// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class QLabel;
class pqRenderView;
class pqView;

/// Writes into 2-D views, at the lower left, how far the pictures are that they show: the filters' Status.
/// Below *Continue*, where the user has stopped one. Not part of what is saved.
class pqPictureStatus : public QObject
{
  Q_OBJECT

public:
  explicit pqPictureStatus(QObject* parent);

protected:
  /// The widgets of views: their size has changed.
  bool eventFilter(QObject* widget, QEvent* event) override;

private:
  void watch(pqView* view);
  void show(pqRenderView* view);
  void showButton(pqRenderView* view, const QLabel* label);
};
