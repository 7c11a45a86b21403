// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QKeySequence>
#include <QList>
#include <QObject>

/// Holds the user's input during its lifetime, because ParaView handles events whenever a layout
/// changes, where another action may delete the views, or the session, that are being made. Afterwards
/// pressed keys trigger the actions that are enabled then; other input is dropped.
class HeldInput : public QObject
{
public:
  HeldInput();
  ~HeldInput() override;

  /// Returns whether an event of a widget or an action is the user's input, other than at the abort
  /// button of ParaView's progress bar.
  static bool isInput(QObject* receiver, QEvent* event);

  /// Notes the key of an event while input is held. Returns whether it has one.
  static bool note(QEvent* event);

  bool eventFilter(QObject* receiver, QEvent* event) override;

private:
  QList<QKeySequence> Keys;
};
