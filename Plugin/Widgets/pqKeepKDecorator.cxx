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
#include "vtkSchlierenFilter.h"

namespace
{

bool isValueInPanel(vtkSMProperty* property)
{
  return vtkSMUncheckedPropertyHelper(property).GetAsInt() == vtkSchlierenFilter::K_VALUE;
}

} // namespace

pqKeepKDecorator::pqKeepKDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
  , WasValue(isValueInPanel(parentObject->property()))
{
  for (const unsigned long event :
    { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Connection->Connect(parentObject->property(), event, this, SLOT(onChoice()));
  }
}

pqKeepKDecorator::~pqKeepKDecorator() = default;

void pqKeepKDecorator::onChoice()
{
  vtkSMProperty* choice = this->parentWidget()->property();
  vtkSMProxy* filter = this->parentWidget()->proxy();
  const bool was = this->WasValue;
  this->WasValue = isValueInPanel(choice);
  // Acts if the applied k is another one and the user has chosen Value.
  if (!was && this->WasValue &&
    vtkSMPropertyHelper(choice).GetAsInt() != vtkSchlierenFilter::K_VALUE)
  {
    filter->UpdatePropertyInformation(filter->GetProperty("KScaleUsed"));
    const double k = vtkSMPropertyHelper(filter, "KScaleUsed").GetAsDouble();
    if (k > 0)
    {
      vtkSMUncheckedPropertyHelper(filter, "KScale").Set(k);
    }
  }
}
