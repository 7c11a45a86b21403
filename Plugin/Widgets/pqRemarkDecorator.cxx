// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqRemarkDecorator.h"

#include "InputOfFilter.h"
#include "NumberText.h"
#include "WidgetRows.h"
#include "pqPropertyWidget.h"

#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkSMProperty.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkSchlierenFilter.h"

#include <QLabel>

#include <cmath>

namespace
{

QString edgeOf(double angle)
{
  const double turned = std::fmod(std::abs(angle), 180);
  return turned == 0 ? QObject::tr("vertical edge")
    : turned == 90   ? QObject::tr("horizontal edge")
                     : QString();
}

QString sizeOf(vtkSMProxy* filter, double metresPerUnit)
{
  vtkPVDataInformation* data = inputOf(filter);
  const std::array<double, 3> sides = data ? sidesOf(data) : std::array<double, 3>();
  const double longest = metresPerUnit * *std::max_element(sides.begin(), sides.end());
  if (!(longest > 0))
  {
    return QString();
  }
  const UnitPrefix prefix = unitPrefixOf(longest);
  QStringList numbers;
  for (const double side : sides)
  {
    numbers << QString::number(metresPerUnit * side / prefix.factor, 'g', 3);
  }
  return numbers.join(QStringLiteral(" × ")) + " " + prefix.name + "m";
}

/// Says what Documentation/quality.md has measured.
QString costOf(int quality)
{
  using Filter = vtkSchlierenFilter;
  switch (quality)
  {
    case Filter::INTERACTIVE:
      return QObject::tr("errors of up to 15 %");
    case Filter::FINE:
      return QObject::tr("errors of up to 3 %, 5 times the time");
    case Filter::PUBLICATION:
      return QObject::tr("errors of up to 1 %, 20 times the time");
    case Filter::REFERENCE:
      return QObject::tr("to assess others, hundreds of times the time");
    case Filter::AUTOMATIC:
      return QObject::tr("errors that cannot be seen");
    default:
      return QObject::tr("as the advanced properties say");
  }
}

} // namespace

pqRemarkDecorator::pqRemarkDecorator(vtkPVXMLElement* element, pqPropertyWidget* parentObject)
  : pqPropertyWidgetDecorator(element, parentObject)
  , Label(new QLabel(parentObject))
{
  this->Label->setObjectName("Remark");
  this->Label->setTextFormat(Qt::PlainText);
  vtkSMProperty* property = parentObject->property();
  if (std::string(property->GetXMLName()) == "KnifeEdgeAngle")
  {
    appendToRow(parentObject, this->Label);
  }
  else
  {
    this->Label->setWordWrap(true);
    appendBelowRow(parentObject, this->Label);
  }
  for (const unsigned long event :
    { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Connection->Connect(property, event, this, SLOT(showText()));
  }
  if (vtkSMProperty* input = parentObject->proxy()->GetProperty("Input"))
  {
    this->Connection->Connect(input, vtkCommand::ModifiedEvent, this, SLOT(showText()));
  }
  this->showText();
}

pqRemarkDecorator::~pqRemarkDecorator() = default;

void pqRemarkDecorator::showText()
{
  vtkSMProperty* property = this->parentWidget()->property();
  const std::string name = property->GetXMLName();
  const double value = vtkSMUncheckedPropertyHelper(property).GetAsDouble();
  this->Label->setText(name == "KnifeEdgeAngle" ? edgeOf(value)
      : name == "LengthScale"                   ? sizeOf(this->parentWidget()->proxy(), value)
                                                : costOf(static_cast<int>(value)));
  this->Label->setVisible(!this->Label->text().isEmpty());
}
