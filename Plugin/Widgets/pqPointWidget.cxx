// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPointWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QDoubleValidator>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>

//------------------------------------------------------------------------------
pqPointWidget::pqPointWidget(vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
  , Clear(new QToolButton(this))
{
  this->setProperty(smProperty);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  for (int axis = 0; axis < 3; ++axis)
  {
    auto* edit = new QLineEdit(this);
    edit->setObjectName(QString("Coordinate%1").arg(axis));
    auto* validator = new QDoubleValidator(edit);
    validator->setLocale(QLocale::c());
    edit->setValidator(validator);
    edit->setPlaceholderText(tr("automatic"));
    grid->addWidget(new QLabel(QString("XYZ"[axis]), this), axis, 0);
    grid->addWidget(edit, axis, 1);
    this->Edits[axis] = edit;
    QObject::connect(
      edit, &QLineEdit::editingFinished, this, [this, axis]() { this->edited(axis); });
  }
  this->Clear->setObjectName("Clear");
  this->Clear->setText(tr("Clear"));
  this->Clear->setToolTip(tr("No point of one's own"));
  grid->addWidget(this->Clear, 3, 1);
  QObject::connect(this->Clear, &QToolButton::clicked, this,
    [this]()
    {
      this->setPoint({});
      Q_EMIT this->pointChanged();
    });
  this->showPoint();
  this->addPropertyLink(this, "point", SIGNAL(pointChanged()), smProperty);
  this->Connection->Connect(smProperty, vtkCommand::ModifiedEvent, this, SLOT(onModified()));
}

//------------------------------------------------------------------------------
pqPointWidget::~pqPointWidget() = default;

//------------------------------------------------------------------------------
void pqPointWidget::setPoint(const QVariantList& point)
{
  this->Point = point.size() >= 3 ? point.mid(0, 3) : QVariantList();
  this->showPoint();
}

//------------------------------------------------------------------------------
void pqPointWidget::onModified()
{
  // Clears the point, because the link does not report removed values.
  if (vtkSMUncheckedPropertyHelper(this->property()).GetNumberOfElements() == 0)
  {
    this->setPoint({});
  }
}

//------------------------------------------------------------------------------
void pqPointWidget::edited(int axis)
{
  // Uses only edited texts, because the others may be rounded.
  if (this->Edits[axis]->text() != this->textOf(axis))
  {
    if (this->Point.isEmpty())
    {
      this->Point = { 0., 0., 0. };
    }
    this->Point[axis] = this->Edits[axis]->text().toDouble();
    this->showPoint();
    Q_EMIT this->pointChanged();
  }
}

//------------------------------------------------------------------------------
QString pqPointWidget::textOf(int axis) const
{
  constexpr int digits = 8;
  return this->Point.isEmpty() ? QString()
                               : QString::number(this->Point[axis].toDouble(), 'g', digits);
}

//------------------------------------------------------------------------------
void pqPointWidget::showPoint()
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Edits[axis]->setText(this->textOf(axis));
    this->Edits[axis]->setCursorPosition(0);
  }
  this->Clear->setEnabled(!this->Point.isEmpty());
}
