// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QComboBox>
#include <QGridLayout>
#include <QWidget>

/// Adds a widget behind the others of a property's row.
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

/// Adds a widget below the others of a property's row, as wide as they are.
inline void appendBelowRow(QWidget* row, QWidget* added)
{
  QLayout* layout = row->layout();
  if (auto* grid = qobject_cast<QGridLayout*>(layout))
  {
    grid->addWidget(added, grid->rowCount(), 0, 1, -1);
    return;
  }
  if (auto* box = qobject_cast<QBoxLayout*>(layout))
  {
    box->setDirection(QBoxLayout::TopToBottom); // of one widget
  }
  appendToRow(row, added);
}

/// Lets the lists of properties' rows become so narrow that they fit into ParaView's default panel.
inline void narrowLists(QWidget* row)
{
  constexpr int fewestLetters = 4;
  for (QComboBox* list : row->findChildren<QComboBox*>())
  {
    list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list->setMinimumContentsLength(fewestLetters);
  }
}
