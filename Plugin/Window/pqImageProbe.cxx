// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageProbe.h"

#include "ImagesInViews.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"

#include <QHelpEvent>
#include <QToolTip>

namespace
{

/// Property of a watched widget: its view.
constexpr const char* viewOfWidget = "SchlierenProbedView";

/// Returns what the image that a view draws has at a place, from 0 to 1 to the right and up.
QString drawnInWords(pqRenderView* view, double right, double up)
{
  const QList<vtkSMProxy*> benches = imagesInViews::benchesIn(view);
  return benches.isEmpty() ? QString() : imagesInViews::placeInWords(benches.front(), right, up);
}

/// Returns what an image of a filter has at a place of a view.
QString sliceInWords(pqRenderView* view, double right, double up)
{
  for (pqPipelineSource* filter : imagesInViews::imagesIn(view))
  {
    const auto place = imagesInViews::placeInImage(filter, view, right, up);
    const QString text = imagesInViews::placeInWords(filter->getProxy(), place[0], place[1]);
    if (!text.isEmpty())
    {
      return text;
    }
  }
  return QString();
}

} // namespace

pqImageProbe::pqImageProbe(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqImageProbe::watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
}

void pqImageProbe::watch(pqView* view)
{
  if (qobject_cast<pqRenderView*>(view) && view->widget())
  {
    view->widget()->setProperty(viewOfWidget, QVariant::fromValue<QObject*>(view));
    view->widget()->installEventFilter(this);
    QObject::connect(view, &QObject::destroyed, view->widget(),
      [widget = view->widget()]() { widget->setProperty(viewOfWidget, QVariant()); });
  }
}

bool pqImageProbe::eventFilter(QObject* object, QEvent* event)
{
  auto* widget = qobject_cast<QWidget*>(object);
  auto* view = widget && event->type() == QEvent::ToolTip
    ? qobject_cast<pqRenderView*>(widget->property(viewOfWidget).value<QObject*>())
    : nullptr;
  if (!view)
  {
    return QObject::eventFilter(object, event);
  }
  auto* help = static_cast<QHelpEvent*>(event);
  const double right = (help->pos().x() + 0.5) / widget->width();
  const double up = 1 - (help->pos().y() + 0.5) / widget->height();
  QString text = drawnInWords(view, right, up);
  if (text.isEmpty())
  {
    text = sliceInWords(view, right, up);
  }
  if (text.isEmpty())
  {
    return QObject::eventFilter(object, event);
  }
  QToolTip::showText(help->globalPos(), text, widget);
  return true;
}
