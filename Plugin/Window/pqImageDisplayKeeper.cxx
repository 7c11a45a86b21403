// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageDisplayKeeper.h"

#include "FlatViews.h"
#include "ImageDisplay.h"
#include "ImagesInViews.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProxy.h"
#include "vtkSMTrace.h"

#include <QVariant>

#include <utility>

namespace
{

/// Qt property of a source: the last ImageDisplay::white() of its cutoff.
constexpr const char* lastWhite = "SchlierenWhite";

} // namespace

pqImageDisplayKeeper::pqImageDisplayKeeper(QObject* parentObject)
  : QObject(parentObject)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, SIGNAL(sourceAdded(pqPipelineSource*)), SLOT(watch(pqPipelineSource*)));
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watch(source);
  }
}

pqImageDisplayKeeper::~pqImageDisplayKeeper() = default;

void pqImageDisplayKeeper::watch(pqPipelineSource* source)
{
  if (imagesInViews::isSchlieren(source))
  {
    source->setProperty(lastWhite, ImageDisplay::white(source->getProxy()));
    this->Events->Connect(
      source->getProxy(), vtkCommand::UpdateEvent, this, SLOT(onFilterChanged(vtkObject*)));
  }
  if (imagesInViews::isSchlieren(source) || imagesInViews::isComparison(source))
  {
    QObject::connect(source, &pqPipelineSource::modifiedStateChanged, this,
      [source, state = source->modifiedState()]() mutable
      {
        const pqProxy::ModifiedState before = std::exchange(state, source->modifiedState());
        pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
        if (before == pqProxy::UNINITIALIZED && state == pqProxy::UNMODIFIED &&
          !(stack && (stack->getInUndo() || stack->getInRedo())))
        {
          showInFlatViews(source); // where ParaView has shown it
        }
      });
  }
}

void pqImageDisplayKeeper::onFilterChanged(vtkObject* filter)
{
  auto* proxy = static_cast<vtkSMProxy*>(filter);
  auto* source =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(proxy);
  const double white = ImageDisplay::white(proxy);
  if (!source || source->property(lastWhite).toDouble() == white)
  {
    return;
  }
  source->setProperty(lastWhite, white);
  for (pqDataRepresentation* shown : source->getOutputPort(0)->getRepresentations(nullptr))
  {
    vtkSMProxy* representation = shown->getProxy();
    if (ImageDisplay::isApplied(representation))
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", representation);
      ImageDisplay::apply(representation, proxy);
    }
  }
}
