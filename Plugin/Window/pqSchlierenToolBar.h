// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointer>
#include <QToolBar>

#include "SchlierenViews.h"
#include "pqViewFrameActionsInterface.h"

class QAction;
class QMenu;
class QMessageBox;
class QPushButton;

/// The toolbar and menu Schlieren; its first action is also in empty cells of a layout.
class pqSchlierenToolBar : public QToolBar, public pqViewFrameActionsInterface
{
  Q_OBJECT
  Q_INTERFACES(pqViewFrameActionsInterface)

public:
  explicit pqSchlierenToolBar(QWidget* parent = nullptr);
  ~pqSchlierenToolBar() override;

  void frameConnected(pqViewFrame* frame, pqView* view) override;

private Q_SLOTS:
  /// Enables the actions that fit the selected source, while there is a session.
  void updateActions();

private:
  QAction* addArrangement(const char* name, const QString& text, const QString& hint,
    SchlierenViews::Arrangement arrangement);
  void addMenu();
  void addToEmpty(QWidget* frame);

  /// Moves to the last row of toolbars, where there is room, unless the user has moved it before.
  void makeRoom();
  /// Makes views, or shows why not and offers what completes the flow.
  void add(SchlierenViews::Arrangement arrangement, const SchlierenViews::Cell& cell = {},
    const Completion& completion = {});
  /// Returns a button of the message.
  QPushButton* offer(const char* name, const QString& text);
  void showExample(const char* name);
  void showResult(const SchlierenViews::Result& result);
  QMessageBox* message();

  QList<QAction*> Arrangements;
  QMenu* Examples = nullptr;
  bool HasSession = true; ///< which is not being reset
  QPointer<QMessageBox> Message;
  QList<QPointer<QPushButton>> Offers; ///< in Message
};
