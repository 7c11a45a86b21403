// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageProbe.h"

#include "ImagesInViews.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"

#include "vtkClientServerStream.h"
#include "vtkPVDataInformation.h"
#include "vtkPVSession.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"
#include "vtkSMSourceProxy.h"

#include <QHelpEvent>
#include <QToolTip>

#include <array>
#include <cmath>

namespace
{

/// Property of a watched widget: its view.
constexpr const char* viewOfWidget = "SchlierenProbedView";

/// Returns what the image of a filter has at a place, from 0 to 1 to the right and up, where the filter is.
QString placeInWords(vtkSMProxy* filter, double right, double up)
{
  // Sends the place itself, because a property would make views update.
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(filter) << "SetProbedPlace" << right << up
         << vtkClientServerStream::End;
  filter->GetSession()->ExecuteStream(vtkPVSession::DATA_SERVER, stream);
  filter->UpdatePropertyInformation(filter->GetProperty("ProbedPlace"));
  return QString::fromUtf8(vtkSMPropertyHelper(filter, "ProbedPlace").GetAsString());
}

/// Returns what the image that a view draws has at a place, from 0 to 1 to the right and up.
QString drawnInWords(pqRenderView* view, double right, double up)
{
  const QList<vtkSMProxy*> benches = imagesInViews::benchesIn(view);
  return benches.isEmpty() ? QString() : placeInWords(benches.front(), right, up);
}

/// Returns what an image of a filter, which is in the plane z = 0, has at a place of a view.
QString sliceInWords(pqRenderView* view, double right, double up)
{
  vtkRenderer* renderer = view->getRenderViewProxy()->GetRenderer();
  const int* size = renderer->GetSize();
  std::array<std::array<double, 4>, 2> ends{}; // of the line of sight
  for (int end = 0; end < 2; ++end)
  {
    renderer->SetDisplayPoint(right * size[0], up * size[1], end);
    renderer->DisplayToWorld();
    renderer->GetWorldPoint(ends[end].data());
    for (int axis = 0; axis < 3; ++axis)
    {
      ends[end][axis] /= ends[end][3];
    }
  }
  const double depth = ends[0][2] - ends[1][2];
  if (depth == 0)
  {
    return QString();
  }
  const double along = ends[0][2] / depth;
  std::array<double, 2> place{};
  for (int axis = 0; axis < 2; ++axis)
  {
    place[axis] = ends[0][axis] + along * (ends[1][axis] - ends[0][axis]);
  }
  for (pqPipelineSource* filter : imagesInViews::imagesIn(view))
  {
    vtkPVDataInformation* image = filter->getSourceProxy()->GetDataInformation(0);
    const auto fraction = [&](int axis)
    {
      // Bounds are centres of pixels.
      const double* bounds = image->GetBounds() + 2 * axis;
      const int* extent = image->GetExtent() + 2 * axis;
      const double last = extent[1] - extent[0];
      return (0.5 + last * (place[axis] - bounds[0]) / (bounds[1] - bounds[0])) / (last + 1);
    };
    const QString text = placeInWords(filter->getProxy(), fraction(0), fraction(1));
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
