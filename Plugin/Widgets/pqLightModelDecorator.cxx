// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqLightModelDecorator.h"

#include "pqPropertyWidget.h"
#include "vtkSchlierenFilter.h"

#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <utility>

namespace
{

/// Returns what the panel shows.
int inPanel(vtkSMProxy* filter, const char* name)
{
  return vtkSMUncheckedPropertyHelper(filter, name).GetAsInt();
}

} // namespace

//------------------------------------------------------------------------------
pqLightModelDecorator::pqLightModelDecorator(
  vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  for (vtkSMProperty* property :
    { parentObject->property(), parentObject->proxy()->GetProperty("Cutoff") })
  {
    for (const unsigned long event :
      { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
    {
      this->Connection->Connect(property, event, this, SLOT(onChoice()));
    }
  }
}

//------------------------------------------------------------------------------
pqLightModelDecorator::~pqLightModelDecorator() = default;

//------------------------------------------------------------------------------
bool pqLightModelDecorator::canShowWidget(bool showAdvanced) const
{
  vtkSMProxy* filter = this->parentWidget()->proxy();
  return showAdvanced || inPanel(filter, "LightModel") != vtkSchlierenFilter::LIGHT_RAYS ||
    inPanel(filter, "Cutoff") == vtkSchlierenFilter::PHASE_CONTRAST;
}

//------------------------------------------------------------------------------
void pqLightModelDecorator::onChoice()
{
  vtkSMProxy* filter = this->parentWidget()->proxy();
  const int cutoff = inPanel(filter, "Cutoff");
  const bool isNew = cutoff != vtkSMPropertyHelper(filter, "Cutoff").GetAsInt(); // not by a script
  const int model = inPanel(filter, "LightModel");
  vtkSMUncheckedPropertyHelper chosen(filter, "LightModel");
  if (cutoff != vtkSchlierenFilter::PHASE_CONTRAST)
  {
    if (std::exchange(this->IsSetForCutoff, false) && model == vtkSchlierenFilter::LIGHT_AUTO)
    {
      chosen.Set(vtkSchlierenFilter::LIGHT_RAYS);
    }
  }
  else if (isNew && !this->IsSetForCutoff && model == vtkSchlierenFilter::LIGHT_RAYS)
  {
    this->IsSetForCutoff = true;
    chosen.Set(vtkSchlierenFilter::LIGHT_AUTO);
  }
  Q_EMIT this->visibilityChanged();
}
