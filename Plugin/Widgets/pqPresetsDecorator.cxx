// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPresetsDecorator.h"

#include "BenchPresets.h"
#include "WidgetRows.h"
#include "pqLiveEdit.h"
#include "pqPropertyWidget.h"
#include "pqSMAdaptor.h"

#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QMenu>
#include <QToolButton>

namespace
{

QMap<QString, QVariant> valuesOf(const BenchPreset& preset)
{
  QMap<QString, QVariant> values;
  for (const PresetSetting& setting : preset.settings)
  {
    values[setting.property] = setting.text ? QVariant(setting.text) : QVariant(setting.number);
  }
  return values;
}

/// Applies a preset at once as one undo step, without other changes that wait for Apply.
void applyPreset(vtkSMProxy* filter, const BenchPreset& preset)
{
  pqLiveEdit edit(filter, QObject::tr("Bench: %1").arg(preset.name));
  edit.show(valuesOf(preset));
  edit.finish();
  for (const PresetSetting& setting : preset.settings)
  {
    vtkSMProperty* property = filter->GetProperty(setting.property);
    if (pqSMAdaptor::getElementProperty(property, pqSMAdaptor::UNCHECKED) !=
      pqSMAdaptor::getElementProperty(property))
    {
      property->ClearUncheckedElements(); // discards edits that were not applied
    }
  }
}

/// Shows a preset in the panel for Apply.
void showPreset(vtkSMProxy* filter, const BenchPreset& preset)
{
  for (const PresetSetting& setting : preset.settings)
  {
    vtkSMUncheckedPropertyHelper value(filter, setting.property);
    if (setting.text)
    {
      value.Set(setting.text);
    }
    else
    {
      value.Set(setting.number);
    }
  }
}

} // namespace

pqPresetsDecorator::pqPresetsDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  auto* button = new QToolButton(parentObject);
  button->setObjectName("Presets");
  button->setText(tr("Presets"));
  button->setToolTip(
    tr("Sets everything behind the flow, and the light before it, to a bench as it is "
       "known from laboratories."));
  button->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(button);
  menu->setObjectName("PresetsMenu");
  for (const BenchPreset& preset : benchPresets())
  {
    QAction* action = menu->addAction(tr(preset.name));
    action->setObjectName(preset.name);
    QObject::connect(action, &QAction::triggered, this,
      [this, &preset]()
      {
        vtkSMProxy* filter = this->parentWidget()->proxy();
        filter->UpdatePropertyInformation(filter->GetProperty("ImageCount"));
        if (pqLiveEdit::isPossible(filter))
        {
          applyPreset(filter, preset);
          return;
        }
        showPreset(filter, preset);
        // Enables Apply, because the panel observes only its widgets.
        Q_EMIT this->parentWidget()->changeAvailable();
        Q_EMIT this->parentWidget()->changeFinished();
      });
  }
  button->setMenu(menu);
  narrowLists(parentObject);
  appendToRow(parentObject, button);
}

pqPresetsDecorator::~pqPresetsDecorator() = default;
