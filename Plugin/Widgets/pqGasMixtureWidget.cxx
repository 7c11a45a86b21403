// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqGasMixtureWidget.h"

#include "pqArrayComboBox.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkGasTable.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QDoubleValidator>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QTableWidget>

namespace
{

enum Column
{
  ARRAY,
  GAS,
  CONSTANT,
  MOLAR_MASS
};

// Defaults of unknown gases: those of air.
constexpr double airConstant = 2.26e-4;
constexpr double airMolarMass = 0.0289647;
const char* const custom = "Custom";

/// Returns the gas's name for a formula.
QString nameOf(const QString& gas)
{
  for (int i = 0; i < vtkGasTable::GetNumberOfGases(); ++i)
  {
    const std::string name = vtkGasTable::GetName(i);
    if (vtkGasTable::GetFormula(name) == gas.toStdString())
    {
      return QString::fromStdString(name);
    }
  }
  return gas.isEmpty() ? QString(custom) : gas;
}

void complete(QVariantList& list, int count, const QVariant& value)
{
  while (list.size() > count)
  {
    list.removeLast();
  }
  while (list.size() < count)
  {
    list.append(value);
  }
}

QLineEdit* newNumberEdit()
{
  auto* edit = new QLineEdit;
  auto* validator = new QDoubleValidator(edit);
  validator->setLocale(QLocale::c());
  validator->setBottom(0);
  edit->setValidator(validator);
  edit->setFrame(false);
  return edit;
}

void showNumber(QLineEdit* edit, double value, bool editable)
{
  edit->setEnabled(editable);
  // Keeps the user's text if it has the same value.
  if (edit->text().isEmpty() || edit->text().toDouble() != value)
  {
    edit->setText(QString::number(value, 'g', editable ? 12 : 4));
    edit->setCursorPosition(0);
  }
  edit->setToolTip(edit->text());
}

} // namespace

