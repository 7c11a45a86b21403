// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImagePainter.h"

#include "ImagesInViews.h"
#include "pqApplicationCore.h"
#include "pqColorFilterImage.h"
#include "pqDataRepresentation.h"
#include "pqFetchedImage.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqView.h"

#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"

#include <QApplication>
#include <QKeyEvent>
#include <QSet>
#include <QWidget>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int imagePort = 0;
constexpr float beforeTheView = 10;  // priority that keeps the view from turning
constexpr double finestPlace = 1024; // resolution of the filter's side

vtkSMRenderViewProxy* renderViewOf(pqView* view)
{
  return view ? vtkSMRenderViewProxy::SafeDownCast(view->getProxy()) : nullptr;
}

pqServerManagerModel* model() { return pqApplicationCore::instance()->getServerManagerModel(); }

bool shows(pqView* view, vtkSMProxy* filter)
{
  auto* source = model()->findItem<pqPipelineSource*>(filter);
  const QList<pqDataRepresentation*> images =
    source ? source->getRepresentations(imagePort, view) : QList<pqDataRepresentation*>();
  return std::any_of(images.begin(), images.end(),
           [](pqDataRepresentation* image) { return image->isVisible(); }) ||
    imagesInViews::benchesIn(view).contains(filter);
}

/// The plane of an image in a view: z = 0 for a filter's output; for a representation, the plane
/// through the focal point with the view's axes.
struct ImagePlane
{
  double Right[3] = { 1, 0, 0 }, Up[3] = { 0, 1, 0 }, Normal[3] = { 0, 0, 1 }, Height = 0;

  static ImagePlane ofRepresentation(vtkRenderer* renderer)
  {
    ImagePlane plane;
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->GetDirectionOfProjection(plane.Normal);
    vtkMath::Cross(plane.Normal, camera->GetViewUp(), plane.Right);
    vtkMath::Normalize(plane.Right);
    vtkMath::Cross(plane.Right, plane.Normal, plane.Up);
    plane.Height = vtkMath::Dot(camera->GetFocalPoint(), plane.Normal);
    return plane;
  }
};

/// Intersects the line of sight through a pixel of the window with the plane.
bool placeUnder(const int pixel[2], vtkRenderer* renderer, const ImagePlane& plane, QPointF& place)
{
  double ends[2][4];
  for (int end = 0; end < 2; ++end)
  {
    renderer->SetDisplayPoint(pixel[0], pixel[1], end);
    renderer->DisplayToWorld();
    renderer->GetWorldPoint(ends[end]);
    for (int axis = 0; axis < 3; ++axis)
    {
      ends[end][axis] /= ends[end][3];
    }
  }
  const double before = vtkMath::Dot(ends[0], plane.Normal) - plane.Height;
  const double behind = vtkMath::Dot(ends[1], plane.Normal) - plane.Height;
  const double fraction = before / (before - behind);
  const auto along = [&](const double axis[3])
  {
    const double first = vtkMath::Dot(ends[0], axis);
    return first + fraction * (vtkMath::Dot(ends[1], axis) - first);
  };
  place = { along(plane.Right), along(plane.Up) };
  return std::isfinite(place.x()) && std::isfinite(place.y());
}

} // namespace

pqImagePainter::pqImagePainter(vtkSMProxy* filter, QObject* parentObject)
  : QObject(parentObject)
  , Filter(filter)
{
  QObject::connect(
    model(), &pqServerManagerModel::preViewRemoved, this, &pqImagePainter::viewRemoved);
}

pqImagePainter::~pqImagePainter() { this->stop(); }

bool pqImagePainter::start()
{
  for (pqView* view : model()->findItems<pqView*>())
  {
    vtkSMRenderViewProxy* proxy = renderViewOf(view);
    if (!proxy || !proxy->GetInteractor() || !shows(view, this->Filter))
    {
      continue;
    }
    this->Views.append(view);
    view->widget()->setCursor(Qt::CrossCursor);
    for (const unsigned long event : { vtkCommand::LeftButtonPressEvent, vtkCommand::MouseMoveEvent,
           vtkCommand::LeftButtonReleaseEvent })
    {
      this->Connection->Connect(proxy->GetInteractor(), event, this,
        SLOT(mouseEvent(vtkObject*, unsigned long, void*, void*, vtkCommand*)), view, beforeTheView,
        Qt::DirectConnection);
    }
  }
  if (this->isOn())
  {
    QApplication::instance()->installEventFilter(this);
  }
  return this->isOn();
}

void pqImagePainter::stop()
{
  if (!this->isOn())
  {
    return;
  }
  QApplication::instance()->removeEventFilter(this);
  this->Connection->Disconnect();
  for (pqView* view : this->Views)
  {
    if (view && view->widget())
    {
      view->widget()->unsetCursor();
    }
  }
  this->Views.clear();
  this->Deflection = nullptr;
  this->FetchedImage = 0;
  if (this->Pressed)
  {
    this->Pressed = nullptr;
    Q_EMIT this->strokeEnded();
  }
  Q_EMIT this->stopped();
}

void pqImagePainter::viewRemoved(pqView* view)
{
  if (this->Views.contains(view))
  {
    this->stop();
  }
}

