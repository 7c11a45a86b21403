// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqPresetsDecorator.h"

#include "BenchPresets.h"
#include "WidgetRows.h"
#include "pqPropertyWidget.h"

#include "vtkSMUncheckedPropertyHelper.h"

#include <QComboBox>
#include <QMenu>
#include <QToolButton>

//------------------------------------------------------------------------------
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
        for (const PresetSetting& setting : preset.settings)
        {
          vtkSMUncheckedPropertyHelper value(this->parentWidget()->proxy(), setting.property);
          if (setting.text)
          {
            value.Set(setting.text);
          }
          else
          {
            value.Set(setting.number);
          }
        }
        // The panel listens to its widgets only: now there is something to apply.
        Q_EMIT this->parentWidget()->changeAvailable();
        Q_EMIT this->parentWidget()->changeFinished();
      });
  }
  button->setMenu(menu);
  // Together no wider than ParaView's panel is without asking for room.
  constexpr int fewestLetters = 8;
  for (QComboBox* box : parentObject->findChildren<QComboBox*>())
  {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(fewestLetters);
  }
  appendToRow(parentObject, button);
}

//------------------------------------------------------------------------------
pqPresetsDecorator::~pqPresetsDecorator() = default;
