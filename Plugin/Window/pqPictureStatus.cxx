// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureStatus.h"

#include "PicturesInViews.h"
#include "pqPictureRefiner.h"
#include "pqRepresentationRefiner.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
#include "pqServerManagerModel.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QCoreApplication>
#include <QEvent>
#include <QLabel>
#include <QPushButton>

#include <algorithm>

namespace
{

const QString labelName = "SchlierenStatus";
const QString buttonName = "SchlierenContinue";
constexpr int margin = 6; // pixels

/// At the lower left, where there is room for it: for each word, and not over most of an image.
void place(QLabel* label, QWidget* view)
{
  label->setWordWrap(false);
  const int width = std::min(label->sizeHint().width(), view->width() - 2 * margin);
  label->setWordWrap(true);
  label->resize(width, label->heightForWidth(width));
  label->move(margin, view->height() - label->height() - margin);
  label->setVisible(!label->text().isEmpty() && width >= label->minimumSizeHint().width() &&
    2 * label->height() < view->height());
}

QLabel* labelOf(QWidget* view)
{
  return view->findChild<QLabel*>(labelName, Qt::FindDirectChildrenOnly);
}

QPushButton* buttonOf(QWidget* view)
{
  return view->findChild<QPushButton*>(buttonName, Qt::FindDirectChildrenOnly);
}

/// Above the line.
void place(QPushButton* button, const QLabel* label)
{
  button->resize(button->sizeHint());
  button->move(label->x(), label->y() - button->height() - margin);
}

QString statusOf(vtkSMProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("Status"));
  return QString::fromUtf8(vtkSMPropertyHelper(filter, "Status").GetAsString());
}

bool isStopped(pqPipelineSource* filter)
{
  return pqPictureRefiner::instance()->isStopped(filter->getProxy());
}

} // namespace

//------------------------------------------------------------------------------
pqPictureStatus::pqPictureStatus(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqPictureStatus::watch);
  // A view that is being destroyed still sends signals, but can no longer be asked.
  QObject::connect(model, &pqServerManagerModel::preViewRemoved, this,
    [this](pqView* view) { view->disconnect(this); });
  QObject::connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, this,
    [this, model]()
    {
      model->disconnect(this);
      for (pqView* view : model->findItems<pqView*>())
      {
        view->disconnect(this);
      }
    });
  QObject::connect(pqPictureRefiner::instance(), &pqPictureRefiner::stoppedChanged, this,
    [this, model](vtkSMProxy* filter)
    {
      auto* source = model->findItem<pqPipelineSource*>(filter);
      for (pqView* view : source ? picturesInViews::showing(source) : QList<pqView*>())
      {
        if (auto* flat = qobject_cast<pqRenderView*>(view))
        {
          this->show(flat);
        }
      }
    });
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
}

//------------------------------------------------------------------------------
void pqPictureStatus::watch(pqView* item)
{
  if (auto* view = qobject_cast<pqRenderView*>(item))
  {
    const auto update = [this, view]() { this->show(view); };
    QObject::connect(view, &pqView::updateDataEvent, this, update);
    QObject::connect(view, &pqView::endRender, this,
      [update, view]()
      {
        if (!pqRepresentationRefiner::benchesIn(view).isEmpty())
        {
          update();
        }
      });
    QObject::connect(view, &pqView::representationVisibilityChanged, this, update);
    QObject::connect(view, &pqView::representationRemoved, this, update);
  }
}

//------------------------------------------------------------------------------
void pqPictureStatus::show(pqRenderView* view)
{
  QWidget* widget = view->widget();
  if (!widget)
  {
    return; // the view is about to go
  }
  QStringList lines;
  if (picturesInViews::isFlat(view))
  {
    for (pqPipelineSource* filter : picturesInViews::picturesIn(view))
    {
      const QString status = statusOf(filter->getProxy());
      lines << (isStopped(filter) ? "Stopped. " + status : status);
    }
  }
  for (vtkSMProxy* bench : pqRepresentationRefiner::benchesIn(view))
  {
    lines << statusOf(bench);
  }
  lines.removeAll(QString());
  QLabel* label = labelOf(widget);
  if (!label && !lines.isEmpty())
  {
    label = new QLabel(widget);
    label->setObjectName(labelName);
    label->setTextFormat(Qt::PlainText);
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    label->setStyleSheet(
      "color: white; background: rgba(0, 0, 0, 150); padding: 2px 5px; border-radius: 3px");
    widget->installEventFilter(this);
  }
  if (label)
  {
    label->setText(lines.join('\n'));
    place(label, widget);
    this->showButton(view, label);
  }
}

//------------------------------------------------------------------------------
void pqPictureStatus::showButton(pqRenderView* view, const QLabel* label)
{
  const QList<pqPipelineSource*> filters = picturesInViews::picturesIn(view);
  const bool isWanted =
    picturesInViews::isFlat(view) && std::any_of(filters.begin(), filters.end(), isStopped);
  QPushButton* button = buttonOf(view->widget());
  if (!button && isWanted)
  {
    button = new QPushButton("Continue", view->widget());
    button->setObjectName(buttonName);
    button->setToolTip("Go on with the image that has been stopped");
    QObject::connect(button, &QPushButton::clicked, this,
      [view]()
      {
        for (pqPipelineSource* filter : picturesInViews::picturesIn(view))
        {
          pqPictureRefiner::instance()->resume(filter->getProxy());
        }
      });
  }
  if (button)
  {
    place(button, label);
    button->setVisible(isWanted);
  }
}

//------------------------------------------------------------------------------
bool pqPictureStatus::eventFilter(QObject* object, QEvent* event)
{
  auto* widget = qobject_cast<QWidget*>(object);
  QLabel* label = widget && event->type() == QEvent::Resize ? labelOf(widget) : nullptr;
  if (label)
  {
    place(label, widget);
    if (QPushButton* button = buttonOf(widget))
    {
      place(button, label);
    }
  }
  return QObject::eventFilter(object, event);
}
