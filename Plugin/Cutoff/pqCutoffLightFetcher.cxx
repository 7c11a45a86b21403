// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCutoffLightFetcher.h"

#include "pqFetchedImage.h"
#include "pqImageRefiner.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkImageData.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

#include <QEvent>
#include <QWidget>

namespace
{

constexpr int imagePort = 0, histogramPort = 1;
constexpr int patience = 100; // milliseconds without another image

int informationOf(vtkSMProxy* filter, const char* name)
{
  vtkSMProperty* property = filter->GetProperty(name);
  filter->UpdatePropertyInformation(property);
  return vtkSMPropertyHelper(property).GetAsInt();
}

/// Returns whether the image is finished. Fetching an unfinished one would first finish it. Filters
/// in representations announce only finished images.
bool isWhole(vtkSMProxy* filter)
{
  if (filter->GetProperty("ImageSize")->GetIsInternal())
  {
    return informationOf(filter, "Finished") != 0;
  }
  auto* source = vtkSMSourceProxy::SafeDownCast(filter);
  int extent[6];
  source->GetDataInformation(imagePort)->GetExtent(extent);
  const int width = vtkSMPropertyHelper(filter, "ImageSize").GetAsInt(0);
  return extent[1] - extent[0] + 1 == width && informationOf(filter, "Finished") != 0;
}

} // namespace

//------------------------------------------------------------------------------
pqCutoffLightFetcher::pqCutoffLightFetcher(vtkSMProxy* filter, QWidget* widget)
  : QObject(widget)
  , Filter(filter)
  , Widget(widget)
{
  this->Timer.setSingleShot(true);
  this->Timer.setInterval(patience);
  QObject::connect(&this->Timer, &QTimer::timeout, this, &pqCutoffLightFetcher::fetch);
  this->Connection->Connect(filter, vtkCommand::UpdateDataEvent, this, SLOT(imageUpdated()));
  QObject::connect(pqImageRefiner::instance(), &pqImageRefiner::imageChanged, this,
    [this](vtkSMProxy* changed)
    {
      if (changed == this->Filter)
      {
        this->imageUpdated();
      }
    });
  widget->installEventFilter(this);
}

//------------------------------------------------------------------------------
pqCutoffLightFetcher::~pqCutoffLightFetcher() = default;

//------------------------------------------------------------------------------
bool pqCutoffLightFetcher::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Show)
  {
    this->imageUpdated();
  }
  return QObject::eventFilter(watched, event);
}

//------------------------------------------------------------------------------
void pqCutoffLightFetcher::setWaiting(bool waits)
{
  this->Waits = waits;
  this->imageUpdated();
}

//------------------------------------------------------------------------------
void pqCutoffLightFetcher::imageUpdated()
{
  if (this->Filter && !this->Waits)
  {
    this->Timer.start();
  }
}

//------------------------------------------------------------------------------
void pqCutoffLightFetcher::fetch()
{
  if (!this->Filter || this->Waits || !this->Widget->isVisible())
  {
    return;
  }
  if (pqImageRefiner::instance()->isPlaying())
  {
    this->Timer.start();
    return;
  }
  const int image = informationOf(this->Filter, "PictureCount");
  Q_EMIT this->imageChanged();
  if (image != this->FetchedImage && isWhole(this->Filter))
  {
    this->FetchedImage = image;
    this->Light = pqCutoffLight(fetchedImage(this->Filter, histogramPort, { "Rays" }));
    Q_EMIT this->lightChanged();
  }
}
