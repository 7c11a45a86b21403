// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointer>
#include <QToolBar>

#include "SchlierenViews.h"
#include "vtkNew.h"

class QAction;
class QMessageBox;
class vtkEventQtSlotConnect;

/// The toolbar Schlieren, and the menu of the same name with the same actions.
class pqSchlierenToolBar : public QToolBar
{
  Q_OBJECT

public:
  explicit pqSchlierenToolBar(QWidget* parent = nullptr);
  ~pqSchlierenToolBar() override;

private Q_SLOTS:
  /// Enables and checks what fits the selected source.
  void updateActions();
  void watchSource();
  void setFollowing(bool isFollowing);

private:
  QAction* addArrangement(const char* name, const QString& text, const QString& hint,
    SchlierenViews::Arrangement arrangement);
  void addToolAction(QAction* action, const char* name, const QString& hint);
  void addMenu();

  /// Moves to the last row of toolbars, where there is room, unless the user has placed it before.
  void makeRoom();
  void tell(const SchlierenViews::Result& result);

  QList<QAction*> Arrangements;
  QAction* Follow;
  QPointer<QMessageBox> Message;
  vtkNew<vtkEventQtSlotConnect> Events;
};
