// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFieldsWidget.h"

#include "pqArrayComboBox.h"

#include "pqColorChooserButton.h"
#include "pqPropertyWidgetDecorator.h"
#include "pqTransferFunctionWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QBoxLayout>
#include <QDoubleValidator>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QTableWidget>

#include <cmath>
#include <string>
#include <vector>

namespace
{

enum Column
{
  ARRAY,
  FROM,
  TO,
  COLOR
};

const char* const group = "piecewise_functions";
const std::string prefix = "SchlierenField"; // of the functions' names

/// Returns the filter's default colour.
QColor colorOf(int row) { return QColor::fromHsvF(std::fmod(row * 0.61803398875, 1), 1, 1); }

void complete(QVariantList& list, int count)
{
  while (list.size() > count)
  {
    list.removeLast();
  }
  while (list.size() < count)
  {
    list.append(0.);
  }
}

/// Registers a straight line from 0 to 1 under a new name.
vtkSmartPointer<vtkSMProxy> newFunction(vtkSMSessionProxyManager* manager)
{
  int number = 1;
  const auto name = [&]() { return prefix + std::to_string(number); };
  while (manager->GetProxy(group, (name() + ".PiecewiseFunction").c_str()))
  {
    ++number;
  }
  vtkNew<vtkSMTransferFunctionManager> functions;
  return functions->GetOpacityTransferFunction(name().c_str(), manager);
}

QLineEdit* newLimitEdit(const QString& limit)
{
  auto* edit = new QLineEdit;
  auto* validator = new QDoubleValidator(edit);
  validator->setLocale(QLocale::c());
  edit->setValidator(validator);
  edit->setFrame(false);
  edit->setPlaceholderText(limit);
  edit->setToolTip(
    pqFieldsWidget::tr("Both limits of the range, or none (auto): that of the data. What lies "
                       "beyond is clamped."));
  return edit;
}

/// Returns whether the panel shows the index model Transfer Functions.
bool usesFunctions(vtkSMProxy* proxy)
{
  constexpr int transferFunctions = 5;
  return vtkSMUncheckedPropertyHelper(proxy, "IndexModel").GetAsInt() == transferFunctions;
}

/// Shows the widget where fields are used. The filter Refractive Index has no ColorByField.
class Decorator : public pqPropertyWidgetDecorator
{
public:
  explicit Decorator(pqPropertyWidget* widget)
    : pqPropertyWidgetDecorator(nullptr, widget)
  {
    for (const char* name : { "IndexModel", "ColorByField" })
    {
      if (vtkSMProperty* property = widget->proxy()->GetProperty(name))
      {
        for (const unsigned long event :
          { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
        {
          this->Connection->Connect(property, event, this, SIGNAL(visibilityChanged()));
        }
      }
    }
  }

  bool canShowWidget(bool) const override
  {
    vtkSMProxy* proxy = this->parentWidget()->proxy();
    return usesFunctions(proxy) ||
      (proxy->GetProperty("ColorByField") &&
        vtkSMUncheckedPropertyHelper(proxy, "ColorByField").GetAsInt() != 0);
  }

private:
  vtkNew<vtkEventQtSlotConnect> Connection;
};

} // namespace

//------------------------------------------------------------------------------
pqFieldsWidget::pqFieldsWidget(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentObject)
  : pqRowsWidget(smproxy, smgroup, { tr("Array"), tr("From"), tr("To"), QString() }, tr("a field"),
      QString(), parentObject)
  , HasColors(smproxy->GetProperty("FieldColors") != nullptr)
  , Title(new QLabel(this))
  , Editor(new pqTransferFunctionWidget(this))
  , FunctionsProperty(vtkSMProxyProperty::SafeDownCast(smproxy->GetProperty("TransferFunctions")))
{
  this->table()->setColumnHidden(COLOR, !this->HasColors);
  this->table()->horizontalHeader()->setSectionResizeMode(COLOR, QHeaderView::Fixed);
  this->table()->setColumnWidth(COLOR, this->table()->verticalHeader()->defaultSectionSize());
  this->Title->setWordWrap(true);
  this->below()->addWidget(this->Title);
  this->Editor->setObjectName("TransferFunction");
  this->Editor->setMinimumHeight(150);
  this->below()->addWidget(this->Editor);
  QObject::connect(this->Editor, &pqTransferFunctionWidget::controlPointsModified, this,
    &pqFieldsWidget::pointsMoved);

  this->addPropertyLink(this, "fields", SIGNAL(fieldsChanged()), smproxy->GetProperty("Fields"));
  this->addPropertyLink(
    this, "ranges", SIGNAL(rangesChanged()), smproxy->GetProperty("FieldRanges"));
  if (this->HasColors)
  {
    this->addPropertyLink(
      this, "colors", SIGNAL(colorsChanged()), smproxy->GetProperty("FieldColors"));
  }
  for (const unsigned long event :
    { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Connection->Connect(
      smproxy->GetProperty("IndexModel"), event, this, SLOT(modelChanged()));
  }
  this->Connection->Connect(
    this->FunctionsProperty, vtkCommand::ModifiedEvent, this, SLOT(readFunctions()));
  this->readFunctions();

  this->addDecorator(new Decorator(this));
}

//------------------------------------------------------------------------------
pqFieldsWidget::~pqFieldsWidget() = default;

//------------------------------------------------------------------------------
void pqFieldsWidget::completeLists()
{
  complete(this->Ranges, 2 * this->rows());
  const int known = this->Colors.size() / 3;
  complete(this->Colors, 3 * this->rows());
  for (int row = known; row < this->rows(); ++row)
  {
    const QColor color = colorOf(row);
    this->Colors[3 * row] = color.redF();
    this->Colors[3 * row + 1] = color.greenF();
    this->Colors[3 * row + 2] = color.blueF();
  }
  this->RowFunctions.resize(this->rows());
  for (vtkSmartPointer<vtkSMProxy>& function : this->RowFunctions)
  {
    if (!function)
    {
      function = newFunction(this->proxy()->GetSessionProxyManager());
      this->Created.append(function);
    }
  }
}

//------------------------------------------------------------------------------
void pqFieldsWidget::emitChanges()
{
  this->completeLists();
  Q_EMIT this->fieldsChanged();
  Q_EMIT this->rangesChanged();
  Q_EMIT this->colorsChanged();
}

//------------------------------------------------------------------------------
void pqFieldsWidget::appendToLists()
{
  QStringList taken;
  for (const QVariant& name : this->Fields)
  {
    taken << name.toString();
  }
  this->Fields.append(pqArrayComboBox::firstBut(taken, this->proxy()->GetProperty("Density")));
  this->completeLists();
}

//------------------------------------------------------------------------------
void pqFieldsWidget::removeFromLists(int row)
{
  this->completeLists();
  this->Fields.removeAt(row);
  for (int i = 0; i < 2; ++i)
  {
    this->Ranges.removeAt(2 * row);
  }
  for (int i = 0; i < 3; ++i)
  {
    this->Colors.removeAt(3 * row);
  }
  this->RowFunctions.removeAt(row);
}

//------------------------------------------------------------------------------
void pqFieldsWidget::makeRow(int row)
{
  auto* array = new pqArrayComboBox(this->proxy()->GetProperty("Density"));
  this->setCell(row, ARRAY, array, "Field");
  QObject::connect(array, &QComboBox::currentTextChanged, this,
    [this, row](const QString& name)
    {
      this->Fields[row] = name;
      this->emitChanges();
      this->rowSelected(this->currentRow());
    });

  for (const int column : { FROM, TO })
  {
    QLineEdit* edit = newLimitEdit(tr("auto"));
    this->setCell(row, column, edit, column == FROM ? "From" : "To");
    QObject::connect(
      edit, &QLineEdit::editingFinished, this, [this, row]() { this->rangeEdited(row); });
  }

  auto* color = new pqColorChooserButton(nullptr);
  color->setShowAlphaChannel(false);
  color->setToolTip(tr("The field's colour, for Color By Field"));
  this->setCell(row, COLOR, color, "Color");
  QObject::connect(color, &pqColorChooserButton::chosenColorChanged, this,
    [this, row](const QColor& chosen)
    {
      this->completeLists();
      this->Colors[3 * row] = chosen.redF();
      this->Colors[3 * row + 1] = chosen.greenF();
      this->Colors[3 * row + 2] = chosen.blueF();
      this->emitChanges();
    });
}

//------------------------------------------------------------------------------
void pqFieldsWidget::rangeEdited(int row)
{
  if (row >= this->rows())
  {
    return;
  }
  this->completeLists();
  const QString from = this->cell<QLineEdit>(row, FROM)->text();
  const QString to = this->cell<QLineEdit>(row, TO)->text();
  // Waits until both limits are given.
  const bool given = !from.isEmpty() && !to.isEmpty();
  const double range[2] = { given ? from.toDouble() : 0, given ? to.toDouble() : 0 };
  if (this->Ranges[2 * row].toDouble() != range[0] ||
    this->Ranges[2 * row + 1].toDouble() != range[1])
  {
    this->Ranges[2 * row] = range[0];
    this->Ranges[2 * row + 1] = range[1];
    this->emitChanges();
  }
}

//------------------------------------------------------------------------------
void pqFieldsWidget::showRow(int row)
{
  this->cell<pqArrayComboBox>(row, ARRAY)->setArray(this->Fields[row].toString());

  const double range[2] = { this->Ranges.value(2 * row).toDouble(),
    this->Ranges.value(2 * row + 1).toDouble() };
  auto* from = this->cell<QLineEdit>(row, FROM);
  auto* to = this->cell<QLineEdit>(row, TO);
  const auto show = [](QLineEdit* edit, double value)
  {
    if (edit->text().isEmpty() || edit->text().toDouble() != value)
    {
      edit->setText(QString::number(value, 'g', 12));
      edit->setCursorPosition(0);
    }
  };
  if (range[0] != range[1])
  {
    show(from, range[0]);
    show(to, range[1]);
  }
  else if (!from->text().isEmpty() && !to->text().isEmpty())
  {
    from->clear();
    to->clear();
  }

  const bool given = this->Colors.size() >= 3 * (row + 1);
  auto* color = this->cell<pqColorChooserButton>(row, COLOR);
  const QSignalBlocker blocker(color);
  color->setChosenColor(given
      ? QColor::fromRgbF(this->Colors[3 * row].toDouble(), this->Colors[3 * row + 1].toDouble(),
          this->Colors[3 * row + 2].toDouble())
      : colorOf(row));
}

//------------------------------------------------------------------------------
void pqFieldsWidget::rowSelected(int row)
{
  vtkSMProxy* function =
    row >= 0 && row < this->RowFunctions.size() ? this->RowFunctions[row].Get() : nullptr;
  if (function != this->Shown)
  {
    this->Shown = function;
    this->Editor->initialize(nullptr, false,
      function ? vtkPiecewiseFunction::SafeDownCast(function->GetClientSideObject()) : nullptr,
      true);
  }
  // Hides the editor for Color By Field alone, which uses the fields without functions.
  const bool used = usesFunctions(this->proxy());
  this->Editor->setVisible(used && function);
  this->Title->setVisible(used || row < 0);
  this->Title->setText(row < 0
      ? tr("Add a field to begin.")
      : tr("Contribution of the refractivity over %1, from the low to the high end of its range:")
          .arg(this->Fields.value(row).toString()));
}

//------------------------------------------------------------------------------
void pqFieldsWidget::modelChanged() { this->rowSelected(this->currentRow()); }

//------------------------------------------------------------------------------
void pqFieldsWidget::pointsMoved()
{
  if (!this->Shown)
  {
    return;
  }
  auto* function = vtkPiecewiseFunction::SafeDownCast(this->Shown->GetClientSideObject());
  std::vector<double> points(4 * static_cast<std::size_t>(function->GetSize()));
  for (int i = 0; i < function->GetSize(); ++i)
  {
    function->GetNodeValue(i, points.data() + 4 * i);
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->Shown);
  vtkSMPropertyHelper(this->Shown, "Points")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  this->Shown->UpdateVTKObjects();
  Q_EMIT this->changeAvailable();
}

//------------------------------------------------------------------------------
pqFieldsWidget::Functions pqFieldsWidget::usedFunctions() const
{
  Functions used;
  for (unsigned int i = 0; i < this->FunctionsProperty->GetNumberOfProxies(); ++i)
  {
    used.append(this->FunctionsProperty->GetProxy(i));
  }
  return used;
}

//------------------------------------------------------------------------------
void pqFieldsWidget::readFunctions()
{
  this->RowFunctions = this->usedFunctions();
  this->refresh();
}

//------------------------------------------------------------------------------
void pqFieldsWidget::unregisterUnused(Functions candidates)
{
  const Functions used = this->usedFunctions();
  for (const vtkSmartPointer<vtkSMProxy>& function : qAsConst(candidates))
  {
    // Keeps functions that copied properties share with another filter.
    if (used.contains(function) || function->GetNumberOfConsumers() > 0)
    {
      continue;
    }
    this->Created.removeAll(function);
    vtkSMSessionProxyManager* manager = function->GetSessionProxyManager();
    const char* registered = manager->GetProxyName(group, function);
    const std::string name = registered ? registered : "";
    if (name.rfind(prefix, 0) == 0) // only our own
    {
      manager->UnRegisterProxy(group, name.c_str(), function);
    }
  }
}

//------------------------------------------------------------------------------
void pqFieldsWidget::apply()
{
  const Functions before = this->usedFunctions();
  if (this->RowFunctions != before)
  {
    const Functions now = this->RowFunctions; // a copy, because setting it reads them back
    std::vector<vtkSMProxy*> proxies(now.begin(), now.end());
    this->FunctionsProperty->SetProxies(static_cast<unsigned int>(proxies.size()), proxies.data());
  }
  this->pqRowsWidget::apply();
  this->proxy()->UpdateVTKObjects();
  this->unregisterUnused(this->Created + before);
}

//------------------------------------------------------------------------------
void pqFieldsWidget::reset()
{
  this->pqRowsWidget::reset();
  this->readFunctions();
  this->unregisterUnused(this->Created);
}
