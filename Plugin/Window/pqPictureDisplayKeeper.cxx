// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPictureDisplayKeeper.h"

#include "PictureDisplay.h"
#include "PicturesInViews.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProxy.h"
#include "vtkSMTrace.h"

//------------------------------------------------------------------------------
pqPictureDisplayKeeper::pqPictureDisplayKeeper(QObject* parentObject)
  : QObject(parentObject)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, SIGNAL(sourceAdded(pqPipelineSource*)), SLOT(watch(pqPipelineSource*)));
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watch(source);
  }
}

//------------------------------------------------------------------------------
pqPictureDisplayKeeper::~pqPictureDisplayKeeper() = default;

//------------------------------------------------------------------------------
void pqPictureDisplayKeeper::watch(pqPipelineSource* source)
{
  if (picturesInViews::isSchlieren(source))
  {
    this->Events->Connect(
      source->getProxy(), vtkCommand::UpdateEvent, this, SLOT(onFilterChanged(vtkObject*)));
  }
}

//------------------------------------------------------------------------------
void pqPictureDisplayKeeper::onFilterChanged(vtkObject* filter)
{
  auto* proxy = static_cast<vtkSMProxy*>(filter);
  auto* source =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(proxy);
  pqOutputPort* picture = source ? source->getOutputPort(0) : nullptr;
  if (!picture)
  {
    return;
  }
  for (pqDataRepresentation* shown : picture->getRepresentations(nullptr))
  {
    vtkSMProxy* representation = shown->getProxy();
    if (PictureDisplay::isApplied(representation) && !PictureDisplay::suits(representation, proxy))
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
      PictureDisplay::apply(representation, proxy);
    }
  }
}
