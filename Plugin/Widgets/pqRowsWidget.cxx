// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqRowsWidget.h"

#include "pqProxyWidget.h"

#include "vtkSMPropertyGroup.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>

namespace
{

constexpr int rowsShown = 4;

QToolButton* newButton(const char* name, const char* icon, const QString& tip, QWidget* parent)
{
  auto* button = new QToolButton(parent);
  button->setObjectName(name);
  button->setIcon(QIcon(icon));
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setFocusPolicy(Qt::StrongFocus);
  return button;
}

} // namespace

//------------------------------------------------------------------------------
pqRowsWidget::pqRowsWidget(vtkSMProxy* smproxy, vtkSMPropertyGroup* group,
  const QStringList& headers, const QString& what, const QString& note, QWidget* parentObject)
  : pqPropertyWidget(smproxy, parentObject)
  , Layout(new QVBoxLayout(this))
  , Table(new QTableWidget(0, headers.size(), this))
{
  this->setShowLabel(false);
  this->Layout->setContentsMargins(0, 0, 0, 0);

  this->Layout->addWidget(pqProxyWidget::newGroupLabelWidget(group->GetXMLLabel(), this));

  this->Table->setObjectName("Table");
  this->Table->setHorizontalHeaderLabels(headers);
  this->Table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  // Leaves scrolling to the narrow panel.
  this->Table->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  this->Table->horizontalHeader()->setMinimumSectionSize(24);
  this->Table->verticalHeader()->hide();
  this->Table->setSelectionBehavior(QAbstractItemView::SelectRows);
  this->Table->setSelectionMode(QAbstractItemView::SingleSelection);
  this->Table->setTabKeyNavigation(false); // Tab leaves the table after the last cell
  this->Layout->addWidget(this->Table);

  auto* buttons = new QHBoxLayout;
  auto* add = newButton("Add", ":/QtWidgets/Icons/pqPlus.svg", tr("Add %1").arg(what), this);
  this->Remove =
    newButton("Remove", ":/QtWidgets/Icons/pqMinus.svg", tr("Remove %1").arg(what), this);
  buttons->addWidget(add);
  buttons->addWidget(this->Remove);
  buttons->addWidget(new QLabel(note, this));
  buttons->addStretch();
  this->Layout->addLayout(buttons);

  QObject::connect(add, &QToolButton::clicked, this, &pqRowsWidget::addRow);
  QObject::connect(this->Remove, &QToolButton::clicked, this, &pqRowsWidget::removeRow);
  QObject::connect(
    this->Table, &QTableWidget::itemSelectionChanged, this, &pqRowsWidget::selectionChanged);
  this->Remove->setEnabled(false);
}

//------------------------------------------------------------------------------
QWidget* pqRowsWidget::cellWidget(int row, int column) const
{
  return this->Table->cellWidget(row, column);
}

//------------------------------------------------------------------------------
int pqRowsWidget::currentRow() const
{
  const QList<QTableWidgetSelectionRange> ranges = this->Table->selectedRanges();
  return ranges.isEmpty() ? -1 : ranges.first().topRow();
}

//------------------------------------------------------------------------------
void pqRowsWidget::setCell(int row, int column, QWidget* widget, const QString& name)
{
  widget->setObjectName(QString("%1%2").arg(name).arg(row));
  widget->setAccessibleName(QString("%1 %2").arg(name).arg(row + 1));
  widget->installEventFilter(this);
  this->Table->setCellWidget(row, column, widget);
}

//------------------------------------------------------------------------------
void pqRowsWidget::refresh()
{
  const int before = this->Table->rowCount(), now = this->rows();
  if (before != now)
  {
    for (int row = now; row < before; ++row)
    {
      for (int column = 0; column < this->Table->columnCount(); ++column)
      {
        this->cellWidget(row, column)->setObjectName(QString()); // because it is deleted later
      }
    }
    this->Table->setRowCount(now);
    for (int row = before; row < now; ++row)
    {
      this->makeRow(row);
    }
    const int height = this->Table->verticalHeader()->defaultSectionSize();
    this->Table->setFixedHeight(this->Table->horizontalHeader()->sizeHint().height() +
      qBound(2, now, rowsShown) * height + 2 * this->Table->frameWidth());
  }
  for (int row = 0; row < now; ++row)
  {
    this->showRow(row);
  }
  if (this->currentRow() < 0 && now > 0)
  {
    this->Table->selectRow(0);
  }
  this->selectionChanged();
}

//------------------------------------------------------------------------------
void pqRowsWidget::setList(QVariantList& list, const QVariantList& values)
{
  if (list != values)
  {
    list = values;
    this->refresh();
  }
}

//------------------------------------------------------------------------------
void pqRowsWidget::addRow()
{
  this->appendToLists();
  this->refresh();
  this->emitChanges();
  const int last = this->rows() - 1;
  this->Table->selectRow(last);
  this->cellWidget(last, 0)->setFocus();
}

//------------------------------------------------------------------------------
void pqRowsWidget::removeRow()
{
  const int row = this->currentRow();
  if (row < 0)
  {
    return;
  }
  this->removeFromLists(row);
  this->refresh();
  this->emitChanges();
  this->Table->selectRow(qMin(row, this->rows() - 1));
}

//------------------------------------------------------------------------------
void pqRowsWidget::selectionChanged()
{
  const int row = this->currentRow();
  this->Remove->setEnabled(row >= 0);
  this->rowSelected(row);
}

//------------------------------------------------------------------------------
void pqRowsWidget::rowSelected(int) {}

//------------------------------------------------------------------------------
int pqRowsWidget::rowOf(QObject* widget) const
{
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    for (int column = 0; column < this->Table->columnCount(); ++column)
    {
      if (this->cellWidget(row, column) == widget)
      {
        return row;
      }
    }
  }
  return -1;
}

//------------------------------------------------------------------------------
bool pqRowsWidget::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::FocusIn)
  {
    const int row = this->rowOf(watched);
    if (row >= 0 && row != this->currentRow())
    {
      this->Table->selectRow(row);
    }
  }
  return this->pqPropertyWidget::eventFilter(watched, event);
}
