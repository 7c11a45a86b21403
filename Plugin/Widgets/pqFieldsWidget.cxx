// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFieldsWidget.h"

#include "pqPropertyWidgetDecorator.h"
#include "pqProxyWidget.h"
#include "pqTransferFunctionWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPVXMLElement.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMTrace.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QDoubleValidator>
#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QTableWidget>
#include <QToolButton>

#include <algorithm>
#include <vector>

namespace
{

enum Column
{
  ARRAY,
  FROM,
  TO
};

void complete(QVariantList& list, int count)
{
  list = list.mid(0, count);
  while (list.size() < count)
  {
    list.append(0.);
  }
}

/// Lists the arrays of the flow, each once, although points and cells may both have it.
QStringList arraysFor(vtkSMProxy* proxy)
{
  auto* domain = proxy->GetProperty("Density")->FindDomain<vtkSMArrayListDomain>();
  QStringList names;
  for (unsigned int i = 0; domain && i < domain->GetNumberOfStrings(); ++i)
  {
    names << QString::fromUtf8(domain->GetString(i));
  }
  names.removeDuplicates();
  return names;
}

QLineEdit* newLimitEdit(const QString& text)
{
  auto* edit = new QLineEdit(text);
  auto* validator = new QDoubleValidator(edit);
  validator->setLocale(QLocale::c());
  edit->setValidator(validator);
  edit->setFrame(false);
  edit->setPlaceholderText(pqFieldsWidget::tr("auto"));
  edit->setToolTip(
    pqFieldsWidget::tr("Both limits of the range, or none (auto): that of the data. What lies "
                       "beyond is clamped."));
  return edit;
}

} // namespace

pqFieldsWidget::pqFieldsWidget(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentObject)
  : pqPropertyWidget(smproxy, parentObject)
  , Table(new QTableWidget(0, TO + 1, this))
  , Title(new QLabel(this))
  , Editor(new pqTransferFunctionWidget(this))
  , Functions(vtkSMProxyProperty::SafeDownCast(smproxy->GetProperty("TransferFunctions")))
{
  this->setShowLabel(false);
  this->Table->setObjectName("Table");
  this->Table->setHorizontalHeaderLabels({ tr("Array"), tr("From"), tr("To") });
  QHeaderView* header = this->Table->horizontalHeader();
  header->setMinimumSectionSize(24);
  header->setSectionResizeMode(QHeaderView::Stretch);
  this->Table->verticalHeader()->hide();
  this->Table->setSelectionBehavior(QAbstractItemView::SelectRows);
  this->Table->setSelectionMode(QAbstractItemView::SingleSelection);
  this->Table->setTabKeyNavigation(false); // Tab leaves the table after the last cell
  QObject::connect(
    this->Table, &QTableWidget::itemSelectionChanged, this, &pqFieldsWidget::showFunction);
  this->Title->setWordWrap(true);
  this->Editor->setObjectName("TransferFunction");
  this->Editor->setMinimumHeight(150);
  QObject::connect(this->Editor, &pqTransferFunctionWidget::controlPointsModified, this,
    &pqFieldsWidget::pointsMoved);

  auto* buttons = new QHBoxLayout;
  const auto addButton = [&](const char* name, const char* icon, const QString& tip, auto clicked)
  {
    auto* button = new QToolButton(this);
    button->setObjectName(name);
    button->setIcon(QIcon(icon));
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    button->setFocusPolicy(Qt::StrongFocus);
    buttons->addWidget(button);
    QObject::connect(button, &QToolButton::clicked, this, clicked);
  };
  addButton("Add", ":/QtWidgets/Icons/pqPlus.svg", tr("Add a field"), &pqFieldsWidget::addRow);
  addButton(
    "Remove", ":/QtWidgets/Icons/pqMinus.svg", tr("Remove a field"), &pqFieldsWidget::removeRow);
  buttons->addStretch();
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(pqProxyWidget::newGroupLabelWidget(smgroup->GetXMLLabel(), this));
  layout->addWidget(this->Table);
  layout->addLayout(buttons);
  layout->addWidget(this->Title);
  layout->addWidget(this->Editor);

  this->addPropertyLink(this, "fields", SIGNAL(fieldsChanged()), smproxy->GetProperty("Fields"));
  this->addPropertyLink(
    this, "ranges", SIGNAL(rangesChanged()), smproxy->GetProperty("FieldRanges"));
  this->Connection->Connect(
    this->Functions.property(), vtkCommand::ModifiedEvent, this, SLOT(readFunctions()));
  this->readFunctions();

  // Shows all of it where its properties would be shown.
  pqPropertyWidgetDecorator::create(
    smproxy->GetProperty("Fields")->GetHints()->FindNestedElementByName("PropertyWidgetDecorator"),
    this);
}

pqFieldsWidget::~pqFieldsWidget() = default;

void pqFieldsWidget::completeLists()
{
  complete(this->Ranges, 2 * this->rows());
  this->Functions.complete(this->rows());
}

void pqFieldsWidget::emitChanges()
{
  this->completeLists();
  Q_EMIT this->fieldsChanged();
  Q_EMIT this->rangesChanged();
}

void pqFieldsWidget::setList(QVariantList& list, const QVariantList& values)
{
  if (list != values)
  {
    list = values;
    this->showRows();
  }
}

