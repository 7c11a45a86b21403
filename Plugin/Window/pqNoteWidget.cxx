// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqNoteWidget.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRepresentationRefiner.h"
#include "pqServerManagerModel.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>

pqNoteWidget::pqNoteWidget(vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
  , Label(new QLabel(this))
{
  this->setProperty(smProperty);
  this->setShowLabel(false); // a sentence says what it is about, and takes the width
  this->Label->setObjectName("Note");
  this->Label->setTextFormat(Qt::PlainText);
  this->Label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->Label->setWordWrap(true);
  auto* box = new QHBoxLayout(this);
  box->setContentsMargins(0, 0, 0, 0);
  box->addWidget(this->Label);
  this->Connection->Connect(smProperty, vtkCommand::ModifiedEvent, this, SLOT(showText()));
  auto* source =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(smProxy);
  if (source)
  {
    // Updates after the filter, unlike ParaView, which updates before, with the output's extent.
    QObject::connect(source, QOverload<pqPipelineSource*>::of(&pqPipelineSource::dataUpdated), this,
      &pqNoteWidget::refresh);
    QObject::connect(source, &pqProxy::modifiedStateChanged, this, &pqNoteWidget::showText);
  }
  else // a filter inside of a representation
  {
    QObject::connect(pqRepresentationRefiner::instance(), &pqRepresentationRefiner::imageChanged,
      this,
      [this](vtkSMProxy* changed)
      {
        if (changed == this->proxy())
        {
          this->refresh();
        }
      });
  }
  this->showText();
}

pqNoteWidget::~pqNoteWidget() = default;

void pqNoteWidget::changeEvent(QEvent* event)
{
  // Keeps the widget enabled, because disabled ones look like a line edit.
  if (event->type() == QEvent::EnabledChange && this->testAttribute(Qt::WA_ForceDisabled))
  {
    this->setEnabled(true);
  }
  pqPropertyWidget::changeEvent(event);
}

void pqNoteWidget::refresh()
{
  this->proxy()->UpdatePropertyInformation(this->property());
  this->showText(); // also of what stays empty
}

void pqNoteWidget::showText()
{
  const QString text = QString::fromUtf8(vtkSMPropertyHelper(this->property(), true).GetAsString());
  const auto* source =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
      this->proxy());
  const bool isToApply = source && source->modifiedState() == pqProxy::UNINITIALIZED;
  this->Label->setText(!text.isEmpty() ? text
      : isToApply                      ? tr("known after Apply")
                                       : tr("known with the image"));
}
