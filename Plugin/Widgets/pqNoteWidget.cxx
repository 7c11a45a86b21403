// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqNoteWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QHBoxLayout>
#include <QLabel>

//------------------------------------------------------------------------------
pqNoteWidget::pqNoteWidget(vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
  , Label(new QLabel(this))
{
  this->setProperty(smProperty);
  this->Label->setObjectName("Note");
  this->Label->setTextFormat(Qt::PlainText);
  this->Label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->Label->setWordWrap(true);
  auto* box = new QHBoxLayout(this);
  box->setMargin(0);
  box->addWidget(this->Label);
  this->Connection->Connect(smProperty, vtkCommand::ModifiedEvent, this, SLOT(showText()));
  // ParaView itself asks when the output's extent is asked for, before the filter has run.
  this->Connection->Connect(smProxy, vtkCommand::UpdateDataEvent, this, SLOT(ask()));
  this->showText();
}

//------------------------------------------------------------------------------
pqNoteWidget::~pqNoteWidget() = default;

//------------------------------------------------------------------------------
void pqNoteWidget::ask() { this->proxy()->UpdatePropertyInformation(this->property()); }

//------------------------------------------------------------------------------
void pqNoteWidget::showText()
{
  const QString text = QString::fromUtf8(vtkSMPropertyHelper(this->property(), true).GetAsString());
  this->Label->setText(text.isEmpty() ? tr("known after Apply") : text);
}