bool pqImagePainter::eventFilter(QObject* watched, QEvent* event)
{
  if ((event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) &&
    static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape && !QApplication::activeModalWidget())
  {
    event->accept();
    this->stop();
    return true;
  }
  return QObject::eventFilter(watched, event);
}

bool pqImagePainter::fetchDeflection()
{
  for (const char* name : { "ImageCount", "KScaleUsed" })
  {
    this->Filter->UpdatePropertyInformation(this->Filter->GetProperty(name));
  }
  const int image = vtkSMPropertyHelper(this->Filter, "ImageCount").GetAsInt();
  this->K = vtkSMPropertyHelper(this->Filter, "KScaleUsed").GetAsDouble();
  if (image != this->FetchedImage)
  {
    this->Deflection = fetchedImage(this->Filter, imagePort, { "Deflection", "BlockedFraction" });
    this->FetchedImage = image;
  }
  return this->Deflection && this->Deflection->GetPointData()->GetArray("Deflection") &&
    this->K > 0;
}

void pqImagePainter::mouseEvent(
  vtkObject* caller, unsigned long event, void* client, void*, vtkCommand* command)
{
  auto* view = static_cast<pqView*>(client);
  auto* interactor = vtkRenderWindowInteractor::SafeDownCast(caller);
  if (!this->Filter || !interactor)
  {
    return;
  }
  if (event == vtkCommand::LeftButtonPressEvent && !this->Pressed && shows(view, this->Filter))
  {
    command->SetAbortFlag(1);
    if (this->fetchDeflection())
    {
      this->Pressed = view;
      this->HasLast = false;
      Q_EMIT this->strokeBegan();
      this->brush(interactor);
    }
  }
  else if (this->Pressed == view)
  {
    command->SetAbortFlag(1);
    if (event == vtkCommand::MouseMoveEvent)
    {
      this->brush(interactor);
    }
    else if (event == vtkCommand::LeftButtonReleaseEvent)
    {
      this->Pressed = nullptr;
      Q_EMIT this->strokeEnded();
    }
  }
}

void pqImagePainter::brush(vtkRenderWindowInteractor* interactor)
{
  QPointF position;
  vtkRenderer* renderer = renderViewOf(this->Pressed)->GetRenderer();
  const ImagePlane plane = imagesInViews::benchesIn(this->Pressed).contains(this->Filter)
    ? ImagePlane::ofRepresentation(renderer)
    : ImagePlane();
  if (!placeUnder(interactor->GetEventPosition(), renderer, plane, position))
  {
    return;
  }
  const double* bounds = this->Deflection->GetBounds();
  const double radius = this->BrushRadius * std::min(bounds[1] - bounds[0], bounds[3] - bounds[2]);
  QVector<QPointF> places;
  for (const QPointF& at : pqColorFilterImage::stroke(
         this->HasLast ? this->Last : position, position, std::max(radius, 1e-300)))
  {
    places += this->placesAround(at);
  }
  this->Last = position;
  this->HasLast = true;
  if (!places.isEmpty())
  {
    Q_EMIT this->brushed(places);
  }
}

QVector<QPointF> pqImagePainter::placesAround(const QPointF& position) const
{
  vtkDataArray* deflections = this->Deflection->GetPointData()->GetArray("Deflection");
  vtkDataArray* blocked = this->Deflection->GetPointData()->GetArray("BlockedFraction");
  const int* size = this->Deflection->GetDimensions();
  const double* origin = this->Deflection->GetOrigin();
  const double* spacing = this->Deflection->GetSpacing();
  const int* extent = this->Deflection->GetExtent();
  // Computes pixels from the centre of the first one.
  const double column = (position.x() - origin[0]) / spacing[0] - extent[0];
  const double row = (position.y() - origin[1]) / spacing[1] - extent[2];
  const double radius = this->BrushRadius * std::min(size[0], size[1]);
  const auto first = [](double middle, double reach)
  { return static_cast<int>(std::lround(std::max(0., middle - reach))); };
  const auto last = [](double middle, double reach, int count)
  { return static_cast<int>(std::lround(std::min(count - 1., middle + reach))); };
  QVector<QPointF> places;
  QSet<QPair<int, int>> known;
  for (int y = first(row, radius); y <= last(row, radius, size[1]); ++y)
  {
    for (int x = first(column, radius); x <= last(column, radius, size[0]); ++x)
    {
      const bool isNearest = std::abs(x - column) <= 0.5 && std::abs(y - row) <= 0.5;
      const vtkIdType pixel = x + static_cast<vtkIdType>(y) * size[0];
      if ((!isNearest && std::hypot(x - column, y - row) > radius) ||
        (blocked && blocked->GetTuple1(pixel) >= 1))
      {
        continue;
      }
      const double u = this->K * deflections->GetComponent(pixel, 0);
      const double v = this->K * deflections->GetComponent(pixel, 1);
      if (!std::isfinite(u) || !std::isfinite(v))
      {
        continue;
      }
      // Clamps to the filter, whose edge colours extend beyond it.
      const QPointF place(qBound(-1., u, 1.), qBound(-1., v, 1.));
      const QPair<int, int> cell(static_cast<int>(std::lround(place.x() * finestPlace / 2)),
        static_cast<int>(std::lround(place.y() * finestPlace / 2)));
      if (isNearest || !known.contains(cell))
      {
        known.insert(cell);
        places.insert(isNearest ? 0 : places.size(), place);
      }
    }
  }
  return places;
}
