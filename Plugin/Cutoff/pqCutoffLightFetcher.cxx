// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqCutoffLightFetcher.h"

#include "pqFetchedImage.h"
#include "pqRepresentationRefiner.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkImageData.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QEvent>
#include <QWidget>

namespace
{

constexpr int histogramPort = 1;
constexpr int patience = 100; // milliseconds without another image

int informationOf(vtkSMProxy* filter, const char* name)
{
  vtkSMProperty* property = filter->GetProperty(name);
  filter->UpdatePropertyInformation(property);
  return vtkSMPropertyHelper(property).GetAsInt();
}

} // namespace

pqCutoffLightFetcher::pqCutoffLightFetcher(vtkSMProxy* filter, QWidget* widget)
  : QObject(widget)
  , Filter(filter)
  , Widget(widget)
{
  this->Timer.setSingleShot(true);
  this->Timer.setInterval(patience);
  QObject::connect(&this->Timer, &QTimer::timeout, this, &pqCutoffLightFetcher::fetch);
  this->Connection->Connect(filter, vtkCommand::UpdateDataEvent, this, SLOT(imageUpdated()));
  QObject::connect(pqRepresentationRefiner::instance(), &pqRepresentationRefiner::imageChanged,
    this,
    [this](vtkSMProxy* changed)
    {
      if (changed == this->Filter)
      {
        this->imageUpdated();
      }
    });
  widget->installEventFilter(this);
}

pqCutoffLightFetcher::~pqCutoffLightFetcher() = default;

bool pqCutoffLightFetcher::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Show)
  {
    this->imageUpdated();
  }
  return QObject::eventFilter(watched, event);
}

void pqCutoffLightFetcher::setWaiting(bool waits)
{
  this->Waits = waits;
  this->imageUpdated();
}

void pqCutoffLightFetcher::imageUpdated()
{
  if (this->Filter && !this->Waits)
  {
    this->Timer.start();
  }
}

void pqCutoffLightFetcher::fetch()
{
  if (!this->Filter || this->Waits || !this->Widget->isVisible())
  {
    return;
  }
  const int image = informationOf(this->Filter, "ImageCount");
  Q_EMIT this->imageChanged();
  // Fetching an unfinished image would first finish it.
  if (image != this->FetchedImage && informationOf(this->Filter, "Finished") != 0)
  {
    this->FetchedImage = image;
    this->Light = pqCutoffLight(fetchedImage(this->Filter, histogramPort, { "Rays" }));
    Q_EMIT this->lightChanged();
  }
}
