// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqImageDisplayKeeper.h"

#include "ImageDisplay.h"
#include "ImagesInViews.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyLocator.h"
#include "vtkSMTrace.h"

#include <QVariant>

#include <cstring>
#include <sstream>

namespace
{

/// Qt property of a source: the last ImageDisplay::white() of its cutoff.
constexpr const char* lastWhite = "SchlierenWhite";

} // namespace

//------------------------------------------------------------------------------
pqImageDisplayKeeper::pqImageDisplayKeeper(QObject* parentObject)
  : QObject(parentObject)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, SIGNAL(sourceAdded(pqPipelineSource*)), SLOT(watch(pqPipelineSource*)));
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watch(source);
  }
  QObject::connect(pqApplicationCore::instance(), &pqApplicationCore::stateLoaded, this,
    &pqImageDisplayKeeper::onStateLoaded);
}

//------------------------------------------------------------------------------
pqImageDisplayKeeper::~pqImageDisplayKeeper() = default;

//------------------------------------------------------------------------------
void pqImageDisplayKeeper::watch(pqPipelineSource* source)
{
  if (imagesInViews::isSchlieren(source))
  {
    source->setProperty(lastWhite, ImageDisplay::white(source->getProxy()));
    this->Events->Connect(
      source->getProxy(), vtkCommand::UpdateEvent, this, SLOT(onFilterChanged(vtkObject*)));
  }
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
void pqImageDisplayKeeper::onStateLoaded(vtkPVXMLElement* root, vtkSMProxyLocator* locator)
{
  vtkPVXMLElement* nested = root->FindNestedElementByName("ServerManagerState");
  vtkPVXMLElement* state = nested ? nested : root;
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (unsigned int i = 0; i < state->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* element = state->GetNestedElement(i);
    vtkTypeUInt32 id = 0;
    std::istringstream(element->GetAttributeOrDefault("id", "0")) >> id;
    const bool isView = std::strcmp(element->GetAttributeOrDefault("group", ""), "views") == 0;
    auto* view = model->findItem<pqRenderView*>(isView ? locator->LocateProxy(id) : nullptr);
    for (unsigned int j = 0; view && j < element->GetNumberOfNestedElements(); ++j)
    {
      vtkPVXMLElement* property = element->GetNestedElement(j);
      vtkPVXMLElement* value = property->FindNestedElementByName("Element");
      int isOn = 0;
      if (value && value->GetScalarAttribute("value", &isOn) &&
        std::strcmp(property->GetAttributeOrDefault("name", ""), "UseFXAA") == 0 &&
        !imagesInViews::imagesIn(view).isEmpty())
      {
        SCOPED_UNDO_EXCLUDE();
        vtkSMPropertyHelper(view->getProxy(), "UseFXAA").Set(isOn);
        view->getProxy()->UpdateVTKObjects();
        view->render();
      }
    }
  }
}
