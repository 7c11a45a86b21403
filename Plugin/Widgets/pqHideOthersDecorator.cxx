// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqHideOthersDecorator.h"

#include "pqPropertyWidget.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMProxy.h"

namespace
{

/// Returns the proxy, among a display and the representations inside, that has the property of a widget.
vtkSMProxy* ownerOf(const pqPropertyWidget* widget)
{
  vtkSMProxy* display = widget->proxy();
  vtkSMProperty* property = widget->property();
  // Widgets of groups have no property; they are named after the kind of widget, followed by a number where there are
  // several.
  for (std::size_t i = 0; !property && i < display->GetNumberOfPropertyGroups(); ++i)
  {
    vtkSMPropertyGroup* group = display->GetPropertyGroup(i);
    const QString kind = QString(group->GetPanelWidget()).remove(' ');
    if (!kind.isEmpty() && widget->objectName().startsWith(kind))
    {
      property = group->GetProperty(0U);
    }
  }
  return property ? property->GetParent() : display;
}

} // namespace

pqHideOthersDecorator::pqHideOthersDecorator(
  vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  // The panel has the widgets of ParaView's own representations already, and asks their decorators whenever it is
  // updated.
  for (pqPropertyWidget* other : parentObject->parentWidget()->findChildren<pqPropertyWidget*>(
         QString(), Qt::FindDirectChildrenOnly))
  {
    vtkSMProxy* owner = ownerOf(other);
    if (owner != other->proxy() && owner != ownerOf(parentObject))
    {
      pqPropertyWidgetDecorator::create(element->GetNestedElement(0), other);
    }
  }
}

pqHideOthersDecorator::~pqHideOthersDecorator() = default;
