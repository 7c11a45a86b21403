// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageProbe.h"

#include "ImagesInViews.h"
#include "UnitPrefix.h"
#include "pqRepresentationRefiner.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"

#include <QHelpEvent>
#include <QToolTip>

#include <array>
#include <cmath>

namespace
{

/// Property of a watched widget: its view.
constexpr const char* viewOfWidget = "SchlierenProbedView";

/// Returns the image of a filter in this process; null: it has none.
vtkImageData* imageOf(vtkSMProxy* filter)
{
  auto* algorithm = vtkAlgorithm::SafeDownCast(filter->GetClientSideObject());
  auto* image = algorithm ? vtkImageData::SafeDownCast(algorithm->GetOutputDataObject(0)) : nullptr;
  return image && image->GetPointData()->GetArray("Intensity") ? image : nullptr;
}

double fieldValue(vtkImageData* image, const char* name, int component)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() > component
    ? array->GetVariantValue(component).ToDouble()
    : 0;
}

/// Returns values with a unit whose prefix suits the largest of them.
QString inWords(std::initializer_list<double> values, const QString& unit)
{
  double largest = 0;
  for (const double value : values)
  {
    largest = std::max(largest, std::abs(value));
  }
  const UnitPrefix prefix = unitPrefixOf(largest);
  QStringList texts;
  for (const double value : values)
  {
    texts << QString::number(value / prefix.factor, 'g', 4);
  }
  return texts.join(", ") + " " + QString::fromUtf8(prefix.name) + unit;
}

/// Returns the name of a direction in the data, if it is along an axis.
QString axisName(vtkImageData* image, const char* direction, const QString& otherwise)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double part = fieldValue(image, direction, axis);
    if (std::abs(part) > 1 - 1e-9)
    {
      return (part < 0 ? "-" : "") + QString("xyz").mid(axis, 1);
    }
  }
  return otherwise;
}

/// Returns what a pixel of an image has; empty if it is not in the image.
QString pixelInWords(vtkImageData* image, int column, int row)
{
  const int* size = image->GetDimensions();
  if (column < 0 || row < 0 || column >= size[0] || row >= size[1])
  {
    return QString();
  }
  const vtkIdType pixel = vtkIdType{ row } * size[0] + column;
  const auto valueOf = [&](const char* name, int component)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(name);
    return array ? array->GetComponent(pixel, component) : 0;
  };
  const double scale = fieldValue(image, "LengthScale", 0);
  double place[3];
  image->GetPoint(pixel, place);
  QString text = axisName(image, "AxisRight", "u") + ", " + axisName(image, "AxisUp", "v") + ": " +
    inWords({ scale * place[0], scale * place[1] }, "m");
  if (valueOf("BlockedFraction", 0) >= 1)
  {
    return text + "\nLight is blocked";
  }
  text += "\nDeflection to the right, up: " +
    inWords({ valueOf("Deflection", 0), valueOf("Deflection", 1) }, "rad");
  text += "\nOptical path difference: " + inWords({ valueOf("OpticalPathDifference", 0) }, "m");
  return text + "\nIntensity: " + QString::number(valueOf("Intensity", 0), 'g', 3);
}

/// Returns what the image that a view draws has at a place, from 0 to 1 to the right and up.
QString drawnInWords(pqRenderView* view, double right, double up)
{
  for (vtkSMProxy* bench : pqRepresentationRefiner::benchesIn(view))
  {
    if (vtkImageData* image = imageOf(bench))
    {
      return pixelInWords(image, static_cast<int>(std::floor(right * image->GetDimensions()[0])),
        static_cast<int>(std::floor(up * image->GetDimensions()[1])));
    }
  }
  return QString();
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
  const double fraction = ends[0][2] / depth;
  std::array<double, 2> place{};
  for (int axis = 0; axis < 2; ++axis)
  {
    place[axis] = ends[0][axis] + fraction * (ends[1][axis] - ends[0][axis]);
  }
  for (pqPipelineSource* filter : imagesInViews::imagesIn(view))
  {
    vtkImageData* image = imageOf(filter->getProxy());
    const auto index = [&](int axis)
    {
      return static_cast<int>(
        std::lround((place[axis] - image->GetOrigin()[axis]) / image->GetSpacing()[axis]));
    };
    const QString text = image ? pixelInWords(image, index(0), index(1)) : QString();
    if (!text.isEmpty())
    {
      return text;
    }
  }
  return QString();
}

} // namespace

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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
