// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqRenderView;
class pqView;

/// Shows what an image has under the mouse when that rests in a view: position, deflection, optical path and intensity, in
/// units that suit them.
class pqImageProbe : public QObject
{
  Q_OBJECT

public:
  explicit pqImageProbe(QObject* parent);

protected:
  bool eventFilter(QObject* widget, QEvent* event) override;

private:
  void watch(pqView* view);
};
