// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FieldFunctions.h"
#include "pqPropertyWidget.h"

#include "vtkNew.h"

#include <QVariant>

class pqTransferFunctionWidget;
class QLabel;
class QTableWidget;
class vtkEventQtSlotConnect;
class vtkSMPropertyGroup;

/// Edits the fields of transfer functions, one in a row: the array and its range (empty: that of the
/// data); below the table, ParaView's editor shows the function of the selected row. The properties
/// are Fields, FieldRanges and TransferFunctions. Moving a point changes the function at once and
/// the image with Apply. Shown for the index model Transfer Functions.
class pqFieldsWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QList<QVariant> fields READ fields WRITE setFields NOTIFY fieldsChanged)
  Q_PROPERTY(QList<QVariant> ranges READ ranges WRITE setRanges NOTIFY rangesChanged)

public:
  pqFieldsWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqFieldsWidget() override;

  const QVariantList& fields() const { return this->Fields; }
  const QVariantList& ranges() const { return this->Ranges; }

  void setFields(const QVariantList& values) { this->setList(this->Fields, values); }
  void setRanges(const QVariantList& values) { this->setList(this->Ranges, values); }

  void apply() override;
  void reset() override;

Q_SIGNALS:
  void fieldsChanged();
  void rangesChanged();

protected:
  /// Selects the row of a cell that gets the focus.
  bool eventFilter(QObject* cell, QEvent* event) override;

private Q_SLOTS:
  void readFunctions();
  void showFunction();
  void pointsMoved();

private:
  int rows() const { return this->Fields.size(); }
  void setList(QVariantList& list, const QVariantList& values);
  void completeLists();
  void emitChanges();
  void showRows();
  void addRow();
  void removeRow();
  void setCell(int row, int column, QWidget* widget, const QString& name);
  void rangeEdited(int row);

  QVariantList Fields, Ranges;
  vtkSMProxy* Shown = nullptr; // the one of Functions in the editor
  QTableWidget* Table;
  QLabel* Title;
  pqTransferFunctionWidget* Editor;
  FieldFunctions Functions;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
