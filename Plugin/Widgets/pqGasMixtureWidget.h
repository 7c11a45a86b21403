// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqRowsWidget.h"

#include "vtkNew.h"

class vtkEventQtSlotConnect;
class vtkSMPropertyGroup;

/// Edits the species of a gas mixture, one in a row: the fraction's array, the gas, and its
/// constant and molar mass, editable for Custom and else from vtkGasTable. The properties are
/// MixtureArrays, MixtureGases, MixtureConstants and MixtureMolarMasses.
class pqGasMixtureWidget : public pqRowsWidget
{
  Q_OBJECT
  Q_PROPERTY(QList<QVariant> arrays READ arrays WRITE setArrays NOTIFY arraysChanged)
  Q_PROPERTY(QList<QVariant> gases READ gases WRITE setGases NOTIFY gasesChanged)
  Q_PROPERTY(QList<QVariant> constants READ constants WRITE setConstants NOTIFY constantsChanged)
  Q_PROPERTY(
    QList<QVariant> molarMasses READ molarMasses WRITE setMolarMasses NOTIFY molarMassesChanged)

public:
  pqGasMixtureWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqGasMixtureWidget() override;

  const QVariantList& arrays() const { return this->Arrays; }
  const QVariantList& gases() const { return this->Gases; }
  const QVariantList& constants() const { return this->Constants; }
  const QVariantList& molarMasses() const { return this->MolarMasses; }

  void setArrays(const QVariantList& values) { this->setList(this->Arrays, values); }
  void setGases(const QVariantList& values) { this->setList(this->Gases, values); }
  void setConstants(const QVariantList& values) { this->setList(this->Constants, values); }
  void setMolarMasses(const QVariantList& values) { this->setList(this->MolarMasses, values); }

Q_SIGNALS:
  void arraysChanged();
  void gasesChanged();
  void constantsChanged();
  void molarMassesChanged();

protected:
  void emitChanges() override;
  int rows() const override { return this->Arrays.size(); }
  void makeRow(int row) override;
  void showRow(int row) override;
  void appendToLists() override;
  void removeFromLists(int row) override;

private Q_SLOTS:
  void showAll();

private:
  void completeLists();
  void chooseGas(int row, const QString& gas);
  double wavelength() const;

  QVariantList Arrays, Gases, Constants, MolarMasses;
  vtkNew<vtkEventQtSlotConnect> Connection;
};
