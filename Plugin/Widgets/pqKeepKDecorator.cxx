// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqKeepKDecorator.h"

#include "pqPropertyWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

namespace
{

bool isAutomaticInPanel(vtkSMProperty* property)
{
  return vtkSMUncheckedPropertyHelper(property).GetAsInt() != 0;
}

} // namespace

//------------------------------------------------------------------------------
pqKeepKDecorator::pqKeepKDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
  , WasAutomatic(isAutomaticInPanel(parentObject->property()))
{
  for (const unsigned long event :
    { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Connection->Connect(parentObject->property(), event, this, SLOT(onChoice()));
  }
}

//------------------------------------------------------------------------------
pqKeepKDecorator::~pqKeepKDecorator() = default;

//------------------------------------------------------------------------------
void pqKeepKDecorator::onChoice()
{
  vtkSMProperty* choice = this->parentWidget()->property();
  vtkSMProxy* filter = this->parentWidget()->proxy();
  const bool was = this->WasAutomatic;
  this->WasAutomatic = isAutomaticInPanel(choice);
  // Acts if the applied k is automatic and the user has unchecked it.
  if (was && !this->WasAutomatic && vtkSMPropertyHelper(choice).GetAsInt() != 0)
  {
    filter->UpdatePropertyInformation(filter->GetProperty("KScaleUsed"));
    const double k = vtkSMPropertyHelper(filter, "KScaleUsed").GetAsDouble();
    if (k > 0)
    {
      vtkSMUncheckedPropertyHelper(filter, "KScale").Set(k);
    }
  }
}
