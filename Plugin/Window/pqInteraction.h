// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"

#include <QObject>
#include <QSet>

class pqView;
class vtkEventQtSlotConnect;
class vtkObject;

/// Knows whether the user is turning, moving or resizing a render view.
class pqInteraction : public QObject
{
  Q_OBJECT

public:
  /// The one of this program; made when first asked for.
  static pqInteraction* instance();

  /// Whether a mouse button is down in any render view.
  bool isOn() const { return !this->Moving.isEmpty(); }

  /// Whether the next rendering of a view answers the user's movements: the last one of them, or a new size.
  bool isAnsweredBy(vtkObject* view) const { return this->Moved.contains(view); }
  void setAnswered(vtkObject* view) { this->Moved.remove(view); }
  void setAllAnswered() { this->Moved.clear(); }

Q_SIGNALS:
  void ended();

private Q_SLOTS:
  void watch(pqView* view);
  void forget(pqView* view);
  void onEvent(vtkObject* interactor, unsigned long event, void* view);
  void onTimerOver(vtkObject* interactor, unsigned long event, void* view);

private:
  explicit pqInteraction(QObject* parent);
  ~pqInteraction() override;

  QSet<void*> Moving; // proxies of views
  QSet<void*> Moved;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
