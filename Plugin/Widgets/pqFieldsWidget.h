// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqRowsWidget.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <QVector>

class pqTransferFunctionWidget;
class QLabel;
class vtkEventQtSlotConnect;
class vtkPiecewiseFunction;
class vtkSMPropertyGroup;
class vtkSMProxyProperty;

/// Edits the fields of transfer functions, one in a row: the array, its range (empty: that of the
/// data) and, for filters with FieldColors, its colour; below the table, with the index model
/// Transfer Functions, ParaView's editor shows the function of the selected row. The properties are
/// Fields, FieldRanges, FieldColors and TransferFunctions. The functions are ParaView's opacity
/// functions "SchlierenField1", ..., which state files and scripts can restore. Moving a point
/// changes the function at once and the image with Apply. Shown for the index model Transfer
/// Functions and for ColorByField.
class pqFieldsWidget : public pqRowsWidget
{
  Q_OBJECT
  Q_PROPERTY(QList<QVariant> fields READ fields WRITE setFields NOTIFY fieldsChanged)
  Q_PROPERTY(QList<QVariant> ranges READ ranges WRITE setRanges NOTIFY rangesChanged)
  Q_PROPERTY(QList<QVariant> colors READ colors WRITE setColors NOTIFY colorsChanged)

public:
  pqFieldsWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqFieldsWidget() override;

  const QVariantList& fields() const { return this->Fields; }
  const QVariantList& ranges() const { return this->Ranges; }
  const QVariantList& colors() const { return this->Colors; }

  void setFields(const QVariantList& values) { this->setList(this->Fields, values); }
  void setRanges(const QVariantList& values) { this->setList(this->Ranges, values); }
  void setColors(const QVariantList& values) { this->setList(this->Colors, values); }

  void apply() override;
  void reset() override;

Q_SIGNALS:
  void fieldsChanged();
  void rangesChanged();
  void colorsChanged();

protected:
  void emitChanges() override;
  int rows() const override { return this->Fields.size(); }
  void makeRow(int row) override;
  void showRow(int row) override;
  void appendToLists() override;
  void removeFromLists(int row) override;
  void rowSelected(int row) override;

private Q_SLOTS:
  void readFunctions();
  void modelChanged();
  void pointsMoved();

private:
  using Functions = QVector<vtkSmartPointer<vtkSMProxy>>;

  void completeLists();
  void rangeEdited(int row);
  Functions usedFunctions() const;
  void unregisterUnused(Functions candidates); // a copy, which the function removes from Created

  QVariantList Fields, Ranges, Colors;
  Functions RowFunctions;      // null: not needed yet
  Functions Created;           // by this widget; some may be unused
  vtkSMProxy* Shown = nullptr; // the one of RowFunctions in the editor
  bool HasColors;
  QLabel* Title;
  pqTransferFunctionWidget* Editor;
  vtkSmartPointer<vtkSMProxyProperty> FunctionsProperty;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