//------------------------------------------------------------------------------
pqGasMixtureWidget::pqGasMixtureWidget(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentObject)
  : pqRowsWidget(smproxy, smgroup, { tr("Array"), tr("Gas"), tr("K"), tr("M") }, tr("a gas"),
      tr("K: m³/kg, M: kg/mol"), parentObject)
{
  const char* const tips[] = {
    "The array with the gas's fraction",
    "The gas; Custom: K and M are given here",
    "Gladstone-Dale constant at Wavelength, m^3/kg",
    "Molar mass, kg/mol; counts where Fraction Type is Volume",
  };
  for (int column = ARRAY; column <= MOLAR_MASS; ++column)
  {
    this->table()->horizontalHeaderItem(column)->setToolTip(tr(tips[column]));
  }
  this->addPropertyLink(
    this, "arrays", SIGNAL(arraysChanged()), smproxy->GetProperty("MixtureArrays"));
  this->addPropertyLink(
    this, "gases", SIGNAL(gasesChanged()), smproxy->GetProperty("MixtureGases"));
  this->addPropertyLink(
    this, "constants", SIGNAL(constantsChanged()), smproxy->GetProperty("MixtureConstants"));
  this->addPropertyLink(
    this, "molarMasses", SIGNAL(molarMassesChanged()), smproxy->GetProperty("MixtureMolarMasses"));
  for (const unsigned long event :
    { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Connection->Connect(smproxy->GetProperty("Wavelength"), event, this, SLOT(showAll()));
  }
  this->refresh();
}

//------------------------------------------------------------------------------
pqGasMixtureWidget::~pqGasMixtureWidget() = default;

//------------------------------------------------------------------------------
double pqGasMixtureWidget::wavelength() const
{
  return vtkSMUncheckedPropertyHelper(this->proxy(), "Wavelength").GetAsDouble();
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::completeLists()
{
  complete(this->Gases, this->rows(), custom);
  complete(this->Constants, this->rows(), airConstant);
  complete(this->MolarMasses, this->rows(), airMolarMass);
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::emitChanges()
{
  this->completeLists();
  Q_EMIT this->arraysChanged();
  Q_EMIT this->gasesChanged();
  Q_EMIT this->constantsChanged();
  Q_EMIT this->molarMassesChanged();
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::appendToLists()
{
  QStringList taken;
  for (const QVariant& name : this->Arrays)
  {
    taken << name.toString();
  }
  vtkSMProperty* density = this->proxy()->GetProperty("Density");
  taken << vtkSMUncheckedPropertyHelper(density).GetAsString(4);
  this->Arrays.append(pqArrayComboBox::firstBut(taken, density));
  this->completeLists();
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::removeFromLists(int row)
{
  this->completeLists();
  for (QVariantList* list : { &this->Arrays, &this->Gases, &this->Constants, &this->MolarMasses })
  {
    list->removeAt(row);
  }
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::chooseGas(int row, const QString& gas)
{
  this->completeLists();
  this->Gases[row] = gas;
  if (vtkGasTable::Has(gas.toStdString()))
  {
    this->Constants[row] = vtkGasTable::GetConstant(gas.toStdString(), this->wavelength());
    this->MolarMasses[row] = vtkGasTable::GetMolarMass(gas.toStdString());
  }
  this->showRow(row);
  this->emitChanges();
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::makeRow(int row)
{
  auto* array = new pqArrayComboBox(this->proxy()->GetProperty("Density"));
  this->setCell(row, ARRAY, array, "Array");
  QObject::connect(array, &QComboBox::currentTextChanged, this,
    [this, row](const QString& name)
    {
      this->Arrays[row] = name;
      this->emitChanges();
    });

  auto* gas = new QComboBox;
  gas->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  gas->setMinimumContentsLength(4);
  gas->addItem(custom);
  for (int i = 0; i < vtkGasTable::GetNumberOfGases(); ++i)
  {
    const std::string name = vtkGasTable::GetName(i);
    gas->addItem(QString::fromStdString(name));
    gas->setItemData(i + 1, QString::fromStdString(vtkGasTable::GetSource(name)), Qt::ToolTipRole);
  }
  this->setCell(row, GAS, gas, "Gas");
  QObject::connect(gas, &QComboBox::currentTextChanged, this,
    [this, row](const QString& name) { this->chooseGas(row, name); });

  for (const int column : { CONSTANT, MOLAR_MASS })
  {
    QLineEdit* edit = newNumberEdit();
    this->setCell(row, column, edit, column == CONSTANT ? "Constant" : "MolarMass");
    QObject::connect(edit, &QLineEdit::editingFinished, this,
      [this, row, column, edit]()
      {
        this->completeLists();
        QVariantList& list = column == CONSTANT ? this->Constants : this->MolarMasses;
        if (row < list.size() && list[row].toDouble() != edit->text().toDouble())
        {
          list[row] = edit->text().toDouble();
          this->emitChanges();
        }
      });
  }
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::showRow(int row)
{
  this->cell<pqArrayComboBox>(row, ARRAY)->setArray(this->Arrays[row].toString());

  const QString name = nameOf(this->Gases.value(row).toString());
  auto* gas = this->cell<QComboBox>(row, GAS);
  const QSignalBlocker blocker(gas);
  if (gas->findText(name) < 0)
  {
    gas->addItem(name); // an unknown gas of a script, which Apply reports
  }
  gas->setCurrentIndex(gas->findText(name));
  gas->setToolTip(QString::fromStdString(vtkGasTable::GetSource(name.toStdString())));

  const bool isCustom = name == custom;
  const std::string text = name.toStdString();
  showNumber(this->cell<QLineEdit>(row, CONSTANT),
    isCustom ? this->Constants.value(row, airConstant).toDouble()
             : vtkGasTable::GetConstant(text, this->wavelength()),
    isCustom);
  showNumber(this->cell<QLineEdit>(row, MOLAR_MASS),
    isCustom ? this->MolarMasses.value(row, airMolarMass).toDouble()
             : vtkGasTable::GetMolarMass(text),
    isCustom);
}

//------------------------------------------------------------------------------
void pqGasMixtureWidget::showAll() { this->refresh(); }
