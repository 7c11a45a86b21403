// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageStatus.h"

#include "ImagesInViews.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
#include "pqServerManagerModel.h"
#include "pqSettings.h"

#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QCoreApplication>
#include <QEvent>
#include <QLabel>
#include <QRegularExpression>

#include <algorithm>

namespace
{

const QString labelName = "SchlierenStatus";
const QString settingName = "Schlieren/ShowStatus";
constexpr int margin = 6; // pixels

/// Places the label at the upper left, away from the image's legend and ParaView's axes, if its words
/// fit and do not cover most of an image.
void place(QLabel* label, QWidget* view)
{
  constexpr double widest = 0.6; // of the view
  label->setWordWrap(false);
  const int width =
    std::min(label->sizeHint().width(), static_cast<int>(widest * view->width()) - margin);
  label->setWordWrap(true);
  label->resize(width, label->heightForWidth(width));
  label->move(margin, margin);
  label->setVisible(!label->text().isEmpty() && width >= label->minimumSizeHint().width() &&
    2 * label->height() < view->height());
}

QLabel* labelOf(QWidget* view)
{
  return view->findChild<QLabel*>(labelName, Qt::FindDirectChildrenOnly);
}

/// Returns the status of an image without the speed and the device, which do not concern it.
QString statusOf(vtkSMProxy* filter)
{
  static const QRegularExpression speed(
    ",( [0-9.]+( million)? rays/s on)? (CUDA|CPU)( \\([^)]*\\)| on each of [0-9]+ ranks)?");

  for (const char* name : { "Status", "Stopped" })
  {
    if (vtkSMProperty* property = filter->GetProperty(name))
    {
      filter->UpdatePropertyInformation(property);
    }
  }
  QString status = QString::fromUtf8(vtkSMPropertyHelper(filter, "Status").GetAsString());
  status.remove(speed);
  return vtkSMPropertyHelper(filter, "Stopped", true).GetAsInt() != 0 ? "Stopped. " + status
                                                                      : status;
}

} // namespace

bool pqImageStatus::isShown()
{
  return pqApplicationCore::instance()->settings()->value(settingName, true).toBool();
}

void pqImageStatus::setShown(bool isShown)
{
  pqApplicationCore::instance()->settings()->setValue(settingName, isShown);
  pqApplicationCore::instance()->render();
}

pqImageStatus::pqImageStatus(QObject* parentObject)
  : QObject(parentObject)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &pqImageStatus::watch);
  // Forgets views early, because they signal but cannot be queried while destroyed.
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
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
}

void pqImageStatus::watch(pqView* item)
{
  if (auto* view = qobject_cast<pqRenderView*>(item))
  {
    const auto update = [this, view]() { this->show(view); };
    QObject::connect(view, &pqView::endRender, this, update);
    QObject::connect(view, &pqView::representationVisibilityChanged, this, update);
    QObject::connect(view, &pqView::representationRemoved, this, update);
  }
}

void pqImageStatus::show(pqRenderView* view)
{
  QWidget* widget = view->widget();
  if (!widget)
  {
    return; // the view is being deleted
  }
  QStringList lines;
  if (imagesInViews::isFlat(view))
  {
    for (pqPipelineSource* filter : imagesInViews::imagesIn(view))
    {
      lines << statusOf(filter->getProxy());
    }
  }
  for (vtkSMProxy* bench : imagesInViews::benchesIn(view))
  {
    lines << statusOf(bench);
  }
  lines.removeAll(QString());
  if (!isShown())
  {
    lines.clear();
  }
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
  }
}

bool pqImageStatus::eventFilter(QObject* object, QEvent* event)
{
  auto* widget = qobject_cast<QWidget*>(object);
  QLabel* label = widget && event->type() == QEvent::Resize ? labelOf(widget) : nullptr;
  if (label)
  {
    place(label, widget);
  }
  return QObject::eventFilter(object, event);
}
