// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointer>
#include <QToolBar>

#include "SchlierenViews.h"

class QAction;
class QMessageBox;

/// The toolbar Schlieren, and the menu of the same name with the same actions.
class pqSchlierenToolBar : public QToolBar
{
  Q_OBJECT

public:
  explicit pqSchlierenToolBar(QWidget* parent = nullptr);
  ~pqSchlierenToolBar() override;

private Q_SLOTS:
  /// Enables what fits the selected source.
  void updateActions();

private:
  QAction* addArrangement(const char* name, const QString& text, const QString& hint,
    SchlierenViews::Arrangement arrangement);
  void addMenu();

  /// Moves to the last row of toolbars, where there is room, unless the user has placed it before.
  void makeRoom();
  void showResult(const SchlierenViews::Result& result);

  QList<QAction*> Arrangements;
  QPointer<QMessageBox> Message;
};
