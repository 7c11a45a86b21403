// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqViewChoiceWidget.h"

#include "PicturesInViews.h"

#include "pqApplicationCore.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"

#include "vtkSMProperty.h"
#include "vtkSMProxy.h"

#include <QComboBox>
#include <QSignalBlocker>
#include <QVBoxLayout>

//------------------------------------------------------------------------------
pqViewChoiceWidget::pqViewChoiceWidget(
  vtkSMProxy* smProxy, vtkSMProperty* smProperty, QWidget* parentObject)
  : pqPropertyWidget(smProxy, parentObject)
  , Choice(new QComboBox(this))
{
  this->setProperty(smProperty);
  this->Choice->setObjectName("Choice");
  this->Choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Choice);
  this->fill();
  QObject::connect(this->Choice, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &pqViewChoiceWidget::viewChanged);

  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqViewChoiceWidget::fill);
  QObject::connect(model, &pqServerManagerModel::viewRemoved, this, &pqViewChoiceWidget::fill);
  this->addPropertyLink(this, "view", SIGNAL(viewChanged()), smProperty);
}

//------------------------------------------------------------------------------
pqViewChoiceWidget::~pqViewChoiceWidget() = default;

//------------------------------------------------------------------------------
QString pqViewChoiceWidget::view() const { return this->Choice->currentData().toString(); }

//------------------------------------------------------------------------------
void pqViewChoiceWidget::setView(const QString& name)
{
  int index = this->Choice->findData(name);
  if (index < 0)
  {
    this->Choice->addItem(tr("%1 (not there)").arg(name), name);
    index = this->Choice->count() - 1;
  }
  this->Choice->setCurrentIndex(index);
}

//------------------------------------------------------------------------------
void pqViewChoiceWidget::fill()
{
  const QString chosen = this->view();
  const QSignalBlocker blocker(this->Choice);
  this->Choice->clear();
  this->Choice->addItem(tr("None"), QString(""));
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqRenderView* view :
    model->findItems<pqRenderView*>(model->findServer(this->proxy()->GetSession())))
  {
    const QString name = view->getSMName();
    QObject::connect(
      view, &pqProxy::nameChanged, this, &pqViewChoiceWidget::fill, Qt::UniqueConnection);
    if (!picturesInViews::isFlat(view) && this->Choice->findData(name) < 0)
    {
      this->Choice->addItem(name, name);
    }
  }
  this->setView(chosen.isNull() ? QString("") : chosen);
}
