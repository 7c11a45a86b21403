// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqQualityHintsDecorator.h"

#include "pqPropertyWidget.h"

#include "vtkSMEnumerationDomain.h"
#include "vtkSMProperty.h"
#include "vtkSchlierenFilter.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QMap>
#include <QStyledItemDelegate>

#include <cstring>

namespace
{

using Filter = vtkSchlierenFilter;

double valueOf(int quality, const char* property)
{
  int number = 0;
  while (Filter::GetQualitySetting(number) &&
    std::strcmp(Filter::GetQualitySetting(number), property) != 0)
  {
    ++number;
  }
  return Filter::GetQualityValue(quality, number);
}

QString hintFor(int quality)
{
  if (quality == Filter::CUSTOM)
  {
    return pqQualityHintsDecorator::tr("as set below");
  }
  const double rays = valueOf(quality, "SamplesPerPixel");
  const double step = valueOf(quality, "StepSize");
  const QString hint = pqQualityHintsDecorator::tr("%1, %2").arg(rays == 1
      ? pqQualityHintsDecorator::tr("1 ray per pixel")
      : pqQualityHintsDecorator::tr("%1 rays per pixel").arg(rays),
    step == 1 ? pqQualityHintsDecorator::tr("steps of 1 voxel")
              : pqQualityHintsDecorator::tr("steps of %1 voxels").arg(step));
  return quality == Filter::INTERACTIVE ? pqQualityHintsDecorator::tr("fastest; %1").arg(hint)
    : quality == Filter::REFERENCE      ? pqQualityHintsDecorator::tr("finest; %1").arg(hint)
                                        : hint;
}

/// Draws the entries of a list with descriptions.
class Hints : public QStyledItemDelegate
{
public:
  Hints(vtkSMEnumerationDomain* domain, QObject* parentObject)
    : QStyledItemDelegate(parentObject)
  {
    for (unsigned int i = 0; i < domain->GetNumberOfEntries(); ++i)
    {
      this->OfNames[domain->GetEntryText(i)] = hintFor(domain->GetEntryValue(i));
    }
  }

  QString displayText(const QVariant& value, const QLocale& locale) const override
  {
    const QString name = QStyledItemDelegate::displayText(value, locale);
    const QString hint = this->OfNames.value(name);
    return hint.isEmpty() ? name : name + " – " + hint;
  }

private:
  QMap<QString, QString> OfNames;
};

} // namespace

//------------------------------------------------------------------------------
pqQualityHintsDecorator::pqQualityHintsDecorator(
  vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
{
  auto* box = parentObject->findChild<QComboBox*>();
  auto* domain = parentObject->property()->FindDomain<vtkSMEnumerationDomain>();
  if (box && domain)
  {
    box->setItemDelegate(new Hints(domain, box));
    constexpr int frame = 20; // pixels around the longest entry
    box->view()->setMinimumWidth(box->view()->sizeHintForColumn(0) + frame);
  }
}

//------------------------------------------------------------------------------
pqQualityHintsDecorator::~pqQualityHintsDecorator() = default;
