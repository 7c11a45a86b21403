// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqBenchWidget.h"

#include "WidgetRows.h"
#include "pqPropertiesPanel.h"
#include "pqPropertyWidgetDecorator.h"
#include "pqProxyWidget.h"
#include "pqSearchBox.h"
#include "pqUndoStack.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMTrace.h"

#include <QVBoxLayout>

#include <algorithm>

namespace
{

/// Returns what is searched for in the panel that a widget is in.
QString searchedFor(const QWidget* widget)
{
  while (widget && !qobject_cast<const pqPropertiesPanel*>(widget))
  {
    widget = widget->parentWidget();
  }
  const auto* box = widget ? widget->findChild<pqSearchBox*>() : nullptr;
  return box ? box->text() : QString();
}

} // namespace

pqBenchWidget::pqBenchWidget(vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
{
  this->setProperty(smProperty);
  this->setShowLabel(false);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  this->Connection->Connect(smProperty, vtkCommand::ModifiedEvent, this, SLOT(showBench()));
  this->showBench();
}

pqBenchWidget::~pqBenchWidget() = default;

void pqBenchWidget::showBench()
{
  vtkSMProxy* bench = vtkSMPropertyHelper(this->property(), true).GetAsProxy();
  if (bench == this->Bench)
  {
    return;
  }
  this->Bench = bench;
  delete this->Panel;
  if (bench)
  {
    this->Panel = new pqProxyWidget(bench, this);
    this->Panel->setObjectName("BenchPanel");
    this->layout()->addWidget(this->Panel);
    narrowLists(this->Panel);
    this->Panel->setView(this->view());
    QObject::connect(
      this->Panel, &pqProxyWidget::changeAvailable, this, &pqPropertyWidget::changeAvailable);
    for (const auto* row : this->Panel->findChildren<pqPropertyWidget*>())
    {
      QObject::connect(row, &pqPropertyWidget::changeAvailable, this,
        [this, row]()
        {
          if (row->property())
          {
            this->Changed = row->property()->GetXMLLabel();
          }
        });
    }
    QObject::connect(this->Panel, &pqProxyWidget::changeFinished, this,
      [this]()
      {
        SCOPED_UNDO_SET(tr("Change %1").arg(this->Changed)); // around ParaView's "Property Changed"
        Q_EMIT this->changeFinished();
      });
    this->search(false);
  }
}

void pqBenchWidget::apply()
{
  pqPropertyWidget::apply();
  if (this->Panel)
  {
    SM_SCOPED_TRACE(BlockTraceItems); // the display's trace has the filter's properties
    this->Panel->apply();
  }
}

void pqBenchWidget::reset()
{
  if (this->Panel)
  {
    this->Panel->reset();
  }
  pqPropertyWidget::reset();
}

void pqBenchWidget::setView(pqView* aView)
{
  if (this->Panel)
  {
    this->Panel->setView(aView);
  }
  pqPropertyWidget::setView(aView);
}

void pqBenchWidget::updateWidget(bool showAdvanced)
{
  this->search(showAdvanced);
  pqPropertyWidget::updateWidget(showAdvanced);
}

void pqBenchWidget::setVisible(bool visible)
{
  // The panel hides what its search does not find in the name and the description of the display's property.
  if (!searchedFor(this).isEmpty())
  {
    const bool isActive = std::all_of(this->decorators().begin(), this->decorators().end(),
      [](const pqPropertyWidgetDecorator* decorator) { return decorator->canShowWidget(true); });
    visible = isActive && this->search(true);
  }
  pqPropertyWidget::setVisible(visible);
}

bool pqBenchWidget::search(bool showAdvanced)
{
  return this->Panel && this->Panel->filterWidgets(showAdvanced, searchedFor(this));
}
