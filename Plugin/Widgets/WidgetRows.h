// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QBoxLayout>
#include <QGridLayout>
#include <QWidget>

/// Puts a widget behind the others of a property's row.
inline void appendToRow(QWidget* row, QWidget* added)
{
  QLayout* layout = row->layout();
  if (auto* grid = qobject_cast<QGridLayout*>(layout))
  {
    grid->addWidget(added, 0, grid->columnCount());
  }
  else if (layout)
  {
    layout->addWidget(added);
  }
  else
  {
    added->hide();
  }
}
