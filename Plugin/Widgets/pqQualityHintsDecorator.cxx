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

namespace
{

using Filter = vtkSchlierenFilter;

QString hintFor(int quality)
{
  const double time = Filter::GetQualityTime(quality);
  return quality == Filter::CUSTOM ? pqQualityHintsDecorator::tr("as set below")
    : quality == Filter::AUTOMATIC ? pqQualityHintsDecorator::tr("errors that cannot be seen")
    : quality == Filter::REFERENCE
    ? pqQualityHintsDecorator::tr("to compare with, hundreds of times as long")
    : pqQualityHintsDecorator::tr("errors up to %1 %, %2")
        .arg(100 * Filter::GetQualityError(quality, Filter::KNIFE_EDGE))
        .arg(time > 1 ? pqQualityHintsDecorator::tr("%1 times as long").arg(time)
                      : pqQualityHintsDecorator::tr("fastest"));
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
