// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageStatus.h"

#include "ImagesInViews.h"
#include "Remedies.h"
#include "pqLiveEdit.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
#include "pqServerManagerModel.h"
#include "pqSettings.h"

#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkWeakPointer.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QEvent>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>

#include <algorithm>

namespace
{

const QString labelName = "SchlierenStatus";
const QString remediesName = "SchlierenRemedies";
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

/// Shows the buttons that mend images below their label, and other ones only if these change, because one may be pressed.
void showRemedies(QWidget* view, const QWidget* label, const QList<vtkSMProxy*>& filters)
{
  auto* box = view->findChild<QDialogButtonBox*>(remediesName, Qt::FindDirectChildrenOnly);
  QVector<QPair<vtkSMProxy*, Remedy>> remedies;
  QStringList texts;
  for (vtkSMProxy* filter : filters)
  {
    for (const Remedy& remedy : remediesFor(filter))
    {
      remedies.append({ filter, remedy });
      texts << QString::number(filter->GetGlobalID()) + remedy.text;
    }
  }
  if (!box && remedies.empty())
  {
    return;
  }
  if (!box)
  {
    box = new QDialogButtonBox(view);
    box->setObjectName(remediesName);
  }
  if (box->property("texts").toStringList() != texts)
  {
    box->setProperty("texts", texts);
    box->clear();
    for (const auto& [filter, remedy] : remedies)
    {
      QPushButton* button = box->addButton(remedy.text, QDialogButtonBox::ActionRole);
      button->setObjectName(remedy.text);
      const auto mend = [filter = vtkWeakPointer<vtkSMProxy>(filter), remedy = remedy]()
      {
        if (filter)
        {
          pqLiveEdit edit(filter, remedy.text);
          edit.show(remedy.values);
          edit.finish();
        }
      };
      QObject::connect(button, &QPushButton::clicked, box, mend, Qt::QueuedConnection);
    }
    box->adjustSize();
  }
  box->move(margin, label->isHidden() ? margin : label->geometry().bottom() + margin);
  box->setVisible(!remedies.empty());
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
  QString status = QString::fromUtf8(vtkSMPropertyHelper(filter, "Status", true).GetAsString());
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
  QList<vtkSMProxy*> filters;
  if (isShown() && imagesInViews::isFlat(view))
  {
    for (pqPipelineSource* filter : imagesInViews::imagesIn(view))
    {
      filters << filter->getProxy();
    }
  }
  filters << (isShown() ? imagesInViews::benchesIn(view) : QList<vtkSMProxy*>());
  QStringList lines;
  for (vtkSMProxy* filter : filters)
  {
    lines << statusOf(filter);
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
    showRemedies(widget, label, filters);
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
