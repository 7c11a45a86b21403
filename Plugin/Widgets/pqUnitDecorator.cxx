// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqUnitDecorator.h"

#include "pqPropertyWidget.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"

#include <QBoxLayout>
#include <QEvent>
#include <QGridLayout>
#include <QLabel>

namespace
{

/// Finds the label before or above a property's widget; null if there is none.
QLabel* labelOf(QWidget* property)
{
  QWidget* panel = property->parentWidget();
  auto* grid = qobject_cast<QGridLayout*>(panel ? panel->layout() : nullptr);
  const int index = grid ? grid->indexOf(property) : -1;
  if (index < 0)
  {
    return nullptr;
  }
  int row = 0;
  int column = 0;
  int rows = 0;
  int columns = 0;
  grid->getItemPosition(index, &row, &column, &rows, &columns);
  QLayoutItem* item = grid->itemAtPosition(column > 0 ? row : row - 1, 0);
  return item ? qobject_cast<QLabel*>(item->widget()) : nullptr;
}

/// Writes a property's name above its widget, where ParaView 5.11 leaves it out: of lists of numbers.
QLabel* addLabel(pqPropertyWidget* property)
{
  auto* label = new QLabel("<p>" + QString(property->property()->GetXMLLabel()) + "</p>", property);
  if (auto* row = qobject_cast<QBoxLayout*>(property->layout()))
  {
    row->setDirection(QBoxLayout::TopToBottom);
    row->insertWidget(0, label);
  }
  label->show();
  return label;
}

} // namespace

pqUnitDecorator::pqUnitDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
  , Unit(QString::fromUtf8(element->GetAttributeOrEmpty("unit")))
{
  parentObject->installEventFilter(this); // waits for the label
}

pqUnitDecorator::~pqUnitDecorator() = default;

bool pqUnitDecorator::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Show)
  {
    watched->removeEventFilter(this);
    this->writeUnit();
  }
  return pqPropertyWidgetDecorator::eventFilter(watched, event);
}

void pqUnitDecorator::writeUnit()
{
  QLabel* label = labelOf(this->parentWidget());
  if (!label)
  {
    label = addLabel(this->parentWidget());
  }
  label->setObjectName(this->parentWidget()->objectName() + "Label");
  QString text = label->text();
  const QString unit = " (" + this->Unit + ")";
  const int end = text.lastIndexOf("</p>");
  label->setText(end < 0 ? text + unit : text.insert(end, unit));
}
