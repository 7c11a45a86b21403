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
#include "pqUndoStack.h"
#include "pqView.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyLocator.h"
#include "vtkSMTrace.h"

#include <cstring>
#include <sstream>

namespace
{

/// Sets a property to the value that is kept in a proxy's part of a state file.
void setFromState(vtkSMProxy* proxy, const char* name, vtkPVXMLElement* state)
{
  for (unsigned int i = 0; i < state->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* property = state->GetNestedElement(i);
    vtkPVXMLElement* element = property->FindNestedElementByName("Element");
    const char* itsName = property->GetAttribute("name");
    int value = 0;
    if (element && itsName && std::strcmp(itsName, name) == 0 &&
      element->GetScalarAttribute("value", &value))
    {
      vtkSMPropertyHelper(proxy, name).Set(value);
      proxy->UpdateVTKObjects();
    }
  }
}

} // namespace

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
  QObject::connect(pqApplicationCore::instance(), &pqApplicationCore::stateLoaded, this,
    &pqPictureDisplayKeeper::onStateLoaded);
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

//------------------------------------------------------------------------------
void pqPictureDisplayKeeper::onStateLoaded(vtkPVXMLElement* root, vtkSMProxyLocator* locator)
{
  vtkPVXMLElement* nested = root->FindNestedElementByName("ServerManagerState");
  vtkPVXMLElement* state = nested ? nested : root;
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (unsigned int i = 0; i < state->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* element = state->GetNestedElement(i);
    const char* group = element->GetAttribute("group");
    vtkTypeUInt32 id = 0;
    std::istringstream(element->GetAttributeOrDefault("id", "0")) >> id;
    vtkSMProxy* proxy =
      group && std::strcmp(group, "views") == 0 ? locator->LocateProxy(id) : nullptr;
    auto* view = model->findItem<pqView*>(proxy);
    if (view && picturesInViews::isFlat(view) && !picturesInViews::picturesIn(view).isEmpty())
    {
      SCOPED_UNDO_EXCLUDE();
      setFromState(proxy, "UseFXAA", element);
      view->render();
    }
  }
}