void pqFieldsWidget::addRow()
{
  const QStringList arrays = arraysFor(this->proxy());
  const auto unused = std::find_if(arrays.begin(), arrays.end(),
    [this](const QString& name) { return !this->Fields.contains(name); });
  this->Fields.append(unused == arrays.end() ? QString() : *unused);
  this->completeLists();
  this->showRows();
  this->emitChanges();
  this->Table->selectRow(this->rows() - 1);
}

void pqFieldsWidget::removeRow()
{
  const int row = this->Table->currentRow();
  if (row < 0)
  {
    return;
  }
  this->completeLists();
  this->Fields.removeAt(row);
  this->Ranges = this->Ranges.mid(0, 2 * row) + this->Ranges.mid(2 * row + 2);
  this->Functions.remove(row);
  this->showRows();
  this->emitChanges();
}

void pqFieldsWidget::setCell(int row, int column, QWidget* widget, const QString& name)
{
  widget->setObjectName(QString("%1%2").arg(name).arg(row));
  widget->setAccessibleName(QString("%1 %2").arg(name).arg(row + 1));
  widget->setProperty("row", row);
  widget->installEventFilter(this);
  this->Table->setCellWidget(row, column, widget);
}

bool pqFieldsWidget::eventFilter(QObject* cell, QEvent* event)
{
  if (event->type() == QEvent::FocusIn)
  {
    this->Table->selectRow(cell->property("row").toInt());
  }
  return this->pqPropertyWidget::eventFilter(cell, event);
}

void pqFieldsWidget::showRows()
{
  constexpr int fewest = 2, most = 4; // rows without scrolling
  const int chosen = std::max(0, this->Table->currentRow());
  for (QWidget* cell :
    this->Table->viewport()->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly))
  {
    cell->setObjectName(QString()); // because it is deleted later
  }
  this->Table->setRowCount(0);
  this->Table->setRowCount(this->rows());
  for (int row = 0; row < this->rows(); ++row)
  {
    auto* array = new QComboBox;
    array->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    array->setMinimumContentsLength(4);
    array->addItems(arraysFor(this->proxy()));
    const QString name = this->Fields[row].toString();
    if (array->findText(name) < 0)
    {
      array->addItem(name);
    }
    array->setCurrentText(name);
    this->setCell(row, ARRAY, array, "Field");
    QObject::connect(array, &QComboBox::currentTextChanged, this,
      [this, row](const QString& text)
      {
        this->Fields[row] = text;
        this->emitChanges();
        this->showFunction();
      });

    const double range[2] = { this->Ranges.value(2 * row).toDouble(),
      this->Ranges.value(2 * row + 1).toDouble() };
    for (const int column : { FROM, TO })
    {
      QLineEdit* edit = newLimitEdit(
        range[0] == range[1] ? QString() : QString::number(range[column - FROM], 'g', 12));
      this->setCell(row, column, edit, column == FROM ? "From" : "To");
      QObject::connect(
        edit, &QLineEdit::editingFinished, this, [this, row]() { this->rangeEdited(row); });
    }
  }
  this->Table->setFixedHeight(this->Table->horizontalHeader()->sizeHint().height() +
    qBound(fewest, this->rows(), most) * this->Table->verticalHeader()->defaultSectionSize() +
    2 * this->Table->frameWidth());
  this->Table->selectRow(std::min(chosen, this->rows() - 1));
  this->showFunction();
}

void pqFieldsWidget::rangeEdited(int row)
{
  if (row >= this->rows())
  {
    return;
  }
  this->completeLists();
  const auto textOf = [this, row](int column)
  { return qobject_cast<QLineEdit*>(this->Table->cellWidget(row, column))->text(); };
  const QString from = textOf(FROM);
  const QString to = textOf(TO);
  // Waits until both limits are given.
  const bool given = !from.isEmpty() && !to.isEmpty();
  const QVariantList range = { given ? from.toDouble() : 0., given ? to.toDouble() : 0. };
  if (this->Ranges.mid(2 * row, 2) != range)
  {
    std::copy(range.begin(), range.end(), this->Ranges.begin() + 2 * row);
    this->emitChanges();
  }
}

void pqFieldsWidget::showFunction()
{
  const int row = this->rows() > 0 ? this->Table->currentRow() : -1;
  vtkSMProxy* function = this->Functions.at(row);
  if (function != this->Shown)
  {
    this->Shown = function;
    this->Editor->initialize(nullptr, false,
      function ? vtkPiecewiseFunction::SafeDownCast(function->GetClientSideObject()) : nullptr,
      true);
  }
  this->Editor->setVisible(function);
  this->Title->setText(row < 0
      ? tr("Add a field to begin.")
      : tr("Contribution of the refractivity over %1, from the low to the high end of its range:")
          .arg(this->Fields.value(row).toString()));
}

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

void pqFieldsWidget::readFunctions()
{
  this->Functions.read();
  this->showRows();
}

void pqFieldsWidget::apply()
{
  this->Functions.write();
  this->pqPropertyWidget::apply();
  this->proxy()->UpdateVTKObjects();
  this->Functions.dropUnused();
}

void pqFieldsWidget::reset()
{
  this->pqPropertyWidget::reset();
  this->readFunctions();
  this->Functions.dropUnused();
}
