// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFitKDecorator.h"

#include "WidgetRows.h"
#include "pqImageRefiner.h"
#include "pqPropertyWidget.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMTrace.h"

#include <QToolButton>

//------------------------------------------------------------------------------
pqFitKDecorator::pqFitKDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  auto* button = new QToolButton(parentObject);
  button->setObjectName("FitK");
  button->setText(tr("Fit Again"));
  button->setToolTip(tr("Finds the sensitivity k again, for the image as it is now."));
  QObject::connect(button, &QToolButton::clicked, this, &pqFitKDecorator::fit);
  appendToRow(parentObject, button);
}

//------------------------------------------------------------------------------
pqFitKDecorator::~pqFitKDecorator() = default;

//------------------------------------------------------------------------------
void pqFitKDecorator::fit()
{
  vtkSMProxy* filter = this->parentWidget()->proxy();
  filter->UpdatePropertyInformation();
  // The property follows updates of the data only, and k is kept while the camera moves, too.
  vtkSMPropertyHelper(filter, "LockedK")
    .Set(vtkSMPropertyHelper(filter, "LockedKInformation").GetAsDouble());
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
    vtkSMPropertyHelper(filter, "LockedK").Set(0.);
    filter->UpdateVTKObjects();
  }
  pqImageRefiner::instance()->refine(filter);
}
