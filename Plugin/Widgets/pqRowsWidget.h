// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqPropertyWidget.h"

#include <QStringList>
#include <QVariant>

class QBoxLayout;
class QTableWidget;
class QToolButton;
class vtkSMPropertyGroup;

/// Base of editors of several lists: a table with a row for each entry of the first list, a widget
/// in each cell, and buttons to add and remove rows. The lists are Qt properties of the subclass,
/// linked with those of the proxy, so that Apply, Reset, undo and scripts work as usual. Each edit
/// completes all lists to the same length.
class pqRowsWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  /// `what` completes "Add ..."; `note` is below the table.
  pqRowsWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, const QStringList& headers,
    const QString& what, const QString& note, QWidget* parent = nullptr);

protected:
  QTableWidget* table() const { return this->Table; }
  QBoxLayout* below() const { return this->Layout; }
  int currentRow() const;

  /// Updates the table. Call it when a list has changed.
  void refresh();

  /// Sets a cell's widget, which selects its row when it gets the focus.
  void setCell(int row, int column, QWidget* widget, const QString& name);
  template <class Widget>
  Widget* cell(int row, int column) const
  {
    return qobject_cast<Widget*>(this->cellWidget(row, column));
  }

  /// Signals that the user has changed lists.
  virtual void emitChanges() = 0;

  virtual int rows() const = 0;
  virtual void makeRow(int row) = 0;
  virtual void showRow(int row) = 0;
  virtual void appendToLists() = 0;
  virtual void removeFromLists(int row) = 0;
  virtual void rowSelected(int row);

  /// Sets `list`, with `perRow` values for each row, and shows it.
  void setList(QVariantList& list, const QVariantList& values);

  bool eventFilter(QObject* watched, QEvent* event) override;

private Q_SLOTS:
  void addRow();
  void removeRow();
  void selectionChanged();

private:
  QWidget* cellWidget(int row, int column) const;
  int rowOf(QObject* widget) const;

  QBoxLayout* Layout;
  QTableWidget* Table;
  QToolButton* Remove;
};
